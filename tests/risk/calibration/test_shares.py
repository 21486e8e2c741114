"""Probabilities of a fall from few gains, against a threshold whose probability is known."""

import numpy as np
import pytest
from scipy import stats
from scipy.optimize import minimize

from rocksteady.risk.calibration._shares import (
    RIDGE,
    _logistic,
    fit_curves,
    normal_strata,
    pooled_shares,
)


def test_gains_are_one_of_each_stratum_and_normal() -> None:
    z = normal_strata(3000, 2, 5, np.random.default_rng(1))
    assert z.shape == (2, 3000, 5)
    stratum = np.floor(5.0 * stats.norm.cdf(z))
    assert (stratum == np.arange(5)).all()
    assert stats.kstest(z[0].ravel(), "norm").pvalue > 0.01
    # Tests and draws have shifts of their own.
    assert abs(np.corrcoef(z[0, :, 2], z[1, :, 2])[0, 1]) < 0.05


def runs_of(
    wobble: float, sigma: float = 0.2
) -> tuple[tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray], np.ndarray]:
    """Return runs of blocks that fall above a capacity, and their true probabilities of a fall.

    The capacity follows the slenderness and, in a way that no curve of low order has, a property.
    """
    rng = np.random.default_rng(2)
    draws = 900
    features = np.column_stack([rng.uniform(-0.3, 0.3, draws), rng.normal(size=draws)])
    error = np.full((1, draws), sigma)
    gain = error[:, :, None] * normal_strata(draws, 1, 5, rng)
    capacity = features[:, 0] + 0.05 * features[:, 1] + wobble * np.sin(9.0 * features[:, 1])
    fell = gain > capacity[None, :, None]
    return (fell, gain, error, features), stats.norm.cdf(-capacity / sigma)


def test_shares_are_unbiased_and_nearer_than_the_runs_of_a_draw() -> None:
    runs, exact = runs_of(0.0)
    raw, pooled = runs[0][0].mean(axis=1), pooled_shares(*runs)[:, 0]
    assert np.mean(raw - exact) == pytest.approx(0.0, abs=0.01)
    assert np.mean(pooled - exact) == pytest.approx(0.0, abs=0.01)
    assert np.std(pooled - exact) < 0.5 * np.std(raw - exact)


def test_runs_count_where_the_fitted_curve_misses_them() -> None:
    runs, exact = runs_of(0.3)
    raw, pooled = runs[0][0].mean(axis=1), pooled_shares(*runs)[:, 0]
    assert np.std(pooled - exact) < 1.05 * np.std(raw - exact)
    assert np.std(pooled - raw) < 0.5 * np.std(raw - exact)


def test_tests_of_one_fate_stay_as_they_are() -> None:
    gain = np.zeros((1, 20, 3))
    features = np.zeros((20, 2))
    fell = np.zeros((1, 20, 3), dtype=bool)
    assert (pooled_shares(fell, gain, np.zeros((1, 20)), features) == 0.0).all()
    assert (pooled_shares(~fell, gain, np.zeros((1, 20)), features) == 1.0).all()


def test_an_exact_gain_and_one_block_have_a_share() -> None:
    """Nothing differs but the scatter: the curve is a constant."""
    fell = np.random.default_rng(3).random((1, 400, 1)) < 0.3
    found = pooled_shares(fell, np.zeros((1, 400, 1)), np.zeros((1, 400)), np.zeros((400, 3)))
    assert found.mean() == pytest.approx(fell.mean(), abs=0.01)
    assert found.std() < 0.1


def test_logistic_coefficients_are_the_likeliest_with_their_ridge() -> None:
    """Newton's steps against a search, with runs that a plain curve would separate too."""
    rng = np.random.default_rng(6)
    for separated in (False, True):
        x, z = rng.normal(size=400), rng.normal(size=400)
        design = np.vstack([np.ones(400), x, z])
        odds = 0.5 + 2.0 * x - z
        fell = odds > 0.0 if separated else rng.random(400) < 1.0 / (1.0 + np.exp(-odds))
        ridge = RIDGE * np.array([0.1, 1.0, 1.0])

        def lost(at: np.ndarray, design: np.ndarray, fell: np.ndarray, ridge: np.ndarray) -> float:
            z = at @ design
            likely = float((np.logaddexp(0.0, z) - fell * z).sum())
            return likely + 0.5 * float((ridge * at * at).sum())

        best = minimize(lost, np.zeros(3), args=(design, fell, ridge), tol=1e-10).x
        assert _logistic(design, fell) == pytest.approx(best, abs=0.02 * np.abs(best).max())


def test_curves_of_motions_are_moved_by_gain_and_integrated_over_their_error() -> None:
    """A fall above a capacity that follows the slenderness: the normal distribution of both."""
    runs, _ = runs_of(0.0)
    fell, gain, sigma, features = runs
    curves = fit_curves(fell, gain, sigma, features)
    nodes = np.array([-0.4, -0.1, 0.0, 0.2, 0.5])
    shift = np.broadcast_to(nodes, (len(features), len(nodes)))
    capacity = features[:, 0] + 0.05 * features[:, 1]
    for error in (0.2, 0.3):
        result = curves.at(0, shift, np.zeros((1, 1)), np.full(len(features), error))
        exact = stats.norm.cdf((shift - capacity[:, np.newaxis]) / error)
        assert np.abs(result - exact).mean() < 0.03
        assert np.abs((result - exact).mean(axis=0)).max() < 0.02
    alike = fit_curves(np.ones_like(fell), gain, sigma, features)
    assert alike.fits == [None]
    result = alike.at(0, shift, np.zeros((1, 1)), sigma[0])
    assert result.shape == shift.shape
    assert (result == 1.0).all()
