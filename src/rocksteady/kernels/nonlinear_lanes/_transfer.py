"""Transfer of cells and of states of the march into lanes, and back."""

import math

from rocksteady.kernels.core.clock import clock, side_phase
from rocksteady.kernels.core.tables import ALPHA as SIDE_ALPHA
from rocksteady.kernels.core.tables import LEFT_OUT, RESTITUTION, Floats, March
from rocksteady.kernels.elementary.circular import sincos_near
from rocksteady.kernels.elementary.inverse import atan2
from rocksteady.kernels.elementary.logarithm import LN2, log
from rocksteady.kernels.machine_code.compilation import compiled
from rocksteady.kernels.nonlinear.proofs import HALF_PI
from rocksteady.kernels.nonlinear_lanes._ends import NO_LIMIT
from rocksteady.kernels.nonlinear_lanes._layout import (
    ALLOWED,
    ALPHA,
    AMPLITUDE,
    ANGLE,
    CALMING,
    CELL,
    DELTA,
    DRIFT,
    FALLEN,
    FLAT,
    FLYING,
    FOOT_SINE,
    FOOT_SWING,
    FREQUENCY,
    HALVINGS,
    IMPACTS,
    INVERSE,
    LAG,
    LANDED,
    LEFT,
    LIMIT,
    LOST,
    PHASE,
    REF_IMPACTS,
    REF_PHASE,
    REF_VELOCITY,
    SPEED,
    SQUARE,
    STAGE,
    START_ANGLE,
    STOP,
    SWING_RATE,
    TIME,
    TURN,
    VELOCITY,
)

DOUBT = 1.0 + 1e-9
"""By which what lanes ask of a slow bounce is weaker than what the proof of rest does."""


@compiled
def load(
    lanes: Floats, k: int, cell: int, amplitude: float, frequency: float, side: Floats, stop: float
) -> None:
    """Give a lane the constants of a cell; `stop` is the phase at which its run ends."""
    alpha: float = side[SIDE_ALPHA]
    delta: float = side[RESTITUTION]
    lanes[CELL + k] = cell
    lanes[ALPHA + k] = alpha
    lanes[INVERSE + k] = 1.0 / alpha
    lanes[SQUARE + k] = alpha * alpha
    lanes[AMPLITUDE + k] = amplitude
    lanes[FREQUENCY + k] = frequency
    lanes[SWING_RATE + k] = amplitude * frequency
    lanes[TURN + k] = -frequency * frequency
    lanes[ALLOWED + k] = log(side[LEFT_OUT]) / LN2
    lanes[DELTA + k] = delta
    lost = 1.0 + atan2(alpha * amplitude, 1.0) / alpha
    flat = HALF_PI / alpha
    lanes[LOST + k] = lost
    # A block that lies on its side may be lost no sooner: then the march looks for the instant.
    lanes[FLAT + k] = flat if lost >= flat else math.inf
    sine, cosine = sincos_near(alpha)
    lanes[FOOT_SINE + k] = sine / alpha
    lanes[FOOT_SWING + k] = amplitude * cosine
    # Bounces are proved to end only if kappa, of the worse side, is (1 + delta)/2 at most.
    drift = amplitude * frequency * (cosine + alpha * sine)
    lanes[DRIFT + k] = 4.0 * drift * (delta * delta)
    lanes[CALMING + k] = DOUBT * (0.25 * (1.0 + delta) * (1.0 + delta) - delta * delta)
    lanes[STOP + k] = stop
    lanes[REF_PHASE + k] = math.inf
    lanes[REF_VELOCITY + k] = math.inf
    lanes[REF_IMPACTS + k] = math.inf
    lanes[LAG + k] = 0.0


@compiled
def put_lane(lanes: Floats, k: int, state: March, end_half: int) -> None:
    """Give a lane the state of a march in flight."""
    phase, moved = side_phase(state.half_cycles, state.phase, state.side, lanes[FREQUENCY + k])
    angle, velocity = state.side * state.angle, state.side * state.velocity
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
    base = end_half - int(lanes[LEFT + k])
    side = 1 if base % 2 == 0 else -1
    turned, phase = clock(lanes[PHASE + k])
    return March(
        side,
        side * lanes[START_ANGLE + k],
        side * lanes[VELOCITY + k],
        0,
        base + turned,
        phase,
        int(lanes[IMPACTS + k]),
        0,
    )


@compiled
def at_the_end(lanes: Floats, k: int, end_half: int) -> March:
    """Return the state of a lane whose run has ended in mid flight."""
    start = taken(lanes, k, end_half)
    return March(
        start.side,
        start.side * lanes[ANGLE + k],
        start.side * lanes[SPEED + k],
        0,
        end_half,
        lanes[STOP + k],
        start.impacts,
        0,
    )
