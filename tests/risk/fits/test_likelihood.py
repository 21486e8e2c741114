"""Likelihoods of probits: exact in both tails, derivatives, and scores that have no root."""

from typing import Any

import mpmath
import numpy as np
import pytest
from scipy import stats

from rocksteady.risk.fits._likelihood import log_likelihood_of, maximise, slopes, solve_score


def test_a_failure_and_a_survival_are_exact_in_both_tails() -> None:
    """The exact logarithm of F and its derivatives, with 250 digits."""

    def log_cdf(x: Any) -> Any:
        return mpmath.log(mpmath.ncdf(x))

    one = np.ones(1)
    with mpmath.workdps(250):
        for eta in (-30.0, -6.0, -1.3, 0.0, 0.4, 2.0, 7.0, 30.0):
            exact = [float(mpmath.diff(log_cdf, mpmath.mpf(eta), order)) for order in range(3)]
            for sign, failures in ((1.0, one), (-1.0, 0.0 * one)):
                at = np.array([sign * eta])
                first, second = slopes(at, failures, one)
                assert log_likelihood_of(at, failures, one) == pytest.approx(exact[0], rel=1e-12)
                assert first[0] == pytest.approx(sign * exact[1], rel=1e-11)
                # In the far lower tail hazard + eta cancels, to the digits of the hazard.
                rounding = 1e-12 * exact[1] * (abs(eta) + 1.0)
                assert second[0] == pytest.approx(-exact[2], rel=1e-9, abs=rounding)


def test_several_trials_have_the_binomial_likelihood_and_the_sum_of_single_slopes() -> None:
    eta = np.array([-2.0, -0.3, 0.0, 0.8, 2.5])
    failures, trials = np.array([0.0, 1.0, 3.0, 4.0, 5.0]), np.array([2.0, 6.0, 4.0, 9.0, 5.0])
    ways = stats.binom.logpmf(failures, trials, 0.5) + trials * np.log(2.0)
    binomial = stats.binom.logpmf(failures, trials, stats.norm.cdf(eta))
    found = log_likelihood_of(eta, failures, trials)
    assert found == pytest.approx((binomial - ways).sum(), rel=1e-10)
    fell, stood = (slopes(eta, np.full(5, outcome), np.ones(5)) for outcome in (1.0, 0.0))
    for whole, up, down in zip(slopes(eta, failures, trials), fell, stood, strict=True):
        assert whole == pytest.approx(failures * up + (trials - failures) * down)
    assert (slopes(eta, failures, trials)[1] > 0.0).all()  # it is concave


def test_a_score_without_a_root_has_none() -> None:
    """Separated outcomes are the likelier the steeper the curve; overlapping ones have a root."""
    z = np.array([-1.0, -0.3, 0.3, 1.0])
    design, ones, start = np.column_stack([np.ones(4), z]), np.ones(4), np.array([0.0, 1.0])
    apart, over = np.array([0.0, 0.0, 1.0, 1.0]), np.array([0.0, 1.0, 0.0, 1.0])
    found = solve_score(design, over, ones, start)
    assert found is not None
    assert slopes(design @ found, over, ones)[0] @ design == pytest.approx(np.zeros(2), abs=1e-12)
    assert found == pytest.approx(maximise(design, over, ones, np.array([2.0, 0.1])))
    # By symmetry half fail in the middle.
    assert found[0] == pytest.approx(0.0, abs=1e-12)
    steep = solve_score(design, apart, ones, start)
    assert steep is None or steep[1] > 10.0
