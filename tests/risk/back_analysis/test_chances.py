"""Chances of falling: errors and outliers by quadrature, limits of levels, and the likelihood."""

import math

import numpy as np
import pytest
from scipy import stats
from scipy.integrate import quad

from rocksteady.risk.back_analysis._chances import Levels, chances, log_likelihoods
from rocksteady.risk.observations.prior import OutcomeErrors
from rocksteady.risk.observations.spread import PriorRange
from tests.risk.back_analysis.toys import noise


def test_levels_reach_beyond_the_limits_by_what_errors_do() -> None:
    levels = Levels.between(0.1, 2.0, 8, noise(0.2, 0.0))
    assert levels.nodes[[0, -1]] == pytest.approx(np.log([0.1, 2.0]))
    assert len(levels.nodes) == 3 * 7 + 1
    assert levels.simulated[[0, -1]] == pytest.approx(np.log([0.1, 2.0]) + np.array([-0.5, 0.5]))
    assert len(levels.simulated) == 8
    for row in (levels.nodes, levels.simulated):
        assert np.diff(row) == pytest.approx(np.full(len(row) - 1, row[1] - row[0]))
    exact = Levels.between(0.1, 2.0, 8, noise(0.0, 0.0))
    assert exact.nodes[::3] == pytest.approx(exact.simulated)


def test_a_chance_is_the_mean_over_both_errors() -> None:
    """By quadrature of a share that rises in a line from 0 to 1, of known errors."""
    sigma, outlier = 0.3, 0.1
    levels = Levels.between(0.05, 3.0, 200, noise(sigma, outlier))
    low, high = math.log(0.4), math.log(0.9)

    def share(x: float) -> float:
        return min(max((x - low) / (high - low), 0.0), 1.0)

    shares = np.array([[share(x) for x in levels.simulated.tolist()]])
    found = chances(shares, levels, noise(sigma, outlier))[0]
    for place in (0, 200, 280, 330, 400, len(levels.nodes) - 1):
        x = float(levels.nodes[place])
        kinks = [(low - x) / sigma, (high - x) / sigma]
        mean = quad(
            lambda z, x=x: share(x + sigma * z) * stats.norm.pdf(z),
            -8.0, 8.0, points=[z for z in kinks if abs(z) < 8.0],
        )[0]  # fmt: skip
        assert found[place] == pytest.approx(0.9 * mean + 0.05, abs=2e-3)
    # Without errors it is the share itself, and never quite certain.
    plain = chances(shares, Levels.between(0.05, 3.0, 200, noise(0.0, 0.0)), noise(0.0, 0.0))
    assert plain[0, 0] == 1e-12
    assert plain[0, -1] == 1.0 - 1e-12


def test_spreads_of_errors_are_averaged() -> None:
    """A share of 1 from a threshold on: the mean of the normal distribution over sigma."""
    wide = OutcomeErrors(
        sigma_ln=PriorRange.between(0.1, 0.5), outliers=PriorRange.between(0.0, 0.2)
    )
    levels = Levels.between(0.05, 3.0, 400, wide)
    shares = (levels.simulated >= math.log(0.5)).astype(float)[np.newaxis]
    found = chances(shares, levels, wide)[0]
    sigmas = [
        wide.sigma_ln.quantile(np.array([part]))[0] for part in np.linspace(0.001, 0.999, 500)
    ]
    for place in (300, 500, 600, 800):
        x = levels.nodes[place] - math.log(0.5)
        mean = np.mean([stats.norm.cdf(x / sigma) for sigma in sigmas])
        assert found[place] == pytest.approx(0.9 * mean + 0.05, abs=6e-3)


def test_the_likelihood_is_the_product_over_objects() -> None:
    rng = np.random.default_rng(1)
    chance = rng.uniform(0.05, 0.95, (4, 2, 3, 5))
    outcomes = np.array([[1.0, 0.0, 0.0, 1.0], [0.0, 0.0, 0.0, 0.0]])
    found = log_likelihoods(outcomes, chance)
    assert found.shape == (2, 2, 3, 5)
    for survey, row in enumerate(outcomes):
        each = [p if fell else 1.0 - p for p, fell in zip(chance, row, strict=True)]
        assert np.exp(found[survey]) == pytest.approx(np.prod(each, axis=0))
