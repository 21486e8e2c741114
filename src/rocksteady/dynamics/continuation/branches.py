"""All connected branches over a parameter, followed through every bifurcation."""

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from rocksteady.dynamics.continuation._chain import MERGED, Chain
from rocksteady.dynamics.continuation._family import LARGEST_STEP, checked_ranges
from rocksteady.dynamics.continuation._from_orbit import chain_at
from rocksteady.dynamics.continuation._switching import switched
from rocksteady.dynamics.continuation.branch import follow_branch
from rocksteady.dynamics.continuation.points import Branch, BranchPoint, PointType
from rocksteady.dynamics.orbits.orbit import Orbit
from rocksteady.dynamics.parameters import PARAMETERS
from rocksteady.errors import InputError, ModelError
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import odd_order, whole_number

SAME = 1e-5
"""Difference of phases [rad] up to which two orbits are one."""
NEAR = 0.02
"""Difference of phases [rad] of an orbit and a chord between two points of its branch."""
SAME_PLACE = 1e-7
"""Difference of a parameter, relative to its range, up to which two bifurcations are one."""
DEPARTURES = (PointType.SYMMETRY_BREAKING, PointType.PERIOD_DOUBLING, PointType.GRAZING)


MOST = 1000
"""Of periods and impacts, as `find_orbits` has it."""


@checked
@dataclass(frozen=True, kw_only=True)
class BranchSearch:
    """Which branches a bifurcation diagram has.

    Parameters
    ----------
    order
        n = 1, 3, 5, ... of the symmetric motions in closed form from which branches are followed.
    max_period, max_impacts
        Longest orbits that are branched off to [forcing periods, impacts]; by default 4 times the
        order, and 12.
    max_branches
        After so many (default 100) no further one is begun at a bifurcation.
    everywhere
        Whether to start also from all motions that `find_orbits` finds at both ends of the range
        and in its middle; they may be many.
    doublings
        Of the longest cascade (default 6, at most 8); 0 follows none.

    Raises
    ------
    InputError
        If a number is outside its range.
    """

    order: int = 1
    max_period: int | None = None
    max_impacts: int = 12
    max_branches: int = 100
    everywhere: bool = False
    doublings: int = 6

    def __post_init__(self) -> None:
        """Validate."""
        hint = "give a whole number"
        order = odd_order(self.order)
        whole_number("order", order, at_least=1, at_most=MOST, hint="use 1, 3, 5, ...")
        longest = min(4 * order, MOST) if self.max_period is None else self.max_period
        for name, value, least, most in (
            ("max_period", longest, 1, MOST),
            ("max_impacts", self.max_impacts, 1, MOST),
            ("max_branches", self.max_branches, 1, 10 * MOST),
            ("doublings", self.doublings, 0, 8),
        ):
            whole = whole_number(name, value, at_least=least, at_most=most, hint=hint)
            object.__setattr__(self, name, whole)


@checked
def find_branches(
    origins: Iterable[Orbit | BranchPoint],
    parameter: str,
    within: tuple[float, float],
    *,
    max_period: int = 4,
    max_impacts: int = 12,
    max_branches: int = 100,
    largest_step: float = LARGEST_STEP,
) -> tuple[Branch, ...]:
    """Follow orbits over a parameter in both directions, and all branches that bifurcate from them.

    Of mirror images one is followed.  At a graze branches begin with the two new impacts in every
    half of a symmetric orbit and in one alone, and in every period or in every other; branches with
    one touch in three periods or more are not looked for.

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
        After so many no further one is begun.
    largest_step
        As for `follow_branch`.

    Returns
    -------
    tuple of Branch
        In the order in which they were found: a branch comes after the one it branches off.

    Raises
    ------
    InputError, ModelError
        If a value is outside its range, or an origin comes to rest.

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
    longest, most, count = (
        whole_number(name, value, at_least=1, at_most=100_000, hint="give a whole number")
        for name, value in (
            ("max_period", max_period),
            ("max_impacts", max_impacts),
            ("max_branches", max_branches),
        )
    )
    if not isinstance(origins, Iterable):
        raise InputError("origins", origins, "it must be a list of orbits", "put it into a list")
    found = _Found(parameter, within, longest, most, count, largest_step)
    for origin in origins:
        chain = chain_at(origin)
        checked_ranges(chain, (parameter,), (within,))
        if origin.admissible and not found.holds(chain):
            found.follow(origin)
    return tuple(found.branches)


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
            for one, other in pairwise(branch.points):
                near = _between(one.chain, other.chain, chain, index)
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
