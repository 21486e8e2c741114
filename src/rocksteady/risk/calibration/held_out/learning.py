"""Learning curve: how good predictions from few groups are."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from rocksteady.arrays import Bools, Floats, Integers
from rocksteady.risk.calibration.held_out.leaving_out import Case, Draws, blank, fill, predict_cases
from rocksteady.risk.calibration.held_out.rivals import base_rate, logistic_of
from rocksteady.risk.calibration.held_out.scores import score_values
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
        For each size `groups`, `tests` (mean number of the training), and means of the ten of each
        score of each rule, as "block brier".
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
    known = np.isfinite(trial.fell)
    for place, size in enumerate(sizes):
        parts: list[dict[str, float]] = []
        for number in range(place * REPEATS, (place + 1) * REPEATS):
            train = trains[number]
            asked = ~train & known
            if not asked.any():
                continue
            rates = base_rate(trial.fell, trial.objects, train)
            part = {"tests": float((train & known).sum())}
            for name, p in zip(RULES, (blocks[number], curves[number], rates), strict=True):
                values = score_values(p[asked], trial.fell[asked])
                part |= {f"{name} {score}": value for score, value in values.items()}
            parts.append(part)
        if parts:
            row = {key: _mean([part[key] for part in parts]) for key in parts[0]}
            rows.append({"groups": size} | row)
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


def _mean(values: Sequence[float]) -> float:
    """Return the mean of the numbers among values: F1 is none without falls."""
    numbers = [value for value in values if np.isfinite(value)]
    return float(np.mean(numbers)) if numbers else np.nan
