"""Transfer of cells and of states of the march into lanes, and back."""

import math

from rocksteady.kernels.core.clock import clock, side_phase
from rocksteady.kernels.core.tables import LEAN, Floats, March
from rocksteady.kernels.elementary.circular import sincos_near
from rocksteady.kernels.lanes import _fields as lane
from rocksteady.kernels.lanes._both_sides import leaving, load_sides, row_of, turn_to, unit_of
from rocksteady.kernels.machine_code.compilation import compiled
from rocksteady.kernels.machine_code.types import Floats2


@compiled
def load(
    lanes: Floats,
    j: int,
    cell: int,
    amplitude: float,
    frequency: float,
    sides: Floats2,
    stop: float,
) -> None:
    """Give a lane the constants of a cell; `stop` is the phase at which its run ends."""
    load_sides(lanes, j, amplitude, frequency, sides)
    lanes[lane.CELL + j] = cell
    lanes[lane.STOP + j] = stop
    lanes[lane.STOP_SINE + j], lanes[lane.STOP_COSINE + j] = sincos_near(stop)
    lanes[lane.REF_PHASE + j] = math.inf
    lanes[lane.REF_VELOCITY + j] = math.inf
    lanes[lane.REF_IMPACTS + j] = -math.inf
    lanes[lane.LAG + j] = 0.0


@compiled
def put_lane(lanes: Floats, j: int, state: March, end_half: int, sides: Floats2) -> None:
    """Give a lane the state of a march that is in flight from the floor."""
    turn_to(lanes, j, state.side)
    frequency = lanes[lane.FREQUENCY + j]
    phase, moved = side_phase(state.half_cycles, state.phase, state.side, frequency)
    lanes[lane.PHASE + j] = phase
    lanes[lane.LEFT + j] = end_half - (state.half_cycles - moved)
    velocity = state.side * state.velocity / unit_of(sides, row_of(state.side))
    lanes[lane.VELOCITY + j] = leaving(velocity) if lanes[lane.APART + j] < 0.0 else velocity
    lanes[lane.IMPACTS + j] = state.impacts
    lanes[lane.SINE + j], lanes[lane.COSINE + j] = sincos_near(phase)
    lanes[lane.TIME + j] = 0.0
    lanes[lane.STAGE + j] = lane.LAUNCH


@compiled
def taken(lanes: Floats, j: int, end_half: int, sides: Floats2) -> March:
    """Return the state of a lane at the start of its flight, as the march has it."""
    base = end_half - int(lanes[lane.LEFT + j])
    side = 1 if base % 2 == 0 else -1
    turned, phase = clock(lanes[lane.PHASE + j])
    return March(
        side,
        0.0,
        side * lanes[lane.VELOCITY + j] * unit_of(sides, row_of(side)),
        0,
        base + turned,
        phase,
        int(lanes[lane.IMPACTS + j]),
        0,
    )


@compiled
def at_the_end(lanes: Floats, j: int, end_half: int, sides: Floats2) -> March:
    """Return the state of a lane whose run has ended in mid flight."""
    start = taken(lanes, j, end_half, sides)
    row = row_of(start.side)
    return March(
        start.side,
        start.side * lanes[lane.START_ANGLE + j] * sides[row, LEAN],
        start.side * lanes[lane.START_VELOCITY + j] * unit_of(sides, row),
        0,
        end_half,
        lanes[lane.STOP + j],
        start.impacts,
        0,
    )
