"""Inverse circular functions: errors in ulp, special values, symmetry."""

import itertools
import math
from typing import Any

import numpy as np
import pytest

from rocksteady.kernels.elementary import arrays
from tests.kernels.elementary.oracle import (
    COUNT,
    MANY,
    SPECIAL,
    Floats,
    any_float,
    around,
    bits,
    check,
    same_as_math,
    spread,
    uniform,
)


def near_one(rng: np.random.Generator, count: int) -> Floats:
    away = np.exp(rng.uniform(math.log(1e-16), math.log(0.3), count))
    signed: Floats = np.copysign(1.0 - away, rng.choice([-1.0, 1.0], count))
    return signed


DRAWS: dict[str, list[Any]] = {
    "asin": [uniform(-1.0, 1.0), near_one, spread(1e-9, 0.6)],
    "acos": [uniform(-1.0, 1.0), near_one, spread(1e-9, 0.6)],
    "atan": [uniform(-3.0, 3.0), spread(1e-9, 1e3), any_float],
    "atan2": [
        (uniform(-1.0, 1.0), uniform(-1.0, 1.0)),
        (spread(1e-8, 1e8), spread(1e-8, 1e8)),
        (uniform(0.2, 0.6), uniform(0.9, 1.1)),
        (spread(1e-300, 1e-290), spread(1e-300, 1e-290)),
        (spread(1e290, 1e300), spread(1e290, 1e300)),
    ],
}


@pytest.mark.parametrize("name", DRAWS)
def test_errors(name: str) -> None:
    check(name, DRAWS[name], COUNT)


@pytest.mark.slow
@pytest.mark.parametrize("name", DRAWS)
def test_errors_on_many(name: str) -> None:
    check(name, DRAWS[name], MANY)


@pytest.mark.parametrize("x", SPECIAL)
@pytest.mark.parametrize("name", ["asin", "acos", "atan"])
def test_special_values(name: str, x: float) -> None:
    assert same_as_math(name, x)


def test_special_values_of_atan2() -> None:
    for y, x in itertools.product(SPECIAL, repeat=2):
        assert same_as_math("atan2", y, x), (y, x)


def test_signs_follow_the_argument() -> None:
    rng = np.random.default_rng(9)
    x, y = any_float(rng, 20_000), any_float(rng, 20_000)
    assert bits(arrays.atan(-x)) == bits(-arrays.atan(x))
    assert bits(arrays.atan2(-y, x)) == bits(-arrays.atan2(y, x))
    part = rng.uniform(-1.0, 1.0, 20_000)
    assert bits(arrays.asin(-part)) == bits(-arrays.asin(part))


def test_exact_angles() -> None:
    assert arrays.atan(1.0) == 0.25 * math.pi
    assert arrays.atan2(1.0, -1.0) == 0.75 * math.pi
    assert arrays.acos(0.0) == arrays.asin(1.0) == 0.5 * math.pi
    assert arrays.acos(0.5) == pytest.approx(math.pi / 3.0, rel=1.2e-16)


@pytest.mark.parametrize(("name", "sense"), [("asin", 1.0), ("acos", -1.0), ("atan", 1.0)])
def test_monotone_where_the_forms_meet(name: str, sense: float) -> None:
    for point in (2.0**-27, math.tan(math.pi / 8.0), 0.5, 1.0 - 1e-12):
        assert (sense * np.diff(getattr(arrays, name)(around(point))) >= 0.0).all()
