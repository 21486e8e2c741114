"""Predictions without a test as ratios of likelihoods with it and without it."""

import functools
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from rocksteady.calibration import OutcomeErrors, PriorRange
from rocksteady.risk.calibration.held_out import leaving_out
from rocksteady.risk.calibration.held_out.leaving_out import (
    Case,
    Draws,
    hold_out,
    predict_cases,
    refit,
    weighed,
    weighted_quantiles,
)
from tests.every import every
from tests.risk.calibration.cases import narrow
from tests.risk.calibration.toys import FEATURES, Known, make_toy

SESSIONS = ("a", "a", "b", "a", None, "b", "a", "c")
FELL = (True, False, True, None, True, False, True, True)
BASE = np.linspace(0.0, -1.0, 9)
EVERY = np.arange(8)
EXACT = OutcomeErrors(outliers=PriorRange.exactly(0.03))


def joint(fell: tuple[bool | None, ...], noise: OutcomeErrors = EXACT) -> Any:
    """Return the likelihood of outcomes at each draw, the weights of the draws included."""
    return np.exp(make_toy(SESSIONS, fell, noise=noise).joint(Known(), FEATURES, EVERY) + BASE)


def changed(places: Any, fell: bool | None) -> tuple[bool | None, ...]:
    return tuple(fell if k in places else each for k, each in enumerate(FELL))


def toy_draws(fell: tuple[bool | None, ...] = FELL, noise: OutcomeErrors = EXACT) -> Draws:
    surfaces: Any = Known()
    likelihood = make_toy(SESSIONS, fell, noise=noise)
    return Draws(likelihood=likelihood, surfaces=surfaces, features=FEATURES, base=BASE)


@every(("noise", "near"), [(EXACT, 2e-4), (OutcomeErrors(), 0.01)])
def test_a_test_is_predicted_from_all_others(noise: OutcomeErrors, near: float) -> None:
    """p = L(it fell, the others)/L(the others): alone, in a session, in one of its own."""
    cases = [Case(left=np.array([k]), asked=np.array([k])) for k in range(8)]
    for place, (held, _) in enumerate(predict_cases(toy_draws(noise=noise), cases)):
        without = joint(changed([place], None), noise)
        exact = joint(changed([place], True), noise).sum() / without.sum()
        assert held.p[0] == pytest.approx(exact, abs=near), place
        effective = without.sum() ** 2 / np.square(without).sum()
        assert held.effective[0] == pytest.approx(effective, rel=2e-3)
    # A group over sessions is left out together, and other tests may be asked for.
    case = Case(left=np.array([0, 2, 4, 5]), asked=np.array([5, 0, 6]))
    ((held, _),) = predict_cases(toy_draws(noise=noise), [case])
    rest = changed(case.left, None)
    for place, test in ((0, 5), (1, 0)):
        fell = tuple(True if k == test else each for k, each in enumerate(rest))
        exact = joint(fell, noise).sum() / joint(rest, noise).sum()
        assert held.p[place] == pytest.approx(exact, abs=near)


def test_no_outcome_of_a_group_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    left = np.array([0, 1, 5])
    outcomes = (FELL, (False, True, True, None, True, True, True, True), changed([2], False))
    parts = [predict_cases(toy_draws(fell), [Case(left=left, asked=left)]) for fell in outcomes]
    first, second, other = (part[0][0] for part in parts)
    assert (first.p == second.p).all()
    assert (first.error == second.error).all()
    assert (first.p != other.p).all()
    monkeypatch.setattr("rocksteady.risk.calibration.sampler.outcome_likelihood.CHUNK", 1)
    assert (predict_cases(toy_draws(), [Case(left=left, asked=left)])[0][0].p == first.p).all()


@functools.cache
def folds() -> tuple[Any, list[Case], list[tuple[Any, float]]]:
    """Return a fit, its folds by record, and their predictions from its draws."""
    (fit,) = narrow().fits
    groups = np.unique([test.group for test in fit.bench.tests], return_inverse=True)[1]
    places = [np.flatnonzero(groups == group) for group in range(groups.max() + 1)]
    cases = [Case(left=each, asked=each) for each in places]
    kept = np.flatnonzero(fit.weights > 0.0)
    features, base = fit.features[kept], fit.base[kept]
    draws = Draws(likelihood=fit.likelihood, surfaces=fit.surfaces, features=features, base=base)
    return fit, cases, predict_cases(draws, cases)


def test_folds_that_are_refitted_agree_with_reweighted_ones() -> None:
    fit, cases, held = folds()
    for place in range(0, len(cases), 3):
        again = refit(fit, cases[place])
        assert again.p == pytest.approx(held[place][0].p, abs=0.01), place


def test_a_fold_with_few_draws_is_refitted(monkeypatch: pytest.MonkeyPatch) -> None:
    fit, cases, held = folds()
    codes, mark = np.empty(60, dtype=np.int64), np.full(60, 0.123)
    for code, case in enumerate(cases):
        codes[case.left] = code
    monkeypatch.setattr(
        leaving_out, "refit", lambda _, case: replace(held[0][0], p=mark[case.left])
    )
    for enough, most_k, refitted in ((0.0, 9.0, False), (1e9, 9.0, True), (0.0, -9.0, True)):
        monkeypatch.setattr(leaving_out, "ENOUGH_DRAWS", enough)
        monkeypatch.setattr(leaving_out, "MOST_K", most_k)
        found = hold_out([fit], [np.arange(60)], codes).p
        assert ((found == 0.123).all()) == refitted
        if not refitted:
            assert found[cases[3].asked] == pytest.approx(held[3][0].p, abs=1e-3)


def test_weighted_quantiles_are_those_of_repeated_values() -> None:
    values = np.array([[3.0, 1.0], [1.0, 2.0], [2.0, 3.0]])
    weights = np.array([0.2, 0.5, 0.3])
    found = weighted_quantiles(values, weights, (0.05, 0.5, 0.75, 0.95))
    assert found[:, 0].tolist() == [1.0, 1.0, 2.0, 3.0]
    assert found[:, 1].tolist() == [1.0, 2.0, 3.0, 3.0]


def test_the_error_of_a_mean_is_the_scatter_of_repeated_draws() -> None:
    rng = np.random.default_rng(6)
    found = []
    for _ in range(300):
        x = rng.normal(size=400)
        weights = np.exp(-0.5 * np.square(x - 1.0) + 0.5 * np.square(x))  # of N(1, 1)
        share = 1.0 / (1.0 + np.exp(-x[:, np.newaxis] * [1.0, -2.0]))
        found.append(weighed(weights / weights.sum(), share))
    scatter = np.std([each.p for each in found], axis=0)
    assert np.mean([each.error for each in found], axis=0) == pytest.approx(scatter, rel=0.25)
    share = np.array([[0.2], [0.4]])
    one, two = (weighed(np.array(w), share) for w in ([1.0, 0.0], [0.5, 0.5]))
    assert (one.p[0], one.error[0], one.effective[0]) == pytest.approx((0.2, 0.5, 1.0))
    assert two.p[0] == pytest.approx(0.3)
    assert np.isnan([one.low, two.high]).all()  # too few draws for a band
