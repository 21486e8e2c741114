"""Fits in several intensities: statsmodels, the curve of one, separated and dependent columns."""

import math
from typing import Any

import numpy as np
import pytest
import statsmodels.api as sm
from scipy import stats

from rocksteady.errors import InputError
from rocksteady.risk import VectorCurve, fit_curve, fit_vector
from tests.every import every


def made(seed: int, width: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return intensities, failures and trials of a known plane."""
    rng = np.random.default_rng(seed)
    logs = rng.normal(size=(150, width)) @ rng.normal(size=(width, width))
    logs += rng.normal(0.0, 4.0, width)
    slopes = rng.normal(size=width)
    eta = (logs - logs.mean(axis=0)) @ slopes + 0.3
    trials = rng.integers(1, 9, len(logs))
    return np.exp(logs), rng.binomial(trials, stats.norm.cdf(eta)), trials


@every("width", [1, 2, 3])
def test_fits_are_those_of_statsmodels(width: int) -> None:
    for seed in range(8):
        at, failures, trials = made(seed, width)
        found = fit_vector(at, failures, trials)
        binomial = sm.families.Binomial(sm.families.links.Probit())
        counts = np.column_stack([failures, trials - failures])
        oracle = sm.GLM(counts, sm.add_constant(np.log(at)), family=binomial).fit(tol=1e-14)
        assert found.status == "fitted"
        assert found.coefficients == pytest.approx(oracle.params, rel=1e-6, abs=1e-6)
        ways = float(np.sum(np.log(stats.binom.pmf(failures, trials, 0.5)) + trials * np.log(2.0)))
        assert found.log_likelihood == pytest.approx(oracle.llf - ways, rel=1e-8)
        assert found.explained == pytest.approx(1.0 - (oracle.llf - ways) / (oracle.llnull - ways))
        assert found.aic == pytest.approx(oracle.aic + 2.0 * ways)
        assert found.probability(at) == pytest.approx(oracle.fittedvalues, rel=1e-5, abs=1e-12)


def test_one_intensity_is_the_lognormal_curve() -> None:
    at, failures, trials = [0.2, 0.4, 0.8, 1.6], [2, 9, 27, 39], [40] * 4
    curve = fit_curve(at, failures, trials)
    found = fit_vector(np.reshape(at, (4, 1)), failures, trials, names=("PGV",))
    assert 1.0 / found.coefficients[1] == pytest.approx(curve.beta, rel=1e-9)
    median = math.exp(-found.coefficients[0] / found.coefficients[1])
    assert median == pytest.approx(curve.median, rel=1e-9)
    assert found.log_likelihood == pytest.approx(curve.log_likelihood, rel=1e-12)
    assert found.log_likelihood_per_trial == pytest.approx(curve.log_likelihood_per_trial)
    assert found.probability([0.3]) == pytest.approx(float(curve.probability(0.3)), rel=1e-9)
    assert found.probability([[0.0], [math.inf]]).tolist() == pytest.approx([0.0, 1.0])
    assert "PGV" in found.summary()


def test_a_second_intensity_explains_more_and_one_without_a_part_next_to_nothing() -> None:
    rng = np.random.default_rng(4)
    logs = rng.normal(size=(1500, 3))
    failures = (logs[:, 0] + 0.8 * logs[:, 1] + 0.4 * rng.normal(size=1500) > 0.0).astype(int)
    one, two, three = (fit_vector(np.exp(logs[:, :k]), failures) for k in (1, 2, 3))
    assert one.explained < two.explained - 0.2
    assert two.aic < one.aic
    # Twice the gain of a column without a part is chi-squared with one degree of freedom.
    assert 0.0 <= three.log_likelihood - two.log_likelihood < 5.5
    assert two.coefficients[1:] == pytest.approx([1 / 0.4, 0.8 / 0.4], rel=0.15)


def test_products_of_powers_have_the_same_likelihood() -> None:
    """PGA and PGV, or PGV and PGV/PGA, are the same pair."""
    at, failures, trials = made(11, 2)
    other = np.column_stack([at[:, 1], at[:, 1] / at[:, 0]])
    first, second = fit_vector(at, failures, trials), fit_vector(other, failures, trials)
    assert second.log_likelihood == pytest.approx(first.log_likelihood, rel=1e-10)
    assert second.probability(other) == pytest.approx(first.probability(at), rel=1e-6)


@every(
    ("points", "failures", "status"),
    [
        ([[1, 1], [2, 1], [1, 2], [2, 2.5]], [0, 0, 1, 1], "separated"),
        ([[1, 1], [2, 1], [1, 2], [2, 2.5]], [0, 0, 0, 0], "never"),
        ([[1, 1], [2, 1], [1, 2], [2, 2.5]], [1, 1, 1, 1], "always"),
        ([[1, 1], [2, 1], [1, 2], [2, 2.5], [2, 1.5]], [0, 1, 1, 0, 0], "fitted"),
    ],
)
def test_data_without_a_maximum_have_a_status(points: Any, failures: Any, status: str) -> None:
    found = fit_vector(points, failures)
    assert found.status == status
    assert np.isfinite(found.coefficients).all() == (status == "fitted")
    assert (found.log_likelihood == 0.0) == (status != "fitted")
    assert found.summary()


def test_points_on_the_separating_plane_keep_their_likelihood() -> None:
    """At im_2 = 1 a curve in im_1 is left; all else lies on its own side."""
    left, failures = [0.2, 0.4, 0.8, 1.6], [2, 9, 27, 39]
    rows = [*([at, 1.0] for at in left), [0.3, 0.5], [2.0, 0.5], [0.3, 2.0], [2.0, 2.0]]
    found = fit_vector(rows, [*failures, 0, 0, 40, 40], [40] * 8)
    assert found.status == "separated"
    assert found.log_likelihood == pytest.approx(fit_curve(left, failures, [40] * 4).log_likelihood)


def test_columns_that_depend_on_each_other_are_refused() -> None:
    at, _, trials = made(12, 2)
    three = np.column_stack([at, at[:, 1] / at[:, 0]])
    for dependent in (three, np.column_stack([at, np.full(len(at), 3.0)]), at[:2]):
        rows = len(dependent)
        with pytest.raises(InputError, match="depend linearly"):
            fit_vector(dependent, np.arange(rows) % 2, trials[:rows])
    # A row without trials does not distinguish columns.
    untried = np.append(trials[:8], 0)
    with pytest.raises(InputError, match="depend linearly"):
        fit_vector(
            np.column_stack([at[:9, 0], at[:9, 0] ** 2 * (1 + (untried == 0))]),
            untried // 2,
            untried,
        )


def test_what_is_not_valid_is_refused() -> None:
    for at, words in (
        ([1.0, 2.0], "must be"),
        ([[1.0, 2.0], [1.0, 0.0]], r"intensity\[1\]\[1\]"),
        ([[1.0, 2.0], [math.nan, 1.0]], r"intensity\[1\]\[0\]"),
    ):
        with pytest.raises(InputError, match=words):
            fit_vector(at, [0, 1])
    with pytest.raises(InputError, match="names"):
        fit_vector([[1.0], [2.0]], [0, 1], names=("a", "b"))
    with pytest.raises(InputError, match="shape"):
        fit_vector([[1.0], [2.0]], [0, 1]).probability([[1.0, 2.0]])


def rising(sign: float = 1.0) -> VectorCurve:
    """Return the fit to runs whose probability rises, or falls, with both intensities."""
    rng = np.random.default_rng(5)
    logs = rng.normal(size=(150, 2))
    failures = rng.binomial(9, stats.norm.cdf(sign * (logs @ [0.7, 1.4] - 0.2)))
    return fit_vector(np.exp(logs), failures, [9] * len(logs))


def test_where_two_intensities_have_a_ratio_the_fit_is_a_lognormal() -> None:
    found, parts = rising(), np.array([0.3, 1.0, 2.5])
    for ratio in (0.1, 1.0, 3.0):
        median, beta = found.along(ratio)
        second = median * parts
        cut = found.probability(np.stack([second / ratio, second], axis=-1))
        assert cut == pytest.approx(stats.norm.cdf(np.log(parts) / beta), rel=1e-12)


def test_what_falls_has_no_lognormal_and_a_ratio_is_of_two() -> None:
    assert all(map(math.isnan, rising(-1.0).along(1.0)))
    for ratio in (0.0, -1.0, math.nan, math.inf):
        with pytest.raises(InputError, match="ratio"):
            rising().along(ratio)
    single = fit_vector([[0.2], [0.4], [0.8]], [1, 3, 7], [9] * 3)
    with pytest.raises(InputError, match="two intensities"):
        single.along(1.0)
