"""Restitution that measured free rocking shows: estimates, impacts, remarks."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats
from rocksteady.errors import InputError
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.arguments import checked_result
from rocksteady.model.checks.validation import in_range
from rocksteady.model.equations import Linear, Model
from rocksteady.results.result import Result
from rocksteady.risk.free_rocking.release import Release

SMALL = 0.05
"""Part of the first peak down to which impacts are counted."""
MOST_COUNTED = 1_000_000
MOST = 2.0
"""The largest restitution that peaks are computed with."""


@dataclass(frozen=True, kw_only=True)
class Impact:
    """One step from peak to peak, of one impact or two.

    Attributes
    ----------
    release
        Name of the release.
    number
        Number of the peak after it, from 1.
    side
        Side whose rotation it ended, 1 or -1; 0 of two impacts, one of each side.
    peak_rad, next_rad
        Peaks before and after [rad].
    restitution
        Ratio of angular velocities of an impact; of two the geometric mean.
    measuring_error
        Standard deviation of it that follows from the measuring error of both peaks.
    residual
        Its deviation from the fit, in standard deviations.
    """

    release: str
    number: int
    side: int
    peak_rad: float
    next_rad: float
    restitution: float
    measuring_error: float
    residual: float


@checked_result
@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class RestitutionFit(Result):
    """Restitution of measured free rocking, from `rocksteady.fit_restitution`.

    Pairs are of the impact that ends positive rotation and of the other; equal where one factor of
    Housner's value was fitted to both.  All intervals have a confidence of 90 %.

    Attributes
    ----------
    block, model, releases
        Inputs of the fit.
    restitution, standard_error, low, high
        Geometric mean of the restitution over the impacts, its standard error, and its interval.
    housner
        Housner's values of the block; None of a block so stocky that there are none.
    factor, factor_error
        Restitution over Housner's value, and its standard error; None without that.
    scatter, scatter_low, scatter_high
        Standard deviation of the restitution from impact to impact, without the measuring error,
        and its interval.
    sigma_rad
        Measuring error of a peak [rad]; None where it was given for each.
    sigma_estimated
        Whether that is an estimate.
    trend, trend_error
        Change of the restitution with theta/alpha before the impact, from 0 to 1, and its standard
        error; None of fewer than four steps, and of peaks that are all alike.
    impacts
        The steps that the fit is made of.
    left_out
        Peaks that were left out, because they are lost in the measuring error.
    half_periods
        Median of measured over computed half periods; None without times.
    to_small, to_small_housner
        Impacts until the peaks are 5 % of the first one of the first release, by the fit and by
        Housner's values; None where they never are.
    warnings
        Reasons against the fit.

    Examples
    --------
    >>> from rocksteady import Block, fit_restitution
    >>> block = Block.rectangle(width=0.4, height=1.2)
    >>> fit = fit_restitution([0.2, 0.16, 0.13, 0.11, 0.1, 0.09], block)
    >>> [round(ratio, 3) for ratio in fit.restitution]
    [0.944, 0.944]
    """

    block: Block
    model: Model
    releases: tuple[Release, ...]
    restitution: tuple[float, float]
    standard_error: tuple[float, float]
    low: tuple[float, float]
    high: tuple[float, float]
    housner: tuple[float, float] | None
    factor: tuple[float, float] | None
    factor_error: tuple[float, float] | None
    scatter: float
    scatter_low: float
    scatter_high: float
    sigma_rad: float | None
    sigma_estimated: bool
    trend: float | None
    trend_error: float | None
    impacts: tuple[Impact, ...]
    left_out: int
    half_periods: float | None
    to_small: int | None
    to_small_housner: int | None
    warnings: tuple[str, ...]

    @property
    def measured(self) -> Block:
        """The block with the restitutions of the fit, those above 1 as 1.

        Examples
        --------
        >>> from rocksteady import Block, fit_restitution
        >>> block = Block.rectangle(width=0.1, height=0.6)
        >>> fit = fit_restitution([0.08, 0.0679, 0.0584, 0.0505], block)
        >>> print(f"{fit.measured.restitution:.3f}")
        0.943
        """
        first, second = (min(each, 1.0) for each in self.restitution)
        return self.block.with_restitution((first, second))

    def peaks_of(self, release: Release, ratios: Sequence[float] | None = None) -> Floats:
        """Return the peaks of a release that its first one and a restitution bring [rad].

        Parameters
        ----------
        release
            Its first peak and its sides count.
        ratios
            Restitution of the impact that ends positive rotation, and of the other; by default
            those of the fit.

        Returns
        -------
        ndarray, shape (peaks,)

        Raises
        ------
        InputError
            If there are not two ratios in (0, 2]: those of a fit may exceed 1.
        """
        ends = self.restitution if ratios is None else _two(ratios)
        return decayed(release, self.block, self.model, ends)


def velocities(peaks: Floats, sides: NDArray[np.int64], block: Block, model: Model) -> Floats:
    """Return the angular velocity at the impact after, or before, each peak [rad/s]."""
    values = np.empty(peaks.shape)
    for sign, side in ((1, block.positive), (-1, block.negative)):
        here = sides == sign
        values[here] = side.p * np.sqrt(2.0 * _energy(peaks[here], side.alpha, model))
    return values


def slopes(peaks: Floats, sides: NDArray[np.int64], block: Block, model: Model) -> Floats:
    """Return the change of the logarithm of `velocities` with the peak [1/rad]."""
    values = np.empty(peaks.shape)
    for sign, side in ((1, block.positive), (-1, block.negative)):
        here = sides == sign
        force = side.alpha - peaks[here]
        if not isinstance(model, Linear):
            force = np.sin(force)
        values[here] = 0.5 * force / _energy(peaks[here], side.alpha, model)
    return values


def peaks_at(velocity: Floats, side: int, block: Block, model: Model) -> Floats:
    """Return the peaks that angular velocities after impacts bring [rad]; alpha where they fall."""
    here = block.positive if side == 1 else block.negative
    energy = 0.5 * np.square(velocity / here.p)
    if isinstance(model, Linear):
        square = np.maximum(here.alpha**2 - 2.0 * energy, 0.0)
        return np.asarray(2.0 * energy / (here.alpha + np.sqrt(square)))
    # sin^2(alpha/2) - sin^2((alpha - theta)/2) is half the energy.
    sine, cosine = math.sin(0.5 * here.alpha), math.cos(0.5 * here.alpha)
    half = np.minimum(0.5 * energy, sine * sine)
    square = sine * sine - half
    fall = half / (sine * np.sqrt(1.0 - square) + np.sqrt(square) * cosine)
    return np.asarray(2.0 * np.arcsin(fall))


def _two(ratios: Sequence[float]) -> tuple[float, float]:
    """Return two restitutions, which of a fit may exceed 1."""
    if len(ratios) != 2:
        valid = "there are two impacts: the end of positive and the end of negative rotation"
        raise InputError("ratios", ratios, valid, "give a pair, as (0.9, 0.9)")
    hint = "give ratios of angular velocities after and before an impact"
    first, second = (in_range("ratios", ratio, 0.0, MOST, "(]", hint=hint) for ratio in ratios)
    return first, second


def decayed(release: Release, block: Block, model: Model, ratios: tuple[float, float]) -> Floats:
    """Return the peaks of a release that follow from the first by two restitutions [rad]."""
    sides = np.asarray(release.sides)
    first = np.asarray(release.peaks_rad, dtype=np.float64)
    steps = np.where(sides[:-1] == sides[1:], ratios[0] * ratios[1], 0.0)
    ends = np.where(sides[:-1] == 1, ratios[0], ratios[1])
    kept = np.cumprod(np.concatenate([[1.0], np.where(steps > 0.0, steps, ends)]))
    start = velocities(first[:1], sides[:1], block, model)[0]
    peaks_after = np.empty(sides.shape)
    for sign in (1, -1):
        here = sides == sign
        peaks_after[here] = peaks_at(start * kept[here], sign, block, model)
    peaks_after[0] = first[0]
    return peaks_after


def impacts_until(
    release: Release, block: Block, model: Model, ratios: tuple[float, float]
) -> int | None:
    """Return after how many impacts the peaks are 5 % of the first; None where they never are."""
    peak = np.asarray(release.peaks_rad, dtype=np.float64)[0]
    side = int(np.asarray(release.sides)[0])
    if ratios[0] * ratios[1] >= 1.0:
        return None
    speed = velocities(np.array([peak]), np.array([side]), block, model)
    aim = SMALL * peak
    pair = ratios if side == 1 else ratios[::-1]
    # Two impacts at a time; then the first of the last few that reaches the aim.
    target = min(velocities(np.array([aim]), np.array([each]), block, model)[0] for each in (1, -1))
    most = 2 * math.ceil(math.log(target / speed[0]) / math.log(ratios[0] * ratios[1])) + 4
    if not 0 < most < MOST_COUNTED:
        return None
    factors = np.cumprod(np.where(np.arange(most) % 2 == 0, pair[0], pair[1]))
    here = np.empty(most)
    here[0::2] = peaks_at(speed[0] * factors[0::2], -side, block, model)
    here[1::2] = peaks_at(speed[0] * factors[1::2], side, block, model)
    # Computed peaks of the limit itself may lie above it by rounding.
    return int(np.argmax(here <= aim * (1.0 + 1e-12))) + 1


def _energy(peaks: Floats, alpha: float, model: Model) -> Floats:
    """Return ``cos(alpha - theta) - cos(alpha)``, without its cancellation, or the linear one."""
    if isinstance(model, Linear):
        return peaks * (alpha - 0.5 * peaks)
    return np.asarray(2.0 * np.sin(alpha - 0.5 * peaks) * np.sin(0.5 * peaks))
