"""Bifurcation curves in two parameters."""

from collections.abc import Iterator
from typing import Annotated

import numpy as np

from rocksteady.dynamics.continuation.chains.events import (
    ChainCurve,
    ChainSpot,
    range_ends,
    returns,
)
from rocksteady.dynamics.continuation.chains.family import (
    LARGEST_STEP,
    Course,
    Family,
    checked_ranges,
)
from rocksteady.dynamics.continuation.chains.point_types import (
    BIFURCATIONS,
    CODIMENSION_TWO,
    PointType,
)
from rocksteady.dynamics.continuation.chains.predictor_corrector import LostError, StalledError
from rocksteady.dynamics.continuation.curves._codimension_two import curve_through, meetings
from rocksteady.dynamics.continuation.points import BranchPoint
from rocksteady.dynamics.parameters import PARAMETERS
from rocksteady.errors import InputError, ModelError
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import INSIDE
from rocksteady.model.checks.validation import is_pair

AT_START = 1e-6
"""Arclength up to which a point of codimension two is the one at which the curve begins."""


@checked
def follow_bifurcation(
    origin: Annotated[BranchPoint, INSIDE],
    parameters: tuple[str, str],
    within: Annotated[tuple[tuple[float, float], tuple[float, float]], INSIDE],
    *,
    direction: int = 1,
    largest_step: float = LARGEST_STEP,
    most_points: int = 10_000,
) -> Iterator[BranchPoint]:
    """Follow a fold, symmetry breaking, period doubling or graze in two parameters.

    The orbit's own equations and the condition of the bifurcation are solved together.

    Parameters
    ----------
    origin
        A bifurcation that `follow_branch` has found.
    parameters
        Two of "amplitude", "frequency_ratio" and "restitution".
    within
        The range of each; the curve ends where it leaves one of them.
    direction
        +1 to set off with the second parameter growing, -1 with it falling.
    largest_step
        Largest step of arclength, in parts of the ranges and of pi of mean phase.
    most_points
        Points after which the curve ends.

    Yields
    ------
    BranchPoint
        The origin, then one after another, of the type of the origin; where a second condition is
        met the point has the type of that: `CODIMENSION_TWO` in
        `rocksteady.dynamics.continuation.points`.  The type of the last one is the reason why
        the curve ends: also as a graze, where the orbit on another curve meets the floor.

    Raises
    ------
    InputError
        If a value is outside its range, or the origin is.
    ModelError
        If the origin is no bifurcation.

    Examples
    --------
    >>> from rocksteady import DimensionlessBlock, Harmonic, find_orbits
    >>> from rocksteady.branches import follow_branch
    >>> motion = Harmonic(amplitude=1.0, frequency_ratio=2.0)
    >>> origin = find_orbits(DimensionlessBlock(restitution=0.8), motion, max_period=1)[0]
    >>> branch = follow_branch(origin, "amplitude", (0.1, 3.0))
    >>> breaking = next(point for point in branch if point.type == "symmetry-breaking")
    >>> plane = ("amplitude", "frequency_ratio")
    >>> curve = list(follow_bifurcation(breaking, plane, ((0.1, 6.0), (1.0, 4.0))))
    >>> print(curve[-1].type, f"{curve[-1].amplitude:.9f} {curve[-1].frequency_ratio:.9f}")
    end-of-range 6.000000000 3.291247638
    """
    given: object = origin
    if not isinstance(given, BranchPoint) or given.type not in BIFURCATIONS:
        raise ModelError(
            "origin",
            given.type.value if isinstance(given, BranchPoint) else given,
            "a curve begins at a " + ", ".join(BIFURCATIONS),
            "take such a point of a branch",
        )
    if not (is_pair(parameters) and is_pair(within)) or parameters[0] == parameters[1]:
        raise InputError(
            "parameters",
            parameters,
            "they must be two different ones, with a range for each in `within`",
            "give two of " + ", ".join(PARAMETERS),
        )
    course = Course(direction=direction, largest_step=largest_step, most_points=most_points)
    active, ranges = checked_ranges(origin.chain, parameters, within)
    family, curve = curve_through(origin.type, origin.chain, active, ranges, course.largest_step)
    return _followed(family, curve, origin.type, course)


def follow_curve(
    family: Family, curve: ChainCurve, kind: PointType, begin: ChainSpot, most_points: int
) -> Iterator[BranchPoint]:
    """Yield the points of a curve after its first one.

    Parameters
    ----------
    family, curve
        Its equations.
    kind
        Kind of bifurcation.
    begin
        Where it begins, with the tangent along which it sets off.
    most_points
        After which it ends.
    """
    spot = begin
    end = PointType.LOST
    try:
        for count, new in enumerate(curve.follow(begin)):
            events = meetings(kind, family, curve, spot, new)
            events += range_ends(family, curve, spot, new)
            events += returns(family, curve, spot, new, begin)
            for event in sorted(events, key=lambda event: event.arclength):
                if event.type in CODIMENSION_TWO and event.arclength < AT_START:
                    continue  # the point at which the curve begins
                yield BranchPoint(type=event.type, arclength=event.arclength, chain=event.chain)
                if event.final:
                    return
            last = count + 1 == most_points
            yield BranchPoint(
                type=PointType.LIMIT if last else kind,
                arclength=new.arclength,
                chain=new.solution.chain,
            )
            if last:
                return
            spot = new
    except StalledError:
        end = PointType.STALLED
    except LostError:
        pass
    yield BranchPoint(type=end, arclength=spot.arclength, chain=spot.solution.chain)


def _followed(
    family: Family, curve: ChainCurve, kind: PointType, course: Course
) -> Iterator[BranchPoint]:
    """Yield the points of a curve through a bifurcation."""
    towards = np.append(np.zeros(family.chain.impacts + 1), course.direction)
    begin = curve.start(family.place_of(family.chain), towards)
    if begin is None:
        raise ModelError(
            "origin",
            kind.value,
            "the curve through it has no direction there",
            "start from another point of it",
        )
    yield BranchPoint(type=kind, arclength=0.0, chain=begin.solution.chain)
    yield from follow_curve(family, curve, kind, begin, course.most_points)
