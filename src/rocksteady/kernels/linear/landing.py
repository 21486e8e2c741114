"""Exact derivatives of a linear flight through its impact (the saltation matrix).

State on a section of impacts: phase psi of the forcing in the side frame and velocity ``v = dy/ds``
just after the impact.  A flight of length T takes (psi, v) to (psi + Omega T, -restitution y'(T)).
Since y(T) = 0 for every start, ``dT = -(y_psi dpsi + y_v dv) / y'(T)``.
"""

from rocksteady.kernels.core.forcing import Forcing
from rocksteady.kernels.elementary.exponential import expm1_short
from rocksteady.kernels.linear.flight import Flight
from rocksteady.kernels.linear.zeros import Zero
from rocksteady.kernels.machine_code.compilation import compiled


@compiled
def landing_jacobian(
    forcing: Forcing, restitution: float, flight: Flight, zero: Zero
) -> tuple[float, float, float, float]:
    """Return d(psi', v') / d(psi, v) row by row, of a flight from angle 0 that lands at a zero.

    Velocity and phase at the landing are taken from the zero: computed again from the initial
    state they would lose digits in long flights.  The forcing has no slope.  The new phase is
    counted in the old side's frame; a change of side adds pi, which changes no derivative.
    """
    beta, frequency = forcing.beta, forcing.frequency
    sine, cosine = flight.sine, flight.cosine
    grown = expm1_short(zero.time)
    decayed = grown / (1.0 + grown)
    sinh, cosh_less_1 = 0.5 * (grown + decayed), 0.5 * grown * decayed
    end_acceleration = forcing.constant + forcing.amplitude * zero.sine

    angle_by_phase = (
        -beta * frequency * sine * sinh
        + beta * cosine * cosh_less_1
        + beta * (cosine - zero.cosine)
    )
    velocity_by_phase = (
        -beta * frequency * sine * cosh_less_1
        + beta * cosine * sinh
        - beta * frequency * (sine - zero.sine)
    )
    time_by_phase = -angle_by_phase / zero.velocity
    time_by_velocity = -sinh / zero.velocity
    return (
        1.0 + frequency * time_by_phase,
        frequency * time_by_velocity,
        -restitution * (velocity_by_phase + end_acceleration * time_by_phase),
        -restitution * (1.0 + cosh_less_1 + end_acceleration * time_by_velocity),
    )
