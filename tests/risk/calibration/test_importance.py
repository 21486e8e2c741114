"""Densities of rounds against SciPy, and weights against moments that are known."""

import numpy as np
import pytest
from scipy import stats

from rocksteady.risk.calibration._importance import (
    FREEDOM,
    LEAST_TAIL,
    Proposal,
    base_weights,
    refine,
    smoothed,
)
from rocksteady.risk.calibration.held_out.folds import effective, normalised

CENTRE, ROOT = np.array([0.5, -1.0, 0.2]), np.array([[0.6, 0, 0], [0.2, 0.9, 0], [0.0, 0.3, 0.4]])


def test_density_of_a_refined_round_is_that_of_scipy() -> None:
    proposal = Proposal(draws=64, centre=CENTRE, root=ROOT)
    at = np.random.default_rng(1).normal(size=(20, 3))
    own = stats.multivariate_t(CENTRE, ROOT @ ROOT.T, df=int(FREEDOM)).logpdf(at)
    prior = stats.norm.logpdf(at).sum(axis=1)
    apart = proposal.log_density(at) - (own - prior)
    assert apart == pytest.approx(np.zeros(20), abs=1e-9)


def test_draws_of_a_refined_round_come_from_its_density() -> None:
    draws = Proposal(draws=4096, centre=CENTRE, root=ROOT).sample(3, (1, 2))
    assert np.median(draws, axis=0) == pytest.approx(CENTRE, abs=0.03)
    score = (draws[:, 0] - CENTRE[0]) / ROOT[0, 0]
    assert stats.kstest(score, stats.t(FREEDOM).cdf).pvalue > 0.01


def test_weighted_draws_of_all_rounds_have_the_moments_of_the_prior() -> None:
    proposals = [Proposal(draws=1024), Proposal(draws=1024, centre=CENTRE, root=ROOT)]
    scores = np.concatenate([each.sample(3, (3, k)) for k, each in enumerate(proposals)])
    base = base_weights(scores, proposals)
    weights = normalised(base[:, None])[:, 0]
    assert np.exp(base).max() <= 2.0 + 1e-12  # all draws over those of the prior
    assert np.exp(base).mean() == pytest.approx(1.0, abs=0.03)
    assert weights @ scores == pytest.approx(np.zeros(3), abs=0.06)
    assert weights @ scores**2 == pytest.approx(np.ones(3), abs=0.1)


@pytest.mark.parametrize("deviation", [0.05, 0.001])
def test_a_refined_round_makes_draws_effective(deviation: float) -> None:
    """A likelihood of one narrow direction about 1.2."""
    first = Proposal(draws=512)
    scores = first.sample(3, (4, 0))

    def likelihood(at: np.ndarray) -> np.ndarray:
        return -0.5 * ((at[:, 0] - 1.2) / deviation) ** 2

    second = refine(scores, base_weights(scores, [first]), likelihood(scores), 512)
    both = np.concatenate([scores, second.sample(3, (4, 1))])
    base = base_weights(both, [first, second])
    before = effective(normalised(likelihood(scores)[:, None])[:, 0])
    after = normalised((base + likelihood(both))[:, None])[:, 0]
    assert effective(after) > 5.0 * before
    precision = 1.0 + 1.0 / deviation**2
    assert after @ both[:, 0] == pytest.approx(1.2 / deviation**2 / precision, abs=0.01)
    assert (second.sample(3, (4, 1))[:, 1:].std(axis=0) > 1.0).all()  # as wide as the prior


def test_an_object_without_free_numbers_has_draws_of_equal_weight() -> None:
    proposal = Proposal(draws=16)
    scores = proposal.sample(0, (0,))
    assert scores.shape == (16, 0)
    assert base_weights(scores, [proposal]).tolist() == [0.0] * 16


@pytest.mark.parametrize("shape", [0.2, 0.5, 1.0])
def test_shape_of_a_pareto_law_is_found(shape: float) -> None:
    """Weights u^-k of uniform u; the prior of Zhang and Stephens pulls k towards a half."""
    count = 100_000
    weights = np.random.default_rng(1).random(count) ** -shape
    weights /= weights.sum()
    made, found = smoothed(weights)
    assert found == pytest.approx(shape, abs=0.2)
    assert made.sum() == pytest.approx(1.0)
    assert (made is weights) == (shape > 0.7)
    assert effective(made) >= 0.99 * effective(weights)


def test_equal_weights_have_no_tail() -> None:
    equal = np.full(400, 1 / 400)
    made, found = smoothed(equal)
    assert made is equal
    assert np.isnan(found)


@pytest.mark.parametrize("count", [100, 400, 3000])
def test_the_largest_weights_become_quantiles_of_the_law_fitted_to_them(count: int) -> None:
    """Zhang and Stephens' estimate, summed in loops, of a fifth of all or 3 sqrt(n)."""
    weights = np.random.default_rng(3).random(count) ** -0.4
    weights /= weights.sum()
    tail = int(min(0.2 * count, 3.0 * count**0.5))
    ordered = sorted(weights.tolist())
    cut, x = ordered[-tail - 1], [each - ordered[-tail - 1] for each in ordered[-tail:]]
    quarter = x[int(tail / 4 + 0.5) - 1]
    trials = 30 + int(tail**0.5)
    slopes, logs = [], []
    for number in range(1, trials + 1):
        b = 1.0 / x[-1] + (1.0 - (trials / (number - 0.5)) ** 0.5) / (3.0 * quarter)
        k = sum(np.log1p(-b * each) for each in x) / tail
        slopes.append(b)
        logs.append(tail * (np.log(-b / k) - k - 1.0))
    shares = np.exp(np.array(logs) - max(logs))
    b = float(shares @ slopes / shares.sum())
    raw = float(np.mean([np.log1p(-b * each) for each in x]))
    shape = (tail * raw + 10.0 * 0.5) / (tail + 10.0)
    made, result = smoothed(weights)
    assert result == pytest.approx(shape, rel=1e-9)
    law = stats.genpareto(shape, scale=-raw / b)
    quantiles = cut + law.ppf((np.arange(tail) + 0.5) / tail)
    expected = np.sort(weights)
    expected[-tail:] = np.minimum(quantiles, expected[-1])
    assert np.sort(made) == pytest.approx(expected / expected.sum(), rel=1e-9)
    assert (np.argsort(made, kind="stable") == np.argsort(weights, kind="stable")).all()


def test_a_tail_of_few_weights_stays() -> None:
    rng = np.random.default_rng(3)
    for count, known in ((LEAST_TAIL * 5 - 1, False), (LEAST_TAIL * 5, True)):
        weights = rng.random(count) ** -0.3
        made, result = smoothed(weights / weights.sum())
        assert np.isfinite(result) == known
        assert made.sum() == pytest.approx(1.0)
