"""Orbits from which the branches of a diagram are followed."""

from collections.abc import Iterable, Iterator

from rocksteady.dynamics.orbits.attractor_sweep import AttractorSweep
from rocksteady.dynamics.orbits.orbit import Orbit
from rocksteady.dynamics.orbits.search import find_orbits
from rocksteady.dynamics.parameters import moved_to
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.motions.segments import Harmonic

PLACES = 9
"""Values over the range at which closed forms are asked for orbits."""


def symmetric_orbits(
    block: DimensionlessBlock,
    motion: Harmonic,
    parameter: str,
    within: tuple[float, float],
    order: int,
) -> Iterator[Orbit]:
    """Yield the symmetric orbits of an order at several values, where they are motions."""
    low, high = within
    for place in range(PLACES):
        share = place / (PLACES - 1)
        here = moved_to(block, motion, parameter, (1.0 - share) * low + share * high)
        for orbit in find_orbits(*here, max_period=order, max_impacts=2, seeds=1):
            if orbit.branch is not None and orbit.period == order and orbit.admissible:
                yield orbit


def searched_orbits(
    block: DimensionlessBlock,
    motion: Harmonic,
    parameter: str,
    within: tuple[float, float],
    max_period: int,
    max_impacts: int,
) -> Iterator[Orbit]:
    """Yield all orbits without rest that a search finds at both ends and in the middle."""
    low, high = within
    for value in (low, 0.5 * (low + high), high):
        here = moved_to(block, motion, parameter, value)
        for orbit in find_orbits(*here, max_period=max_period, max_impacts=max_impacts):
            if orbit.admissible and not orbit.rest_phases:
                yield orbit


def settled_orbits(
    trails: Iterable[AttractorSweep], max_period: int, max_impacts: int
) -> list[Orbit]:
    """Return an orbit in the middle of every run of one kind that trails met, short ones first.

    Those that come to rest have no branch.
    """
    found = [run[len(run) // 2].orbit for trail in trails for _, _, run in trail.runs()]
    fitting = [
        (orbit.period, orbit.impacts, orbit)
        for orbit in found
        if orbit is not None and orbit.impacts is not None
    ]
    return [
        orbit
        for period, impacts, orbit in sorted(fitting, key=lambda each: each[:2])
        if period <= max_period and impacts <= max_impacts
    ]
