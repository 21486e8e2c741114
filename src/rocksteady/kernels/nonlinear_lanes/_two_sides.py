"""Constants of the two sides of a block, those of the side it is on first."""

import math

from rocksteady.kernels.core.tables import ALPHA, LEAN, RATE, RESTITUTION, Floats
from rocksteady.kernels.elementary.circular import sincos_near
from rocksteady.kernels.elementary.inverse import atan2
from rocksteady.kernels.machine_code.compilation import compiled
from rocksteady.kernels.nonlinear.proofs import HALF_PI
from rocksteady.kernels.nonlinear_lanes import _layout as lane
from rocksteady.kernels.nonlinear_lanes._layout import LANES, OFFSETS, SIDED

FAR = 8.0
"""Of the phases on the two sides of an unlike block, so that no state on one is like the other."""


@compiled
def unlike(sides: Floats) -> bool:
    """Return whether the two sides of a block differ."""
    found = False
    for column in range(sides.shape[1]):
        found = found or sides[0, column] != sides[1, column]
    return found


@compiled
def load_sides(lanes: Floats, k: int, amplitude: float, frequency: float, sides: Floats) -> None:
    """Give a lane the constants of both sides, the positive one first."""
    load_side(lanes, k, amplitude, frequency, sides, 0)
    load_side(lanes, k + lane.OTHER, amplitude, frequency, sides, 1)
    lanes[lane.SIDE + k] = 1.0
    lanes[lane.APART + k] = FAR if unlike(sides) else 0.0


@compiled
def load_side(
    lanes: Floats, k: int, amplitude: float, frequency: float, sides: Floats, row: int
) -> None:
    """Fill the constants of one side, with shaking in its units."""
    delta: float = max(sides[0, RESTITUTION], sides[1, RESTITUTION])
    alpha: float = sides[row, ALPHA]
    unit: float = sides[row, LEAN] * sides[row, RATE]
    amplitude /= sides[row, LEAN]
    frequency /= sides[row, RATE]
    lanes[lane.ALPHA + k] = alpha
    lanes[lane.INVERSE + k] = 1.0 / alpha
    lanes[lane.SQUARE + k] = alpha * alpha
    lanes[lane.AMPLITUDE + k] = amplitude
    lanes[lane.FREQUENCY + k] = frequency
    lanes[lane.SWING_RATE + k] = amplitude * frequency
    lanes[lane.TURN + k] = -frequency * frequency
    lanes[lane.LEAN + k] = sides[row, LEAN]
    lanes[lane.UNIT + k] = unit
    lanes[lane.ACROSS + k] = unit / (sides[1 - row, LEAN] * sides[1 - row, RATE])
    lanes[lane.DELTA + k] = sides[row, RESTITUTION]
    lost = 1.0 + atan2(alpha * amplitude, 1.0) / alpha
    flat = HALF_PI / alpha
    lanes[lane.LOST + k] = lost
    # A block that lies on its side may be lost no sooner: then the march looks for the instant.
    lanes[lane.FLAT + k] = flat if lost >= flat else math.inf
    sine, cosine = sincos_near(alpha)
    lanes[lane.FOOT_SINE + k] = sine / alpha
    lanes[lane.FOOT_SWING + k] = amplitude * cosine
    drift = amplitude * frequency * (cosine + alpha * sine)
    lanes[lane.DRIFT + k] = 4.0 * drift * (delta * delta)


@compiled
def change_sides(lanes: Floats) -> None:
    """Give the lanes that have just landed the constants of the side that they are on now."""
    for field in range(0, SIDED, LANES):
        here = field & OFFSETS
        for k in range(LANES):
            stage = lanes[lane.STAGE + k]
            landed = (stage == lane.LANDED) | (stage == lane.SLOW)
            left, reached = lanes[here + k], lanes[lane.OTHER + here + k]
            lanes[here + k] = reached if landed else left
            lanes[lane.OTHER + here + k] = left if landed else reached


@compiled
def turn_to(lanes: Floats, k: int, side: int) -> None:
    """Give a lane the constants of this side."""
    if side != lanes[lane.SIDE + k]:
        lanes[lane.SIDE + k] = side
        for field in range(k, SIDED, LANES):
            lanes[field], lanes[lane.OTHER + field] = lanes[lane.OTHER + field], lanes[field]
