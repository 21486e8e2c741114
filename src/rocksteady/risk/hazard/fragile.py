"""A fragility as a hazard curve meets it: shares at levels of the ground."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rocksteady.arrays import Floats
from rocksteady.errors import InputError, Words
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.arrays import guard_result
from rocksteady.model.checks.validation import non_negative, positive
from rocksteady.risk.counted.curve import Curve
from rocksteady.risk.counted.verdict import LEAST
from rocksteady.risk.fits.fragility_curve import FragilityCurve
from rocksteady.risk.fragility.fragility import Fragility
from rocksteady.risk.fragility.state_fragility import StateFragility
from rocksteady.risk.hazard.hazard_curve import HazardCurve
from rocksteady.risk.hazard.hazard_measures import fragility_factor, intensity_named, written
from rocksteady.seismic.measures.scalar import Measure

Given = Fragility | StateFragility | FragilityCurve | tuple[float, float]
REACH = 8.0
"""Standard deviations about a median within which a lognormal has edges of its own."""
LEAST_BETA = 1e-9
"""Beta below which a lognormal is a step."""


@guard_result
@dataclass(frozen=True, kw_only=True, eq=False)
class Fragile:
    """Shares of a fragility at levels of a hazard curve.

    Attributes
    ----------
    given
        The fragility.
    measure
        What it is over.
    factor
        What a level of the hazard curve is multiplied by to be one of the fragility.
    shares
        Shares at levels of the fragility, of their shape.
    edges
        Levels of the fragility at which its shares jump or bend.
    first, last
        Levels of the fragility between which it was counted; 0 and infinite without counts.
    slides
        Whether it slides there, so that not even the share at that level is a bound.
    counted
        The counts; None of a curve that is given.
    """

    given: Given
    measure: Measure
    factor: float
    shares: Callable[[Floats], Floats]
    edges: Floats
    first: float = 0.0
    last: float = math.inf
    slides: bool = False
    counted: Curve | None = None

    def at(self, level: ArrayLike) -> Floats:
        """Return the shares at levels of the hazard curve."""
        return self.shares(self.factor * np.asarray(level, dtype=np.float64))


def fragile_of(
    fragility: Given, hazard: HazardCurve, measure: Measure | str | None, block: Block | None
) -> Fragile:
    """Return a fragility over the measure of a hazard curve.

    Raises
    ------
    InputError
        If it is none, is counted over too few records, does not rise, or the measures do not fit.
    """
    if isinstance(fragility, Fragility):
        fragility = fragility.states[-1]
    if isinstance(fragility, StateFragility):
        records = min(count.records for count in fragility.curve.counts)
        if records < LEAST:
            raise InputError(
                "fragility",
                Words(f"is of {records} records"),
                f"a rate is of shares over {LEAST} records or more",
                "give more records",
            )
        over = _known("measure", measure, fragility.measure)
        factor = fragility_factor(over, hazard.intensity, block)
        curve = fragility.curve
        return Fragile(
            given=fragility,
            measure=over,
            factor=factor,
            shares=fragility.share,
            edges=np.concatenate([curve.levels, curve.lifts_at[np.isfinite(curve.lifts_at)]]),
            first=float(curve.levels[0]),
            last=float(curve.levels[-1]),
            counted=curve,
        )
    over = hazard.intensity if measure is None else intensity_named("measure", measure)
    factor = fragility_factor(over, hazard.intensity, block)
    if isinstance(fragility, FragilityCurve):
        if measure is None and fragility.measure[0] not in ("intensity", hazard.label):
            raise InputError(
                "fragility",
                Words(f"is a curve over {fragility.measure[0]}"),
                f"the hazard curve is over {hazard.label}",
                f"fit it over {written(hazard.intensity)}, or give measure= and block=",
            )
        if fragility.status not in ("fitted", "separated"):
            raise InputError(
                "fragility",
                Words(f"has no curve: its status is {fragility.status}"),
                "a rate is of trials that fail the more often the stronger they are",
                "fit it to more trials, with failures and survivals",
            )
        width = fragility.beta if math.isfinite(fragility.beta) else 0.0
        return Fragile(
            given=fragility,
            measure=over,
            factor=factor,
            shares=fragility.probability,
            edges=_edges(fragility.median, width),
        )
    pair: object = fragility  # of a caller without types perhaps something else
    if not isinstance(pair, tuple) or len(pair) != 2:
        raise InputError(
            "fragility",
            pair,
            "it is a Fragility, one of its states, a FragilityCurve or (median, beta)",
            "give what compute_fragility or fit_curve returns",
        )
    median, beta = _bounded(*pair)
    return Fragile(
        given=(median, beta),
        measure=over,
        factor=factor,
        shares=partial(_lognormal, median=median, beta=beta),
        edges=_edges(median, beta),
    )


def _known(name: str, asked: Measure | str | None, counted: Measure | None) -> Measure:
    """Return the measure of counted shares, which `asked` may only repeat."""
    if counted is None or (asked is not None and intensity_named(name, asked) != counted):
        raise InputError(
            name,
            asked,
            "the shares are over " + ("factors" if counted is None else written(counted)),
            "leave it out" if counted else "count them over a measure, as rs.risk.Levels('pga_g')",
        )
    return counted


def _bounded(median: float, beta: float) -> tuple[float, float]:
    """Return median and beta, or raise."""
    hint = "give the fragility as (median, beta)"
    median, beta = positive("median", median, hint=hint), non_negative("beta", beta, hint=hint)
    if not (1e-50 <= median <= 1e50 and beta <= 20.0):
        valid = "median must lie in [1e-50, 1e50] and beta in [0, 20]"
        raise InputError("fragility", (median, beta), valid, hint)
    return median, beta


def _lognormal(level: Floats, median: float, beta: float) -> Floats:
    """Return Phi(ln(level/median)/beta); without beta a step, 1 from the median on."""
    from scipy.special import ndtr

    x = np.log(level / median)
    return np.where(x >= 0.0, 1.0, 0.0) if beta < LEAST_BETA else np.asarray(ndtr(x / beta))


def _edges(median: float, beta: float) -> Floats:
    """Return levels about a median between which a curve of a beta is smooth."""
    return np.asarray(median * np.exp(beta * np.linspace(-REACH, REACH, 33)))


def resampled(curve: Curve, draws: NDArray[np.int64], level: Floats) -> Floats:
    """Return the shares at some levels of records drawn anew.

    Parameters
    ----------
    curve
        Counted shares.
    draws
        How often each record is drawn, shape (draws, records).
    level
        Levels, shape (levels,).

    Returns
    -------
    ndarray, shape (draws, levels)
    """
    fell = np.stack([count.fell for count in curve.counts], axis=1)
    answered = np.stack([count.answered for count in curve.counts], axis=1)
    tried = np.maximum(draws @ answered, 1)  # whole numbers: the same on every machine
    rows = [curve.between(level, curve.monotone(row)) for row in (draws @ fell) / tried]
    return np.minimum(np.array(rows), curve.lifting(level))
