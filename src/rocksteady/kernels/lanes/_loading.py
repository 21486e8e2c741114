"""Transfer of cells and of states of the march into lanes, and back."""

import math

from rocksteady.kernels.core.clock import PI_HIGH, clock, side_phase
from rocksteady.kernels.core.forcing import make_forcing
from rocksteady.kernels.core.tables import Floats, March
from rocksteady.kernels.elementary.circular import sincos_near
from rocksteady.kernels.lanes._exp_sincos import growth_and_decay
from rocksteady.kernels.lanes._fields import (
    AHEAD,
    AMPLITUDE,
    BETA,
    CALMING,
    CELL,
    COSINE,
    DECAY_AHEAD,
    DELTA,
    EXCESS,
    FARTHEST,
    FREQUENCY,
    GROWTH_AHEAD,
    IMPACTS,
    INVERSE,
    LAG,
    LAUNCH,
    LEFT,
    NODE_COSINE,
    NODE_SINE,
    PHASE,
    REF_IMPACTS,
    REF_PHASE,
    REF_VELOCITY,
    RISING,
    SINE,
    SIZE,
    SQUARE,
    STAGE,
    START_ANGLE,
    START_VELOCITY,
    STOP,
    STOP_COSINE,
    STOP_SINE,
    SWING_RATE,
    TIME,
    VELOCITY,
)
from rocksteady.kernels.machine_code.compilation import compiled


@compiled
def load(
    lanes: Floats, j: int, cell: int, amplitude: float, frequency: float, delta: float, stop: float
) -> None:
    """Give a lane the constants of a cell; `stop` is the phase at which its run ends."""
    forcing = make_forcing(-1.0, 0.0, amplitude, frequency)
    lanes[CELL + j] = cell
    lanes[AMPLITUDE + j] = amplitude
    lanes[FREQUENCY + j] = frequency
    lanes[INVERSE + j] = 1.0 / frequency
    lanes[SQUARE + j] = frequency * frequency
    lanes[SWING_RATE + j] = amplitude * frequency
    lanes[BETA + j] = forcing.beta
    lanes[SIZE + j] = 1.0 + forcing.beta * (1.0 + frequency)
    lanes[DELTA + j] = delta
    # From the bound of the rest with c = c_0, v << c: above it there is no need to ask.
    lanes[CALMING + j] = 1.5 * (1.0 - delta) / delta
    lanes[EXCESS + j] = forcing.swing - 1.0
    lanes[RISING + j] = forcing.rising
    lanes[NODE_SINE + j] = forcing.node_sine
    lanes[NODE_COSINE + j] = forcing.node_cosine
    ahead = PI_HIGH - 2.0 * forcing.rising
    lanes[AHEAD + j] = ahead
    lanes[GROWTH_AHEAD + j], lanes[DECAY_AHEAD + j] = growth_and_decay(
        min(ahead / frequency, FARTHEST)
    )
    lanes[STOP + j] = stop
    lanes[STOP_SINE + j], lanes[STOP_COSINE + j] = sincos_near(stop)
    lanes[REF_PHASE + j] = math.inf
    lanes[REF_VELOCITY + j] = math.inf
    lanes[REF_IMPACTS + j] = math.inf
    lanes[LAG + j] = 0.0


@compiled
def put_lane(lanes: Floats, j: int, state: March, end_half: int) -> None:
    """Give a lane the state of a march that is in flight from the floor."""
    frequency = lanes[FREQUENCY + j]
    phase, moved = side_phase(state.half_cycles, state.phase, state.side, frequency)
    lanes[PHASE + j] = phase
    lanes[LEFT + j] = end_half - (state.half_cycles - moved)
    lanes[VELOCITY + j] = state.side * state.velocity
    lanes[IMPACTS + j] = state.impacts
    lanes[SINE + j], lanes[COSINE + j] = sincos_near(phase)
    lanes[TIME + j] = 0.0
    lanes[STAGE + j] = LAUNCH


@compiled
def taken(lanes: Floats, j: int, end_half: int) -> March:
    """Return the state of a lane at the start of its flight, as the march has it."""
    base = end_half - int(lanes[LEFT + j])
    side = 1 if base % 2 == 0 else -1
    turned, phase = clock(lanes[PHASE + j])
    return March(
        side,
        0.0,
        side * lanes[VELOCITY + j],
        0,
        base + turned,
        phase,
        int(lanes[IMPACTS + j]),
        0,
    )


@compiled
def at_the_end(lanes: Floats, j: int, end_half: int) -> March:
    """Return the state of a lane whose run has ended in mid flight."""
    start = taken(lanes, j, end_half)
    return March(
        start.side,
        start.side * lanes[START_ANGLE + j],
        start.side * lanes[START_VELOCITY + j],
        0,
        end_half,
        lanes[STOP + j],
        start.impacts,
        0,
    )
