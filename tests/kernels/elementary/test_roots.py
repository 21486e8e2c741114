"""Roots of equations: known ones, to the last digit, and brackets that are no trouble."""

import math
from collections.abc import Callable

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rocksteady.kernels.elementary.roots import root
from tests.every import every


@every(
    ("equation", "low", "high", "expected"),
    [
        (lambda x: x * x - 2.0, 1.0, 2.0, math.sqrt(2.0)),
        (lambda x: 2.0 - x * x, 0.0, 1e6, math.sqrt(2.0)),
        (lambda x: x * x * x - 27e-9, 0.0, 1.0, 3e-3),
        (lambda x: 1.0 / x - 1e-5, 1.0, 1e9, 1e5),
        (lambda x: math.copysign(1.0, x - 0.3), 0.0, 7.0, 0.3),  # a step: nothing but its sign
    ],
)
def test_it_is_the_known_root(
    equation: Callable[[float], float], low: float, high: float, expected: float
) -> None:
    assert abs(root(equation, low, high) - expected) <= math.ulp(expected)


@given(st.floats(-1e3, 1e3), st.floats(0.0, 1e3), st.floats(0.0, 1e3), st.sampled_from([1, 3, 5]))
def test_the_sign_changes_at_it(middle: float, left: float, right: float, power: int) -> None:
    low, high = middle - left, middle + right
    evaluations = 0

    def equation(x: float) -> float:
        nonlocal evaluations
        evaluations += 1
        return math.prod([x - middle] * power)

    found = root(equation, low, high)
    assert low <= found <= high
    near = 2.0 * math.ulp(found)
    assert equation(found) == 0.0 or equation(found - near) * equation(found + near) < 0.0
    assert evaluations < 2200  # halvings from the largest float to the smallest


def test_an_end_that_is_a_root_is_it() -> None:
    assert root(lambda x: x, 0.0, 1.0) == 0.0
    assert root(lambda x: x - 1.0, 0.0, 1.0) == 1.0


def test_it_takes_far_fewer_steps_than_halving() -> None:
    """Smooth equations: some ten values where halving takes 53."""
    asked: list[float] = []

    def equation(x: float) -> float:
        asked.append(x)
        return math.exp(x) - 5.0

    assert root(equation, 0.0, 4.0) == pytest.approx(math.log(5.0), rel=1e-15)
    assert len(asked) <= 15
