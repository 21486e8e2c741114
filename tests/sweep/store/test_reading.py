"""Reading a store gives what the sweep gave; what is missing or damaged is said in one line."""

import json
import math
import pickle
import shutil
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from rocksteady import Execution, Store, open_store
from rocksteady.errors import InputError, UnfinishedError
from rocksteady.sweep.store import _writer
from rocksteady.sweeps import Axis, Grid, Output, evaluate
from tests.every import every
from tests.sweep.indices import indexers

Found = dict[str, NDArray[Any]]

GRID = Grid(
    axes=(
        Axis(name="length", values=np.linspace(0.0, 3.0, 7), units="m", long_name="a length"),
        Axis(name="number", values=np.arange(5)),
        Axis(name="word", values=np.array(["a", "bb", "é ü"], dtype="U20")),
    )
)
OUTPUTS = (  # in an order that is not that of the alphabet
    Output(name="value", units="m", long_name="a value"),
    Output(name="kind", dtype=np.int8, flags={0: "at rest", 2: "over"}),
    Output(name="above", dtype=np.bool_),
    Output(name="large", dtype=np.int64),
    Output(name="count", dtype=np.uint16),
    Output(name="single", dtype=np.float32),
)
ATTRIBUTES = {"restitution": 0.8, "start": "at rest", "cycles": np.int64(7)}
CELLS = 6
"""Of a chunk: two rows of three words."""


def some(length: Any, number: Any, word: Any) -> Found:
    value = np.sin(length) * number + np.strings.str_len(word)
    return {
        "value": np.where(value > 3.5, np.nan, value),
        "kind": np.where(value > 2.0, 2, 0).astype(np.int8),
        "above": value > 1.5,
        "large": (value * 1e15).astype(np.int64),
        "count": np.round(value * 100).astype(np.uint16),
        "single": value.astype(np.float32),
    }


@pytest.fixture(scope="module")
def reference() -> xarray.Dataset:
    return evaluate(some, GRID, OUTPUTS, attributes=ATTRIBUTES)


@pytest.fixture(scope="module")
def filled(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("filled") / "map.zarr"
    evaluate(
        some, GRID, OUTPUTS, run=Execution(store=Store(path, chunk=CELLS)), attributes=ATTRIBUTES
    )
    return path


@pytest.fixture
def store(filled: Path, tmp_path: Path) -> Path:
    """A copy that a test may damage."""
    return Path(shutil.copytree(filled, tmp_path / "map.zarr"))


def unfinish(store: Path, chunk: int) -> None:
    """Take the flag of a chunk away; its arrays stay."""
    (store / "done" / "c" / str(chunk)).unlink()


def chunk_file(store: Path, output: str, chunk: int) -> Path:
    """Of the fourth axis of chunks: three along numbers, one along words."""
    return store / output / f"c.{chunk // 3}.{chunk % 3}.0"


# ---------------------------------------------------------------------------------- what was found


def test_a_store_gives_what_memory_gives(filled: Path, reference: xarray.Dataset) -> None:
    found = open_store(filled)
    assert found.identical(reference)
    assert list(found.data_vars) == [output.name for output in OUTPUTS]
    assert list(found.coords) == list(GRID.names)
    for name, variable in reference.variables.items():
        assert found[name].dims == variable.dims
        assert found[name].dtype.kind == variable.dtype.kind
        assert found[name].dtype.itemsize == variable.dtype.itemsize or name == "word"
        assert list(found[name].attrs) == list(variable.attrs)
    flags = found.kind.attrs["flag_values"]
    assert isinstance(flags, np.ndarray)
    assert flags.dtype == np.int8
    assert found.word.values.tolist() == ["a", "bb", "é ü"]
    assert found.sel(word="bb", number=2.0).identical(reference.sel(word="bb", number=2.0))


def test_what_the_sweep_returns_is_what_is_read(tmp_path: Path, reference: xarray.Dataset) -> None:
    path = tmp_path / "map.zarr"
    returned = evaluate(some, GRID, OUTPUTS, run=Execution(store=path), attributes=ATTRIBUTES)
    assert returned.identical(reference)
    assert open_store(str(path)).identical(returned)


def test_attributes_are_plain(reference: xarray.Dataset) -> None:
    assert {type(value) for value in reference.attrs.values()} <= {int, float, str}
    assert reference.attrs["cycles"] == 7


@every("value", [None, True, math.nan, math.inf, [1.0], np.array(2.0), 1j])
def test_other_attributes_are_refused(value: Any) -> None:
    with pytest.raises(InputError, match=r"extra = .* a finite number or a text"):
        evaluate(some, GRID, OUTPUTS, attributes={"extra": value})


def test_nothing_is_read_before_it_is_used(store: Path) -> None:
    found = open_store(store)
    chunk_file(store, "value", 0).write_bytes(b"")
    assert found.value.isel(length=slice(1, None)).notnull().any()
    assert found.kind.values.shape == GRID.shape
    with pytest.raises(InputError):
        _ = found.value.values


@pytest.mark.slow
@given(st.tuples(*(indexers(length) for length in GRID.shape)))
def test_any_part_of_it_is_that_part(
    filled: Path, reference: xarray.Dataset, index: tuple[Any, ...]
) -> None:
    where = dict(zip(GRID.names, index, strict=True))
    found = open_store(filled, partial=True)
    assert found.drop_vars("computed").isel(where).identical(reference.isel(where))
    assert found.computed.isel(where).all()


@pytest.mark.slow
@given(st.lists(st.tuples(*(st.integers(-n, n - 1) for n in GRID.shape)), min_size=1, max_size=5))
def test_points_of_it_are_those_points(
    filled: Path, reference: xarray.Dataset, points: list[tuple[int, ...]]
) -> None:
    columns = zip(GRID.names, zip(*points, strict=True), strict=True)
    where = {name: xarray.DataArray(list(column), dims="point") for name, column in columns}
    found = open_store(filled, partial=True)
    assert found.drop_vars("computed").isel(where).identical(reference.isel(where))
    assert found.computed.isel(where).values.tolist() == [True] * len(points)


def test_it_can_be_sent_elsewhere(filled: Path, reference: xarray.Dataset) -> None:
    assert pickle.loads(pickle.dumps(open_store(filled, partial=True).value)).identical(
        reference.value
    )


# ------------------------------------------------------------------------------------ other readers


@pytest.mark.filterwarnings("error")
def test_others_read_it_without_this_package(filled: Path, reference: xarray.Dataset) -> None:
    found = xarray.open_zarr(filled, consolidated=False, chunks=None).drop_vars("done").load()
    for name, variable in reference.variables.items():
        # Texts are objects in xarray before 2026.
        texts = {"T", "O"} if variable.dtype.kind == "U" else set()
        assert found[name].dtype.kind in {variable.dtype.kind, *texts}
        assert found[name].values.astype(variable.dtype).tobytes() == variable.values.tobytes()
    assert found.attrs == reference.attrs


@pytest.mark.filterwarnings("error")
def test_xarray_writes_it_to_other_files(
    filled: Path, reference: xarray.Dataset, tmp_path: Path
) -> None:
    open_store(filled).to_netcdf(tmp_path / "map.nc")
    assert xarray.load_dataset(tmp_path / "map.nc").identical(reference)


# ---------------------------------------------------------------------------------------- refusals


def test_what_is_no_store_is_refused(tmp_path: Path, filled: Path) -> None:
    (tmp_path / "file").write_text("text", encoding="utf-8")
    (tmp_path / "folder").mkdir()
    (tmp_path / "odd").mkdir()
    (tmp_path / "odd" / "zarr.json").write_text("[]", encoding="utf-8")
    for path in (tmp_path / "file", tmp_path / "folder", tmp_path / "odd", filled / "value"):
        with pytest.raises(
            InputError, match="it is no store of a sweep; name the folder"
        ) as caught:
            open_store(path)
        assert "\n" not in str(caught.value)
    with pytest.raises(InputError, match="there is no such folder"):
        open_store(tmp_path / "nowhere")


@pytest.mark.parametrize("text", ["{", "{}", None])
def test_what_cannot_be_read_is_refused_in_one_line(store: Path, text: str | None) -> None:
    metadata = store / "value" / "zarr.json"
    metadata.unlink()
    if text is not None:
        metadata.write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match="it cannot be read: ") as caught:
        open_store(store)
    assert "\n" not in str(caught.value)


def test_an_unfinished_store_says_how_far_it_is(store: Path) -> None:
    for chunk in (4, 20):
        unfinish(store, chunk)
    with pytest.raises(
        UnfinishedError,
        match=r"19 of 21 chunks, 96 of 105 cells, are finished; resume .* partial=True",
    ) as caught:
        open_store(store)
    assert str(store) in str(caught.value)


@pytest.mark.parametrize("output", [output.name for output in OUTPUTS])
def test_a_missing_file_is_not_silent(store: Path, output: str) -> None:
    chunk_file(store, output, 4).unlink()
    with pytest.raises(UnfinishedError, match="files of 1 of 21 finished chunks are missing"):
        open_store(store)
    with pytest.warns(UserWarning, match="files of 1 of 21 finished chunks .* not computed"):
        found = open_store(store, partial=True)
    assert int((~found.computed).sum()) == CELLS


@pytest.mark.parametrize("damage", ["change", "cut", "empty"])
def test_a_damaged_file_is_one_clear_line(store: Path, damage: str) -> None:
    file = chunk_file(store, "value", 4)
    written = bytearray(file.read_bytes())
    written[len(written) // 2] ^= 0xFF
    file.write_bytes({"change": bytes(written), "cut": bytes(written[:9]), "empty": b""}[damage])
    found = open_store(store)
    for values in (found.value, found.value.isel(length=1), found.isel(length=[1], number=[2])):
        with pytest.raises(
            InputError, match=r"map.zarr' .*: value cannot be read: .* resume"
        ) as one:
            values.load()
        assert "\n" not in str(one.value)
    assert found.value.isel(length=2).notnull().any()


def test_a_damaged_store_is_mended_by_its_sweep(store: Path, reference: xarray.Dataset) -> None:
    chunk_file(store, "value", 4).write_bytes(b"")
    chunk_file(store, "count", 5).unlink()
    with pytest.warns(UserWarning, match="2 of 21 finished chunks are missing or damaged"):
        evaluate(
            some,
            GRID,
            OUTPUTS,
            run=Execution(store=Store(store, resume=True)),
            attributes=ATTRIBUTES,
        )
    assert open_store(store).identical(reference)


@every("name", ["done", "chunk", "computed"])
def test_names_that_a_store_needs_itself_are_refused(name: str, tmp_path: Path) -> None:
    grid = Grid(axes=(Axis(name=name, values=[1.0]),))
    for arguments in ((grid, OUTPUTS), (GRID, (Output(name=name),))):
        with pytest.raises(InputError, match="a store has done, chunk, computed of its own"):
            evaluate(some, *arguments, run=Execution(store=tmp_path / "map.zarr"))
    assert not list(tmp_path.iterdir())


# ------------------------------------------------------------------------------------- unfinished


@pytest.fixture
def unfinished(store: Path) -> Iterator[tuple[Path, NDArray[np.bool_]]]:
    """Three chunks without flags: with all arrays, with some and with none.  And what is left."""
    for chunk in (4, 9, 20):
        unfinish(store, chunk)
    for name in ("value", "kind", "large"):
        chunk_file(store, name, 9).unlink()
    for output in OUTPUTS:
        chunk_file(store, output.name, 20).unlink()
    computed = np.ones(GRID.shape, dtype=np.bool_)
    computed[1, 2:4] = computed[3, 0:2] = computed[6, 4] = False
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        yield store, computed


def test_a_part_of_a_store_says_which_cells_it_has(
    unfinished: tuple[Path, NDArray[np.bool_]], reference: xarray.Dataset
) -> None:
    store, computed = unfinished
    found = open_store(store, partial=True)
    assert found.computed.dtype == np.bool_
    assert found.computed.dims == GRID.names
    assert found.computed.attrs == {"long_name": "whether the cell has been computed", "units": "1"}
    assert np.array_equal(found.computed.values, computed)
    for output in OUTPUTS:
        values, whole = found[output.name].values, reference[output.name].values
        expected = np.where(computed, whole, whole.dtype.type(output.nothing))
        assert values.dtype == expected.dtype
        assert np.array_equal(values, expected, equal_nan=output.dtype.kind == "f")
    assert found.kind.values[6, 4].tolist() == [-128] * 3
    assert not found.above.values[6, 4].any()
    assert np.isnan(found.value.values[6, 4]).all()


@pytest.mark.slow
def test_a_sweep_can_be_looked_at_while_it_runs(
    tmp_path: Path, reference: xarray.Dataset, monkeypatch: pytest.MonkeyPatch
) -> None:
    # A slow disk is written to more seldom: here each chunk is written when it is full.
    monkeypatch.setattr(_writer, "LATEST", 0.0)
    path = tmp_path / "map.zarr"
    there: list[int] = []

    def look(_: int) -> None:
        found = open_store(path, partial=True).load()
        there.append(int(found.computed.sum()))
        some_of_it = found.value.where(found.computed)
        assert some_of_it.equals(reference.value.where(found.computed))

    evaluate(
        some,
        GRID,
        OUTPUTS,
        run=Execution(executor="serial", store=Store(path, chunk=CELLS), progress=look),
    )
    assert there[0] == 0
    assert there == sorted(there)
    assert len(set(there)) > 3
    assert there[-1] == GRID.size


def test_a_sweep_that_is_resumed_has_all_in_the_end(
    unfinished: tuple[Path, NDArray[np.bool_]], reference: xarray.Dataset
) -> None:
    store, _ = unfinished
    told: list[int] = []
    run = Execution(store=Store(store, resume=True), progress=told.append)
    evaluate(some, GRID, OUTPUTS, run=run, attributes=ATTRIBUTES)
    assert told[0] == GRID.size - 15
    assert open_store(store).identical(reference)
    whole = open_store(store, partial=True)
    assert whole.computed.all()
    assert whole.drop_vars("computed").identical(reference)


def test_the_inputs_are_written_down(filled: Path) -> None:
    inputs = json.loads(open_store(filled).attrs["inputs"])
    assert inputs["dimensions"] == list(GRID.names)
    assert inputs["outputs"]["kind"] == "int8"
