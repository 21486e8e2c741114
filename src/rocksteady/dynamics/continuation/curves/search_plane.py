"""Search for the bifurcation curves of a plane that hang together with the simplest motions."""

import heapq
import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from itertools import count, pairwise

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.dynamics.continuation.branches import (
    BranchOptions,
    find_branches,
    refuse_wall,
    searched_orbits,
    simple_orbits,
)
from rocksteady.dynamics.continuation.chains.chain import Chain
from rocksteady.dynamics.continuation.chains.family import LARGEST_STEP
from rocksteady.dynamics.continuation.chains.point_types import CODIMENSION_TWO, PointType
from rocksteady.dynamics.continuation.curves._curve_starts import Departure, departures
from rocksteady.dynamics.continuation.curves.bifurcation_curves import (
    BifurcationCurve,
    BifurcationCurves,
    CodimensionTwoPoint,
    CurveOptions,
    Region,
)
from rocksteady.dynamics.continuation.curves.loci import follow_curve
from rocksteady.dynamics.continuation.points import Branch, BranchPoint
from rocksteady.dynamics.orbits.return_map import harmonic
from rocksteady.dynamics.parameters import PARAMETERS, moved_to, range_of
from rocksteady.errors import InputError
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked
from rocksteady.model.equations import Model, ModelChoice, chosen_model
from rocksteady.model.motions.segments import Harmonic
from rocksteady.results.numbers import plural

Pair = tuple[float, float]

NEAR = 0.02
"""Difference of phases [rad] of an orbit and a chord between two points of its curve."""
BESIDE = 2e-3
"""Distance from such a chord, in parts of the ranges."""
NARROW = 0.01
"""Of a line across the plane: of what is narrower no region is named."""
SAME_PLACE = 1e-6
"""Distance of two points of codimension two that are one, in parts of the ranges."""


@checked
def find_bifurcation_curves(
    block: Block | DimensionlessBlock,
    motion: Harmonic,
    parameters: tuple[str, str] = ("frequency_ratio", "amplitude"),
    *,
    within: tuple[tuple[float, float], tuple[float, float]],
    search: CurveOptions | None = None,
    model: ModelChoice = None,
) -> BifurcationCurves:
    """Find the bifurcation curves of a plane, and the points of codimension two on them.

    Branches are followed on lines across the plane in either direction, from the symmetric motions
    in closed form, or those of the nonlinear model to which they lead.  Each bifurcation on them is
    followed in both parameters, and at each point of codimension two the curves that meet there.
    One of each pair of mirror images is followed.  A block whose sides differ has neither symmetric
    motions nor mirror images, and no symmetry breaks: all begins from motions with two impacts that
    a search finds.

    Parameters
    ----------
    block
        It rocks on both of its sides.  Over "restitution" both impacts have the same.
    motion
        Its own values of the two parameters do not count.
    parameters
        Two of "amplitude", "frequency_ratio" and "restitution".
    within
        The range of each.
    search
        Which curves are followed; by default `CurveOptions()`.
    model
        ``"linear"`` or ``"nonlinear"``; by default nonlinear for a `Block`.

    Returns
    -------
    BifurcationCurves
        Curves and points of codimension two: amplitudes over alpha g, frequencies over p.

    Raises
    ------
    InputError, ModelError
        If a value is outside its range, the block stands against a wall, or the nonlinear model
        meets a block without slenderness.

    Examples
    --------
    >>> from rocksteady import DimensionlessBlock, Harmonic
    >>> from rocksteady.branches import CurveOptions
    >>> block = DimensionlessBlock(restitution=0.87)
    >>> motion = Harmonic(amplitude=3.0, frequency_ratio=4.2)
    >>> few = CurveOptions(orders=(3,), lines=(1, 1), max_impacts=2, max_period=3)
    >>> curves = find_bifurcation_curves(block, motion, within=((4.4, 5.4), (2.5, 4.0)), search=few)
    >>> for each in curves.points:
    ...     point = each.point
    ...     print(point.type, f"{point.frequency_ratio:.8f} {point.amplitude:.8f}", each.curves)
    doubling-graze 5.13279136 3.75209273 (2, 3)
    resonant-graze 4.53615082 3.20580335 (3,)
    """
    refuse_wall(block, "bifurcation curves")
    equations = chosen_model(model, block)
    shaken, asked = harmonic(motion), CurveOptions() if search is None else search
    names, ranges = _checked_plane(block, shaken, parameters, within)
    lines = list(_lines(block, shaken, names, ranges, asked, equations))
    collection = _Found(names, ranges, asked)
    for line in lines:
        for branch in line.branches:
            for point in branch.bifurcations:
                collection.add(point)
    collection.follow()
    whole = all(line.complete for line in lines)
    return BifurcationCurves(
        block=block,
        motion=shaken,
        parameters=names,
        within=ranges,
        search=asked,
        curves=tuple(collection.curves),
        points=tuple(collection.meetings()),
        regions=tuple(_regions(lines, ranges)),
        complete=whole and not collection.waiting,
        model=equations,
    )


def _checked_plane(
    block: Block | DimensionlessBlock,
    motion: Harmonic,
    parameters: tuple[str, str],
    within: tuple[Pair, Pair],
) -> tuple[tuple[str, str], tuple[Pair, Pair]]:
    """Return the names of the two parameters and their ranges.

    Raises
    ------
    InputError
        If they are none.
    """
    choice = ", ".join(PARAMETERS)
    for name in parameters:
        if name not in PARAMETERS:
            valid = f"bifurcations are followed over {choice}"
            raise InputError("parameters", name, valid, "name two of them")
    if parameters[0] == parameters[1]:
        raise InputError("parameters", parameters, "they must differ", f"give two of {choice}")
    ranges = []
    for name, ends in zip(parameters, within, strict=True):
        low, high = range_of(ends, name)
        for end in (low, high):
            moved_to(block, motion, name, end)  # refuses what is outside its range
        ranges.append((low, high))
    return (str(parameters[0]), str(parameters[1])), (ranges[0], ranges[1])


@dataclass(frozen=True, kw_only=True, eq=False)
class _Line:
    """The branches on a line across the plane.

    Attributes
    ----------
    axis, value
        Index of the parameter over which they are, and the value of the other one.
    branches
        Branches of one order.
    complete
        Whether all were followed.
    """

    axis: int
    value: float
    branches: tuple[Branch, ...]
    complete: bool


def _lines(
    block: Block | DimensionlessBlock,
    motion: Harmonic,
    names: tuple[str, str],
    ranges: tuple[Pair, Pair],
    asked: CurveOptions,
    model: Model,
) -> Iterator[_Line]:
    """Yield the branches over each parameter at values of the other, those of each order."""
    for axis in (0, 1):
        low, high = ranges[1 - axis]
        lines = asked.lines[1 - axis]
        for place in range(lines):
            value = low + (high - low) * (place + 0.5) / lines
            body, shaken = moved_to(block, motion, names[1 - axis], value)
            for order in asked.orders:
                search = BranchOptions(
                    orders=(order,),
                    max_period=asked.longest,
                    max_impacts=asked.max_impacts,
                    max_branches=asked.max_branches,
                )
                case = (body, shaken, names[axis], ranges[axis], search, model)
                origins = [*simple_orbits(*case)]
                if asked.everywhere:
                    origins += searched_orbits(*case)
                branches = find_branches(
                    origins,
                    names[axis],
                    ranges[axis],
                    max_period=asked.longest,
                    max_impacts=asked.max_impacts,
                    max_branches=asked.max_branches + 1,
                )
                most = asked.max_branches  # one more shows that more would have begun
                yield _Line(
                    axis=axis,
                    value=value,
                    branches=branches[:most],
                    complete=len(branches) <= most,
                )


class _Found:
    """The curves found so far, and the bifurcations through which others may run."""

    def __init__(
        self, names: tuple[str, str], ranges: tuple[Pair, Pair], asked: CurveOptions
    ) -> None:
        self.names, self.asked = names, asked
        self.active = tuple(PARAMETERS.index(name) for name in names)
        self.ranges = np.array(ranges)
        self.widths = self.ranges[:, 1] - self.ranges[:, 0]
        self.curves: list[BifurcationCurve] = []
        self.waiting: list[tuple[int, int, int, BranchPoint]] = []
        self.number = count()

    def add(self, point: BranchPoint) -> None:
        """Keep a bifurcation for later, those of short motions first."""
        if point.period <= self.asked.longest:
            key = (point.period, point.impacts, next(self.number))
            heapq.heappush(self.waiting, (*key, point))

    def follow(self) -> None:
        """Follow what waits, and what is found on the way."""
        while self.waiting and len(self.curves) < self.asked.max_curves:
            *_, point = heapq.heappop(self.waiting)
            for ways in departures(point.type, point.chain, self.active, self.ranges, LARGEST_STEP):
                if len(self.curves) >= self.asked.max_curves:
                    self.add(point)
                    return
                if not ways or not self._allowed(ways[0]):
                    continue
                # Where two arcs graze both curves begin with one motion.
                twin = point.type is PointType.DOUBLE_GRAZE
                if twin or not self._known(ways[0].kind, ways[0].begin.solution.chain):
                    self._trace(point, ways)

    def _allowed(self, way: Departure) -> bool:
        chain = way.begin.solution.chain
        impacts = chain.impacts * (2 if chain.symmetric else 1)
        return chain.period <= self.asked.longest and impacts <= self.asked.max_impacts

    def _trace(self, origin: BranchPoint, ways: list[Departure]) -> None:
        """Follow a curve from a point, both ways where there are two."""
        halves = [
            list(follow_curve(way.family, way.curve, way.kind, way.begin, self.asked.most_points))
            for way in ways[:1]
        ]
        if len(ways) > 1 and halves[0][-1].type is not PointType.CLOSED:
            way = ways[1]
            halves.append(
                list(
                    follow_curve(way.family, way.curve, way.kind, way.begin, self.asked.most_points)
                )
            )
        kind = ways[0].kind
        special = origin.type in CODIMENSION_TWO
        chain = origin.chain if special else ways[0].begin.solution.chain
        middle = BranchPoint(type=origin.type if special else kind, arclength=0.0, chain=chain)
        before = (
            [replace(point, arclength=-point.arclength) for point in reversed(halves[1])]
            if len(halves) > 1
            else []
        )
        points = (*before, middle, *halves[0])
        if len(points) < 3 or (
            origin.type is PointType.DOUBLE_GRAZE
            and self._known(kind, points[len(points) // 2].chain)
        ):
            return
        self.curves.append(BifurcationCurve(type=kind, parameters=self.names, points=points))
        for point in points:
            if point.type in CODIMENSION_TWO and point is not middle:
                self.add(point)

    def _known(self, kind: PointType, chain: Chain) -> bool:
        """Return whether the curve of a kind through a chain has been followed already."""
        place = self._place(chain)
        for curve in self.curves:
            if curve.type is not kind:
                continue
            for earlier, later in pairwise(curve.points):
                near = self._between(earlier.chain, later.chain, chain, place)
                if near is not None and chain.repeats(near, NEAR, mirrors=True):
                    return True
        return False

    def _place(self, chain: Chain) -> Floats:
        scaled: Floats = chain.parameters[list(self.active)] / self.widths
        return scaled

    def _between(self, one: Chain, other: Chain, chain: Chain, place: Floats) -> Chain | None:
        """Return the chain of a chord between two neighbours beside a place; None elsewhere."""
        shapes = {(each.impacts, each.half_cycles) for each in (one, other, chain)}
        if len(shapes) > 1:
            return None
        begin, end = self._place(one), self._place(other)
        chord = end - begin
        length = float(chord @ chord)
        share = float((place - begin) @ chord) / length if length > 0.0 else 0.0
        share = min(1.0, max(0.0, share))
        if np.abs(begin + share * chord - place).max() > BESIDE:
            return None
        turned = (other.turns - one.turns) * math.pi
        return one.moved(
            one.phases + share * (other.phases + turned - one.phases), chain.parameters
        )

    def meetings(self) -> Iterator[CodimensionTwoPoint]:
        """Yield every point of codimension two once, with the curves that meet there."""
        listed: list[tuple[BranchPoint, list[int]]] = []
        for number, curve in enumerate(self.curves, start=1):
            for point in curve.points:
                if point.type not in CODIMENSION_TWO:
                    continue
                for known, numbers in listed:
                    if known.type is point.type and self._same(known, point):
                        if number not in numbers:
                            numbers.append(number)
                        break
                else:
                    listed.append((point, [number]))
        for point, numbers in listed:
            yield CodimensionTwoPoint(point=point, curves=tuple(numbers))

    def _same(self, one: BranchPoint, other: BranchPoint) -> bool:
        apart = self._place(one.chain) - self._place(other.chain)
        return bool(np.abs(apart).max() <= SAME_PLACE)


def _regions(lines: Iterable[_Line], ranges: tuple[Pair, Pair]) -> Iterator[Region]:
    """Yield the middle of each part of a line with one set of stable motions among those known."""
    merged: dict[tuple[int, float], list[Branch]] = {}
    for line in lines:
        merged.setdefault((line.axis, line.value), []).extend(line.branches)
    for (axis, value), branches in merged.items():
        spans: list[tuple[float, float, str]] = []
        for branch in branches:
            for part in branch.stretches:
                if part.stable:
                    ends = sorted(float(branch.values[k]) for k in (part.first, part.last))
                    spans.append((ends[0], ends[1], _motion_text(branch)))
        borders = sorted({end for low, high, _ in spans for end in (low, high)})
        parts: list[tuple[float, float, tuple[str, ...]]] = []
        for low, high in pairwise(borders):
            middle = 0.5 * (low + high)
            words_between = tuple(
                dict.fromkeys(word for first, last, word in spans if first < middle < last)
            )
            if not words_between:
                continue
            if parts and parts[-1][1] == low and parts[-1][2] == words_between:
                parts[-1] = (parts[-1][0], high, words_between)
            else:
                parts.append((low, high, words_between))
        for low, high, words_between in parts:
            if high - low < NARROW * (ranges[axis][1] - ranges[axis][0]):
                continue
            middle = 0.5 * (low + high)
            place = (middle, value) if axis == 0 else (value, middle)
            yield Region(place=place, motions=words_between, extent=(axis, low, high))


def _motion_text(branch: Branch) -> str:
    """Return what the motions of a branch are."""
    word = "symmetric" if branch.symmetric else "unsymmetric"
    return word if branch.period == 1 else f"{word}, {plural(branch.period, 'period')}"
