"""Transfer of cells and of states of the march into lanes, and back."""

import math

from rocksteady.kernels.core.clock import clock, side_phase
from rocksteady.kernels.core.law import UNKNOWN
from rocksteady.kernels.core.tables import LEFT_OUT, RESTITUTION, Floats, March
from rocksteady.kernels.elementary.logarithm import LN2, log
from rocksteady.kernels.machine_code.compilation import compiled
from rocksteady.kernels.nonlinear.proofs import HALF_PI
from rocksteady.kernels.nonlinear_lanes import _layout as lane
from rocksteady.kernels.nonlinear_lanes._ends import NO_LIMIT
from rocksteady.kernels.nonlinear_lanes._two_sides import load_sides, turn_to

DOUBT = 1.0 + 1e-9
"""By which what lanes ask of a slow bounce is weaker than what the proof of rest does."""


@compiled
def load(
    lanes: Floats, k: int, cell: int, amplitude: float, frequency: float, sides: Floats, stop: float
) -> None:
    """Give a lane the constants of a cell; `stop` is the phase at which its run ends."""
    delta: float = max(sides[0, RESTITUTION], sides[1, RESTITUTION])
    load_sides(lanes, k, amplitude, frequency, sides)
    lanes[lane.CELL + k] = cell
    lanes[lane.ALLOWED + k] = log(sides[0, LEFT_OUT]) / LN2
    # Bounces are proved to end only if kappa, of the worse side, is (1 + delta)/2 at most.
    lanes[lane.CALMING + k] = DOUBT * (0.25 * (1.0 + delta) * (1.0 + delta) - delta * delta)
    lanes[lane.STOP + k] = stop
    lanes[lane.REF_PHASE + k] = math.inf
    lanes[lane.REF_VELOCITY + k] = math.inf
    lanes[lane.REF_IMPACTS + k] = -math.inf
    lanes[lane.LAG + k] = 0.0


@compiled
def put_lane(lanes: Floats, k: int, state: March, end_half: int) -> None:
    """Give a lane the state of a march in flight."""
    turn_to(lanes, k, state.side)
    phase, moved = side_phase(state.half_cycles, state.phase, state.side, lanes[lane.FREQUENCY + k])
    angle = state.side * state.angle / lanes[lane.LEAN + k]
    velocity = state.side * state.velocity / lanes[lane.UNIT + k]
    lanes[lane.PHASE + k] = phase
    lanes[lane.LEFT + k] = end_half - (state.half_cycles - moved)
    lanes[lane.START_ANGLE + k] = lanes[lane.ANGLE + k] = angle
    lanes[lane.VELOCITY + k] = lanes[lane.SPEED + k] = velocity
    lanes[lane.TIME + k] = 0.0
    lanes[lane.IMPACTS + k] = state.impacts
    lanes[lane.LIMIT + k] = NO_LIMIT
    lanes[lane.HALVINGS + k] = 0.0
    if state.flights > 0:  # of the march, whose areas are not counted
        lanes[lane.AREA + k] = UNKNOWN
    lanes[lane.STAGE + k] = lane.LANDED if angle == 0.0 else lane.FLYING
    if angle >= HALF_PI / lanes[lane.ALPHA + k] or (
        angle > lanes[lane.LOST + k] and velocity >= 0.0
    ):
        lanes[lane.STAGE + k] = lane.FALLEN


@compiled
def taken(lanes: Floats, k: int, end_half: int) -> March:
    """Return the state of a lane at the start of its flight, as the march has it."""
    side = int(lanes[lane.SIDE + k])
    turned, phase = clock(lanes[lane.PHASE + k])
    return March(
        side,
        side * lanes[lane.START_ANGLE + k] * lanes[lane.LEAN + k],
        side * lanes[lane.VELOCITY + k] * lanes[lane.UNIT + k],
        0,
        end_half - int(lanes[lane.LEFT + k]) + turned,
        phase,
        int(lanes[lane.IMPACTS + k]),
        0,
    )


@compiled
def at_the_end(lanes: Floats, k: int, end_half: int) -> March:
    """Return the state of a lane whose run has ended in mid flight."""
    side = int(lanes[lane.SIDE + k])
    return March(
        side,
        side * lanes[lane.ANGLE + k] * lanes[lane.LEAN + k],
        side * lanes[lane.SPEED + k] * lanes[lane.UNIT + k],
        0,
        end_half,
        lanes[lane.STOP + k],
        int(lanes[lane.IMPACTS + k]),
        0,
    )
