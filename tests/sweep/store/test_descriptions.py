"""Descriptions of a store: what zarr reads of them, and a store of other inputs."""

import functools
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import zarr

from rocksteady.errors import OutputError
from rocksteady.sweep.cases.axes import Axis
from rocksteady.sweep.cases.grid import Grid
from rocksteady.sweep.cases.inputs import inputs_of
from rocksteady.sweep.cases.task import Task
from rocksteady.sweep.evaluate import evaluate
from rocksteady.sweep.run import Execution
from rocksteady.sweep.store._descriptions import Described
from rocksteady.sweep.store.chunks import Chunks
from rocksteady.sweep.store.store import Store
from tests.sweep.executors.cases import GRID, OUTPUTS, some
from tests.sweep.store.faults import CHUNK, run, tree


def test_another_sweep_is_refused_and_the_differences_named(begun: Path) -> None:
    before = tree(begun)
    store = Store(begun, resume=True)
    with pytest.raises(OutputError, match=r"factor nothing there, 3\.0 here"):
        evaluate(functools.partial(some, factor=3.0), GRID, OUTPUTS, run=Execution(store=store))
    with pytest.raises(OutputError, match=r"case .*:some there, .*:other here"):
        evaluate(other, GRID, OUTPUTS, run=Execution(store=store))
    with pytest.raises(OutputError, match=r"sign int8 there, nothing here|outputs sign"):
        evaluate(some, GRID, OUTPUTS[:1], run=Execution(store=store))
    finer = Grid(axes=(GRID.axes[0], Axis(name="b", values=np.arange(21.0))))
    with pytest.raises(OutputError, match=r"b points 20 there, 21 here.*b to 19\.0 there, 20\.0"):
        evaluate(some, finer, OUTPUTS, run=Execution(store=store))
    assert tree(begun) == before


def other(a: Any, b: Any) -> Any:
    return some(a, b)


@pytest.mark.parametrize(
    ("what", "said"),
    [("version", "version 0.0 there"), ("source", "source rocksteady 0123456789abcdef there")],
)
def test_what_another_version_has_computed_is_not_continued(
    what: str, said: str, begun: Path
) -> None:
    group = zarr.open_group(begun, mode="r+")
    inputs = json.loads(str(group.attrs["inputs"]))
    if what == "version":
        inputs["version"] = "0.0"
    else:
        inputs["source"]["rocksteady"] = "0123456789abcdef"
    group.attrs["inputs"] = json.dumps(inputs)
    with pytest.raises(OutputError, match=said):
        run(begun, resume=True)


# ------------------------------------------------------------------------------ as zarr reads it

TASK = Task(cases=some, grid=GRID, outputs=OUTPUTS, numbered=None, batch=CHUNK)


def described(box: tuple[int, ...] = (5, 20)) -> Described:
    chunks = Chunks(shape=GRID.shape, box=box)
    return Described(TASK, chunks, inputs_of(TASK), {"restitution": 0.8})


def test_the_files_are_a_group_that_zarr_opens(tmp_path: Path) -> None:
    found = described()
    for path, content in found.files.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_bytes(content)
    group = zarr.open_group(tmp_path, mode="r")
    assert group.attrs["restitution"] == 0.8
    for axis in GRID.axes:
        array: Any = group[axis.name]
        np.testing.assert_array_equal(array[:], axis.points)
        assert array.metadata.dimension_names == (axis.name,)
    for output in OUTPUTS:
        array = group[output.name]
        assert (array.shape, array.chunks, array.dtype) == (GRID.shape, (5, 20), output.dtype)
        assert array.metadata.dimension_names == GRID.names
        nothing = np.full(GRID.shape, output.nothing, output.dtype)
        np.testing.assert_array_equal(array[:], nothing)
    assert json.loads(str(group.attrs["inputs"])) == inputs_of(TASK)


def test_a_chunk_is_encoded_as_zarr_reads_it_the_last_one_of_an_axis_too(tmp_path: Path) -> None:
    found = described(box=(7, 20))  # 30 is no multiple of 7
    for path, content in found.files.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_bytes(content)
    total = np.arange(600.0)
    arrays = {"sum": total, "sign": np.ones(600, dtype=np.int8)}
    chunks = Chunks(shape=GRID.shape, box=(7, 20))
    for chunk in range(len(chunks)):
        first, stop = chunks.cells(chunk)
        part = {name: values[first:stop] for name, values in arrays.items()}
        for name, content in found.encoded(chunk, part).items():
            (tmp_path / found.path(name, chunk)).write_bytes(content)
    group = zarr.open_group(tmp_path, mode="r")
    for name, values in arrays.items():
        array: Any = group[name]
        np.testing.assert_array_equal(array[:].ravel(), values)


def test_a_store_is_marked_with_its_inputs_and_its_chunks() -> None:
    one, same, other_box = described(), described(), described((10, 20))
    assert one.files == same.files
    assert one.marks == same.marks
    assert one.marks.sweep != other_box.marks.sweep
    assert (one.marks.axes, one.marks.outputs) == (("a", "b"), ("sum", "sign"))
    begun = json.loads(one.beginning(other_box.marks))
    assert begun["replaces"]["sweep"] == other_box.marks.sweep
    assert json.loads(one.beginning(None))["replaces"] is None
