"""Learning curve: how good predictions from few groups are."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rocksteady.arrays import Bools, Floats, Integers
from rocksteady.risk.calibration.held_out.folds import (
    LADDER,
    Evidence,
    hold_out,
    normalised,
    preferred,
)
from rocksteady.risk.calibration.held_out.rivals import base_rate, logistic
from rocksteady.risk.calibration.held_out.scores import NAMES, Scores, scores_of

RULES = ("calibrated", "logistic", "base rate")
REPEATS = 10
"""Random choices of the training groups at each size."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Trial:
    """All that scores need: what draws and measures make of the tests.

    Attributes
    ----------
    evidence
        Evidence of each object, each test seen from the other groups of its session.
    marginal
        The same of tests each seen alone, for few groups.
    codes, objects
        Number of the group and of the object of each test, shape (tests,).
    fell
        Outcome, nan where it is not known, shape (tests,).
    measures
        Intensity measures, shape (tests, measures).
    temper
        A number, or None for that with the best score among the training tests.
    recalibrate
        Whether predictions are recalibrated; None where that helps.
    """

    evidence: Sequence[Evidence]
    marginal: Sequence[Evidence]
    codes: Integers
    objects: Integers
    fell: Floats
    measures: Floats
    temper: float | None
    recalibrate: bool | None = None


def best_temper(evidence: Sequence[Evidence], codes: Integers, fell: Floats) -> float:
    """Return the temper that the held-out log score of the groups prefers."""
    scores = np.zeros((len(LADDER), int(codes.max()) + 1))
    known = np.isfinite(fell)
    for row, temper in enumerate(LADDER):
        p = hold_out(evidence, codes, temper, ends=False).p[known]
        happened = np.where(fell[known] > 0.0, p, 1.0 - p)
        np.add.at(scores[row], codes[known], np.log(np.maximum(happened, 1e-12)))
    return LADDER[preferred(scores[:, np.unique(codes[known])])]


def learning_curve(trial: Trial, *, seed: int) -> list[dict[str, Any]]:
    """Return scores of tests that were not used, by the number of groups that were.

    Sizes double from 1.  Training groups are drawn at random, ten times at each size; the temper is
    chosen among them alone.

    Returns
    -------
    list
        For each size `groups`, `tests` (mean number of the training), and the `Scores` of
        "calibrated", "logistic" and "base rate": means of the ten, with their 5 and 95 %.
    """
    names = np.unique(trial.codes)
    sizes = [2**k for k in range(12) if 2**k < len(names)]
    rng = np.random.default_rng([seed, 5])
    rows = []
    for size in sizes:
        parts = []
        for _ in range(REPEATS):
            train = np.isin(trial.codes, rng.choice(names, size=size, replace=False))
            result = _once(trial, train)
            if result:
                parts.append((float((train & np.isfinite(trial.fell)).sum()), result))
        if parts:
            row: dict[str, Any] = {"groups": size, "tests": float(np.mean([n for n, _ in parts]))}
            row |= {name: _mean([part[name] for _, part in parts]) for name in RULES}
            rows.append(row)
    return rows


def _mean(parts: Sequence[Scores]) -> Scores:
    """Return the mean of each score, with the 5 and 95 % of the parts as its ends."""
    means: dict[str, tuple[float, float, float]] = {}
    for key in NAMES:
        values = np.array([getattr(part, key)[0] for part in parts])
        values = values[np.isfinite(values)]
        low, high = np.quantile(values, [0.05, 0.95]) if len(values) else (np.nan, np.nan)
        mean = float(values.mean()) if len(values) else np.nan
        means[key] = (mean, float(low), float(high))
    tests = round(float(np.mean([part.tests for part in parts])))
    groups = round(float(np.mean([part.groups for part in parts])))
    return Scores(**means, tests=tests, groups=groups)


def _once(trial: Trial, train: Bools) -> dict[str, Scores]:
    """Return scores of the other tests; none where no outcome of them is known."""
    scored = ~train & np.isfinite(trial.fell)
    if not scored.any():
        return {}
    temper = trial.temper
    if temper is None:
        inside = [_of_tests(each, train) for each in trial.marginal]
        # Numbers of the groups stay; of tests that are left out nothing is scored.
        fell = np.where(train, trial.fell, np.nan)
        temper = best_temper([each for each in inside if len(each.tests)], trial.codes, fell)
    p = np.full(len(train), np.nan)
    for each in trial.marginal:
        given = each.log_likelihood[:, train[each.tests]].sum(axis=1)
        weights = normalised((each.base + temper * given)[:, np.newaxis])[:, 0]
        p[each.tests] = weights @ each.share
    rules = (
        p,
        logistic(trial.measures, trial.fell, train),
        base_rate(trial.fell, trial.objects, train),
    )
    codes = np.unique(trial.codes[scored], return_inverse=True)[1]
    fell = trial.fell[scored]
    return {
        name: scores_of(values[scored], fell, codes, replicates=0)
        for name, values in zip(RULES, rules, strict=True)
    }


def _of_tests(each: Evidence, kept: Bools) -> Evidence:
    """Return what draws make of some of the tests."""
    mask = kept[each.tests]
    return replace(
        each,
        log_likelihood=each.log_likelihood[:, mask],
        share=each.share[:, mask],
        tests=each.tests[mask],
        total=None,
        sessions=None,
    )
