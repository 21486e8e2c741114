"""Validation: scores of each group's tests from the others, beside those of simpler rules."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rocksteady.arrays import Floats, Integers
from rocksteady.model.checks.arguments import checked
from rocksteady.results.description import Column, Description, Fact, Table
from rocksteady.results.doubts import FEWEST_DRAWS
from rocksteady.results.numbers import chance, interval, number
from rocksteady.results.result import Result
from rocksteady.risk.calibration.held_out.folds import LADDER, choose_tempers, hold_out
from rocksteady.risk.calibration.held_out.learning import Trial, best_temper, learning_curve
from rocksteady.risk.calibration.held_out.predictions import Predictions, predictions_of
from rocksteady.risk.calibration.held_out.recalibration import (
    PLAIN,
    Platt,
    fit_platt,
    it_helps,
    recalibrated,
)
from rocksteady.risk.calibration.held_out.rivals import out_of_group
from rocksteady.risk.calibration.held_out.scores import BINS, NAMES, Scores, bin_of, scores_of
from rocksteady.risk.observations.shaking_test import ShakingTest

Row = dict[str, Any]
ODD, LEAST_VARIANCE = 0.01, 0.5
"""Chance below which a misfit is named, and the variance of the falls of a group that counts."""
ROWS = ("calibrated", "untempered", "base rate", "logistic")


@checked
@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Validation(Result):
    """Held-out scores of a calibration and of simpler rules.

    Attributes
    ----------
    folds
        What stays together: "group", "record", "test" or "session".
    rows
        `Scores` of "calibrated", "untempered", "base rate" and "logistic", on the same folds;
        empty where tests cannot be held out, and `warnings` have the reason.
    tempers
        Temper by the name of each group, chosen among the tests of the others.
    temper_scores
        `Scores` by temper, of all groups at that temper.
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
        By the number of training `groups` the `Scores` of "calibrated", "logistic" and
        "base rate", with `tests`, the mean number of the training.
    recalibration
        Line over log odds by all held-out predictions, for tests that were not in the training;
        held-out predictions have that of the other groups.
    warnings
        Sentences on what limits the scores.

    Examples
    --------
    >>> from rocksteady import Block, Linear, calibrate
    >>> from rocksteady.calibration import DrawOptions, make_synthetic_tests
    >>> from rocksteady.motions import make_synthetic_suite
    >>> column = Block.rectangle(width=0.15, height=0.6)
    >>> tests = make_synthetic_tests(column, make_synthetic_suite(4), model=Linear())
    >>> few = DrawOptions(draws=60, gains=2, rounds=1)
    >>> validation = calibrate(tests, sampling=few, model=Linear()).validation
    >>> validation.folds, sorted(validation.rows)
    ('group', ['base rate', 'calibrated', 'logistic', 'untempered'])
    """

    folds: str
    rows: Mapping[str, Scores]
    tempers: Mapping[str, float]
    temper_scores: Mapping[float, Scores]
    predictions: Predictions
    reliability: tuple[Row, ...]
    residuals: Mapping[str, tuple[Row, ...]]
    learning: tuple[Row, ...]
    recalibration: Platt = PLAIN
    warnings: tuple[str, ...] = ()

    def describe(self) -> Description:
        """Return the scores, one row for each rule."""
        rows = [{"rule": name} | _plain(scores) for name, scores in self.rows.items()]
        learning = [
            {
                f"{key} {score}" if isinstance(value, Scores) else key: part
                for key, value in row.items()
                for score, part in (
                    [(name, getattr(value, name)[0]) for name in NAMES]
                    if isinstance(value, Scores)
                    else [("", value)]
                )
            }
            for row in self.learning
        ]
        residuals = [{"by": by} | row for by, rows in self.residuals.items() for row in rows]
        columns = (
            Column("rule", "predicted by", left=True),
            Column("accuracy", "accuracy", number),
            Column("f1", "F1", number),
            Column("brier", "Brier", number),
            Column("log_score", "log score", number),
            Column("ece", "ECE", number),
        )
        best = self.rows.get("calibrated")
        words = "no scores"
        if best is not None:
            share, low, high = best.accuracy
            span = interval(None if np.isnan(low) else (low, high), 0.9)
            words = f"accuracy {chance(share, best.tests)}{span}, "
            words += f"Brier score {number(best.brier[0])}"
        return Description(
            headline=f"held out by {self.folds}: {words}",
            facts=[
                Fact("folds", self.folds, "held out together"),
                Fact("groups", 0 if best is None else best.groups, "groups"),
                Fact("tests", 0 if best is None else best.tests, "tests"),
                Fact("warnings", list(self.warnings)),
            ],
            tables=[
                Table("scores", rows, columns, title="scores of tests that were held out"),
                Table("temper_scores", self._tempers(), title=""),
                Table("reliability", self.reliability),
                Table("residuals", residuals),
                Table("learning", learning),
            ],
            notes=self.warnings,
        )

    def _tempers(self) -> list[Row]:
        return [
            {"temper": temper, "log_score": scores.log_score[0], "brier": scores.brier[0]}
            for temper, scores in self.temper_scores.items()
        ]


def validate_trial(
    trial: Trial,
    tests: Sequence[ShakingTest],
    names: Sequence[str],
    *,
    folds: str,
    seed: int,
) -> Validation:
    """Return held-out scores of a trial; `names` are those of the groups, by their numbers."""
    known = np.isfinite(trial.fell)
    fell, codes = trial.fell[known], np.unique(trial.codes[known], return_inverse=True)[1]

    def scored(p: Floats) -> Scores:
        return scores_of(p[known], fell, codes, seed=seed)

    if trial.temper is None:
        tempers = choose_tempers(trial.evidence, trial.codes, trial.fell)
    else:
        tempers = np.full(len(names), trial.temper)
    held = hold_out(trial.evidence, trial.codes, tempers)
    line = PLAIN
    helps = trial.recalibrate
    if helps is None:
        helps = it_helps(held.p, trial.fell, trial.codes)
    if helps:
        line = fit_platt(held.p[known], fell)
        mended = recalibrated(held.p, trial.fell, trial.codes, held.low, held.high)
        held = replace(held, **dict(zip(("p", "low", "high"), mended, strict=True)))
    rates, curves = out_of_group(trial.measures, trial.fell, trial.objects, trial.codes)
    at_tempers = {
        temper: hold_out(trial.evidence, trial.codes, temper, ends=False).p for temper in LADDER
    }
    rules = (held.p, at_tempers[1.0], rates, curves)
    groups = [names[code] for code in trial.codes.tolist()]
    low = np.flatnonzero(held.effective < FEWEST_DRAWS)
    warnings = []
    if len(low):
        few = sorted({groups[place] for place in low.tolist()})
        warnings.append(
            f"{len(few)} of {len(names)} folds rest on fewer than {FEWEST_DRAWS:g} effective "
            f"draws, {held.effective.min():.0f} at least: make more draws"
        )
    scores = {name: scored(p) for name, p in zip(ROWS, rules, strict=True)}
    if scores["calibrated"].brier[0] >= scores["base rate"].brier[0]:
        score, rate = (number(scores[name].brier[0]) for name in ("calibrated", "base rate"))
        warnings.append(
            f"held-out predictions are no better than the base rate: Brier score {score}, by the "
            f"base rate {rate}: doubt the prior of the outline, or the model"
        )
    residuals = _residuals(held.p, trial.fell, tests)
    warnings += _misfits(residuals)
    if len(names) < 10:
        warnings.append(f"with {len(names)} groups the intervals of the scores are rough")
    return Validation(
        folds=folds,
        rows=scores,
        tempers=dict(zip(names, tempers.tolist(), strict=True)),
        temper_scores={temper: scored(p) for temper, p in at_tempers.items()},
        predictions=predictions_of(tests, held, groups, held_out=[True] * len(tests)),
        reliability=tuple(_reliability(held.p[known], fell)),
        residuals=residuals,
        learning=tuple(learning_curve(trial, seed=seed)),
        recalibration=line,
        warnings=tuple(warnings),
    )


def without_scores(
    trial: Trial,
    tests: Sequence[ShakingTest],
    names: Sequence[str],
    *,
    folds: str,
    reason: str,
) -> Validation:
    """Return predictions of tests that cannot be scored, each without its group."""
    held = hold_out(trial.evidence, trial.codes, 1.0 if trial.temper is None else trial.temper)
    groups = [names[code] for code in trial.codes.tolist()]
    return Validation(
        folds=folds,
        rows={},
        tempers={},
        temper_scores={},
        predictions=predictions_of(tests, held, groups, held_out=[True] * len(tests)),
        reliability=(),
        residuals={"record": (), "session": (), "order": (), "intensity": ()},
        learning=(),
        warnings=(f"no held-out scores: {reason}",),
    )


def temper_of(trial: Trial) -> float:
    """Return the temper of all tests: the given one, or that of the best held-out log score."""
    if trial.temper is not None:
        return trial.temper
    return best_temper(trial.evidence, trial.codes, trial.fell)


def _plain(scores: Scores) -> Row:
    """Return scores and their ends as values of a row."""
    row: Row = {}
    for key in NAMES:
        value, low, high = getattr(scores, key)
        row |= {key: value, f"{key}_low": low, f"{key}_high": high}
    return row


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
