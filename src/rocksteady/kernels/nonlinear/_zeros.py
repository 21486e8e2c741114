"""All zeros, level crossings and extrema of a step's polynomial.

**Control points.**  Signs of the polynomial in Bernstein's basis say of most steps that they have
no zero, or one (`rocksteady.kernels.nonlinear._bernstein`).  Where they say neither, nodes do.

**Nodes.**  A step is cut into pieces on each of which y'' keeps its sign: with M an upper bound of
|y'''| over the step, y'' does so on a piece of half-width d around m where ``|y''(m)| >= M d``;
other pieces are halved.  On such a piece y' is monotone, so that it has one zero at most; it has
one where its signs at the ends differ, and is cut there once more.  Between two neighbouring
*nodes* y is therefore monotone, and its signs there decide: a zero exists where they differ, and it
is the only one.  A graze is a node itself, a minimum, whose height is known to rounding however
flat it is.

**Most steps need neither.**  While ``y'' >= -q`` the motion stays above the parabola ``y + v t - q
t^2/2``, which is concave and so lowest at an end: where it is positive at the end of a piece (and y
is positive) the step has no zero, grazing ones included.  Where y'' < 0 or y' < 0 all over the step
there is one zero at most, and there is one where y ends below zero.

Halving ends at 2^-40 of the step: what y'' leaves open there is a change of y by M times the cube
of that, far below its rounding.
"""

import math

from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.core.typed import FALSE, TRUE, ZERO
from rocksteady.kernels.machine_code.compilation import compiled, inlined
from rocksteady.kernels.nonlinear._bernstein import (
    CONTROL_POINTS,
    FALLS,
    NO_CHANGE,
    RISES,
    UNKNOWN,
    change_of_sign,
    control_points,
    differences,
    hull,
)
from rocksteady.kernels.nonlinear._expansion import Stretch, most_over
from rocksteady.kernels.nonlinear.series import (
    ANGLE,
    HIGHEST,
    POINTS,
    angle_at,
    angle_bound,
    bend_at,
    root_of_parabola,
    speed_at,
    third_bound,
)

MARGIN = 1e-12
SHORTEST = 2.0**-40
ITERATIONS = 200


@compiled
def next_node(
    work: Floats,
    degree: int,
    step: float,
    third: float,
    start: float,
    velocity: float,
    width: float,
) -> tuple[float, float, float, float]:
    """Return the next node after `start`, y and y' there, and the width to try after it.

    `velocity` is y' at `start`, `width` how long a piece to try.
    """
    while True:
        end = min(start + width, step)
        middle = 0.5 * (start + end)
        _, bend = speed_at(work, degree, middle)
        if abs(bend) >= third * 0.5 * (end - start) or width <= SHORTEST * step:
            break
        width *= 0.5
    if step - end <= SHORTEST * step:
        end = step
    angle, later = angle_at(work, degree, end)
    if (velocity < 0.0 and later > 0.0) or (velocity > 0.0 and later < 0.0):
        turn = turning_point(work, degree, start, end, velocity > 0.0, start)
        if start < turn < end:
            angle, _ = angle_at(work, degree, turn)
            return turn, angle, 0.0, width
    return end, angle, later, 2.0 * width


@compiled
def turning_point(
    work: Floats, degree: int, low: float, high: float, top: bool, guess: float
) -> float:
    """Return the one zero of y' in [low, high], where y has a maximum if it is the `top`."""
    time = guess
    for _ in range(ITERATIONS):
        velocity, bend = speed_at(work, degree, time)
        if (velocity > 0.0) == top:
            low = time
        else:
            high = time
        near = time - velocity / bend if bend != 0.0 else math.inf
        if not (low < near < high):
            near = 0.5 * (low + high)
            if not (low < near < high):
                break
        if near == time:
            break
        time = near
    return time


@compiled
def parabola(work: Floats, degree: int, low: float, level: float, falling: bool) -> float:
    """Return where the parabola of the state at `low` passes a level after it."""
    angle, velocity = angle_at(work, degree, low)
    _, bend = speed_at(work, degree, low)
    return low + root_of_parabola(angle - level, velocity, bend, falling)


@compiled
def crossing(
    work: Floats,
    degree: int,
    low: float,
    high: float,
    level: float,
    falling: bool,
    guess: float,
    bend: float,
) -> float:
    """Return the one time in (low, high] at which y passes a level; |y''| is at most `bend`."""
    time = guess if low < guess <= high else high
    for _ in range(ITERATIONS):
        angle, velocity = angle_at(work, degree, time)
        if (angle > level) == falling:
            low = time
        else:
            high = time
        move = (angle - level) / velocity if velocity != 0.0 else math.inf
        near = time - move
        # What Newton's next step would move, y'' move^2/(2 y'), is below rounding.
        if low <= near <= high and bend * move * move <= 4e-16 * near * abs(velocity):
            return near
        if abs(move) <= 4e-16 * time:
            break
        if abs(move) < 0.1 * time and bend * abs(move) < 0.1 * abs(velocity):
            # The next term of the inverse series (Chebyshev), y'' from its first terms.
            bending = 2.0 * work[ANGLE, 2] + time * (
                6.0 * work[ANGLE, 3] + time * (12.0 * work[ANGLE, 4] + time * 20.0 * work[ANGLE, 5])
            )
            near -= 0.5 * bending / velocity * move * move
        if not (low < near <= high):
            near = 0.5 * (low + high)
            if not (low < near < high):
                time = high
                break
        time = near
    return time


@inlined
def stays_above(angle: float, velocity: float, bend: float, width: float) -> bool:
    """Return whether y is proved positive over a piece on which y'' is at least `bend`.

    At its start y is positive, or zero and rising.
    """
    fall = -0.5 * min(bend, 0.0) * width * width
    moved = (angle - MARGIN * angle) + velocity * width
    return (angle > 0.0 or velocity > 0.0) and moved > fall * (1.0 + MARGIN)


@compiled
def first_zero(work: Floats, degree: int, step: float, third: float, pull: float) -> float:
    """Return the first time in (0, step] at which y is zero, or -1.

    y starts above zero, or at zero with y' >= 0; a zero at the start does not count.  |y'''| is at
    most `third`, and y'' at least -`pull` as long as y >= 0.
    """
    angle, velocity = work[ANGLE, 0], work[ANGLE, 1]
    bend = 2.0 * work[ANGLE, 2]
    most, least = bend + third * step, bend - third * step
    if stays_above(angle, velocity, max(least, -pull), step):
        return -1.0
    largest_bend = abs(bend) + third * step
    concave = most < 0.0 and (angle > 0.0 or velocity > 0.0)
    falling = angle > 0.0 and velocity + max(most, 0.0) * step < 0.0
    if concave or falling:  # one zero at most, and the end says whether it is there
        if angle_at(work, degree, step)[0] > 0.0:
            return -1.0
        guess = root_of_parabola(angle, velocity, bend, TRUE)
        return crossing(work, degree, 0.0, step, 0.0, TRUE, guess, largest_bend)
    # What starts in an impact, or lifts off, has zeros at the start, which are divided out.
    dropped = 0 if angle > 0.0 else 1 if velocity > 0.0 else 2
    if dropped == 2 and work[ANGLE, 2] >= 0.0:
        # It lifts off where y'' is zero but for rounding: y is at least what follows over t^3.
        dropped = 3
    while True:
        doubt = control_points(work, degree, step, dropped)
        change, place = change_of_sign(work, CONTROL_POINTS, doubt)
        if change == NO_CHANGE and work[POINTS, 0] > 0.0:
            return -1.0
        if dropped < 3:
            break
        dropped = 2
    if change == FALLS:
        return crossing(work, degree, 0.0, step, 0.0, TRUE, place * step, largest_bend)
    start, width = 0.0, step
    while start < step:
        end, later, later_velocity, width = next_node(
            work, degree, step, third, start, velocity, width
        )
        if later <= 0.0:
            # What starts at zero with no speed and sinks has not lifted off at all.
            if angle <= 0.0:
                return start
            if later == 0.0:
                return end
            guess = parabola(work, degree, start, 0.0, TRUE)
            return crossing(work, degree, start, end, 0.0, TRUE, guess, largest_bend)
        start, angle, velocity = end, later, later_velocity
    return -1.0


@compiled
def first_rise(work: Floats, degree: int, step: float, level: float) -> float:
    """Return the first time in (0, step] at which y has reached a level, or -1; it starts below."""
    if angle_bound(work, degree, step) < level:
        return -1.0
    third = third_bound(work, degree, step)
    start, velocity, width = 0.0, work[ANGLE, 1], step
    while start < step:
        end, angle, velocity, width = next_node(work, degree, step, third, start, velocity, width)
        if angle >= level:
            guess = parabola(work, degree, start, level, FALSE)
            bend = 2.0 * abs(work[ANGLE, 2]) + third * step
            return crossing(work, degree, start, end, level, FALSE, guess, bend)
        start = end
    return -1.0


@compiled
def last_rise(work: Floats, degree: int, step: float, level: float) -> float:
    """Return the last time in (0, step] at which y rises through a level, or -1."""
    last = -1.0
    third = third_bound(work, degree, step)
    start, angle, velocity, width = 0.0, work[ANGLE, 0], work[ANGLE, 1], step
    if angle_bound(work, degree, step) < level:
        return last
    while start < step:
        end, later, velocity, width = next_node(work, degree, step, third, start, velocity, width)
        if angle <= level < later:
            guess = parabola(work, degree, start, level, FALSE)
            bend = 2.0 * abs(work[ANGLE, 2]) + third * step
            last = crossing(work, degree, start, end, level, FALSE, guess, bend)
        start, angle = end, later
    return last


@compiled
def largest(
    work: Floats,
    degree: int,
    step: float,
    third: float,
    later: float,
    velocity: float,
    angle: float,
    speed: float,
) -> tuple[float, float]:
    """Return the largest y and |y'| over the step; `angle` and `speed` where these are larger.

    y and y' are `later` and `velocity` at its end, |y'''| is at most `third`.
    """
    angle = max(angle, work[ANGLE, 0], later)
    speed = max(speed, abs(work[ANGLE, 1]), abs(velocity))
    stretch = Stretch(
        work[ANGLE, 0], work[ANGLE, 1], later, velocity, 2.0 * work[ANGLE, 2], third, step
    )
    fastest, most = most_over(stretch)
    if fastest <= speed and most <= angle:
        return angle, speed
    doubt = control_points(work, degree, step, ZERO)
    _, most = hull(work, CONTROL_POINTS)
    differences(work, CONTROL_POINTS)  # from here on of y', over HIGHEST/step
    slowest, fastest = hull(work, CONTROL_POINTS - 1)
    if most + doubt > angle:
        change, place = change_of_sign(work, CONTROL_POINTS - 1, 2.0 * doubt)
        if change == FALLS:
            turn = turning_point(work, degree, 0.0, step, TRUE, place * step)
            angle = max(angle, angle_at(work, degree, turn)[0])
        elif change == UNKNOWN:
            angle = highest(work, degree, step, angle)
    if HIGHEST * (max(-slowest, fastest) + 2.0 * doubt) > speed * step:
        differences(work, CONTROL_POINTS - 1)  # of y''
        change, place = change_of_sign(work, CONTROL_POINTS - 2, 4.0 * doubt)
        if change in (RISES, FALLS):
            bend = bending_point(work, degree, step, change == FALLS, place * step)
            speed = max(speed, abs(speed_at(work, degree, bend)[0]))
        elif change == UNKNOWN:
            speed = fastest_of(work, degree, step, speed)
    return angle, speed


@compiled
def highest(work: Floats, degree: int, step: float, angle: float) -> float:
    """Return the largest y over the step, from node to node; `angle` where that is larger."""
    third = third_bound(work, degree, step)
    start, velocity, width = 0.0, work[ANGLE, 1], step
    while start < step:
        end, later, velocity, width = next_node(work, degree, step, third, start, velocity, width)
        angle = max(angle, later)
        start = end
    return angle


@compiled
def fastest_of(work: Floats, degree: int, step: float, speed: float) -> float:
    """Return the largest |y'| over the step; `speed` where that is larger.

    It is at an end or where y'' is zero, which is what halving closes in on.
    """
    third = third_bound(work, degree, step)
    start, width = 0.0, step
    while start < step:
        end = min(start + width, step)
        if step - end <= SHORTEST * step:
            end = step
        half = 0.5 * (end - start)
        velocity, bend = speed_at(work, degree, start + half)
        later, _ = speed_at(work, degree, end)
        most = abs(velocity) + half * (abs(bend) + third * half)
        if most > speed * (1.0 + MARGIN) and abs(bend) < third * half and width > SHORTEST * step:
            width *= 0.5
            speed = max(speed, abs(velocity))
            continue
        speed = max(speed, abs(later))
        start, width = end, 2.0 * width
    return speed


@compiled
def bending_point(work: Floats, degree: int, step: float, falling: bool, guess: float) -> float:
    """Return the one zero of y'' in the step, where it falls or rises."""
    low, high, time = 0.0, step, guess
    for _ in range(ITERATIONS):
        bend, third = bend_at(work, degree, time)
        if (bend > 0.0) == falling:
            low = time
        else:
            high = time
        near = time - bend / third if third != 0.0 else math.inf
        # y' hardly changes around it: half of its digits are enough.
        if abs(near - time) <= 1e-9 * step:
            break
        if not (low < near < high):
            near = 0.5 * (low + high)
        time = near
    return time
