"""Fates of a block under pulses of many amplitudes and frequencies: a loop of the march.

The pulse stays as it is, of amplitude 1 and frequency ratio 1: to make it a times as strong is to
divide the block's lean by a, to make it w times as fast to divide the block's rate by w.  Lean and
rate are no more than units, so that this holds in the nonlinear model too: what its equation has of
the block itself, the slenderness, is a column of its own.

Each march ends with the pulse.  What follows on the still base, and the margin by which the block
overturns or stands, is in closed form (`kernels.batch._still_base`).  A block that has bounced
very often is not followed any longer where a bound shows that it stands
(`rocksteady.kernels.batch._lossless_bound`).
"""

import math

import numpy as np

from rocksteady.kernels.batch._lossless_bound import largest_margin
from rocksteady.kernels.batch._still_base import HALF_PI, NEAR, fate_on_still_base, over_the_top
from rocksteady.kernels.core import tables as columns
from rocksteady.kernels.core.clock import segment_start
from rocksteady.kernels.core.tables import Floats, March, is_nonlinear
from rocksteady.kernels.core.tuples import Kept, PulseFates, Tables, Until
from rocksteady.kernels.core.typed import FALSE, ZERO
from rocksteady.kernels.machine_code.compilation import allocating
from rocksteady.kernels.machine_code.types import Floats1
from rocksteady.kernels.march.march import march
from rocksteady.kernels.march.replay import beginning_of, recorded_peaks, stepped_from
from rocksteady.kernels.nonlinear.flight import fly
from rocksteady.kernels.nonlinear.series import TERMS, WORK_ROWS

SOME = 200
MANY = 2000
"""Flights, besides one a segment, after which a proof that the block stands is tried."""
STANDS = -1
"""In place of a status: it is proved to stand, and has not been followed to the pulse's end."""
LOST = 1.0
"""Margin of a linear block that is lost before the pulse ends: how much has not been followed."""


@allocating
def pulse_fates(
    tables: Tables,
    amplitude: Floats1,
    frequency_ratio: Floats1,
    rest_velocity: float,
    limit: int,
    fates: PulseFates,
) -> None:
    """March a block from rest through a pulse of many sizes and write its fates.

    Parameters
    ----------
    tables
        Of the pulse of amplitude 1 and frequency ratio 1, without the still base that follows it,
        in the nonlinear model with infinite ceilings; and of the block.
    amplitude, frequency_ratio
        Of the pulse, above 0, shape (cells,).
    rest_velocity
        Chatter slower than this, in the block's units, comes to rest as soon as that is proved.
    limit
        Flights, besides one a segment, after which a cell is UNDECIDED.
    fates
        Receives how the block fares: `kernels.core.tuples`.
    """
    segments, sides = tables
    status, impacts, side, during, margin = fates
    nonlinear = is_nonlinear(sides)
    own = sides.copy()
    peaks = np.zeros(columns.PEAK_COLUMNS if nonlinear else 0)
    half, phase = segment_start(segments, ZERO)
    start = March(0, 0.0, 0.0, 0, half, phase, 0, 0)
    scaled = Tables(segments, own)
    for i in range(len(amplitude)):
        lean, rate = 1.0 / amplitude[i], 1.0 / frequency_ratio[i]
        for row in range(2):
            own[row, columns.LEAN] = sides[row, columns.LEAN] * lean
            own[row, columns.RATE] = sides[row, columns.RATE] * rate
        peaks[:] = 0.0
        code, end, bound = followed(scaled, start, rest_velocity, limit, peaks)
        status[i] = columns.AT_REST
        impacts[i] = end.impacts
        side[i] = 0
        during[i] = 3 * end.impacts + 1 + end.side
        if code == STANDS:
            margin[i] = bound
            continue
        if code not in (columns.AT_REST, columns.ROCKING, columns.OVERTURNED):
            status[i] = code
            margin[i] = math.nan
            continue
        if code == columns.OVERTURNED:
            status[i] = columns.OVERTURNED
            side[i] = end.side
            margin[i] = speed_at_the_floor(segments, own, end) if nonlinear else LOST
            continue
        margin[i] = -1.0
        if code != columns.AT_REST:
            row = 0 if end.side > 0 else 1
            unit = own[row, columns.LEAN] * own[row, columns.RATE]
            y, v = end.side * end.angle / own[row, columns.LEAN], end.side * end.velocity / unit
            fate = fate_on_still_base(own, end.side, y, v)
            margin[i] = fate.margin
            if fate.margin > 0.0:
                status[i] = columns.OVERTURNED
                impacts[i] = end.impacts + fate.impacts
                side[i] = fate.side
                continue
        if nonlinear:
            widest = max(sides[0, columns.ALPHA], sides[1, columns.ALPHA])
            near = NEAR * (widest * peaks[columns.PEAK_ANGLE] / HALF_PI - 1.0)
            if sides[0, columns.ALPHA] != sides[1, columns.ALPHA] and near > margin[i]:
                # The peak is in the alpha of its side, and which that was only rows tell.
                rows = np.zeros((end.flights, columns.ROW_COLUMNS))
                flights = len(segments) + limit
                until = Until(ZERO, 0.0, rest_velocity, flights)
                march(scaled, start, until, Kept(rows, np.zeros(0)))
                last = rows[len(rows) - 1, columns.ROW_DURATION]
                positive, negative, _ = recorded_peaks(segments, own, rows, last)
                turned = max(sides[0, columns.ALPHA] * positive, sides[1, columns.ALPHA] * negative)
                near = NEAR * (turned / HALF_PI - 1.0)
            margin[i] = max(margin[i], near)


@allocating
def followed(
    tables: Tables, start: March, rest_velocity: float, limit: int, peaks: Floats
) -> tuple[int, March, float]:
    """March to the end of a pulse, or until a block that bounces often is proved to stand.

    The parameters are those of `pulse_fates` and `kernels.march.march.march`; returned are the
    status or STANDS, the final state, and the bound of its margin where it stands.
    """
    kept, end, bound = Kept(np.zeros((0, columns.ROW_COLUMNS)), peaks), start, math.inf
    code = columns.UNDECIDED
    for most in (min(SOME, limit), min(MANY, limit), limit):
        # From the start again: a march does not begin within a segment that has a slope.
        until = Until(ZERO, 0.0, rest_velocity, len(tables.segments) + most)
        code, end = march(tables, start, until, kept)
        if code != columns.UNDECIDED:
            break
        bound = largest_margin(tables.segments, tables.sides, end)
        if bound < 0.0:
            return STANDS, end, bound
    return code, end, bound


@allocating
def speed_at_the_floor(segments: Floats, sides: Floats, last: March) -> float:
    """Return the speed with which a nonlinear block comes to lie on its side, over the barrier.

    It is no number where the flight comes to no end.

    Parameters
    ----------
    segments, sides
        The tables of its march.
    last
        How its last flight began.
    """
    start = beginning_of(segments, sides, last)
    flight = stepped_from(segments, sides, start, math.inf)
    lifting, lean, rate = last.angle == 0.0 and last.velocity == 0.0, start.lean, start.rate
    work, nothing = np.empty((WORK_ROWS, TERMS)), np.zeros(0)
    zero = fly(flight, FALSE, math.inf, lifting, nothing, lean, rate, work, np.empty((0, TERMS)))
    if zero.event == columns.STALLED:
        return math.nan
    return max(zero.velocity, 0.0) / -over_the_top(sides, 0 if last.side > 0 else 1, 0.0)
