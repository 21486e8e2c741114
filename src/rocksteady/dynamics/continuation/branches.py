"""All connected branches over a parameter, followed through every bifurcation."""

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Annotated

import numpy as np

from rocksteady.dynamics.continuation.branch import follow_branch
from rocksteady.dynamics.continuation.chains.chain import MERGED, Chain
from rocksteady.dynamics.continuation.chains.family import LARGEST_STEP, checked_ranges
from rocksteady.dynamics.continuation.chains.point_types import PointType
from rocksteady.dynamics.continuation.chains.switching import switched
from rocksteady.dynamics.continuation.from_orbit import chain_at
from rocksteady.dynamics.continuation.points import Branch, BranchPoint
from rocksteady.dynamics.orbits.attractor_sweep import AttractorSweep
from rocksteady.dynamics.orbits.orbit import Orbit
from rocksteady.dynamics.orbits.search import find_orbits
from rocksteady.dynamics.parameters import PARAMETERS, moved_to
from rocksteady.errors import InputError, ModelError, Words
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import INSIDE, Whole
from rocksteady.model.checks.validation import odd_order, whole_number
from rocksteady.model.equations import Model
from rocksteady.model.motions.fourier import PeriodicMotion
from rocksteady.model.motions.segments import Harmonic

SAME = 1e-5
"""Difference of phases [rad] up to which two orbits are one."""
NEAR = 0.02
"""Difference of phases [rad] of an orbit and a chord between two points of its branch."""
SAME_PLACE = 1e-7
"""Difference of a parameter, relative to its range, up to which two bifurcations are one."""
PLACES = 9
"""Values over the range at which orbits are computed in closed form, or a search of a block whose
sides differ."""
SEEDS = 24
"""Of phase and of speed each, of that search."""
DEPARTURES = (PointType.SYMMETRY_BREAKING, PointType.PERIOD_DOUBLING, PointType.GRAZING)


MOST_CYCLES = 1_000_000
"""Limit of a sweep's value, as for `find_attractor`."""
MOST = 1000
"""Limits of periods and impacts, as for `find_orbits`."""
UP_TO_MOST = Whole(1, MOST, "give a whole number")
MANY = Whole(1, 100_000, "give a whole number")


def _orders(name: str, value: Iterable[object]) -> tuple[int, ...]:
    """Return orders of symmetric motions, each once."""
    orders = tuple(dict.fromkeys(odd_order(name, order) for order in value))
    if not orders:
        raise InputError(name, value, "there must be one", "give orders=(1,)")
    for order in orders:
        whole_number(name, order, at_least=1, at_most=MOST, hint="use 1, 3, 5, ...")
    return orders


@checked
@dataclass(frozen=True, kw_only=True)
class BranchOptions:
    """Which branches a bifurcation diagram has.

    Parameters
    ----------
    orders
        Each n = 1, 3, 5, ... of the symmetric motions in closed form from which branches are
        followed (default 1 alone); sweeps that begin on a steady state take the first.
    max_period, max_impacts
        Longest orbits that are branched off to [forcing periods, impacts]; by default 4 times the
        largest order, and 12.
    max_branches
        Number of branches (default 100) after which no further one begins at a bifurcation.
    everywhere
        Whether to start also from all motions that `find_orbits` finds at both ends of the range
        and in its middle; they may be many.
    doublings
        Number of doublings of the longest cascade (default 6, at most 8); 0 follows none.
    max_cycles
        Forcing periods at each value of a sweep (default 2000), as for `find_attractor`.

    Raises
    ------
    InputError
        If a number is outside its range, or there is no order.

    Examples
    --------
    >>> few = BranchOptions(max_period=1, max_impacts=2, doublings=0)
    >>> few.max_branches
    100
    """

    orders: Annotated[tuple[int, ...], _orders] = (1,)
    max_period: Annotated[int | None, UP_TO_MOST] = None
    max_impacts: Annotated[int, UP_TO_MOST] = 12
    max_branches: Annotated[int, Whole(1, 10 * MOST, "give a whole number")] = 100
    everywhere: bool = False
    doublings: Annotated[int, Whole(0, 8, "give a whole number")] = 6
    max_cycles: Annotated[int, Whole(1, MOST_CYCLES, "give a whole number")] = 2000

    @property
    def longest(self) -> int:
        """Longest motions that are followed [forcing periods]: `max_period`, or its default."""
        longest = min(4 * max(self.orders), MOST)
        return longest if self.max_period is None else self.max_period


@checked
def find_branches(
    origins: Iterable[Orbit | BranchPoint],
    parameter: str,
    within: Annotated[tuple[float, float], INSIDE],
    *,
    max_period: Annotated[int, MANY] = 4,
    max_impacts: Annotated[int, MANY] = 12,
    max_branches: Annotated[int, MANY] = 100,
    largest_step: float = LARGEST_STEP,
) -> tuple[Branch, ...]:
    """Follow orbits over a parameter in both directions, and all branches that bifurcate from them.

    One of each pair of mirror images is followed; a block whose sides differ has none.  At a graze
    branches begin with the two new impacts in every half of a symmetric orbit and in one alone, and
    in every period or in every other; branches with one touch in three periods or more are not
    looked for.

    Parameters
    ----------
    origins
        Orbits without rest, as `rocksteady.find_orbits` finds them, or points of other branches;
        inadmissible ones and orbits that lie on a branch already followed are passed over.
    parameter
        "amplitude", "frequency_ratio" or "restitution".
    within
        Its range.
    max_period, max_impacts
        Longest orbits that are branched off to [forcing periods, impacts]: doublings and grazes
        make them longer without end.
    max_branches
        Number of branches after which no further one begins.
    largest_step
        As for `follow_branch`.

    Returns
    -------
    tuple of Branch
        In the order in which they were found: a branch comes after the one it branches off.

    Raises
    ------
    InputError, ModelError
        If a value is outside its range, or `follow_branch` refuses an origin.

    Examples
    --------
    >>> from rocksteady import DimensionlessBlock, Harmonic, find_orbits
    >>> motion = Harmonic(amplitude=2.0, frequency_ratio=2.2)
    >>> origins = find_orbits(DimensionlessBlock(restitution=0.8), motion, max_period=1)
    >>> for branch in find_branches(origins[:1], "frequency_ratio", (1.6, 2.4), max_period=2):
    ...     special = [f"{p.type} {p.frequency_ratio:.6f}" for p in branch.bifurcations]
    ...     print(branch.period, branch.symmetric, ", ".join(special))
    1 True symmetry-breaking 1.948378
    1 False symmetry-breaking 1.948378, period-doubling 1.789272
    2 False period-doubling 1.789272, period-doubling 1.774691
    """
    collection = _Found(parameter, within, max_period, max_impacts, max_branches, largest_step)
    for origin in origins:
        chain = chain_at(origin)
        checked_ranges(chain, (parameter,), (within,))
        if origin.admissible and not collection.holds(chain):
            collection.follow(origin)
    return tuple(collection.branches)


class _Found:
    """The branches found so far, and the bifurcations at which they begin or end."""

    def __init__(
        self,
        parameter: str,
        within: tuple[float, float],
        max_period: int,
        max_impacts: int,
        max_branches: int,
        largest_step: float,
    ) -> None:
        self.parameter, self.within = parameter, within
        self.max_period, self.max_impacts = max_period, max_impacts
        self.max_branches, self.largest_step = max_branches, largest_step
        self.branches: list[Branch] = []
        self.ends: list[BranchPoint] = []

    def follow(self, origin: Orbit | BranchPoint) -> None:
        """Follow an orbit in both directions, and all that branches off."""
        forward = self._points(origin, direction=1)
        backward: list[BranchPoint] = []
        if forward[-1].type is not PointType.CLOSED:
            backward = self._points(origin, direction=-1)
        # A start at an end of the range is that end, and no regular point beside it.
        if len(backward) > 1 and backward[1].arclength == 0.0:
            backward, forward = backward[:1], [backward[1], *forward[1:]]
        elif len(forward) > 1 and forward[1].arclength == 0.0:
            forward = forward[1:]
        before = [replace(point, arclength=-point.arclength) for point in reversed(backward[1:])]
        waiting = self._add([*before, *forward])
        while waiting and len(self.branches) < self.max_branches:
            point = waiting.pop(0)
            if self._known(point):
                continue
            points = self._points(point, switch=True)
            if len(points) > 1:  # else it is a graze beside which nothing is a motion
                waiting += self._add(points)

    def holds(self, chain: Chain) -> bool:
        """Return whether an orbit, or its mirror image, lies on a branch."""
        index = PARAMETERS.index(self.parameter)
        for branch in self.branches:
            for earlier, later in pairwise(branch.points):
                near = _between(earlier.chain, later.chain, chain, index)
                if near is not None and chain.repeats(near, NEAR, mirrors=True):
                    return True
        return False

    def _points(
        self, origin: Orbit | BranchPoint, *, direction: int = 1, switch: bool = False
    ) -> list[BranchPoint]:
        points = follow_branch(
            origin,
            self.parameter,
            self.within,
            direction=direction,
            switch=switch,
            largest_step=self.largest_step,
        )
        return list(points)

    def _add(self, points: list[BranchPoint]) -> list[BranchPoint]:
        """Keep a branch and return the points at which others may begin."""
        self.branches.append(Branch(parameter=self.parameter, points=tuple(points)))
        self.ends += [end for end in (points[0], points[-1]) if end.type in DEPARTURES]
        departures = [point for point in points if point.type in DEPARTURES]
        return [
            point
            for departure in departures
            for point in _variants(departure)
            if self._allowed(point)
        ]

    def _allowed(self, point: BranchPoint) -> bool:
        if point.type is PointType.GRAZING:
            more = 4 if point.symmetric else 2
            return point.period <= self.max_period and point.impacts + more <= self.max_impacts
        return point.type is PointType.SYMMETRY_BREAKING or (
            2 * point.period <= self.max_period and 2 * point.impacts <= self.max_impacts
        )

    def _known(self, point: BranchPoint) -> bool:
        """Return whether the branch that begins at a bifurcation has been followed."""
        chain = point.chain
        if point.type is PointType.GRAZING:
            try:
                chain, _ = switched(point.type, chain)
            except ModelError:  # of the last two impacts nothing would be left
                return True
        near = SAME_PLACE * (self.within[1] - self.within[0])
        value = getattr(point, self.parameter)
        return any(
            end.type is point.type
            and abs(getattr(end, self.parameter) - value) <= near
            and end.chain.repeats(chain, SAME, mirrors=True)
            for end in self.ends
        )


def _variants(point: BranchPoint) -> list[BranchPoint]:
    """Return the ways in which a branch may begin at a bifurcation.

    Where an orbit touches its base in each of its halves, or in each of two periods, the new one
    may have its impacts there in one of them alone.
    """
    if point.type is not PointType.GRAZING or np.abs(point.chain.durations).min() < MERGED:
        return [point]
    return [point, replace(point, chain=point.chain.doubled())]


def _between(one: Chain, other: Chain, chain: Chain, index: int) -> Chain | None:
    """Return the chain between two neighbours on a branch, at the parameter of another; or None."""
    shapes = {(each.impacts, each.half_cycles) for each in (one, other, chain)}
    low, high, value = (float(each.parameters[index]) for each in (one, other, chain))
    if len(shapes) > 1 or (low - value) * (high - value) > 0.0:
        return None
    share = (value - low) / (high - low) if high != low else 0.0
    turned = (other.turns - one.turns) * math.pi
    return one.moved(one.phases + share * (other.phases + turned - one.phases), chain.parameters)


def refuse_wall(block: Block | DimensionlessBlock, what: str) -> None:
    """Refuse a block against a wall.

    Raises
    ------
    InputError, ModelError
        If it is no block, or is such a one.
    """
    if block.dimensionless().one_sided:
        raise ModelError(
            "block",
            Words("stands against a wall"),
            f"{what} are followed of blocks that rock on both sides",
            "its periodic motions are found by `find_orbits`, along a parameter by "
            "`sweep_attractor`",
        )


def simple_orbits(
    block: Block | DimensionlessBlock,
    motion: PeriodicMotion,
    parameter: str,
    within: tuple[float, float],
    search: BranchOptions,
    model: Model,
) -> Iterator[Orbit]:
    """Yield the motions of each order with two impacts at several values.

    Under harmonic shaking of a block whose sides are alike they are symmetric, from the closed
    form.
    """
    low, high = within
    alike = block.symmetric and isinstance(motion, Harmonic)
    seeds = 1 if alike else SEEDS
    for order in search.orders:
        for place in range(PLACES):
            share = place / (PLACES - 1)
            here = moved_to(block, motion, parameter, (1.0 - share) * low + share * high)
            for orbit in find_orbits(
                *here, max_period=order, max_impacts=2, seeds=seeds, model=model
            ):
                known = orbit.branch is not None if alike else orbit.impacts == 2
                if known and orbit.period == order and orbit.admissible:
                    yield orbit


def searched_orbits(
    block: Block | DimensionlessBlock,
    motion: PeriodicMotion,
    parameter: str,
    within: tuple[float, float],
    search: BranchOptions,
    model: Model,
) -> Iterator[Orbit]:
    """Yield all orbits without rest that a search finds at both ends and in the middle."""
    low, high = within
    for value in (low, 0.5 * (low + high), high):
        here = moved_to(block, motion, parameter, value)
        longest, most = search.longest, search.max_impacts
        for orbit in find_orbits(*here, max_period=longest, max_impacts=most, model=model):
            if orbit.admissible and not orbit.rest_phases:
                yield orbit


def settled_orbits(sweeps: Iterable[AttractorSweep], search: BranchOptions) -> list[Orbit]:
    """Return an orbit in the middle of every run of one kind that sweeps met, short ones first.

    Those that come to rest have no branch.
    """
    orbits = [run[len(run) // 2].orbit for sweep in sweeps for _, _, run in sweep.runs()]
    fitting = [
        (orbit.period, orbit.impacts, orbit)
        for orbit in orbits
        if orbit is not None and orbit.impacts is not None
    ]
    return [
        orbit
        for period, impacts, orbit in sorted(fitting, key=lambda each: each[:2])
        if period <= search.longest and impacts <= search.max_impacts
    ]
