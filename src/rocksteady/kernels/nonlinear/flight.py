"""Nonlinear flight: Taylor steps up to its first zero."""

import math

from rocksteady.kernels.core import tables
from rocksteady.kernels.core.forcing import TWO_PI
from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.elementary.circular import sincos_near
from rocksteady.kernels.linear.zeros import Zero
from rocksteady.kernels.machine_code.compilation import compiled, inlined
from rocksteady.kernels.nonlinear._expansion import expand
from rocksteady.kernels.nonlinear._variation import advance, begin
from rocksteady.kernels.nonlinear._zeros import first_rise, first_zero, largest
from rocksteady.kernels.nonlinear.drive import Drive, Instant, SteppedFlight, hardest_pull
from rocksteady.kernels.nonlinear.proofs import HALF_PI, falls_on_still_base
from rocksteady.kernels.nonlinear.series import ANGLE, angle_at, third_bound

LONGEST_STEP = 1e12
"""Of a block that stands upright to the last bit."""
LONGEST_MOVING_STEP = 8.0
"""Of one that moves.  Only beside the upright position, by less than rounding, might a step be
longer; in it the motion would grow so much that its nodes lay too close together to be counted."""

NEVER = 1e200
"""Angle of a block that lies on its side, in the linear model, which knows of none."""
FAR = 8.0
"""Angle, over that of lying on the side, to which a step may lead."""

MANY_STEPS = 1000
"""Steps that any flight may take: short ones, as to a zero close by, come first and grow."""
SHORT_STEP = 1e-3
"""Mean step, in units of 1/(1 + Omega), below which a flight of more than these is given up."""


@compiled
def is_stuck(drive: Drive, steps: int, time: float) -> bool:
    """Return whether a flight has taken more steps than it can need for the time it has come to.

    Between its samples a motion is smooth on the scale of 1/(1 + Omega), and so are its steps.  A
    flight of a given span therefore takes ``max(MANY_STEPS, span (1 + Omega)/SHORT_STEP)`` steps at
    most, whatever rounding does to them: steps of length 0 and a time that is no number included.
    """
    return steps > MANY_STEPS and not time * (1.0 + drive.frequency) > SHORT_STEP * steps


@compiled
def reach_of(velocity: float, left: float) -> float:
    """Return the longest step of use, with `left` the side time to the end of the flight."""
    return min(left, LONGEST_STEP if velocity == 0.0 else LONGEST_MOVING_STEP)


@compiled
def phase_at(drive: Drive, phase: float, time: float) -> tuple[int, float]:
    """Return whole turns and the phase beyond them, in [-pi/2, 3 pi/2), at a time of a flight."""
    turned = phase + drive.frequency * time
    if turned < 3.0 * HALF_PI:
        return 0, turned
    cycle = int((turned + HALF_PI) / TWO_PI)
    return cycle, turned - TWO_PI * cycle


@inlined
def third_and_step(work: Floats, degree: int, step: float, far: float) -> tuple[float, float]:
    """Return an upper bound of |y'''| over a step, and the step halved until y stays below `far`.

    Far beyond that a polynomial turns too often for its zeros to be told apart.
    """
    third = third_bound(work, degree, step)
    while (
        abs(work[ANGLE, 0])
        + step * (abs(work[ANGLE, 1]) + step * (abs(work[ANGLE, 2]) + step * third))
        > far
    ):
        step *= 0.5
        third = third_bound(work, degree, step)
    return third, step


@compiled
def is_lost(drive: Drive, lost_from: float, angle: float, velocity: float) -> bool:
    """Return whether a block is proved to overturn on a base motion that goes on for ever.

    `lost_from` is the angle of `rocksteady.kernels.nonlinear.proofs.point_of_no_return`.
    """
    if angle > lost_from and velocity >= 0.0:
        return True
    still = (
        drive.alpha > 0.0 and drive.amplitude == 0.0 and drive.constant == 0.0 and drive.lift == 0.0
    )
    return still and falls_on_still_base(drive.alpha, angle, velocity)


@compiled
def fly(
    flight: SteppedFlight,
    endless: bool,
    lost_from: float,
    lifting: bool,
    peaks: Floats,
    lean: float,
    rate: float,
    work: Floats,
    course: Floats,
) -> Zero:
    """Fly from a state to the first zero, to the end of the span or until the block is lost.

    Parameters
    ----------
    flight
        Where it starts, what drives it, and the end of the segment.
    endless
        The base motion goes on for ever, so that a loss may be concluded.
    lost_from
        Angle beyond which a block that moves on is then lost.
    lifting
        The block lifts off from rest at this instant.
    peaks
        As in `rocksteady.kernels.core.tuples.Kept`.
    lean, rate
        Of the side; they convert its speed.
    work
        Working space, shape (6, 24), or that of `kernels.nonlinear.series.make_work`.
    course
        Working space of the derivatives by the state at the start, shape (7, 48), which are left
        in its first row; or of shape (0, ...).  They are for endless periodic shaking, in the
        nonlinear model.

    Returns
    -------
    Zero
        Its event, and the state there.  The time of NO_RETURN is infinite where it is proved, and
        that of the block lying on its side where it has come to that.  STALLED where `is_stuck`
        says so: nothing is known of what follows.
    """
    drive, phase, angle, velocity, span, left_out = flight
    flat = HALF_PI / drive.alpha if drive.alpha > 0.0 else NEVER
    time, cycle, steps = 0.0, 0, 0
    watch, varied = len(peaks) > 0, len(course) > 0
    if varied:
        begin(course)
    here = phase
    sine, cosine = 0.0, 1.0
    if drive.frequency > 0.0:
        sine, cosine = sincos_near(phase)
    while True:
        if angle >= flat:
            return Zero(tables.NO_RETURN, time, cycle, here, sine, cosine, angle, velocity)
        if endless and is_lost(drive, lost_from, angle, velocity):
            return Zero(tables.NO_RETURN, math.inf, cycle, here, sine, cosine, angle, velocity)
        left = span - time
        if left <= 0.0:
            return Zero(tables.SPAN_END, span, cycle, here, sine, cosine, angle, velocity)
        if is_stuck(drive, steps, time):
            return Zero(tables.STALLED, time, cycle, here, sine, cosine, angle, velocity)
        steps += 1
        at = Instant(time, angle, velocity, sine, cosine, lifting and time == 0.0)
        degree, step = expand(drive, at, reach_of(velocity, left), left_out, work)
        event = tables.SPAN_END
        third, step = third_and_step(work, degree, step, FAR * flat)
        zero = first_zero(work, degree, step, third, hardest_pull(drive, time, step))
        ends = step if zero < 0.0 else zero
        if zero >= 0.0:
            event = tables.FOUND
        bend = 2.0 * abs(work[ANGLE, 2]) + third * step
        if angle + ends * (max(velocity, 0.0) + 0.5 * bend * ends) >= flat:
            fallen = first_rise(work, degree, ends, flat)
            if fallen >= 0.0:
                event, ends = tables.NO_RETURN, fallen
        angle, velocity = angle_at(work, degree, ends)
        if varied:
            advance(drive, work, degree, ends, course)
        if watch:
            before, fastest = peaks[tables.PEAK_ANGLE], peaks[tables.PEAK_SPEED] / (lean * rate)
            top_angle, top_speed = largest(
                work, degree, ends, third, angle, velocity, before, fastest
            )
            peaks[tables.PEAK_ANGLE] = top_angle
            peaks[tables.PEAK_SPEED] = max(peaks[tables.PEAK_SPEED], top_speed * lean * rate)
        time = span if event == tables.SPAN_END and step >= left else time + ends
        if drive.frequency > 0.0:
            cycle, here = phase_at(drive, phase, time)
            sine, cosine = sincos_near(here)
        if event == tables.FOUND:
            return Zero(tables.FOUND, time, cycle, here, sine, cosine, 0.0, min(velocity, 0.0))
        if event == tables.NO_RETURN:
            return Zero(tables.NO_RETURN, time, cycle, here, sine, cosine, angle, velocity)
        angle = max(angle, 0.0)
