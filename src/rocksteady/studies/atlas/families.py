"""The stable motions that hang together with a symmetric one, column by column, exactly.

At one frequency a family is followed upwards in amplitude from its symmetric motion: to where that
loses its symmetry, then along the motions that lean, then along those of twice the period, and so
on.  Each part is stable until its own bifurcation, so that the bifurcations are the borders of the
bands, and nothing is sampled.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from rocksteady import (
    BranchPoint,
    DimensionlessBlock,
    Harmonic,
    Orbit,
    PointType,
    Steady,
    attractor,
    continuation,
    steady_states,
    symmetry_breaking_amplitude,
)
from rocksteady.errors import RocksteadyError
from rocksteady.studies.atlas.plane import Plane
from rocksteady.studies.folder import Done, nothing

Floats = NDArray[np.float64]

LEVELS = 4
"""Symmetric, leaning, doubled once and twice: three doublings say where infinitely many end."""
SCANNED = 48
"""Amplitudes at which a column is looked at for a stable symmetric motion to begin from."""
THIN = 1e-6
"""Height of a band of symmetric motions over the amplitude at which it begins, below which what
branches off is not followed: at low frequencies it comes near to rounding."""
FEIGENBAUM = 4.669201609
BORDERS = (
    PointType.FOLD,
    PointType.SYMMETRY_BREAKING,
    PointType.PERIOD_DOUBLING,
    PointType.GRAZING,
)


@dataclass(frozen=True, kw_only=True, eq=False)
class Column:
    """The bands of one family at one frequency.

    Attributes
    ----------
    frequency_ratio
        Omega.
    lowest
        Amplitude at which the stable symmetric motion begins; nan where there is none.
    borders
        Where each band ends, the symmetric one first, up to `LEVELS`; the plane's top where the
        band goes on beyond it.
    points
        The bifurcations there; None at the plane's top, and of a band too thin to be followed.
    followed
        Whether what branches off was followed: not of a band of symmetric motions below `THIN`.
    """

    frequency_ratio: float
    lowest: float = float("nan")
    borders: tuple[float, ...] = ()
    points: tuple[BranchPoint | None, ...] = field(default=(), repr=False)
    followed: bool = True

    @property
    def limit(self) -> float:
        """Where the cascade of doublings ends; the end of the last band where there is none.

        After three doublings, or two, the distances are taken to go on shrinking: by their last
        ratio, or by Feigenbaum's.
        """
        types = [point.type if point is not None else None for point in self.points]
        doublings = [
            border
            for border, kind in zip(self.borders, types, strict=True)
            if kind is PointType.PERIOD_DOUBLING
        ]
        last = self.borders[-1] if self.borders else self.lowest
        if len(doublings) < 2 or types[-1] is not PointType.PERIOD_DOUBLING:
            return last
        ratio = FEIGENBAUM
        if len(doublings) > 2:
            ratio = (doublings[1] - doublings[0]) / (doublings[2] - doublings[1])
        step = doublings[-1] - doublings[-2]
        return last + step / (ratio - 1.0) if ratio > 1.0 else last

    def band(self, level: int) -> tuple[float, float]:
        """Return the ends of a band; two equal numbers where it is not there."""
        edges = [self.lowest, *self.borders]
        edges += [edges[-1]] * (LEVELS + 1 - len(edges))
        return edges[level], edges[level + 1]


@dataclass(frozen=True, kw_only=True, eq=False)
class FamilyMap:
    """The bands of one family over the plane.

    Attributes
    ----------
    plane
        Where.
    order
        Half periods n of the shaking in a half cycle of the symmetric motion.
    columns
        One for each frequency ratio of the plane.
    """

    plane: Plane
    order: int
    columns: tuple[Column, ...]

    @cached_property
    def edges(self) -> Floats:
        """Ends of the bands, shape (4, columns): begin, symmetric, leaning, cascade.

        nan where there is no stable symmetric motion.
        """
        rows = [(c.lowest, c.band(0)[1], c.band(1)[1], c.limit) for c in self.columns]
        edges: Floats = np.minimum(np.array(rows).T, self.plane.top)
        edges[3] = np.maximum(edges[3], edges[2])
        return edges

    def area(self, band: int) -> float:
        """Return the part of the plane that a band takes: 0 symmetric, 1 leaning, 2 doubled."""
        left, right, low, high = self.plane.window
        heights = np.nan_to_num(self.edges[band + 1] - np.maximum(self.edges[band], low))
        ratios = self.plane.ratios
        # Each column stands for its cell, so that the outermost ones count to the window's edges.
        widths = np.diff([left, *(0.5 * (ratios[1:] + ratios[:-1])), right])
        return float(widths @ np.maximum(heights, 0.0) / ((right - left) * (high - low)))

    def stable(self, amplitude: Floats) -> NDArray[np.bool_]:
        """Return where a motion of the family is stable, shape (amplitudes, columns)."""
        rows = np.asarray(amplitude)[:, np.newaxis]
        inside: NDArray[np.bool_] = (rows > self.edges[0]) & (rows < self.edges[3])
        return inside


def family_map(plane: Plane, order: int, *, done: Done = nothing) -> FamilyMap:
    """Return the bands of one family over a plane.

    Parameters
    ----------
    plane
        Where.
    order
        n = 1, 3, 5, ...
    done
        Called after each column.
    """
    columns = []
    for ratio in plane.ratios.tolist():
        columns.append(column(plane.restitution, ratio, plane.top, order))
        done(f"n = {order}, Ω = {ratio:.4g}")
    return FamilyMap(plane=plane, order=order, columns=tuple(columns))


def column(restitution: float, ratio: float, top: float, order: int) -> Column:
    """Return the bands of one family at one frequency, up to an amplitude.

    Examples
    --------
    >>> bands = column(0.8, 2.0, 8.0, 1)
    >>> print(f"{bands.lowest:.6f}", [f"{border:.6f}" for border in bands.borders])
    0.236428 ['2.120167', '2.624661', '2.681132', '2.690529']
    >>> print(f"{bands.limit:.4f}")
    2.6924
    """
    states = steady_states(0.5, ratio, restitution, order=order)
    low, high = (
        float(states.existence),
        float(symmetry_breaking_amplitude(ratio, restitution, order=order)),
    )
    ceiling = min(high, top)
    if low >= top:
        return Column(frequency_ratio=ratio)
    if high - low < THIN * low:
        return Column(
            frequency_ratio=ratio, lowest=low, borders=(high,), points=(None,), followed=False
        )
    scan = low + (ceiling - low) * (np.arange(SCANNED) + 0.5) / SCANNED
    stable = steady_states(scan, ratio, restitution, order=order).stable[0]
    if not stable.any():
        return Column(frequency_ratio=ratio)
    first = int(np.argmax(stable))
    start = _orbit(float(scan[first]), ratio, restitution, order)
    if start is None:
        return Column(frequency_ratio=ratio)
    lowest, most = low, 1.02 * top
    if first > 0:  # it passes through the floor below
        under = border_of(start, (0.5 * low, most), direction=-1)
        lowest = low if under is None else under.amplitude
    ends: list[BranchPoint | None] = []
    for end in band_ends(start, (0.5 * low, most)):
        inside = end is not None and end.amplitude <= top
        ends.append(end if inside else None)
        if not inside:  # what follows lies above the plane too
            break
    borders = tuple(top if end is None else end.amplitude for end in ends)
    return Column(frequency_ratio=ratio, lowest=lowest, borders=borders, points=tuple(ends))


def band_ends(start: Orbit, within: tuple[float, float]) -> list[BranchPoint | None]:
    """Return the bifurcations at the ends of the bands above a stable symmetric motion."""
    return [*islice(_ends(start, within), LEVELS)]


def _ends(start: Orbit, within: tuple[float, float]) -> Iterator[BranchPoint | None]:
    """Yield the bifurcation at the end of each band; None, last of all, beyond the range."""
    here: Orbit | BranchPoint = start
    while True:
        end = border_of(here, within)
        yield end
        if end is None or end.type not in (PointType.SYMMETRY_BREAKING, PointType.PERIOD_DOUBLING):
            return  # at a graze and at a fold stability ends for good
        if not _sets_off_stable(end, within):
            return
        here = end


def border_of(
    start: Orbit | BranchPoint, within: tuple[float, float], *, direction: int = 1
) -> BranchPoint | None:
    """Return the first bifurcation of a branch, from a bifurcation of the one that begins there."""
    switch = isinstance(start, BranchPoint)
    branch = continuation(start, "amplitude", within, direction=direction, switch=switch)
    next(branch)
    return next((point for point in branch if point.type in BORDERS), None)


def _sets_off_stable(point: BranchPoint, within: tuple[float, float]) -> bool:
    """Return whether the branch that begins at a bifurcation is stable there: it bends upwards."""
    branch = continuation(point, "amplitude", within, switch=True)
    next(branch)
    following = next(branch, None)
    return following is not None and following.stable and following.amplitude > point.amplitude


def _orbit(amplitude: float, ratio: float, restitution: float, order: int) -> Orbit | None:
    """Return a stable symmetric motion."""
    block = DimensionlessBlock(restitution=restitution)
    shaking = Harmonic(amplitude=amplitude, frequency_ratio=ratio)
    try:
        found = attractor(block, shaking, start=Steady(order=order)).orbit
    except RocksteadyError:
        return None
    return found if found is not None and found.symmetric and found.period == order else None
