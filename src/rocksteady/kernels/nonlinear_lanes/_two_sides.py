"""Constants of the two sides of a block, those of the side it is on first."""

import math

from rocksteady.kernels.core.other_side import (
    difference,
    exchanged,
    mask_of,
    put_differences,
    turn_over,
    unlike,
)
from rocksteady.kernels.core.tables import ALPHA, LEAN, RATE, RESTITUTION, Floats
from rocksteady.kernels.elementary.circular import sincos_near
from rocksteady.kernels.elementary.inverse import atan2
from rocksteady.kernels.machine_code.compilation import compiled, inlined
from rocksteady.kernels.nonlinear.proofs import HALF_PI
from rocksteady.kernels.nonlinear_lanes import _layout as lane
from rocksteady.kernels.nonlinear_lanes._layout import LANES, OFFSETS, SIDED

FAR = 8.0
"""Of the phases on the two sides of an unlike block, so that no state on one is like the other."""


@compiled
def load_sides(lanes: Floats, k: int, amplitude: float, frequency: float, sides: Floats) -> None:
    """Give a lane the constants of both sides, the positive one first."""
    load_side(lanes, k, amplitude, frequency, sides, 0)
    load_side(lanes, k + lane.DIFFERENCE, amplitude, frequency, sides, 1)
    put_differences(lanes, SIDED, LANES, k)
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


@inlined
def other(lanes: Floats, k: int, field: int) -> float:
    """Return a field of the side that a lane's block is not on."""
    return difference(lanes[field + k], lanes[lane.DIFFERENCE + field + k])


@compiled
def change_sides(lanes: Floats) -> None:
    """Give the lanes that have just landed the constants of the side that they are on now."""
    for k in range(LANES):
        stage = lanes[lane.STAGE + k]
        landed = (stage == lane.LANDED) | (stage == lane.SLOW)
        lanes[lane.CHANGING + k] = mask_of(landed)
    for field in range(0, SIDED, LANES):
        here = field & OFFSETS
        for k in range(LANES):
            lanes[here + k] = exchanged(
                lanes[here + k], lanes[lane.DIFFERENCE + here + k], lanes[lane.CHANGING + k]
            )


@compiled
def turn_to(lanes: Floats, k: int, side: int) -> None:
    """Give a lane the constants of this side."""
    if side != lanes[lane.SIDE + k]:
        lanes[lane.SIDE + k] = side
        turn_over(lanes, SIDED, LANES, k)
