"""Bifurcations between two neighbouring points of a branch."""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from rocksteady.dynamics.continuation.chains.chain import Chain
from rocksteady.dynamics.continuation.chains.family import ChainSolution, Family
from rocksteady.dynamics.continuation.chains.point_types import PointType
from rocksteady.dynamics.continuation.chains.predictor_corrector import (
    Curve,
    LostError,
    Spot,
    null_vector,
)

ChainSpot = Spot[ChainSolution]
ChainCurve = Curve[ChainSolution]

NEAR = 0.3
"""A test that may come this near to zero between two points, as a part of its value at one of them,
is looked at where it is least: two events may hide there."""
ASIDE = 0.5
"""Part of a step beyond its ends where the least value may seem to be."""
LEAST, FAR_OFF = 1e-5, 10.0
"""Part of the step to which its place is searched for, and its value where nothing is known."""
NARROWER, NARROWINGS = 0.1, 20
"""Part of a bracket that is taken instead of it, next to the crossing of two curves; how often."""
BESIDE = 1e-6
"""Part of a step before a merging of impacts at which the orbit is still looked at."""

BACK = 1e-6
"""Difference of phases [rad] at which a branch is back where it began."""


@dataclass(frozen=True, eq=False)
class Event:
    """A bifurcation on a branch.

    Attributes
    ----------
    type
        What it is.
    arclength
        Where on the branch.
    chain
        The orbit there; where a branch of doubled orbits ends, the orbit that is doubled.
    final
        Whether the branch ends there.
    """

    type: PointType
    arclength: float
    chain: Chain
    final: bool


def flip(solution: ChainSolution) -> float:
    """Return what vanishes where a multiplier of the chain is -1."""
    return solution.flip


def fold(solution: ChainSolution) -> float:
    """Return what vanishes where a multiplier of the chain is 1."""
    return solution.fold


def shortest(solution: ChainSolution) -> float:
    """Return what vanishes where two impacts merge."""
    return solution.chain.shortest


def clearance(solution: ChainSolution) -> float:
    """Return what vanishes where the block grazes between two impacts; 1 where nothing dips."""
    return min(solution.chain.clearance, 1.0)


def turning(spot: ChainSpot) -> float:
    """Return what vanishes where the branch turns back in its parameter."""
    return float(spot.tangent[-1])


def events_between(
    family: Family, curve: ChainCurve, before: ChainSpot, after: ChainSpot, earlier: ChainSpot
) -> list[Event]:
    """Return the bifurcations between two neighbouring points, in order.

    Parameters
    ----------
    family, curve
        Their equations.
    before, after
        The two points.
    earlier
        The one before them; `before` again where there is none.
    """
    inner = [
        spot
        for number in _suspicious(earlier, before, after)
        if (spot := _dipping(curve, before, after, number)) is not None
    ]
    events: list[Event] = []
    for low, high in pairwise([before, *sorted(inner, key=_arclength), after]):
        events += _events(family, curve, low, high)
    return sorted(events, key=_arclength)


def _arclength(of: ChainSpot | Event) -> float:
    return of.arclength


def _tests(spot: ChainSpot) -> tuple[float, ...]:
    solution = spot.solution
    return (turning(spot), flip(solution), shortest(solution), clearance(solution))


def _suspicious(earlier: ChainSpot, before: ChainSpot, after: ChainSpot) -> Iterator[int]:
    """Yield the tests that may touch zero between two points at which they have one sign."""
    if earlier.arclength == before.arclength:
        return
    s0, s2 = earlier.arclength - before.arclength, after.arclength - before.arclength
    tests = zip(_tests(earlier), _tests(before), _tests(after), strict=True)
    for number, (v0, v1, v2) in enumerate(tests):
        if not all(map(math.isfinite, (v0, v1, v2))) or v1 * v2 <= 0.0:
            continue
        # The parabola v1 + b s + c s^2 through the three.
        c = ((v0 - v1) / s0 - (v2 - v1) / s2) / (s0 - s2)
        b = (v2 - v1) / s2 - c * s2
        if c * v1 > 0.0 and -ASIDE * s2 < -b / (2.0 * c) < (1.0 + ASIDE) * s2:
            extreme = v1 - b * b / (4.0 * c)
            if extreme / v1 < NEAR or extreme / v2 < NEAR:
                yield number


def _dipping(
    curve: ChainCurve, before: ChainSpot, after: ChainSpot, number: int
) -> ChainSpot | None:
    """Return a point between two others at which a test has another sign; None if there is none."""
    from scipy.optimize import minimize_scalar

    sign = math.copysign(1.0, _tests(before)[number])
    length = after.arclength - before.arclength
    dips: list[ChainSpot] = []

    def height(ahead: float) -> float:
        spot = curve.along(before, ahead)
        value = FAR_OFF if spot is None else sign * _tests(spot)[number]
        if spot is not None and value < 0.0:
            dips.append(spot)
        return value

    minimize_scalar(
        height, bounds=(0.0, length), method="bounded", options={"xatol": LEAST * length}
    )
    return dips[0] if dips else None


def _events(family: Family, curve: ChainCurve, low: ChainSpot, high: ChainSpot) -> Iterator[Event]:
    """Yield the bifurcations whose tests have opposite signs at two points."""
    changed = _changed(low, high)
    halving = [*_halving(family, curve, low, high)]
    yield from halving
    # Where a doubled branch ends it turns back too, and rounding decides on the sign of fold.
    if turning(low) * turning(high) < 0.0 and changed(fold) and not halving:
        yield from _located(curve, low, high, fold, PointType.FOLD)
    if changed(flip):
        broken = low.solution.chain.symmetric
        kind = PointType.SYMMETRY_BREAKING if broken else PointType.PERIOD_DOUBLING
        yield from _located(curve, low, high, flip, kind)
    yield from grazes(curve, low, high)


def grazes(curve: ChainCurve, low: ChainSpot, high: ChainSpot) -> Iterator[Event]:
    """Yield where a branch loses its admissibility, or gains it."""
    if low.solution.chain.admissible == high.solution.chain.admissible:
        return
    inside = low if low.solution.chain.admissible else high
    end = high if inside is low else low
    if shortest(end.solution) <= 0.0:
        merging = _met(curve, low, high, shortest)
        if merging is None:
            return
        back = BESIDE * (high.arclength - low.arclength)
        beside = curve.along(merging, -back if inside is low else back)
        # Beyond a merging the next arc dips too.  Before it none does, or a dip came first.
        if beside is None or beside.solution.chain.admissible:
            yield Event(PointType.GRAZING, merging.arclength, merging.solution.chain, final=False)
            return
        low, high = (inside, beside) if inside is low else (beside, inside)
    if _changed(low, high)(clearance):
        yield from _located(curve, low, high, clearance, PointType.GRAZING)


def range_ends(
    family: Family, curve: ChainCurve, before: ChainSpot, after: ChainSpot
) -> Iterator[Event]:
    """Yield where a branch or a curve leaves the range of one of its parameters."""
    for index, ends in zip(family.active, family.ranges.tolist(), strict=True):
        for end, outwards in zip(ends, (-1.0, 1.0), strict=True):

            def beyond(solution: ChainSolution, index: int = index, end: float = end) -> float:
                return float(solution.chain.parameters[index]) - end

            if outwards * beyond(after.solution) <= 0.0:
                continue
            inside = outwards * beyond(before.solution) < 0.0
            spot = curve.locate(before, after, beyond) if inside else before
            parameters = spot.solution.chain.parameters.copy()
            parameters[index] = end  # except for rounding it is
            chain = spot.solution.chain.moved(spot.solution.chain.phases, parameters)
            yield Event(PointType.RANGE_END, spot.arclength, chain, final=True)


def returns(
    family: Family, curve: ChainCurve, before: ChainSpot, after: ChainSpot, begin: ChainSpot
) -> Iterator[Event]:
    """Yield where a branch or a curve is back where it began."""
    start, index = begin.solution, family.active[-1]

    def ahead(solution: ChainSolution) -> float:
        return float(solution.chain.parameters[index] - start.chain.parameters[index])

    def beyond(solution: ChainSolution) -> float:  # where the start is a turning point of ahead
        return float((solution.place - start.place) @ begin.tangent)

    for test in (ahead, beyond):
        if before is begin or not test(before.solution) * test(after.solution) < 0.0:
            continue
        spot = _met(curve, before, after, test)
        if spot is None:
            continue
        chain = spot.solution.chain
        close = np.abs(chain.parameters - start.chain.parameters).max() <= BACK
        if close and start.chain.repeats(chain, BACK):
            yield Event(PointType.CLOSED, spot.arclength, chain, final=True)
            return


def _changed(low: ChainSpot, high: ChainSpot) -> Callable[[Callable[[ChainSolution], float]], bool]:
    def changed(test: Callable[[ChainSolution], float]) -> bool:
        before, after = test(low.solution), test(high.solution)
        return before != 0.0 and ((before > 0.0) != (after > 0.0))

    return changed


def _located(
    curve: ChainCurve,
    low: ChainSpot,
    high: ChainSpot,
    test: Callable[[ChainSolution], float],
    kind: PointType,
) -> Iterator[Event]:
    """Yield the event at which a test changes its sign."""
    spot = _met(curve, low, high, test)
    if spot is not None:
        yield Event(kind, spot.arclength, spot.solution.chain, final=False)


def _met(
    curve: ChainCurve,
    low: ChainSpot,
    high: ChainSpot,
    test: Callable[[ChainSolution], float],
) -> ChainSpot | None:
    """Return the point at which a test changes its sign.

    Next to the crossing of two curves no point can be corrected, and the bracket is narrowed first.
    None where that does not help: so near to the beginning of a branch, or to its end in what is
    doubled there, that the event counts as that.
    """
    for _ in range(NARROWINGS):
        try:
            return curve.locate(low, high, test)
        except LostError:
            middle = curve.along(low, NARROWER * (high.arclength - low.arclength))
        if middle is None:
            return None
        if _changed(low, middle)(test):
            high = middle
        else:
            low = middle
    return None


def _halving(family: Family, curve: ChainCurve, low: ChainSpot, high: ChainSpot) -> Iterator[Event]:
    """Yield where a branch of doubled orbits turns back into itself: at what is doubled there."""
    apart, beyond = low.solution.chain.halves_apart, high.solution.chain.halves_apart
    if apart is None or beyond is None or not float(apart @ beyond) < 0.0:
        return
    size, reach = math.sqrt(float(apart @ apart)), math.sqrt(float(beyond @ beyond))
    share = size / (size + reach)
    # Not corrected: at the event itself the equations of the doubled orbit are singular.
    between = family.chain_at((1.0 - share) * low.place + share * high.place)
    half = None if between is None else between.halved()
    if between is None or half is None:
        return
    parents = Family(chain=half, active=family.active, ranges=family.ranges)
    equations = Curve(evaluate=parents.evaluate, largest_step=curve.largest_step)
    guess = parents.place_of(half)
    solution = parents.evaluate(guess)
    met = None
    if solution is not None:
        # Along its own branch, which may turn back in the parameter just there.
        begin = equations.start(guess, null_vector(solution.slopes))
        met = None if begin is None else equations.locate_near(begin, flip, curve.largest_step)
    arclength = (1.0 - share) * low.arclength + share * high.arclength
    if met is None:  # the branch ends all the same: beyond, it is itself again
        yield Event(PointType.LOST, arclength, between, final=True)
        return
    kind = PointType.SYMMETRY_BREAKING if half.symmetric else PointType.PERIOD_DOUBLING
    yield Event(kind, arclength, met.solution.chain, final=True)
