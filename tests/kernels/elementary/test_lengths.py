"""Lengths and next numbers: errors in ulp, special values, exact lengths."""

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
    any_float,
    bits,
    check,
    same_as_math,
    spread,
    uniform,
)

DRAWS: list[Any] = [
    (uniform(-1.0, 1.0), uniform(-1.0, 1.0)),
    (spread(1e-3, 1e3), spread(1e-3, 1e3)),
    (spread(1e-307, 1e-290), spread(1e-307, 1e-290)),
    (spread(1e290, 1e307), spread(1e290, 1e307)),
]


def test_errors() -> None:
    check("hypot", DRAWS, COUNT)


def test_errors_where_the_length_is_subnormal() -> None:
    check("hypot", [(spread(1e-315, 1e-309), spread(1e-315, 1e-309))], COUNT // 10, bound=1.0)


@pytest.mark.slow
def test_errors_on_many() -> None:
    check("hypot", DRAWS, MANY)


def test_special_values() -> None:
    for x, y in itertools.product(SPECIAL, repeat=2):
        if math.hypot(x, y) < 1e308 or math.isinf(x) or math.isinf(y):
            assert same_as_math("hypot", x, y), (x, y)
    assert arrays.hypot(1e308, 1.7e308) == math.inf


def test_whole_triangles_and_mirrored_ones() -> None:
    for a, b, c in ((3, 4, 5), (5, 12, 13), (8, 15, 17), (20, 21, 29)):
        for power in (-1000.0, 0.0, 1000.0):
            scale = 2.0**power
            assert arrays.hypot(a * scale, b * scale) == c * scale
    rng = np.random.default_rng(11)
    x, y = any_float(rng, 20_000) * 0.5, any_float(rng, 20_000) * 0.5
    assert bits(arrays.hypot(x, y)) == bits(arrays.hypot(-y, x))


@pytest.mark.parametrize("x", SPECIAL)
def test_the_next_number_above(x: float) -> None:
    assert bits(arrays.next_up(x)) == bits(math.nextafter(x, math.inf))


def test_the_next_numbers_above_drawn_ones() -> None:
    x = any_float(np.random.default_rng(12), 20_000)
    assert bits(arrays.next_up(x)) == bits(np.nextafter(x, np.inf))
