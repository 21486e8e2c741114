"""Bootstrap by record: slopes of the delta method, covariance by loops, intervals by hand."""

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from scipy import stats

from rocksteady.risk import BandOptions
from rocksteady.risk.fits import _bootstrap
from rocksteady.risk.fits._bootstrap import Redrawn, Replicates, covariance_of, draw_replicates
from rocksteady.risk.fits._maximum import Maximum, maximum_of
from rocksteady.risk.fits._trial_counts import counts_of
from tests.every import every
from tests.risk.fits.suites import make_suite

LOGS = np.log([0.2, 0.6, 1.1, 2.5])
AT = np.array([[0.3, 1.4, -0.6, 2.2], [-0.2, 0.7, 0.1, 1.1]])


def stage(seed: int = 3, records: int = 14, family: str = "lognormal") -> Maximum:
    suite = make_suite(records, seed=seed, scatter=0.2)
    given = (("trials", suite.trials), ("failures", suite.failures))
    (counts,) = counts_of(suite.intensity, given, suite.record)
    return maximum_of(counts, family)


FIRST, SECOND = stage(), stage(seed=4)
Quantity = Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]
QUANTITIES: dict[str, Quantity] = {
    "median": _bootstrap._log_median,
    "beta": _bootstrap._log_beta,
    "one stage": lambda at: _bootstrap._predictor(FIRST, LOGS, at[..., :2]),
    "two stages": lambda at: _bootstrap._log_odds((FIRST, SECOND), LOGS, at),
}


@every("name", QUANTITIES)
def test_slopes_are_the_derivatives_of_their_quantities(name: str) -> None:
    quantity, step = QUANTITIES[name], 1e-6
    _, slope = quantity(AT)
    for column in range(slope.shape[-1]):
        shift = step * np.eye(4)[column]
        rise = (quantity(AT + shift)[0] - quantity(AT - shift)[0]) / (2.0 * step)
        assert slope[..., column] == pytest.approx(rise, rel=1e-7, abs=1e-8)


def test_quantities_are_those_of_the_curves() -> None:
    """P = F(a + b z): half fail at z = -a/b, beta is 1/b, and stages multiply."""
    a, b = AT[:, 0], AT[:, 1]
    assert _bootstrap._log_median(AT)[0][:, 0] == pytest.approx(-a / b)
    assert np.exp(_bootstrap._log_beta(AT)[0][:, 0]) == pytest.approx(1.0 / b)
    product = np.ones((2, len(LOGS)))
    for each, place in ((FIRST, 0), (SECOND, 2)):
        z = (LOGS - each.centre) / each.scale
        product *= stats.norm.cdf(AT[:, [place]] + AT[:, [place + 1]] * z)
    odds = _bootstrap._log_odds((FIRST, SECOND), LOGS, AT)[0]
    assert 1.0 / (1.0 + np.exp(-odds)) == pytest.approx(product, rel=1e-9)


def test_the_covariance_is_that_of_scores_summed_by_record() -> None:
    """Liang and Zeger by loops, with the normal density and its own derivative of the score."""
    weight = np.random.default_rng(0).integers(0, 3, FIRST.counts.trials.shape[0]).astype(float)
    at = FIRST.coefficients + np.array([0.1, -0.05])
    trials, failures = FIRST.counts.trials.toarray(), FIRST.counts.failures.toarray()
    scores, bread = np.zeros((len(weight), 2)), np.zeros((2, 2))

    def score(k: float, n: float, eta: float) -> float:
        density = math.exp(-0.5 * eta * eta) / math.sqrt(2.0 * math.pi)
        below, above = (0.5 * math.erfc(sign * eta / math.sqrt(2.0)) for sign in (-1.0, 1.0))
        return density * (k / below - (n - k) / above)

    for record in range(len(weight)):
        for level, row in enumerate(FIRST.design):
            k, n, eta = failures[record, level], trials[record, level], float(row @ at)
            scores[record] += score(k, n, eta) * row
            fall = (score(k, n, eta - 1e-5) - score(k, n, eta + 1e-5)) / 2e-5
            bread += weight[record] * fall * np.outer(row, row)
    meat = (scores * weight[:, None]).T @ scores
    expected = np.linalg.inv(bread) @ meat @ np.linalg.inv(bread)
    found = covariance_of([FIRST], at[None], weight[None])
    assert found.shape == (1, 2, 2)
    assert found[0] == pytest.approx(expected, rel=1e-6)


def test_stages_of_the_same_records_vary_together() -> None:
    weight = FIRST.counts.multiplicity
    both = np.concatenate([FIRST.coefficients, FIRST.coefficients])[None]
    found = covariance_of([FIRST, FIRST], both, weight[None])[0]
    alone = covariance_of([FIRST], FIRST.coefficients[None], weight[None])[0]
    for rows in (slice(0, 2), slice(2, 4)):
        for columns in (slice(0, 2), slice(2, 4)):
            assert found[rows, columns] == pytest.approx(alone, rel=1e-12)


def test_an_interval_is_studentised() -> None:
    """By hand: t* of each redrawn value, its quantiles, and the ends turned round."""
    rng = np.random.default_rng(5)
    values, errors = rng.normal(0.4, 0.2, 60), rng.uniform(0.1, 0.3, 60)
    made = Replicates(
        stages=(FIRST,),
        confidence=0.8,
        value=np.array([0.5]),
        covariance=np.array([[0.15**2]]),
        values=values[:, None],
        covariances=np.square(errors)[:, None, None],
    )
    low, high = made.interval(lambda at: (at, np.ones((*at.shape, 1))))
    t = np.sort((values - 0.5) / errors)
    tenth, ninth = np.interp([0.1, 0.9], np.linspace(0.0, 1.0, 60), t)
    assert (low[0], high[0]) == pytest.approx((0.5 - ninth * 0.15, 0.5 - tenth * 0.15))


@every("family", ["lognormal", "logistic"])
def test_a_redrawn_suite_is_fitted_as_a_suite_of_these_records(family: str) -> None:
    one = stage(family=family)
    drawn = np.random.default_rng(1).multinomial(14, np.full(14, 1 / 14), size=8).astype(float)
    solved = _bootstrap._solve(one, drawn)
    for row, weight in zip(solved, drawn, strict=True):
        again = maximum_of(replace(one.counts, multiplicity=weight), family)
        if again.status != "fitted":
            assert np.isnan(row).all()
            continue
        # The same curve on another scale of ln im.
        a, b = again.coefficients
        slope = b * one.scale / again.scale
        centre = a + b * (one.centre - again.centre) / again.scale
        assert row == pytest.approx([centre, slope], rel=1e-7, abs=1e-9)
    assert np.isfinite(solved[:, 0]).sum() >= 4


def test_suites_solved_at_once_are_those_solved_one_by_one(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    drawn = np.random.default_rng(2).multinomial(14, np.full(14, 1 / 14), size=60).astype(float)
    at_once = _bootstrap._solve(FIRST, drawn)
    monkeypatch.setattr(_bootstrap, "STEPS", 0)
    alone = _bootstrap._solve(FIRST, drawn)
    assert np.isfinite(at_once).all(axis=1).sum() > 30
    assert at_once == pytest.approx(alone, rel=1e-8, abs=1e-10, nan_ok=True)


def test_suites_computed_in_parts_are_those_computed_at_once(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    options = BandOptions(replicates=100)
    whole = draw_replicates([FIRST], options)
    widest = max(*FIRST.counts.trials.shape)
    monkeypatch.setattr(_bootstrap, "MOST_CELLS", 30 * widest)
    parts = draw_replicates([FIRST], options)
    assert parts.values.tobytes() == whole.values.tobytes()
    assert parts.covariances.tobytes() == whole.covariances.tobytes()
    monkeypatch.setattr(_bootstrap, "MOST_CELLS", 1)
    assert draw_replicates([FIRST], BandOptions(replicates=100)).values.shape == whole.values.shape


def test_what_is_remembered_is_known_by_all_that_decides_it() -> None:
    drawn = np.ones((2, 14))
    one = Redrawn(FIRST, drawn)
    assert one == Redrawn(stage(), drawn.copy())
    assert hash(one) == hash(Redrawn(stage(), drawn.copy()))
    counts = FIRST.counts
    others = [
        Redrawn(FIRST, drawn + 1.0),
        Redrawn(FIRST, np.ones((1, 28))),
        *(
            Redrawn(replace(FIRST, **changed), drawn)
            for changed in (
                {"name": "logistic"},
                {"centre": FIRST.centre + 1e-12},
                {"scale": 2.0 * FIRST.scale},
                {"coefficients": FIRST.coefficients + 1e-12},
                {"counts": replace(counts, levels=counts.levels * 2.0)},
                {"counts": replace(counts, failures=counts.trials)},
                {"counts": replace(counts, trials=2.0 * counts.trials)},
            )
        ),
    ]
    assert all(other != one for other in others)
    assert one != FIRST
