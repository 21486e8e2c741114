"""Held-out validation: falls by tenth and by group against SciPy, its words, odd sessions."""

import functools
from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import beta

from rocksteady import calibrate
from rocksteady.calibration import Observations, Validation
from rocksteady.risk.calibration.held_out.rivals import stacks_of
from rocksteady.risk.calibration.held_out.validate import _misfits, why_not
from tests.risk.calibration.cases import LINEAR, SERIAL, narrow, narrow_tests


@functools.cache
def validated() -> tuple[Observations, Validation]:
    """Return 20 tests, of two sessions and some without, of which one has no outcome."""
    made = narrow_tests().subset([k for k in range(60) if k % 15 < 5])
    sessions = ["Monday", "Tuesday", None, "Tuesday"]
    tests = [replace(test, session=sessions[k % 4]) for k, test in enumerate(made.tests)]
    tests[7] = replace(tests[7], fell=None)
    given = Observations(tests=tests, objects=made.objects)
    return given, calibrate(given, most_runs=200, model=LINEAR, run=SERIAL).validation


def test_falls_by_tenth_have_jeffreys_interval() -> None:
    given, found = validated()
    fell = np.array([np.nan if test.fell is None else test.fell for test in given.tests])
    known = np.isfinite(fell)
    p, fell = np.array(found.predictions.p)[known], fell[known]
    rows = {row["from"]: row for row in found.reliability}
    assert len(rows) > 2
    assert sum(row["tests"] for row in rows.values()) == len(p) == 19
    for begin, row in rows.items():
        here = np.clip((10.0 * p).astype(int), 0, 9) == round(10.0 * begin)
        count, of = fell[here].sum(), here.sum()
        assert row["to"] == pytest.approx(begin + 0.1)
        assert (row["tests"], row["observed"]) == (of, count / of)
        assert row["predicted"] == pytest.approx(p[here].mean())
        low, high = (float(beta.ppf(q, count + 0.5, of - count + 0.5)) for q in (0.05, 0.95))
        assert row["low"] == pytest.approx(low if count else 0.0)
        assert row["high"] == pytest.approx(high if count < of else 1.0)


def test_falls_by_group_are_beside_the_sums_of_their_chances() -> None:
    given, found = validated()
    p = np.array(found.predictions.p)
    peaks = [test.gain * np.abs(test.record.acceleration_m_s2).max() for test in given.tests]
    ranks = np.argsort(np.argsort(peaks))
    names: dict[str, list[str | None]] = {
        "record": [test.record.name for test in given.tests],
        "session": [test.session for test in given.tests],
        "order": [f"quarter {1 + k // 5}" for k in range(20)],
        "intensity": [f"quarter {1 + rank // 5}" for rank in ranks],
    }
    assert set(found.residuals) == set(names)
    for kind, of in names.items():
        rows = {row["name"]: row for row in found.residuals[kind]}
        assert set(rows) == {name for name in of if name}
        for name, row in rows.items():
            here = [k for k in range(20) if of[k] == name and k != 7]
            fell = sum(bool(given.tests[k].fell) for k in here)
            variance = sum(p[k] * (1.0 - p[k]) for k in here)
            assert (row["tests"], row["fell"]) == (len(here), fell)
            assert row["expected"] == pytest.approx(p[here].sum())
            assert row["deviation"] == pytest.approx(variance**0.5)
            assert row["z"] == pytest.approx((fell - p[here].sum()) / variance**0.5)


def test_a_session_that_falls_too_often_is_named() -> None:
    """Ten sessions of 30 tests at p = .5: all but one as predicted, and one at 27 of 30."""

    def rows(fell: int) -> dict[str, list[dict[str, object]]]:
        z = (fell - 15.0) / 7.5**0.5
        odd = {"name": "Tuesday", "tests": 30, "fell": fell, "expected": 15.0}
        usual = {"name": "other", "tests": 30, "fell": 15, "expected": 15.0}
        deviation = {"deviation": 7.5**0.5}
        return {"session": [{**usual, **deviation, "z": 0.8}] * 9 + [{**odd, **deviation, "z": z}]}

    (sentence,) = _misfits(rows(27))
    assert sentence.startswith("misfit by session")
    assert "worst Tuesday, 27 of 30 fell" in sentence
    assert _misfits(rows(16)) == []


def test_every_group_is_predicted_with_the_stack_of_the_others() -> None:
    validation = narrow().validation
    predictions = validation.predictions
    assert list(validation.rows) == ["predicted", "block", "logistic", "base rate"]
    fell = narrow_tests().fell
    for name, p in (("predicted", predictions.p), ("block", predictions.block)):
        assert validation.rows[name].brier[0] == pytest.approx(np.square(p - fell).mean())
    groups, codes = np.unique(predictions.group, return_inverse=True)
    trains = np.arange(len(groups))[:, np.newaxis] != codes
    stacks = stacks_of(predictions.block, predictions.logistic, fell, trains)
    for place in (0, 17, 44):
        stack = stacks[codes[place]]
        expected = stack.of(predictions.block[place], predictions.logistic[place])
        assert predictions.p[place] == pytest.approx(expected, abs=1e-9)
    rates = [(fell[codes != k].sum() + 1.0) / ((codes != k).sum() + 2.0) for k in codes]
    brier = np.square(np.array(rates) - fell).mean()
    assert validation.rows["base rate"].brier[0] == pytest.approx(brier)
    assert validation.rows["predicted"].brier[0] < 0.6 * brier


def test_what_cannot_be_held_out_has_a_reason() -> None:
    fell, codes = np.array([1.0, 0.0, np.nan]), np.array([0, 0, 1])
    assert "of one record" in why_not(fell, codes, "record")
    assert "no test has an outcome" in why_not(np.full(3, np.nan), codes, "record")
    assert why_not(fell, np.array([0, 1, 1]), "record") == ""
