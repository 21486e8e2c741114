"""Logarithms: errors in ulp, special values, rise where the parts meet."""

import math

import numpy as np
import pytest

from rocksteady.kernels.elementary import arrays
from rocksteady.kernels.elementary.logarithm import LOG2_DOUBT, low_log2
from tests.every import every
from tests.kernels.elementary.oracle import (
    around,
)


@every("point", [math.sqrt(0.5), 1.0, math.sqrt(2.0), 2.0, 2.0**-1022, 2.0**40])
def test_log_rises_where_its_parts_meet(point: float) -> None:
    assert (np.diff(arrays.log(around(point))) >= 0.0).all()


@every("point", [2.0**-54, math.sqrt(2.0) - 1.0, 1.0, 2.0])
def test_log1p_rises_where_its_parts_meet(point: float) -> None:
    assert (np.diff(arrays.log1p(around(point))) >= 0.0).all()


def test_powers_of_two_have_whole_multiples_of_one_logarithm() -> None:
    for k in range(-1074, 1024):
        assert arrays.log(2.0**k) == pytest.approx(k * math.log(2.0), rel=2.3e-16)


def test_the_rough_logarithm_is_a_lower_bound() -> None:
    x = np.exp(np.random.default_rng(4).uniform(-700.0, 700.0, 1000))
    lack = np.log2(x) - np.array([low_log2(each) for each in x.tolist()])
    assert lack.min() > -1e-12
    assert 0.08 < lack.max() <= LOG2_DOUBT
    assert low_log2(0.0) == -1023.0
    assert low_log2(8.0) == 3.0
