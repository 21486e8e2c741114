"""The search for all windows of amplitude in which one pulse at one frequency overturns a block.

Over the amplitude the block's fate is piecewise constant.  What decides it, the margin of
`rocksteady.kernels.pulsed`, is continuous, so that every border of fates is a zero of it, and every
border between ways of overturning a change of the impacts on the way.  The search looks in four
ways, each of which adds amplitudes to those that have been tried:

1. A grid: no two amplitudes of the first round are further apart than a stated part of themselves,
   and towards uplift (a = 1) they crowd together.
2. Between neighbours whose itineraries differ (impacts and side at the pulse's end, impacts and
   side of overturning) the interval is halved until it is `FINE`: there flights graze, the margin
   has its kinks, and a window may begin and end close by.
3. Likewise where the margin could come to zero between two neighbours if inside the interval it
   were `STEEPER` times as steep as there and in the two intervals beside it.
4. Around every amplitude at which the margin of a block that stands is larger than at both
   neighbours, or that of one that falls smaller, both intervals are halved until they are `FINEST`:
   the hump may reach over zero between them.

What is left are neighbours of different fate, which bisection brings together to rounding.  So a
window, or a gap in one, is missed only if the margin has between two neighbours a hump that neither
itineraries nor slopes nor maxima around it announce, and that is narrower than the grid's step, or
than `FINE` in a doubtful place.  No bound on the slope is known: where flights graze it has none.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

FINEST = 1e-7
"""Part of an amplitude to which intervals beside a hump of the margin are halved."""
FINE = 1e-5
"""The same of intervals whose ends differ, and of those in which the margin may come to zero."""
STEEPER = 2.0
"""How many times as steep as there the margin may be inside an interval."""
NEAREST = 1e-6
"""How close to uplift, a = 1, the grid begins."""
DECADE = 16
"""Points of the grid in a decade of a - 1."""
ROUNDS = 60
"""Of halvings: as many as a double has digits, and some."""


class Fates(NamedTuple):
    """What becomes of the block, an array each of shape (amplitudes,)."""

    overturns: NDArray[np.bool_]
    decided: NDArray[np.bool_]
    impacts: Integers
    """Until it overturns."""
    side: Integers
    during: Integers
    """Impacts and side at the pulse's end, as one number."""
    margin: Floats


class Found(NamedTuple):
    """The windows at one frequency, in ascending order: arrays of shape (windows,)."""

    low: Floats
    high: Floats
    impacts: Integers
    side: Integers
    undecided: int
    """Amplitudes whose fate the march could not decide; each counts as one that stands."""
    tried: int


def scan(follow: Callable[[Floats], Fates], low: float, high: float, step: float) -> Found:
    """Return every window between two amplitudes.

    Parameters
    ----------
    follow
        Returns the fates at some amplitudes.
    low, high
        Ends of the range, in units of alpha g.
    step
        Largest distance of neighbours on the grid, as a part of the amplitude.
    """
    amplitude = first_grid(low, high, step)
    fates = follow(amplitude)
    for _ in range(ROUNDS):
        doubtful = _doubtful(amplitude, fates)
        if not doubtful.any():
            break
        amplitude, fates = _with_middles(follow, amplitude, fates, np.flatnonzero(doubtful))
    return _windows(follow, amplitude, fates)


def first_grid(low: float, high: float, step: float) -> Floats:
    """Return the amplitudes of the first round, ends included.

    No block lifts at 1 or below, so that nothing is tried there but the lower end.
    """
    floor = max(low, 1.0)
    if high <= floor:
        return np.unique([low, high])
    count = int(np.ceil(np.log(high / floor) / np.log1p(step))) + 1
    even = np.geomspace(floor, high, max(count, 2))
    nearest = max(floor - 1.0, NEAREST)
    crowded = np.zeros(0)
    if high - 1.0 > nearest:
        decades = np.log10((high - 1.0) / nearest)
        crowded = 1.0 + np.geomspace(nearest, high - 1.0, int(np.ceil(DECADE * decades)) + 1)
    points = np.concatenate([[low], even, crowded])
    # Ends that rounding has moved, and neighbours that it has made one.
    return np.unique(np.clip(points, low, high))


def _doubtful(amplitude: Floats, fates: Fates) -> NDArray[np.bool_]:
    """Return which intervals are to be halved, shape (amplitudes - 1,)."""
    margin = np.where(fates.overturns, -fates.margin, fates.margin)  # its distance from zero, < 0
    lifted = fates.overturns | (margin > -1.0)  # -1 is that of a block at rest
    inner = slice(1, -1)
    hump = np.zeros(len(amplitude), dtype=np.bool_)
    hump[inner] = (
        lifted[inner]
        & (margin[inner] > margin[:-2])  # of a plateau only its beginning
        & (margin[inner] >= margin[2:])
        & (fates.overturns[inner] == fates.overturns[:-2])
        & (fates.overturns[inner] == fates.overturns[2:])
    )
    width = np.diff(amplitude)
    finest, fine = width > FINEST * amplitude[1:], width > FINE * amplitude[1:]
    doubtful: NDArray[np.bool_] = ((hump[:-1] | hump[1:]) & finest) | (
        (_differ(fates, during=True) | _steep(width, margin)) & fine
    )
    return doubtful


def _steep(width: Floats, margin: Floats) -> NDArray[np.bool_]:
    """Return in which intervals the margin may come to zero if it is nowhere steeper than around.

    Shape (amplitudes - 1,); of the margin's distance from zero, below 0, shape (amplitudes,).
    """
    slope = np.abs(np.diff(margin)) / width
    around = np.maximum(np.maximum(slope, np.append(slope[1:], 0.0)), np.append(0.0, slope[:-1]))
    reach: NDArray[np.bool_] = np.maximum(margin[1:], margin[:-1]) + STEEPER * around * width > 0.0
    return reach


def _differ(fates: Fates, *, during: bool) -> NDArray[np.bool_]:
    """Return between which neighbours the way of overturning changes, or what leads to it."""
    columns = [fates.overturns, fates.impacts * fates.overturns, fates.side]
    if during:
        columns.append(fates.during)
    found = np.zeros(len(fates.overturns) - 1, dtype=np.bool_)
    for column in columns:
        found |= column[1:] != column[:-1]
    return found


def _with_middles(
    follow: Callable[[Floats], Fates], amplitude: Floats, fates: Fates, where: Integers
) -> tuple[Floats, Fates]:
    """Return amplitudes and fates with the middle of some intervals among them."""
    middle = 0.5 * (amplitude[where] + amplitude[where + 1])
    more, count = follow(middle), len(amplitude)
    order = np.insert(np.arange(count), where + 1, np.arange(count, count + len(where)))
    merged = (np.concatenate([column, new])[order] for column, new in zip(fates, more, strict=True))
    return np.concatenate([amplitude, middle])[order], Fates(*merged)


def _windows(follow: Callable[[Floats], Fates], amplitude: Floats, fates: Fates) -> Found:
    """Return the windows that amplitudes close enough show, their borders to rounding.

    All intervals whose ends differ are halved together; where a third way turns up between two,
    both halves go on.
    """
    tried, undecided = len(amplitude), int((~fates.decided).sum())
    where = np.flatnonzero(_differ(fates, during=False))
    # The ends and both sides of every border say it all.
    kept = np.unique(np.concatenate([[0, len(amplitude) - 1], where, where + 1]))
    amplitude, fates = amplitude[kept], Fates(*(column[kept] for column in fates))
    while True:
        where = np.flatnonzero(_differ(fates, during=False))
        apart = where[_apart(amplitude, where)]
        if not apart.size:
            break
        amplitude, fates = _with_middles(follow, amplitude, fates, apart)
        tried += len(apart)
    starts = np.concatenate([[0], where + 1])
    stops = np.concatenate([where, [len(amplitude) - 1]])
    falls = fates.overturns[starts]
    starts, stops = starts[falls], stops[falls]
    # A window begins at the first amplitude known to be in it.  Two that touch share the border.
    low, high = amplitude[starts], amplitude[stops]
    touching = np.flatnonzero(starts[1:] == stops[:-1] + 1)
    high[touching] = low[touching + 1]
    return Found(low, high, fates.impacts[starts], fates.side[starts], undecided, tried)


def _apart(amplitude: Floats, where: Integers) -> NDArray[np.bool_]:
    """Return which intervals still have a number between their ends, but for the last digits."""
    gap = amplitude[where + 1] - amplitude[where]
    found: NDArray[np.bool_] = gap > 4.0 * np.spacing(amplitude[where + 1])
    return found
