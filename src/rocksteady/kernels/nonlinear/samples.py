"""Runs of equally spaced samples in the nonlinear model: one short step each.

As in the linear model (`rocksteady.kernels.march._samples`), a sample is passed through where the
bounds of its polynomial prove that the block neither lands nor comes to lie on its side in it, and
the peaks so far are not surpassed within.  All else is left to the search of
`rocksteady.kernels.nonlinear.flight`.  Where a short step is not exact enough, as of a small block
or one of low slenderness, the series takes its place.
"""

import math

from rocksteady.kernels.core import tables as columns
from rocksteady.kernels.core.tables import (
    Floats,
    March,
    Rise,
    end_of_run,
    free_side,
    keep_passage,
    write_row,
)
from rocksteady.kernels.core.tuples import Kept, Tables
from rocksteady.kernels.core.typed import FALSE, ONE, ZERO
from rocksteady.kernels.elementary.circular import sincos_near
from rocksteady.kernels.machine_code.compilation import compiled
from rocksteady.kernels.nonlinear._short import (
    DEGREE,
    StepDrive,
    fill_short,
    short_step,
    state_after,
    third_of,
)
from rocksteady.kernels.nonlinear._zeros import MARGIN, largest, stays_above
from rocksteady.kernels.nonlinear.drive import WEIGHTLESS, Drive, Instant
from rocksteady.kernels.nonlinear.flight import reach_of
from rocksteady.kernels.nonlinear.proofs import HALF_PI, point_of_no_return
from rocksteady.kernels.nonlinear.series import ANGLE, angle_at, expand_series, third_bound


@compiled
def fly_through(
    tables: Tables, state: March, limit: int, kept: Kept, work: Floats
) -> tuple[int, float, float, int, bool]:
    """Fly from the start of a sample through all that follow without a doubt.

    Parameters and results are those of `rocksteady.kernels.march._samples.fly_through`, with the
    working space of a step.
    """
    segments, sides = tables
    rows, peaks = kept
    side, angle, velocity, segment, _, _, _, flights = state
    row = 0 if side > 0 else 1
    lean, rate = sides[row, columns.LEAN], sides[row, columns.RATE]
    alpha, left_out = sides[row, columns.ALPHA], sides[0, columns.LEFT_OUT]
    h = segments[segment, columns.DURATION] * rate
    pull = side / lean
    slowing = 1.0 / rate
    flat = HALF_PI / alpha
    y, v = side * angle / lean, side * velocity / (lean * rate)
    record, watch, keeps = len(rows) > 0, len(peaks) > 0, len(peaks) >= columns.PASSAGE_COLUMNS
    top_angle = top_speed = 0.0
    if watch:
        top_angle, top_speed = peaks[columns.PEAK_ANGLE], peaks[columns.PEAK_SPEED] / (lean * rate)
    stop = min(end_of_run(segments, segment), segment + limit - flights)
    first, fallen = segment, False
    while segment < stop:
        shaking = pull * segments[segment, columns.CONSTANT]
        shaking_slope = pull * slowing * segments[segment, columns.SLOPE]
        lift = segments[segment, columns.LIFT]
        lift_slope = slowing * segments[segment, columns.LIFT_SLOPE]
        weight = 1.0 + lift
        if min(weight, weight + lift_slope * h) <= WEIGHTLESS:
            break
        at = Instant(0.0, y, v, 0.0, 1.0, FALSE)
        driven = StepDrive(alpha, shaking, shaking_slope, weight, lift_slope)
        short = short_step(driven, at, h, left_out)
        degree = DEGREE
        if short.exact:
            bend, third = 2.0 * short.second, third_of(short, h)
            later_y, later_v = state_after(short, y, v, h)
        else:
            if y + h * (v + h * (short.second + h * short.third)) <= 0.0:
                break  # it lands
            drive = Drive(alpha, shaking, shaking_slope, 0.0, 0.0, lift, lift_slope, 0.0)
            degree, step = expand_series(drive, at, reach_of(v, h), left_out, work)
            if step < h:
                break
            bend, third = 2.0 * work[ANGLE, 2], third_bound(work, degree, h)
            later_y, later_v = angle_at(work, degree, h)
        if not stays_above(y, v, bend - third * h, h):
            break
        fastest = max(abs(v), abs(later_v)) + h * (abs(bend) + third * h)
        highest = max(y, later_y) + h * fastest
        if highest >= flat:
            break
        rises = keeps and later_y > 1.0
        if record or rises:
            now = March(side, side * y * lean, side * v * lean * rate, segment, 0, 0.0, 0, flights)
            if record:
                write_row(rows, now, segments[segment, columns.DURATION], columns.ENDED_BY_SPAN)
            if rises:
                top = max(peaks[columns.PEAK_SPEED], top_speed * lean * rate)
                rise = Rise(y, v, later_y, h, segments[segment, columns.CEILING] / lean)
                keep_passage(peaks, now, top_angle, top, rise)
        if watch and (fastest > top_speed or highest > top_angle):
            if abs(bend) <= third * h or (v > 0.0 and later_v < 0.0):
                if short.exact:
                    fill_short(short, y, v, work)
                top_angle, top_speed = largest(
                    work, degree, h, third, later_y, later_v, top_angle, top_speed
                )
            else:
                top_angle = max(top_angle, y, later_y)
                top_speed = max(top_speed, abs(v), abs(later_v))
        y, v = later_y, later_v
        segment += 1
        flights += 1
        if y > 1.0 and v >= 0.0 and y > point_of_no_return(segments, segment, sides, side):
            fallen = True  # nothing that is still to come can bring it back
            break
    if watch:
        peaks[columns.PEAK_ANGLE] = top_angle
        peaks[columns.PEAK_SPEED] = max(peaks[columns.PEAK_SPEED], top_speed * lean * rate)
    if segment == first:  # untouched, to the last bit
        return segment, angle, velocity, flights, fallen
    return segment, side * y * lean, side * v * lean * rate, flights, fallen


@compiled
def uplift_at(sides: Floats, row: int) -> float:
    """Return a base acceleration over 1 + l just below uplift at lean tan(alpha)/alpha."""
    alpha = sides[row, columns.ALPHA]
    sine, cosine = sincos_near(alpha)
    return float(sides[row, columns.LEAN] * sine / (alpha * cosine) * (1.0 - MARGIN))


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
    above, below = uplift_at(sides, ZERO), -uplift_at(sides, ONE)
    free = free_side(sides)
    if free > 0:
        below = -math.inf
    elif free < 0:
        above = math.inf
    duration = segments[segment, columns.DURATION]
    record = len(rows) > 0
    stop = min(end_of_run(segments, segment), segment + limit - flights)
    lightest = columns.SAFELY - segments[segment, columns.LIFT_CEILING]
    faint = segments[segment, columns.CEILING] < columns.SAFELY * lightest * min(above, -below)
    if faint and not record and segment < stop:
        return stop, flights + (stop - segment)
    while segment < stop:
        start, weight = segments[segment, columns.CONSTANT], 1.0 + segments[segment, columns.LIFT]
        end = start + segments[segment, columns.SLOPE] * duration
        later = weight + segments[segment, columns.LIFT_SLOPE] * duration
        if min(weight, later) <= WEIGHTLESS:
            break
        if max(start - above * weight, end - above * later) >= 0.0:
            break
        if min(start - below * weight, end - below * later) <= 0.0:
            break
        if record:
            state = March(0, 0.0, 0.0, segment, 0, 0.0, 0, flights)
            write_row(rows, state, duration, columns.ENDED_BY_SPAN)
        segment += 1
        flights += 1
    return segment, flights
