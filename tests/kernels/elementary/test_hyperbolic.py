"""Hyperbolic functions: errors in ulp, special values, symmetry."""

from typing import Any

import numpy as np
import pytest

from rocksteady.kernels.elementary import arrays
from tests.kernels.elementary.oracle import (
    COUNT,
    MANY,
    SPECIAL,
    any_float,
    bits,
    check,
    same_as_math,
    spread,
    uniform,
)

WIDE: list[Any] = [spread(1e-10, 700.0), uniform(-3.0, 3.0), uniform(709.0, 710.47)]
DRAWS: dict[str, list[Any]] = {
    "sinh": WIDE,
    "cosh": WIDE,
    "tanh": [spread(1e-10, 21.0), uniform(-2.0, 2.0)],
    "asinh": [spread(1e-10, 25.0), uniform(-3.0, 3.0), any_float],
}


@pytest.mark.parametrize("name", DRAWS)
def test_errors(name: str) -> None:
    check(name, DRAWS[name], COUNT)


@pytest.mark.slow
@pytest.mark.parametrize("name", DRAWS)
def test_errors_on_many(name: str) -> None:
    check(name, DRAWS[name], MANY)


@pytest.mark.parametrize("x", SPECIAL)
@pytest.mark.parametrize("name", DRAWS)
def test_special_values(name: str, x: float) -> None:
    assert same_as_math(name, x)


def test_signs_follow_the_argument() -> None:
    x = any_float(np.random.default_rng(10), 20_000)
    x = np.concatenate([x, np.linspace(0.0, 30.0, 20_000)])
    for name in ("sinh", "tanh", "asinh"):
        assert bits(getattr(arrays, name)(-x)) == bits(-getattr(arrays, name)(x))
    assert bits(arrays.cosh(-x)) == bits(arrays.cosh(x))


def test_the_squares_differ_by_one() -> None:
    x = np.linspace(-1.0, 1.0, 2001)
    assert arrays.cosh(x) ** 2 - arrays.sinh(x) ** 2 == pytest.approx(1.0, abs=3e-15)
    assert arrays.sinh(arrays.asinh(x)) == pytest.approx(x, rel=1e-15, abs=0.0)
