"""Grids: what they refuse, and in which order cells come."""

from typing import Any

import numpy as np
import pytest

from rocksteady.errors import InputError
from rocksteady.sweep.cases.axes import Axis
from rocksteady.sweep.cases.grid import Grid
from tests.every import every

ONE = Axis(name="one", values=[1.0, 2.0])
OTHER = Axis(name="other", values=[5, 6, 7])


def test_cells_come_in_c_order_whatever_the_range() -> None:
    grid = Grid(axes=[ONE, OTHER])
    assert (grid.names, grid.shape, grid.size) == (("one", "other"), (2, 3), 6)
    expected = [(a, b) for a in (1.0, 2.0) for b in (5.0, 6.0, 7.0)]
    for first in range(6):
        for stop in range(first, 7):
            cells = grid.cells(first, stop)
            pairs = list(zip(cells["one"].tolist(), cells["other"].tolist(), strict=True))
            assert pairs == expected[first:stop]
    # Memory is that of the cells of a range, however far it lies.
    far = Grid(axes=[Axis(name=name, values=np.arange(1e5)) for name in ("a", "b")])
    assert far.cells(10**10 - 2, 10**10)["b"].tolist() == [99_998.0, 99_999.0]


@every("axes", [(), [ONE, "other"], None, ONE])
def test_a_grid_needs_axes(axes: Any) -> None:
    with pytest.raises(InputError, match="one axis or more"):
        Grid(axes=axes)


def test_two_axes_of_one_name_are_refused() -> None:
    with pytest.raises(InputError, match="axes = 'one'"):
        Grid(axes=(ONE, OTHER, Axis(name="one", values=[3.0])))


def test_more_cells_than_memory_holds_are_refused_before_anything_is_allocated() -> None:
    long = np.arange(1_000_001.0)
    with pytest.raises(InputError, match="1000001 x 1000001 cells") as raised:
        Grid(axes=(Axis(name="width", values=long), Axis(name="height", values=long)))
    assert "\n" not in str(raised.value)
