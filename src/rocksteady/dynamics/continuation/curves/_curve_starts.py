"""Curves of bifurcations that meet at a point of codimension two: where each begins."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.dynamics.continuation.chains.chain import Chain
from rocksteady.dynamics.continuation.chains.events import ChainCurve, ChainSpot
from rocksteady.dynamics.continuation.chains.family import Family
from rocksteady.dynamics.continuation.chains.point_types import BIFURCATIONS, PointType
from rocksteady.dynamics.continuation.chains.predictor_corrector import Curve, Spot, null_vector
from rocksteady.dynamics.continuation.curves._codimension_two import (
    curve_through,
    flip_type,
    free,
    grazed,
    merging,
    touching,
)
from rocksteady.errors import ModelError

BESIDE = 1e-5
"""Arclength at which the motions of a curve are tested for passing through the floor."""
FIRST_STEPS = (0.01, 0.02, 0.005, 0.04)
"""Arclength of the first step away from where the equations are singular, in turn."""
TOUCHING = 1e-9
"""Least height of an arc that touches the base."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Departure:
    """A curve that begins at a point, in one direction.

    Attributes
    ----------
    kind
        Kind of bifurcation.
    family, curve
        Its equations.
    begin
        The point, or the next one where the equations are singular at it.
    """

    kind: PointType
    family: Family
    curve: ChainCurve
    begin: ChainSpot


def departures(
    kind: PointType, chain: Chain, active: tuple[int, ...], ranges: Floats, step: float
) -> Iterator[list[Departure]]:
    """Yield the curves through a bifurcation or a point of codimension two, each way a departure.

    Parameters
    ----------
    kind, chain
        The point.
    active, ranges, step
        The parameters, as for `Family`, and the largest step.
    """
    given = (active, ranges, step)
    if kind in BIFURCATIONS:
        yield _regular(kind, chain, *given)
    elif kind is PointType.CUSP:
        yield _regular(PointType.FOLD, chain, *given)
    elif kind is PointType.FOLD_GRAZE:
        short = touching(chain)
        yield _regular(PointType.GRAZING, chain, *given)
        yield _regular(PointType.FOLD, short, *given)
    elif kind in (PointType.BREAKING_GRAZE, PointType.DOUBLING_GRAZE):
        short = touching(chain)
        yield _regular(flip_type(short), short, *given)
        yield _regular(PointType.GRAZING, chain, *given)
        yield _branched_graze(short, *given)
    elif kind in (PointType.GENERALISED_BREAKING, PointType.GENERALISED_DOUBLING):
        yield _regular(flip_type(chain), chain, *given)
        yield _branched_fold(chain, *given)
    elif kind is PointType.DOUBLE_GRAZE:
        for row in np.flatnonzero(np.abs(chain.shape[:, 1]) < TOUCHING):
            yield _other_graze(chain, int(row), *given)
    elif kind is PointType.RESONANT_GRAZE:
        short = touching(chain)
        yield _regular(PointType.GRAZING, chain, *given)
        longer = merging(short)
        yield _regular(PointType.FOLD, longer, *given)
        yield _regular(flip_type(longer), longer, *given)


def _regular(
    kind: PointType, chain: Chain, active: tuple[int, ...], ranges: Floats, step: float
) -> list[Departure]:
    """Return both ways of a curve through a point, or the way that stays above the floor."""
    family, curve = curve_through(kind, chain, active, ranges, step)
    begin = _start(family, curve, family.chain)
    if begin is None:
        return []
    height = free(kind, family.chain)
    ways = []
    for sign in (1.0, -1.0):
        spot = Spot(
            place=begin.place,
            tangent=sign * begin.tangent,
            solution=begin.solution,
            arclength=0.0,
        )
        near = curve.along(spot, BESIDE)
        if near is not None and height(near.solution) > 0.0:
            ways.append(Departure(kind=kind, family=family, curve=curve, begin=spot))
    return ways


def _start(family: Family, curve: ChainCurve, chain: Chain) -> ChainSpot | None:
    """Return the start of a curve through a chain, if it has one there."""
    place = family.place_of(chain)
    solution = family.evaluate(place)
    if solution is None or not np.isfinite(solution.slopes).all():
        return None
    return curve.start(place, null_vector(solution.slopes))


def _other_graze(
    chain: Chain, row: int, active: tuple[int, ...], ranges: Floats, step: float
) -> list[Departure]:
    """Return the graze of one arc of a chain, from where two of them graze."""
    conditions = (lambda spot: float(spot.shape[row, 1]),)
    family = Family(chain=chain, active=active, ranges=ranges, conditions=conditions)
    curve = Curve(evaluate=family.evaluate, largest_step=step)
    begin = _start(family, curve, chain)
    if begin is None:
        return []
    for sign in (1.0, -1.0):
        near = curve.along(replace(begin, tangent=sign * begin.tangent), FIRST_STEPS[-2])
        if near is None or grazed(near.solution.chain) != (row, False):
            continue
        if not free(PointType.GRAZING, near.solution.chain)(near.solution) > 0.0:
            continue
        # From here on the arc that grazes is the lowest one.
        family, curve = curve_through(PointType.GRAZING, near.solution.chain, active, ranges, step)
        return [Departure(kind=PointType.GRAZING, family=family, curve=curve, begin=near)]
    return []


def _branched_fold(
    half: Chain, active: tuple[int, ...], ranges: Floats, step: float
) -> list[Departure]:
    """Return the fold of the motions that branch off, from where it meets their flip."""
    along = half.null_direction(-1.0)
    twice = half.doubled()
    family, curve = curve_through(PointType.FOLD, twice, active, ranges, step)
    tangent = np.concatenate([along, -along, np.zeros(2)])
    return _singular(PointType.FOLD, family, curve, tangent, (1.0,))


def _branched_graze(
    half: Chain, active: tuple[int, ...], ranges: Floats, step: float
) -> list[Departure]:
    """Return the graze of the motions that branch off, from where their flip grazes.

    Along the flip the least height changes at a rate; along the graze that begins the new motion
    lies beside it by as much as keeps one of its two halves at the floor.  The other half is above.
    """
    flips, lines = curve_through(flip_type(half), half, active, ranges, step)
    begin = None if grazed(half)[1] else _start(flips, lines, half)
    if begin is None:
        return []
    twice = half.doubled()
    family, curve = curve_through(PointType.GRAZING, twice, active, ranges, step)
    place, arc = family.place_of(family.chain), grazed(family.chain)[0]
    # Phases in the units of the longer chain, of which an arc may begin in one half and end in the
    # other.
    phases = begin.tangent[: half.impacts] / np.sqrt(2.0)
    along = np.concatenate([phases, phases, begin.tangent[half.impacts :]])
    xi = half.null_direction(-1.0)
    aside = np.concatenate([xi, -xi, np.zeros(len(active))]) / family.phase_scale

    def slope(direction: Floats) -> float:
        """Return how the height of the arc changes in a direction."""
        ends = [family.chain_at(place + sign * BESIDE * direction) for sign in (1.0, -1.0)]
        high, low = (np.nan if end is None else float(end.shape[arc, 1]) for end in ends)
        return (high - low) / (2.0 * BESIDE)

    rate, bend = slope(along), slope(aside)
    if not np.isfinite([rate, bend]).all() or bend == 0.0:
        return []
    tangent = along - rate / bend * aside
    return _singular(PointType.GRAZING, family, curve, tangent, (1.0, -1.0))


def _singular(
    kind: PointType,
    family: Family,
    curve: ChainCurve,
    tangent: Floats,
    signs: tuple[float, ...],
) -> list[Departure]:
    """Return the way along a tangent from where equations are singular."""
    place = family.place_of(family.chain)
    solution = family.evaluate(place)
    if solution is None:
        return []
    height = free(kind, family.chain)
    for sign in signs:
        unit = sign * tangent / np.linalg.norm(tangent)
        spot = Spot(place=place, tangent=unit, solution=solution, arclength=0.0)
        for ahead in FIRST_STEPS:
            try:
                near = curve.along(spot, ahead)
            except ModelError:
                near = None
            if near is not None and height(near.solution) > 0.0:
                return [Departure(kind=kind, family=family, curve=curve, begin=near)]
    return []
