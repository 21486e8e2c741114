"""Borders of a family as bifurcation curves in two parameters, started from its columns.

The columns show where the bands are; the curves give it between the columns too, and to rounding.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from rocksteady import RocksteadyError
from rocksteady.arrays import Floats
from rocksteady.branches import BranchPoint, PointType, follow_bifurcation
from rocksteady.orbits import compute_region_boundaries
from rocksteady.studies.atlas.analysis.columns import Column, followed
from rocksteady.studies.atlas.analysis.families import FamilyMap
from rocksteady.studies.atlas.analysis.plane import Plane

Ranges = tuple[tuple[float, float], tuple[float, float]]

PARAMETERS = ("amplitude", "frequency_ratio")
STEP = 0.015
"""Largest step of arclength along a curve."""
MOST_POINTS = 400
NEAR = 0.01
"""Part of the plane's height by which a border may miss a curve that runs through it."""
FINE = 8
"""Points of a closed form to a column of the plane."""
NAMES = {
    PointType.SYMMETRY_BREAKING: ("symmetry-breaking",),
    PointType.PERIOD_DOUBLING: ("first-doubling", "second-doubling"),
    PointType.GRAZING: ("graze",),
    PointType.FOLD: ("fold",),
}


@dataclass(frozen=True, kw_only=True, eq=False)
class Line:
    """A curve in the plane.

    Attributes
    ----------
    order
        n of the family whose border it is.
    name
        "existence", "symmetry-breaking", "first-doubling", "second-doubling", "cascade-limit",
        "graze" or "fold".
    frequency_ratio, amplitude
        Its points, shape (points,).
    ends
        Why it ends, on either side.
    impacts
        In a period of the symmetric motion from which the family comes.
    """

    order: int
    name: str
    frequency_ratio: Floats
    amplitude: Floats
    ends: tuple[str, str]
    impacts: int = 2

    def amplitude_at(self, ratio: float) -> float:
        """Return the amplitude of the curve at a frequency between its points; nan beyond them."""
        for k, (left, right) in enumerate(pairwise(self.frequency_ratio.tolist())):
            if min(left, right) <= ratio <= max(left, right):
                share = (ratio - left) / (right - left) if right != left else 0.0
                low, high = self.amplitude[k : k + 2].tolist()
                return float(low + share * (high - low))
        return float("nan")


def family_lines(family: FamilyMap) -> tuple[Line, ...]:
    """Return the curves that border the bands of a family.

    Parameters
    ----------
    family
        Its bands.

    Returns
    -------
    tuple of Line
        The existence boundary in closed form, what bifurcates as far as it can be followed within
        the plane, and the end of the cascade through the columns.
    """
    lines = [_existence(family)]
    plane = family.plane
    for column in family.columns:
        names = [_name(column.ends, level) for level in range(len(column.ends))]
        begun = {
            level: name
            for level, name in enumerate(names)
            if name is not None and not _known(lines, name, column, level, plane)
        }
        if not begun:
            continue
        ratio = column.frequency_ratio
        _, points = followed(plane.restitution, ratio, plane.top, family.order)
        for level, name in begun.items():
            point = points[level]
            assert point is not None
            line = traced(point, name, _within(family))
            if line is not None:
                lines.append(replace(line, order=family.order))
    return (*lines, *_limits(family))


def _existence(family: FamilyMap) -> Line:
    plane = family.plane
    ratios = fine_ratios(plane)
    amplitude = compute_region_boundaries(ratios, plane.restitution, order=family.order).existence
    inside = amplitude <= plane.top
    return Line(
        order=family.order,
        name="existence",
        frequency_ratio=ratios[inside],
        amplitude=amplitude[inside],
        ends=("end-of-range", "end-of-range"),
    )


def fine_ratios(plane: Plane) -> Floats:
    """Return frequency ratios for a closed form across the plane."""
    left, right = plane.window[:2]
    return np.linspace(max(left, float(plane.ratios[0])), right, FINE * len(plane.ratios))


def _name(ends: Sequence[PointType | None], level: int) -> str | None:
    """Return what the curve through the end of a band is called.

    None where there is none, and of the third doubling, which shows nothing between the second and
    the end of the cascade.
    """
    end = ends[level]
    if end is None:
        return None
    names = NAMES[end]
    if end is PointType.PERIOD_DOUBLING:
        before = ends[:level].count(end)
        return names[before] if before < len(names) else None
    return names[0]


def _known(lines: Sequence[Line], name: str, column: Column, level: int, plane: Plane) -> bool:
    """Return whether a curve of that name runs through the end of a band."""
    border = column.borders[level]
    return any(
        line.name == name
        and abs(line.amplitude_at(column.frequency_ratio) - border) <= NEAR * plane.top
        for line in lines
    )


def _within(family: FamilyMap) -> Ranges:
    """Return the ranges in which borders of a family are followed."""
    plane = family.plane
    left, right = plane.window[:2]
    # As far down as the columns were followed: below, half cycles are too long for rounding.
    ratios = [c.frequency_ratio for c in family.columns if any(end is not None for end in c.ends)]
    lowest = 0.5 * float(np.nanmin(family.edges[0]))
    return (lowest, plane.top), (max(left, min(ratios)), right)


def traced(point: BranchPoint, name: str, within: Ranges) -> Line | None:
    """Return the curve through a bifurcation, followed to both sides; None where there is none.

    Parameters
    ----------
    point
        Point of a branch.
    name
        Name of the line.
    within
        Ranges of amplitude and frequency ratio.
    """
    halves: list[list[BranchPoint]] = []
    for direction in (-1, 1):
        try:
            curve = follow_bifurcation(
                point,
                PARAMETERS,
                within,
                direction=direction,
                largest_step=STEP,
                most_points=MOST_POINTS,
            )
            halves.append(list(curve))
        except RocksteadyError:
            return None
    points = [*reversed(halves[0]), *halves[1][1:]]
    return Line(
        order=point.period,
        name=name,
        frequency_ratio=np.array([each.frequency_ratio for each in points]),
        amplitude=np.array([each.amplitude for each in points]),
        ends=(str(halves[0][-1].type.value), str(halves[1][-1].type.value)),
    )


def _limits(family: FamilyMap) -> Iterator[Line]:
    """Yield the ends of the cascade where neighbouring columns have one."""
    run: list[tuple[float, float]] = []
    for column in (*family.columns, None):
        if column is not None and column.ends[-1:] == (PointType.PERIOD_DOUBLING,):
            run.append((column.frequency_ratio, column.limit))
        elif run:
            ratios, amplitudes = np.array(run).T
            yield Line(
                order=family.order,
                name="cascade-limit",
                frequency_ratio=ratios,
                amplitude=amplitudes,
                ends=("column", "column"),
            )
            run = []
