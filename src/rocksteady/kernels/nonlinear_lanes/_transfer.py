"""Transfer of cells and of states of the march into lanes, and back."""

import math

from rocksteady.kernels.core.clock import clock, side_phase
from rocksteady.kernels.core.tables import LEFT_OUT, RESTITUTION, Floats, March
from rocksteady.kernels.elementary.logarithm import LN2, log
from rocksteady.kernels.machine_code.compilation import compiled
from rocksteady.kernels.nonlinear.proofs import HALF_PI
from rocksteady.kernels.nonlinear_lanes._ends import NO_LIMIT
from rocksteady.kernels.nonlinear_lanes._layout import (
    ALLOWED,
    ALPHA,
    ANGLE,
    CALMING,
    CELL,
    FALLEN,
    FLYING,
    FREQUENCY,
    HALVINGS,
    IMPACTS,
    LAG,
    LANDED,
    LEAN,
    LEFT,
    LIMIT,
    LOST,
    PHASE,
    REF_IMPACTS,
    REF_PHASE,
    REF_VELOCITY,
    SIDE,
    SPEED,
    STAGE,
    START_ANGLE,
    STOP,
    TIME,
    UNIT,
    VELOCITY,
)
from rocksteady.kernels.nonlinear_lanes._two_sides import load_sides, turn_to

DOUBT = 1.0 + 1e-9
"""By which what lanes ask of a slow bounce is weaker than what the proof of rest does."""


@compiled
def load(
    lanes: Floats, k: int, cell: int, amplitude: float, frequency: float, sides: Floats, stop: float
) -> None:
    """Give a lane the constants of a cell; `stop` is the phase at which its run ends."""
    delta: float = max(sides[0, RESTITUTION], sides[1, RESTITUTION])
    load_sides(lanes, k, amplitude, frequency, sides, delta)
    lanes[CELL + k] = cell
    lanes[ALLOWED + k] = log(sides[0, LEFT_OUT]) / LN2
    # Bounces are proved to end only if kappa, of the worse side, is (1 + delta)/2 at most.
    lanes[CALMING + k] = DOUBT * (0.25 * (1.0 + delta) * (1.0 + delta) - delta * delta)
    lanes[STOP + k] = stop
    lanes[REF_PHASE + k] = math.inf
    lanes[REF_VELOCITY + k] = math.inf
    lanes[REF_IMPACTS + k] = math.inf
    lanes[LAG + k] = 0.0


@compiled
def put_lane(lanes: Floats, k: int, state: March, end_half: int) -> None:
    """Give a lane the state of a march in flight."""
    turn_to(lanes, k, state.side)
    phase, moved = side_phase(state.half_cycles, state.phase, state.side, lanes[FREQUENCY + k])
    angle = state.side * state.angle / lanes[LEAN + k]
    velocity = state.side * state.velocity / lanes[UNIT + k]
    lanes[PHASE + k] = phase
    lanes[LEFT + k] = end_half - (state.half_cycles - moved)
    lanes[START_ANGLE + k] = lanes[ANGLE + k] = angle
    lanes[VELOCITY + k] = lanes[SPEED + k] = velocity
    lanes[TIME + k] = 0.0
    lanes[IMPACTS + k] = state.impacts
    lanes[LIMIT + k] = NO_LIMIT
    lanes[HALVINGS + k] = 0.0
    lanes[STAGE + k] = LANDED if angle == 0.0 else FLYING
    if angle >= HALF_PI / lanes[ALPHA + k] or (angle > lanes[LOST + k] and velocity >= 0.0):
        lanes[STAGE + k] = FALLEN


@compiled
def taken(lanes: Floats, k: int, end_half: int) -> March:
    """Return the state of a lane at the start of its flight, as the march has it."""
    side = int(lanes[SIDE + k])
    turned, phase = clock(lanes[PHASE + k])
    return March(
        side,
        side * lanes[START_ANGLE + k] * lanes[LEAN + k],
        side * lanes[VELOCITY + k] * lanes[UNIT + k],
        0,
        end_half - int(lanes[LEFT + k]) + turned,
        phase,
        int(lanes[IMPACTS + k]),
        0,
    )


@compiled
def at_the_end(lanes: Floats, k: int, end_half: int) -> March:
    """Return the state of a lane whose run has ended in mid flight."""
    side = int(lanes[SIDE + k])
    return March(
        side,
        side * lanes[ANGLE + k] * lanes[LEAN + k],
        side * lanes[SPEED + k] * lanes[UNIT + k],
        0,
        end_half,
        lanes[STOP + k],
        int(lanes[IMPACTS + k]),
        0,
    )
