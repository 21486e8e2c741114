"""One sample of many blocks in lanes: products and conditions of `kernels.nonlinear.samples`.

Fields of a lane are offsets into one flat array.
"""

from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.core.typed import FALSE, TRUE
from rocksteady.kernels.elementary.circular import SMALL_ANGLE, small_sinc_cos
from rocksteady.kernels.linear.short import LANDS, NO_LANDING
from rocksteady.kernels.machine_code.compilation import inlined
from rocksteady.kernels.machine_code.width import side_by_side
from rocksteady.kernels.nonlinear._expansion import (
    BRIEF,
    Course,
    bounds_over,
    course_from,
    landing_step,
    shortened,
    state_after,
)
from rocksteady.kernels.nonlinear._landing_step import landing_at_once, landing_event
from rocksteady.kernels.nonlinear._zeros import stays_above
from rocksteady.kernels.nonlinear.drive import WEIGHTLESS, StepDrive

# 16 or fewer lanes would be unrolled and stay scalar.
LANES = side_by_side(32)

(
    ANGLE,
    VELOCITY,
    TOP_ANGLE,
    TOP_SPEED,
    PHASE,  # time into the sample
    PASSES,  # 1 where the last pass took the lane through the rest of a sample
    LANDING,  # or else the side time after which it lands in that, or 0
    LANDING_VELOCITY,
    READY,  # 1 where the lane is at a sample that it may pass
    # Of the side.
    PULL,
    STEEPNESS,  # the pull over the rate
    SLOWING,
    RATE,
    ALPHA,
    LEFT_OUT,
    FLAT,  # the angle at which the block lies on its side
    # Of the sample.
    CONSTANT,
    SLOPE,
    DURATION,
    LIFT,
    LIFT_SLOPE,
) = range(0, 21 * LANES, LANES)
FIELDS = 21


@inlined
def step_lanes(lanes: Floats) -> None:
    """Take lanes through a sample, as `kernels.nonlinear.samples` does."""
    longest = 0.0
    for j in range(LANES):
        longest = max(longest, lanes[DURATION + j] * lanes[RATE + j])
    if longest <= BRIEF:
        _step(lanes, TRUE, FALSE)
    else:
        _step(lanes, FALSE, FALSE)


@inlined
def land_lanes(lanes: Floats) -> None:
    """Do what `step_lanes` does, and find where lanes land that do so within the sample."""
    _step(lanes, FALSE, TRUE)


@inlined
def _step(lanes: Floats, brief: bool, lands: bool) -> None:
    """Take lanes through a sample, or find where they land if it `lands`.

    `brief` is whether the samples of all lanes are.
    """
    for j in range(LANES):
        y, v, left_out = lanes[ANGLE + j], lanes[VELOCITY + j], lanes[LEFT_OUT + j]
        whole, span, sound = _whole_course(lanes, j, brief)
        course, exact = shortened(whole, y, v, span, left_out, brief)
        falls, found = False, False
        if lands:
            second = whole.second
            falls = (not exact) and y + span * (v + span * (second + span * whole.third)) <= 0.0
            span = landing_step(y, v, second, span) if falls else span
            course, exact = shortened(whole, y, v, span, left_out, brief)
        bend = 2.0 * course.second
        third, fourths = bounds_over(course, span)
        later_y, later_v = state_after(course, y, v, span)
        above = stays_above(y, v, bend - third * span, span)
        if lands:
            event = landing_event(course, y, v, span, fourths, later_y)
            time, speed, there = landing_at_once(course, y, v, span)
            above = (above | (event == NO_LANDING)) & ~falls
            found = there & (event == LANDS) & (later_y <= 0.0) & ~above
            span = time if found else span
            later_y, later_v = 0.0 if found else later_y, speed if found else later_v
        fastest = max(abs(v), abs(later_v)) + span * (abs(bend) + third * span)
        highest = max(y, later_y) + span * fastest
        top_angle, top_speed = lanes[TOP_ANGLE + j], lanes[TOP_SPEED + j]
        turns = (abs(bend) <= third * span) | ((v > 0.0) & (later_v < 0.0))
        higher = (fastest > top_speed) | (highest > top_angle)
        moves = sound & exact & (above | found) & (highest < lanes[FLAT + j]) & (later_y <= 1.0)
        moves = moves & ~(turns & higher)
        passes = moves & above
        speed = max(top_speed, abs(v), abs(later_v))
        lanes[PASSES + j] = 1.0 if passes else 0.0
        lanes[ANGLE + j] = later_y if passes else y
        lanes[VELOCITY + j] = later_v if passes else v
        lanes[PHASE + j] = 0.0 if passes else lanes[PHASE + j]
        lanes[TOP_ANGLE + j] = max(top_angle, y, later_y) if moves else top_angle
        lanes[TOP_SPEED + j] = speed if moves else top_speed
        if lands:
            lanes[LANDING + j] = span if moves & found else 0.0
            lanes[LANDING_VELOCITY + j] = later_v


@inlined
def _whole_course(lanes: Floats, j: int, brief: bool) -> tuple[Course, float, bool]:
    """Return the coefficients over the rest of a lane's sample, its length, and whether they hold.

    They do where the lane is ready, its block stands steeply enough and has weight.
    """
    y, v, phase = lanes[ANGLE + j], lanes[VELOCITY + j], lanes[PHASE + j]
    alpha, span = lanes[ALPHA + j], (lanes[DURATION + j] - phase) * lanes[RATE + j]
    shaking = lanes[PULL + j] * (lanes[CONSTANT + j] + lanes[SLOPE + j] * phase)
    shaking_slope = lanes[STEEPNESS + j] * lanes[SLOPE + j]
    weight = 1.0 + (lanes[LIFT + j] + lanes[LIFT_SLOPE + j] * phase)
    lift_slope = lanes[SLOWING + j] * lanes[LIFT_SLOPE + j]
    tilt = alpha * (1.0 - y)
    sinc, cosine = small_sinc_cos(tilt)
    sine = sinc * (1.0 - y)
    force = shaking * cosine - weight * sine
    driven = StepDrive(alpha, shaking, shaking_slope, weight, lift_slope)
    course = course_from(driven, v, sine, cosine, force, brief)
    heavy = min(weight, weight + lift_slope * span) > WEIGHTLESS
    ready = (lanes[READY + j] > 0.0) & (span > 0.0)
    return course, span, (abs(tilt) < SMALL_ANGLE) & heavy & ready
