"""What a calibration has to beat: the base rate, and a logistic curve on intensity measures."""

import math
from collections.abc import Mapping, Sequence

import numpy as np

from rocksteady.arrays import Bools, Floats, Integers
from rocksteady.kernels.elementary.arrays import tan
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.risk.observations.object_prior import ObjectPrior
from rocksteady.risk.observations.shaking_test import ShakingTest
from rocksteady.seismic.measures.intensity import Measures, compute_measures

MEASURES = (
    "ln(gain PGA/(g tan alpha))",
    "ln(gain p PGV/(g tan alpha))",
    "ln(PGV/PGA)",
    "ln(significant duration, 5-95 %)",
    "ln(gain p^2 PGD/(g tan alpha))",
    "ln(gain^2 Arias intensity)",
    "ln(gain CAV)",
    "ln(gain RMS)",
    "ln(gain Housner intensity)",
    "ln(significant duration, 5-75 %)",
    "ln(mean period)",
    "ln(PGD/PGV)",
    "ln(g tan alpha)",
    "ln p",
)
RIDGE = 1.0 / 0.5**2
"""Precision of a slope over a standard deviation of its measure: its prior has the scale 0.5."""
STEPS = 50
LEAST = 1e-9


def measures_of(tests: Sequence[ShakingTest], objects: Mapping[str, ObjectPrior]) -> Floats:
    """Return the measures of each test, shape (tests, 14).

    alpha is that of the object's outline, and p that of the middle of its prior: what is known
    before any test.
    """
    courses: dict[int, Measures] = {}
    scales = {name: _scale_of(given) for name, given in objects.items()}
    rows = []
    for test in tests:
        if id(test.record) not in courses:
            courses[id(test.record)] = compute_measures(test.record)
        of = courses[id(test.record)]
        gain, (uplift, rate) = test.gain, scales[test.object]
        measures = (
            gain * of.pga_m_s2 / uplift,
            gain * rate * of.pgv_m_s / uplift,
            of.pgv_m_s / max(of.pga_m_s2, LEAST),
            of.significant_5_95_s,
            gain * rate**2 * of.pgd_m / uplift,
            gain**2 * of.arias_m_s,
            gain * of.cav_m_s,
            gain * of.rms_m_s2,
            gain * of.housner_intensity_m,
            of.significant_5_75_s,
            of.mean_period_s,
            of.pgd_m / max(of.pgv_m_s, LEAST),
            uplift,
            rate,
        )
        rows.append([math.log(max(measure, LEAST)) for measure in measures])
    return np.array(rows)


def _scale_of(given: ObjectPrior) -> tuple[float, float]:
    """Return the uplift acceleration of the outline [m/s^2] and p of the middle [rad/s]."""
    middle = given.draw(np.full((1, len(given.parameters)), 0.5))
    side = given.sides(middle)[0]
    return STANDARD_GRAVITY * float(tan(given.outline_alpha_rad)), float(side[:, 2].mean())


def base_rate(fell: Floats, objects: Integers, train: Bools) -> Floats:
    """Return the share of an object's tests that fell, (k + 1)/(n + 2), for each test."""
    rates = np.full(len(fell), 0.5)
    for number in np.unique(objects):
        rows = objects == number
        seen = fell[rows & train & np.isfinite(fell)]
        rates[rows] = (seen.sum() + 1.0) / (len(seen) + 2.0)
    return rates


def fit_logistic(measures: Floats, fell: Floats) -> tuple[Floats, Floats, Floats]:
    """Return centre, scale and coefficients of a logistic curve with a ridge on its slopes.

    Measures are taken in standard deviations, as in [1], and each slope has a normal prior of scale
    0.5: measures are many, and hang together.  The constant has none except a tenth of a trial of
    each kind, so that outcomes of one kind have a fit.

    References
    ----------
    .. [1] A. Gelman and others, Annals of Applied Statistics 2, 1360-1383 (2008).
    """
    centre, scale = measures.mean(axis=0), measures.std(axis=0)
    scale = np.where(scale > 1e-9, scale, 1.0)
    design = np.column_stack([np.ones(len(fell)), (measures - centre) / scale])
    added = np.zeros((2, design.shape[1]))
    added[:, 0] = 1.0
    rows, target = np.vstack([design, added]), np.append(fell, [1.0, 0.0])
    trials = np.append(np.ones(len(fell)), [0.1, 0.1])
    ridge = np.full(design.shape[1], RIDGE)
    ridge[0] = 0.0
    at = np.zeros(design.shape[1])
    for _ in range(STEPS):
        p = 1.0 / (1.0 + np.exp(-np.clip(rows @ at, -30.0, 30.0)))
        slope = rows.T @ (trials * (target - p)) - ridge * at
        bend = (rows.T * (trials * p * (1.0 - p))) @ rows + np.diag(ridge + 1e-9)
        step = np.linalg.solve(bend, slope)
        largest = float(np.abs(step).max())
        at = at + step * min(1.0, 3.0 / largest) if largest > 0.0 else at
        if largest < 1e-9:
            break
    return centre, scale, at


def logistic(measures: Floats, fell: Floats, train: Bools) -> Floats:
    """Return the probability of a fall of each test, by a curve fitted to the training tests."""
    used = train & np.isfinite(fell)
    if not used.any():
        return np.full(len(fell), 0.5)
    centre, scale, at = fit_logistic(measures[used], fell[used])
    odds = at[0] + (measures - centre) / scale @ at[1:]
    p: Floats = 1.0 / (1.0 + np.exp(-np.clip(odds, -30.0, 30.0)))
    return p


def out_of_group(
    measures: Floats, fell: Floats, objects: Integers, codes: Integers
) -> tuple[Floats, Floats]:
    """Return base rate and logistic curve of each test from the tests of other groups."""
    rates, curves = np.empty(len(fell)), np.empty(len(fell))
    for group in np.unique(codes):
        held = codes == group
        rates[held] = base_rate(fell, objects, ~held)[held]
        curves[held] = logistic(measures, fell, ~held)[held]
    return rates, curves
