"""Exported files hold what the result holds, to the last bit, whatever is read at once."""

import csv
import math
import subprocess
import sys
from pathlib import Path
from typing import Any

import h5netcdf
import numpy as np
import pytest
import xarray
from hypothesis import given
from hypothesis import strategies as st

from rocksteady.errors import InputError, OutputError
from rocksteady.export import write_dataset
from rocksteady.show.export import _slices, csv_files
from tests.every import every

WORDS = "at_rest over"
ODD = [math.nan, math.inf, -math.inf, 0.1 + 0.2, -0.0, 5e-324, 1.7976931348623157e308, 1.0 / 3.0]


def result(shape: tuple[int, ...] = (3, 2, 4)) -> xarray.Dataset:
    """As a sweep returns it, with every type that there is."""
    size = math.prod(shape)
    number = np.arange(size)
    dims = ("length", "word", "count")[: len(shape)]
    arrays: dict[str, Any] = {
        "value": np.where(number < len(ODD), np.resize(ODD, size), number / 3.0),
        "kind": np.where(number % 3 == 0, 2, 0).astype(np.int8),
        "above": number % 2 == 0,
        "large": number * 2**57 - 2**62,
        "most": np.uint64(2**64 - 1) - number.astype(np.uint64),
        "small": number.astype(np.uint16),
        "single": (number / 7.0).astype(np.float32),
        "half": (number / 8.0).astype(np.float16),
    }
    attributes = {name: {"units": "1", "long_name": f"a {name}"} for name in arrays}
    flags = np.array([0, 2], dtype=np.int8)
    attributes["kind"] |= {"flag_values": flags, "flag_meanings": WORDS}  # type: ignore[dict-item]
    axes: dict[str, Any] = {
        "length": np.linspace(0.1, 0.7, 10_000)[: shape[0]],
        "word": np.array(["é, ü", 'b "c"'] if len(shape) > 1 else []),
        "count": np.arange(4.0),
    }
    return xarray.Dataset(
        {key: (dims, array.reshape(shape), attributes[key]) for key, array in arrays.items()},
        coords={dim: (dim, axes[dim], {"units": "m", "long_name": f"the {dim}"}) for dim in dims},
        attrs={"restitution": 0.8, "cycles": 7, "start": "θ at rest", "inputs": "x" * 200_000},
    )


def table(file: Path) -> list[list[str]]:
    with file.open(encoding="utf-8", newline="") as stream:
        return list(csv.reader(stream))


@pytest.fixture
def small_parts(monkeypatch: pytest.MonkeyPatch) -> None:
    """Files of many parts, and tables of many pieces, from small results."""
    monkeypatch.setattr(_slices, "MOST", 3)
    monkeypatch.setattr(csv_files, "ROWS", 2)


# ----------------------------------------------------------------------------------------- NetCDF


@pytest.mark.parametrize("engine", ["h5netcdf"])
@pytest.mark.parametrize("shape", [(3, 2, 4), (3, 2), (5,)])
@pytest.mark.usefixtures("small_parts")
def test_netcdf_reads_back_to_the_last_bit(
    shape: tuple[int, ...], engine: Any, tmp_path: Path
) -> None:
    data = result(shape)
    write_dataset(data, tmp_path / "x.nc")
    found = xarray.load_dataset(tmp_path / "x.nc", engine=engine)
    assert found.drop_vars("half").identical(data.drop_vars("half"))
    assert list(found.data_vars) == list(data.data_vars)
    for name in data.data_vars:
        if name == "half":  # NetCDF has no such floats
            assert np.array_equal(found[name].values, data[name].values.astype(np.float32))
            continue
        assert found[name].dtype == data[name].dtype
        assert found[name].values.tobytes() == data[name].values.tobytes()
    assert found.kind.attrs["flag_values"].dtype == np.int8
    assert found.attrs["inputs"] == "x" * 200_000
    assert list(tmp_path.iterdir()) == [tmp_path / "x.nc"]


def test_netcdf_is_valid_for_every_reader(tmp_path: Path) -> None:
    write_dataset(result(), tmp_path / "x.nc")
    with h5netcdf.File(tmp_path / "x.nc") as file:
        assert file.variables["above"].dtype == np.int8
        assert file.variables["value"].chunks == (3, 2, 4)
        assert file.variables["value"].dimensions == ("length", "word", "count")
        assert "_FillValue" not in file.variables["large"].attrs


@pytest.mark.usefixtures("small_parts")
def test_coordinates_that_are_no_axes_are_kept(tmp_path: Path) -> None:
    data = result().isel(word=1).assign_coords(twice=("length", [0.0, 2.0, 4.0]))
    write_dataset(data, tmp_path / "x.nc")
    found = xarray.load_dataset(tmp_path / "x.nc").drop_vars("half")
    assert found.identical(data.drop_vars("half"))
    write_dataset(data[["kind"]], tmp_path / "x.csv")
    header, first, *_, last = table(tmp_path / "x.csv")
    assert header == ["length_m", "count_m", "word_m", "twice", "kind"]
    assert first[1:4] == ["0.0", 'b "c"', "0.0"]
    assert last[1:4] == ["3.0", 'b "c"', "4.0"]


def test_a_result_of_variables_over_several_axes_is_a_netcdf_file(tmp_path: Path) -> None:
    data = result().assign(names=("order", ["a", "bb"]), alone=((), 2.5))
    write_dataset(data.drop_vars("half"), tmp_path / "x.nc")
    assert xarray.load_dataset(tmp_path / "x.nc").identical(data.drop_vars("half"))
    with pytest.raises(InputError, match=r"names = .* a table all outputs are over the same axes"):
        write_dataset(data, tmp_path / "x.csv")


@every("value", [None, {"a": 1}, [], [[1.0]], 1j])
def test_attributes_that_netcdf_has_not_are_refused(value: Any, tmp_path: Path) -> None:
    with pytest.raises(InputError, match="extra = "):
        write_dataset(result().assign_attrs(extra=value), tmp_path / "x.nc")
    assert not list(tmp_path.iterdir())


def test_a_boolean_attribute_is_a_number(tmp_path: Path) -> None:
    write_dataset(result().assign_attrs(extra=True), tmp_path / "x.nc")
    assert xarray.load_dataset(tmp_path / "x.nc").attrs["extra"] == 1


# -------------------------------------------------------------------------------------------- CSV


@pytest.mark.parametrize("shape", [(3, 2, 4), (3, 2), (5,)])
@pytest.mark.usefixtures("small_parts")
def test_a_table_has_every_cell_in_order(shape: tuple[int, ...], tmp_path: Path) -> None:
    data = result(shape)
    write_dataset(data, tmp_path / "x.csv")
    header, *rows = table(tmp_path / "x.csv")
    names = [*map(str, data.kind.dims), *data.data_vars]
    assert header == [f"{name}_m" if name in data.dims else name for name in names]
    header = names
    assert len(rows) == math.prod(shape)
    for row, index in zip(rows, np.ndindex(*shape), strict=True):
        found = dict(zip(header, row, strict=True))
        here = {name: data[name].values[index].item() for name in data.data_vars}
        for dim, place in zip(data.kind.dims, index, strict=True):
            assert found[str(dim)] == str(data[dim].values[place].item())
        assert found["kind"] == {0: "at_rest", 2: "over"}[here["kind"]]
        assert found["above"] == str(here["above"])
        for name in ("large", "most", "small"):
            assert int(found[name]) == here[name]
        for name in ("value", "single", "half"):
            assert np.float64(found[name]).tobytes() == np.float64(here[name]).tobytes()


def test_a_class_without_a_word_is_its_number(tmp_path: Path) -> None:
    data = result((5,))[["kind", "small"]]
    data["kind"][1] = -128
    write_dataset(data, tmp_path / "x.csv")
    assert [row[1] for row in table(tmp_path / "x.csv")[1:]] == [
        "over", "-128", "at_rest", "over", "at_rest",
    ]  # fmt: skip
    data.kind.attrs["flag_meanings"] = "too many words"
    write_dataset(data, tmp_path / "x.csv")
    assert table(tmp_path / "x.csv")[1][1] == "2"


def test_an_axis_without_coordinates_is_numbered(tmp_path: Path) -> None:
    write_dataset(result((3, 2)).drop_vars("length")[["small"]], tmp_path / "x.csv")
    assert [row[0] for row in table(tmp_path / "x.csv")[1:]] == ["0", "0", "1", "1", "2", "2"]


@given(st.lists(st.floats(width=64), min_size=1, max_size=20))
def test_every_float_reads_back(values: list[float]) -> None:
    from tempfile import TemporaryDirectory

    data = xarray.Dataset({"value": ("x", values)})
    with TemporaryDirectory() as folder:
        write_dataset(data, Path(folder) / "x.csv")
        read = [float(row[1]) for row in table(Path(folder) / "x.csv")[1:]]
    assert np.array_equal(read, values, equal_nan=True)


# --------------------------------------------------------------------------------- whole, or not


@every("ending", ["xlsx", "zarr", ""])
def test_another_ending_is_refused(ending: str, tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"its extension sets the format: .nc or .csv"):
        write_dataset(result(), tmp_path / f"x.{ending}")


@every("ending", ["nc", "csv"])
@every(
    "dataset",
    [None, 3, xarray.Dataset(), result().isel(length=slice(0)), result().value]
    + [xarray.Dataset({"bad": ("x", np.array([value]))}) for value in (1j, None, b"x")]
    + [xarray.Dataset({"bad": ("x", np.array(["2020-01-01"], dtype="datetime64[ns]"))})],
)
def test_what_no_sweep_returns_is_refused_in_one_line(
    dataset: Any, ending: str, tmp_path: Path
) -> None:
    with pytest.raises(InputError, match=r"dataset = |bad = ") as caught:
        write_dataset(dataset, tmp_path / f"x.{ending}")
    assert "\n" not in str(caught.value)
    assert not list(tmp_path.iterdir())


@every("ending", ["nc", "NC", "csv"])
def test_a_file_that_is_there_is_replaced(ending: str, tmp_path: Path) -> None:
    file = tmp_path / f"x.{ending}"
    file.write_text("old", encoding="utf-8")
    write_dataset(result(), str(file))
    assert file.stat().st_size > 1000
    assert list(tmp_path.iterdir()) == [file]


@pytest.mark.parametrize("ending", ["nc", "csv"])
def test_a_folder_that_is_not_there_is_an_error_of_output(ending: str, tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="its folder does not exist; create the folder"):
        write_dataset(result(), tmp_path / "nowhere" / f"x.{ending}")


LIMITED = """
import resource, sys
import numpy as np, xarray
from rocksteady.errors import OutputError
from rocksteady.export import write_dataset
data = xarray.Dataset({"value": (("a", "b"), np.random.default_rng(0).random((500, 1000)))})
resource.setrlimit(resource.RLIMIT_FSIZE, (1_000_000, 1_000_000))
try:
    write_dataset(data, sys.argv[1])
except OutputError as error:
    print(error)
"""


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="no limits on the size of files")
@pytest.mark.parametrize("ending", ["nc", "csv"])
def test_a_full_disk_is_one_line_and_leaves_nothing(ending: str, tmp_path: Path) -> None:
    code = [sys.executable, "-c", LIMITED, str(tmp_path / f"x.{ending}")]
    done = subprocess.run(code, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert "File too large; check the folder and the space that is left" in done.stdout
    assert done.stdout.count("\n") == 1
    assert not list(tmp_path.iterdir())


MEASURED = """
import resource, sys
from pathlib import Path
import numpy as np
from rocksteady import Execution, open_store
from rocksteady.export import write_dataset
from rocksteady.sweeps import Axis, Grid, Output, evaluate
sys.path.insert(0, sys.argv[2])
from cases_of_a_large_map import many
axes = [Axis(name=n, values=np.arange(1000.0)) for n in ("a", "b")]
outputs = [Output(name=f"o{n}") for n in range(10)]
folder = Path(sys.argv[2])
evaluate(many, Grid(axes=axes), outputs, run=Execution(store=folder / "x.zarr"), batch=100_000)
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
write_dataset(open_store(folder / "x.zarr"), folder / sys.argv[1])
print((resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) // 1024)
"""
"""Of 80 MB, in chunks of 2.5 MB; numbers that compress well, for the sake of speed."""


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="memory is measured in units of its own")
@pytest.mark.parametrize("ending", ["nc", pytest.param("csv", marks=pytest.mark.slow)])
def test_a_result_need_not_fit_into_memory(ending: str, tmp_path: Path) -> None:
    (tmp_path / "cases_of_a_large_map.py").write_text(
        "def many(a, b):\n    return {f'o{n}': a + n for n in range(10)}\n", encoding="utf-8"
    )
    code = [sys.executable, "-c", MEASURED, f"x.{ending}", str(tmp_path)]
    done = subprocess.run(code, capture_output=True, text=True, check=True)
    assert int(done.stdout) < 40


def test_a_count_of_infinitely_many_is_an_empty_cell_of_a_table(tmp_path: Path) -> None:
    counts = ("length", np.array([2, -1, 0]), {"infinitely_many": -1})
    data = xarray.Dataset({"impacts": counts}, coords={"length": [0.1, 0.2, 0.3]})
    write_dataset(data, tmp_path / "x.csv")
    assert [row[1] for row in table(tmp_path / "x.csv")[1:]] == ["2", "", "0"]
