"""Columns of the flat tables that a march reads and writes, and its state between flights.

A motion is a table of segments, the block two rows of side parameters, a recorded march a table of
flights, all float64 with the columns below.

The tables say which equation of motion holds.  The nonlinear one needs each side's slenderness and
the vertical motion of the base, in further columns of both tables; a side table without these
columns, or with a slenderness of 0 in them, is that of the linear one, which is the limit.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rocksteady.kernels.core.typed import whole
from rocksteady.kernels.machine_code.compilation import inlined
from rocksteady.kernels.machine_code.types import Floats2
from rocksteady.outcomes import Status

Floats = NDArray[np.float64]

# Columns of a table of segments: c0 + c1 s + A sin(Omega s + phi) for `DURATION` of pivot time.
DURATION = 0
JUMP = 1  # of a reference block's velocity at the segment's start, by an impulse of the base
CONSTANT = 2
SLOPE = 3
AMPLITUDE = 4
FREQUENCY = 5
PHASE = 6
CEILING = 7  # max |a| from this segment's start on; infinite while a later one has a jump
ALIKE = 8  # samples like this one that follow at once: as long, without sinusoid and without jump
SEGMENT_COLUMNS = 9
# Nonlinear model only: the vertical acceleration of the base, upwards, over g.
LIFT = 9  # at the segment's start
LIFT_SLOPE = 10
LIFT_CEILING = 11  # max of its absolute value from this segment's start on
NONLINEAR_SEGMENT_COLUMNS = 12
# Of either model, in a table with periodic shaking that is no single sinusoid: A and Omega are
# those of a Fourier series, and CONSTANT and SLOPE are 0.
ORDERS = 12  # highest order of the series; 0 of any other segment
SHARES = 13  # and from here on its shares (`kernels.core.harmonics`), two of each order

COUNTED = 1e-6
"""Least |du/d(pt)| with which a block leaves an impact that counts, in the alpha and p of the side
that it leaves to: chatter has no end of slower ones.  Chatter above it comes to rest only where
its impacts are known, as on a still base; maps of fates, which count none, rest at any velocity."""
SMALLEST_BOUNCE = 1e-8
"""Chatter slower than this (du/ds) may come to rest in a run whose flights are kept: its bounces
are below 1e-16 of alpha."""
SURELY_ABOVE = 1.0 + 1e-12
"""Least angle that is above the slenderness, rounding included."""
SAFELY = 1.0 - 1e-9
"""Part of its uplift value up to which no sample lifts a block, rounding included."""

# Columns of the side table; row 0 is the positive side, row 1 the negative one.
RESTITUTION = 0  # velocity after over that before the impact that ends a flight on this side
# Of a block that rocks on one side alone, against a wall behind it, this is minus the wall's
# restitution, which may be 0, in the row of the side that it stays on.  No flight reads the other.
LEAN = 1  # this side's alpha over the reference alpha
RATE = 2  # this side's p over the reference p
SIDE_COLUMNS = 3
# Nonlinear model only.
ALPHA = 3  # this side's alpha [rad]
LEFT_OUT = 4  # what a step may leave out of the motion in it, as a part of that motion
NONLINEAR_SIDE_COLUMNS = 5
LINEAR_LEFT_OUT = 1e-15  # the same, where the linear model takes steps
# Of either model, where restitution scatters from impact to impact (`kernels.core.scatter`).
SCATTER = 5  # standard deviation of the restitution before it is cut off; RESTITUTION is the mean
KEY = 6  # of the draws, a whole number from 0 to 2^53 - 1, the same on both sides
SCATTERED_SIDE_COLUMNS = 7

# Columns of a recorded flight, in reference units.
ROW_SEGMENT = 0
ROW_HALF_CYCLES = 1
ROW_PHASE = 2
ROW_SIDE = 3  # +1, -1, or 0 at rest
ROW_ANGLE = 4
ROW_VELOCITY = 5
ROW_DURATION = 6
ROW_EVENT = 7
ROW_COLUMNS = 8

# What a search for the end of a flight has found.
SPAN_END = 0  # no zero up to the end of the span
FOUND = 1  # the first zero
NO_RETURN = 2  # the proof that none follows
STALLED = 4  # neither, after more steps than any flight takes; no row is written of it

# What ended a recorded flight or rest.
ENDED_BY_SPAN = whole(SPAN_END)  # the segment or the run ended
ENDED_BY_IMPACT = FOUND
ENDED_BY_NO_RETURN = NO_RETURN
ENDED_BY_UPLIFT = 3

# What a march keeps of all its flights.
PEAK_ANGLE = 0  # largest |theta|/alpha, each side in its own alpha
PEAK_SPEED = 1  # largest |velocity|, in reference units
PEAK_COLUMNS = 2
# And, where there is room for it, the flight or sample that last rose above the slenderness:
BEFORE_ANGLE = 2  # the peaks before it
BEFORE_SPEED = 3
PASSING_SIDE = 4  # the state at its start
PASSING_ANGLE = 5
PASSING_VELOCITY = 6
PASSING_SEGMENT = 7
PASSING_HALF_CYCLES = 8
PASSING_PHASE = 9
PASSING_AGAIN = 10  # 1 where the block may have come back to its slenderness since
PASSAGE_COLUMNS = 11

ROCKING = int(Status.ROCKING)
AT_REST = int(Status.AT_REST)
OVERTURNED = int(Status.OVERTURNED)
UNDECIDED = int(Status.UNDECIDED)
LOST_CONTACT = int(Status.LOST_CONTACT)


class March(NamedTuple):
    """State of a march between two flights."""

    side: int  # +1, -1, or 0 at rest
    angle: float  # theta / alpha
    velocity: float  # d(theta / alpha) / ds
    segment: int
    half_cycles: int
    phase: float  # within the half cycle, or time within a segment without sinusoid
    impacts: int
    flights: int  # flights and rests: the rows that a record of the march has


@inlined
def end_of_run(segments: Floats, index: int) -> int:
    """Return the segment that follows the samples alike; the table's last one is none of them."""
    last = index + int(segments[index, ALIKE])
    if last + 1 == len(segments) or segments[last + 1, JUMP] != 0.0:
        return last
    return last + 1


class Rise(NamedTuple):
    """A flight that may rise above its slenderness, in the units of its side."""

    angle: float  # at its start
    velocity: float
    later_angle: float  # at its end
    span: float
    ceiling: float  # the largest |a| of the base while it lasts


@inlined
def keep_passage(
    peaks: Floats, state: March, top_angle: float, top_speed: float, rise: Rise
) -> None:
    """Keep a flight that rises above its slenderness, and the peaks before it.

    Above the slenderness y'' >= -|a| in either model, so that a flight which begins there stays
    above ``y + y' t - |a| t^2/2``.  That is lowest at an end: where it is above the slenderness at
    the end of the flight too, the passage that was kept is still the last.
    """
    angle, velocity, later_angle, span, ceiling = rise
    if later_angle <= 1.0:
        return
    if angle <= 1.0:
        peaks[BEFORE_ANGLE], peaks[BEFORE_SPEED] = top_angle, top_speed
        peaks[PASSING_SIDE] = state.side
        peaks[PASSING_ANGLE], peaks[PASSING_VELOCITY] = state.angle, state.velocity
        peaks[PASSING_SEGMENT] = state.segment
        peaks[PASSING_HALF_CYCLES], peaks[PASSING_PHASE] = state.half_cycles, state.phase
        peaks[PASSING_AGAIN] = 0.0
    elif velocity < 0.0 or ceiling > 0.0:
        lowest = angle + span * (velocity - 0.5 * ceiling * span)
        if not lowest > SURELY_ABOVE:  # so too where it is no number, of an endless flight
            peaks[PASSING_AGAIN] = 1.0


@inlined
def speed_in_unit(peaks: Floats, top_speed: float, before: float, unit: float) -> float:
    """Return the largest speed so far in the unit of a side, from that of the side before.

    Peaks that are watched hold it in reference units.
    """
    if len(peaks) == 0 or unit == before:
        return top_speed
    peaks[PEAK_SPEED] = max(peaks[PEAK_SPEED], top_speed * before)
    return float(peaks[PEAK_SPEED] / unit)


@inlined
def kept_passage(peaks: Floats) -> March:
    """Return the state at the start of the flight that was kept.

    That flight ends without an impact, so that the number of the impacts before it does not count.
    """
    return March(
        int(peaks[PASSING_SIDE]),
        peaks[PASSING_ANGLE],
        peaks[PASSING_VELOCITY],
        int(peaks[PASSING_SEGMENT]),
        int(peaks[PASSING_HALF_CYCLES]),
        peaks[PASSING_PHASE],
        0,
        0,
    )


@inlined
def free_side(sides: Floats2) -> int:
    """Return the one side on which a block against a wall rocks, or 0 of a block that has two.

    A restitution of 0 marks it as well, and -0.0 is 0.
    """
    if sides[0, RESTITUTION] <= 0.0:
        return 1
    return -1 if sides[1, RESTITUTION] <= 0.0 else 0


@inlined
def is_nonlinear(sides: Floats2) -> bool:
    """Return whether a side table asks for the nonlinear equation of motion."""
    return bool(sides.shape[1] > SIDE_COLUMNS and sides[0, ALPHA] > 0.0)


@inlined
def is_series(segments: Floats, index: int) -> bool:
    """Return whether a segment is periodic shaking that is no single sinusoid."""
    return bool(segments.shape[1] > ORDERS and segments[index, ORDERS] > 0.0)


@inlined
def is_stepped(segments: Floats, index: int, sides: Floats2) -> bool:
    """Return whether flights on a segment are Taylor steps: those of a series, or nonlinear."""
    return is_nonlinear(sides) or is_series(segments, index)


@inlined
def slenderness(sides: Floats2, row: int) -> float:
    """Return alpha of a side; 0 in the linear model."""
    return float(sides[row, ALPHA]) if sides.shape[1] > SIDE_COLUMNS else 0.0


@inlined
def left_out_of(sides: Floats2) -> float:
    """Return what a step may leave out of the motion in it."""
    return float(sides[0, LEFT_OUT]) if is_nonlinear(sides) else LINEAR_LEFT_OUT


@inlined
def write_row(rows: Floats, state: March, duration: float, event: int) -> None:
    """Record one flight or rest, by the state at its start."""
    index = state.flights
    rows[index, ROW_SEGMENT] = state.segment
    rows[index, ROW_HALF_CYCLES] = state.half_cycles
    rows[index, ROW_PHASE] = state.phase
    rows[index, ROW_SIDE] = state.side
    rows[index, ROW_ANGLE] = state.angle
    rows[index, ROW_VELOCITY] = state.velocity
    rows[index, ROW_DURATION] = duration
    rows[index, ROW_EVENT] = event
