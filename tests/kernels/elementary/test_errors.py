"""Errors in ulp of every elementary function, and its values at special numbers."""

import itertools
import math
from typing import Any

import numpy as np
import pytest

from rocksteady.kernels.elementary import arrays
from tests.every import every
from tests.kernels.elementary.oracle import (
    ANGLES,
    BOUNDS,
    COUNT,
    MANY,
    SPECIAL,
    Floats,
    any_float,
    check,
    positive,
    same_as_math,
    spread,
    uniform,
)


def near_one(rng: np.random.Generator, count: int) -> Floats:
    """Return numbers of either sign beside 1."""
    away = np.exp(rng.uniform(math.log(1e-16), math.log(0.3), count))
    signed: Floats = np.copysign(1.0 - away, rng.choice([-1.0, 1.0], count))
    return signed


WIDE: list[Any] = [spread(1e-10, 700.0), uniform(-3.0, 3.0), uniform(709.0, 710.47)]
RATIOS: list[Any] = [uniform(-1.0, 1.0), near_one, spread(1e-9, 0.6)]
DRAWS: dict[str, list[Any]] = {
    "exp": [uniform(0.25, 60.0), uniform(-708.0, 709.78), uniform(-1.0, 1.0)],
    "expm1": [uniform(-0.35, 0.35), uniform(0.34, 0.42), uniform(-3.0, 3.0), spread(1e-18, 700.0)],
    "log": [positive(any_float), uniform(0.5, 2.0), uniform(0.999, 1.001)],
    "log1p": [uniform(-0.5, 0.5), uniform(-0.999, 10.0), positive(spread(1e-17, 1e17))],
    "sin": ANGLES,
    "cos": ANGLES,
    "tan": ANGLES,
    "asin": RATIOS,
    "acos": RATIOS,
    "atan": [uniform(-3.0, 3.0), spread(1e-9, 1e3), any_float],
    "atan2": [
        (uniform(-1.0, 1.0), uniform(-1.0, 1.0)),
        (spread(1e-8, 1e8), spread(1e-8, 1e8)),
        (uniform(0.2, 0.6), uniform(0.9, 1.1)),
        (spread(1e-300, 1e-290), spread(1e-300, 1e-290)),
        (spread(1e290, 1e300), spread(1e290, 1e300)),
    ],
    "sinh": WIDE,
    "cosh": WIDE,
    "tanh": [spread(1e-10, 21.0), uniform(-2.0, 2.0)],
    "asinh": [spread(1e-10, 25.0), uniform(-3.0, 3.0), any_float],
    "hypot": [
        (uniform(-1.0, 1.0), uniform(-1.0, 1.0)),
        (spread(1e-3, 1e3), spread(1e-3, 1e3)),
        (spread(1e-307, 1e-290), spread(1e-307, 1e-290)),
        (spread(1e290, 1e307), spread(1e290, 1e307)),
    ],
}
"""Ranges from which the arguments of each function are drawn; a pair for a function of two."""
OF_TWO = {"atan2", "hypot"}


def test_every_function_with_a_stated_error_is_tested() -> None:
    assert set(DRAWS) == set(BOUNDS)


@every("name", DRAWS)
def test_errors(name: str) -> None:
    check(name, DRAWS[name], COUNT)


@pytest.mark.slow
@pytest.mark.parametrize("name", DRAWS)
def test_errors_on_many(name: str) -> None:
    check(name, DRAWS[name], MANY)


@every("name", ["sin", "cos", "tan"])
def test_errors_at_any_angle_at_all(name: str) -> None:
    check(name, [any_float], 4000)


@every(
    ("name", "draw", "bound"),
    [
        ("exp", uniform(-744.0, -708.4), 1.0),
        ("log", positive(spread(1e-320, 2e-308)), None),
        ("hypot", (spread(1e-315, 1e-309), spread(1e-315, 1e-309)), 1.0),
    ],
)
def test_errors_at_subnormal_numbers(name: str, draw: Any, bound: float | None) -> None:
    check(name, [draw], COUNT // 10, bound=bound)


@every("x", SPECIAL)
@every("name", sorted(set(DRAWS) - OF_TWO))
def test_special_values(name: str, x: float) -> None:
    assert same_as_math(name, x)


def test_special_values_of_atan2() -> None:
    for y, x in itertools.product(SPECIAL, repeat=2):
        assert same_as_math("atan2", y, x), (y, x)


def test_special_values_of_hypot() -> None:
    for x, y in itertools.product(SPECIAL, repeat=2):
        if math.hypot(x, y) < 1e308 or math.isinf(x) or math.isinf(y):
            assert same_as_math("hypot", x, y), (x, y)
    assert arrays.hypot(1e308, 1.7e308) == math.inf
