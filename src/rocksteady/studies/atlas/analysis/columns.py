"""Stable motions connected to a symmetric orbit at one frequency.

A family is followed upwards in amplitude from its symmetric motion: to where that loses its
symmetry, then along the motions that lean, then along those of twice the period, and so on.  Each
part is stable until its own bifurcation, so that the bifurcations are the borders of the bands, and
nothing is sampled.
"""

import functools
import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rocksteady import (
    DimensionlessBlock,
    Execution,
    Harmonic,
    RocksteadyError,
    Steady,
    find_attractor,
)
from rocksteady.arrays import Floats
from rocksteady.branches import BranchPoint, PointType, follow_branch
from rocksteady.formulas import steady_states, symmetry_breaking_amplitude
from rocksteady.orbits import Orbit
from rocksteady.studies.atlas.analysis.plane import Plane
from rocksteady.sweeps import Axis, Grid, Output, evaluate

LEVELS = 4
"""Symmetric, unsymmetric, doubled once and twice: three doublings determine where infinitely many
end."""
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
NO_BAND, BEYOND = 0, 1
"""Codes of how a band ends, before those of `BORDERS`: it is not there, or it has no known end."""
ENDS = {NO_BAND: "no-band", BEYOND: "beyond"} | {
    code: str(kind.value) for code, kind in enumerate(BORDERS, start=2)
}
OUTPUTS = (
    Output(name="lowest", long_name="amplitude at which the stable symmetric motion begins"),
    Output(name="followed", dtype=np.bool_),
    *(Output(name=f"border_{level}") for level in range(LEVELS)),
    *(Output(name=f"end_{level}", dtype=np.int8, flags=ENDS) for level in range(LEVELS)),
)


@dataclass(frozen=True, kw_only=True)
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
    ends
        Bifurcation at the end; None at the plane's top, and of a band too thin to be followed.
    followed
        Whether what branches off was followed: not of a band of symmetric motions below `THIN`.
    """

    frequency_ratio: float
    lowest: float = float("nan")
    borders: tuple[float, ...] = ()
    ends: tuple[PointType | None, ...] = ()
    followed: bool = True

    @property
    def limit(self) -> float:
        """Where the cascade of doublings ends; the end of the last band where there is none.

        After three doublings, or two, the distances are taken to go on shrinking: by their last
        ratio, or by Feigenbaum's.
        """
        doublings = [
            border
            for border, end in zip(self.borders, self.ends, strict=True)
            if end is PointType.PERIOD_DOUBLING
        ]
        last = self.borders[-1] if self.borders else self.lowest
        if len(doublings) < 2 or self.ends[-1] is not PointType.PERIOD_DOUBLING:
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


def columns(
    plane: Plane,
    order: int,
    ratios: ArrayLike,
    *,
    run: Execution | None = None,
) -> tuple[Column, ...]:
    """Return the bands of one family at several frequencies, up to the plane's top.

    Parameters
    ----------
    plane
        Its restitution and its top count.
    order
        n = 1, 3, 5, ...
    ratios
        Omega, shape (columns,).
    run
        As for `rocksteady.sweeps.evaluate`.
    """
    cases = functools.partial(_bands, restitution=plane.restitution, top=plane.top, order=order)
    grid = Grid(axes=(Axis(name="frequency_ratio", values=ratios),))
    data = evaluate(cases, grid, OUTPUTS, run=run)
    borders, codes = (
        np.array([data[f"{name}_{level}"].values for level in range(LEVELS)]).T.tolist()
        for name in ("border", "end")
    )
    return tuple(
        Column(
            frequency_ratio=ratio,
            lowest=lowest,
            borders=tuple(border[: len(ends)]),
            ends=ends,
            followed=followed,
        )
        for ratio, lowest, followed, border, ends in zip(
            data["frequency_ratio"].values.tolist(),
            data["lowest"].values.tolist(),
            data["followed"].values.tolist(),
            borders,
            map(_ends_of, codes),
            strict=True,
        )
    )


def _bands(
    frequency_ratio: Floats, *, restitution: float, top: float, order: int
) -> dict[str, NDArray[Any]]:
    """Return the bands at some frequencies as numbers."""
    columns_found = [column(restitution, ratio, top, order) for ratio in frequency_ratio.tolist()]
    rows = len(columns_found)
    borders, codes = np.full((LEVELS, rows), math.nan), np.full((LEVELS, rows), NO_BAND, np.int8)
    for row, each in enumerate(columns_found):
        borders[: len(each.borders), row] = each.borders
        codes[: len(each.ends), row] = [
            BEYOND if end is None else 2 + BORDERS.index(end) for end in each.ends
        ]
    return {
        "lowest": np.array([each.lowest for each in columns_found]),
        "followed": np.array([each.followed for each in columns_found]),
        **{f"border_{level}": values for level, values in enumerate(borders)},
        **{f"end_{level}": values for level, values in enumerate(codes)},
    }


def _ends_of(codes: list[int]) -> tuple[PointType | None, ...]:
    """Return how bands end by their codes."""
    return tuple(None if code == BEYOND else BORDERS[code - 2] for code in codes if code != NO_BAND)


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
    low, high = _symmetric_range(restitution, ratio, order)
    if low < top and high - low < THIN * low:
        return Column(
            frequency_ratio=ratio, lowest=low, borders=(high,), ends=(None,), followed=False
        )
    lowest, points = followed(restitution, ratio, top, order)
    return Column(
        frequency_ratio=ratio,
        lowest=lowest,
        borders=tuple(top if point is None else point.amplitude for point in points),
        ends=tuple(None if point is None else point.type for point in points),
    )


def followed(
    restitution: float, ratio: float, top: float, order: int
) -> tuple[float, tuple[BranchPoint | None, ...]]:
    """Return where the stable symmetric motion begins, and the bifurcations at the bands' ends.

    nan and none where there is no such motion; None, last of all, at the plane's top.
    """
    low, high = _symmetric_range(restitution, ratio, order)
    if low >= top:
        return math.nan, ()
    scan = low + (min(high, top) - low) * (np.arange(SCANNED) + 0.5) / SCANNED
    stable = steady_states(scan, ratio, restitution, order=order).stable[0]
    if not stable.any():
        return math.nan, ()
    first = int(np.argmax(stable))
    start = _orbit(float(scan[first]), ratio, restitution, order)
    if start is None:
        return math.nan, ()
    lowest, within = low, (0.5 * low, 1.02 * top)
    if first > 0:  # it passes through the floor below
        under = border_of(start, within, direction=-1)
        lowest = low if under is None else under.amplitude
    points: list[BranchPoint | None] = []
    for end in band_ends(start, within):
        inside = end is not None and end.amplitude <= top
        points.append(end if inside else None)
        if not inside:  # what follows lies above the plane too
            break
    return lowest, tuple(points)


def _symmetric_range(restitution: float, ratio: float, order: int) -> tuple[float, float]:
    """Return the amplitudes between which there are symmetric motions that may be stable."""
    states = steady_states(0.5, ratio, restitution, order=order)
    breaking = symmetry_breaking_amplitude(ratio, restitution, order=order)
    return float(states.existence), float(breaking)


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
    """Return the first bifurcation of a branch, from one of the branch that begins there."""
    switch = isinstance(start, BranchPoint)
    branch = follow_branch(start, "amplitude", within, direction=direction, switch=switch)
    next(branch)
    return next((point for point in branch if point.type in BORDERS), None)


def _sets_off_stable(point: BranchPoint, within: tuple[float, float]) -> bool:
    """Return whether the branch that begins at a bifurcation is stable there: it bends upwards."""
    branch = follow_branch(point, "amplitude", within, switch=True)
    next(branch)
    following = next(branch, None)
    return following is not None and following.stable and following.amplitude > point.amplitude


def _orbit(amplitude: float, ratio: float, restitution: float, order: int) -> Orbit | None:
    """Return a stable symmetric motion."""
    block = DimensionlessBlock(restitution=restitution)
    shaking = Harmonic(amplitude=amplitude, frequency_ratio=ratio)
    try:
        orbit = find_attractor(block, shaking, start=Steady(order=order)).orbit
    except RocksteadyError:
        return None
    return orbit if orbit is not None and orbit.symmetric and orbit.period == order else None
