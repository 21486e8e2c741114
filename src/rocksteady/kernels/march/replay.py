"""Replay of a march: state at any time, peaks, time of overturning."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rocksteady.kernels.core import tables as columns
from rocksteady.kernels.core.clock import elapsed_time, segment_start, side_phase
from rocksteady.kernels.core.forcing import Forcing, side_forcing
from rocksteady.kernels.core.tables import (
    Floats,
    March,
    is_nonlinear,
    is_series,
    is_stepped,
    left_out_of,
)
from rocksteady.kernels.core.typed import ONE, ZERO
from rocksteady.kernels.elementary.circular import sin, sincos_near
from rocksteady.kernels.linear.extrema import flight_peaks, last_rise
from rocksteady.kernels.linear.flight import Flight, flight_acceleration, flight_state, make_flight
from rocksteady.kernels.machine_code.compilation import allocating, compiled, inlined
from rocksteady.kernels.machine_code.types import Floats1, Floats2, Integers1
from rocksteady.kernels.nonlinear.drive import SteppedFlight, acceleration, side_drive, swing_at
from rocksteady.kernels.nonlinear.flight import is_stuck, phase_at
from rocksteady.kernels.nonlinear.proofs import point_of_no_return
from rocksteady.kernels.nonlinear.replay import (
    Leg,
    last_rise_of,
    leg_after,
    leg_from,
    peaks_of,
    stays_below,
)
from rocksteady.kernels.nonlinear.series import ANGLE, TERMS, WORK_ROWS, angle_at, load_shares


class Beginning(NamedTuple):
    """Where a flight begins, in the units of its side."""

    segment: int
    side: int
    since: float  # pivot time since the start of the segment
    phase: float  # as the side sees it; of a series as it is
    angle: float
    velocity: float
    lean: float  # of the side
    rate: float


@inlined
def beginning_of(segments: Floats, sides: Floats, state: March) -> Beginning:
    """Return where the flight of a march in some state begins."""
    segment, side, half, phase = state.segment, state.side, state.half_cycles, state.phase
    row = 0 if side > 0 else 1
    lean, rate = sides[row, columns.LEAN], sides[row, columns.RATE]
    frequency = segments[segment, columns.FREQUENCY]
    first_half, first_phase = segment_start(segments, segment)
    since = elapsed_time(half, phase, first_half, first_phase, frequency)
    seen, _ = side_phase(half, phase, ONE if is_series(segments, segment) else side, frequency)
    angle, velocity = side * state.angle / lean, side * state.velocity / (lean * rate)
    return Beginning(segment, side, since, seen, angle, velocity, lean, rate)


@compiled
def stepped_from(segments: Floats, sides: Floats, start: Beginning, span: float) -> SteppedFlight:
    """Return the flight in steps that begins somewhere, over a span of side time."""
    drive = side_drive(segments, start.segment, sides, start.side, start.since)
    left_out = left_out_of(sides)
    return SteppedFlight(drive, start.phase, start.angle, start.velocity, span, left_out)


@inlined
def row_start(segments: Floats, sides: Floats, rows: Floats, index: int) -> Beginning:
    """Return where the flight of a row begins."""
    side = 1 if rows[index, columns.ROW_SIDE] > 0.0 else -1
    angle, velocity = rows[index, columns.ROW_ANGLE], rows[index, columns.ROW_VELOCITY]
    half, phase = int(rows[index, columns.ROW_HALF_CYCLES]), rows[index, columns.ROW_PHASE]
    segment = int(rows[index, columns.ROW_SEGMENT])
    state = March(side, angle, velocity, segment, half, phase, 0, 0)
    return beginning_of(segments, sides, state)


@compiled
def row_flight(
    segments: Floats, sides: Floats, rows: Floats, index: int
) -> tuple[Flight, Forcing, float, float]:
    """Return a recorded flight in its side's units, its forcing, and the side's lean and rate."""
    start = row_start(segments, sides, rows, index)
    forcing = side_forcing(segments, start.segment, sides, start.side, start.since)
    sine, cosine = sincos_near(start.phase)
    flight = make_flight(forcing, start.angle, start.velocity, start.phase, sine, cosine)
    return flight, forcing, start.lean, start.rate


@compiled
def row_in_steps(
    segments: Floats, sides: Floats, rows: Floats, index: int, duration: float
) -> tuple[SteppedFlight, float, float]:
    """Return a recorded flight in steps, of a duration, and the side's lean and rate."""
    start = row_start(segments, sides, rows, index)
    flight = stepped_from(segments, sides, start, duration * start.rate)
    return flight, start.lean, start.rate


@allocating
def fill_in_steps(
    segments: Floats,
    sides: Floats,
    rows: Floats,
    index: NDArray[np.int64],
    since: Floats,
    states: Floats,
) -> None:
    """Fill what `fill_states` fills, of flights in steps, each of which is passed over once.

    Times have to be in order for that; others are reached too.  What lies beyond steps that come
    to nothing is no number.
    """
    orders = max((segments.shape[1] - columns.SHARES) // 2, 0)
    work = np.empty((WORK_ROWS + orders, TERMS))
    row, steps = -1, 0  # whose step the working space holds, and which
    flight, lean, rate = row_in_steps(segments, sides, rows, ZERO, 0.0)
    side = 0.0
    leg = Leg(0.0, 0.0, 0, 0.0, 0.0)
    for i in range(len(index)):
        if rows[index[i], columns.ROW_SIDE] == 0.0:
            states[0, i] = states[1, i] = states[2, i] = 0.0
            continue
        if index[i] != row or since[i] * rate < leg.start:
            row = index[i]
            side = rows[row, columns.ROW_SIDE]
            segment = int(rows[row, columns.ROW_SEGMENT])
            if not is_stepped(segments, segment, sides):
                fill_state(segments, sides, rows, index[i], since[i], states, i)
                row = -1
                continue
            if orders > 0:
                load_shares(segments[segment, columns.SHARES :], work)
            flight, lean, rate = row_in_steps(
                segments, sides, rows, row, rows[row, columns.ROW_DURATION]
            )
            leg, steps = leg_from(flight, 0.0, flight.angle, flight.velocity, work), 1
        time = since[i] * rate
        while time > leg.start + leg.step and leg.start + leg.step < flight.span:
            if is_stuck(flight.drive, steps, leg.start):
                work[ANGLE, 0] = work[ANGLE, 1] = math.nan
                break
            leg = leg_after(leg, flight, work)
            steps += 1
        angle, velocity = angle_at(work, leg.degree, time - leg.start)
        drive = flight.drive
        _, turned = phase_at(drive, flight.phase, time)
        states[0, i] = side * lean * angle
        states[1, i] = side * lean * rate * velocity
        swing = sin(turned)
        if drive.series != 0.0:
            swing = swing_at(
                drive, segments[int(rows[row, columns.ROW_SEGMENT]), columns.SHARES :], turned
            )
        states[2, i] = side * lean * rate * rate * acceleration(drive, time, angle, swing)


@compiled
def fill_states(
    segments: Floats2,
    sides: Floats2,
    rows: Floats2,
    index: Integers1,
    since: Floats1,
    states: Floats2,
) -> None:
    """Fill angle, velocity and acceleration, shape (3, times), in reference units.

    `index` names the row in which each time lies, `since` the time since that row's start.
    """
    if is_nonlinear(sides) or segments.shape[1] > columns.ORDERS:
        fill_in_steps(segments, sides, rows, index, since, states)
        return
    for i in range(len(index)):
        side = rows[index[i], columns.ROW_SIDE]
        if side == 0.0:
            states[0, i] = states[1, i] = states[2, i] = 0.0
            continue
        fill_state(segments, sides, rows, index[i], since[i], states, i)


@compiled
def fill_state(
    segments: Floats, sides: Floats, rows: Floats, row: int, since: float, states: Floats, i: int
) -> None:
    """Fill column i of the states by the closed form of the flight in a row."""
    side = rows[row, columns.ROW_SIDE]
    flight, forcing, lean, rate = row_flight(segments, sides, rows, row)
    time = since * rate
    phase = flight.phase + forcing.frequency * time
    sine, cosine = sincos_near(phase)
    angle, velocity = flight_state(flight, forcing, time, sine, cosine)
    acceleration = flight_acceleration(forcing, time, angle, sine)
    states[0, i] = side * lean * angle
    states[1, i] = side * lean * rate * velocity
    states[2, i] = side * lean * rate * rate * acceleration


@compiled
def last_crossing(
    segments: Floats2, sides: Floats2, rows: Floats2, level: float
) -> tuple[int, float]:
    """Return row and time since its start at which the last flight last rises through a level.

    The level is in units of the side's own slenderness.  A flight that starts above it and never
    crosses it has been above since its start.
    """
    return last_crossing_in(segments, sides, rows, level, segments[0])


@inlined
def last_crossing_in(
    segments: Floats, sides: Floats, rows: Floats, level: float, series: Floats | None
) -> tuple[int, float]:
    """Do what `last_crossing` does; `series` as for `shares_in`."""
    index = len(rows) - 1
    while True:
        segment = int(rows[index, columns.ROW_SEGMENT])
        if is_stepped(segments, segment, sides):
            duration = rows[index, columns.ROW_DURATION]
            stepped, _, rate = row_in_steps(segments, sides, rows, index, duration)
            side = 1 if rows[index, columns.ROW_SIDE] > 0.0 else -1
            lost = point_of_no_return(segments, segment, sides, side)
            shares = shares_in(segments, segment, series)
            time = last_rise_of(stepped, level, lost, shares)
        else:
            flight, forcing, _, rate = row_flight(segments, sides, rows, index)
            endless = rows[index, columns.ROW_EVENT] == columns.ENDED_BY_NO_RETURN
            time = last_rise(
                flight, forcing, level, rows[index, columns.ROW_DURATION] * rate, endless
            )
        if time >= 0.0:
            return index, time / rate
        before = rows[index - 1, columns.ROW_EVENT] if index > 0 else columns.ENDED_BY_IMPACT
        same_flight = (
            before == columns.ENDED_BY_SPAN
            and rows[index - 1, columns.ROW_SIDE] == rows[index, columns.ROW_SIDE]
        )
        if not same_flight:
            return index, 0.0
        index -= 1


@compiled
def recorded_peaks(
    segments: Floats2, sides: Floats2, rows: Floats2, last_duration: float
) -> tuple[float, float, float]:
    """Return the largest |theta|/alpha on either side, and the largest |velocity|.

    Each side counts in its own alpha; the velocity is in reference units.  `last_duration` replaces
    the duration of the last row, which is infinite where the block falls.
    """
    return recorded_peaks_in(segments, sides, rows, last_duration, segments[0])


@inlined
def recorded_peaks_in(
    segments: Floats, sides: Floats, rows: Floats, last_duration: float, series: Floats | None
) -> tuple[float, float, float]:
    """Do what `recorded_peaks` does; `series` as for `shares_in`."""
    positive = negative = speed = 0.0
    for index in range(len(rows)):
        if rows[index, columns.ROW_SIDE] == 0.0:
            continue
        above = rows[index, columns.ROW_SIDE] > 0.0
        angle = positive if above else negative
        duration = last_duration if index == len(rows) - 1 else rows[index, columns.ROW_DURATION]
        segment = int(rows[index, columns.ROW_SEGMENT])
        if is_stepped(segments, segment, sides):
            stepped, lean, rate = row_in_steps(segments, sides, rows, index, duration)
            fast = speed / (lean * rate)
            if not stays_below(stepped, angle, fast):
                shares = shares_in(segments, segment, series)
                angle, fast = peaks_of(stepped, angle, fast, shares)
        else:
            flight, forcing, lean, rate = row_flight(segments, sides, rows, index)
            span = duration * rate
            turned = flight.phase + forcing.frequency * span
            sine, cosine = sincos_near(turned)
            y, v = flight_state(flight, forcing, span, sine, cosine)
            angle, fast = flight_peaks(flight, forcing, span, y, v, angle, speed / (lean * rate))
        speed = max(speed, fast * lean * rate)
        if above:
            positive = angle
        else:
            negative = angle
    return positive, negative, speed


@compiled
def peaks_until_overturning(
    segments: Floats2, sides: Floats2, rows: Floats2
) -> tuple[float, float, float]:
    """Return what `recorded_peaks` does, until a block that falls passes its alpha for good.

    When the fall is proved depends on the proof; when it passes alpha, on the motion alone.
    """
    return peaks_until_overturning_in(segments, sides, rows, segments[0])


@inlined
def peaks_until_overturning_in(
    segments: Floats, sides: Floats, rows: Floats, series: Floats | None
) -> tuple[float, float, float]:
    """Do what `peaks_until_overturning` does; `series` as for `shares_in`."""
    row, since = last_crossing_in(segments, sides, rows, 1.0, series)
    positive, negative, speed = recorded_peaks_in(segments, sides, rows[: row + 1], since, series)
    if rows[row, columns.ROW_SIDE] > 0.0:  # it passes 1, to rounding
        return max(positive, 1.0), negative, speed
    return positive, max(negative, 1.0), speed


@inlined
def shares_in(segments: Floats, index: int, series: Floats | None) -> Floats | None:
    """Return the shares of a segment's Fourier series; None where `series` is None.

    `series` tells the compiler, by its type, whether any segment of a motion may have one: without,
    no working space has a size that is known only as it runs.
    """
    if series is None:
        return None
    return segments[index, columns.SHARES :]


@compiled
def peaks_without_series(
    segments: Floats2, sides: Floats2, rows: Floats2
) -> tuple[float, float, float]:
    """Do what `peaks_until_overturning` does, where no segment has a Fourier series."""
    return peaks_until_overturning_in(segments, sides, rows, None)
