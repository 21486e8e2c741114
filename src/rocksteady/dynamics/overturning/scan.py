"""Search for every amplitude window in which a pulse of one frequency overturns a block.

Over the amplitude the block's fate is piecewise constant.  What decides it, the margin of
`kernels.batch.pulses`, is continuous, so that every border of fates is a zero of it, and every
border between ways of overturning a change of the impacts on the way.  The search looks in four
ways, each of which adds amplitudes to the grid:

1. A grid: no two amplitudes of the first round are further apart than a stated part of themselves,
   and towards uplift they crowd together.
2. Between neighbours whose itineraries differ (impacts and side at the pulse's end, impacts and
   side of overturning) the interval is halved until it is `FINE`: there flights graze, the margin
   has its kinks, and a window may begin and end close by.  Impacts beyond `MANY`, chatter among
   them, announce less: where only their number differs, or the block falls after more than `MANY`,
   the interval is halved until it is `COARSE`.
3. Likewise where the margin could come to zero between two neighbours if inside the interval it
   were `STEEPER` times as steep as there and in the two intervals beside it.
4. Around every amplitude at which the margin of a block that stands is larger than at both
   neighbours, or that of one that falls smaller, both intervals are halved until they are
   `FINEST`, as long as the hump could reach over zero between them: while it lacks less than
   `HIGHER` times what it stands out from the lower of its neighbours, or `MUCH_HIGHER` until they
   are `FINE`.  For a cusp, as the square root of a graze makes it, no more than 1.4 times as much
   is hidden between two amplitudes; what rounding and straight lines do to the margin is no hump.

What is left are neighbours of different fate, which are brought together to rounding at the ends of
the widest windows (`rocksteady.dynamics.overturning._borders`).  So a
window, or a gap in one, is missed only if the margin has between two neighbours a hump that neither
itineraries nor slopes nor maxima around it announce, and that is narrower than the grid's step, or
than `FINE` in a doubtful place.  No bound on the slope is known: where flights graze it has none.

Where windows have no number the search would not end for a long time.  After `most` amplitudes
besides the grid it ends, the widest intervals halved first, and returns the intervals that it
leaves.  On a floor it returns those too, above the first fall, between whose ends the fate or the
itinerary of a block that stands changes, and their neighbours: narrower windows crowd there.
"""

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats, Integers
from rocksteady.dynamics.overturning._borders import next_amplitudes
from rocksteady.kernels.elementary.arrays import log, log1p
from rocksteady.sweep.cases.spacing import in_equal_ratios

FINEST = 1e-7
"""Part of an amplitude to which intervals beside a hump of the margin are halved."""
MANY = 10
"""Number of impacts from which on numbers of impacts are not distinguished."""
COARSE = 2e-4
"""Part of an amplitude to which intervals are halved after more impacts than that."""
FINE = 1e-5
"""The same of intervals whose ends differ, and of those in which the margin may come to zero."""
HIGHER = 8.0
MUCH_HIGHER = 1000.0
"""How many times as much as it stands out a hump may rise between the amplitudes beside it."""
MOST = 10_000
"""Amplitudes, besides the grid, after which doubtful intervals are left as they are."""
STEEPER = 2.0
"""How many times as steep as there the margin may be inside an interval."""
NEAREST = 1e-6
"""How close to uplift the grid begins, as a part of it."""
DECADE = 16
"""Points of the grid in a decade of a - uplift."""


class Fates(NamedTuple):
    """Fates of the block, as arrays of shape (amplitudes,)."""

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
    hidden: Floats
    """Ends of the intervals in which a window might still hide, shape (intervals, 2)."""


def scan(
    follow: Callable[[Floats], Fates],
    low: float,
    high: float,
    step: float,
    *,
    uplifts: Sequence[float] = (1.0,),
    keep: int = 1000,
    rough: Callable[[Floats], Fates] | None = None,
    closest: float = 0.0,
    most: int = MOST,
    numbered: bool = True,
    crowded: bool = False,
) -> Found:
    """Return every window between two amplitudes.

    Parameters
    ----------
    follow
        Returns the fates at some amplitudes.
    low, high
        Ends of the range, in units of alpha g.
    step
        Largest distance of neighbours on the grid, as a part of the amplitude.
    uplifts
        Amplitudes at which a side of the block lifts; below all of them it rests.
    keep
        Number of windows, the widest, whose ends are located to rounding; those of others are found
        to within the steps of the search.
    rough
        Returns fates that are nearly right and come at less cost, for the search; without, `follow`
        does.  The borders found with it are moved to where `follow` has them.
    closest
        Part of an amplitude to which borders are wanted; 0 (default) for rounding.
    most
        Amplitudes, besides the grid, after which doubtful intervals are left as they are.
    numbered
        Whether a fall after many impacts is doubtful by itself.  Under a record all falls are such:
        without (False), intervals are doubtful where the impacts of their ends differ.
    crowded
        Whether windows may hide above the first wherever the fate or the itinerary of a block that
        stands changes, and in the intervals beside.
    """
    amplitude = first_grid(low, high, step, uplifts)
    looked = follow if rough is None else rough
    fates, left = looked(amplitude), most
    doubtful = np.flatnonzero(_doubtful(amplitude, fates, numbered))
    while doubtful.size and left:
        width = np.diff(amplitude)[doubtful] / amplitude[doubtful + 1]
        where = np.sort(doubtful[np.argsort(-width, kind="stable")[:left]])
        middles = 0.5 * (amplitude[where] + amplitude[where + 1])
        amplitude, fates = _with(looked, amplitude, fates, middles)
        left -= len(where)
        doubtful = np.flatnonzero(_doubtful(amplitude, fates, numbered))
    if crowded:
        above = np.cumsum(fates.overturns)[:-1] * ~(fates.overturns[:-1] & fates.overturns[1:])
        changes = np.flatnonzero(above * (_differ(fates, during=False) | np.diff(fates.during)))
        beside = np.clip(np.add.outer((-1, 0, 1), changes), 0, len(above) - 1)
        doubtful = np.union1d(doubtful, beside)
    hidden = np.stack([amplitude[doubtful], amplitude[doubtful + 1]], axis=1)
    if rough is not None:
        amplitude = amplitude[_kept(amplitude, fates)]
        fates = follow(amplitude)
    return _windows(follow, amplitude, fates, hidden, keep, closest)


def first_grid(low: float, high: float, step: float, uplifts: Sequence[float] = (1.0,)) -> Floats:
    """Return the amplitudes of the first round, ends included.

    No block lifts at the lowest uplift or below, so that nothing is tried there but the lower end.
    """
    floor = max(low, min(uplifts))
    if high <= floor:
        return np.unique([low, high])
    count = math.ceil(log(high / floor) / log1p(step)) + 1
    parts: list[Floats] = [np.array([low]), np.array(in_equal_ratios(floor, high, max(count, 2)))]
    for uplift in sorted(set(uplifts)):
        nearest, furthest = max(floor - uplift, NEAREST * uplift), high - uplift
        if furthest > nearest:
            decades = log(furthest / nearest) / log(10.0)
            count = math.ceil(DECADE * decades) + 1
            parts.append(uplift + np.array(in_equal_ratios(nearest, furthest, count)))
    # Ends that rounding has moved, and neighbours that it has made one.
    return np.unique(np.clip(np.concatenate(parts), low, high))


def _doubtful(amplitude: Floats, fates: Fates, numbered: bool) -> NDArray[np.bool_]:
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
    drop = np.abs(np.diff(margin))
    stands_out = np.maximum(np.append(drop, 0.0), np.append(0.0, drop))
    high = hump & (margin + HIGHER * stands_out > 0.0)
    hump &= margin + MUCH_HIGHER * stands_out > 0.0
    finest, fine = width > FINEST * amplitude[1:], width > FINE * amplitude[1:]
    doubtful: NDArray[np.bool_] = (
        ((high[:-1] | high[1:]) & finest)
        | ((_differ(fates, during=True) | _steep(width, margin) | hump[:-1] | hump[1:]) & fine)
        | (
            ((np.diff(fates.during) != 0) | (numbered & _many(fates)))
            & (width > COARSE * amplitude[1:])
        )
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


def _many(fates: Fates) -> NDArray[np.bool_]:
    """Return between which neighbours the block falls after very many impacts."""
    late = fates.overturns & (fates.impacts >= MANY)
    late_pairs: NDArray[np.bool_] = late[1:] & late[:-1]
    return late_pairs


def _differ(fates: Fates, *, during: bool) -> NDArray[np.bool_]:
    """Return between which neighbours the way of overturning changes, or what leads to it."""
    columns = [fates.overturns, np.minimum(fates.impacts, MANY) * fates.overturns, fates.side]
    if during:
        columns.append(np.minimum(fates.during, 3 * MANY + 3))
    differs = np.zeros(len(fates.overturns) - 1, dtype=np.bool_)
    for column in columns:
        differs |= column[1:] != column[:-1]
    return differs


def _with(
    follow: Callable[[Floats], Fates], amplitude: Floats, fates: Fates, more: Floats
) -> tuple[Floats, Fates]:
    """Return amplitudes and fates with more of them in their places."""
    merged = np.concatenate([amplitude, more])
    order = np.argsort(merged)
    columns = zip(fates, follow(more), strict=True)
    return merged[order], Fates(*(np.concatenate(pair)[order] for pair in columns))


def _windows(
    follow: Callable[[Floats], Fates],
    amplitude: Floats,
    fates: Fates,
    hidden: Floats,
    keep: int,
    closest: float,
) -> Found:
    """Return the windows that amplitudes close enough show, the borders of the widest to rounding.

    All intervals whose ends differ are cut together; where a third way turns up between two, both
    parts go on.
    """
    tried, undecided = len(amplitude), int((~fates.decided).sum())
    while True:
        where = np.flatnonzero(_differ(fates, during=False))
        starts = np.concatenate([[0], where + 1])
        stops = np.concatenate([where, [len(amplitude) - 1]])
        falls = fates.overturns[starts]
        wide = _may_be_widest(amplitude, starts, stops, falls, keep)
        apart = where[(wide[:-1] | wide[1:]) & _apart(amplitude, where, closest)]
        if not apart.size:
            break
        more = next_amplitudes(amplitude, fates.margin, fates.overturns, apart, closest)
        amplitude, fates = _with(follow, amplitude, fates, more)
        tried += len(more)
    starts, stops = starts[falls], stops[falls]
    # A window begins at the first amplitude known to be in it.  Two that touch share the border.
    low, high = amplitude[starts], amplitude[stops]
    touching = np.flatnonzero(starts[1:] == stops[:-1] + 1)
    high[touching] = low[touching + 1]
    return Found(low, high, fates.impacts[starts], fates.side[starts], undecided, tried, hidden)


def _kept(amplitude: Floats, fates: Fates) -> Integers:
    """Return the places of the ends, of both sides of every border, and of a middle between.

    Where both borders of a stretch are off by more than their distance from what was tried beside
    them, its middle is what shows it.
    """
    where = np.flatnonzero(_differ(fates, during=False))
    starts = np.concatenate([[0], where + 1])
    stops = np.concatenate([where, [len(amplitude) - 1]])
    middles = np.searchsorted(amplitude, 0.5 * (amplitude[starts] + amplitude[stops]))
    return np.unique(np.concatenate([starts, stops, middles]))


def _may_be_widest(
    amplitude: Floats, starts: Integers, stops: Integers, falls: NDArray[np.bool_], keep: int
) -> NDArray[np.bool_]:
    """Return which stretches of one fate are windows that may be among the widest, shape (n,)."""
    if falls.sum() <= keep:
        return falls
    before, after = np.maximum(starts - 1, 0), np.minimum(stops + 1, len(amplitude) - 1)
    least = np.sort((amplitude[stops] - amplitude[starts])[falls])[-keep]
    candidate: NDArray[np.bool_] = falls & (amplitude[after] - amplitude[before] >= least)
    return candidate


def _apart(amplitude: Floats, where: Integers, closest: float) -> NDArray[np.bool_]:
    """Return which intervals are wider than a part of them, or than the last digits."""
    high = amplitude[where + 1]
    apart: NDArray[np.bool_] = high - amplitude[where] > np.maximum(
        4.0 * np.spacing(high), closest * high
    )
    return apart
