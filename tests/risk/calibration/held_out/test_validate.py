"""Held-out validation: falls by tenth and by group against SciPy, its words, odd sessions."""

import functools
from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import beta

from rocksteady import calibrate
from rocksteady.calibration import DrawOptions, Observations, Validation
from rocksteady.risk.calibration.held_out.validate import _misfits
from tests.risk.calibration.trials import LINEAR, Case, make_tests


@functools.cache
def validated() -> tuple[Observations, Validation]:
    """Return 20 tests, of two sessions and some without, of which one has no outcome."""
    made, _ = make_tests(Case("20 tests", tests=20), 4)
    sessions = ["Monday", "Tuesday", None, "Tuesday"]
    tests = [replace(test, session=sessions[k % 4]) for k, test in enumerate(made.tests)]
    tests[7] = replace(tests[7], fell=None)
    few = DrawOptions(draws=60, gains=2, rounds=1)
    given = Observations(tests=tests, objects=made.objects)
    validation = calibrate(given, sampling=few, model=LINEAR).validation
    assert validation is not None
    return given, validation


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
            here = [
                k for k, test in enumerate(given.tests) if of[k] == name and test.fell is not None
            ]
            fell = sum(bool(given.tests[k].fell) for k in here)
            variance = sum(p[k] * (1.0 - p[k]) for k in here)
            assert (row["tests"], row["fell"]) == (len(here), fell)
            assert row["expected"] == pytest.approx(p[here].sum())
            assert row["deviation"] == pytest.approx(variance**0.5)
            assert row["z"] == pytest.approx((fell - p[here].sum()) / variance**0.5)


def test_the_headline_has_the_accuracy_and_its_interval() -> None:
    _, found = validated()
    scores = replace(found.rows["calibrated"], accuracy=(0.84, 0.75, 0.9), brier=(0.1234, 0.1, 0.2))
    for accuracy, words in (
        ((0.84, 0.75, 0.9), "accuracy 84 % (90 %: 75 to 90 %), Brier score 0.123"),
        ((0.84, np.nan, np.nan), "accuracy 84 %, Brier score 0.123"),
        ((1.0, np.nan, np.nan), "accuracy 19 of 19, Brier score 0.123"),
    ):
        rows = {"calibrated": replace(scores, accuracy=accuracy)}
        described = replace(found, rows=rows).describe()
        assert described.headline == f"held out by {found.folds}: {words}"
        facts = {fact.key: fact.value for fact in described.facts}
        assert (facts["groups"], facts["tests"]) == (scores.groups, scores.tests) == (5, 19)
    without = replace(found, rows={}).describe()
    assert without.headline == f"held out by {found.folds}: no scores"
    facts = {fact.key: fact.value for fact in without.facts}
    assert (facts["groups"], facts["tests"]) == (0, 0)


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
