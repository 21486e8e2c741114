"""Start on a symmetric steady state of either model, and departure from an unstable one."""

import math

from rocksteady.arrays import Floats
from rocksteady.dynamics.arrays import SMALLEST
from rocksteady.errors import ModelError, Words
from rocksteady.kernels.core.clock import clock
from rocksteady.kernels.core.tables import ALPHA, RESTITUTION, is_nonlinear
from rocksteady.kernels.elementary.arrays import hypot
from rocksteady.kernels.orbits.closed_form import half_cycle_jacobian, symmetric_orbit
from rocksteady.kernels.orbits.return_map import Section
from rocksteady.kernels.orbits.symmetric_nonlinear import Half, symmetric_from


def set_off(
    amplitude: float,
    frequency_ratio: float,
    sides: Floats,
    *,
    order: int,
    branch: int,
    phase: float,
    velocity: float,
    unstable: bool,
    away: float,
) -> tuple[float, float]:
    """Return phase and velocity at the start on a steady state, beside it where it is unstable.

    Parameters
    ----------
    amplitude, frequency_ratio
        Parameters of the shaking.
    sides
        Sides of the block, both alike, as from `dynamics.history.nonlinear_tables.sides_of`.
    order, branch
        Order and branch of the steady state.
    phase, velocity, unstable
        What it is in the linear model: phase of the shaking [rad], d(theta/alpha)/d(p t), and
        whether it is unstable.  In the nonlinear model the search for its own begins there.
    away
        Distance along its unstable direction at which an unstable one is left; of either sign.

    Raises
    ------
    ModelError
        If the nonlinear model has no such state, or no number determines how it is left.
    """
    turn = rate = 0.0
    if is_nonlinear(sides):
        start_state = nonlinear_half(
            amplitude,
            frequency_ratio,
            sides,
            order=order,
            branch=branch,
            phase=phase,
            velocity=velocity,
        )
        if not start_state.found:
            alpha = float(sides[0, ALPHA])
            raise ModelError(
                "start",
                Words(f"is of order {order}, branch {branch}"),
                "the linear model's steady state leads to none of the nonlinear model at "
                f"alpha = {alpha:.6g}",
                "take the other branch, another amplitude, or a State to start from",
            )
        state, jacobian = start_state.state, start_state.jacobian
        phase, velocity = state.half_cycles * math.pi + state.phase, state.speed
        trace = jacobian.phase_by_phase + jacobian.speed_by_speed
        restitution = float(sides[0, RESTITUTION])
        if not abs(trace) < 1.0 + restitution * restitution:
            turn, rate = growing(tuple(jacobian), velocity, order, branch, frequency_ratio)
    elif unstable:
        restitution = float(sides[0, RESTITUTION])
        turn, rate = unstable_direction(amplitude, frequency_ratio, restitution, order, branch)
    return phase + away * turn, velocity + away * rate


def nonlinear_half(
    amplitude: float,
    frequency_ratio: float,
    sides: Floats,
    *,
    order: int,
    branch: int,
    phase: float,
    velocity: float,
) -> Half:
    """Return the half cycle of the nonlinear model to which one of the linear model leads.

    Parameters and the meaning of numbers are those of `set_off`.
    """
    half_cycles, turn = clock(phase)
    begin = Section(1, half_cycles, turn, velocity)
    return symmetric_from(amplitude, frequency_ratio, sides, order, branch, begin)


def unstable_direction(
    amplitude: float, frequency_ratio: float, restitution: float, order: int, branch: int
) -> tuple[float, float]:
    """Return how an unstable steady state of the linear model is left, as in `growing`."""
    amplitude = max(amplitude, SMALLEST)
    orbit = symmetric_orbit(amplitude, frequency_ratio, restitution, order, branch)
    if math.isnan(orbit.trace):
        raise ModelError(
            "start",
            Words(f"is of order {order}, branch {branch}"),
            "it meets its base without speed, and no derivative determines how it is left",
            "take another amplitude, or a State to start from",
        )
    velocity = frequency_ratio * orbit.velocity
    jacobian = half_cycle_jacobian(amplitude, frequency_ratio, restitution, order, orbit)
    return growing(jacobian, velocity, order, branch, frequency_ratio)


def growing(
    jacobian: tuple[float, ...], velocity: float, order: int, branch: int, frequency_ratio: float
) -> tuple[float, float]:
    """Return the unit eigenvector of a half cycle's larger multiplier, velocity part positive.

    Its measure is (phase, velocity / velocity of the orbit), so that "the positive side" means:
    with more velocity than the orbit has.

    Parameters
    ----------
    jacobian
        Derivative of the half cycle by (phase, d(theta/alpha)/d(p t)), row by row.
    velocity
        Velocity of the orbit, d(theta/alpha)/d(p t).
    order, branch, frequency_ratio
        Named in an error.

    Returns
    -------
    phase, velocity
        The shift of either [rad; per pivot time].

    Raises
    ------
    ModelError
        If the derivative is beyond what a number can hold.
    """
    j11, j12, j21, j22 = jacobian
    entries = (j11, j12 * velocity, j21 / velocity, j22)
    largest = max(map(abs, entries))
    if not 0.0 < largest < math.inf:
        raise ModelError(
            "start",
            Words(f"is of order {order}, branch {branch}"),
            f"at Omega = {frequency_ratio:.6g} its half cycle is so long that no number determines "
            "how it is left",
            "take a lower order, or a State to start from",
        )
    # Its entries may be near the overflow; the direction does not depend on their scale.
    j11, j12, j21, j22 = (entry / largest for entry in entries)
    half, apart = 0.5 * (j11 + j22), 0.5 * (j11 - j22)
    root = math.sqrt(max(apart * apart + j12 * j21, 0.0))
    multiplier = half + math.copysign(root, half)
    # The longer of the two rows of J - multiplier gives the direction.
    if hypot(j11 - multiplier, j12) > hypot(j21, j22 - multiplier):
        x, y = -j12, j11 - multiplier
    else:
        x, y = multiplier - j22, j21
    size = math.copysign(hypot(x, y), y)
    return x / size, y / size * velocity
