"""Stores: what they hold is what memory holds; what is there already is not lost by accident."""

import functools
import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady.errors import InputError, OutputError
from rocksteady.sweep.cases.axes import Axis
from rocksteady.sweep.cases.grid import Grid
from rocksteady.sweep.cases.outputs import Output
from rocksteady.sweep.evaluate import evaluate
from rocksteady.sweep.run import Execution, Progress
from rocksteady.sweep.store.ownership import is_store
from rocksteady.sweep.store.store import Store
from tests.every import every

GRID = Grid(
    axes=(
        Axis(name="word", values=["a", "long"], long_name="a word"),
        Axis(name="b", values=np.linspace(0.1, 3.0, 30), units="rad"),
        Axis(name="c", values=[5, 1, 2]),
    )
)
OUTPUTS = (
    Output(name="product", long_name="a product", units="m"),
    Output(name="kind", dtype=np.int8, flags={-1: "below", 0: "at", 1: "above"}),
    Output(name="truth", dtype=np.bool_),
    Output(name="nothing", long_name="always nan"),
)


def cases(word: Any, b: NDArray[np.float64], c: NDArray[np.float64], *, factor: float = 1.0) -> Any:
    product = factor * np.sin(b) * c * np.char.str_len(word)
    return {
        "product": product,
        "kind": np.sign(product - 1.0).astype(np.int8),
        "truth": product > 1.0,
        "nothing": np.full(len(b), math.nan),
    }


def run(store: Any, factor: float = 1.0, progress: Progress | None = None, **more: Any) -> Any:
    return evaluate(
        functools.partial(cases, factor=factor),
        GRID,
        OUTPUTS,
        run=Execution(store=store, progress=progress),
        batch=7,
        **more,
    )


def test_a_store_holds_what_memory_holds(tmp_path: Path) -> None:
    memory = run(None, attributes={"restitution": 0.8, "start": "rest"})
    stored = run(tmp_path / "a.zarr", attributes={"restitution": 0.8, "start": "rest"})
    assert stored.identical(memory)
    assert stored.kind.attrs["flag_values"].dtype == np.int8
    assert [str(stored[name].dtype) for name in ("product", "kind", "truth")] == [
        "float64",
        "int8",
        "bool",
    ]
    assert bool(np.isnan(stored.nothing).all())


@pytest.mark.slow
@every("chunk", [1, 8, 50, 1000])
def test_chunks_do_not_change_a_value(tmp_path: Path, chunk: int) -> None:
    told: list[int] = []
    stored = run(Store(tmp_path / "a.zarr", chunk=chunk), progress=told.append)
    assert stored.identical(run(None))
    assert told[0] == 0
    assert sum(told) == GRID.size


def test_others_can_read_it(tmp_path: Path) -> None:
    import xarray
    import zarr

    run(Store(tmp_path / "a.zarr", chunk=30))
    group: Any = zarr.open_group(tmp_path / "a.zarr", mode="r", use_consolidated=False)
    assert group["done"][:].all()
    assert group["done"].shape == (6 * 4,)
    assert json.loads(group.attrs["inputs"])["constants"] == {"factor": 1.0}
    data = xarray.open_zarr(tmp_path / "a.zarr")  # without a warning, which would be an error
    assert set(data.variables) == {"word", "b", "c", "product", "kind", "truth", "nothing"}
    assert set(data.dims) == {"word", "b", "c"}
    assert data.attrs == run(None).attrs
    assert data["product"].dims == ("word", "b", "c")
    assert data["product"].attrs["units"] == "m"


def test_a_finished_store_is_read_and_not_computed(tmp_path: Path) -> None:
    first = run(tmp_path / "a.zarr")
    before = {file: file.stat().st_mtime_ns for file in tmp_path.rglob("c*") if file.is_file()}
    told: list[int] = []
    again = run(Store(tmp_path / "a.zarr", resume=True), progress=told.append)
    assert told == [GRID.size]
    assert again.identical(first)
    assert {file: file.stat().st_mtime_ns for file in before} == before


@pytest.mark.slow
def test_a_resumed_store_that_is_not_there_is_begun(tmp_path: Path) -> None:
    assert run(Store(tmp_path / "a.zarr", resume=True)).identical(run(None))


@pytest.mark.slow
def test_what_is_there_is_kept_unless_one_says_otherwise(tmp_path: Path) -> None:
    path = tmp_path / "a.zarr"
    first = run(path).load()
    with pytest.raises(OutputError, match="it exists; resume it, overwrite it"):
        run(path)
    with pytest.raises(OutputError, match=r"another sweep: factor 1.0 there, 2.0 here; give"):
        run(Store(path, resume=True), factor=2.0)
    assert run(Store(path, resume=True)).identical(first)
    other = run(Store(path, overwrite=True), factor=2.0)
    assert other.identical(run(None, factor=2.0))
    assert [file.name for file in tmp_path.iterdir()] == ["a.zarr"]


def test_a_place_where_nothing_can_be_written_is_refused(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    (tmp_path / "folder").mkdir()
    (tmp_path / "folder" / "thesis").touch()
    for store, valid in (
        (tmp_path / "file", "it is a file"),
        (tmp_path / "missing" / "a.zarr", "the folder it would be in does not exist"),
        (Store(tmp_path / "folder", overwrite=True), "no store of a sweep"),
        (Store(tmp_path / "folder", resume=True), "no store of a sweep"),
    ):
        with pytest.raises(OutputError, match=valid) as raised:
            run(store)
        assert "\n" not in str(raised.value)
    assert (tmp_path / "folder" / "thesis").is_file()
    assert not is_store(tmp_path / "folder")


def test_a_store_that_cannot_be_begun_leaves_no_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(*_: object) -> None:
        raise OutputError("store", "a", "it cannot be begun", "name another")

    monkeypatch.setattr(Store, "_writer", refuse)
    with pytest.raises(OutputError, match="it cannot be begun"):
        run(tmp_path / "a.zarr")
    assert not list(tmp_path.iterdir())


def test_what_a_store_is_told_is_checked(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="both continued and replaced"):
        Store(tmp_path, resume=True, overwrite=True)
    for chunk in (0, 2.0, 2**25):
        with pytest.raises(InputError, match="chunk"):
            Store(tmp_path, chunk=chunk)  # type: ignore[arg-type]
    with pytest.raises(InputError, match="a path or a Store"):
        run(3)


def test_the_case_function_of_a_store_can_be_found_again(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="module level"):
        evaluate(lambda **_: None, GRID, OUTPUTS, run=Execution(store=tmp_path / "a.zarr"))  # type: ignore[arg-type]
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
@every("what", ["cut", "gone", "edited"])
@every("file", ["product/zarr.json", "kind/zarr.json", "b/zarr.json", "b/c/0", "done/zarr.json"])
def test_what_describes_a_store_is_mended(tmp_path: Path, file: str, what: str) -> None:
    first = run(Store(tmp_path / "a.zarr", chunk=30)).load()
    before = {path: path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()}
    path = tmp_path / "a.zarr" / file
    if what == "gone":
        path.unlink()
    else:
        text = path.read_bytes()
        path.write_bytes(text[:20] if what == "cut" else text.replace(b"zarr", b"rats") + b" ")
    told: list[int] = []
    again = run(Store(tmp_path / "a.zarr", resume=True), progress=told.append)
    assert again.identical(first)
    assert told[0] == GRID.size
    assert {path: path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()} == before


@pytest.mark.slow
def test_a_store_that_no_more_says_what_it_holds_may_be_replaced(tmp_path: Path) -> None:
    path = tmp_path / "a.zarr"
    run(path)
    (path / "zarr.json").write_text("{")
    with pytest.raises(OutputError, match=r"its zarr\.json is damaged"):
        run(Store(path, resume=True))
    assert run(Store(path, overwrite=True)).identical(run(None))


def test_a_link_leads_to_the_store(tmp_path: Path) -> None:
    (tmp_path / "elsewhere").mkdir()
    link = tmp_path / "a.zarr"
    run(tmp_path / "elsewhere" / "b.zarr")
    link.symlink_to(tmp_path / "elsewhere" / "b.zarr")
    run(Store(link, overwrite=True), factor=2.0)
    assert link.is_symlink()
    assert run(Store(link, resume=True), factor=2.0).identical(run(None, factor=2.0))
