"""Start on a symmetric steady state of either model, and departure from an unstable one.

An unstable state is left along its unstable eigenvector, to a named side: rounding decides nothing.
"""

import math

from rocksteady.arrays import Floats
from rocksteady.dynamics.arrays import SMALLEST
from rocksteady.dynamics.steady.states import SteadyStates, full_states, steady_states
from rocksteady.errors import ModelError, Words
from rocksteady.kernels.core.tables import ALPHA, RESTITUTION, SIDE_COLUMNS
from rocksteady.kernels.elementary.arrays import hypot
from rocksteady.kernels.orbits.closed_form import half_cycle_jacobian, symmetric_orbit


def states_to_start_on(
    amplitude: Floats, frequency_ratio: Floats, sides: Floats, order: int, branch: int
) -> tuple[SteadyStates, Floats | None]:
    """Return the steady states of blocks, and derivatives of their half cycles in the full model.

    Parameters
    ----------
    amplitude, frequency_ratio
        Parameters of the shaking, shape (cells,).
    sides
        Sides of the blocks, both alike, as from `model.equations.Linear.sides`, shape
        (cells, 2, 3) or, in the nonlinear model, (cells, 2, 5).
    order, branch
        Which steady state.
    """
    restitution = sides[:, 0, RESTITUTION]
    if sides.shape[2] == SIDE_COLUMNS:
        return steady_states(amplitude, frequency_ratio, restitution, order=order), None
    alpha = sides[:, 0, ALPHA]
    return full_states(amplitude, frequency_ratio, restitution, alpha, order=order, branch=branch)


def set_off(
    states: SteadyStates, jacobian: Floats | None, *, branch: int, cell: int, away: float
) -> tuple[float, float]:
    """Return phase and velocity at the start on a steady state, beside it where it is unstable.

    Parameters
    ----------
    states, jacobian
        From `states_to_start_on`.
    branch, cell
        Which of them, and at which point.
    away
        Distance along its unstable direction at which an unstable one is left; of either sign.

    Raises
    ------
    ModelError
        If no number determines how it is left.
    """
    at = branch - 1, cell
    phase, velocity = float(states.phase[at]), float(states.velocity[at])
    if states.stable[at] or states.neutral[at]:
        return phase, velocity
    amplitude, ratio = float(states.amplitude[cell]), float(states.frequency_ratio[cell])
    order = int(states.order[cell])
    if math.isnan(states.trace[at]):
        raise ModelError(
            "start",
            Words(f"is of order {order}, branch {branch}"),
            "it meets its base without speed, and no derivative determines how it is left",
            "take another amplitude, or a State to start from",
        )
    if jacobian is None:
        restitution = float(states.restitution[cell])
        turn, rate = unstable_direction(amplitude, ratio, restitution, order, branch)
    else:
        turn, rate = growing(tuple(jacobian[:, *at].tolist()), velocity, order, branch, ratio)
    return phase + away * turn, velocity + away * rate


def unstable_direction(
    amplitude: float, frequency_ratio: float, restitution: float, order: int, branch: int
) -> tuple[float, float]:
    """Return how an unstable steady state of the linear model is left, as in `growing`."""
    amplitude = max(amplitude, SMALLEST)
    orbit = symmetric_orbit(amplitude, frequency_ratio, restitution, order, branch)
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
        Derivative of the half cycle by (phase, d(theta/alpha)/d(p t)), row by row; of any scale.
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
