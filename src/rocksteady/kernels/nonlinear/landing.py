"""Nonlinear flight to its landing under harmonic shaking, with the exact derivative.

The derivatives D of y by the state at the start obey the equation of motion's own derivative::

    D'' = K D + F,    K = (1 + l) C + alpha^2 h S,

with S and C of `rocksteady.kernels.nonlinear.series`; F is C dh/dpsi for the derivative by the
phase at the start and 0 for that by the velocity.  Their Taylor coefficients follow from those of
the flight by sums of products, step by step along with it.

State on a section of impacts: phase psi of the forcing in the side frame and velocity ``v = dy/ds``
just after the impact, as in `kernels.linear.landing`, and the landing takes the derivatives
onto the section in the same way: ``dT = -(y_psi dpsi + y_v dv)/y'(T)``.
"""

import numpy as np

from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.core.typed import FALSE, TRUE
from rocksteady.kernels.elementary.circular import sin
from rocksteady.kernels.elementary.inverse import atan
from rocksteady.kernels.linear.zeros import Zero
from rocksteady.kernels.machine_code.compilation import allocating, compiled
from rocksteady.kernels.nonlinear.drive import Drive, acceleration
from rocksteady.kernels.nonlinear.flight import fly, phase_at
from rocksteady.kernels.nonlinear.replay import leg_after, leg_from
from rocksteady.kernels.nonlinear.series import COSINE, SHAKING, SINE, TERMS, WORK_ROWS

SHARE = 0.01
"""Of what may be left out of the motion: the derivatives have one term less and are larger."""


@compiled
def lost_under_shaking(drive: Drive) -> float:
    """Return the y beyond which a block that moves on never comes back from harmonic shaking."""
    return 1.0 + atan(drive.alpha * drive.amplitude) / drive.alpha


@allocating
def fly_to_landing(
    drive: Drive, angle: float, velocity: float, phase: float, span: float, left_out: float
) -> Zero:
    """Return where a flight under endless harmonic shaking ends, within a span."""
    work, nothing = np.empty((WORK_ROWS, TERMS)), np.empty(0)
    return fly(
        drive,
        angle,
        velocity,
        phase,
        span,
        TRUE,
        lost_under_shaking(drive),
        angle == 0.0 and velocity == 0.0,
        left_out,
        nothing,
        1.0,
        1.0,
        work,
    )


@allocating
def variation_step(
    drive: Drive, work: Floats, degree: int, step: float, angle: float, rate: float, by_phase: bool
) -> tuple[float, float]:
    """Return a derivative of y, and of y', at the end of a step; `angle` and `rate` at its start.

    `work` holds the coefficients of the step.
    """
    square = drive.alpha * drive.alpha
    course = np.empty(TERMS)
    stiffness = np.empty(TERMS)
    course[0], course[1] = angle, rate
    share = 1.0 / drive.frequency
    last = degree - 1  # the coefficients of the shaking are known up to one less than of y
    for n in range(last - 1):
        force = 0.0
        tilted = work[COSINE, n]
        for j in range(n + 1):
            tilted += square * work[SHAKING, j] * work[SINE, n - j]
        stiffness[n] = tilted
        for j in range(n + 1):
            force += stiffness[j] * course[n - j]
        if by_phase:
            for j in range(n + 1):
                force += share * (j + 1) * work[SHAKING, j + 1] * work[COSINE, n - j]
        course[n + 2] = force / ((n + 1) * (n + 2))
    value, slope = course[last], 0.0
    for n in range(last - 1, -1, -1):
        slope = slope * step + value
        value = value * step + course[n]
    return value, slope


@allocating
def landing_derivative(
    drive: Drive, restitution: float, velocity: float, phase: float, zero: Zero, left_out: float
) -> tuple[float, float, float, float]:
    """Return d(psi', v') / d(psi, v) row by row, of a flight from angle 0 that lands at a zero.

    Parameters
    ----------
    drive
        The side and its shaking.
    restitution
        Of the landing.
    velocity, phase
        At the start of the flight.
    zero
        Where it lands.
    left_out
        Part of the motion that a step may leave out.
    """
    work = np.empty((WORK_ROWS, TERMS))
    left_out *= SHARE
    y_phase, v_phase, y_speed, v_speed = 0.0, 0.0, 0.0, 1.0
    leg = leg_from(drive, phase, 0.0, 0.0, velocity, zero.time, left_out, work)
    while True:
        y_phase, v_phase = variation_step(drive, work, leg.degree, leg.step, y_phase, v_phase, TRUE)
        y_speed, v_speed = variation_step(
            drive, work, leg.degree, leg.step, y_speed, v_speed, FALSE
        )
        if leg.start + leg.step >= zero.time:
            break
        leg = leg_after(leg, drive, phase, zero.time, left_out, work)
    _, turned = phase_at(drive, phase, zero.time)
    end = acceleration(drive, zero.time, 0.0, sin(turned))
    time_by_phase = -y_phase / zero.velocity
    time_by_speed = -y_speed / zero.velocity
    return (
        1.0 + drive.frequency * time_by_phase,
        drive.frequency * time_by_speed,
        -restitution * (v_phase + end * time_by_phase),
        -restitution * (v_speed + end * time_by_speed),
    )
