"""Inverse circular functions: errors in ulp, special values, symmetry."""

import math

import numpy as np
import pytest

from rocksteady.kernels.elementary import arrays
from tests.every import every
from tests.kernels.elementary.oracle import (
    any_float,
    around,
    bits,
)


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


@every(("name", "sense"), [("asin", 1.0), ("acos", -1.0), ("atan", 1.0)])
def test_monotone_where_the_forms_meet(name: str, sense: float) -> None:
    for point in (2.0**-27, math.tan(math.pi / 8.0), 0.5, 1.0 - 1e-12):
        assert (sense * np.diff(getattr(arrays, name)(around(point))) >= 0.0).all()


@every("power", [1000, 600, 501, -399, -401, -600, -1000])
def test_an_angle_is_that_of_the_point_as_many_times_as_far(power: int) -> None:
    y, x = np.random.default_rng(4).uniform(0.5, 2.0, (2, 2000))
    far = arrays.atan2(np.ldexp(y, power), np.ldexp(x, power))
    assert bits(far) == bits(arrays.atan2(y, x))
