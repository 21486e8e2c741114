"""Restricted likelihood of steps that share peaks, beside dense matrices and known estimates."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy import stats

from rocksteady.risk.free_rocking._steps import (
    Steps,
    _deviance,
    _refined,
    _whitened,
    errors_of,
    estimate,
    solved,
)
from tests.every import every


def steps(count: int = 9, kinds: int = 2) -> Steps:
    """Return steps of two releases, of one or two impacts, of two kinds."""
    rng = np.random.default_rng(3)
    design = np.zeros((count, kinds))
    design[np.arange(count), np.arange(count) % kinds] = 1.0
    design[3] += 1.0
    follows = np.arange(count) != 0
    follows[count // 2] = False
    after = rng.uniform(0.01, 0.03, count)
    return Steps(
        change=rng.normal(-0.05, 0.04, count),
        design=design,
        impacts=design.sum(axis=1),
        before=np.where(follows, np.roll(after, 1), 0.02),
        after=after,
        follows=follows,
    )


def dense(made: Steps, scatter: float, error: float) -> np.ndarray:
    """Return the covariance of the steps: neighbours share the error of a peak."""
    count = len(made.change)
    whole = np.diag(scatter**2 * made.impacts + error**2 * (made.before**2 + made.after**2) + 1e-28)
    for place in range(1, count):
        if made.follows[place]:
            shared = -((error * made.before[place]) ** 2)
            whole[place, place - 1] = whole[place - 1, place] = shared
    return whole


@every(("scatter", "error"), [(0.03, 1.0), (0.0, 1.0), (0.05, 0.0), (0.01, 2.5)])
def test_generalised_least_squares_and_their_deviance_are_those_of_dense_matrices(
    scatter: float, error: float
) -> None:
    made = steps()
    whole = dense(made, scatter, error)
    inverse = np.linalg.inv(whole)
    information = made.design.T @ inverse @ made.design
    factor = np.linalg.solve(information, made.design.T @ inverse @ made.change)
    found, covariance = solved(made, scatter, error)
    assert found == pytest.approx(factor, rel=1e-9)
    assert covariance == pytest.approx(np.linalg.inv(information), rel=1e-9)
    left = made.change - made.design @ factor
    expected = (
        np.linalg.slogdet(whole)[1] + np.linalg.slogdet(information)[1] + left @ inverse @ left
    )
    assert _deviance(made, scatter, error) == pytest.approx(expected, rel=1e-9)
    root, shares, change, _ = _whitened(made, scatter, error)
    lower = np.diag(root) + np.diag(shares[1:], -1)
    assert lower @ lower.T == pytest.approx(whole, abs=1e-15)
    assert lower @ change == pytest.approx(made.change, rel=1e-9)


def test_expected_errors_of_peaks_are_those_of_a_normal_vector_given_the_steps() -> None:
    """Of errors u of all peaks: the change has A u, and E[u] is C A' V^-1 times what is left."""
    made = replace(steps(), before=np.full(9, 0.02), after=np.full(9, 0.02))
    found = estimate(made, error=1.0)
    scatter = found.scatter
    peaks, columns = 0, np.zeros((9, 2), dtype=int)
    for place in range(9):
        if not made.follows[place]:
            peaks += 1
        columns[place] = peaks - 1, peaks
        peaks += 1
    errors = np.zeros((9, peaks))
    errors[np.arange(9), columns[:, 0]] = -1.0
    errors[np.arange(9), columns[:, 1]] = 1.0
    whole = dense(made, scatter, 1.0)
    assert errors @ errors.T * 0.02**2 + np.diag(scatter**2 * made.impacts) == pytest.approx(
        whole, abs=1e-15
    )
    left = made.change - made.design @ found.factor
    expected = 0.02**2 * errors.T @ np.linalg.solve(whole, left)
    before, after = errors_of(made, found)
    assert before == pytest.approx(expected[columns[:, 0]], rel=1e-7, abs=1e-12)
    assert after == pytest.approx(expected[columns[:, 1]], rel=1e-7, abs=1e-12)
    deviations = np.sqrt(np.diag(whole))
    assert found.residuals == pytest.approx(left / deviations, rel=1e-7)


def independent(count: int, mean: float, scatter: float, seed: int = 1) -> Steps:
    change = np.random.default_rng(seed).normal(mean, scatter, count)
    return Steps(
        change=change,
        design=np.ones((count, 1)),
        impacts=np.ones(count),
        before=np.zeros(count),
        after=np.zeros(count),
        follows=np.zeros(count, dtype=bool),
    )


@every("count", [3, 8, 40])
def test_without_measuring_errors_it_is_the_sample_with_student_s_interval(count: int) -> None:
    """One mean: s^2 of n - 1 degrees of freedom, and mixed over scatters Student's distribution."""
    made = independent(count, -0.06, 0.05)
    found = estimate(made, error=1.0)
    mean, spread = made.change.mean(), made.change.std(ddof=1)
    assert found.factor[0] == pytest.approx(mean)
    assert found.scatter == pytest.approx(spread, rel=1e-3)
    # A flat prior of the standard deviation: n - 2 degrees of freedom, and the same sum of squares.
    if count > 3:
        free = count - 2
        width = math.sqrt((count - 1) / free) * spread / math.sqrt(count)
        ends = mean + width * stats.t.ppf([0.05, 0.95], free)
        assert found.interval[0] == pytest.approx(ends, rel=0.03, abs=0.03 * float(np.ptp(ends)))
    # Both ends of the scatter have a likelihood of exp(-1.3528) of the best.
    least = _deviance(made, found.scatter, 1.0)
    for end in found.scatter_interval:
        assert 0.5 * (_deviance(made, end, 1.0) - least) == pytest.approx(1.3528, abs=2e-3)
    assert stats.chi2.sf(2.0 * 1.3528, 1) == pytest.approx(0.1, abs=2e-4)
    assert found.error == 1.0


def test_steps_that_are_all_alike_have_no_scatter() -> None:
    made = replace(independent(6, 0.0, 0.0), change=np.full(6, -0.1))
    found = estimate(made, error=None)
    assert (found.scatter, found.scatter_interval, found.error) == (0.0, (0.0, 0.0), 0.0)
    assert found.factor[0] == pytest.approx(-0.1)
    assert found.interval[0] == pytest.approx([-0.1, -0.1], abs=1e-12)


def test_what_measuring_errors_explain_is_no_scatter() -> None:
    """Errors of peaks alternate in neighbouring steps; scatter does not."""
    rng = np.random.default_rng(11)
    errors = rng.normal(0.0, 0.05, 17)
    count = 16
    made = Steps(
        change=-0.08 + np.diff(errors),
        design=np.ones((count, 1)),
        impacts=np.ones(count),
        before=np.ones(count),
        after=np.ones(count),
        follows=np.arange(count) > 0,
    )
    found = estimate(made, error=None)
    assert found.error == pytest.approx(errors.std(), rel=0.3)
    assert found.scatter < 0.02
    assert found.factor[0] == pytest.approx(-0.08, abs=4.0 * 0.05 / 16.0)
    known = estimate(replace(made, before=0.05 * made.before, after=0.05 * made.after), error=1.0)
    assert known.error == 1.0
    assert known.factor[0] == pytest.approx(found.factor[0], abs=1e-3)


def test_the_lowest_deviance_is_refined_between_its_neighbours_and_below_the_least_trial() -> None:
    def bowl(at: float) -> float:
        return 2.0 + (at - least) ** 2

    trials = [0.0, 1.0, 2.0, 4.0]
    for least in (0.7, 1.3, 2.6, 3.9, 4.0, 7.0, -1.0):
        value, place = _refined(bowl, trials, [bowl(each) for each in trials])
        assert place == pytest.approx(min(max(least, 0.0), 4.0), abs=1e-3)
        assert value == pytest.approx(bowl(place), rel=1e-9)


@every(("count", "kinds"), [(24, 1), (24, 2), (60, 2)])
def test_groups_without_measuring_errors_have_their_own_means_and_a_common_scatter(
    count: int, kinds: int
) -> None:
    """Posterior of a flat prior of the scatter: chi-square with n - k - 1 degrees of freedom."""
    made = independent(count, -0.06, 0.05, seed=4)
    kind = np.arange(count) % kinds
    design = (kind[:, np.newaxis] == np.arange(kinds)).astype(np.float64)
    result = estimate(replace(made, design=design), error=1.0)
    means = np.array([made.change[kind == each].mean() for each in range(kinds)])
    assert result.factor == pytest.approx(means, rel=1e-9)
    squares = float(((made.change - means[kind]) ** 2).sum())
    assert result.scatter == pytest.approx(math.sqrt(squares / (count - kinds)), rel=1e-3)
    free = count - kinds - 1
    deviation = math.sqrt(squares / (free - 2) / (count // kinds))
    assert result.deviation == pytest.approx(np.full(kinds, deviation), rel=0.01)
    width = math.sqrt(squares / free / (count // kinds))
    ends = means[:, np.newaxis] + width * stats.t.ppf([0.05, 0.95], free)
    assert result.interval == pytest.approx(ends, abs=0.02 * width)
    residuals = (made.change - means[kind]) / result.scatter
    assert result.residuals == pytest.approx(residuals, rel=1e-6)


def test_steps_of_two_impacts_have_twice_the_scatter_squared() -> None:
    """Equal steps of one impact and of two, beside weighted least squares by hand."""
    rng = np.random.default_rng(9)
    impacts = np.where(np.arange(30) % 3 == 0, 2.0, 1.0)
    change = -0.05 * impacts + 0.04 * np.sqrt(impacts) * rng.standard_normal(30)
    zero = np.zeros(30)
    made = Steps(
        change=change,
        design=impacts[:, np.newaxis],
        impacts=impacts,
        before=zero,
        after=zero,
        follows=np.zeros(30, dtype=bool),
    )
    result = estimate(made, error=1.0)
    factor = change.sum() / impacts.sum()
    squares = float(((change - factor * impacts) ** 2 / impacts).sum())
    assert result.factor[0] == pytest.approx(factor, rel=1e-9)
    assert result.scatter == pytest.approx(math.sqrt(squares / 29.0), rel=1e-3)
    _, covariance = solved(made, result.scatter, 1.0)
    assert covariance[0, 0] == pytest.approx(result.scatter**2 / impacts.sum(), rel=1e-9)


def test_few_steps_leave_the_scatter_without_an_upper_end() -> None:
    """Of two steps and one mean one degree of freedom is left, of which Student's is known."""
    made = independent(2, -0.06, 0.05)
    result = estimate(made, error=1.0)
    spread = float(made.change.std(ddof=1))
    assert result.scatter == pytest.approx(spread, rel=1e-3)
    reach = float(stats.t.ppf(0.95, 1)) * spread / math.sqrt(2.0)
    assert result.interval[0] == pytest.approx(
        made.change.mean() + np.array([-reach, reach]), rel=1e-3
    )
    alone = estimate(independent(1, -0.06, 0.05), error=1.0)
    assert np.isinf(alone.interval[0]).all()
    assert alone.scatter == 0.0


def test_errors_of_peaks_alone_have_no_scatter_and_their_own_size() -> None:
    """Where the errors are known and explain all, the likelihood is largest without a scatter."""
    rng = np.random.default_rng(21)
    change = rng.normal(-0.05, 0.01, 12)
    wide = np.full(12, 0.05)
    made = replace(independent(12, 0.0, 1.0), change=change, before=wide, after=wide)
    result = estimate(made, error=1.0)
    assert result.scatter == 0.0
    assert result.scatter_interval[0] == 0.0
    least = _deviance(made, 0.0, 1.0)
    end = result.scatter_interval[1]
    assert 0.5 * (_deviance(made, end, 1.0) - least) == pytest.approx(1.3528, abs=2e-3)
    assert result.factor[0] == pytest.approx(change.mean())
    assert result.residuals == pytest.approx((change - change.mean()) / (0.05 * math.sqrt(2.0)))
