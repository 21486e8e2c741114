"""Flight in steps to its landing under periodic shaking, with the exact derivative.

State on a section of impacts: phase psi of the forcing in the side frame and velocity ``v = dy/ds``
just after the impact, as in `kernels.linear.landing`.  The landing takes the derivatives of the
flight (`rocksteady.kernels.nonlinear._variation`) onto the section in the same way:
``dT = -(y_psi dpsi + y_v dv)/y'(T)``.

In the linear model, which takes steps under a Fourier series, those derivatives D are in closed
form.  ``D'' = D + dh/dpsi`` with ``dh/dpsi = h'/Omega``, and ``w = y'`` obeys ``w'' = w + h'``.  So
``D = (y' - v_0 cosh t - y''_0 sinh t)/Omega`` by the phase, and sinh t by the velocity.
"""

import numpy as np

from rocksteady.kernels.core.tables import FOUND, Floats
from rocksteady.kernels.core.typed import TRUE
from rocksteady.kernels.elementary.exponential import expm1_short
from rocksteady.kernels.elementary.inverse import atan
from rocksteady.kernels.linear.zeros import Zero
from rocksteady.kernels.machine_code.compilation import allocating, compiled
from rocksteady.kernels.nonlinear._variation import COLUMNS, ROWS, SHARE, STATE
from rocksteady.kernels.nonlinear.drive import Drive, SteppedFlight, acceleration, swing_at
from rocksteady.kernels.nonlinear.flight import fly, phase_at
from rocksteady.kernels.nonlinear.series import make_work

Derivative = tuple[float, float, float, float]
"""Of y and y' at the end of a flight by the phase at its start, and of both by the velocity."""


@compiled
def lost_under_shaking(drive: Drive) -> float:
    """Return the y beyond which a block that moves on never comes back from harmonic shaking."""
    if drive.alpha == 0.0:
        return 1.0 + drive.amplitude
    return 1.0 + atan(drive.alpha * drive.amplitude) / drive.alpha


@allocating
def fly_to_landing(flight: SteppedFlight, shares: Floats | None = None) -> tuple[Zero, Derivative]:
    """Return where a flight under endless periodic shaking ends, within a span, and what moves it.

    The derivative is that of y and y' at the time at which it ends.
    """
    drive, phase, angle, velocity, span, left_out = flight
    linear = drive.alpha == 0.0
    course = np.empty((ROWS, COLUMNS))[: 0 if linear else ROWS]
    share = left_out if linear else SHARE * left_out
    lost, lifting = lost_under_shaking(drive), angle == 0.0 and velocity == 0.0
    work, nothing = make_work(shares), np.empty(0)
    closely = SteppedFlight(drive, phase, angle, velocity, span, share)
    zero = fly(closely, TRUE, lost, lifting, nothing, 1.0, 1.0, work, course)
    if linear:
        return zero, linear_derivative(flight, zero, shares)
    return zero, (course[STATE, 0], course[STATE, 1], course[STATE, 2], course[STATE, 3])


@compiled
def linear_derivative(flight: SteppedFlight, zero: Zero, shares: Floats | None) -> Derivative:
    """Return what moves the end of a linear flight that has come to a zero."""
    if zero.event != FOUND:
        return 0.0, 0.0, 0.0, 0.0
    drive, phase, angle, velocity, _, _ = flight
    _, turned = phase_at(drive, phase, zero.time)
    start = acceleration(drive, 0.0, angle, swing_at(drive, shares, phase))
    end = acceleration(drive, zero.time, 0.0, swing_at(drive, shares, turned))
    grown = expm1_short(zero.time)
    decayed = grown / (1.0 + grown)
    sinh, cosh_less_1 = 0.5 * (grown + decayed), 0.5 * grown * decayed
    share = 1.0 / drive.frequency
    return (
        share * ((zero.velocity - velocity) - velocity * cosh_less_1 - start * sinh),
        share * ((end - start) - start * cosh_less_1 - velocity * sinh),
        sinh,
        1.0 + cosh_less_1,
    )


@compiled
def landing_derivative(
    drive: Drive,
    restitution: float,
    phase: float,
    zero: Zero,
    derivative: Derivative,
    shares: Floats | None = None,
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
    shares
        Of a Fourier series.
    """
    y_phase, v_phase, y_speed, v_speed = derivative
    _, turned = phase_at(drive, phase, zero.time)
    end = acceleration(drive, zero.time, 0.0, swing_at(drive, shares, turned))
    time_by_phase = -y_phase / zero.velocity
    time_by_speed = -y_speed / zero.velocity
    return (
        1.0 + drive.frequency * time_by_phase,
        drive.frequency * time_by_speed,
        -restitution * (v_phase + end * time_by_phase),
        -restitution * (v_speed + end * time_by_speed),
    )
