"""The step that a nonlinear flight takes: of degree 8 or 10 where that does, or the long series.

Without a sinusoid, as between two samples of a record, each coefficient follows from those before
it, with S and C of `rocksteady.kernels.nonlinear.series`.  Sums are written out, the products that
are known last at their end, so that no processor waits for more than it must.  The step of length
t is exact where a_n t^n and a_(n-1) t^(n+1), of its last coefficients, are negligible, as in the
series.  A brief step takes degree 8 where that is exact: so do nearly all samples of a record
whose interval is short for the block, 999 of 1000 at 2 ms.  A sample in flight costs a tenth of
what the series costs, an impact in one a quarter.
"""

import math
from typing import NamedTuple

from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.core.typed import FALSE, TRUE
from rocksteady.kernels.elementary.circular import SMALL_ANGLE, sincos_near, small_sinc_cos
from rocksteady.kernels.machine_code.compilation import compiled, inlined
from rocksteady.kernels.nonlinear.drive import Drive, Instant, StepDrive
from rocksteady.kernels.nonlinear.series import (
    ANGLE,
    BEYOND,
    expand_linear,
    expand_series,
    root_of_parabola,
)

DEGREE = 10
BRIEF = 0.01
"""Longest step, in a side's time, for which degree 8 is tried."""


class Course(NamedTuple):
    """Taylor coefficients of y over a step, from the second on."""

    second: float
    third: float
    fourth: float
    fifth: float
    sixth: float
    seventh: float
    eighth: float
    ninth: float
    tenth: float


@compiled
def middle_step(drive: StepDrive, at: Instant, step: float, left_out: float) -> tuple[Course, bool]:
    """Return the coefficients of a step, of degree 8 or 10, and whether they are enough.

    Parameters
    ----------
    drive, at
        What drives the side at the start of the step, and its state there.
    step
        Length of the step.
    left_out
        Part of the motion that a step may leave out.
    """
    tilt = drive.alpha * (1.0 - at.angle)
    if abs(tilt) < SMALL_ANGLE:
        sinc, cosine = small_sinc_cos(tilt)
        sine = sinc * (1.0 - at.angle)
    else:
        sine, cosine = sincos_near(tilt)
        sine /= drive.alpha
    force = drive.shaking * cosine - drive.weight * sine
    if at.lifting:
        force = max(force, 0.0)
    if step <= BRIEF:
        course = course_from(drive, at.velocity, sine, cosine, force, TRUE)
        if is_enough(course, at.angle, at.velocity, step, left_out, TRUE):
            return course, True
    course = course_from(drive, at.velocity, sine, cosine, force, FALSE)
    return course, is_enough(course, at.angle, at.velocity, step, left_out, FALSE)


@inlined
def is_enough(
    course: Course, angle: float, velocity: float, step: float, left_out: float, brief: bool
) -> bool:
    """Return whether degree 10, or 8 of a brief step, is exact over the step."""
    squared = step * step
    power = squared * squared * squared * step
    largest = max(
        abs(angle),
        abs(velocity) * step,
        squared * abs(course.second),
        squared * step * abs(course.third),
    )
    before = course.seventh if brief else course.ninth
    last = course.eighth if brief else course.tenth
    power *= 1.0 if brief else squared
    allowed = left_out * largest
    left = power * (squared * abs(before) + step * abs(last))
    return (left <= allowed) & (allowed < math.inf)


@inlined
def course_from(
    drive: StepDrive, velocity: float, sine: float, cosine: float, force: float, brief: bool
) -> Course:
    """Return the coefficients from S, C and y'' at the start, of a brief step to degree 8."""
    alpha, shaking, shaking_slope, weight, weight_slope = drive
    square = alpha * alpha
    v0, s0, c0 = velocity, sine, cosine
    v1 = force
    s1 = -(v0 * c0)
    c1 = square * (v0 * s0)
    force = (shaking_slope * c0 - weight_slope * s0) + (shaking * c1 - weight * s1)
    v2 = force * (1.0 / 2.0)
    s2 = (v0 * c1 + v1 * c0) * (-1.0 / 2.0)
    c2 = (v0 * s1 + v1 * s0) * (square * (1.0 / 2.0))
    force = (shaking_slope * c1 - weight_slope * s1) + (shaking * c2 - weight * s2)
    v3 = force * (1.0 / 3.0)
    s3 = (v1 * c1 + v0 * c2 + v2 * c0) * (-1.0 / 3.0)
    c3 = (v1 * s1 + v0 * s2 + v2 * s0) * (square * (1.0 / 3.0))
    force = (shaking_slope * c2 - weight_slope * s2) + (shaking * c3 - weight * s3)
    v4 = force * (1.0 / 4.0)
    s4 = (v1 * c2 + v2 * c1 + v0 * c3 + v3 * c0) * (-1.0 / 4.0)
    c4 = (v1 * s2 + v2 * s1 + v0 * s3 + v3 * s0) * (square * (1.0 / 4.0))
    force = (shaking_slope * c3 - weight_slope * s3) + (shaking * c4 - weight * s4)
    v5 = force * (1.0 / 5.0)
    s5 = (v1 * c3 + v2 * c2 + v3 * c1 + v0 * c4 + v4 * c0) * (-1.0 / 5.0)
    c5 = (v1 * s3 + v2 * s2 + v3 * s1 + v0 * s4 + v4 * s0) * (square * (1.0 / 5.0))
    force = (shaking_slope * c4 - weight_slope * s4) + (shaking * c5 - weight * s5)
    v6 = force * (1.0 / 6.0)
    s6 = (v1 * c4 + v2 * c3 + v3 * c2 + v4 * c1 + v0 * c5 + v5 * c0) * (-1.0 / 6.0)
    c6 = (v1 * s4 + v2 * s3 + v3 * s2 + v4 * s1 + v0 * s5 + v5 * s0) * (square * (1.0 / 6.0))
    force = (shaking_slope * c5 - weight_slope * s5) + (shaking * c6 - weight * s6)
    v7 = force * (1.0 / 7.0)
    second, third, fourth = 0.5 * v1, v2 * (1.0 / 3.0), 0.25 * v3
    fifth, sixth, seventh, eighth = v4 * (1.0 / 5.0), v5 * (1.0 / 6.0), v6 * (1.0 / 7.0), 0.125 * v7
    if brief:
        return Course(second, third, fourth, fifth, sixth, seventh, eighth, 0.0, 0.0)
    s7 = (v1 * c5 + v2 * c4 + v3 * c3 + v4 * c2 + v5 * c1 + v0 * c6 + v6 * c0) * (-1.0 / 7.0)
    c7 = (v1 * s5 + v2 * s4 + v3 * s3 + v4 * s2 + v5 * s1 + v0 * s6 + v6 * s0) * (
        square * (1.0 / 7.0)
    )
    force = (shaking_slope * c6 - weight_slope * s6) + (shaking * c7 - weight * s7)
    v8 = force * (1.0 / 8.0)
    s8 = (v1 * c6 + v2 * c5 + v3 * c4 + v4 * c3 + v5 * c2 + v6 * c1 + v0 * c7 + v7 * c0) * (
        -1.0 / 8.0
    )
    c8 = (v1 * s6 + v2 * s5 + v3 * s4 + v4 * s3 + v5 * s2 + v6 * s1 + v0 * s7 + v7 * s0) * (
        square * (1.0 / 8.0)
    )
    force = (shaking_slope * c7 - weight_slope * s7) + (shaking * c8 - weight * s8)
    v9 = force * (1.0 / 9.0)
    ninth, tenth = v8 * (1.0 / 9.0), v9 * (1.0 / 10.0)
    return Course(second, third, fourth, fifth, sixth, seventh, eighth, ninth, tenth)


@compiled
def step_to_landing(
    drive: StepDrive, at: Instant, span: float, left_out: float, second: float
) -> tuple[Course, float, bool]:
    """Return a step up to the landing, of a flight whose step over the span is not exact."""
    step = landing_step(at.angle, at.velocity, second, span)
    course, exact = middle_step(drive, at, step, left_out)
    landed, _ = state_after(course, at.angle, at.velocity, step)
    return course, step, exact and landed <= 0.0


@inlined
def landing_step(angle: float, velocity: float, second: float, span: float) -> float:
    """Return the length of a step that ends soon after a landing, or with the span."""
    return min(BEYOND * root_of_parabola(angle, velocity, 2.0 * second, TRUE), span)


@inlined
def shortened(
    course: Course, angle: float, velocity: float, step: float, left_out: float, brief: bool
) -> tuple[Course, bool]:
    """Return what `middle_step` does of a course that is known to degree 10, or 8 if it is `brief`.

    Here without branches.
    """
    short = (step <= BRIEF) & is_enough(course, angle, velocity, step, left_out, TRUE)
    exact = short or (not brief and is_enough(course, angle, velocity, step, left_out, FALSE))
    second, third, fourth, fifth, sixth, seventh, eighth, ninth, tenth = course
    ninth, tenth = 0.0 if short else ninth, 0.0 if short else tenth
    return Course(second, third, fourth, fifth, sixth, seventh, eighth, ninth, tenth), exact


@inlined
def state_after(course: Course, angle: float, velocity: float, time: float) -> tuple[float, float]:
    """Return y and y' at a time of the step."""
    second, third, fourth, fifth, sixth, seventh, eighth, ninth, tenth = course
    # In pairs, what is known last at the end: nothing waits for a long chain of products.
    square = time * time
    fourths = square * square
    low = (velocity * time + square * second) + square * (time * third + square * fourth)
    high = (time * ninth + square * tenth) * square + (time * seventh + square * eighth)
    low += fourths * ((time * fifth + square * sixth) + square * high)
    slope = (2.0 * (time * second) + 3.0 * (square * third)) + square * (
        4.0 * (time * fourth) + 5.0 * (square * fifth)
    )
    high = (8.0 * (time * eighth) + 9.0 * (square * ninth)) + 10.0 * (square * (time * tenth))
    slope += fourths * ((6.0 * (time * sixth) + 7.0 * (square * seventh)) + square * high)
    return angle + low, velocity + slope


@inlined
def bends_after(course: Course, time: float) -> tuple[float, float, float, float]:
    """Return y'' and the next three derivatives at a time of the step; the last two nearly."""
    second, third, fourth, fifth, sixth, seventh, eighth, ninth, tenth = course
    high = 56.0 * eighth + time * (72.0 * ninth + time * (90.0 * tenth))
    high = 20.0 * fifth + time * (30.0 * sixth + time * (42.0 * seventh + time * high))
    bend = 2.0 * second + time * (6.0 * third + time * (12.0 * fourth + time * high))
    high = 60.0 * fifth + time * (120.0 * sixth + time * (210.0 * seventh))
    jerk = 6.0 * third + time * (24.0 * fourth + time * high)
    high = 120.0 * fifth + time * (360.0 * sixth + time * (840.0 * seventh))
    later = 120.0 * fifth + time * (720.0 * sixth)
    return bend, jerk, 24.0 * fourth + time * high, later


@inlined
def bounds_over(course: Course, step: float) -> tuple[float, float]:
    """Return upper bounds of the moduli of the third and the fourth derivative over the step."""
    _, third, fourth, fifth, sixth, seventh, eighth, ninth, tenth = course
    high = 1680.0 * abs(eighth) + step * (3024.0 * abs(ninth) + step * (5040.0 * abs(tenth)))
    high = 360.0 * abs(sixth) + step * (840.0 * abs(seventh) + step * high)
    fourths = 24.0 * abs(fourth) + step * (120.0 * abs(fifth) + step * high)
    return 6.0 * abs(third) + step * fourths, fourths


class Stretch(NamedTuple):
    """A flight over a step, by what bounds it."""

    angle: float  # at its start
    velocity: float
    later_angle: float  # at its end
    later_velocity: float
    bend: float  # second derivative at its start
    third: float  # bound of the third derivative
    span: float


@inlined
def most_over(stretch: Stretch) -> tuple[float, float]:
    """Return upper bounds of |y'| and y over a step: their ends' where neither has a peak within.

    Over a step of length h a function leaves its chord by at most h^2/8 of its second derivative.
    """
    angle, velocity, later_angle, later_velocity, bend, third, span = stretch
    bend, change, eighth = abs(bend), third * span, 0.125 * (span * span)
    start, end = abs(velocity), abs(later_velocity)
    beyond = eighth * third
    turns = ((velocity > 0.0) != (later_velocity > 0.0)) | (min(start, end) <= beyond)
    fastest = max(start, end) + (beyond if bend <= change else 0.0)
    highest = max(angle, later_angle) + (eighth * (bend + change) if turns else 0.0)
    return fastest, highest


@inlined
def fill_course(course: Course, angle: float, velocity: float, work: Floats) -> None:
    """Fill the coefficients of y."""
    work[ANGLE, 0], work[ANGLE, 1] = angle, velocity
    work[ANGLE, 2], work[ANGLE, 3], work[ANGLE, 4] = course.second, course.third, course.fourth
    work[ANGLE, 5], work[ANGLE, 6], work[ANGLE, 7] = course.fifth, course.sixth, course.seventh
    work[ANGLE, 8], work[ANGLE, 9], work[ANGLE, 10] = course.eighth, course.ninth, course.tenth


@compiled
def expand(
    drive: Drive, at: Instant, reach: float, left_out: float, work: Floats
) -> tuple[int, float]:
    """Fill the coefficients of y by a step of degree 10 where one does, or else by the series.

    Parameters and results are those of `rocksteady.kernels.nonlinear.series.expand_series`, which
    fills all rows.
    """
    if drive.alpha == 0.0:
        return expand_linear(drive, at, reach, left_out, work)
    time, angle, velocity, _, _, _ = at
    if drive.frequency == 0.0:
        shaking = drive.constant + drive.slope * time
        weight = 1.0 + drive.lift + drive.lift_slope * time
        driven = StepDrive(drive.alpha, shaking, drive.slope, weight, drive.lift_slope)
        step = reach
        for _ in range(2):
            course, exact = middle_step(driven, at, step, left_out)
            if exact:
                fill_course(course, angle, velocity, work)
                return DEGREE, step
            # A shorter one, up to the next zero, may be exact; not to a zero at the start itself.
            step = BEYOND * root_of_parabola(angle, velocity, 2.0 * course.second, TRUE)
            if not 0.0 < step < reach:
                break
    return expand_series(drive, at, reach, left_out, work)
