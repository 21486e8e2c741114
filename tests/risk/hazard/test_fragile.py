"""Fragilities as a hazard sees them: lognormal ones, multiples, and what is unknown outside."""

import math

import numpy as np
import pytest
from scipy import stats

from rocksteady.errors import InputError
from rocksteady.risk import fit_curve
from rocksteady.risk.hazard._fragile import Converted, Lognormal
from tests.every import every

AT = np.array([0.01, 0.1, 0.4, 0.9, 5.0])


def test_a_lognormal_is_that_of_scipy() -> None:
    made, exact = Lognormal(0.4, 0.5), stats.lognorm(0.5, scale=0.4)
    assert made.probability(AT) == pytest.approx(exact.cdf(AT), rel=1e-12)
    for p in (0.001, 0.05, 0.5, 0.9):
        assert made.quantile(p) == pytest.approx(exact.ppf(p), rel=1e-12)
    for beta in (0.0, 1e-13):
        step = Lognormal(0.4, beta)
        assert step.probability(AT).tolist() == [0.0, 0.0, 1.0, 1.0, 1.0]
        assert step.probability(math.nextafter(0.4, 0.0)) == 0.0


@every(
    ("median", "beta", "fits"),
    [
        (1e-50, 0.0, True), (1e50, 20.0, True), (0.9e-50, 0.5, False), (1.1e50, 0.5, False),
        (0.4, 20.1, False), (0.4, -0.1, False), (0.0, 0.5, False), (math.nan, 0.5, False),
    ],
)  # fmt: skip
def test_medians_and_betas_have_bounds(median: float, beta: float, fits: bool) -> None:
    if fits:
        assert Lognormal(median, beta).beta == beta
        return
    with pytest.raises(InputError, match=r"give the fragility as \(median, beta\)"):
        Lognormal(median, beta)


def test_a_multiple_moves_intensities_and_leaves_beta() -> None:
    curve = fit_curve([0.2, 0.4, 0.8, 1.6], [2, 9, 27, 39], [40] * 4)
    found = Converted(curve, 4.0)
    assert found.probability(AT) == pytest.approx(curve.probability(4.0 * AT), rel=1e-14)
    assert found.quantile(0.3) == pytest.approx(curve.quantile(0.3) / 4.0)
    assert found.beta == curve.beta
    assert found.sampled == (0.05, 0.4)
    assert Converted(Lognormal(0.4, 0.5), 4.0).sampled is None
    # Steps, quantiles and the ends of the runs divide the integral.
    knots = np.exp(found.knots)
    for intensity in (found.quantile(0.5), found.quantile(1e-9), 0.05, 0.4):
        assert np.abs(knots / intensity - 1.0).min() < 1e-12


def test_the_beta_of_another_family_is_that_from_its_median_to_its_5_per_cent() -> None:
    logistic = fit_curve([0.2, 0.4, 0.8, 1.6], [2, 9, 27, 39], [40] * 4, family="logistic")
    expected = logistic.beta * math.log(19.0) / stats.norm.ppf(0.95)
    assert Converted(logistic, 3.0).beta == pytest.approx(expected, rel=1e-12)


@every(
    ("failures", "inside", "outside"),
    [([0, 0, 0], [0.0, 0.0, 0.0], [0.0, 1.0]), ([9, 9, 9], [1.0, 1.0, 1.0], [1.0, 1.0])],
)
def test_outside_trials_of_one_kind_a_failure_is_taken_to_be_sure(
    failures: list[int], inside: list[float], outside: list[float]
) -> None:
    curve = Converted(fit_curve([0.2, 0.4, 0.8], failures, [9] * 3), 2.0)
    assert curve.probability(np.array([0.1, 0.2, 0.4])).tolist() == inside
    assert curve.probability(np.array([0.01, 0.41])).tolist() == outside
