"""Nonlinear flight to its landing under harmonic shaking, with the exact derivative.

State on a section of impacts: phase psi of the forcing in the side frame and velocity ``v = dy/ds``
just after the impact, as in `kernels.linear.landing`.  The landing takes the derivatives of the
flight (`rocksteady.kernels.nonlinear._variation`) onto the section in the same way:
``dT = -(y_psi dpsi + y_v dv)/y'(T)``.
"""

import numpy as np

from rocksteady.kernels.core.typed import TRUE
from rocksteady.kernels.elementary.circular import sin
from rocksteady.kernels.elementary.inverse import atan
from rocksteady.kernels.linear.zeros import Zero
from rocksteady.kernels.machine_code.compilation import allocating, compiled
from rocksteady.kernels.nonlinear._variation import COLUMNS, ROWS, SHARE, STATE
from rocksteady.kernels.nonlinear.drive import Drive, acceleration
from rocksteady.kernels.nonlinear.flight import fly, phase_at
from rocksteady.kernels.nonlinear.series import TERMS, WORK_ROWS

Derivative = tuple[float, float, float, float]
"""Of y and y' at the end of a flight by the phase at its start, and of both by the velocity."""


@compiled
def lost_under_shaking(drive: Drive) -> float:
    """Return the y beyond which a block that moves on never comes back from harmonic shaking."""
    return 1.0 + atan(drive.alpha * drive.amplitude) / drive.alpha


@allocating
def fly_to_landing(
    drive: Drive, angle: float, velocity: float, phase: float, span: float, left_out: float
) -> tuple[Zero, Derivative]:
    """Return where a flight under endless harmonic shaking ends, within a span, and what moves it.

    The derivative is that of y and y' at the time at which it ends.
    """
    course = np.empty((ROWS, COLUMNS))
    zero = fly(
        drive,
        angle,
        velocity,
        phase,
        span,
        TRUE,
        lost_under_shaking(drive),
        angle == 0.0 and velocity == 0.0,
        SHARE * left_out,
        np.empty(0),
        1.0,
        1.0,
        np.empty((WORK_ROWS, TERMS)),
        course,
    )
    return zero, (course[STATE, 0], course[STATE, 1], course[STATE, 2], course[STATE, 3])


@compiled
def landing_derivative(
    drive: Drive, restitution: float, phase: float, zero: Zero, derivative: Derivative
) -> tuple[float, float, float, float]:
    """Return d(psi', v') / d(psi, v) row by row, of a flight from the floor that lands at a zero.

    Parameters
    ----------
    drive
        The side and its shaking.
    restitution
        Of the landing.
    phase
        At the start of the flight.
    zero, derivative
        Where it lands, and what `fly_to_landing` says moves it.
    """
    y_phase, v_phase, y_speed, v_speed = derivative
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
