"""Probabilities of a fall from few gains, against a threshold whose probability is known."""

import numpy as np
import pytest
from scipy import stats

from rocksteady.risk.calibration._shares import normal_strata, pooled_shares


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
