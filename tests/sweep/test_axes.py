"""Axes, grids and outputs: what they refuse, and in which order cells come."""

import math
from typing import Any

import numpy as np
import pytest

from rocksteady.errors import InputError
from rocksteady.sweep.axes import Axis, Grid, Output

ONE = Axis(name="one", values=[1.0, 2.0])
OTHER = Axis(name="other", values=[5, 6, 7])


@pytest.mark.parametrize(
    ("name", "values", "valid"),
    [
        ("a", [], "one or more real numbers"),
        ("a", [[1.0, 2.0]], "one or more real numbers"),
        ("a", ["1"], "one or more real numbers"),
        ("a", [True], "one or more real numbers"),
        ("a", 1.0, "one or more real numbers"),
        ("a", [1.0, math.nan], "are finite"),
        ("a", [1.0, math.inf], "are finite"),
        ("a", [1.0, 2.0, 1.0], "each value once"),
        ("not a name", [1.0], "name of an argument"),
        (3, [1.0], "name of an argument"),
    ],
)
def test_an_axis_is_refused_in_one_line(name: Any, values: Any, valid: str) -> None:
    with pytest.raises(InputError, match=valid):
        Axis(name=name, values=values)


def test_the_values_of_an_axis_are_its_own() -> None:
    given = np.array([1.0, 2.0])
    axis = Axis(name="a", values=given)
    given[0] = 7.0
    assert axis.points.tolist() == [1.0, 2.0]
    with pytest.raises(ValueError, match="read-only"):
        axis.points[0] = 7.0


def test_cells_come_in_c_order_whatever_the_range() -> None:
    grid = Grid(axes=[ONE, OTHER])
    assert (grid.names, grid.shape, grid.size) == (("one", "other"), (2, 3), 6)
    expected = [(a, b) for a in (1.0, 2.0) for b in (5.0, 6.0, 7.0)]
    for first in range(6):
        for stop in range(first, 7):
            cells = grid.cells(first, stop)
            pairs = list(zip(cells["one"].tolist(), cells["other"].tolist(), strict=True))
            assert pairs == expected[first:stop]


@pytest.mark.parametrize("axes", [(), [ONE, "other"], None, ONE])
def test_a_grid_needs_axes(axes: Any) -> None:
    with pytest.raises(InputError, match="one axis or more"):
        Grid(axes=axes)


def test_two_axes_of_one_name_are_refused() -> None:
    with pytest.raises(InputError, match="axes = 'one'"):
        Grid(axes=(ONE, OTHER, Axis(name="one", values=[3.0])))


def test_classes_say_what_they_mean() -> None:
    attributes = Output(
        name="kind", dtype=np.int8, long_name="what it is", flags={0: "at rest", 2: "overturned"}
    ).attributes
    assert attributes["flag_values"].dtype == np.int8
    assert attributes["flag_values"].tolist() == [0, 2]
    assert attributes["flag_meanings"] == "at_rest overturned"
    assert (attributes["long_name"], attributes["units"]) == ("what it is", "1")


def test_a_float_has_no_flags() -> None:
    with pytest.raises(InputError, match="only integers have flags"):
        Output(name="kind", flags={0: "rest"})


def test_more_cells_than_memory_holds_are_refused_before_anything_is_allocated() -> None:
    long = np.arange(10_000.0)
    with pytest.raises(InputError, match="10000 x 10000 cells") as raised:
        Grid(axes=(Axis(name="width", values=long), Axis(name="height", values=long)))
    assert "\n" not in str(raised.value)
