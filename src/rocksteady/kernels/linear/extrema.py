"""Peaks and level crossings of a linear flight, found without sampling.

The velocity obeys ``w'' = w + dr/dt`` and ``y - level`` obeys ``z'' = z + (r + level)``: both are
flights, so that `rocksteady.kernels.linear.zeros` isolates their zeros too.
"""

import math

from rocksteady.kernels.core.forcing import Forcing, make_forcing
from rocksteady.kernels.core.tables import FOUND, PEAK_ANGLE, PEAK_SPEED, Floats
from rocksteady.kernels.core.typed import FALSE
from rocksteady.kernels.elementary.circular import sincos_near
from rocksteady.kernels.elementary.exponential import exp
from rocksteady.kernels.linear.flight import (
    LONG,
    Flight,
    Parts,
    flight_state,
    make_flight,
    shifted_flight,
    velocity_flight,
    wrapped,
)
from rocksteady.kernels.linear.zeros import Zero, next_zero
from rocksteady.kernels.machine_code.compilation import compiled


@compiled
def inner_extrema(flight: Flight, forcing: Forcing, span: float) -> tuple[float, float, float, int]:
    """Return the largest extremum inside (0, span), the least minimum, its time, and their number.

    Where there is none they are -inf, inf and nan.  A touch of the velocity at zero (an inflection)
    does not count as an extremum.
    """
    largest, lowest, lowest_time = -math.inf, math.inf, math.nan
    speed, rate = velocity_flight(flight, forcing)
    passed, extrema = 0.0, 0
    while passed < span:
        zero = next_zero(speed, rate, span - passed, FALSE, FALSE, -1.0)
        passed += zero.time
        if zero.event != FOUND or passed >= span:
            break
        if zero.velocity != 0.0:
            phase = flight.phase + forcing.frequency * passed
            sine, cosine = sincos_near(phase)
            angle, _ = flight_state(flight, forcing, passed, sine, cosine)
            largest = max(largest, angle)
            if zero.velocity > 0.0 and angle < lowest:
                lowest, lowest_time = angle, passed
            extrema += 1
        speed, rate = restarted(speed, rate, zero)
    return largest, lowest, lowest_time, extrema


@compiled
def highest_angle(flight: Flight, forcing: Forcing, span: float) -> tuple[float, int]:
    """Return the largest angle over [0, span], ends included, and the number of extrema inside."""
    phase = flight.phase + forcing.frequency * span
    sine, cosine = sincos_near(phase)
    angle, _ = flight_state(flight, forcing, span, sine, cosine)
    largest, _, _, extrema = inner_extrema(flight, forcing, span)
    return max(flight.angle, angle, largest), extrema


@compiled
def flight_peaks(
    flight: Flight,
    forcing: Forcing,
    span: float,
    end_angle: float,
    end_velocity: float,
    angle: float,
    speed: float,
) -> tuple[float, float]:
    """Return the largest angle and speed of a flight above the floor over [0, span], exactly.

    `angle` and `speed` are those of earlier flights: the larger ones are returned, and nothing is
    looked for inside where neither can be surpassed.  For ``t <= 1`` sinh t < 1.2 t and cosh t - 1
    < 0.6 t^2, so that with |r| <= R the angle is below ``y + 1.2 v t + 0.6 (y + R) t^2`` and the
    speed below ``v + 1.2 (y + R) t + 0.6 v t^2``, with the speed v at the start.
    """
    y, v = flight.angle, abs(flight.velocity)
    if span <= 1.0:
        drive = y + abs(forcing.constant) + abs(forcing.slope) * span + forcing.amplitude
        highest = y + span * (1.2 * v + 0.6 * span * drive)
        fastest = v + span * (1.2 * drive + 0.6 * span * v)
        if highest <= angle and fastest <= speed:
            return angle, speed
    top, _, _, _ = inner_extrema(flight, forcing, span)
    velocity, rate = velocity_flight(flight, forcing)
    swiftest, slowest, _, _ = inner_extrema(velocity, rate, span)
    return (
        max(angle, y, end_angle, top),
        max(speed, v, abs(end_velocity), swiftest, -slowest),
    )


@compiled
def keep_peaks(
    flight: Flight, forcing: Forcing, zero: Zero, lean: float, rate: float, peaks: Floats
) -> None:
    """Raise `peaks` to the largest angle and speed of a flight on a side of this lean and rate."""
    angle, speed = flight_peaks(
        flight,
        forcing,
        zero.time,
        zero.angle,
        zero.velocity,
        peaks[PEAK_ANGLE],
        peaks[PEAK_SPEED] / (lean * rate),
    )
    peaks[PEAK_ANGLE] = angle
    peaks[PEAK_SPEED] = max(peaks[PEAK_SPEED], speed * lean * rate)


@compiled
def last_rise(flight: Flight, forcing: Forcing, level: float, span: float, endless: bool) -> float:
    """Return the last time in [0, span] at which the angle rises through `level`, or -1.

    On an `endless` forcing `span` may be infinite where the angle grows for ever.
    """
    above, lowered = shifted_flight(flight, forcing, level)
    passed, last = 0.0, -1.0
    while passed < span:
        zero = next_zero(above, lowered, span - passed, endless, FALSE, -1.0)
        if zero.event != FOUND:
            break
        passed += zero.time
        if zero.velocity > 0.0:
            last = passed
        above, lowered = restarted(above, lowered, zero)
    return last


@compiled
def restarted(flight: Flight, forcing: Forcing, zero: Zero) -> tuple[Flight, Forcing]:
    """Return the same motion counted from a zero, its growing part carried over unrounded."""
    later = forcing
    if forcing.slope != 0.0:
        constant = forcing.constant + forcing.slope * zero.time
        later = make_forcing(constant, forcing.slope, forcing.amplitude, forcing.frequency)
    phase = wrapped(zero.phase)
    start = make_flight(later, zero.angle, zero.velocity, phase, zero.sine, zero.cosine)
    _, _, growing, reference, decaying = flight.parts
    if zero.time < LONG and reference == 0.0:
        return start, later
    a, b, _, _, _ = start.parts
    parts = Parts(a, b, growing, reference - zero.time, decaying * exp(-zero.time))
    return Flight(zero.angle, zero.velocity, phase, zero.sine, zero.cosine, parts), later
