"""Newton's steps against a search for the largest penalised likelihood."""

import numpy as np
import pytest
from scipy import special
from scipy.optimize import minimize

from rocksteady.arrays import Floats
from rocksteady.risk.calibration.sampler.logistic import fit_logistics, probability


def test_probabilities_are_those_of_the_logistic_and_never_sure() -> None:
    odds = np.linspace(-25.0, 25.0, 101)
    assert probability(odds) == pytest.approx(special.expit(odds), rel=1e-13)
    assert (probability(np.array([-1e4, 1e4])) == probability(np.array([-30.0, 30.0]))).all()


def test_coefficients_are_the_likeliest_under_their_prior() -> None:
    """Three regressions of one design: usual, weighted with a prior of its own, and separated."""
    rng = np.random.default_rng(1)
    design = np.column_stack([np.ones(500), rng.normal(size=(500, 2))])
    odds = design @ [0.4, 2.0, -1.0]
    fell = np.stack([rng.random(500) < special.expit(odds), rng.random(500) < 0.3, odds > 0.0])
    weight = np.stack([np.arange(500) < 400, rng.random(500), np.ones(500)])
    fell[0, 400:] = ~fell[0, 400:]  # without a weight they do not count
    precision = np.array([[0.1, 1.0, 1.0], [9.0, 0.5, 2.0], [0.1, 0.3, 0.3]])
    mean, outcomes = np.array([0.5, -1.0, 0.0]), fell.astype(float)
    at, variance = fit_logistics(
        design, outcomes, weight, precision=precision, mean=mean, steps=40, close=1e-4
    )
    for place in range(3):

        def lost(b: Floats, place: int = place) -> float:
            z = design @ b
            likely = (weight[place] * (np.logaddexp(0.0, z) - fell[place] * z)).sum()
            return float(likely + 0.5 * (precision[place] * np.square(b - mean)).sum())

        best = minimize(lost, np.zeros(3), tol=1e-10).x
        assert at[place] == pytest.approx(best, abs=2e-3), place
        p = special.expit(design @ best)
        bend = (design * (weight[place] * p * (1.0 - p))[:, np.newaxis]).T @ design
        exact = np.linalg.inv(bend + np.diag(precision[place])).diagonal()
        assert variance[place] == pytest.approx(exact, rel=0.02), place
    near = fit_logistics(
        design, outcomes, weight, precision=precision, mean=mean, start=at + 0.01, steps=1
    )[0]
    assert near == pytest.approx(at, abs=2e-3)
