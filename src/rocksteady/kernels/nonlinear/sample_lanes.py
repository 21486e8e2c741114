"""One sample of many blocks in lanes: products and conditions of `kernels.nonlinear.samples`.

Landings are found in two looks, by selects alone; what would need more is left to the march.

Fields of a lane are offsets into one flat array.
"""

from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.core.typed import FALSE, TRUE
from rocksteady.kernels.elementary.circular import SMALL_ANGLE, small_sinc_cos
from rocksteady.kernels.linear.short import LANDS, NO_LANDING
from rocksteady.kernels.machine_code.compilation import compiled, inlined
from rocksteady.kernels.machine_code.width import side_by_side
from rocksteady.kernels.nonlinear._expansion import (
    BRIEF,
    Course,
    Stretch,
    bounds_over,
    course_from,
    landing_step,
    most_over,
    shortened,
    state_after,
)
from rocksteady.kernels.nonlinear._landing_step import landing_at_once, landing_event
from rocksteady.kernels.nonlinear._zeros import largest, stays_above
from rocksteady.kernels.nonlinear.drive import WEIGHTLESS, Drive, Instant, StepDrive
from rocksteady.kernels.nonlinear.samples import series_step
from rocksteady.kernels.nonlinear.series import ANGLE as COEFFICIENTS

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
    COARSE,  # 1 where a short step is not exact, and the block does not come down
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
) = range(0, 22 * LANES, LANES)
FIELDS = 22


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
            down = y + span * (v + span * (second + span * whole.third)) <= 0.0
            falls = down and not exact
            coarse = sound and not (exact or down) and (y != 0.0 or v != 0.0)
            lanes[COARSE + j] = 1.0 if coarse else 0.0
            span = landing_step(y, v, second, span) if falls else span
            course, exact = shortened(whole, y, v, span, left_out, brief)
        bend = 2.0 * course.second
        third, fourths = bounds_over(course, span)
        later_y, later_v = state_after(course, y, v, span)
        above = stays_above(y, v, bend - third * span, span)
        if lands:
            event = landing_event(course, y, v, span, fourths, later_y)
            time, speed, there = landing_at_once(course, y, v, span)
            above = (above or event == NO_LANDING) and not falls
            found = there and event == LANDS and later_y <= 0.0 and not above
            span = time if found else span
            later_y, later_v = 0.0 if found else later_y, speed if found else later_v
        fastest, highest = most_over(Stretch(y, v, later_y, later_v, bend, third, span))
        top_angle, top_speed = lanes[TOP_ANGLE + j], lanes[TOP_SPEED + j]
        angle, speed = max(top_angle, y, later_y), max(top_speed, abs(v), abs(later_v))
        moves = sound & exact & (above | found) & (highest < lanes[FLAT + j]) & (later_y <= 1.0)
        moves = moves & (fastest <= speed) & (highest <= angle)
        passes = moves & above
        lanes[PASSES + j] = 1.0 if passes else 0.0
        lanes[ANGLE + j] = later_y if passes else y
        lanes[VELOCITY + j] = later_v if passes else v
        lanes[PHASE + j] = 0.0 if passes else lanes[PHASE + j]
        lanes[TOP_ANGLE + j] = angle if moves else top_angle
        lanes[TOP_SPEED + j] = speed if moves else top_speed
        if lands:
            lanes[LANDING + j] = span if moves & found else 0.0
            lanes[LANDING_VELOCITY + j] = later_v


@inlined
def _whole_course(lanes: Floats, j: int, brief: bool) -> tuple[Course, float, bool]:
    """Return the coefficients over the rest of a lane's sample, its length, and whether they hold.

    They do where the lane is ready, its block stands steeply enough and has weight.
    """
    y, v = lanes[ANGLE + j], lanes[VELOCITY + j]
    driven, _, span = _driven(lanes, j)
    tilt = driven.alpha * (1.0 - y)
    sinc, cosine = small_sinc_cos(tilt)
    sine = sinc * (1.0 - y)
    force = driven.shaking * cosine - driven.weight * sine
    course = course_from(driven, v, sine, cosine, force, brief)
    heavy = min(driven.weight, driven.weight + driven.weight_slope * span) > WEIGHTLESS
    ready = (lanes[READY + j] > 0.0) & (span > 0.0)
    return course, span, (abs(tilt) < SMALL_ANGLE) & heavy & ready


@inlined
def _driven(lanes: Floats, j: int) -> tuple[StepDrive, float, float]:
    """Return what drives a lane's side over the rest of its sample, l there, and its length."""
    phase = lanes[PHASE + j]
    lift = lanes[LIFT + j] + lanes[LIFT_SLOPE + j] * phase
    driven = StepDrive(
        lanes[ALPHA + j],
        lanes[PULL + j] * (lanes[CONSTANT + j] + lanes[SLOPE + j] * phase),
        lanes[STEEPNESS + j] * lanes[SLOPE + j],
        1.0 + lift,
        lanes[SLOWING + j] * lanes[LIFT_SLOPE + j],
    )
    return driven, lift, (lanes[DURATION + j] - phase) * lanes[RATE + j]


@compiled
def pass_coarse(lanes: Floats, j: int, work: Floats) -> bool:
    """Take a lane through a coarse sample by the series; return whether that is plain too."""
    y, v = lanes[ANGLE + j], lanes[VELOCITY + j]
    driven, lift, span = _driven(lanes, j)
    alpha, shaking, shaking_slope, _, lift_slope = driven
    drive = Drive(alpha, shaking, shaking_slope, 0.0, 0.0, lift, lift_slope, 0.0)
    at = Instant(0.0, y, v, 0.0, 1.0, False)
    left_out = lanes[LEFT_OUT + j]
    above, degree, third, later_y, later_v = series_step(drive, at, span, left_out, work)
    bend = 2.0 * work[COEFFICIENTS, 2]
    fastest, highest = most_over(Stretch(y, v, later_y, later_v, bend, third, span))
    top_angle = max(lanes[TOP_ANGLE + j], y, later_y)
    top_speed = max(lanes[TOP_SPEED + j], abs(v), abs(later_v))
    if not above or highest >= lanes[FLAT + j] or later_y > 1.0:
        return False
    if fastest > top_speed or highest > top_angle:
        top_angle, top_speed = largest(
            work, degree, span, third, later_y, later_v, top_angle, top_speed
        )
    lanes[ANGLE + j], lanes[VELOCITY + j], lanes[PHASE + j] = later_y, later_v, 0.0
    lanes[TOP_ANGLE + j], lanes[TOP_SPEED + j] = top_angle, top_speed
    return True
