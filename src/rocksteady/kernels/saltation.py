"""Exact derivatives of one flight through its impact (the saltation matrix of the linear model).

State on a section of impacts: phase psi of the forcing in the side frame and velocity ``v = dy/ds``
just after the impact.  A flight of length T takes (psi, v) to (psi + Omega T, -restitution y'(T)).
Since y(T) = 0 for every start, ``dT = -(y_psi dpsi + y_v dv) / y'(T)``.
"""

import math

from rocksteady.kernels.compilation import compiled


@compiled
def impact_jacobian(
    amplitude: float,
    frequency: float,
    restitution: float,
    phase: float,
    velocity: float,
    time: float,
) -> tuple[float, float, float, float]:
    """Return d(psi', v') / d(psi, v) row by row, for a flight of length `time` under -1 + A sin.

    The new phase is counted in the old side's frame; a change of side adds pi, which changes no
    derivative.
    """
    beta = amplitude / (1.0 + frequency * frequency)
    sine, cosine = math.sin(phase), math.cos(phase)
    landing = phase + frequency * time
    end_sine, end_cosine = math.sin(landing), math.cos(landing)
    grown = math.expm1(time)
    decayed = grown / (1.0 + grown)
    sinh, cosh_less_1 = 0.5 * (grown + decayed), 0.5 * grown * decayed
    cosh = 1.0 + cosh_less_1

    a = velocity + beta * frequency * cosine
    b = beta * sine - 1.0
    end_velocity = velocity + a * cosh_less_1 + b * sinh + beta * frequency * (cosine - end_cosine)
    end_acceleration = amplitude * end_sine - 1.0

    angle_by_phase = (
        -beta * frequency * sine * sinh + beta * cosine * cosh_less_1 + beta * (cosine - end_cosine)
    )
    velocity_by_phase = (
        -beta * frequency * sine * cosh_less_1
        + beta * cosine * sinh
        - beta * frequency * (sine - end_sine)
    )
    time_by_phase = -angle_by_phase / end_velocity
    time_by_velocity = -sinh / end_velocity
    return (
        1.0 + frequency * time_by_phase,
        frequency * time_by_velocity,
        -restitution * (velocity_by_phase + end_acceleration * time_by_phase),
        -restitution * (cosh + end_acceleration * time_by_velocity),
    )
