"""Exponentials and small turns of the lanes, against numpy's functions."""

import numpy as np
import pytest

from rocksteady.kernels.lanes._exp_sincos import growth_and_decay, turned_by

ROUNDING = 2.0**-53


def test_exponentials_are_exact_to_rounding() -> None:
    times = np.concatenate([np.linspace(0.0, 3.0, 200), 10.0 ** np.linspace(-15.0, 2.7, 200)])
    for time in times:
        grown, decayed = growth_and_decay(time)
        assert grown == pytest.approx(np.expm1(time), rel=ROUNDING * (5.0 + time), abs=0.0)
        assert decayed == pytest.approx(-np.expm1(-time), rel=5.0 * ROUNDING, abs=0.0)


def test_small_turns_are_exact_to_rounding() -> None:
    for angle in np.linspace(-3.0, 3.0, 41):
        for turn in np.linspace(-0.03, 0.03, 11):
            sine, cosine = turned_by(np.sin(angle), np.cos(angle), turn)
            assert abs(sine - np.sin(angle + turn)) < 4.0 * ROUNDING
            assert abs(cosine - np.cos(angle + turn)) < 4.0 * ROUNDING
