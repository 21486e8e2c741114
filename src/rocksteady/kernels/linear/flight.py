"""Closed-form motion of a block on one pivot over one segment.

In the side frame the linear equation of motion (eqs 4, 5 of Tso and Wong) is ``y'' = y + r`` with
the forcing ``r`` of `rocksteady.kernels.core.forcing`, and its solution (eqs 7, 8) is::

    y = a sinh t + b cosh t - constant - slope t - beta sin psi
    a = velocity + slope + beta Omega cos(phase)          (eq 14)
    b = angle + constant + beta sin(phase)                (eq 15)

Three ways of writing it share the work, since none is accurate everywhere:

* short (``t`` and ``Omega t`` below 1/4): a Taylor polynomial, without cancellation however small
  the velocity;
* medium (``t`` below 1/4 under fast shaking): ``angle + a sinh t + b (cosh t - 1) - slope t +
  beta (sin(phase) - sin psi)``;
* long: ``growing e^(t - reference) + decaying e^-t - constant - slope t - beta sin psi``, in which
  a tiny growing part keeps its own relative precision.
"""

from typing import NamedTuple

import numpy as np

from rocksteady.kernels.core.forcing import HALF_PI, TWO_PI, Forcing, make_forcing
from rocksteady.kernels.elementary.exponential import exp_clamped, exp_near, expm1_near
from rocksteady.kernels.machine_code.compilation import compiled, inlined

SHORT = 0.25
"""Largest t and Omega t of the Taylor form: its 13 terms leave out below 2e-18 of the largest."""
LONG = 0.25
"""Least t of the exponential form.  With 1, impact times of flights from 1/4 to 1/2 would have a
median error of 1e-16 in place of 9e-16, but marches would take 14 to 17 % longer: most flights are
that long, and one exponential is cheaper than `expm1`."""
LARGEST_EXPONENT = 700.0  # e^700 is finite; only signs matter there


class Parts(NamedTuple):
    """Coefficients of the closed form of a flight."""

    sinh: float  # a
    cosh: float  # b
    growing: float  # G
    reference: float
    decaying: float  # H


class Flight(NamedTuple):
    """Initial state of a flight and the coefficients of its closed form."""

    angle: float
    velocity: float
    phase: float  # psi at t = 0, in [-pi/2, 3 pi/2)
    sine: float
    cosine: float
    parts: Parts


@inlined
def make_flight(
    forcing: Forcing, angle: float, velocity: float, phase: float, sine: float, cosine: float
) -> Flight:
    """Return the flight that starts with `angle` and `velocity` at `phase`."""
    a = velocity + forcing.slope + forcing.beta * forcing.frequency * cosine
    b = angle + forcing.constant + forcing.beta * sine
    parts = Parts(a, b, 0.5 * (a + b), 0.0, 0.5 * (b - a))
    return Flight(angle, velocity, phase, sine, cosine, parts)


@compiled
def wrapped(phase: float) -> float:
    """Return `phase` modulo 2 pi in [-pi/2, 3 pi/2)."""
    turned = phase - TWO_PI * float(np.floor((phase + HALF_PI) / TWO_PI))
    if turned >= 3.0 * HALF_PI:  # the subtraction rounded up
        turned -= TWO_PI
    return turned


@inlined
def flight_state(
    flight: Flight, forcing: Forcing, time: float, sine: float, cosine: float
) -> tuple[float, float]:
    """Return angle and velocity at `time`, where the forcing's phase has this sine and cosine."""
    if time < SHORT and forcing.frequency * time < SHORT:
        return short_flight_state(flight, forcing, time)
    beta, parts = forcing.beta, flight.parts
    if time < LONG:
        grown = expm1_near(time)  # e^t - 1
        decayed = grown / (1.0 + grown)  # 1 - e^-t
        sinh = 0.5 * (grown + decayed)
        cosh_less_1 = 0.5 * grown * decayed
        angle = (
            flight.angle
            + parts.sinh * sinh
            + parts.cosh * cosh_less_1
            - forcing.slope * time
            + beta * (flight.sine - sine)
        )
        velocity = (
            flight.velocity
            + parts.sinh * cosh_less_1
            + parts.cosh * sinh
            + beta * forcing.frequency * (flight.cosine - cosine)
        )
        return angle, velocity
    if parts.reference == 0.0:
        up = exp_near(min(time, LARGEST_EXPONENT))
        down = 1.0 / up
    else:
        up = exp_clamped(time - parts.reference)
        down = exp_clamped(-time)
    up *= parts.growing
    down *= parts.decaying
    angle = up + down - forcing.constant - forcing.slope * time - beta * sine
    velocity = up - down - forcing.slope - beta * forcing.frequency * cosine
    return angle, velocity


@compiled
def short_flight_state(flight: Flight, forcing: Forcing, time: float) -> tuple[float, float]:
    """Return angle and velocity by Taylor's series: d_(n+2) = d_n + the n-th derivative of r.

    13 terms leave out less than 1e-17 of the first for `time` and `frequency time` below 1/4.
    """
    w = forcing.frequency
    swing_even = forcing.amplitude * flight.sine
    swing_odd = forcing.amplitude * w * flight.cosine
    even = flight.angle + forcing.constant + swing_even  # d_2
    odd = flight.velocity + forcing.slope + swing_odd  # d_3
    # term_n = t^(n-1)/n!, so that the angle is angle_0 + t (v + sum of d_n term_n).
    half = 0.5 * time
    third = time * time * (1.0 / 6.0)
    rise = even * half + odd * third
    speed = even * time + odd * half * time
    for n in range(4, 14, 2):
        swing_even *= -w * w
        swing_odd *= -w * w
        even += swing_even  # d_n
        odd += swing_odd  # d_(n+1)
        half = third * (time * (1.0 / n))
        third = half * (time * (1.0 / (n + 1)))
        rise += even * half + odd * third
        speed += even * half * n + odd * third * (n + 1)
    return flight.angle + time * (flight.velocity + rise), flight.velocity + speed


@inlined
def flight_acceleration(forcing: Forcing, time: float, angle: float, sine: float) -> float:
    """Return y'' = y + r."""
    return angle + forcing.constant + forcing.slope * time + forcing.amplitude * sine


@compiled
def velocity_flight(flight: Flight, forcing: Forcing) -> tuple[Flight, Forcing]:
    """Return the velocity as a flight of its own: w = y' obeys w'' = w + dr/dt.

    Its zeros are the extrema of the angle, and they are isolated by the same argument.
    """
    rate = make_forcing(
        forcing.slope, 0.0, forcing.amplitude * forcing.frequency, forcing.frequency
    )
    acceleration = flight_acceleration(forcing, 0.0, flight.angle, flight.sine)
    phase = wrapped(flight.phase + HALF_PI)
    a, b, growing, reference, decaying = flight.parts
    parts = Parts(b, a, growing, reference, -decaying)
    return Flight(flight.velocity, acceleration, phase, flight.cosine, -flight.sine, parts), rate


@compiled
def shifted_flight(flight: Flight, forcing: Forcing, level: float) -> tuple[Flight, Forcing]:
    """Return y - level as a flight of its own, with the level moved into the forcing."""
    lowered = make_forcing(
        forcing.constant + level, forcing.slope, forcing.amplitude, forcing.frequency
    )
    angle, velocity, phase, sine, cosine, parts = flight
    return Flight(angle - level, velocity, phase, sine, cosine, parts), lowered
