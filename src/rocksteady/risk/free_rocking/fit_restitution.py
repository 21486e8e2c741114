"""Restitution of a block from the peaks of its measured free rocking."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Annotated

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rocksteady.arrays import Floats
from rocksteady.dynamics.overturning.free_rocking import free_rocking_period
from rocksteady.errors import InputError, ModelError, Words
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.caps import conserving_pair
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import INSIDE
from rocksteady.model.equations import Linear, Model, ModelChoice, chosen_model
from rocksteady.results.numbers import number, plural
from rocksteady.risk.free_rocking._steps import Estimate, Steps, errors_of, estimate, solved
from rocksteady.risk.free_rocking.release import Release
from rocksteady.risk.free_rocking.restitution_fit import (
    Impact,
    RestitutionFit,
    impacts_until,
    peaks_at,
    slopes,
    velocities,
)

LOST = 6.0
"""Peaks below this number of standard deviations of the measuring error are left out."""
FEWEST_FOR_ERROR = 8
"""Steps below which the measuring error is not estimated."""
FEWEST_FOR_TREND = 4
ROUNDS = 2
"""Of the errors of ln(v) at expected peaks."""
CLEAR = 2.0
"""Standard errors from which on a trend, or a growing peak, is remarked on."""
FAR = 0.05
"""Relative difference of measured and computed half periods that is remarked on."""


@checked
def fit_restitution(
    peaks: Annotated[ArrayLike | Release | Sequence[Release], INSIDE],
    block: Block,
    *,
    each_side: bool | None = None,
    model: ModelChoice = None,
) -> RestitutionFit:
    r"""Estimate the restitution from measured peaks of free rocking.

    On a still base a block falls from a peak theta on side i with the energy ``cos(alpha_i -
    theta) - cos(alpha_i)`` (linear model: ``theta (alpha_i - theta/2)``), so that it meets the
    base at ``v = p_i sqrt(2 energy)``; after the impact its velocity is e times that, which is also
    the v of the next peak, on the other side.  Each impact therefore shows ::

        ln(v_{k+1}) - ln(v_k) = ln(e_k),    ln(e_k) = ln(f h_k) + tau z_k,

    with Housner's value h of the impact, its factor f, and a scatter tau from impact to impact.  A
    peak measured with an error of standard deviation sigma has an error of ``sigma (d ln v/d
    theta)`` in ln(v), which enters the step before it and the step after it with opposite signs:
    this separates it from the scatter.  Factors are the generalised least squares for the
    covariance of the steps, tau, and sigma where it is not given, those of largest restricted
    likelihood [1]_; sigma (d ln v/d theta) is that of the peaks which all steps let expect.
    Standard errors and intervals of the factors are those of the mixture over all scatters, with
    the restricted likelihood as weight; the interval of the scatter is by the profile of the
    likelihood.  Of 200 made-up releases of 20 impacts with e = .95, a scatter of 0, .01 and .03,
    and a measuring error of .8, 1.7 and .8 % of the first peak, intervals of 90 % held e in 1.00,
    .94 and .90, and the scatter in .98, .94 and .90.

    Parameters
    ----------
    peaks
        Peaks abs(theta) of successive half cycles [rad], or `Release` objects, of one block let go
        once or several times.
    block
        The block; its own restitution does not count.  One against a wall is refused: the peaks of
        a symmetric block with the restitution of the wall are the same.
    each_side
        Whether each side has its own factor of Housner's value; by default where the sides of the
        block differ and each side's impacts are measured.
    model
        ``"linear"`` or ``"nonlinear"`` (default), the full equations.

    Returns
    -------
    RestitutionFit
        Estimates, errors, scatter, impacts and warnings.

    Raises
    ------
    InputError
        If a peak is above alpha, or fewer than two peaks of every release stand out from the
        measuring error.
    ModelError
        If the block stands against a wall.

    References
    ----------
    .. [1] H. D. Patterson and R. Thompson, Biometrika 58, 545-554 (1971).

    Examples
    --------
    >>> from rocksteady import Block, fit_restitution
    >>> from rocksteady.formulas import free_rocking_peaks
    >>> block = Block.rectangle(width=0.05, height=0.5)
    >>> peaks = block.alpha * free_rocking_peaks(0.6, 0.95, 12, alpha=block.alpha)
    >>> fit = fit_restitution(peaks, block)
    >>> print(f"{fit.restitution[0]:.6f}, {fit.factor[0]:.4f} of Housner's")
    0.950000, 0.9643 of Housner's
    >>> fit.to_small, fit.to_small_housner
    (26, 89)
    """
    if block.one_sided:
        raise ModelError(
            "block",
            Words("stands against a wall"),
            "peaks are of a block that rocks to both sides",
            "give the block without its wall: with equal sides both lose alike, so that the peaks "
            "are the same",
        )
    releases = _releases(peaks)
    equations = chosen_model(model, block)
    rows, left_out = _rows(releases, block, equations)
    given = all(release.sigma_rad is not None for release in releases)
    pair = conserving_pair(block.positive, block.negative, block.gravity, block.cap)
    sound = min(pair) > 0.0
    base = pair if sound else (1.0, 1.0)
    single = [row for row in rows if row.impacts == 1.0]
    two_sided = {row.side for row in single} == {1, -1}
    apart = not block.symmetric and two_sided if each_side is None else each_side
    if apart and not two_sided:
        raise InputError(
            "each_side",
            each_side,
            "no impact of one side was measured alone",
            "give the peaks of both sides, or leave it out",
        )
    steps = _steps(rows, base, apart=apart)
    free = len(rows) - (2 if apart else 1)
    known = given or len(rows) < FEWEST_FOR_ERROR
    error = 1.0 if given else 0.0
    estimated = estimate(steps, error=error if known else None)
    for _ in range(ROUNDS):
        # A peak that was measured too large has too small an error of ln(v): of true peaks none.
        rows = _at_expected_peaks(rows, errors_of(steps, estimated), block, equations)
        steps = _steps(rows, base, apart=apart)
        estimated = estimate(steps, error=error if known else None)
    if not given and estimated.error == 0.0 and not known:
        known = True
    places = (0, 1) if apart else (0, 0)
    factors = tuple(math.exp(estimated.factor[place]) for place in places)
    # Without a step to spare there is no scatter from which an error could follow.
    errors = tuple(float(estimated.deviation[place]) if free > 0 else math.inf for place in places)
    low, high = (np.exp(estimated.interval[list(places), end]) * base for end in (0, 1))
    ratios = factors[0] * base[0], factors[1] * base[1]
    mean = math.sqrt(ratios[0] * ratios[1])
    impacts = _impacts(rows, estimated)
    trend = _trend(rows, impacts, steps, estimated)
    half_periods = _half_periods(releases, block, equations, ratios)
    sigma = None if given else estimated.error
    if given:
        values = np.unique(np.concatenate([np.asarray(each.sigma_rad) for each in releases]))
        sigma = float(values[0]) if len(values) == 1 else None
    fitted = RestitutionFit(
        block=block,
        model=equations,
        releases=releases,
        restitution=ratios,
        standard_error=(ratios[0] * errors[0], ratios[1] * errors[1]),
        low=(float(low[0]), float(low[1])),
        high=(float(high[0]), float(high[1])),
        housner=pair if sound else None,
        factor=(factors[0], factors[1]) if sound else None,
        factor_error=(factors[0] * errors[0], factors[1] * errors[1]) if sound else None,
        scatter=mean * estimated.scatter if free > 0 else math.nan,
        scatter_low=mean * estimated.scatter_interval[0],
        scatter_high=mean * estimated.scatter_interval[1] if free > 0 else math.inf,
        sigma_rad=sigma,
        sigma_estimated=not given,
        trend=None if trend is None else trend[0],
        trend_error=None if trend is None else trend[1],
        impacts=impacts,
        left_out=left_out,
        half_periods=half_periods,
        to_small=impacts_until(releases[0], block, equations, ratios),
        to_small_housner=impacts_until(releases[0], block, equations, pair) if sound else None,
        warnings=(),
    )
    object.__setattr__(fitted, "warnings", _warnings(fitted, short=known and not given))
    return fitted


@dataclass(frozen=True, kw_only=True)
class _Row:
    """A step from one measured peak to the next.

    Attributes
    ----------
    release, number
        Name, and number of the peak after it.
    sides, impacts
        Sides that it leaves and reaches, and number of impacts.
    peaks, sigma
        Peaks before and after, and their measuring errors [rad]; 1 where they are not known.
    logs, spread
        ln(v) of either, and its standard deviation.
    amplitude
        Peak before it over alpha.
    follows
        Whether it begins with the peak that the row before it ends with.
    """

    release: str
    number: int
    sides: tuple[int, int]
    impacts: float
    peaks: tuple[float, float]
    sigma: tuple[float, float]
    logs: tuple[float, float]
    spread: tuple[float, float]
    amplitude: float
    follows: bool

    @property
    def side(self) -> int:
        """Side that it leaves."""
        return self.sides[0]

    @property
    def change(self) -> float:
        """Change of ln(v)."""
        return self.logs[1] - self.logs[0]


def _releases(peaks: object) -> tuple[Release, ...]:
    """Return the releases."""
    if isinstance(peaks, Release):
        return (peaks,)
    if isinstance(peaks, list | tuple) and peaks and all(isinstance(p, Release) for p in peaks):
        return tuple(peaks)
    return (Release(peaks_rad=peaks),)  # type: ignore[arg-type]


def _rows(releases: Sequence[Release], block: Block, model: Model) -> tuple[list[_Row], int]:
    """Return the steps, and how many peaks were left out."""
    rows: list[_Row] = []
    left_out = 0
    for release in releases:
        peaks, sides = np.asarray(release.peaks_rad), np.asarray(release.sides)
        alphas = np.where(sides == 1, block.positive.alpha, block.negative.alpha)
        for place in np.flatnonzero(peaks > alphas)[:1]:
            raise InputError(
                "peaks_rad",
                float(peaks[place]),
                f"peak {place + 1} of {release.name} is above alpha, {alphas[place]:.6g} rad, "
                "from where a block falls over",
                "give radians, and the alpha of the base that rocks",
            )
        sigma = np.ones_like(peaks) if release.sigma_rad is None else np.asarray(release.sigma_rad)
        kept = peaks.size
        if release.sigma_rad is not None:
            lost = np.flatnonzero(peaks < LOST * sigma)
            kept = int(lost[0]) if lost.size else kept
        left_out += peaks.size - kept
        spread = sigma * np.abs(slopes(peaks, sides, block, model))
        logs = np.log(velocities(peaks, sides, block, model))
        rows += [
            _Row(
                release=release.name,
                number=k + 1,
                sides=(int(sides[k]), int(sides[k + 1])),
                impacts=2.0 if sides[k] == sides[k + 1] else 1.0,
                peaks=(float(peaks[k]), float(peaks[k + 1])),
                sigma=(float(sigma[k]), float(sigma[k + 1])),
                logs=(float(logs[k]), float(logs[k + 1])),
                spread=(float(spread[k]), float(spread[k + 1])),
                amplitude=float(peaks[k] / alphas[k]),
                follows=k > 0,
            )
            for k in range(kept - 1)
        ]
    if not rows:
        raise InputError(
            "peaks_rad",
            Words(f"leave no impact: {plural(left_out, 'peak')} are lost in the measuring error"),
            f"two peaks in a row must be {LOST:g} standard deviations or more",
            "release the block from a larger angle, or measure angles more closely",
        )
    return rows, left_out


def _at_expected_peaks(
    rows: Sequence[_Row], errors: tuple[Floats, Floats], block: Block, model: Model
) -> list[_Row]:
    """Return the steps with errors of ln(v) that are those of the expected peaks."""
    spread = np.empty((len(rows), 2))
    for end in (0, 1):
        sides = np.array([row.sides[end] for row in rows])
        speeds = np.exp(np.array([row.logs[end] for row in rows]) - errors[end])
        sigma = np.array([row.sigma[end] for row in rows])
        for side in (1, -1):
            here = sides == side
            peaks = peaks_at(speeds[here], side, block, model)
            spread[here, end] = sigma[here] * np.abs(slopes(peaks, sides[here], block, model))
    return [
        replace(row, spread=(before, after))
        for row, (before, after) in zip(rows, spread.tolist(), strict=True)
    ]


def _steps(rows: Sequence[_Row], base: tuple[float, float], *, apart: bool) -> Steps:
    """Return the steps as the likelihood has them."""
    # Impacts that end positive rotation, and others, in each step.
    ends = np.array(
        [[1.0, 1.0] if r.impacts == 2.0 else [r.side == 1, r.side == -1] for r in rows],
        dtype=np.float64,
    )
    spread = np.array([row.spread for row in rows])
    return Steps(
        change=np.array([row.change for row in rows]) - ends @ np.log(base),
        design=ends if apart else ends.sum(axis=1, keepdims=True),
        impacts=np.array([row.impacts for row in rows]),
        before=spread[:, 0],
        after=spread[:, 1],
        follows=np.array([row.follows for row in rows]),
    )


def _impacts(rows: Sequence[_Row], estimate: Estimate) -> tuple[Impact, ...]:
    """Return the steps as people read them."""
    return tuple(
        Impact(
            release=row.release,
            number=row.number,
            side=0 if row.impacts == 2.0 else row.side,
            peak_rad=row.peaks[0],
            next_rad=row.peaks[1],
            restitution=(ratio := math.exp(row.change / row.impacts)),
            measuring_error=ratio * estimate.error * math.hypot(*row.spread) / row.impacts,
            residual=residual,
        )
        for row, residual in zip(rows, estimate.residuals.tolist(), strict=True)
    )


def _trend(
    rows: Sequence[_Row], impacts: Sequence[Impact], steps: Steps, estimate: Estimate
) -> tuple[float, float] | None:
    """Return the change of the restitution with theta/alpha, and its standard error.

    By weighted least squares of the steps on the peak before them, beside the factors.
    """
    amplitude = np.array([row.amplitude for row in rows])
    if len(rows) < FEWEST_FOR_TREND + steps.design.shape[1] - 1 or np.ptp(amplitude) < 1e-6:
        return None
    again = replace(steps, design=np.column_stack([steps.design, amplitude * steps.impacts]))
    factor, covariance = solved(again, estimate.scatter, estimate.error)
    mean = math.exp(float(np.mean([math.log(each.restitution) for each in impacts])))
    return mean * float(factor[-1]), mean * math.sqrt(float(covariance[-1, -1]))


def _half_periods(
    releases: Sequence[Release], block: Block, model: Model, ratios: tuple[float, float]
) -> float | None:
    """Return the median of measured over computed times between peaks.

    From a peak to the base, and from there to the next peak, a block takes a quarter of the period
    of free rocking at that peak each.  Between two peaks of one side it rocks on the other too.
    """
    shares = []
    for release in releases:
        if release.times_s is None:
            continue
        peaks, sides = np.asarray(release.peaks_rad), np.asarray(release.sides)
        quarters = _quarters(peaks, sides, block, model)
        computed = quarters[:-1] + quarters[1:]
        speeds = velocities(peaks, sides, block, model)
        for k in np.flatnonzero(sides[:-1] == sides[1:]):
            ratio = ratios[0] if sides[k] == 1 else ratios[1]
            opposite = -int(sides[k])
            peak = peaks_at(np.array([ratio * speeds[k]]), opposite, block, model)
            computed[k] += 2.0 * _quarters(peak, np.array([opposite]), block, model)[0]
        shares += (np.diff(np.asarray(release.times_s)) / computed).tolist()
    shares = [share for share in shares if math.isfinite(share)]
    return float(np.median(shares)) if shares else None


def _quarters(peaks: Floats, sides: NDArray[np.int64], block: Block, model: Model) -> Floats:
    """Return a quarter of the period of free rocking at each peak [s]."""
    quarters = np.empty(peaks.shape)
    for sign, side in ((1, block.positive), (-1, block.negative)):
        here = sides == sign
        ratio = np.minimum(peaks[here] / side.alpha, 1.0 - 1e-12)
        alpha = None if isinstance(model, Linear) else side.alpha
        quarters[here] = free_rocking_period(ratio, alpha=alpha) / (4.0 * side.p)
    return quarters


def _warnings(fit: RestitutionFit, *, short: bool) -> tuple[str, ...]:
    """Return the reasons against a fit."""
    warnings = []
    rising = [each for each in fit.impacts if each.restitution > 1.0]
    if rising:
        named = ", ".join(f"impact {each.number} of {each.release}" for each in rising[:3])
        more = f" and {len(rising) - 3} more" if len(rising) > 3 else ""
        clear = [e for e in rising if e.restitution - 1.0 > CLEAR * e.measuring_error]
        why = "more than the measuring error explains" if clear else "within the measuring error"
        warnings.append(
            f"The peaks grow over {named}{more}, {why}: check their order and sides, and whether "
            "the base was still."
        )
    if max(fit.restitution) > 1.0:
        warnings.append("A restitution above 1 is that of no impact: blocks take at most 1.")
    if fit.left_out:
        warnings.append(
            f"{plural(fit.left_out, 'peak')} left out: from the first one below {LOST:g} standard "
            "deviations of the measuring error on, a release shows nothing of its impacts."
        )
    if short and len(fit.impacts) < FEWEST_FOR_ERROR:
        warnings.append(
            f"From {plural(len(fit.impacts), 'step')} the measuring error cannot be estimated: the "
            "scatter holds it too. Give sigma_rad, or more impacts."
        )
    if fit.trend is not None and fit.trend_error and abs(fit.trend) > CLEAR * fit.trend_error:
        warnings.append(
            f"The restitution changes with the amplitude, by {number(fit.trend, 2)} over a "
            "theta/alpha of 1: one value stands for the measured range."
        )
    if fit.half_periods is not None and abs(fit.half_periods - 1.0) > FAR:
        warnings.append(
            f"Measured half periods are {number(fit.half_periods)} of the computed ones: the block "
            "does not agree with its outline, as where the base that rocks is narrower, and e "
            "depends on alpha."
        )
    return tuple(warnings)
