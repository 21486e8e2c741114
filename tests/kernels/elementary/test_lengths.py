"""Lengths and next numbers: errors in ulp, special values, exact lengths."""

import math

import numpy as np

from rocksteady.kernels.elementary import arrays
from tests.every import every
from tests.kernels.elementary.oracle import (
    SPECIAL,
    any_float,
    bits,
)


def test_whole_triangles_and_mirrored_ones() -> None:
    for a, b, c in ((3, 4, 5), (5, 12, 13), (8, 15, 17), (20, 21, 29)):
        for power in (-1000.0, 0.0, 1000.0):
            scale = 2.0**power
            assert arrays.hypot(a * scale, b * scale) == c * scale
    rng = np.random.default_rng(11)
    x, y = any_float(rng, 20_000) * 0.5, any_float(rng, 20_000) * 0.5
    assert bits(arrays.hypot(x, y)) == bits(arrays.hypot(-y, x))


@every("x", SPECIAL)
def test_the_next_number_above(x: float) -> None:
    assert bits(arrays.next_up(x)) == bits(math.nextafter(x, math.inf))


def test_the_next_numbers_above_drawn_ones() -> None:
    x = any_float(np.random.default_rng(12), 20_000)
    assert bits(arrays.next_up(x)) == bits(np.nextafter(x, np.inf))
