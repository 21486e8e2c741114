"""First landing of a linear flight under a line of forcing, within a sample of a record.

With ``r(t) = r0 + m t`` the closed form from state (y, v) is::

    y(t) = y + v t + (y + r0) (cosh t - 1) + (v + m) (sinh t - t)

Both functions are polynomials here, since t is 1/4 at most.  The argument that no zero is missed is
that of `rocksteady.kernels.linear.zeros`, of one or two pieces: r changes its sign once at most.
What it leaves open there, a dip that may graze, is left open here too: `DOUBT`.
"""

import math
from typing import NamedTuple

from rocksteady.kernels.core.tables import FOUND, SPAN_END
from rocksteady.kernels.core.typed import FALSE, TRUE, whole
from rocksteady.kernels.linear.zeros import Search, looked_at, place_in
from rocksteady.kernels.machine_code.compilation import compiled, inlined

LONGEST = 0.25
"""Longest flight: beyond it the polynomials would need more terms."""
LIFTING = 1e-9
"""Part of a line's rise over the flight by which it may start below 0 where the block lifts off."""
SURELY = 1e-6
"""Margin for rounding of a bounce's longest duration."""
CLOSE = 1e-9
"""Part of a flight up to which the time of an extremum is known."""
ITERATIONS = 400  # every fourth halves the bracket

NO_LANDING = whole(SPAN_END)
LANDS = whole(FOUND)
DOUBT = whole(-1)


class Landing(NamedTuple):
    """How a flight within a sample ends: on the base, at its end, or in doubt."""

    event: int
    time: float
    angle: float
    velocity: float


class Line(NamedTuple):
    """A flight under a line of forcing, by the derivatives at its start."""

    angle: float
    velocity: float
    bend: float  # y''
    third: float  # y''', but for the jump of the slope, which y'' has not


@inlined
def state_of(line: Line, time: float) -> tuple[float, float]:
    """Return y and y' at a time of the flight."""
    angle, velocity, bend, third = line
    # In pairs: nothing waits for a long chain of products.
    square = time * time
    fourth = square * square
    high = (1.0 / 720.0 + square * (1.0 / 40320.0)) + fourth * (
        1.0 / 3628800.0 + square * (1.0 / 479001600.0)
    )
    rise = square * ((0.5 + square * (1.0 / 24.0)) + fourth * high)
    high = (1.0 / 5040.0 + square * (1.0 / 362880.0)) + fourth * (1.0 / 39916800.0)
    excess = (time * square) * ((1.0 / 6.0 + square * (1.0 / 120.0)) + fourth * high)  # sinh t - t
    return (
        angle + (velocity * time + (bend * rise + third * excess)),
        velocity + (bend * (time + excess) + third * rise),
    )


@compiled
def first_landing(
    angle: float, velocity: float, start: float, slope: float, span: float
) -> Landing:
    """Return the first landing of a flight, or its state at the end of the span.

    Parameters
    ----------
    angle, velocity
        At the start: above 0, or 0 with a velocity of 0 or more.  With both 0 it lifts off.
    start, slope
        Of the forcing ``start + slope t``.
    span
        Of the flight, up to `LONGEST`.
    """
    end = start + slope * span
    line = Line(angle, velocity, angle + start, velocity + slope)
    least = -max(start, end)  # while 0 <= y, y'' <= y - least
    squares = (least - velocity) * (least + velocity)
    if (
        angle == 0.0
        and 0.0 < velocity < least
        and (4.0 + SURELY) * (velocity * velocity) < span * span * squares
    ):  # the bounce is over within 2 v/sqrt(least^2 - v^2)
        return polished(line, start, slope, 0.0, span, 0.0, 0.0)
    later, later_velocity = state_of(line, span)
    event, low, high = LANDS if later <= 0.0 else NO_LANDING, 0.0, span
    if angle == 0.0 and velocity <= 0.0:
        lifts = velocity == 0.0 and end > 0.0 and start >= -LIFTING * (slope * span)
        if not lifts or event == LANDS:
            event = DOUBT
    elif start > 0.0 and end > 0.0:
        event = pushed_up(angle, velocity, later, later_velocity)
    elif start > 0.0 or end > 0.0:
        node = min(-start / slope, span)
        there, there_velocity = state_of(line, node)
        if start > 0.0:  # up, then down
            first = pushed_up(angle, velocity, there, there_velocity)
            low = node
            if first != NO_LANDING:
                event, low, high = first, 0.0, node
        elif there <= 0.0:
            event, high = LANDS, node
        else:
            event, low = pushed_up(there, there_velocity, later, later_velocity), node
    if event == LANDS:
        return polished(line, start, slope, low, high, later, later_velocity)
    return Landing(event, span, later, later_velocity)


@inlined
def pushed_up(angle: float, velocity: float, later: float, later_velocity: float) -> int:
    """Return whether a block lands on a piece on which r is positive."""
    if angle + velocity >= 0.0:
        return NO_LANDING
    if later <= 0.0:
        return LANDS
    return DOUBT if later_velocity > 0.0 else NO_LANDING


@inlined
def polished(
    line: Line,
    start: float,
    slope: float,
    low: float,
    high: float,
    later: float,
    later_velocity: float,
) -> Landing:
    """Polish the one landing between two times, from the parabola that the flight nearly is.

    The state at the end of the flight is `later` and `later_velocity`.
    """
    angle, velocity, bend, third = line
    time = high - later / later_velocity if later_velocity < 0.0 else low
    if bend < 0.0:
        time = bounce_time(angle, velocity, bend, third)
    search = Search(low, high, time, False, velocity)
    for iteration in range(ITERATIONS):
        time = place_in(search, iteration)
        if time <= search.low or time >= search.high:
            break  # no number lies between them
        y, v = state_of(line, time)
        d2, d3 = y + (start + slope * time), v + slope
        search = looked_at(search, time, y, v, d2, d3, d2, d3)
        if search.found:
            return Landing(LANDS, search.time, 0.0, search.speed)
    _, velocity = state_of(line, search.high)
    return Landing(LANDS, search.high, 0.0, min(velocity, 0.0))


@inlined
def bounce_time(angle: float, velocity: float, bend: float, third: float) -> float:
    """Return about when a flight with y'' < 0 lands: where its parabola does, and a step beyond."""
    if angle == 0.0:
        inverse = -1.0 / bend
        time = (velocity + velocity) * inverse
        turned = third * time * inverse
        return time + time * ((1.0 / 3.0) * (turned * (1.0 + turned)))
    speed = math.sqrt(velocity * velocity - 2.0 * bend * angle)
    time = (velocity + speed) / -bend
    # There the parabola falls with that speed; the next term of the motion moves the root.
    moved = third * (time * time)
    return time + time * moved / (6.0 * speed - 3.0 * moved)


@compiled
def inner_peaks(
    angle: float,
    velocity: float,
    start: float,
    slope: float,
    span: float,
    later_velocity: float,
    bend: float,
    tops: tuple[float, float],
) -> tuple[float, float]:
    """Return the largest angle and speed of a flight, or of `tops` where these are larger.

    The parameters are those of `first_landing`, with y' and y'' at the end of the flight.  Peaks
    at its ends count already.  As ``a'' = a`` for a = y'', that is zero once at most, and y' twice.
    """
    top_angle, top_speed = tops
    line = Line(angle, velocity, angle + start, velocity + slope)
    turn, at_turn = span, later_velocity
    if (line.bend > 0.0) != (bend > 0.0):
        turn = turning_time(line, start, slope, TRUE, 0.0, span, line.bend, bend)
        _, at_turn = state_of(line, turn)
        top_speed = max(top_speed, abs(at_turn))
    if velocity > 0.0 and at_turn < 0.0:
        peak = turning_time(line, start, slope, FALSE, 0.0, turn, velocity, at_turn)
        top_angle = max(top_angle, state_of(line, peak)[0])
    if at_turn > 0.0 and later_velocity < 0.0:
        peak = turning_time(line, start, slope, FALSE, turn, span, at_turn, later_velocity)
        top_angle = max(top_angle, state_of(line, peak)[0])
    return top_angle, top_speed


@compiled
def turning_time(
    line: Line,
    start: float,
    slope: float,
    bends: bool,
    low: float,
    high: float,
    first: float,
    last: float,
) -> float:
    """Return the one zero of y', or where it `bends` of y'', between two times.

    Its values there, `first` and `last`, have unlike signs.
    """
    time = low + (high - low) * (first / (first - last))
    for _ in range(ITERATIONS):
        angle, velocity = state_of(line, time)
        value, change = velocity, angle + start + slope * time
        if bends:
            value, change = change, velocity + slope
        if (value > 0.0) == (first > 0.0):
            low = time
        else:
            high = time
        near = time - value / change if change != 0.0 else math.inf
        # y and y' hardly change around it: half of the digits are enough.
        if abs(near - time) <= CLOSE * high:
            break
        if not (low < near < high):
            near = 0.5 * (low + high)
        time = near
    return time
