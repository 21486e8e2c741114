"""Rounds that find a posterior far from the middle of its prior."""

import numpy as np
import pytest

from rocksteady.calibration import ObjectPrior, OutcomeErrors
from rocksteady.risk.calibration.sampler.bench import GAINS, Bench
from rocksteady.risk.calibration.sampler.rounds import FIRST, find_posterior
from rocksteady.risk.calibration.sampler.space import Space
from tests.risk.calibration.cases import LINEAR, SERIAL, STONE, TRUTH, narrow, narrow_tests


def test_a_narrow_base_is_found_in_a_prior_up_to_the_whole_outline() -> None:
    calibration = narrow()
    posterior, (fit,) = calibration.posteriors["stone"], calibration.fits
    assert posterior.effective_draws >= 200.0
    assert posterior.pareto_k < 0.7
    low, high = posterior.interval("base")[1:]
    assert 0.03 < low < TRUTH["base"] < high < 0.3
    truth = ObjectPrior(name="stone", width_m=0.7, height_m=0.8, **TRUTH).block([])
    assert posterior.interval("alpha_rad")[1] < truth.alpha < posterior.interval("alpha_rad")[2]
    assert calibration.conflicts == ()
    assert [each.temper for each in fit.rounds[-3:]] == [1.0] * 3
    assert fit.rounds[-1].apart < 2.0
    assert calibration.runs["stone"] == GAINS * sum(each.draws for each in fit.rounds) <= 6000


def test_draws_of_all_rounds_are_balanced_against_the_prior() -> None:
    """Without the likelihood the draws are those of the prior: standard normal scores."""
    (fit,) = narrow().fits
    weights = np.exp(fit.base)
    assert weights.max() < len(weights) / FIRST
    assert weights.mean() == pytest.approx(1.0, abs=0.1)
    mean = weights @ fit.scores / weights.sum()
    assert np.abs(mean).max() < 0.2
    expected = np.exp(fit.base + fit.joint - (fit.base + fit.joint).max())
    assert fit.weights == pytest.approx(expected / expected.sum(), abs=1e-10)


def test_runs_end_at_their_bound() -> None:
    tests = narrow_tests().subset(range(12)).tests
    for most, draws in ((140, [70]), (1160, [512, 68])):
        bench = Bench(Space(block=STONE), tests, LINEAR, SERIAL)
        fit = find_posterior(bench, OutcomeErrors(), seed=(1,), most_runs=most)
        assert [each.draws for each in fit.rounds] == draws
        assert bench.runs == GAINS * sum(draws)
