"""Branches: a periodic orbit followed over a parameter, with its bifurcations."""

import math
from collections.abc import Iterator
from itertools import chain as joined
from itertools import islice
from typing import Annotated

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.dynamics.continuation.chains.events import (
    ChainCurve,
    ChainSpot,
    events_between,
    range_ends,
    returns,
)
from rocksteady.dynamics.continuation.chains.family import (
    LARGEST_STEP,
    Course,
    Family,
    checked_ranges,
)
from rocksteady.dynamics.continuation.chains.point_types import MARGINAL, PointType
from rocksteady.dynamics.continuation.chains.predictor_corrector import (
    Curve,
    LostError,
    Spot,
    StalledError,
    null_vector,
)
from rocksteady.dynamics.continuation.chains.switching import switched
from rocksteady.dynamics.continuation.from_orbit import chain_at
from rocksteady.dynamics.continuation.points import BranchPoint
from rocksteady.dynamics.orbits.orbit import Orbit
from rocksteady.errors import ModelError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import INSIDE

AT_START = 1e-6
"""Arclength within which an event of the start's own kind is the start."""
BESIDE = 1e-5
"""Arclength from a graze at which it is seen whether a branch is a motion: not rounding decides."""


@checked
def follow_branch(
    origin: Orbit | BranchPoint,
    parameter: str,
    within: Annotated[tuple[float, float], INSIDE],
    *,
    direction: int = 1,
    switch: bool = False,
    inadmissible: bool = False,
    largest_step: float = LARGEST_STEP,
    most_points: int = 10_000,
) -> Iterator[BranchPoint]:
    """Follow a periodic orbit over a parameter, stable or unstable, around its folds.

    By pseudo-arclength on the phases of the impacts (`rocksteady.kernels.orbits.chains`).  Where a
    bifurcation lies between two points it is located to rounding and yielded between them.

    Parameters
    ----------
    origin
        An orbit without rest, of either model and of any block that rocks on both sides, or a point
        of another branch.
    parameter
        "amplitude", "frequency_ratio" or "restitution", which is that of both impacts.
    within
        The range of it; the branch ends where it leaves it.
    direction
        +1 to set off with the parameter growing, -1 with it falling.  From a fold both sides of it
        lead the same way: +1 is the one on which the impacts come later.
    switch
        At a symmetry breaking, a period doubling or a graze: follow the branch that begins there,
        instead of the one on which the point lies.  It sets off to where there are motions, and
        `direction` does not count.
    inadmissible
        Whether the branch is followed on where the solution passes through the floor; without, it
        ends at the graze before.
    largest_step
        Largest step of arclength, in parts of the range and of pi of mean phase.
    most_points
        Regular points after which the branch ends.

    Yields
    ------
    BranchPoint
        The origin, then one after another.  The type of the last one is the reason why the branch
        ends.

    Raises
    ------
    InputError
        If a value is outside its range, or the origin is.
    ModelError
        If the origin comes to rest, is one of a block against a wall, passes through the floor and
        `inadmissible` is off, or nothing branches off there; or if the parameter is a restitution
        that differs between the block's impacts.  From a graze into the floor the branch has its
        start alone.

    Examples
    --------
    >>> from rocksteady import DimensionlessBlock, Harmonic, find_orbits
    >>> block = DimensionlessBlock(restitution=0.8)
    >>> origin = find_orbits(block, Harmonic(amplitude=1.0, frequency_ratio=2.0), max_period=1)[0]
    >>> for point in follow_branch(origin, "amplitude", (0.1, 3.0)):
    ...     if point.type != "regular":
    ...         print(point.type, f"{point.amplitude:.6f}", point.stable)
    symmetry-breaking 2.120167 False
    end-of-range 3.000000 False
    """
    course = Course(direction=direction, largest_step=largest_step, most_points=most_points)
    chain = chain_at(origin)
    active, ranges = checked_ranges(chain, (parameter,), (within,))
    first = PointType.REGULAR
    towards: Floats | None = np.append(np.zeros(chain.impacts), direction)
    if isinstance(origin, BranchPoint):
        first = origin.type
    orbit = chain
    if switch:
        chain, along = switched(first, chain)
        towards = None if along is None else np.append(along / np.linalg.norm(along), 0.0)
    elif not chain.admissible and not inadmissible and first is not PointType.GRAZING:
        raise ModelError(
            "origin",
            Words("passes through the floor"),
            "it is no motion",
            "start from an admissible orbit, or ask for inadmissible ones too",
        )
    family = Family(chain=chain, active=active, ranges=ranges)
    curve = Curve(evaluate=family.evaluate, largest_step=course.largest_step)
    followed = _followed(family, curve, towards, first, inadmissible=inadmissible, most=most_points)
    if switch and first is not PointType.GRAZING:
        # What branches off is drawn from the orbit of which it is the double.
        return joined(
            [BranchPoint(type=first, arclength=0.0, chain=orbit)], islice(followed, 1, None)
        )
    return followed


def _followed(
    family: Family,
    curve: ChainCurve,
    towards: Floats | None,
    first: PointType,
    *,
    inadmissible: bool,
    most: int,
) -> Iterator[BranchPoint]:
    """Yield the points of a branch."""
    begin = _begun(family, curve, towards, first)
    yield BranchPoint(type=first, arclength=0.0, chain=begin.solution.chain)
    earlier = spot = begin
    # So near to the crossing at which a branch of doubled orbits begins nothing else is resolved.
    crossing = towards is not None and towards[-1] == 0.0
    itself = MARGINAL if crossing else (first,)
    if first is PointType.GRAZING and not inadmissible:
        # At the graze itself rounding decides on which side of the floor the block is.
        beside = _beside(curve, begin)
        if beside is None or not beside.solution.chain.admissible:
            return
        earlier = spot = beside
    end = PointType.LOST
    try:
        for count, new in enumerate(curve.follow(spot)):
            events = events_between(family, curve, spot, new, earlier)
            events += range_ends(family, curve, spot, new)
            events += returns(family, curve, spot, new, begin)
            closed = next((e.arclength for e in events if e.type is PointType.CLOSED), math.inf)
            for event in sorted(events, key=lambda event: event.arclength):
                apart = min(event.arclength, abs(event.arclength - closed))
                if event.type in itself and apart < AT_START:
                    continue
                yield BranchPoint(type=event.type, arclength=event.arclength, chain=event.chain)
                if event.final or (event.type is PointType.GRAZING and not inadmissible):
                    return
            kind = PointType.REGULAR if count + 1 < most else PointType.LIMIT
            yield BranchPoint(type=kind, arclength=new.arclength, chain=new.solution.chain)
            if kind is PointType.LIMIT:
                return
            earlier, spot = spot, new
    except StalledError:
        end = PointType.STALLED
    except LostError:
        pass
    yield BranchPoint(type=end, arclength=spot.arclength, chain=spot.solution.chain)


def _begun(
    family: Family, curve: ChainCurve, towards: Floats | None, first: PointType
) -> ChainSpot:
    """Return the start of a branch with the direction in which it sets off.

    Raises
    ------
    ModelError
        If there is no orbit at the start.
    """
    place = family.place_of(family.chain)
    solution = family.evaluate(place)
    assert solution is not None
    if towards is not None and first is PointType.FOLD:
        along = null_vector(solution.slopes)
        later = math.copysign(1.0, float(along[:-1].sum()) * float(towards[-1]))
        return Spot(place=place, tangent=later * along, solution=solution, arclength=0.0)
    if towards is not None and towards[-1] != 0.0:
        spot = curve.start(place, towards)
        if spot is not None:
            return spot
        raise ModelError(
            "origin",
            Words("is an orbit"),
            "it is none of this shaking, or a branch crosses another there",
            "start from an orbit of `find_orbits`, or add switch=True at a bifurcation",
        )
    if towards is not None:
        return Spot(place=place, tangent=towards, solution=solution, arclength=0.0)
    # From a graze the branch goes to where it is a motion.
    tangent = null_vector(solution.slopes)
    sides = [
        Spot(place=place, tangent=sign * tangent, solution=solution, arclength=0.0)
        for sign in (1.0, -1.0)
    ]
    for spot in sides:
        near = _beside(curve, spot)
        if near is not None and near.solution.chain.admissible:
            return spot
    return sides[0]


def _beside(curve: ChainCurve, spot: ChainSpot) -> ChainSpot | None:
    """Return a point a little ahead of one."""
    return curve.along(spot, BESIDE)
