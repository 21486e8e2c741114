"""What a calibrated block has to beat, a logistic on intensity measures, and both together."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from rocksteady.arrays import Bools, Floats, Integers
from rocksteady.kernels.elementary.arrays import log, tan
from rocksteady.risk.calibration.sampler.exact import rounded
from rocksteady.risk.calibration.sampler.logistic import DESIGN_BITS, fit_logistics, probability
from rocksteady.risk.observations.object_prior import ObjectPrior
from rocksteady.risk.observations.shaking_test import ShakingTest
from rocksteady.seismic.measures.intensity import compute_measures
from rocksteady.seismic.measures.response_spectrum import compute_response_spectrum

PERIODS_S = (0.15, 0.25, 0.4, 0.6, 0.9, 1.3, 2.0, 3.0)
"""Of the spectral ordinates."""
POWERS = (1.0, 1.0, 1.0, 2.0, *(1.0 for _ in PERIODS_S), 0.0, 0.0)
"""Powers of the gain in the measures."""
RIDGES = (0.1, 0.3, 1.0, 3.0, 10.0, 30.0)
"""Precisions of a slope over a standard deviation of its measure, among which one is chosen."""
INNER = 4
"""Folds of the training groups in which the ridge is chosen."""
SUREST = 5.3
"""Largest log odds of the logistic: of 200 to 1."""
STACKED = (0.0, 1.0, 0.0)
"""Intercept and slopes of block and logistic where tests say nothing: the block alone."""
LEAST_SLOPE = 0.05
"""Of the block: what it thinks likelier stays likelier.  That of the logistic is 0 at least."""
PRECISION, FEW = 16.0, 100.0
"""Of these, from so many tests on; of fewer it grows as their number falls."""


def measures_of(tests: Sequence[ShakingTest], objects: Mapping[str, ObjectPrior]) -> Floats:
    """Return logarithms of the measures of each test, shape (tests, 14) or (tests, 15).

    PGA, PGV, cumulative absolute velocity, Arias intensity and eight spectral ordinates (5 %), each
    with the gain of the test, significant duration and mean period; of several objects also the
    slenderness of the outline.
    """
    courses: dict[int, Floats] = {}
    rows = []
    for test in tests:
        if id(test.record) not in courses:
            each = compute_measures(test.record)
            psa = compute_response_spectrum(test.record, PERIODS_S).pseudo_acceleration_m_s2
            course = [each.pga_m_s2, each.pgv_m_s, each.cav_m_s, each.arias_m_s, *psa]
            course += [each.significant_5_95_s, each.mean_period_s]
            courses[id(test.record)] = log(np.maximum(np.array(course), 1e-9))
        rows.append(courses[id(test.record)] + log(test.gain) * np.array(POWERS))
    measures = np.array(rows)
    if len(objects) > 1:
        lean = {name: log(tan(given.outline_alpha_rad)) for name, given in objects.items()}
        measures = np.column_stack([measures, [lean[test.object] for test in tests]])
    return measures


def base_rate(fell: Floats, objects: Integers, train: Bools) -> Floats:
    """Return the share of an object's tests that fell, (k + 1)/(n + 2), for each test."""
    rates = np.full(len(fell), 0.5)
    for number in np.unique(objects):
        rows = objects == number
        seen = fell[rows & train & np.isfinite(fell)]
        rates[rows] = (seen.sum() + 1.0) / (len(seen) + 2.0)
    return rates


@dataclass(frozen=True, kw_only=True)
class LogisticCurve:
    """A logistic curve on intensity measures.

    Attributes
    ----------
    middle, width, slopes
        Centre, scale and slope of each measure.
    intercept
        Log odds at the centres.
    """

    middle: tuple[float, ...]
    width: tuple[float, ...]
    slopes: tuple[float, ...]
    intercept: float

    def of(self, measures: Floats) -> Floats:
        """Return the probability of a fall of each row of measures."""
        z = np.clip((measures - np.array(self.middle)) / np.array(self.width), -8.0, 8.0)
        odds = self.intercept + rounded(z, DESIGN_BITS) @ np.array(self.slopes)
        return probability(np.clip(odds, -SUREST, SUREST))


@dataclass(frozen=True, kw_only=True)
class Stack:
    """Log odds of a fall: intercept + block * logit p(block) + logistic * logit p(logistic)."""

    intercept: float = STACKED[0]
    block: float = STACKED[1]
    logistic: float = STACKED[2]

    def of(self, block: Floats, logistic: Floats) -> Floats:
        """Return probabilities by block and logistic together."""
        line = np.array([self.intercept, self.block, self.logistic])
        return probability((_odds(block, logistic) * line).sum(axis=-1))


def logistic_of(measures: Floats, fell: Floats, codes: Integers, trains: Bools) -> Floats:
    """Return the probability of a fall of each test, by curves fitted to training tests.

    The ridge is chosen by the log score in folds of the training groups.

    Parameters
    ----------
    measures, fell, codes
        Measures, outcomes (nan of unknown ones) and groups of the tests.
    trains
        Training tests of each curve, shape (curves, tests).

    Returns
    -------
    ndarray
        Shape (curves, tests).
    """
    design, _, _ = _design(measures)
    at = _fit(design, fell, codes, trains)
    return probability(np.clip(at @ design.T, -SUREST, SUREST))


def logistic_curve(measures: Floats, fell: Floats, codes: Integers) -> LogisticCurve:
    """Return the curve that is fitted to all tests."""
    design, middle, width = _design(measures)
    (at,) = _fit(design, fell, codes, np.ones((1, len(fell)), dtype=bool)).tolist()
    return LogisticCurve(
        middle=tuple(middle.tolist()),
        width=tuple(width.tolist()),
        slopes=tuple(at[1:]),
        intercept=at[0],
    )


def stacks_of(block: Floats, logistic: Floats, fell: Floats, trains: Bools) -> list[Stack]:
    """Return how block and logistic are put together, by each of several sets of training tests.

    Log odds of both are the measures of a logistic regression whose prior is the block alone,
    stronger below 100 tests.

    Parameters
    ----------
    block, logistic
        Held-out probabilities, shape (tests,).
    fell
        Outcomes, nan of unknown ones.
    trains
        Shape (stacks, tests).
    """
    known = np.isfinite(fell)
    counts = (trains & known).sum(axis=1)
    strength = PRECISION * np.maximum(1.0, FEW / np.maximum(counts, 1))
    at, _ = fit_logistics(
        _odds(block, logistic),
        np.broadcast_to(np.nan_to_num(fell), trains.shape),
        (trains & known).astype(np.float64),
        precision=np.broadcast_to(strength[:, np.newaxis], (len(trains), 3)),
        mean=np.array(STACKED),
        steps=40,
        close=1e-3,
    )
    at[:, 1:] = np.maximum(at[:, 1:], (LEAST_SLOPE, 0.0))
    return [Stack(intercept=a, block=b, logistic=c) for a, b, c in at.tolist()]


def _odds(block: Floats, logistic: Floats) -> Floats:
    """Return rows of 1 and the log odds of both."""
    p = np.clip(np.stack([block, logistic], axis=-1), 1e-3, 1.0 - 1e-3)
    odds = log(p / (1.0 - p))
    return np.concatenate([np.ones((*odds.shape[:-1], 1)), odds], axis=-1)


def _design(measures: Floats) -> tuple[Floats, Floats, Floats]:
    """Return 1 and measures in standard deviations, with their centres and scales."""
    middle, width = measures.mean(axis=0), measures.std(axis=0)
    middle, width = rounded(middle, 20), rounded(width, 20)
    width = np.where(width > 1e-4, width, 1.0)
    z = np.clip((measures - middle) / width, -8.0, 8.0)
    return rounded(np.column_stack([np.ones(len(z)), z]), DESIGN_BITS), middle, width


def _fit(design: Floats, fell: Floats, codes: Integers, trains: Bools) -> Floats:
    """Return coefficients of curves with their ridges chosen, shape (curves, coefficients)."""
    known, size = np.isfinite(fell), design.shape[1]
    outcome = np.nan_to_num(fell)
    folds = np.array(
        [np.unique(np.where(train, codes, -1), return_inverse=True)[1] % INNER for train in trains]
    )

    def fitted(weight: Bools, ridge: Floats) -> Floats:
        precision = np.repeat(ridge[:, np.newaxis], size, axis=1)
        precision[:, 0] = 0.01
        return fit_logistics(
            design,
            np.broadcast_to(outcome, weight.shape),
            (weight & known).astype(np.float64),
            precision=precision,
            mean=np.zeros(size),
            steps=40,
            close=1e-3,
        )[0]

    # Of each curve, fold and ridge a regression, all at once.
    inner = np.arange(INNER)[:, np.newaxis, np.newaxis]
    train, asked = trains & (folds != inner), trains & (folds == inner) & known
    weight = np.repeat(train.reshape(-1, len(fell)), len(RIDGES), axis=0)
    at = fitted(weight, np.tile(RIDGES, len(weight) // len(RIDGES)))
    p = probability(np.clip(at @ design.T, -SUREST, SUREST))
    happened = log(np.where(outcome > 0.5, p, 1.0 - p)).reshape(*train.shape[:2], len(RIDGES), -1)
    scores = (happened * asked[:, :, np.newaxis]).sum(axis=(0, 3))
    chosen = np.argmax(np.rint(scores * 2.0**20), axis=1)
    return fitted(trains, np.array(RIDGES)[chosen])
