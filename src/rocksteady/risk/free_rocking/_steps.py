"""Restricted likelihood of logarithms of velocities: impacts that scatter, peaks that err."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats

ROUNDING = 1e-14
"""Standard deviation [1] of what rounding leaves in a logarithm."""

FALL = 1.3528
"""Fall of the log-likelihood at the ends of an interval of 90 %: half of chi-square's 2.7055."""

SHARE = 0.95
"""Probability below the upper end of such an interval."""

STEPS = 12
POINTS = 40
"""Scatters that an interval of the factors is spread over."""


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
    factor, deviation
        Shape (kinds,); the standard deviation allows for the scatter being an estimate.
    interval
        Interval of 90 %, shape (kinds, 2).
    scatter, scatter_interval
        Standard deviation of ln(e) from impact to impact, and its interval of 90 %.
    error
        Factor on the standard deviations of `Steps`: the measuring error where it is estimated.
    residuals
        Each step less its expectation over its standard deviation.
    """

    factor: Floats
    deviation: Floats
    interval: Floats
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
    low, high = (_crossing(lambda each: fit(each)[0], best, least, sign) for sign in (-1, 1))
    result = _of(steps, best, fit(best)[1], (low, high))
    return _spread_out(result, steps, fit, least, spread) if free >= 2 else result


@np.errstate(under="ignore")  # 0 is the weight of what cannot be
def _spread_out(
    estimate: Estimate,
    steps: Steps,
    fit: Callable[[float], tuple[float, float]],
    least: float,
    spread: float,
) -> Estimate:
    """Return the estimate with errors that allow for the uncertainty of the scatter.

    Given the scatter the factors are normal; the mixture of these has the restricted likelihood as
    its weight, over scatters that are all as likely before.
    """
    from scipy.optimize import brentq
    from scipy.special import ndtr

    top = max(estimate.scatter, spread)
    while fit(top)[0] - least < 20.0 and top < 1e3 * spread:
        top *= 1.5
    scatters = np.concatenate([[0.0], np.geomspace(0.02 * spread, top, POINTS)])
    fits = [fit(each) for each in scatters.tolist()]
    weights = np.exp(-0.5 * (np.array([each for each, _ in fits]) - least))
    gaps = np.diff(scatters)
    weights *= 0.5 * (np.append(gaps, 0.0) + np.insert(gaps, 0, 0.0))
    weights /= weights.sum()
    pairs = [
        solved(steps, at, error) for at, (_, error) in zip(scatters.tolist(), fits, strict=True)
    ]
    factors = np.array([factor for factor, _ in pairs])
    deviations = np.sqrt([np.diag(covariance) for _, covariance in pairs])
    whole = np.sqrt(weights @ (deviations**2 + (factors - estimate.factor) ** 2))
    ends = np.empty((len(whole), 2))
    for kind, width in enumerate(whole.tolist()):
        middle, each = factors[:, kind], deviations[:, kind]
        for end, share in enumerate((1.0 - SHARE, SHARE)):

            def short(
                at: float, share: float = share, m: Floats = middle, d: Floats = each
            ) -> float:
                return float(weights @ ndtr((at - m) / d)) - share

            centre, reach = float(estimate.factor[kind]), 10.0 * width
            ends[kind, end] = brentq(short, centre - reach, centre + reach)
    return replace(estimate, deviation=whole, interval=ends)


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
    result = minimize_scalar(
        deviance, bounds=ends, method="bounded", options={"xatol": 1e-4 * at[1]}
    )
    return min((float(result.fun), float(result.x)), (values[place], at[place]))


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


def errors_of(steps: Steps, estimate: Estimate) -> tuple[Floats, Floats]:
    """Return the expected errors of ln(v) before and after each step, given all steps."""
    root, shares, change, design = _whitened(steps, estimate.scatter, estimate.error)
    pull = change - design @ estimate.factor
    for place in range(len(pull) - 1, -1, -1):  # the other half of the solution
        if place + 1 < len(pull):
            pull[place] -= shares[place + 1] * pull[place + 1]
        pull[place] /= root[place]
    earlier = np.where(steps.follows, np.concatenate([[0.0], pull[:-1]]), 0.0)
    goes_on = np.concatenate([steps.follows[1:], [False]])
    later = np.where(goes_on, np.concatenate([pull[1:], [0.0]]), 0.0)
    before, after = (estimate.error * steps.before) ** 2, (estimate.error * steps.after) ** 2
    return before * (earlier - pull), after * (pull - later)


def _whitened(
    steps: Steps, scatter: float, error: float
) -> tuple[Floats, Sequence[float], Floats, Floats]:
    """Return the covariance's root, its diagonal and what is beside, and what is in units of it.

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
    # Lists: a row has two or three numbers, on which array operations take ten times as long.
    rows, roots = joined.tolist(), root.tolist()
    for place, share in enumerate(factors):
        row = rows[place]
        if share:
            row = [value - share * last for value, last in zip(row, rows[place - 1], strict=True)]
        rows[place] = [value / roots[place] for value in row]
    joined = np.array(rows)
    return root, factors, joined[:, 0], joined[:, 1:]


def _deviance(steps: Steps, scatter: float, error: float) -> float:
    """Return minus twice the restricted log-likelihood, up to a constant."""
    root, _, change, design = _whitened(steps, scatter, error)
    information = design.T @ design
    factor = np.linalg.solve(information, design.T @ change)
    left = change - design @ factor
    return float(2.0 * np.log(root).sum() + np.linalg.slogdet(information)[1] + (left * left).sum())


def solved(steps: Steps, scatter: float, error: float) -> tuple[Floats, Floats]:
    """Return the factors of generalised least squares, and their covariance."""
    _, _, change, design = _whitened(steps, scatter, error)
    covariance: Floats = np.asarray(np.linalg.inv(design.T @ design), dtype=np.float64)
    return covariance @ (design.T @ change), covariance


def _of(steps: Steps, scatter: float, error: float, interval: tuple[float, float]) -> Estimate:
    """Return the estimate of a scatter and a measuring error."""
    from scipy.special import stdtrit

    factor, covariance = solved(steps, scatter, error)
    free = len(steps.change) - len(factor)
    reach = float(stdtrit(free, SHARE)) if free > 0 else math.inf
    errors = np.sqrt(np.diag(covariance))
    deviation = np.sqrt(
        scatter * scatter * steps.impacts
        + (error * steps.before) ** 2
        + (error * steps.after) ** 2
        + ROUNDING**2
    )
    return Estimate(
        factor=factor,
        deviation=errors,
        interval=factor[:, np.newaxis] + np.outer(errors, [-reach, reach]),
        scatter=scatter,
        scatter_interval=interval,
        error=error,
        residuals=(steps.change - steps.design @ factor) / deviation,
    )
