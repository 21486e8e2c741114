"""Transfer of cells and of states of the march into lanes, and back."""

import math

from rocksteady.kernels.core.clock import PI_HIGH, clock, side_phase
from rocksteady.kernels.core.forcing import make_forcing
from rocksteady.kernels.core.tables import Floats, March
from rocksteady.kernels.elementary.circular import sincos_near
from rocksteady.kernels.lanes import _fields as lane
from rocksteady.kernels.lanes._exp_sincos import growth_and_decay
from rocksteady.kernels.lanes._fields import FARTHEST
from rocksteady.kernels.machine_code.compilation import compiled


@compiled
def load(
    lanes: Floats, j: int, cell: int, amplitude: float, frequency: float, delta: float, stop: float
) -> None:
    """Give a lane the constants of a cell; `stop` is the phase at which its run ends."""
    forcing = make_forcing(-1.0, 0.0, amplitude, frequency)
    lanes[lane.CELL + j] = cell
    lanes[lane.AMPLITUDE + j] = amplitude
    lanes[lane.FREQUENCY + j] = frequency
    lanes[lane.INVERSE + j] = 1.0 / frequency
    lanes[lane.SQUARE + j] = frequency * frequency
    lanes[lane.SWING_RATE + j] = amplitude * frequency
    lanes[lane.BETA + j] = forcing.beta
    lanes[lane.SIZE + j] = 1.0 + forcing.beta * (1.0 + frequency)
    lanes[lane.DELTA + j] = delta
    # From the bound of the rest with c = c_0, v << c: above it there is no need to ask.
    lanes[lane.CALMING + j] = 1.5 * (1.0 - delta) / delta
    lanes[lane.EXCESS + j] = forcing.swing - 1.0
    lanes[lane.RISING + j] = forcing.rising
    lanes[lane.NODE_SINE + j] = forcing.node_sine
    lanes[lane.NODE_COSINE + j] = forcing.node_cosine
    ahead = PI_HIGH - 2.0 * forcing.rising
    lanes[lane.AHEAD + j] = ahead
    lanes[lane.GROWTH_AHEAD + j], lanes[lane.DECAY_AHEAD + j] = growth_and_decay(
        min(ahead / frequency, FARTHEST)
    )
    lanes[lane.STOP + j] = stop
    lanes[lane.STOP_SINE + j], lanes[lane.STOP_COSINE + j] = sincos_near(stop)
    lanes[lane.REF_PHASE + j] = math.inf
    lanes[lane.REF_VELOCITY + j] = math.inf
    lanes[lane.REF_IMPACTS + j] = math.inf
    lanes[lane.LAG + j] = 0.0


@compiled
def put_lane(lanes: Floats, j: int, state: March, end_half: int) -> None:
    """Give a lane the state of a march that is in flight from the floor."""
    frequency = lanes[lane.FREQUENCY + j]
    phase, moved = side_phase(state.half_cycles, state.phase, state.side, frequency)
    lanes[lane.PHASE + j] = phase
    lanes[lane.LEFT + j] = end_half - (state.half_cycles - moved)
    lanes[lane.VELOCITY + j] = state.side * state.velocity
    lanes[lane.IMPACTS + j] = state.impacts
    lanes[lane.SINE + j], lanes[lane.COSINE + j] = sincos_near(phase)
    lanes[lane.TIME + j] = 0.0
    lanes[lane.STAGE + j] = lane.LAUNCH


@compiled
def taken(lanes: Floats, j: int, end_half: int) -> March:
    """Return the state of a lane at the start of its flight, as the march has it."""
    base = end_half - int(lanes[lane.LEFT + j])
    side = 1 if base % 2 == 0 else -1
    turned, phase = clock(lanes[lane.PHASE + j])
    return March(
        side,
        0.0,
        side * lanes[lane.VELOCITY + j],
        0,
        base + turned,
        phase,
        int(lanes[lane.IMPACTS + j]),
        0,
    )


@compiled
def at_the_end(lanes: Floats, j: int, end_half: int) -> March:
    """Return the state of a lane whose run has ended in mid flight."""
    start = taken(lanes, j, end_half)
    return March(
        start.side,
        start.side * lanes[lane.START_ANGLE + j],
        start.side * lanes[lane.START_VELOCITY + j],
        0,
        end_half,
        lanes[lane.STOP + j],
        start.impacts,
        0,
    )
