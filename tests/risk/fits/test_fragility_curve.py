"""Fragility curves: statsmodels and scipy.stats as oracles, invariances, data without a curve."""

import math
from typing import Any

import numpy as np
import pytest
import statsmodels.api as sm
from scipy import stats

from rocksteady.errors import InputError
from rocksteady.risk import FragilityCurve, fit_curve
from rocksteady.risk.fits._totals import totals_of
from rocksteady.risk.fits.fragility_curve import compare_stripes
from tests.every import every


def made(seed: int, *, grouped: bool = True) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return intensity, failures and trials of a known curve."""
    rng = np.random.default_rng(seed)
    size = int(rng.integers(12, 200))
    median, beta = float(np.exp(rng.normal(0.0, 3.0))), float(rng.uniform(0.2, 2.0))
    at = median * np.exp(rng.normal(0.0, rng.uniform(0.5, 2.0), size))
    trials = rng.integers(1, 30, size) if grouped else np.ones(size, dtype=int)
    share = stats.norm.cdf(np.log(at / median) / beta)
    return at, rng.binomial(trials, share), trials


def overlapping(at: np.ndarray, failures: np.ndarray, trials: np.ndarray) -> bool:
    """Return whether two or more levels lie between the lowest failure and the highest survival."""
    return bool(at[failures > 0].min() < at[failures < trials].max())


@pytest.mark.slow
@every("grouped", [True, False])
def test_fits_are_those_of_statsmodels(grouped: bool) -> None:
    compared = 0
    for seed in range(25):
        at, failures, trials = made(seed, grouped=grouped)
        found = fit_curve(at, failures, trials)
        if found.status != "fitted":
            assert not overlapping(at, failures, trials) or found.status == "not-rising"
            continue
        counts = np.column_stack([failures, trials - failures])
        binomial = sm.families.Binomial(sm.families.links.Probit())
        glm = sm.GLM(counts, sm.add_constant(np.log(at)), family=binomial)
        oracle = glm.fit(tol=1e-14, maxiter=300)
        a, b = oracle.params
        assert found.median == pytest.approx(math.exp(-a / b), rel=1e-6)
        assert found.beta == pytest.approx(1.0 / b, rel=1e-6)
        # statsmodels counts the ways in which failures fall on trials; single trials have one.
        ways = float(np.sum(np.log(stats.binom.pmf(failures, trials, 0.5)) + trials * np.log(2.0)))
        assert found.log_likelihood == pytest.approx(oracle.llf - ways, rel=1e-6)
        compared += 1
    assert compared > 20


def test_no_curve_nearby_has_a_larger_likelihood() -> None:
    at, failures, trials = made(3)
    found = fit_curve(at, failures, trials)

    def log_likelihood(median: float, beta: float) -> float:
        eta = np.log(at / median) / beta
        return float(
            failures @ stats.norm.logcdf(eta) + (trials - failures) @ stats.norm.logsf(eta)
        )

    best = log_likelihood(found.median, found.beta)
    assert found.log_likelihood == pytest.approx(best, rel=1e-12)
    for m, b in ((1.01, 1.0), (0.99, 1.0), (1.0, 1.01), (1.0, 0.99), (1.01, 0.99)):
        assert log_likelihood(found.median * m, found.beta * b) < best
    assert found.probability(found.median) == pytest.approx(0.5)
    assert found.probability(at) == pytest.approx(
        stats.norm.cdf(np.log(at / found.median) / found.beta), rel=1e-12
    )
    assert found.probability([0.0, math.inf]).tolist() == [0.0, 1.0]
    for p in (0.01, 0.5, 0.9):
        assert found.probability(found.quantile(p)) == pytest.approx(p, rel=1e-10)


def numbers(found: FragilityCurve) -> list[float]:
    return [found.beta, found.log_likelihood, found.misfit]


def test_a_unit_multiplies_the_median_alone() -> None:
    at, failures, trials = made(5)
    found = fit_curve(at, failures, trials)
    for factor in (1e-9, 100.0, 1e12):
        other = fit_curve(factor * at, failures, trials)
        assert other.median == pytest.approx(factor * found.median, rel=1e-9)
        assert numbers(other) == pytest.approx(numbers(found), rel=1e-8)


def test_order_and_grouping_do_not_matter() -> None:
    at, failures, trials = made(6)
    found = fit_curve(at, failures, trials)
    order = np.random.default_rng(0).permutation(len(at))
    assert fit_curve(at[order], failures[order], trials[order]).median == found.median
    single = np.repeat(at, trials)
    fails = np.concatenate([np.arange(n) < k for k, n in zip(failures, trials, strict=True)])
    alone = fit_curve(single, fails.astype(int))
    assert [alone.median, *numbers(alone)] == [found.median, *numbers(found)]


def test_twice_the_trials_have_the_same_curve_and_twice_the_likelihood() -> None:
    at, failures, trials = made(7)
    found = fit_curve(at, failures, trials)
    twice = fit_curve(at, 2 * failures, 2 * trials)
    assert twice.median == pytest.approx(found.median, rel=1e-10)
    assert twice.beta == pytest.approx(found.beta, rel=1e-10)
    assert twice.log_likelihood == pytest.approx(2.0 * found.log_likelihood, rel=1e-12)


STEPS: list[tuple[list[float], list[int], str, tuple[float, float] | None]] = [
    ([1.0, 2.0], [0, 1], "separated", (1.0, 2.0)),
    ([3.0, 1.0, 2.0, 4.0], [1, 0, 0, 1], "separated", (2.0, 3.0)),
    ([1.0, 2.0, 2.0, 3.0], [0, 0, 1, 1], "separated", (2.0, 2.0)),
    ([1.0, 1.0, 2.0], [0, 1, 1], "separated", (1.0, 1.0)),
    ([1e-300, 1.0, 1e300], [0, 1, 1], "separated", (1e-300, 1.0)),
    ([1.0, 2.0, 3.0], [0, 0, 0], "never", None),
    ([1.0], [0], "never", None),
    ([1.0, 2.0, 3.0], [1, 1, 1], "always", None),
    ([1.0], [1], "always", None),
    ([1.0, 2.0], [1, 0], "not-rising", None),
    ([1.0, 2.0, 4.0, 8.0], [1, 0, 0, 1], "not-rising", None),
    ([1.0, 1.0], [0, 1], "not-rising", None),
    ([1.0, 2.0, 4.0, 8.0], [0, 1, 0, 1], "fitted", None),
]


@every(("at", "failures", "status", "step"), STEPS)
def test_data_without_a_curve_have_a_status(
    at: list[float], failures: list[int], status: str, step: Any
) -> None:
    found = fit_curve(at, failures)
    assert (found.status, found.step) == (status, step)
    assert found.sampled == (min(at), max(at))
    assert found.summary()
    assert found.to_dict()["status"] == status
    if step is not None:
        low, high = step
        assert math.isnan(found.beta)
        assert "not identified" in found.summary()
        assert found.median == pytest.approx(math.sqrt(low) * math.sqrt(high))
        assert found.probability([0.99 * low, 1.01 * high]).tolist() == [0.0, 1.0]
        assert found.quantile(0.2) == found.median
        assert math.isnan(found.hclpf())
    elif status != "fitted":
        assert math.isnan(found.median)
        assert math.isnan(found.quantile(0.5))


def test_one_sided_data_are_known_on_one_side() -> None:
    never, always = (fit_curve([0.5, 1.0], [fell] * 2, [20] * 2) for fell in (0, 20))
    assert never.probability([0.2, 1.0]).tolist() == [0.0, 0.0]
    assert np.isnan(never.probability(1.01))
    assert always.probability([0.5, 2.0]).tolist() == [1.0, 1.0]
    assert np.isnan(always.probability(0.49))
    assert never.misfit == always.misfit == 0.0
    assert "above the highest intensity, 1" in never.summary()
    assert "below the lowest intensity, 0.5" in always.summary()


def test_small_data_of_any_kind_have_the_status_of_a_search_over_all_steps() -> None:
    rng = np.random.default_rng(1)
    seen = set()
    for _ in range(300):
        size = int(rng.integers(1, 7))
        at = rng.integers(1, 5, size).astype(float)
        failures = rng.integers(0, 2, size)
        found = fit_curve(at, failures)
        seen.add(found.status)
        if failures.all() or not failures.any():
            assert found.status == ("always" if failures.all() else "never")
            continue
        stood, failed = at[failures == 0], at[failures == 1]
        rising = np.log(failed).mean() > np.log(stood).mean() + 1e-9
        apart = stood.max() <= failed.min() and stood.min() < failed.max()
        assert found.status == ("not-rising" if not rising else "separated" if apart else "fitted")
    assert seen == {"always", "never", "separated", "fitted", "not-rising"}


@every(
    ("arguments", "name", "words"),
    [
        (([], []), "intensity", "row of numbers"),
        ((1.0, 0), "intensity", "row of numbers"),
        (([1.0, 0.0], [0, 1]), "intensity[1]", "above 0"),
        (([1.0, math.nan], [0, 1]), "intensity[1]", "above 0"),
        (([math.inf, 1.0], [0, 1]), "intensity[0]", "above 0"),
        (([-1.0, 1.0], [0, 1]), "intensity[0]", "above 0"),
        (([1.0, 2.0], [0, -1]), "failures[1]", "whole number"),
        (([1.0, 2.0], [0.5, 1]), "failures[0]", "whole number"),
        (([1.0, 2.0], [0, math.nan]), "failures[1]", "whole number"),
        (([1.0, 2.0], [0]), "failures", "one for each of the 2"),
        (([1.0, 2.0], [0, 2]), "failures[1]", "trials[1] = 1"),
        (([1.0, 2.0], [0, 3], [4, 2]), "failures[1]", "trials[1] = 2"),
        (([1.0, 2.0], [0, 0], [0, 0]), "trials", "one or more"),
        (([1.0, 2.0], [0, 0], [1, 1, 1]), "trials", "one for each of the 2"),
    ],
)
def test_what_is_not_valid_is_named_with_its_place(arguments: Any, name: str, words: str) -> None:
    with pytest.raises(InputError) as caught:
        fit_curve(*arguments)
    assert caught.value.name == name
    assert words in str(caught.value)


def test_the_hclpf_is_that_of_kennedy_and_ravindra() -> None:
    """Confidence and failure are two lognormals: at most 5 % fail, at 95 % confidence."""
    found, beta_u = fit_curve([0.2, 0.4, 0.8, 1.6], [2, 9, 27, 39], [40] * 4), 0.25
    weak = stats.lognorm(beta_u, scale=found.median).ppf(0.05)
    expected = stats.lognorm(found.beta, scale=weak).ppf(0.05)
    assert found.hclpf(beta_u) == pytest.approx(expected, rel=2e-4)  # 1.645 has four digits
    assert found.probability(found.hclpf()) == pytest.approx(0.05, abs=2e-5)
    with pytest.raises(InputError, match="beta_u = -1"):
        found.hclpf(-1.0)


def test_an_intensity_below_0_has_no_probability() -> None:
    with pytest.raises(InputError, match="intensity"):
        fit_curve([1.0, 2.0], [0, 1]).probability(-1.0)


def test_the_misfit_is_that_of_the_worst_stripe() -> None:
    found = fit_curve([0.2, 0.4, 0.8, 1.6], [2, 9, 27, 39], [40] * 4, measure=("PGV", "m/s"))
    shares = np.array([2, 9, 27, 39]) / 40
    curve = stats.norm.cdf(np.log(np.array([0.2, 0.4, 0.8, 1.6]) / found.median) / found.beta)
    assert found.misfit == pytest.approx(np.abs(shares - curve).max())
    assert found.describe().headline == (
        "lognormal in PGV: median 0.591 m/s, beta 0.582, within "
        f"{100.0 * found.misfit:.2g} points of the shares of 160 trials"
    )


def test_levels_of_ten_trials_on_average_are_stripes_and_of_fewer_are_joined() -> None:
    levels = list(np.geomspace(1.0, 8.0, 4))
    for trials, rows in (([10, 10, 10, 10], 4), ([1, 1, 19, 19], 4), ([10, 10, 10, 9], 3)):
        found, _ = compare_stripes(totals_of(levels, [0, 1, 2, 3], trials), np.full(4, 0.5))
        assert len(found) == rows, trials
        assert sum(row[1] for row in found) == sum(trials)
        assert sum(row[2] for row in found) == 6


@every(("trials", "rows"), [(1, 1), (9, 1), (19, 1), (20, 2), (99, 9), (100, 10), (2000, 10)])
def test_scattered_trials_are_joined_ten_at_least_to_ten_stripes_at_most(
    trials: int, rows: int
) -> None:
    levels = np.geomspace(0.1, 10.0, trials)
    made = totals_of(levels, [0] * trials, [1] * trials)
    found, misfit = compare_stripes(made, np.zeros(trials))
    sizes = [row[1] for row in found]
    assert len(sizes) == rows
    assert max(sizes) - min(sizes) <= 1
    assert misfit == 0.0
    assert [row[0] for row in found] == sorted(row[0] for row in found)


def test_a_joined_stripe_is_at_the_mean_logarithm_with_the_mean_probability() -> None:
    """By hand: 2, 1 and 1 trials at 2, 8 and 32 have a mean of ln of 2.5 ln 2."""
    made = totals_of([2.0, 8.0, 32.0], [0, 1, 1], [2, 1, 1])
    ((at, trials, failures, curve),), misfit = compare_stripes(made, np.array([0.1, 0.5, 0.9]))
    assert at == pytest.approx(2.0**2.5)
    assert (trials, failures) == (4, 2)
    assert curve == pytest.approx(0.4)
    assert misfit == pytest.approx(0.1)
    unknown, misfit = compare_stripes(made, np.full(3, math.nan))
    assert unknown[0][3] is None
    assert math.isnan(misfit)
