"""Points of codimension two on a bifurcation curve: where a second condition is met.

Each kind of curve has its tests, numbers that change their sign where the second condition is met,
and the ends at which its motions touch the floor or become those from which they branch off
(`docs/theory/codimension-two.md` has the list, and why there are no others).
"""

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from rocksteady.dynamics.continuation.chains.chain import MERGED, Chain
from rocksteady.dynamics.continuation.chains.events import ChainCurve, ChainSpot, Event
from rocksteady.dynamics.continuation.chains.family import ChainSolution, Family, Test
from rocksteady.dynamics.continuation.chains.point_types import PointType
from rocksteady.dynamics.continuation.chains.predictor_corrector import (
    Curve,
    LostError,
    null_vector,
)
from rocksteady.dynamics.continuation.chains.switching import switched
from rocksteady.dynamics.continuation.curves._normal_forms import flip_coefficient, fold_coefficient
from rocksteady.errors import ModelError

Test2 = Callable[[ChainSolution], float]

MEETING = 1e-6
"""Duration of an arc, at the end of a curve, that counts as a merging of impacts."""
ALIKE = 0.2
"""Difference of the halves of a chain [rad] at the end of a curve up to which they may be one."""
REACH = 0.05
"""Arclength up to which an end is looked for along the curve that meets there."""


def condition(kind: PointType, chain: Chain) -> Test:
    """Return what vanishes along the curve of a kind of bifurcation.

    Parameters
    ----------
    kind
        Kind of the curve.
    chain
        On it: its sizes scale the determinants, and the arc that grazes is the one of it.
    """
    if kind is not PointType.GRAZING:
        closing, sizes = 1.0 if kind is PointType.FOLD else -1.0, chain.sizes
        return lambda chain: chain.scaled_determinant(closing, sizes)
    row, merged = grazed(chain)
    if merged:
        return lambda chain: float(chain.durations[row])
    return lambda chain: float(chain.shape[row, 1])


def grazed(chain: Chain) -> tuple[int, bool]:
    """Return the arc that grazes, and whether it has no duration."""
    row = int(np.argmin(np.abs(chain.durations)))
    if abs(chain.durations[row]) < MERGED:
        return row, True
    return int(np.nanargmin(chain.shape[:, 1])), False


def curve_through(
    kind: PointType, chain: Chain, active: tuple[int, ...], ranges: "np.ndarray", step: float
) -> tuple[Family, ChainCurve]:
    """Return the equations of the curve of a kind of bifurcation near a chain.

    A graze is followed without the two impacts that merge at it: further touches of that motion,
    which the merging hides, are then repetitions of one touch and not points of the curve.
    """
    chain = touching(chain) if kind is PointType.GRAZING else chain
    conditions = (condition(kind, chain),)
    family = Family(chain=chain, active=active, ranges=ranges, conditions=conditions)
    return family, Curve(evaluate=family.evaluate, largest_step=step)


def flip_type(chain: Chain) -> PointType:
    """Return what a multiplier -1 of a chain is."""
    return PointType.SYMMETRY_BREAKING if chain.symmetric else PointType.PERIOD_DOUBLING


def graze_type(kind: PointType) -> PointType:
    """Return what a bifurcation is whose motion grazes."""
    return {
        PointType.FOLD: PointType.FOLD_GRAZE,
        PointType.SYMMETRY_BREAKING: PointType.BREAKING_GRAZE,
        PointType.PERIOD_DOUBLING: PointType.DOUBLING_GRAZE,
    }.get(kind, PointType.DOUBLE_GRAZE)


def meetings(
    kind: PointType, family: Family, curve: ChainCurve, before: ChainSpot, after: ChainSpot
) -> list[Event]:
    """Return the points of codimension two between two neighbouring points of a curve.

    Parameters
    ----------
    kind
        Kind of the curve.
    family, curve
        Its equations.
    before, after
        The two points.
    """
    ends = [*_joining(kind, family, curve, before, after)]
    ends = ends or [*_touching(kind, family, curve, before, after)]
    events = [*ends]
    for named, test in _tests(kind, before):
        low, high = test(before.solution), test(after.solution)
        if not low * high < 0.0:
            continue
        try:
            spot = curve.locate(before, after, test)
        except LostError:
            continue
        events.append(Event(named, spot.arclength, spot.solution.chain, final=False))
    return events


def _tests(kind: PointType, before: ChainSpot) -> Iterator[tuple[PointType, Test2]]:
    """Yield the types of points inside a curve with the numbers that change sign there."""
    chain = before.solution.chain
    if kind is PointType.FOLD:
        along = chain.null_direction(1.0)
        yield PointType.CUSP, lambda solution: fold_coefficient(solution.chain, along)
        return
    if kind is not PointType.GRAZING:
        symmetric = kind is PointType.SYMMETRY_BREAKING
        named = PointType.GENERALISED_BREAKING if symmetric else PointType.GENERALISED_DOUBLING
        yield named, generalised
        return
    for named, part, closing in (
        (PointType.FOLD_GRAZE, touching, 1.0),
        (graze_type(flip_type(touching(chain))), touching, -1.0),
        (PointType.RESONANT_GRAZE, merging, 1.0),
    ):
        sizes = part(chain).sizes

        def value(
            solution: ChainSolution,
            part: Callable[[Chain], Chain] = part,
            closing: float = closing,
            sizes: "np.ndarray" = sizes,
        ) -> float:
            moved = part(solution.chain)
            return moved.scaled_determinant(closing, sizes) if len(sizes) == moved.impacts else 0.0

        yield named, value


def generalised(solution: ChainSolution) -> float:
    """Return what vanishes at a generalised flip.

    The coefficient itself has a pole where fold and flip meet, at the merging of impacts.
    """
    return flip_coefficient(solution.chain) * solution.chain.determinant(1.0)


def touching(chain: Chain) -> Chain:
    """Return a chain at a graze without the two impacts that merge there.

    Where there are no others the motion never leaves its side.  It has the period of the shaking,
    as the difference of two such motions grows without bound, and keeps the two impacts of one
    touch, without which there is no chain.
    """
    row, merged = grazed(chain)
    if not merged:
        return chain
    if chain.impacts > 2:
        return switched(PointType.GRAZING, chain)[0]
    turns = chain.turns[row] + np.array([0, 2 * row])
    return replace(chain, turns=turns, phases=np.full(2, chain.phases[row]), half_cycles=2)


def merging(chain: Chain) -> Chain:
    """Return a chain at a graze with the two impacts that merge there."""
    return chain if grazed(chain)[1] else switched(PointType.GRAZING, chain)[0]


def free(kind: PointType, chain: Chain) -> Test2:
    """Return the least height and duration of a chain, except the arc that grazes by itself."""
    row, merged = grazed(chain) if kind is PointType.GRAZING else (-1, False)

    def value(solution: ChainSolution) -> float:
        rows = np.arange(solution.chain.impacts)
        durations = solution.chain.durations[rows != row if merged else rows >= 0]
        others = rows != row
        if merged:  # the arcs before and after it touch the base there too, at an end of theirs
            when, ends = solution.chain.shape[:, 2], solution.chain.durations
            beside = np.array([row - 1, row + 1]) % len(rows)
            at_end = (when < MEETING) | (when > ends - MEETING)
            others[beside[at_end[beside]]] = False
        dip = float(np.nanmin(solution.chain.shape[others, 1], initial=1.0))
        return min(dip, float(durations.min(initial=1.0)))

    return value


def _touching(
    kind: PointType, family: Family, curve: ChainCurve, before: ChainSpot, after: ChainSpot
) -> Iterator[Event]:
    """Yield where the motions of a curve meet the floor, elsewhere than they do all along."""
    height = free(kind, family.chain)
    if not height(before.solution) > 0.0 >= height(after.solution):
        return
    if kind is PointType.GRAZING:
        # Of what branches off where a symmetry breaks or a period doubles both halves graze there.
        share = height(before.solution) - height(after.solution)
        share = height(before.solution) / share
        half = _half_at(family, before, after, share, ALIKE)
        if half is not None:
            met = _met(kind, half, family, curve, lambda solution: solution.flip)
            if met is not None:
                arclength = before.arclength + share * (after.arclength - before.arclength)
                named = graze_type(flip_type(half))
                yield Event(named, arclength, met, final=True)
                return
    spot = curve.locate(before, after, height)
    chain = spot.solution.chain
    named = graze_type(kind)
    if kind is not PointType.GRAZING and abs(chain.shortest) < MEETING:
        named = PointType.RESONANT_GRAZE
    yield Event(named, spot.arclength, chain, final=True)


def _joining(
    kind: PointType, family: Family, curve: ChainCurve, before: ChainSpot, after: ChainSpot
) -> Iterator[Event]:
    """Yield where the fold of motions that branched off comes to where they branch off."""
    apart, beyond = (spot.solution.chain.halves_apart for spot in (before, after))
    if kind is not PointType.FOLD or apart is None or beyond is None:
        return
    if not float(apart @ beyond) < 0.0:
        return
    size, reach = float(np.linalg.norm(apart)), float(np.linalg.norm(beyond))
    share = size / (size + reach)
    half = _half_at(family, before, after, share, np.inf)
    if half is None:
        return
    flip = flip_type(half)
    chain = _met(flip, half, family, curve, generalised)
    arclength = before.arclength + share * (after.arclength - before.arclength)
    if chain is None:
        between = family.chain_at((1.0 - share) * before.place + share * after.place)
        if between is not None:
            yield Event(PointType.LOST, arclength, between, final=True)
        return
    named = PointType.GENERALISED_BREAKING if half.symmetric else PointType.GENERALISED_DOUBLING
    yield Event(named, arclength, chain, final=True)


def _half_at(
    family: Family, before: ChainSpot, after: ChainSpot, share: float, tolerance: float
) -> Chain | None:
    """Return the chain of half the length between two points; None where the halves differ."""
    between = family.chain_at((1.0 - share) * before.place + share * after.place)
    if between is None:
        return None
    apart, half = between.halves_apart, between.halved()
    if apart is None or half is None or np.abs(apart).max() > tolerance:
        return None
    return half


def _met(
    kind: PointType, half: Chain, family: Family, curve: ChainCurve, test: Test2
) -> Chain | None:
    """Return the point near a chain at which a test vanishes on the curve of a kind through it."""
    step = curve.largest_step
    # The chain lies only near to its curve: its own lowest arc is the arc that grazes.
    if kind is PointType.GRAZING and not np.isfinite(half.shape[:, 1]).any():
        return None
    parents, equations = curve_through(kind, half, family.active, family.ranges, step)
    guess = parents.place_of(half)
    solution = parents.evaluate(guess)
    if solution is None or not np.isfinite(solution.slopes).all():
        return None
    begin = equations.start(guess, null_vector(solution.slopes))
    if begin is None:
        return None
    try:
        spot = equations.locate_near(begin, test, REACH)
    except (LostError, ModelError):
        return None
    if spot is None or np.abs(spot.place - guess).max() > REACH:
        return None
    return spot.solution.chain
