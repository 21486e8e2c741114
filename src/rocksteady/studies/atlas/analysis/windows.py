"""Windows: narrow strips of stable symmetric motions with more than two impacts.

The search from many starts comes upon them; their borders are then followed exactly.
"""

from dataclasses import dataclass, replace

import numpy as np

from rocksteady import DimensionlessBlock, Harmonic, find_attractor
from rocksteady.branches import BranchPoint, PointType
from rocksteady.orbits import Orbit, find_attractors
from rocksteady.studies.atlas.analysis.coexistence import CYCLES, Coexistence, OrbitClass, starts
from rocksteady.studies.atlas.analysis.columns import band_ends, border_of
from rocksteady.studies.atlas.analysis.lines import NAMES, Line, traced

FEWEST = 4
"""Cells in which a class was found, from which on it is looked at."""
MOST = 2
"""Classes that are followed, those of most cells first."""
REACH = 0.3
"""Part of the amplitude by which the borders may lie away from the cell."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Window:
    """A strip with stable symmetric motions of one class.

    Attributes
    ----------
    orbits
        What they have in common.
    cells
        Number of cells in which the search has found them.
    frequency_ratio
        Frequency ratio of the cell from which the borders were followed.
    low, high
        Amplitudes there at which the stable symmetric motion begins and ends.
    last
        Amplitude there at which the last of the bands above it ends, as far as it was followed.
    lines
        The borders: of the symmetric motion "fold" and "symmetry-breaking", and "first-doubling".
    """

    orbits: OrbitClass
    cells: int
    frequency_ratio: float
    low: float
    high: float
    last: float
    lines: tuple[Line, ...]


def windows(result: Coexistence) -> tuple[Window, ...]:
    """Return the windows that a search has come upon, with exact borders.

    Parameters
    ----------
    result
        The search.
    """
    wanted = [
        (count, kind)
        for kind, count in result.classes.items()
        if (kind.impacts or 0) > 2
        and not kind.unsymmetric
        and kind.period % 2 == 1
        and count >= FEWEST
    ]
    several = (_window(result, kind, count) for count, kind in sorted(wanted, reverse=True)[:MOST])
    return tuple(window for window in several if window is not None)


def _window(result: Coexistence, kind: OrbitClass, count: int) -> Window | None:
    """Return the window of one class; None where its borders cannot be followed."""
    plane = result.plane
    cells = np.argwhere((result.codes == kind.code).any(axis=0))
    # From the cell at the highest frequency: there half cycles are short.
    row, column = max(cells.tolist(), key=lambda cell: cell[1])
    amplitude, ratio = float(plane.amplitudes[row]), float(plane.ratios[column])
    orbit = _orbit(kind, amplitude, ratio, plane.restitution)
    if orbit is None:
        return None
    within = ((1.0 - REACH) * amplitude, (1.0 + REACH) * amplitude)
    below = border_of(orbit, within, direction=-1)
    above = [point for point in band_ends(orbit, within) if point is not None]
    if below is None or not above:
        return None
    borders: list[tuple[str, BranchPoint]] = [(NAMES[below.type][0], below)]
    borders += [
        (NAMES[point.type][0], point) for point in above[:2] if point.type is not PointType.GRAZING
    ]
    left, right, low, _ = plane.window
    ranges = ((max(low, 0.01 * plane.top), plane.top), (max(left, 1.0), right))
    lines = (traced(point, name, ranges) for name, point in borders)
    assert kind.impacts is not None
    return Window(
        orbits=kind,
        cells=count,
        frequency_ratio=ratio,
        low=below.amplitude,
        high=above[0].amplitude,
        last=above[-1].amplitude,
        lines=tuple(
            replace(line, order=kind.period, impacts=kind.impacts)
            for line in lines
            if line is not None
        ),
    )


def _orbit(kind: OrbitClass, amplitude: float, ratio: float, restitution: float) -> Orbit | None:
    """Return an orbit of a class that the search has found at a point."""
    here = np.array([amplitude]), np.array([ratio])
    for velocity, phase in starts(*here, restitution):
        settled = find_attractors(
            *here, restitution, velocity=velocity, phase=phase, max_cycles=CYCLES
        )
        if (settled.period[0], settled.impacts[0]) != (kind.period, kind.impacts):
            continue
        orbit = find_attractor(
            DimensionlessBlock(restitution=restitution),
            Harmonic(amplitude=amplitude, frequency_ratio=ratio),
            start=settled.start(0),
        ).orbit
        if orbit is not None and orbit.symmetric and orbit.period == kind.period:
            return orbit
    return None
