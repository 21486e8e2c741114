"""Goodness of fit: its size on suites with clusters, and what it detects."""

import numpy as np
import pytest
from scipy import stats

from rocksteady.risk import fit_curve
from tests.risk.fits.suites import MEDIAN, TOTAL_BETA, Suite, make_suite


def p_values(suites: list[Suite]) -> np.ndarray:
    """Return the p-values of fits."""
    found = [
        fit_curve(suite.intensity, suite.failures, suite.trials, groups=suite.record).goodness
        for suite in suites
    ]
    return np.array([p for p in found if p is not None])


@pytest.mark.slow
@pytest.mark.parametrize(("draws", "within"), [(1, 0.0), (5, 0.5)])
def test_p_values_of_the_right_family_are_about_uniform(draws: int, within: float) -> None:
    """Of 56 records; 200 suites, shares held to three standard deviations and .03."""
    p = p_values([make_suite(56, seed=s, draws=draws, within=within) for s in range(200)])
    assert len(p) == 200
    for limit in (0.05, 0.1, 0.25, 0.5, 0.75):
        doubt = 3.0 * np.sqrt(limit * (1.0 - limit) / len(p)) + 0.03
        assert (p <= limit).mean() == pytest.approx(limit, abs=doubt), limit


def test_trials_of_a_record_do_not_count_as_many() -> None:
    """A hundred copies of each trial leave the p-value as it is."""
    suite = make_suite(40, seed=1)
    many = Suite(suite.intensity, 100 * suite.failures, 100 * suite.trials, suite.record)
    once, hundred = p_values([suite, many])
    assert hundred == pytest.approx(once, rel=1e-6)


def test_a_gate_and_two_kinds_of_records_are_detected() -> None:
    gated, mixed = [], []
    for seed in range(30):
        suite = make_suite(56, seed=seed)
        closed = np.where(suite.intensity < 0.6 * MEDIAN, 0, suite.failures)
        gated.append(Suite(suite.intensity, closed, suite.trials, suite.record))
        rng = np.random.default_rng(seed)
        away = np.where(rng.random(56) < 0.25, 1.8, 0.0)
        capacity = MEDIAN * np.exp(TOTAL_BETA * rng.normal(size=56) + away)
        failures = (suite.intensity >= capacity[suite.record]).astype(int)
        mixed.append(Suite(suite.intensity, failures, suite.trials, suite.record))
    assert (p_values(gated) < 0.05).mean() > 0.6
    assert (p_values(mixed) < 0.05).mean() > 0.8


def test_independent_trials_agree_with_the_score_test_of_the_textbook() -> None:
    """Without groups the statistic is near the score test that trusts the binomial variance."""
    at, trials = np.geomspace(0.2, 3.0, 9), np.full(9, 300)
    failures = np.random.default_rng(8).binomial(trials, stats.norm.cdf(np.log(at / 0.7) / 0.5))
    found = fit_curve(at, failures, trials)
    z = np.log(at / found.median) / found.beta
    p = stats.norm.cdf(z)
    wide = np.column_stack([np.ones(9), z, p**2])
    residual = (failures - trials * p) * stats.norm.pdf(z) / (p * (1.0 - p))
    information = (wide * (trials * stats.norm.pdf(z) ** 2 / (p * (1.0 - p)))[:, None]).T @ wide
    score = wide.T @ residual
    statistic = float(score @ np.linalg.solve(information, score))
    assert found.goodness == pytest.approx(stats.chi2.sf(statistic, 1), abs=0.03)


def test_few_records_two_levels_and_no_curve_have_none() -> None:
    small = make_suite(10, seed=2)
    assert p_values([small]).size == 0
    assert fit_curve([1.0, 2.0], [10, 30], [40, 40]).goodness is None
    assert fit_curve([1.0, 2.0, 3.0], [0, 0, 40], [40, 40, 40]).goodness is None
    assert fit_curve([1.0, 2.0, 3.0], [3, 9, 30], [40, 40, 40]).goodness is not None
