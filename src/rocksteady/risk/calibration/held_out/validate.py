"""Validation: scores of each group's tests from the others, beside those of simpler rules."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from rocksteady.arrays import Floats, Integers
from rocksteady.model.checks.arguments import checked
from rocksteady.results.doubts import FEWEST_DRAWS
from rocksteady.results.numbers import number
from rocksteady.results.result import Result
from rocksteady.risk.calibration.held_out.learning import Trial, learning_curve
from rocksteady.risk.calibration.held_out.leaving_out import hold_out
from rocksteady.risk.calibration.held_out.predictions import Predictions, predictions_of
from rocksteady.risk.calibration.held_out.rivals import (
    LogisticCurve,
    Stack,
    base_rate,
    logistic_curve,
    logistic_of,
    stacks_of,
)
from rocksteady.risk.calibration.held_out.scores import BINS, Scores, bin_of, scores_of
from rocksteady.risk.observations.shaking_test import ShakingTest

Row = dict[str, Any]
ODD, LEAST_VARIANCE = 0.01, 0.5
"""Chance below which a misfit is named, and the variance of the falls of a group that counts."""
ROWS = ("predicted", "block", "logistic", "base rate")


@checked
@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Validation(Result):
    """Held-out scores of a calibration and of simpler rules.

    Attributes
    ----------
    folds
        What stays together: "group", "record", "test" or "session".
    rows
        `Scores` of "predicted" (block and logistic together), "block", "logistic" and "base rate",
        on the same folds; empty where tests cannot be held out, and `warnings` have the reason.
    predictions
        Predictions of each test without its group.
    reliability
        For each tenth of p that holds tests: `from`, `to`, `tests`, `predicted` (mean p),
        `observed` (share that fell), and `low`, `high` of its 90 % interval (of Jeffreys).
    residuals
        By "record", "session", "order" (quarters of the table) and "intensity" (quarters of the
        gain times PGA) a row for each: `name`, `tests`, `fell`, `expected`,
        `deviation` of it, and `z`, the difference over the deviation.
    learning
        By the number of training `groups` the mean scores of "block", "logistic" and "base rate",
        as "block brier", with `tests`, the mean number of the training.
    curve, stack
        The logistic of all tests, and how it and the block make a prediction together; held-out
        predictions have those of the other groups.
    warnings
        Sentences on what limits the scores.

    Examples
    --------
    >>> from rocksteady import Block, Linear, calibrate
    >>> from rocksteady.calibration import make_synthetic_tests
    >>> from rocksteady.motions import make_synthetic_suite
    >>> column = Block.rectangle(width=0.15, height=0.6)
    >>> tests = make_synthetic_tests(column, make_synthetic_suite(4), model=Linear())
    >>> validation = calibrate(tests, most_runs=200, model=Linear()).validation
    >>> validation.folds, sorted(validation.rows)
    ('group', ['base rate', 'block', 'logistic', 'predicted'])
    """

    folds: str
    rows: Mapping[str, Scores]
    predictions: Predictions
    reliability: tuple[Mapping[str, Any], ...]
    residuals: Mapping[str, tuple[Mapping[str, Any], ...]]
    learning: tuple[Mapping[str, Any], ...]
    curve: LogisticCurve
    stack: Stack
    warnings: tuple[str, ...] = ()


def validate_trial(
    trial: Trial,
    tests: Sequence[ShakingTest],
    names: Sequence[str],
    *,
    folds: str,
    learning: bool,
) -> Validation:
    """Return held-out scores of a trial; `names` are those of the groups, by their numbers."""
    known = np.isfinite(trial.fell)
    fell, codes = trial.fell[known], np.unique(trial.codes[known], return_inverse=True)[1]
    held = hold_out(trial.fits, trial.tests, trial.codes)
    groups = [names[code] for code in trial.codes.tolist()]
    curve = logistic_curve(trial.measures, trial.fell, trial.codes)
    reason = why_not(trial.fell, trial.codes, folds)
    if reason:
        return Validation(
            folds=folds,
            rows={},
            predictions=predictions_of(tests, held, groups, logistic=np.full(len(tests), np.nan)),
            reliability=(),
            residuals={"record": (), "session": (), "order": (), "intensity": ()},
            learning=(),
            curve=curve,
            stack=Stack(),
            warnings=(f"no held-out scores: {reason}",),
        )
    trains = np.arange(len(names))[:, np.newaxis] != trial.codes
    place = np.arange(len(tests))
    logistic = logistic_of(trial.measures, trial.fell, trial.codes, trains)[trial.codes, place]
    stacks = stacks_of(held.p, logistic, trial.fell, np.vstack([trains, np.ones(len(tests), bool)]))
    rates = np.empty(len(tests))
    for train in trains:
        rates[~train] = base_rate(trial.fell, trial.objects, train)[~train]
    apart = [stacks[code] for code in trial.codes.tolist()]
    predictions = predictions_of(tests, held, groups, logistic=logistic, stacks=apart)
    rules = (predictions.p, held.p, logistic, rates)
    scores = {
        name: scores_of(p[known], fell, codes, seed=trial.seed)
        for name, p in zip(ROWS, rules, strict=True)
    }
    low = np.flatnonzero(held.effective < FEWEST_DRAWS)
    warnings = []
    if len(low):
        few = {groups[each] for each in low.tolist()}
        warnings.append(
            f"{len(few)} of {len(names)} folds rest on fewer than {FEWEST_DRAWS:g} effective "
            f"draws, {held.effective.min():.0f} at least"
        )
    if scores["predicted"].brier[0] >= scores["base rate"].brier[0]:
        score, rate = (number(scores[name].brier[0]) for name in ("predicted", "base rate"))
        warnings.append(
            f"held-out predictions are no better than the base rate: Brier score {score}, by the "
            f"base rate {rate}: doubt the prior of the outline, or the model"
        )
    residuals = _residuals(predictions.p, trial.fell, tests)
    warnings += _misfits(residuals)
    if len(names) < 10:
        warnings.append(f"with {len(names)} groups the intervals of the scores are rough")
    return Validation(
        folds=folds,
        rows=scores,
        predictions=predictions,
        reliability=tuple(_reliability(predictions.p[known], fell)),
        residuals=residuals,
        learning=tuple(learning_curve(trial)) if learning else (),
        curve=curve,
        stack=stacks[-1],
        warnings=tuple(warnings),
    )


def why_not(fell: Floats, codes: Integers, folds: str) -> str:
    """Return why tests cannot be held out; an empty text where they can."""
    known = np.isfinite(fell)
    if not known.any():
        return "no test has an outcome: there is nothing to score"
    if len(np.unique(codes[known])) < 2:
        return f"all tests with an outcome are of one {folds}: none is left to predict it from"
    return ""


def _reliability(p: Floats, fell: Floats) -> list[Row]:
    """Return the tenths of p that hold tests."""
    from scipy.special import betaincinv

    rows = []
    place = bin_of(p)
    for tenth in np.unique(place).tolist():
        members = place == tenth
        tests, count = int(members.sum()), float(fell[members].sum())
        low, high = (betaincinv(count + 0.5, tests - count + 0.5, end) for end in (0.05, 0.95))
        rows.append(
            {
                "from": tenth / BINS,
                "to": (tenth + 1) / BINS,
                "tests": tests,
                "predicted": float(p[members].mean()),
                "observed": count / tests,
                "low": float(low) if count else 0.0,
                "high": float(high) if count < tests else 1.0,
            }
        )
    return rows


def _quarters(values: Floats | Integers) -> list[str | None]:
    """Return the quarter of each value by its rank: equal values share one."""
    ranks = np.searchsorted(np.sort(values), values)
    return [f"quarter {1 + 4 * rank // len(values)}" for rank in ranks.tolist()]


def _misfits(residuals: Mapping[str, Sequence[Row]]) -> list[str]:
    """Return a sentence for each way of grouping whose observed falls are odd.

    Squares of z of m groups sum to about chi-squared of m degrees of freedom, if the predictions
    are right: a check of the posterior that predicts each test without its own group [1].

    References
    ----------
    .. [1] A. Gelman, X.-L. Meng and H. Stern, Statistica Sinica 6, 733-760 (1996).
    """
    from scipy.special import gammaincc

    sentences = []
    for kind, rows in residuals.items():
        # Groups without a doubtful test have a deviation of nearly 0, and z has no normal law.
        scored = [row for row in rows if row["deviation"] ** 2 >= LEAST_VARIANCE]
        square = sum(row["z"] ** 2 for row in scored)
        if len(scored) < 2 or gammaincc(0.5 * len(scored), 0.5 * square) >= ODD:
            continue
        worst = max(scored, key=lambda row: abs(row["z"]))
        sentences.append(
            f"misfit by {kind}: mean z^2 {number(square / len(scored), 2)} where 1 is expected; "
            f"worst {worst['name']}, {worst['fell']} of {worst['tests']} fell, "
            f"{number(worst['expected'], 2)} expected"
        )
    return sentences


def _residuals(p: Floats, fell: Floats, tests: Sequence[ShakingTest]) -> dict[str, tuple[Row, ...]]:
    """Return observed and expected falls by record, session, order and intensity."""
    pga = np.array([test.gain * test.record.peak_acceleration_m_s2 for test in tests])
    keys: dict[str, list[str | None]] = {
        "record": [test.record.name or test.group or "" for test in tests],
        "session": [test.session for test in tests],
        "order": _quarters(np.arange(len(tests))),
        "intensity": _quarters(pga),
    }
    groups = {}
    for kind, names in keys.items():
        rows = []
        for name in dict.fromkeys(name for name in names if name is not None):
            chosen = np.array([each == name for each in names]) & np.isfinite(fell)
            if not chosen.any():
                continue
            expected, deviation = (
                float(p[chosen].sum()),
                float(np.sqrt((p * (1.0 - p))[chosen].sum())),
            )
            count = int(fell[chosen].sum())
            rows.append(
                {
                    "name": name,
                    "tests": int(chosen.sum()),
                    "fell": count,
                    "expected": expected,
                    "deviation": deviation,
                    "z": (count - expected) / deviation if deviation > 0.0 else 0.0,
                }
            )
        groups[kind] = tuple(rows)
    return groups
