"""Runs of equally spaced samples in the nonlinear model: one short step each.

As in the linear model (`rocksteady.kernels.march._samples`), a sample is passed through where the
bounds of its polynomial prove that the block neither lands nor comes to lie on its side in it, and
the peaks so far are not surpassed within.  All else is left to the search of
`rocksteady.kernels.nonlinear.flight`.  Where a short step is not exact enough, as of a small block
or one of low slenderness, the series takes its place.
"""

import math

from rocksteady.kernels.core import rides
from rocksteady.kernels.core import tables as columns
from rocksteady.kernels.core.impacts import rebound
from rocksteady.kernels.core.rides import hold, is_held, is_ride
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
from rocksteady.kernels.core.typed import ONE, ZERO
from rocksteady.kernels.elementary.circular import sincos_near
from rocksteady.kernels.linear.short import DOUBT, LANDS, NO_LANDING
from rocksteady.kernels.machine_code.compilation import compiled, inlined
from rocksteady.kernels.nonlinear._expansion import (
    DEGREE,
    Stretch,
    bounds_over,
    fill_course,
    middle_step,
    most_over,
    state_after,
    step_to_landing,
)
from rocksteady.kernels.nonlinear._landing_step import first_landing
from rocksteady.kernels.nonlinear._zeros import MARGIN, largest, stays_above
from rocksteady.kernels.nonlinear.drive import WEIGHTLESS, Drive, Instant, StepDrive
from rocksteady.kernels.nonlinear.flight import reach_of
from rocksteady.kernels.nonlinear.proofs import HALF_PI, point_of_no_return
from rocksteady.kernels.nonlinear.series import ANGLE, angle_at, expand_series, third_bound


@compiled
def fly_through(
    tables: Tables, state: March, until: Until, kept: Kept, work: Floats, ride: Floats
) -> tuple[March, bool, bool]:
    """Fly from a state within a run of samples through all flights and impacts without a doubt.

    Parameters are those of `rocksteady.kernels.march.march.nonlinear_ride`, results those of
    `rocksteady.kernels.march._samples.fly_through`.
    """
    segments, sides = tables
    rows, peaks = kept
    side, angle, velocity, segment, half, phase, impacts, flights = state
    duration, left_out = segments[segment, columns.DURATION], sides[0, columns.LEFT_OUT]
    behind = end_of_run(segments, segment)
    record, watch, keeps = len(rows) > 0, len(peaks) > 0, len(peaks) >= columns.PASSAGE_COLUMNS
    row = 0 if side > 0 else 1
    lean, rate, alpha = (
        sides[row, columns.LEAN],
        sides[row, columns.RATE],
        sides[row, columns.ALPHA],
    )
    pull, unit, slowing = side / lean, lean * rate, 1.0 / rate
    y, v = side * angle / lean, side * velocity / unit
    top_angle = top_speed = math.inf
    if watch:
        top_angle, top_speed = peaks[columns.PEAK_ANGLE], peaks[columns.PEAK_SPEED] / unit
    fallen = bounced = moved = False
    if is_held(ride):
        y, v = ride[rides.ANGLE], ride[rides.VELOCITY]
        if watch:
            top_angle, top_speed = ride[rides.TOP_ANGLE], ride[rides.TOP_SPEED]
        ride[rides.HELD], moved = 0.0, True
    while segment < behind and flights < until.limit:
        constant, slope = segments[segment, columns.CONSTANT], segments[segment, columns.SLOPE]
        lift, lift_slope = segments[segment, columns.LIFT], segments[segment, columns.LIFT_SLOPE]
        shaking, shaking_slope = pull * (constant + slope * phase), pull * slowing * slope
        lift, lift_slope = lift + lift_slope * phase, slowing * lift_slope
        span, weight = (duration - phase) * rate, 1.0 + lift
        if span <= 0.0 or min(weight, weight + lift_slope * span) <= WEIGHTLESS:
            break
        at = Instant(0.0, y, v, 0.0, 1.0, y == 0.0 and v == 0.0)
        driven = StepDrive(alpha, shaking, shaking_slope, weight, lift_slope)
        course, exact = middle_step(driven, at, span, left_out)
        degree, event = DEGREE, NO_LANDING
        if not exact and y + span * (v + span * (course.second + span * course.third)) <= 0.0:
            course, span, exact = step_to_landing(driven, at, span, left_out, course.second)
            if not exact:
                break
        if exact:
            bend = 2.0 * course.second
            third, fourths = bounds_over(course, span)
            later_y, later_v = state_after(course, y, v, span)
            if not stays_above(y, v, bend - third * span, span):
                event, span, later_y, later_v = first_landing(
                    course, y, v, span, fourths, later_y, later_v
                )
                if event == DOUBT:
                    break
        else:
            drive = Drive(alpha, shaking, shaking_slope, 0.0, 0.0, lift, lift_slope, 0.0)
            above, degree, third, later_y, later_v = series_step(drive, at, span, left_out, work)
            bend = 2.0 * work[ANGLE, 2]
            if not above:
                break
        fastest, highest = most_over(Stretch(y, v, later_y, later_v, bend, third, span))
        if highest >= HALF_PI / alpha:
            break
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
            top_angle, top_speed = max(top_angle, y, later_y), max(top_speed, abs(v), abs(later_v))
            if fastest > top_speed or highest > top_angle:
                if exact:
                    fill_course(course, y, v, work)
                top_angle, top_speed = largest(
                    work, degree, span, third, later_y, later_v, top_angle, top_speed
                )
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
                alpha = sides[row, columns.ALPHA]
                pull, unit, slowing = side / lean, lean * rate, 1.0 / rate
                top_speed = speed_in_unit(peaks, top_speed, before, unit)
            y, v = 0.0, side * velocity / unit
            if bounced:
                break
        else:
            segment += 1
            phase = 0.0
            if y > 1.0 and v >= 0.0 and y > point_of_no_return(segments, segment, sides, side):
                fallen = True  # nothing that is still to come can bring it back
                break
        held = is_ride(ride) and segment < behind and segments[segment, columns.ALIKE] > 0.0
        if held and flights < until.limit:
            hold(ride, y, v, top_angle, top_speed)
            break
    if watch:
        peaks[columns.PEAK_ANGLE] = top_angle
        peaks[columns.PEAK_SPEED] = max(peaks[columns.PEAK_SPEED], top_speed * unit)
    if moved:  # otherwise untouched, to the last bit
        angle, velocity = side * y * lean, side * v * unit
    return March(side, angle, velocity, segment, half, phase, impacts, flights), fallen, bounced


@inlined
def series_step(
    drive: Drive, at: Instant, span: float, left_out: float, work: Floats
) -> tuple[bool, int, float, float, float]:
    """Step over a span by the long series.

    Returns
    -------
    tuple
        Whether it is exact and the block does not land in it, the degree, a bound of the third
        derivative, and y and y' at the end.
    """
    degree, step = expand_series(drive, at, reach_of(at.velocity, span), left_out, work)
    third = third_bound(work, degree, span)
    later, later_velocity = angle_at(work, degree, span)
    least = 2.0 * work[ANGLE, 2] - third * span
    above = step >= span and stays_above(at.angle, at.velocity, least, span)
    return above, degree, third, later, later_velocity


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
