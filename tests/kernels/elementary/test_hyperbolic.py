"""Hyperbolic functions: errors in ulp, special values, symmetry."""

import numpy as np
import pytest

from rocksteady.kernels.elementary import arrays
from tests.kernels.elementary.oracle import (
    any_float,
    bits,
)
from tests.strategies import sample_size


def test_signs_follow_the_argument() -> None:
    count = sample_size(20_000, 3_000)
    x = any_float(np.random.default_rng(10), count)
    x = np.concatenate([x, np.linspace(0.0, 30.0, count)])
    for name in ("sinh", "tanh", "asinh"):
        assert bits(getattr(arrays, name)(-x)) == bits(-getattr(arrays, name)(x))
    assert bits(arrays.cosh(-x)) == bits(arrays.cosh(x))


def test_the_squares_differ_by_one() -> None:
    x = np.linspace(-1.0, 1.0, 2001)
    assert arrays.cosh(x) ** 2 - arrays.sinh(x) ** 2 == pytest.approx(1.0, abs=3e-15)
    assert arrays.sinh(arrays.asinh(x)) == pytest.approx(x, rel=1e-15, abs=0.0)
