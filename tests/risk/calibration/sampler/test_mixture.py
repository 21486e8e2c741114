"""Proposals against SciPy's multivariate t, and weights against laws whose tail is known."""

from typing import Any

import numpy as np
import pytest
from scipy import stats

from rocksteady.risk.calibration.sampler.exact import effective, softmax
from rocksteady.risk.calibration.sampler.mixture import (
    FREEDOM,
    Mixture,
    balance,
    fit_mixture,
    pareto_k,
    temper_of,
)

SCALES = np.array([[[1.0, 0.3], [0.3, 0.5]], [[0.2, -0.1], [-0.1, 0.4]]])
SHARES, CENTRES = np.array([0.3, 0.7]), np.array([[0.0, -1.0], [1.5, 0.5]])
MIXED = Mixture(2, SHARES, CENTRES, np.linalg.cholesky(SCALES).transpose(1, 2, 0))


def densities(scores: np.ndarray) -> Any:
    """Return the density of MIXED, and of the prior, by SciPy."""
    parts = [
        share * stats.multivariate_t(centre, scale, int(FREEDOM)).pdf(scores)
        for share, centre, scale in zip(SHARES, CENTRES, SCALES, strict=True)
    ]
    return np.array([np.sum(parts, axis=0), stats.norm.pdf(scores).prod(axis=1)])


def test_densities_and_balance_are_those_of_scipy() -> None:
    scores = np.random.default_rng(1).normal(0.0, 1.5, size=(60, 2))
    mixed, prior = densities(scores)
    assert MIXED.log_density(scores) == pytest.approx(np.log(mixed / prior), abs=1e-8)
    assert (Mixture(2).log_density(scores) == 0.0).all()
    counts = [500, 100, 200]
    all_draws = (500 * prior + 100 * mixed + 200 * mixed) / 800
    found = balance(scores, [Mixture(2), MIXED, MIXED], counts)
    assert found == pytest.approx(np.log(prior / all_draws), abs=1e-8)
    assert (found < np.log(800 / 500)).all()


def test_draws_are_of_their_density() -> None:
    """Weighted by prior over mixture they have the moments of the prior; unweighted their own."""
    scores = MIXED.sample(4096, (1, 2))
    assert scores.shape == (4096, 2)
    assert (scores == MIXED.sample(4096, (1, 2))).all()
    assert (scores != MIXED.sample(4096, (1, 3))).any()
    mixed, prior = densities(scores)
    weights = prior / mixed
    assert weights.mean() == pytest.approx(1.0, abs=0.02)
    assert weights @ scores / 4096 == pytest.approx([0.0, 0.0], abs=0.04)
    assert weights @ np.square(scores) / 4096 == pytest.approx([1.0, 1.0], abs=0.1)
    assert scores.mean(axis=0) == pytest.approx([1.05, 0.05], abs=0.03)
    plain = Mixture(3).sample(300, (4,))
    assert plain.shape == (300, 3)
    assert all(stats.kstest(column, "norm").pvalue > 0.5 for column in plain.T)


def test_a_mixture_finds_the_parts_of_weighted_scores() -> None:
    rng = np.random.default_rng(5)
    scores = rng.normal(0.0, 2.0, size=(6000, 2))
    parts = (stats.multivariate_normal([-1.5, 0.0], 0.09), stats.multivariate_normal([1.5, 1], 0.3))
    target = 0.25 * parts[0].pdf(scores) + 0.75 * parts[1].pdf(scores)
    weights = target / stats.multivariate_normal([0, 0], 4.0).pdf(scores)
    found: Any
    wide: Any
    found, wide = (
        fit_mixture(scores, weights / weights.sum(), 2, (3,), widen=widen) for widen in (1.0, 1.5)
    )
    order = np.argsort(found.centres[:, 0])
    assert found.shares[order] == pytest.approx([0.25, 0.75], abs=0.03)
    assert found.centres[order] == pytest.approx(np.array([[-1.5, 0.0], [1.5, 1.0]]), abs=0.08)
    variances = np.square(found.roots).sum(axis=1)[:, order]
    assert variances[0] == pytest.approx([0.09, 0.3], rel=0.2)
    assert wide.roots == pytest.approx(1.5 * found.roots, rel=1e-12)


def test_the_temper_is_the_largest_that_leaves_enough_draws() -> None:
    rng = np.random.default_rng(6)
    base, joint = rng.normal(0.0, 0.3, 500), -200.0 * np.square(rng.normal(size=500))
    found = temper_of(base, joint, 100.0)
    assert 0.0 < found < 1.0
    assert effective(softmax(base + found * joint)) == pytest.approx(100.0, rel=1e-3)
    assert temper_of(base, joint / 1e4, 100.0) == 1.0


def test_the_tail_of_pareto_draws_has_their_shape() -> None:
    for k, near in ((0.3, 0.15), (0.7, 0.15), (1.5, 0.3)):
        draws = [stats.genpareto(k).rvs(4000, random_state=seed) for seed in range(12)]
        assert np.mean([pareto_k(each) for each in draws]) == pytest.approx(k, abs=near)
        assert pareto_k(1e-6 * draws[0]) == pytest.approx(pareto_k(draws[0]), rel=1e-6)
    assert np.isnan(pareto_k(np.full(500, 0.002)))
    weights = np.random.default_rng(7).random(25)
    assert np.isnan(pareto_k(weights[:24]))
    assert np.isfinite(pareto_k(weights))
