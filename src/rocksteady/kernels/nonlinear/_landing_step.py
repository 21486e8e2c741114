"""First landing of a nonlinear flight within a sample of a record, by the step's polynomial.

Over the step y'' stays between its ends but for ``h^2/8`` of the fourth derivative's bound.  Where
that leaves it so high that y stays above a parabola that does not come down, there is no zero.
Where it leaves it negative, y is concave: from above the base, or off it, it has one zero at most,
and one where it ends at 0 or below.  Where a block comes down so fast that y' stays negative it is
the same.  All else is left open: `DOUBT`.
"""

from rocksteady.kernels.core.typed import TRUE
from rocksteady.kernels.linear.short import DOUBT, ITERATIONS, LANDS, NO_LANDING, Landing
from rocksteady.kernels.linear.zeros import Search, looked_at, place_in
from rocksteady.kernels.machine_code.compilation import compiled
from rocksteady.kernels.nonlinear._expansion import Course, bends_after, state_after
from rocksteady.kernels.nonlinear._zeros import stays_above
from rocksteady.kernels.nonlinear.series import root_of_parabola


@compiled
def first_landing(
    course: Course,
    angle: float,
    velocity: float,
    span: float,
    fourths: float,
    later: float,
    later_velocity: float,
) -> Landing:
    """Return the first landing of a flight within a step, or its state at the end of it.

    Parameters
    ----------
    course, span
        The step's polynomial and its length.
    angle, velocity
        At its start: above 0, or 0 with a velocity of 0 or more.  With both 0 it lifts off.
    fourths
        A bound of the fourth derivative.
    later, later_velocity
        At its end.
    """
    bend, width = 2.0 * course.second, 0.125 * fourths * (span * span)
    if angle == 0.0 and velocity <= 0.0:
        # y is at least t^3 times its coefficient less a bound of the terms beyond.
        rises = velocity == 0.0 and bend >= 0.0 and 4.0 * course.third > span * fourths
        return Landing(NO_LANDING if rises else DOUBT, span, later, later_velocity)
    there, _, _, _ = bends_after(course, span)
    most, least = max(bend, there) + width, min(bend, there) - width
    if stays_above(angle, velocity, least, span):
        return Landing(NO_LANDING, span, later, later_velocity)
    falls = angle > 0.0 and velocity + max(most, 0.0) * span < 0.0
    if not (most < 0.0 or falls):
        return Landing(DOUBT, span, later, later_velocity)
    if later > 0.0:
        return Landing(NO_LANDING, span, later, later_velocity)
    time = root_of_parabola(angle, velocity, bend, TRUE)
    search = Search(0.0, span, time, False, velocity)
    for iteration in range(ITERATIONS):
        time = place_in(search, iteration)
        if time <= search.low or time >= search.high:
            break  # no number lies between them
        y, v = state_after(course, angle, velocity, time)
        d2, d3, d4, d5 = bends_after(course, time)
        search = looked_at(search, time, y, v, d2, d3, d4, d5)
        if search.found:
            break
    # The derivatives are near enough for the time, not for the speed.
    time = search.time if search.found else search.high
    _, velocity = state_after(course, angle, velocity, time)
    return Landing(LANDS, time, 0.0, min(velocity, 0.0))
