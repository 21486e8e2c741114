"""Cells against the dataset that they become: one is read as the other is."""

from itertools import permutations

import numpy as np

from rocksteady.sweep.cases.axes import Axis
from rocksteady.sweep.cases.cells import Cells, cells_of
from rocksteady.sweep.cases.facts import cells_text, grid_facts
from rocksteady.sweep.cases.grid import Grid
from rocksteady.sweep.cases.labelled import as_dataset
from rocksteady.sweep.cases.outputs import Output

SHAPE = (2, 3, 4)
NAMES = ("a", "b", "c")


def drawn() -> Cells:
    axes = tuple(Axis(name=name, values=np.arange(n)) for name, n in zip(NAMES, SHAPE, strict=True))
    outputs = (Output(name="x", units="m"), Output(name="whole", dtype=np.int64))
    values = np.random.default_rng(4).uniform(0.0, 9.0, 24)
    arrays = {"x": values, "whole": values.astype(np.int64)}
    return cells_of(Grid(axes=axes), outputs, arrays, {"model": "linear"})


def test_cells_are_read_as_their_dataset() -> None:
    cells = drawn()
    dataset = as_dataset(cells)
    assert dataset.attrs == cells.attrs
    assert dict(dataset.sizes) == cells.sizes
    assert cells_text(cells) == cells_text(dataset)
    assert grid_facts(cells) == grid_facts(dataset)
    assert ("x" in cells, "a" in cells, "y" in cells) == (True, True, False)
    for name in ("x", "whole", *NAMES):
        own, theirs = cells[name], dataset[name]
        assert (own.dims, own.size, dict(own.attrs)) == (theirs.dims, theirs.size, theirs.attrs)
        for rows in (0, slice(1, 2)):
            assert own[rows].dims == theirs[rows].dims
            np.testing.assert_array_equal(own[rows].values, theirs[rows].values)


def test_axes_are_turned_and_left_out_as_those_of_the_dataset() -> None:
    cells = drawn()
    dataset = as_dataset(cells)
    for names in permutations(NAMES):
        for axes in (names, (*names[:1], ...), (..., names[0])):
            own, theirs = cells["x"].transpose(*axes), dataset["x"].transpose(*axes)
            assert own.dims == theirs.dims
            np.testing.assert_array_equal(own.values, theirs.values)
        one = cells.without(names[:2])
        first = dataset.isel(dict.fromkeys(names[:2], 0))
        assert as_dataset(one).identical(first)
