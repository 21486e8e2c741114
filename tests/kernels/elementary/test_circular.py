"""Sine, cosine and tangent: errors in ulp, special values, symmetry, far angles."""

import math

import numpy as np
import pytest

from rocksteady.kernels.elementary import arrays
from rocksteady.kernels.elementary.circular import NEAR, sincos, sincos_near, sincos_short
from tests.every import every
from tests.kernels.elementary.oracle import (
    ANGLES,
    any_float,
    around,
    bits,
)
from tests.strategies import sample_size


def test_the_float_nearest_to_a_multiple_of_a_quarter_turn() -> None:
    """The hardest angle of all: its cosine is 4.7e-19, and the digits were published.

    J.-M. Muller, Elementary Functions, 2nd ed., table 11.1: 6381956970095103 * 2^797.
    """
    angle = 6381956970095103.0 * 2.0**797
    assert arrays.cos(angle) == pytest.approx(-4.68716592425462761112e-19, rel=1.2e-16)
    assert abs(arrays.sin(angle)) == 1.0


def test_signs_follow_the_angle() -> None:
    rng = np.random.default_rng(5)
    count = sample_size(20_000, 3_000)
    x = np.concatenate([draw(rng, count) for draw in (*ANGLES, any_float)])
    assert bits(arrays.sin(-x)) == bits(-arrays.sin(x))
    assert bits(arrays.tan(-x)) == bits(-arrays.tan(x))
    assert bits(arrays.cos(-x)) == bits(arrays.cos(x))


def test_both_at_once_are_each_by_itself() -> None:
    rng = np.random.default_rng(6)
    for x in np.concatenate([draw(rng, 1000) for draw in (*ANGLES, any_float)]).tolist():
        sine, cosine = sincos(x)
        assert bits([sine, cosine]) == bits([arrays.sin(x), arrays.cos(x)])
        if abs(x) <= NEAR:
            assert sincos_near(x) == (sine, cosine)


def test_the_short_form_is_within_its_bound() -> None:
    for x in np.random.default_rng(7).uniform(-1000.0, 1000.0, 20_000).tolist():
        sine, cosine = sincos_short(x)
        assert abs(sine - arrays.sin(x)) <= 2.3e-16
        assert abs(cosine - arrays.cos(x)) <= 2.3e-16


@every("quarters", [0.5, 1.5, 2.5, 100.5, 100_000.5])
def test_sine_and_cosine_are_monotone_where_their_polynomials_meet(quarters: float) -> None:
    x = around(quarters * 0.5 * math.pi)
    sine, cosine = np.diff(arrays.sin(x)), np.diff(arrays.cos(x))
    assert (sine >= 0.0).all() or (sine <= 0.0).all()
    assert (cosine >= 0.0).all() or (cosine <= 0.0).all()


def test_beyond_the_near_angles_nothing_jumps() -> None:
    x = around(NEAR)
    assert np.abs(np.diff(arrays.sin(x))).max() <= 2.0 * np.diff(x).max()
    assert np.abs(np.diff(arrays.cos(x))).max() <= 2.0 * np.diff(x).max()
