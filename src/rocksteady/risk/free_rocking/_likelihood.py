"""Restricted likelihood of logarithms of velocities: impacts that scatter, peaks that err."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

ROUNDING = 1e-14
"""Standard deviation [1] of what rounding leaves in a logarithm."""

FALL = 1.3528
"""Fall of the log-likelihood at the ends of an interval of 90 %: half of chi-square's 2.7055."""

STEPS = 12


@dataclass(frozen=True, kw_only=True, eq=False)
class Steps:
    """Steps of ln(v) from peak to peak, in a row over all releases.

    Attributes
    ----------
    change
        ``ln(v_after/v_before)`` less the logarithm of Housner's value, shape (steps,).
    design
        Impacts of each kind in the step, shape (steps, kinds).
    impacts
        Number of impacts in the step, shape (steps,).
    before, after
        Standard deviation of ln(v) by the measuring error of the peaks at its ends; of 1 rad where
        the error is to be estimated.
    follows
        Whether a step begins with the peak that the one before it ends with.
    """

    change: Floats
    design: Floats
    impacts: Floats
    before: Floats
    after: Floats
    follows: NDArray[np.bool_]


@dataclass(frozen=True, kw_only=True, eq=False)
class Estimate:
    """Logarithms of factors on Housner's value, and what scatters.

    Attributes
    ----------
    factor, covariance
        Shapes (kinds,) and (kinds, kinds).
    scatter, scatter_interval
        Standard deviation of ln(e) from impact to impact, and its interval of 90 %.
    error
        Factor on the standard deviations of `Steps`: the measuring error where it is estimated.
    residuals
        Each step less its expectation over its standard deviation.
    """

    factor: Floats
    covariance: Floats
    scatter: float
    scatter_interval: tuple[float, float]
    error: float
    residuals: Floats


def estimate(steps: Steps, *, error: float | None) -> Estimate:
    """Return the estimate of largest restricted likelihood.

    Parameters
    ----------
    steps
        More of them than kinds.
    error
        Factor on the measuring errors, 1 where they are known; None to estimate it.
    """
    plain = np.linalg.lstsq(steps.design, steps.change, rcond=None)[0]
    left = steps.change - steps.design @ plain
    free = max(1, steps.change.size - steps.design.shape[1])
    spread = math.sqrt(float(left @ left) / free)
    if spread < 100.0 * ROUNDING:
        return _of(steps, 0.0, 0.0 if error is None else error, (0.0, 0.0))
    typical = math.sqrt(float(np.mean(steps.before**2 + steps.after**2)))
    errors = _trials(spread / typical) if error is None else [error]

    @lru_cache(maxsize=4096)
    def fit(scatter: float) -> tuple[float, float]:
        """Return the least deviance of a scatter, and the measuring error there."""
        values = [_deviance(steps, scatter, each) for each in errors]
        if error is not None:
            return values[0], error
        return _refined(lambda each: _deviance(steps, scatter, each), errors, values)

    scatters = _trials(spread)
    values = [fit(each)[0] for each in scatters]
    least, best = _refined(lambda each: fit(each)[0], scatters, values)
    ends = tuple(_crossing(lambda each: fit(each)[0], best, least, sign) for sign in (-1, 1))
    return _of(steps, best, fit(best)[1], (ends[0], ends[1]))


def _trials(scale: float) -> list[float]:
    """Return standard deviations to begin with: none, and some about a scale."""
    return [0.0, *(scale * np.geomspace(0.02, 2.0, STEPS)).tolist()]


def _refined(
    deviance: Callable[[float], float], at: list[float], values: list[float]
) -> tuple[float, float]:
    """Return the least deviance near the lowest of some values, and where it is."""
    from scipy.optimize import minimize_scalar

    place = int(np.argmin(values))
    if place == 0:
        return values[0], at[0]
    ends = at[max(place - 1, 1)], at[min(place + 1, len(at) - 1)]
    if ends[0] == at[place]:
        ends = 0.2 * at[place], ends[1]
    found = minimize_scalar(
        deviance, bounds=ends, method="bounded", options={"xatol": 1e-4 * at[1]}
    )
    return min((float(found.fun), float(found.x)), (values[place], at[place]))


def _crossing(deviance: Callable[[float], float], best: float, least: float, sign: int) -> float:
    """Return where the log-likelihood has fallen by as much as at the end of an interval."""
    from scipy.optimize import brentq

    def fall(at: float) -> float:
        return 0.5 * (deviance(at) - least) - FALL

    if sign < 0:
        return 0.0 if best == 0.0 or fall(0.0) <= 0.0 else float(brentq(fall, 0.0, best, rtol=1e-4))
    end = max(best, 1e-6)
    while fall(end) <= 0.0 and end < 1e3:
        end *= 2.0
    return float(brentq(fall, best, end, rtol=1e-4)) if end < 1e3 else math.inf


def _whitened(steps: Steps, scatter: float, error: float) -> tuple[Floats, Floats, Floats]:
    """Return the diagonal of the covariance's root, and steps and design in units of it.

    The covariance of the steps has one line beside its diagonal, so that its root has too.
    """
    before, after = error * steps.before, error * steps.after
    diagonal = scatter * scatter * steps.impacts + before**2 + after**2 + ROUNDING**2
    beside = np.where(steps.follows, -(before**2), 0.0)
    root = np.empty_like(diagonal)
    joined = np.column_stack([steps.change, steps.design])
    factor = 0.0
    lines = diagonal.tolist()
    sides = beside.tolist()
    factors = []
    for place, value in enumerate(lines):
        factor = sides[place] / factor if place and sides[place] else 0.0
        factors.append(factor)
        factor = math.sqrt(max(value - factor * factor, ROUNDING**2))
        root[place] = factor
    for place, share in enumerate(factors):
        if share:
            joined[place] -= share * joined[place - 1]
        joined[place] /= root[place]
    return root, joined[:, 0], joined[:, 1:]


def _deviance(steps: Steps, scatter: float, error: float) -> float:
    """Return minus twice the restricted log-likelihood, but for a constant."""
    root, change, design = _whitened(steps, scatter, error)
    information = design.T @ design
    factor = np.linalg.solve(information, design.T @ change)
    left = change - design @ factor
    return float(2.0 * np.log(root).sum() + np.linalg.slogdet(information)[1] + (left * left).sum())


def solved(steps: Steps, scatter: float, error: float) -> tuple[Floats, Floats]:
    """Return the factors of generalised least squares, and their covariance."""
    _, change, design = _whitened(steps, scatter, error)
    covariance = np.linalg.inv(design.T @ design)
    return covariance @ (design.T @ change), covariance


def _of(steps: Steps, scatter: float, error: float, interval: tuple[float, float]) -> Estimate:
    """Return the estimate of a scatter and a measuring error."""
    factor, covariance = solved(steps, scatter, error)
    deviation = np.sqrt(
        scatter * scatter * steps.impacts
        + (error * steps.before) ** 2
        + (error * steps.after) ** 2
        + ROUNDING**2
    )
    return Estimate(
        factor=factor,
        covariance=covariance,
        scatter=scatter,
        scatter_interval=interval,
        error=error,
        residuals=(steps.change - steps.design @ factor) / deviation,
    )
