"""One sample of many blocks in lanes: products and conditions of `kernels.nonlinear.samples`.

Fields of a lane are offsets into one flat array.
"""

from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.core.typed import FALSE, TRUE
from rocksteady.kernels.elementary.circular import SMALL_ANGLE, small_sinc_cos
from rocksteady.kernels.machine_code.compilation import inlined
from rocksteady.kernels.machine_code.width import side_by_side
from rocksteady.kernels.nonlinear._expansion import (
    BRIEF,
    Course,
    bounds_over,
    course_from,
    is_enough,
    state_after,
)
from rocksteady.kernels.nonlinear._zeros import stays_above
from rocksteady.kernels.nonlinear.drive import WEIGHTLESS, StepDrive

# 16 or fewer lanes would be unrolled and stay scalar.
LANES = side_by_side(32)

(
    ANGLE,
    VELOCITY,
    TOP_ANGLE,
    TOP_SPEED,
    PASSES,  # 1 where the last pass took the lane through a sample
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
) = range(0, 18 * LANES, LANES)
FIELDS = 18


@inlined
def step_lanes(lanes: Floats) -> None:
    """Take lanes through a sample, as `kernels.nonlinear.samples` does."""
    longest = 0.0
    for j in range(LANES):
        longest = max(longest, lanes[DURATION + j] * lanes[RATE + j])
    if longest <= BRIEF:
        _step(lanes, TRUE)
    else:
        _step(lanes, FALSE)


@inlined
def _step(lanes: Floats, brief: bool) -> None:
    """Take lanes through a sample; `brief` is whether the samples of all are."""
    for j in range(LANES):
        y, v = lanes[ANGLE + j], lanes[VELOCITY + j]
        alpha, span = lanes[ALPHA + j], lanes[DURATION + j] * lanes[RATE + j]
        shaking = lanes[PULL + j] * lanes[CONSTANT + j]
        shaking_slope = lanes[STEEPNESS + j] * lanes[SLOPE + j]
        weight = 1.0 + lanes[LIFT + j]
        lift_slope = lanes[SLOWING + j] * lanes[LIFT_SLOPE + j]
        tilt = alpha * (1.0 - y)
        sinc, cosine = small_sinc_cos(tilt)
        sine = sinc * (1.0 - y)
        force = shaking * cosine - weight * sine
        driven = StepDrive(alpha, shaking, shaking_slope, weight, lift_slope)
        course = course_from(driven, v, sine, cosine, force, brief)
        short = brief or span <= BRIEF
        exact = is_enough(course, y, v, span, lanes[LEFT_OUT + j], short)
        second, third, fourth, fifth, sixth, seventh, eighth, ninth, tenth = course
        ninth, tenth = 0.0 if short else ninth, 0.0 if short else tenth
        course = Course(second, third, fourth, fifth, sixth, seventh, eighth, ninth, tenth)
        bend = 2.0 * course.second
        third, _ = bounds_over(course, span)
        later_y, later_v = state_after(course, y, v, span)
        above = stays_above(y, v, bend - third * span, span)
        fastest = max(abs(v), abs(later_v)) + span * (abs(bend) + third * span)
        highest = max(y, later_y) + span * fastest
        top_angle, top_speed = lanes[TOP_ANGLE + j], lanes[TOP_SPEED + j]
        turns = (abs(bend) <= third * span) | ((v > 0.0) & (later_v < 0.0))
        higher = (fastest > top_speed) | (highest > top_angle)
        passes = (
            exact
            & above
            & (abs(tilt) < SMALL_ANGLE)
            & (min(weight, weight + lift_slope * span) > WEIGHTLESS)
            & (highest < lanes[FLAT + j])
            & (later_y <= 1.0)
            & (lanes[READY + j] > 0.0)
            & ~(turns & higher)
        )
        speed = max(top_speed, abs(v), abs(later_v))
        lanes[PASSES + j] = 1.0 if passes else 0.0
        lanes[ANGLE + j] = later_y if passes else y
        lanes[VELOCITY + j] = later_v if passes else v
        lanes[TOP_ANGLE + j] = max(top_angle, y, later_y) if passes else top_angle
        lanes[TOP_SPEED + j] = speed if passes else top_speed
