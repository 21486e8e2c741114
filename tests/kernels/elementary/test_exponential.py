"""Exponential functions: errors in ulp, special values, symmetry of their parts."""

import math

import numpy as np
import pytest

from rocksteady.kernels.elementary import arrays
from rocksteady.kernels.elementary.exponential import (
    POWERS,
    exp_clamped,
    exp_near,
    expm1_near,
    expm1_short,
)
from tests.every import every
from tests.kernels.elementary.oracle import (
    around,
    bits,
)


def test_the_table_holds_the_powers_of_two() -> None:
    heads, rests = POWERS[::2], POWERS[1::2]
    assert heads[0] == 1.0
    assert heads[32] == math.sqrt(2.0)
    assert np.abs(rests).max() < 2.0**-53
    # A power and its complement multiply to 2, to the first order in what is left of either.
    for j in range(1, 64):
        product = heads[j] * heads[64 - j]
        assert product == pytest.approx(2.0, abs=4.5e-16)


@every("k", [-64000, -6400, -65, -1, 1, 63, 6400, 64000])
def test_exp_rises_where_its_table_steps(k: int) -> None:
    point = (k + 0.5) * math.log(2.0) / 64.0
    x = np.copysign(around(abs(point)), point)
    assert (np.diff(arrays.exp(np.sort(x))) >= 0.0).all()


@every("point", [0.34657, 0.5 * math.log(2.0), 1.5 * math.log(2.0)])
def test_expm1_rises_where_its_forms_meet(point: float) -> None:
    assert (np.diff(arrays.expm1(around(point))) >= 0.0).all()
    assert (np.diff(arrays.expm1(-around(point))) <= 0.0).all()


def test_forms_of_restricted_range_are_the_functions() -> None:
    for t in np.linspace(-700.0, 700.0, 1001).tolist():
        assert exp_near(t) == exp_clamped(t) == arrays.exp(t)
    for t in np.linspace(-0.34, 0.34, 1000).tolist():
        assert expm1_near(t) == arrays.expm1(t)
    for t in np.linspace(0.0, 40.0, 1001).tolist():
        assert expm1_short(t) == pytest.approx(arrays.expm1(t), rel=4.5e-16)


def test_beyond_its_range_the_clamped_form_stays_at_the_ends() -> None:
    assert exp_clamped(1e9) == arrays.exp(700.0)
    assert exp_clamped(-math.inf) == arrays.exp(-700.0)
    assert bits(exp_near(math.nan)) == bits(math.nan)
