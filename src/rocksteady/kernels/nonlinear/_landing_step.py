"""First landing of a nonlinear flight within a sample of a record, by the step's polynomial.

Over the step y'' stays between its ends but for ``h^2/8`` of the fourth derivative's bound.  Where
that leaves it so high that y stays above a parabola that does not come down, there is no zero.
Where it leaves it negative, y is concave: from above the base, or off it, it has one zero at most,
and one where it ends at 0 or below.  Where a block comes down so fast that y' stays negative it is
the same.  All else is left open: `DOUBT`.
"""

from rocksteady.kernels.core.typed import ONE, TRUE, ZERO
from rocksteady.kernels.linear.short import DOUBT, ITERATIONS, LANDS, NO_LANDING, Landing
from rocksteady.kernels.linear.zeros import Search, looked_at, place_in
from rocksteady.kernels.machine_code.compilation import compiled, inlined
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
    event = landing_event(course, angle, velocity, span, fourths, later)
    if event != LANDS:
        return Landing(event, span, later, later_velocity)
    search = begin_search(course, angle, velocity, span)
    for iteration in range(ITERATIONS):
        time = place_in(search, iteration)
        if time <= search.low or time >= search.high:
            break  # no number lies between them
        search = look(search, course, angle, velocity, time)
        if search.found:
            break
    # The derivatives are near enough for the time, not for the speed.
    time = search.time if search.found else search.high
    _, velocity = state_after(course, angle, velocity, time)
    return Landing(LANDS, time, 0.0, min(velocity, 0.0))


@inlined
def landing_event(
    course: Course, angle: float, velocity: float, span: float, fourths: float, later: float
) -> int:
    """Return whether a flight lands within a step: LANDS, NO_LANDING or DOUBT.

    The parameters are those of `first_landing`.
    """
    bend, width = 2.0 * course.second, 0.125 * fourths * (span * span)
    # From rest y is at least t^3 times its coefficient less a bound of the terms beyond.
    rises = velocity == 0.0 and bend >= 0.0 and 4.0 * course.third > span * fourths
    there, _, _, _ = bends_after(course, span)
    most, least = max(bend, there) + width, min(bend, there) - width
    falls = angle > 0.0 and velocity + max(most, 0.0) * span < 0.0
    event = DOUBT
    if most < 0.0 or falls:
        event = NO_LANDING if later > 0.0 else LANDS
    if stays_above(angle, velocity, least, span):
        event = NO_LANDING
    if angle == 0.0 and velocity <= 0.0:
        event = NO_LANDING if rises else DOUBT
    return event


@inlined
def begin_search(course: Course, angle: float, velocity: float, span: float) -> Search:
    """Return a search for a landing that begins where the parabola of the start comes down."""
    time = root_of_parabola(angle, velocity, 2.0 * course.second, TRUE)
    return Search(0.0, span, time, False, velocity)


@inlined
def look(search: Search, course: Course, angle: float, velocity: float, time: float) -> Search:
    """Return a search for a landing after a look at a time within its bracket."""
    y, v = state_after(course, angle, velocity, time)
    d2, d3, d4, d5 = bends_after(course, time)
    return looked_at(search, time, y, v, d2, d3, d4, d5)


@inlined
def landing_at_once(
    course: Course, angle: float, velocity: float, span: float
) -> tuple[float, float, bool]:
    """Return time and speed of a landing that is there, and whether two looks find it.

    If so they are those of `first_landing`, here without loops and branches.
    """
    search = begin_search(course, angle, velocity, span)
    time = place_in(search, ZERO)
    inside = search.low < time < search.high
    search = look(search, course, angle, velocity, time)
    time = place_in(search, ONE)
    inside = inside and (search.found or search.low < time < search.high)
    again = look(search, course, angle, velocity, time)
    time = search.time if search.found else again.time
    _, velocity = state_after(course, angle, velocity, time)
    return time, min(velocity, 0.0), inside and (search.found or again.found)
