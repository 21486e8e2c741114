"""Runs of equally spaced samples, marched with a few multiplications per sample.

A sampled base acceleration is linear between samples, and so is the forcing of a side:
``r(t) = r0 + (r1 - r0) t/h`` over a sample of length h, in the side's own time.  The closed form of
`rocksteady.kernels.linear.flight`, from state (y, v) at one sample to (Y, V) at the next, is::

    Y = (y + P) + (C y + S v),   P = C r0 + (S/h - 1) (r1 - r0)
    V = (v + Q) + (C v + S y),   Q = S r0 + (C/h) (r1 - r0)

with ``S = sinh h`` and ``C = cosh h - 1``.  All four factors depend on h alone and are worked out
once a run, by series without cancellation; each step adds to the state what changes it, so that it
rounds like the state itself however small h is.

**No zero is missed.**  While y > 0, ``y'' = y + r >= -q`` with ``q = max(0, -r0, -r1)``, because r
lies between its ends.  Up to its first zero y stays above the parabola ``y + v t - q t^2/2``.  That
is concave, so that it is lowest at an end of the sample: where it is positive at h (and y is
positive, or zero with v > 0) there is no first zero in (0, h], grazing ones included.  The test
keeps a margin of 1e-12 for rounding.  Whatever does not pass it is left to the exact search of
`rocksteady.kernels.linear.zeros`: a sample or two before each impact, and all that graze.

**No peak is missed.**  Within a sample ``a = y''`` obeys ``a'' = a``, so that it has one zero at
most and lies between its ends and zero: |a| and |a'| are at most the larger of their ends.  A
function leaves its chord over h by at most h^2/8 of its second derivative, and so the angle and the
speed surpass the larger of their ends by no more than h^2/8 of these.  Only where that surpasses
the peaks so far, and a changes sign or v falls through zero, is there an extremum to be found.
"""

import math
from typing import NamedTuple

from rocksteady.kernels.core import tables as columns
from rocksteady.kernels.core.forcing import make_forcing
from rocksteady.kernels.core.impacts import rebound
from rocksteady.kernels.core.tables import (
    Floats,
    March,
    Rise,
    end_of_run,
    free_side,
    keep_passage,
    speed_in_unit,
    write_row,
)
from rocksteady.kernels.core.tuples import Kept, Tables, Until
from rocksteady.kernels.linear.extrema import flight_peaks
from rocksteady.kernels.linear.flight import make_flight
from rocksteady.kernels.linear.short import DOUBT, LANDS, NO_LANDING, first_landing, inner_peaks
from rocksteady.kernels.linear.short import LONGEST as LONGEST_FLIGHT
from rocksteady.kernels.machine_code.compilation import compiled

LONGEST = 1.0  # in a side's time; beyond it the series would need more terms
MARGIN = 1e-12


class Stride(NamedTuple):
    """What the length h of a sample makes of the closed form."""

    sinh: float
    rise: float  # cosh h - 1
    angle_share: float  # sinh h/h - 1
    speed_share: float  # (cosh h - 1)/h
    half_square: float  # h^2/2, and the margin


@compiled
def make_stride(h: float) -> Stride:
    """Return the factors of a sample's length, 0 < h <= 1, to rounding."""
    # Nested: each bracket is one plus the ratio of neighbouring terms times the next bracket.  What
    # is left out is below 1e-17 of the whole.
    square = h * h
    even = odd = 1.0
    for n in range(18, 3, -2):
        even = 1.0 + even * (square / (n * (n - 1)))
        odd = 1.0 + odd * (square / (n * (n + 1)))
    share = odd * (square / 6.0)
    rise = even * (0.5 * square)
    return Stride(h + h * share, rise, share, even * (0.5 * h), 0.5 * square * (1.0 + MARGIN))


@compiled
def fly_through(tables: Tables, state: March, until: Until, kept: Kept) -> tuple[March, bool, bool]:
    """Fly from a state within a run of samples through all flights and impacts without a doubt.

    Parameters are those of `rocksteady.kernels.march.march.march`.

    Returns
    -------
    tuple
        The state at which it stops, whether the block is proved to overturn, and whether it has
        just left an impact so slowly that it may be coming to rest.
    """
    segments, sides = tables
    rows, peaks = kept
    side, angle, velocity, segment, half, phase, impacts, flights = state
    duration = segments[segment, columns.DURATION]
    behind = end_of_run(segments, segment)
    record, watch, keeps = len(rows) > 0, len(peaks) > 0, len(peaks) >= columns.PASSAGE_COLUMNS
    row = 0 if side > 0 else 1
    lean, rate = sides[row, columns.LEAN], sides[row, columns.RATE]
    h, pull, unit = duration * rate, side / lean, lean * rate
    slowing, per_unit = 1.0 / rate, 1.0 / unit
    if h > LONGEST:
        return state, False, False
    stride = make_stride(h)
    y, v = side * angle / lean, side * velocity / unit
    top_angle = top_speed = math.inf
    if watch:
        top_angle, top_speed = peaks[columns.PEAK_ANGLE], peaks[columns.PEAK_SPEED] / unit
    fallen = bounced = moved = False
    while segment < behind and flights < until.limit:
        constant, slope = segments[segment, columns.CONSTANT], segments[segment, columns.SLOPE]
        start = pull * constant - 1.0
        change = pull * (slope * duration)
        lowest = min(start, start + change, 0.0)
        span, event = h, NO_LANDING
        if phase == 0.0 and (y - MARGIN * y) + v * h > -lowest * stride.half_square:
            later_y = (y + (stride.rise * start + stride.angle_share * change)) + (
                stride.rise * y + stride.sinh * v
            )
            later_v = (v + (stride.sinh * start + stride.speed_share * change)) + (
                stride.rise * v + stride.sinh * y
            )
        else:
            span = (duration - phase) * rate
            if span <= 0.0 or h > LONGEST_FLIGHT:
                break
            start, steepness = pull * (constant + slope * phase) - 1.0, pull * slope * slowing
            event, span, later_y, later_v = first_landing(y, v, start, steepness, span)
            if event == DOUBT:
                break
            change = steepness * span
        moved = True
        rises = keeps and later_y > 1.0
        if record or rises:
            now = March(side, side * y * lean, side * v * unit, segment, 0, phase, impacts, flights)
            if record:
                lasting = span * slowing if event == LANDS or phase != 0.0 else duration
                write_row(rows, now, lasting, event)
            if rises:
                top = max(peaks[columns.PEAK_SPEED], top_speed * unit)
                rise = Rise(y, v, later_y, span, segments[segment, columns.CEILING] / lean)
                keep_passage(peaks, now, top_angle, top, rise)
        flights += 1
        if watch:
            here, there = y + start, later_y + (start + change)
            speed = max(abs(v), abs(later_v))
            if (here > 0.0) != (there > 0.0) or (v > 0.0 and later_v < 0.0):
                eighth = 0.125 * span
                jerk = max(abs(span * v + change), abs(span * later_v + change))
                bend = span * max(abs(here), abs(there))
                fastest, highest = speed + eighth * jerk, max(y, later_y) + eighth * bend
                if fastest > top_speed or highest > top_angle:
                    tops = (top_angle, top_speed)
                    if span > LONGEST_FLIGHT:
                        forcing = make_forcing(start, change / span, 0.0, 0.0)
                        flight = make_flight(forcing, y, v, 0.0, 0.0, 1.0)
                        tops = flight_peaks(flight, forcing, span, later_y, later_v, *tops)
                    else:
                        tops = inner_peaks(y, v, start, change / span, span, later_v, there, tops)
                    top_angle, top_speed = tops
            top_angle = max(top_angle, y, later_y)
            top_speed = max(top_speed, speed)
        y, v = later_y, later_v
        if event == LANDS:
            phase += span * slowing
            later_side, velocity, impacts, bounced = rebound(
                sides, side, v, impacts, until.rest_velocity
            )
            if later_side != side:
                side = later_side
                row, before = 0 if side > 0 else 1, unit
                lean, rate = sides[row, columns.LEAN], sides[row, columns.RATE]
                pull, unit = side / lean, lean * rate
                slowing, per_unit = 1.0 / rate, 1.0 / unit
                if duration * rate != h:
                    h = duration * rate
                    stride = make_stride(h)
                top_speed = speed_in_unit(peaks, top_speed, before, unit)
            y, v = 0.0, side * velocity * per_unit
            if bounced or h > LONGEST:
                break
            continue
        segment += 1
        phase = 0.0
        if y * lean > lean + segments[segment, columns.CEILING] and v >= 0.0:
            fallen = True  # nothing that is still to come can bring it back
            break
    if watch:
        peaks[columns.PEAK_ANGLE] = top_angle
        peaks[columns.PEAK_SPEED] = max(peaks[columns.PEAK_SPEED], top_speed * unit)
    if moved:  # otherwise untouched, to the last bit
        angle, velocity = side * y * lean, side * v * unit
    return March(side, angle, velocity, segment, half, phase, impacts, flights), fallen, bounced


@compiled
def rest_through(
    tables: Tables, segment: int, flights: int, limit: int, rows: Floats
) -> tuple[int, int]:
    """Rest from the start of a sample through all that lift neither side.

    Returns
    -------
    tuple
        The segment at whose start it stops, and the flights and rests so far.
    """
    segments, sides = tables
    above, below = sides[0, columns.LEAN], -sides[1, columns.LEAN]
    free = free_side(sides)
    if free > 0:
        below = -math.inf
    elif free < 0:
        above = math.inf
    duration = segments[segment, columns.DURATION]
    record = len(rows) > 0
    stop = min(end_of_run(segments, segment), segment + limit - flights)
    faint = segments[segment, columns.CEILING] < columns.SAFELY * min(above, -below)
    if faint and not record and segment < stop:
        return stop, flights + (stop - segment)
    while segment < stop:
        start = segments[segment, columns.CONSTANT]
        end = start + segments[segment, columns.SLOPE] * duration
        if max(start, end) >= above or min(start, end) <= below:
            break
        if record:
            state = March(0, 0.0, 0.0, segment, 0, 0.0, 0, flights)
            write_row(rows, state, duration, columns.ENDED_BY_SPAN)
        segment += 1
        flights += 1
    return segment, flights
