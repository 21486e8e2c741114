"""Bifurcation curves in two parameters."""

from collections.abc import Callable, Iterator

import numpy as np

from rocksteady.dynamics.continuation._chain import MERGED, Chain
from rocksteady.dynamics.continuation._events import ChainCurve, Event, range_ends, returns
from rocksteady.dynamics.continuation._family import (
    LARGEST_STEP,
    ChainSolution,
    Course,
    Family,
    Test,
    checked_ranges,
)
from rocksteady.dynamics.continuation._predictor_corrector import Curve, LostError, StalledError
from rocksteady.dynamics.continuation.points import BIFURCATIONS, BranchPoint, PointType
from rocksteady.dynamics.parameters import PARAMETERS
from rocksteady.errors import InputError, ModelError
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import is_pair


@checked
def follow_bifurcation(
    origin: BranchPoint,
    parameters: tuple[str, str],
    within: tuple[tuple[float, float], tuple[float, float]],
    *,
    direction: int = 1,
    largest_step: float = LARGEST_STEP,
    most_points: int = 10_000,
) -> Iterator[BranchPoint]:
    """Follow a fold, symmetry breaking, period doubling or graze in two parameters.

    The orbit's own equations and the one that makes it a bifurcation are solved together.

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
        Of arclength, in parts of the ranges and of pi of mean phase.
    most_points
        Points after which the curve ends.

    Yields
    ------
    BranchPoint
        The origin, then one after another, of the type of the origin; the type of the last one says
        why the curve ends: also as grazing, where the orbit on another curve meets the floor.

    Raises
    ------
    InputError
        If a value is outside its range, or the origin is.
    ModelError
        If the origin is no bifurcation.

    Examples
    --------
    >>> from rocksteady import DimensionlessBlock, Harmonic, follow_branch, find_orbits
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
    conditions = (_condition(origin.type, origin.chain),)
    family = Family(chain=origin.chain, active=active, ranges=ranges, conditions=conditions)
    curve = Curve(evaluate=family.evaluate, largest_step=course.largest_step)
    return _followed(family, curve, origin.type, course)


def _followed(
    family: Family, curve: ChainCurve, kind: PointType, course: Course
) -> Iterator[BranchPoint]:
    """Yield the points of a curve."""
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
    spot = begin
    free = _others(kind, family.chain)
    end = PointType.LOST
    try:
        for count, new in enumerate(curve.follow(begin)):
            ends = [*range_ends(family, curve, spot, new)]
            ends += returns(family, curve, spot, new, begin)
            if free(spot.solution) > 0.0 >= free(new.solution):
                met = curve.locate(spot, new, free)
                ends.append(Event(PointType.GRAZING, met.arclength, met.solution.chain, final=True))
            for event in sorted(ends, key=lambda event: event.arclength):
                yield BranchPoint(type=event.type, arclength=event.arclength, chain=event.chain)
                return
            last = count + 1 == course.most_points
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


def _condition(kind: PointType, chain: Chain) -> Test:
    """Return what vanishes along the curve of a kind of bifurcation."""
    if kind is not PointType.GRAZING:
        closing, sizes = 1.0 if kind is PointType.FOLD else -1.0, chain.sizes
        return lambda chain: chain.scaled_determinant(closing, sizes)
    row, merged = _grazed(chain)
    if merged:
        return lambda chain: float(chain.durations[row])
    return lambda chain: float(chain.shape[row, 1])


def _grazed(chain: Chain) -> tuple[int, bool]:
    """Return the arc that grazes, and whether it has no duration."""
    row = int(np.argmin(np.abs(chain.durations)))
    if abs(chain.durations[row]) < MERGED:
        return row, True
    return int(np.nanargmin(chain.shape[:, 1])), False


def _others(kind: PointType, chain: Chain) -> Callable[[ChainSolution], float]:
    """Return the least height and duration of a chain, but for the arc that grazes by itself."""
    grazed, merged = _grazed(chain) if kind is PointType.GRAZING else (-1, False)

    def free(solution: ChainSolution) -> float:
        rows = np.arange(solution.chain.impacts)
        durations = solution.chain.durations[rows != grazed if merged else rows >= 0]
        dips = solution.chain.shape[rows != grazed, 1]
        dip = float(np.nanmin(dips, initial=1.0))
        return min(dip, float(durations.min(initial=1.0)))

    return free
