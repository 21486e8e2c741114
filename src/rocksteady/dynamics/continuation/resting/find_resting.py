"""All orbits with rest over a parameter, and why there is none elsewhere."""

import math
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any

from rocksteady.dynamics.continuation.resting._legs import Uplifts
from rocksteady.dynamics.continuation.resting._tracing import Span, Tracer
from rocksteady.dynamics.continuation.resting.resting_branch import RestingBranch, RestingPoint
from rocksteady.dynamics.continuation.resting.resting_types import NoRest, RestingPointType
from rocksteady.dynamics.orbits.orbit import Orbit
from rocksteady.dynamics.orbits.return_map import harmonic
from rocksteady.dynamics.parameters import PARAMETERS, range_of
from rocksteady.errors import InputError, ModelError, Words
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.bounds import Whole
from rocksteady.model.checks.validation import positive
from rocksteady.model.equations import Model, ModelChoice, chosen_model
from rocksteady.model.motions.segments import Harmonic
from rocksteady.model.units import framed
from rocksteady.results.result import Result, words_module

if TYPE_CHECKING:
    import pandas as pd

LONGEST = 4
"""Default longest period [forcing periods]."""
STEP = 1.0 / 200.0
"""Default largest step, in parts of the range."""
SHORTEST = 1e-4
"""Smallest step that is accepted, in parts of the range."""


@checked_result
@dataclass(frozen=True, kw_only=True)
class RestingGap:
    """Values of a parameter without an orbit with rest.

    Attributes
    ----------
    low, high
        Its ends.
    reasons
        Why there is none where it was looked, the most frequent first.
    """

    low: float
    high: float
    reasons: tuple[NoRest, ...]


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class RestingBranches(Result):
    """Orbits with rest over a parameter, and the gaps between them.

    Attributes
    ----------
    block, motion, model
        Block, base motion and equations; their own value of the parameter does not count.
    parameter, within
        Parameter and its range.
    max_period, resolution
        Longest orbits [forcing periods], and the largest step through the range.
    branches
        By their lower ends.  One of each pair of mirror images is listed.
    gaps
        Parts of the range without a branch.
    """

    block: Block | DimensionlessBlock
    motion: Harmonic
    model: Model
    parameter: str
    within: tuple[float, float]
    max_period: int
    resolution: float
    branches: tuple[RestingBranch, ...]
    gaps: tuple[RestingGap, ...]

    def rows(self) -> Iterator[dict[str, Any]]:
        """Yield one row per point of each branch, in SI too where the block has a size."""
        for place, branch in enumerate(self.branches, start=1):
            yield from words_module(RestingBranches).resting_rows(branch, place)

    def to_dataframe(self) -> "pd.DataFrame":
        """Return one row per point of each branch, in SI too where the block has a size."""
        return framed(self.rows(), self.block)


@checked
def find_resting_branches(
    block: Block | DimensionlessBlock,
    motion: Harmonic,
    parameter: str,
    within: tuple[float, float],
    *,
    max_period: Annotated[int, Whole(1, 1000, "give a number of forcing periods")] = LONGEST,
    resolution: float | None = None,
    model: ModelChoice = None,
) -> RestingBranches:
    """Find the orbits with rest over a parameter, and why there are none elsewhere.

    At a value of the parameter there is at most one through each uplift, and following the block
    from there finds it.  The range is gone through in steps; between two that differ a step is
    halved three times, and then the border between them is located to rounding.  Every branch and
    every gap wider than a step is found; narrower ones may be missed.

    Parameters
    ----------
    block
        Symmetric, asymmetric, or against a wall.
    motion
        Its phase does not count.
    parameter
        "amplitude", "frequency_ratio" or "restitution".
    within
        Its range (low, high).
    max_period
        Longest period of an orbit [forcing periods].
    resolution
        Largest step, in units of the parameter; by default 1/200 of the range.
    model
        ``"linear"`` or ``"nonlinear"``; by default nonlinear for a `Block`.

    Raises
    ------
    InputError, ModelError
        If a value is outside its range, or the nonlinear model meets a block without slenderness.

    Examples
    --------
    >>> from rocksteady import DimensionlessBlock, Harmonic
    >>> block = DimensionlessBlock(restitution=0.8)
    >>> motion = Harmonic(amplitude=1.0, frequency_ratio=2.0)
    >>> branches = find_resting_branches(block, motion, "amplitude", (0.9, 1.08), resolution=0.02)
    >>> for branch in branches.branches:
    ...     print(branch.kind, branch.period, branch.begin.type, branch.end.type)
    ...     print(f"{branch.within[0]:.12f} {branch.within[1]:.12f}")
    symmetric 1 uplift end-of-rest
    1.000000000000 1.076291189582
    >>> for gap in branches.gaps:
    ...     print(f"{gap.low:.3f} {gap.high:.3f}", *gap.reasons)
    0.900 1.000 below-uplift
    1.076 1.080 no-rest
    """
    moving = Uplifts(block, motion, parameter, chosen_model(model, block), max_period)
    uplifts, ends, step = _asked(moving, within, resolution)
    low, high = ends
    tracers = [Tracer(uplifts, side) for side in uplifts.sides]
    branches = [
        _branch(tracer, span) for tracer in tracers for span in tracer.spans(low, high, step)
    ]
    branches.sort(key=lambda branch: branch.within)
    return RestingBranches(
        block=uplifts.block,
        motion=uplifts.motion,
        model=uplifts.model,
        parameter=parameter,
        within=ends,
        max_period=uplifts.longest,
        resolution=step,
        branches=tuple(branches),
        gaps=tuple(_gaps(tracers, branches, ends, step)),
    )


@checked
def follow_resting_branch(
    origin: Orbit | RestingPoint,
    parameter: str,
    within: tuple[float, float],
    *,
    resolution: float | None = None,
) -> RestingBranch:
    """Follow an orbit with rest over a parameter, both ways, to where it ends.

    Parameters
    ----------
    origin
        Orbit that comes to rest, as `rocksteady.find_orbits` finds it, or a point of a branch.
    parameter
        "amplitude", "frequency_ratio" or "restitution".
    within
        Its range (low, high).
    resolution
        Largest step, in units of the parameter; by default 1/200 of the range.  Gaps narrower than
        a step may not be met.

    Raises
    ------
    InputError
        If a value is outside its range, or the origin is.
    ModelError
        If the origin never rests, or rounding decides about it.

    Examples
    --------
    >>> from rocksteady import DimensionlessBlock, Harmonic, find_attractor
    >>> motion = Harmonic(amplitude=1.05, frequency_ratio=2.0)
    >>> orbit = find_attractor(DimensionlessBlock(restitution=0.8), motion).orbit
    >>> branch = follow_resting_branch(orbit, "restitution", (0.5, 1.0))
    >>> print(f"{branch.end.restitution:.12f} {branch.end.type}")
    0.886333909668 end-of-rest
    """
    period = origin.period
    moving = Uplifts(origin.block, harmonic(origin.motion), parameter, origin.model, period)
    uplifts, (low, high), step = _asked(moving, within, resolution)
    if not origin.rest_phases:
        raise ModelError(
            "origin",
            Words("never comes to rest"),
            "this follows orbits with rest",
            "use follow_branch",
        )
    value = origin.block.dimensionless().restitution
    if parameter != "restitution":
        value = float(getattr(origin.motion, parameter))
    if not low <= value <= high:
        raise InputError(
            "within", within, f"the origin is at {value:.6g}", "choose a range around it"
        )
    for side in uplifts.sides:
        tracer = Tracer(uplifts, side)
        sample = tracer.sample(value)
        if sample.failure is None and sum(h for _, h in sample.pattern) == 2 * period:
            return _branch(tracer, tracer.span_around(value, low, high, step))
    raise ModelError(
        "origin",
        Words("is not met again from its uplift"),
        "rounding decides about it",
        "start from another value of the parameter",
    )


def _asked(
    moving: Uplifts, within: object, resolution: float | None
) -> tuple[Uplifts, tuple[float, float], float]:
    """Return what is followed, its range and the step.

    Raises
    ------
    InputError
        If one of them is not valid.
    """
    moving.block.dimensionless()  # refuses sides too unlike
    harmonic(moving.motion)
    if moving.parameter not in PARAMETERS:
        valid = "orbits are followed over " + ", ".join(PARAMETERS)
        raise InputError("parameter", moving.parameter, valid, "name one of them")
    low, high = range_of(within, moving.parameter)
    for end in (low, high):
        moving.moved(end)  # refuses what is outside its range
    step = STEP * (high - low)
    if resolution is not None:
        step = positive("resolution", resolution, hint="give a step of the parameter")
        if step < SHORTEST * (high - low):
            raise InputError(
                "resolution",
                resolution,
                f"it must be {SHORTEST:g} of the range at least",
                "take a longer step, or a narrower range",
            )
    return moving, (low, high), step


def _branch(tracer: Tracer, span: Span) -> RestingBranch:
    """Return the branch of an interval."""
    uplifts, points = tracer.uplifts, []
    for spot in tracer.spots(span):
        block, motion = uplifts.moved(spot.value)
        points.append(
            RestingPoint(
                type=spot.type,
                block=block,
                motion=motion,
                model=uplifts.model,
                gains=spot.gains,
                touch=spot.touch if spot.type is RestingPointType.GRAZING else None,
                legs=tracer.sample(spot.value).legs,
            )
        )
    return RestingBranch(
        block=uplifts.block,
        motion=uplifts.motion,
        model=uplifts.model,
        parameter=uplifts.parameter,
        points=tuple(points),
    )


def _gaps(
    tracers: list[Tracer],
    branches: list[RestingBranch],
    within: tuple[float, float],
    step: float,
) -> Iterator[RestingGap]:
    """Yield what branches leave of a range, divided where the shaking begins to lift the block."""
    low, high = within
    ends: list[tuple[float, float]] = []
    reached = low
    for branch in branches:
        begin, end = branch.within
        if begin > math.nextafter(reached, math.inf) or (begin > reached == low):
            ends.append((reached, begin))
        reached = max(reached, end)
    if reached < high:
        ends.append((reached, high))
    thresholds = tracers[0].thresholds(low, high, step)
    for begin, end in ends:
        inside = [t for t in thresholds if begin < t < math.nextafter(end, -math.inf)]
        for left, right in zip([begin, *inside], [*inside, end], strict=True):
            looked = [
                (tracer, value)
                for tracer in tracers
                for value in {*tracer.looked(left, right), 0.5 * (left + right)}
            ]
            failures = (tracer.failure(value) for tracer, value in looked)
            counts = Counter(each for each in failures if each is not None)
            counts.pop(NoRest.ELSEWHERE, None)
            reasons = tuple(each for each, _ in counts.most_common())
            yield RestingGap(low=left, high=right, reasons=reasons)
