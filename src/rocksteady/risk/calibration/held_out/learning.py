"""Learning curve: how good predictions from few groups are."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from rocksteady.arrays import Bools, Floats, Integers
from rocksteady.risk.calibration.held_out.leaving_out import Case, Draws, blank, fill, predict_cases
from rocksteady.risk.calibration.held_out.rivals import base_rate, logistic_of
from rocksteady.risk.calibration.held_out.scores import NAMES, Scores, scores_of
from rocksteady.risk.calibration.sampler.outcome_likelihood import Likelihood
from rocksteady.risk.calibration.sampler.rounds import ROUGH, Fit
from rocksteady.risk.calibration.sampler.surfaces import Surfaces

RULES = ("block", "logistic", "base rate")
TOGETHER = 20
"""Training sets that are predicted from at once: of hundreds of tests they take much memory."""
REPEATS = 10
"""Random choices of the training groups at each size."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Trial:
    """All that scores need.

    Attributes
    ----------
    fits, tests
        Fit of each object, and the numbers of its tests among all.
    codes, objects
        Number of the group and of the object of each test, shape (tests,).
    fell
        Outcome, nan where it is not known, shape (tests,).
    measures
        Intensity measures, shape (tests, measures).
    seed
        Of the choices of groups and of the bootstrap.
    """

    fits: Sequence[Fit]
    tests: Sequence[Integers]
    codes: Integers
    objects: Integers
    fell: Floats
    measures: Floats
    seed: int


def learning_curve(trial: Trial) -> list[dict[str, Any]]:
    """Return scores of tests that were not used, by the number of groups that were.

    Sizes double from 1.  Training groups are drawn at random, ten times at each size.  Draws of all
    rounds are weighted on surfaces that are fitted to all runs, wherever they lie: a few tests
    leave a wide posterior.

    Returns
    -------
    list
        For each size `groups`, `tests` (mean number of the training), and the `Scores` of "block",
        "logistic" and "base rate": means of the ten, with their 5 and 95 %.
    """
    names = np.unique(trial.codes)
    rng = np.random.default_rng([trial.seed, 5])
    sizes = [2**k for k in range(12) if 2**k < len(names)]
    trains = [
        np.isin(trial.codes, rng.choice(names, size=size, replace=False))
        for size in sizes
        for _ in range(REPEATS)
    ]
    blocks = _predictions(trial, trains)
    curves = logistic_of(trial.measures, trial.fell, trial.codes, np.array(trains))
    rows = []
    for place, size in enumerate(sizes):
        parts: list[dict[str, Scores]] = []
        counts = []
        for number in range(place * REPEATS, (place + 1) * REPEATS):
            train, known = trains[number], np.isfinite(trial.fell)
            asked = ~train & known
            if not asked.any():
                continue
            groups = np.unique(trial.codes[asked], return_inverse=True)[1]
            rates = base_rate(trial.fell, trial.objects, train)
            parts.append(
                {
                    name: scores_of(p[asked], trial.fell[asked], groups, replicates=0)
                    for name, p in zip(RULES, (blocks[number], curves[number], rates), strict=True)
                }
            )
            counts.append(float((train & known).sum()))
        if parts:
            row: dict[str, Any] = {"groups": size, "tests": float(np.mean(counts))}
            rows.append(row | {name: _mean([part[name] for part in parts]) for name in RULES})
    return rows


def _predictions(trial: Trial, trains: Sequence[Bools]) -> list[Floats]:
    """Return P(fall) of the tests outside of each training set, nan inside."""
    held = [blank(len(trial.codes)) for _ in trains]
    for fit, places in zip(trial.fits, trial.tests, strict=True):
        bench, every = fit.bench, np.ones(len(fit.bench.gain))
        draws = Draws(
            likelihood=Likelihood(bench, fit.likelihood.noise, *ROUGH),
            surfaces=Surfaces(bench.features, bench.gain, bench.fell, bench.peaks, every),
            features=fit.features,
            base=fit.base,
        )
        outside = [np.flatnonzero(~train[places]) for train in trains]
        used = [number for number, left in enumerate(outside) if len(left)]
        for begin in range(0, len(used), TOGETHER):
            some = used[begin : begin + TOGETHER]
            cases = [Case(left=outside[number], asked=outside[number]) for number in some]
            for number, (part, _) in zip(some, predict_cases(draws, cases), strict=True):
                fill(held[number], places[outside[number]], part)
    return [each.p for each in held]


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
