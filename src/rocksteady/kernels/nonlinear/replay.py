"""Replay of a nonlinear flight step by step: its peaks and level crossings.

A row holds where a flight begins; the steps from there on are the march's own, so that whatever is
read off their polynomials is what the march has seen.
"""

import math
from typing import NamedTuple

from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.elementary.circular import sincos_near
from rocksteady.kernels.machine_code.compilation import allocating, compiled
from rocksteady.kernels.nonlinear._expansion import expand
from rocksteady.kernels.nonlinear._zeros import largest, last_rise
from rocksteady.kernels.nonlinear.drive import Instant, SteppedFlight
from rocksteady.kernels.nonlinear.flight import is_stuck, phase_at, reach_of
from rocksteady.kernels.nonlinear.series import angle_at, make_work, third_bound

LONG = 1.0
"""Side time from which on a flight is searched for its peaks."""
BROADLY = 1.001
"""Factor of a bound that covers what steps leave out of the motion."""


class Leg(NamedTuple):
    """One step of a flight, whose polynomial the working space holds."""

    start: float  # side time since the start of the flight
    step: float
    degree: int
    angle: float  # at its start
    velocity: float


@compiled
def leg_from(
    flight: SteppedFlight, start: float, angle: float, velocity: float, work: Floats
) -> Leg:
    """Return the step of a flight that begins at `start`, with a state there."""
    drive = flight.drive
    _, turned = phase_at(drive, flight.phase, start)
    sine, cosine = sincos_near(turned)
    at = Instant(start, angle, velocity, sine, cosine, angle == 0.0 and velocity == 0.0)
    reach = reach_of(velocity, flight.span - start)
    degree, step = expand(drive, at, reach, flight.left_out, work)
    return Leg(start, step, degree, angle, velocity)


@compiled
def leg_after(leg: Leg, flight: SteppedFlight, work: Floats) -> Leg:
    """Return the step after one."""
    angle, velocity = angle_at(work, leg.degree, leg.step)
    return leg_from(flight, leg.start + leg.step, angle, velocity, work)


@allocating
def peaks_of(
    flight: SteppedFlight, top_angle: float, top_speed: float, shares: Floats | None = None
) -> tuple[float, float]:
    """Return the largest y and |y'| of a flight, or the tops given where these are larger.

    They are not numbers where the flight comes to no end.
    """
    work = make_work(shares)
    steps = 1
    leg = leg_from(flight, 0.0, flight.angle, flight.velocity, work)
    while True:
        third = third_bound(work, leg.degree, leg.step)
        later, after = angle_at(work, leg.degree, leg.step)
        top_angle, top_speed = largest(
            work, leg.degree, leg.step, third, later, after, top_angle, top_speed
        )
        if leg.start + leg.step >= flight.span:
            return top_angle, top_speed
        if is_stuck(flight.drive, steps, leg.start):
            return math.nan, math.nan
        steps += 1
        leg = leg_after(leg, flight, work)


@compiled
def stays_below(flight: SteppedFlight, top_angle: float, top_speed: float) -> bool:
    """Return whether a flight is too short to reach the tops given, by a bound of |y''|.

    While 0 <= y <= 2, ``|sin(alpha (1 - y))|/alpha <= 1``.
    """
    drive, _, angle, velocity, span, _ = flight
    if not span < LONG:
        return False
    pull = abs(drive.constant) + abs(drive.slope) * span + drive.amplitude
    pull += 1.0 + abs(drive.lift) + abs(drive.lift_slope) * span
    fastest = BROADLY * (abs(velocity) + span * pull)
    highest = BROADLY * (angle + span * fastest)
    return fastest <= top_speed and highest <= min(top_angle, 2.0)


@allocating
def last_rise_of(
    flight: SteppedFlight, level: float, beyond: float, shares: Floats | None = None
) -> float:
    """Return the last time at which a flight rises through a level, or -1.

    Of a flight that never ends it is the last before it passes `beyond`, from where it does not
    come back.  Where the steps of one that does so by a hair come to nothing, or lead below the
    floor, it is the last that they have passed.
    """
    work = make_work(shares)
    steps = 1
    last = -1.0
    leg = leg_from(flight, 0.0, flight.angle, flight.velocity, work)
    while True:
        time = last_rise(work, leg.degree, leg.step, level)
        if time >= 0.0:
            last = leg.start + time
        if leg.start + leg.step >= flight.span:
            return last
        leg = leg_after(leg, flight, work)
        if flight.span == math.inf and (leg.angle > max(level, beyond) or leg.angle < -1.0):
            return last
        if is_stuck(flight.drive, steps, leg.start):
            return last
        steps += 1
