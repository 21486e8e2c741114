"""What a recorded march amounts to: where a run ends, its times, its peaks and its impacts."""

import math
from typing import NamedTuple

import numpy as np

from rocksteady.kernels.core import tables as columns
from rocksteady.kernels.core.clock import elapsed_time, segment_start
from rocksteady.kernels.core.tables import Floats, free_side, is_nonlinear, is_series
from rocksteady.kernels.core.tuples import Tables
from rocksteady.kernels.core.typed import ZERO
from rocksteady.kernels.elementary.circular import cos, sin, sincos
from rocksteady.kernels.machine_code.compilation import allocating, compiled
from rocksteady.kernels.machine_code.types import Floats1, Floats2
from rocksteady.kernels.march.replay import (
    fill_states,
    last_crossing,
    peaks_until_overturning,
    recorded_peaks,
)

ELASTIC_TIME = 1.0e4
"""Pivot time for which a block without loss is followed on a still base."""
LONGEST_REST = 1.0e15
"""Pivot time for which any other block is: it rests or falls long before."""
SHOWN_TO = 2.0
"""|theta|/alpha up to which a fall is followed; the linear model means nothing much further on."""
LANDING_ROWS = 6
"""Rows of `fill_landings`: time, half cycles, phase, side, velocity before and after."""


class RunFacts(NamedTuple):
    """What a recorded march amounts to, in pivot time; nan where it does not apply."""

    last: float  # duration of the last row; of an endless fall, until it is `SHOWN_TO`
    end: float
    passing: int  # row in which a block that falls passes its alpha for the last time, else -1
    since: float  # from the start of that row on
    overturned: float
    rested: float
    peaks: tuple[float, float, float]  # |theta|/alpha on either side, and |velocity|


@compiled
def run_end(tables: Tables, cycles: float) -> tuple[int, float]:
    """Return half cycles and phase (or time) on the last segment at which a run ends.

    Parameters
    ----------
    tables
        The motion and the block.
    cycles
        Periods for which endless harmonic shaking is followed.  Whole half cycles are counted as an
        integer, so that the run ends in the exact phase.
    """
    segments, sides = tables
    if segments[len(segments) - 1, columns.FREQUENCY] == 0.0:
        elastic = abs(sides[0, columns.RESTITUTION]) == 1.0 and sides[1, columns.RESTITUTION] == 1.0
        return 0, ELASTIC_TIME if elastic else LONGEST_REST
    half, phase = segment_start(segments, ZERO)
    halves = float(np.floor(2.0 * cycles))
    phase += (2.0 * cycles - halves) * math.pi
    if phase >= math.pi:
        return half + int(halves) + 1, phase - math.pi
    return half + int(halves), phase


@allocating
def run_facts(tables: Tables, rows: Floats2, status: int, starts: Floats1) -> RunFacts:
    """Return times and peaks of a recorded march, and fill the time at which each row begins.

    Peaks count up to overturning, which the march proves later than it happens.
    """
    segments, sides = tables
    row = len(rows) - 1
    if row < 0:  # the first flight has come to nothing
        return RunFacts(0.0, 0.0, -1, math.nan, math.nan, math.nan, (0.0, 0.0, 0.0))
    fill_starts(segments, rows, starts)
    last, passing, since = rows[row, columns.ROW_DURATION], -1, math.nan
    overturned = rested = math.nan
    if status == columns.OVERTURNED:
        if last == math.inf:
            last = fall_time(segments, sides, rows)
        passing, since = last_crossing(segments, sides, rows, 1.0)
        overturned = starts[passing] + since
        peaks = peaks_until_overturning(segments, sides, rows)
    else:
        peaks = recorded_peaks(segments, sides, rows, last)
    if status == columns.AT_REST:
        rested = rest_time(segments, sides, rows, starts)
    return RunFacts(last, starts[row] + last, passing, since, overturned, rested, peaks)


@compiled
def fill_starts(segments: Floats, rows: Floats, starts: Floats) -> None:
    """Fill the pivot time at which each row of a march begins."""
    segment, begun, latest = 0, 0.0, -math.inf
    for row in range(len(rows)):
        while segment < int(rows[row, columns.ROW_SEGMENT]):
            begun += segments[segment, columns.DURATION]
            segment += 1
        from_half, from_phase = segment_start(segments, segment)
        half, phase = int(rows[row, columns.ROW_HALF_CYCLES]), rows[row, columns.ROW_PHASE]
        frequency = segments[segment, columns.FREQUENCY]
        # Half cycles are counted as integers, so that a long run loses no digits before the end. A
        # flight shorter than a clock's last digit may not seem to begin before the last.
        latest = max(latest, begun + elapsed_time(half, phase, from_half, from_phase, frequency))
        starts[row] = latest


@compiled
def fall_time(segments: Floats, sides: Floats, rows: Floats) -> float:
    """Return how long the last row of an endless fall is followed, up to `SHOWN_TO`."""
    row = len(rows) - 1
    side = 0 if rows[row, columns.ROW_SIDE] > 0.0 else 1
    tilt = abs(rows[row, columns.ROW_ANGLE]) / sides[side, columns.LEAN]
    level = max(SHOWN_TO, 1.0 + tilt)
    if is_nonlinear(sides):  # further than on its side no block falls
        level = min(level, 0.5 * math.pi / sides[side, columns.ALPHA])
    passing, since = last_crossing(segments, sides, rows, level)
    return since if passing == row else 0.0


@allocating
def rest_time(segments: Floats, sides: Floats, rows: Floats, starts: Floats) -> float:
    """Return the pivot time at which a block came to rest where it stayed.

    The bounces that are not recorded, because they are proved to die out, last ``2 v (1/(1 - a) +
    r/(1 + a))/(1 - r^2)``, with the velocity v after the last recorded impact and the base
    acceleration a towards the side of the next bounce; 1 - a is the pull of that side, and r^2 the
    product of both.  Against a wall they last ``2 v/((1 - a) (1 - r))``.
    """
    first = len(rows)
    while first > 0 and rows[first - 1, columns.ROW_SIDE] == 0.0:
        first -= 1
    start: float = starts[first]
    if first == 0 or rows[first - 1, columns.ROW_EVENT] != columns.ENDED_BY_IMPACT:
        return start
    index, since, states = np.empty(1, np.int64), np.empty(1), np.empty((3, 1))
    index[0], since[0] = first - 1, rows[first - 1, columns.ROW_DURATION]
    fill_states(segments, sides, rows, index, since, states)
    side = rows[first - 1, columns.ROW_SIDE]
    row = 0 if side > 0.0 else 1
    there: float = sides[row, columns.RESTITUTION]
    velocity: float = abs(there * states[1, 0])
    across, lift = base_at(segments, start)
    towards = -side * across
    if free_side(sides) != 0:
        return start + 2.0 * velocity / (pull(sides, ZERO, -towards, lift) * (1.0 + there))
    here: float = sides[1 - row, columns.RESTITUTION]
    near, far = pull(sides, 1 - row, towards, lift), pull(sides, row, -towards, lift)
    # The loss of two impacts, 1 - here there, in a form that does not cancel.
    lost = (1.0 - here) * (1.0 + there) + (here - there)
    return start + 2.0 * velocity * (1.0 / near + here / far) / lost


@compiled
def pull(sides: Floats, row: int, push: float, lift: float) -> float:
    """Return how strongly a block on its base is pulled back from a side, against a push."""
    lean: float = sides[row, columns.LEAN]
    rate: float = sides[row, columns.RATE]
    if not is_nonlinear(sides):
        return rate * rate * (lean - push)
    alpha: float = sides[row, columns.ALPHA]
    moment = lean * ((1.0 + lift) * sin(alpha) / alpha)
    return rate * rate * (moment - push * cos(alpha))


@compiled
def base_at(segments: Floats, time: float) -> tuple[float, float]:
    """Return the acceleration of the base at a pivot time: across [alpha g], and upwards [g]."""
    index, begun = 0, 0.0
    while index + 1 < len(segments) and begun + segments[index, columns.DURATION] <= time:
        begun += segments[index, columns.DURATION]
        index += 1
    return base_in(segments, index, time - begun)


@compiled
def base_in(segments: Floats, index: int, since: float) -> tuple[float, float]:
    """Return the same a time after the start of a segment."""
    turned = segments[index, columns.FREQUENCY] * since + segments[index, columns.PHASE]
    swing = sin(turned)
    if is_series(segments, index):
        swing = 0.0
        for k in range((segments.shape[1] - columns.SHARES) // 2):
            sine, cosine = sincos((k + 1) * turned)
            shares = columns.SHARES + 2 * k
            swing += segments[index, shares] * sine + segments[index, shares + 1] * cosine
    lift = 0.0
    if segments.shape[1] > columns.LIFT:
        lift = segments[index, columns.LIFT] + segments[index, columns.LIFT_SLOPE] * since
    across = (
        segments[index, columns.CONSTANT]
        + segments[index, columns.SLOPE] * since
        + segments[index, columns.AMPLITUDE] * swing
    )
    return across, lift


@allocating
def fill_landings(tables: Tables, rows: Floats2, starts: Floats1, landings: Floats2) -> int:
    """Fill the impacts of a recorded march, however slow, and return how many there are.

    Parameters
    ----------
    tables, rows, starts
        The march, and the times at which its rows begin, as `run_facts` fills them.
    landings
        Shape (6, rows); its first columns receive the impacts.
    """
    segments, sides = tables
    index, since = np.empty(len(rows), np.int64), np.empty(len(rows))
    count = 0
    for row in range(len(rows)):
        if rows[row, columns.ROW_EVENT] == columns.ENDED_BY_IMPACT:
            index[count], since[count] = row, rows[row, columns.ROW_DURATION]
            count += 1
    states = np.empty((3, count))
    fill_states(segments, sides, rows, index[:count], since[:count], states)
    for i in range(count):
        row = index[i]
        # The clock reading of an impact is that of the flight or rest which it begins; only at the
        # flight limit does none follow.
        after = min(row + 1, len(rows) - 1)
        side = rows[row, columns.ROW_SIDE]
        landings[0, i] = starts[after] if after > row else starts[row] + since[i]
        landings[1, i] = rows[after, columns.ROW_HALF_CYCLES]
        landings[2, i] = rows[after, columns.ROW_PHASE]
        landings[3, i] = side
        landings[4, i] = states[1, i]
        landings[5, i] = sides[0 if side > 0.0 else 1, columns.RESTITUTION] * states[1, i]
    return count
