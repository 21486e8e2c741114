"""Peaks and fates of many blocks under one record: the march, in lanes where that is faster.

Rows are not kept: what a spectrum asks for is the status, the impacts and the two peaks.  Chatter
comes to rest as soon as that is proved and none of its impacts and tops counts, or on the still
base, where its impacts are known, none of its tops.

The peaks of a block that falls are those until it passes its slenderness for good, and only the
proof of its fall says which passage was the last.  So the march keeps its last passage, and that
flight alone is marched once more, with its row; all flights are where the block may have come back
to its slenderness since.
"""

import numpy as np

from rocksteady.kernels.batch._record_lanes import (
    CELL,
    WHOLES,
    empty_lanes,
    land,
    put_flight,
    step,
    taken,
)
from rocksteady.kernels.batch._record_lanes import FEW as FEW_LANES
from rocksteady.kernels.batch.waiting import fill_hardest, waits_until
from rocksteady.kernels.core import rides
from rocksteady.kernels.core import tables as columns
from rocksteady.kernels.core.queue import LEFT_OVER, queue_of, take
from rocksteady.kernels.core.rides import is_held
from rocksteady.kernels.core.tables import March, is_nonlinear, kept_passage
from rocksteady.kernels.core.tuples import Blocks, Kept, PeakFates, Tables, Until
from rocksteady.kernels.core.typed import FALSE, ONE, TRUE, ZERO
from rocksteady.kernels.machine_code.compilation import (
    allocating,
    inlined,
    inlined_allocating,
)
from rocksteady.kernels.machine_code.types import Floats1, Floats2, Integers1
from rocksteady.kernels.march.march import (
    linear_march,
    nonlinear_march,
    nonlinear_ride,
)
from rocksteady.kernels.march.replay import peaks_without_series
from rocksteady.kernels.nonlinear import sample_lanes as lane
from rocksteady.kernels.nonlinear.sample_lanes import FIELDS, LANES
from rocksteady.kernels.nonlinear.series import TERMS, WORK_ROWS

WAITING = 3
"""A landing is looked for as soon as one of so many lanes in use waits."""
FEW = 2
"""Blocks that wait at rest step by step: for so few it takes no longer than to make a table."""


@allocating
def record_fates(segments: Floats2, blocks: Blocks, limit: int, fates: PeakFates) -> None:
    """March blocks from rest through one motion and note how each fares.

    The motion is in units of its own, as seconds and m/s^2, and stays as it is: a block is its
    uplift acceleration alpha g and its p in them.  To scale a horizontal motion is to divide the
    lean.

    Parameters
    ----------
    segments
        Table of the motion, shape (segments, 9), or (segments, 12) in the nonlinear model, whose
        vertical motion is in g; the last segment is a still base without end.
    blocks, fates
        The blocks, and what receives how each fares: `kernels.core.tuples`.
    limit
        Flights after which a block is UNDECIDED.
    """
    sides = blocks.sides
    queue = queue_of(len(sides))
    hardest = np.empty(len(segments) - 1)
    nonlinear = len(sides) > 0 and is_nonlinear(sides[0])
    if len(sides) > FEW:
        fill_hardest(segments, nonlinear, hardest)
    if nonlinear:
        _lane_fates(queue, hardest, segments, blocks, limit, fates)
    else:
        _record_fates(queue, hardest, segments, blocks, limit, fates, FALSE, TRUE)


@allocating
def queued_record_fates(
    queue: Integers1,
    hardest: Floats1,
    segments: Floats2,
    blocks: Blocks,
    limit: int,
    fates: PeakFates,
) -> None:
    """Do what `record_fates` does in the linear model, for the blocks taken from a queue.

    `hardest` is what `rocksteady.kernels.batch.waiting.fill_hardest` fills.  A block that falls,
    and may have come back to its slenderness unseen, is LEFT_OVER where peaks are wanted: to find
    them takes a table as long as its motion.
    """
    _record_fates(queue, hardest, segments, blocks, limit, fates, FALSE, FALSE)


@allocating
def queued_nonlinear_record_fates(
    queue: Integers1,
    hardest: Floats1,
    segments: Floats2,
    blocks: Blocks,
    limit: int,
    fates: PeakFates,
) -> None:
    """Do what `queued_record_fates` does in the nonlinear model."""
    _record_fates(queue, hardest, segments, blocks, limit, fates, TRUE, FALSE)


@inlined_allocating
def _record_fates(
    queue: Integers1,
    hardest: Floats1,
    segments: Floats2,
    blocks: Blocks,
    limit: int,
    fates: PeakFates,
    nonlinear: bool,
    whole: bool,
) -> None:
    """Fill the fates of the blocks of a queue; inlined once for each model.

    `whole` is whether to go through a whole motion again where its last passage is not enough.
    """
    none = np.zeros((0, columns.ROW_COLUMNS))
    status, impacts, peaks = fates
    watch = peaks.shape[1] > 0
    kept = np.zeros(columns.PASSAGE_COLUMNS)
    peak = kept[: columns.PASSAGE_COLUMNS if watch else 0]
    while True:
        i = take(queue)
        if i < 0:
            return
        own = blocks.sides[i]
        tables = Tables(segments, own)
        waits = waits_until(hardest, own) if len(blocks.sides) > FEW else ZERO
        stop = blocks.afterwards[i] / own[0, columns.RATE]
        peak[:] = 0.0
        start = March(0, 0.0, 0.0, waits, 0, 0.0, 0, waits)
        status[i], end = _march_through(tables, start, stop, limit, Kept(none, peak), nonlinear)
        impacts[i] = end.impacts
        _note(tables, i, waits, end, stop, peak, fates, nonlinear, whole)


@allocating
def _lane_fates(
    queue: Integers1,
    hardest: Floats1,
    segments: Floats2,
    blocks: Blocks,
    limit: int,
    fates: PeakFates,
) -> None:
    """Do what `_record_fates` does in the nonlinear model, in lanes (`_record_lanes`)."""
    none = np.zeros((0, columns.ROW_COLUMNS))
    watch = fates.peaks.shape[1] > 0
    passages = np.zeros((LANES, columns.PASSAGE_COLUMNS if watch else 0))
    lanes, wholes = np.empty(FIELDS * LANES), np.zeros((WHOLES, LANES), np.int64)
    waits = np.zeros(LANES, np.int64)
    ride, work = np.zeros(rides.RIDE_COLUMNS), np.empty((WORK_ROWS, TERMS))
    empty_lanes(lanes, wholes)
    fresh, busy, landed, many = True, 0, 0, len(blocks.sides) > FEW
    while True:
        # What is left of a batch in few lanes is marched to its end.
        few = not fresh and busy < FEW_LANES
        ride[rides.ON] = 1.0 if few else 0.0
        for j in range(LANES):
            while few or lanes[lane.PASSES + j] == 0.0:
                i, peak = wholes[CELL, j], passages[j]
                if i < 0:
                    if not fresh:
                        break
                    i = take(queue)
                    if i < 0:
                        fresh = False
                        break
                    waits[j] = waits_until(hardest, blocks.sides[i]) if many else ZERO
                    state = March(0, 0.0, 0.0, waits[j], 0, 0.0, 0, waits[j])
                    peak[:] = 0.0
                    busy += 1
                else:
                    state = taken(lanes, wholes, j, ride)
                tables = Tables(segments, blocks.sides[i])
                stop = blocks.afterwards[i] / blocks.sides[i, 0, columns.RATE]
                until, kept = Until(ZERO, stop, columns.COUNTED, limit), Kept(none, peak)
                code, end = nonlinear_ride(tables, state, until, kept, work, ride)
                wholes[CELL, j] = i
                if is_held(ride):
                    put_flight(lanes, wholes, j, tables, end, ride)
                    ride[rides.HELD] = 0.0
                    break
                fates.status[i], fates.impacts[i] = code, end.impacts
                _note(tables, i, waits[j], end, stop, peak, fates, TRUE, TRUE)
                wholes[CELL, j] = -1
                busy -= 1
        if busy == 0:
            return
        free = waiting = LANES - busy
        enough = free + busy // WAITING
        while waiting == free:
            # Lanes that have landed often do so once more, as in chatter.
            if free + landed < enough:
                waiting = step(lanes, wholes, segments, limit)
                if waiting < enough:
                    waiting = free
                    continue
            waiting, landed = land(lanes, wholes, segments, blocks.sides, passages, work, limit)


@inlined_allocating
def _note(
    tables: Tables,
    i: int,
    waits: int,
    end: March,
    stop: float,
    peak: Floats1,
    fates: PeakFates,
    nonlinear: bool,
    whole: bool,
) -> None:
    """Note the peaks of a block whose march is over, if they are wanted."""
    segments, own = tables
    status, _, peaks = fates
    if peaks.shape[1] == 0:
        return
    nothing = np.zeros(0)
    if status[i] == columns.OVERTURNED:
        if peak[columns.PASSING_AGAIN] == 0.0:
            row, again = np.zeros((1, columns.ROW_COLUMNS)), kept_passage(peak)
            _march_through(tables, again, stop, ONE, Kept(row, nothing), nonlinear)
            positive, negative, speed = peaks_without_series(segments, own, row)
        elif whole:
            again, most = March(0, 0.0, 0.0, waits, 0, 0.0, 0, 0), end.flights - waits
            rows = np.zeros((most, columns.ROW_COLUMNS))
            _march_through(tables, again, stop, most, Kept(rows, nothing), nonlinear)
            positive, negative, speed = peaks_without_series(segments, own, rows)
        else:
            status[i] = LEFT_OVER
            return
        peak[columns.PEAK_ANGLE] = max(peak[columns.BEFORE_ANGLE], positive, negative)
        peak[columns.PEAK_SPEED] = max(peak[columns.BEFORE_SPEED], speed)
    peaks[i, columns.PEAK_ANGLE] = peak[columns.PEAK_ANGLE]
    unit = own[0, columns.LEAN] * own[0, columns.RATE]
    peaks[i, columns.PEAK_SPEED] = peak[columns.PEAK_SPEED] / unit


@inlined
def _march_through(
    tables: Tables, start: March, stop: float, limit: int, kept: Kept, nonlinear: bool
) -> tuple[int, March]:
    """March to the end of a motion in one of the models."""
    until = Until(ZERO, stop, columns.COUNTED, limit)
    if nonlinear:
        return nonlinear_march(tables, start, until, kept)
    return linear_march(tables, start, until, kept)
