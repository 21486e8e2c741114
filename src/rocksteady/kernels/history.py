"""What a recorded march tells: its state at any time, its peak, the time of overturning."""

import math

import numpy as np
from numpy.typing import NDArray

from rocksteady.kernels.compilation import compiled
from rocksteady.kernels.extrema import highest_angle, last_rise
from rocksteady.kernels.flight import Flight, flight_acceleration, flight_state, make_flight
from rocksteady.kernels.forcing import Forcing
from rocksteady.kernels.march import (
    ENDED_BY_IMPACT,
    ENDED_BY_NO_RETURN,
    ENDED_BY_SPAN,
    FREQUENCY,
    LEAN,
    RATE,
    ROW_ANGLE,
    ROW_DURATION,
    ROW_EVENT,
    ROW_HALF_CYCLES,
    ROW_PHASE,
    ROW_SEGMENT,
    ROW_SIDE,
    ROW_VELOCITY,
    Floats,
    elapsed_time,
    segment_start,
    side_forcing,
    side_phase,
)


@compiled
def row_flight(
    segments: Floats, sides: Floats, rows: Floats, index: int
) -> tuple[Flight, Forcing, float, float]:
    """Return a recorded flight in its side's units, its forcing, and the side's lean and rate."""
    segment = int(rows[index, ROW_SEGMENT])
    half, phase = int(rows[index, ROW_HALF_CYCLES]), rows[index, ROW_PHASE]
    side = 1 if rows[index, ROW_SIDE] > 0.0 else -1
    row = 0 if side > 0 else 1
    lean, rate = sides[row, LEAN], sides[row, RATE]
    frequency = segments[segment, FREQUENCY]
    first_half, first_phase = segment_start(segments, segment)
    since = elapsed_time(half, phase, first_half, first_phase, frequency)
    forcing = side_forcing(segments, segment, sides, side, since)
    seen, _ = side_phase(half, phase, side, frequency)
    flight = make_flight(
        forcing,
        side * rows[index, ROW_ANGLE] / lean,
        side * rows[index, ROW_VELOCITY] / (lean * rate),
        seen,
        math.sin(seen),
        math.cos(seen),
    )
    return flight, forcing, lean, rate


@compiled
def fill_states(
    segments: Floats,
    sides: Floats,
    rows: Floats,
    index: NDArray[np.int64],
    since: Floats,
    states: Floats,
) -> None:
    """Fill angle, velocity and acceleration, shape (3, times), in reference units.

    `index` names the row in which each time lies, `since` the time since that row's start.
    """
    for i in range(len(index)):
        side = rows[index[i], ROW_SIDE]
        if side == 0.0:
            states[0, i] = states[1, i] = states[2, i] = 0.0
            continue
        flight, forcing, lean, rate = row_flight(segments, sides, rows, index[i])
        time = since[i] * rate
        phase = flight.phase + forcing.frequency * time
        sine, cosine = math.sin(phase), math.cos(phase)
        angle, velocity = flight_state(flight, forcing, time, sine, cosine)
        acceleration = flight_acceleration(forcing, time, angle, sine)
        states[0, i] = side * lean * angle
        states[1, i] = side * lean * rate * velocity
        states[2, i] = side * lean * rate * rate * acceleration


@compiled
def last_crossing(segments: Floats, sides: Floats, rows: Floats, level: float) -> tuple[int, float]:
    """Return row and time since its start at which the last flight last rises through a level.

    The level is in units of the side's own slenderness.  A flight that starts above it and never
    crosses it has been above since its start.
    """
    index = len(rows) - 1
    while True:
        flight, forcing, _, rate = row_flight(segments, sides, rows, index)
        endless = rows[index, ROW_EVENT] == ENDED_BY_NO_RETURN
        time = last_rise(flight, forcing, level, rows[index, ROW_DURATION] * rate, endless)
        if time >= 0.0:
            return index, time / rate
        before = rows[index - 1, ROW_EVENT] if index > 0 else ENDED_BY_IMPACT
        same_flight = before == ENDED_BY_SPAN and rows[index - 1, ROW_SIDE] == rows[index, ROW_SIDE]
        if not same_flight:
            return index, 0.0
        index -= 1


@compiled
def side_peaks(
    segments: Floats, sides: Floats, rows: Floats, last_duration: float
) -> tuple[float, float]:
    """Return the largest |theta|/alpha on the positive and on the negative side, each in its alpha.

    `last_duration` replaces the duration of the last row, which is infinite where the block falls.
    """
    positive = negative = 0.0
    for index in range(len(rows)):
        if rows[index, ROW_SIDE] == 0.0:
            continue
        flight, forcing, _, rate = row_flight(segments, sides, rows, index)
        duration = last_duration if index == len(rows) - 1 else rows[index, ROW_DURATION]
        angle, _ = highest_angle(flight, forcing, duration * rate)
        if rows[index, ROW_SIDE] > 0.0:
            positive = max(positive, angle)
        else:
            negative = max(negative, angle)
    return positive, negative
