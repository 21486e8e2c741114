"""Axes: numbers or names, what they stand for, and what is refused."""

import math
from typing import Any

import numpy as np
import pytest

from rocksteady.errors import InputError
from rocksteady.sweep.cases.axes import Axis
from tests.every import every


@every(
    ("name", "values", "valid"),
    [
        ("a", [], "one or more real numbers"),
        ("a", [[1.0, 2.0]], "one or more real numbers"),
        ("a", [b"1"], "one or more real numbers"),
        ("a", ["x", "y", "x"], "each value once"),
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


@every("count", [1, 2**24 + 1, 3**24, 2.5])
def test_a_rule_makes_two_values_at_least_and_no_more_than_fit(count: Any) -> None:
    with pytest.raises(InputError, match=r"count = .*2 to 16777216|count = .*\[2, 16777216\]"):
        Axis.logarithmic("a", 1.0, 2.0, count)


@every("description", [{"long_name": 3}, {"units": b"m"}])
def test_a_description_is_a_text(description: Any) -> None:
    with pytest.raises(InputError, match="must be a text"):
        Axis(name="a", values=[1.0], **description)


@every("indices", [2, -3, [0, 5], 0.5])
def test_an_axis_refuses_places_that_it_has_not(indices: Any) -> None:
    with pytest.raises(InputError, match="whole numbers from -2 to 1"):
        Axis(name="a", values=[1.0, 2.0]).at(indices)


def test_the_values_of_an_axis_are_its_own() -> None:
    given = np.array([1.0, 2.0])
    axis = Axis(name="a", values=given)
    given[0] = 7.0
    assert axis.points.tolist() == [1.0, 2.0]
    with pytest.raises(ValueError, match="read-only"):
        axis.points[0] = 7.0


def test_an_axis_of_names_gives_names() -> None:
    axis = Axis(name="record", values=["b", "a"])
    assert axis.at([1, 0, 1]).tolist() == ["a", "b", "a"]


def test_an_axis_of_things_gives_the_things() -> None:
    things = (object(), (2,))
    axis = Axis(name="record", values=["one", "other"], items=things)
    found = axis.at([[1, 0], [0, 0]])
    assert found.shape == (2, 2)
    assert found[0, 0] is things[1]
    assert found[1, 1] is things[0]


@every(
    ("values", "items"), [(["a", "b"], (1,)), ([1.0, 2.0], (1, 2)), (["a"], (1, 2)), (["a"], ())]
)
def test_each_name_has_one_thing(values: Any, items: Any) -> None:
    with pytest.raises(InputError, match="one thing for each"):
        Axis(name="record", values=values, items=items)
