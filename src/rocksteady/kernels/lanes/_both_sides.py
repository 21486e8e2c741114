"""Constants of the two sides of a block, or of the one off a wall, and the turn to the other.

What is a product or a sum of others is computed where it is used: exchanging 12 constants at an
impact takes half of the time of 17.
"""

from rocksteady.kernels.core.clock import PI_HIGH
from rocksteady.kernels.core.forcing import HALF_PI, make_forcing
from rocksteady.kernels.core.other_side import (
    difference,
    exchanged,
    mask_of,
    put_differences,
    turn_over,
    unlike,
)
from rocksteady.kernels.core.tables import LEAN, RATE, RESTITUTION, Floats, free_side
from rocksteady.kernels.lanes import _fields as lane
from rocksteady.kernels.lanes._exp_sincos import growth_and_decay
from rocksteady.kernels.lanes._fields import DIFFERENCE, FARTHEST, LANES, SIDED, working
from rocksteady.kernels.machine_code.compilation import compiled, inlined
from rocksteady.kernels.machine_code.types import Floats2
from rocksteady.kernels.march.rest import STILL

FAR = 8.0
"""Of the phases on the two sides of an unlike block, so that no state on one is like the other."""


@compiled
def load_sides(lanes: Floats, j: int, amplitude: float, frequency: float, sides: Floats2) -> None:
    """Give a lane the constants of both sides, the positive one or that off the wall first."""
    free = free_side(sides)
    first = 1 if free < 0 else 0
    apart = unlike(sides)
    load_side(lanes, j, amplitude, frequency, sides, first)
    if apart and free == 0:
        load_side(lanes, j + DIFFERENCE, amplitude, frequency, sides, 1)
        put_differences(lanes, SIDED, LANES, j)
    else:
        lanes[lane.ACROSS + j] = 1.0
        for field in range(j + DIFFERENCE, j + DIFFERENCE + SIDED, LANES):
            lanes[field] = 0.0
        if free != 0:
            lanes[lane.AMPLITUDE + DIFFERENCE + j] = lanes[lane.AMPLITUDE + j]
    lanes[lane.SIDE + j] = -1.0 if free < 0 else 1.0
    lanes[lane.OTHER_TIME + j] = 0.0
    lanes[lane.APART + j] = (FAR if free == 0 else -FAR) if apart else 0.0


@compiled
def load_side(
    lanes: Floats, j: int, amplitude: float, frequency: float, sides: Floats2, row: int
) -> None:
    """Fill the constants of one side, with shaking in its units."""
    frequency /= sides[row, RATE]
    forcing = make_forcing(-1.0, 0.0, amplitude / sides[row, LEAN], frequency)
    lanes[lane.AMPLITUDE + j] = forcing.amplitude
    lanes[lane.FREQUENCY + j] = frequency
    lanes[lane.INVERSE + j] = 1.0 / frequency
    lanes[lane.BETA + j] = forcing.beta
    lanes[lane.DELTA + j] = abs(sides[row, RESTITUTION])
    lanes[lane.EXCESS + j] = forcing.swing - 1.0
    lanes[lane.RISING + j] = forcing.rising
    lanes[lane.NODE_SINE + j] = forcing.node_sine
    lanes[lane.NODE_COSINE + j] = forcing.node_cosine
    ahead = PI_HIGH - 2.0 * forcing.rising
    lanes[lane.GROWTH_AHEAD + j], lanes[lane.DECAY_AHEAD + j] = growth_and_decay(
        min(ahead / frequency, FARTHEST)
    )
    lanes[lane.ACROSS + j] = unit_of(sides, row) / unit_of(sides, 1 - row)


@inlined
def other(lanes: Floats, j: int, field: int) -> float:
    """Return a field of the side that a lane's block is not on."""
    return difference(lanes[field + j], lanes[DIFFERENCE + field + j])


@compiled
def row_of(side: int) -> int:
    """Return the row of a side in its table."""
    return 0 if side > 0 else 1


@compiled
def unit_of(sides: Floats2, row: int) -> float:
    """Return the unit of velocity on a side."""
    unit: float = sides[row, LEAN] * sides[row, RATE]
    return unit


@compiled
def change_sides(lanes: Floats) -> None:
    """Give the lanes that have just come to another side its constants; turn back from a wall."""
    for j in range(working(lanes)):
        stage = lanes[lane.STAGE + j]
        apart = lanes[lane.APART + j]
        landed = stage == lane.LANDED
        turns = (landed | (stage == lane.LIFTED)) & (apart > 0.0)
        back = landed & (apart < 0.0)
        phase, velocity = lanes[lane.PHASE + j], lanes[lane.VELOCITY + j]
        side, left = lanes[lane.SIDE + j], lanes[lane.LEFT + j]
        sine, cosine = lanes[lane.SINE + j], lanes[lane.COSINE + j]
        time, other_time = lanes[lane.TIME + j], lanes[lane.OTHER_TIME + j]
        across = velocity * lanes[lane.ACROSS + j]
        bounced = leaving(velocity)
        further = 1.0 if phase < HALF_PI else -1.0
        moved = phase + further * PI_HIGH
        kept = bounced if back else velocity
        changes = mask_of(turns)
        for field in range(0, SIDED, LANES):
            here = field + j
            lanes[here] = exchanged(lanes[here], lanes[DIFFERENCE + here], changes)
        lanes[lane.SIDE + j] = -side if turns else side
        lanes[lane.TIME + j] = other_time if turns else time
        lanes[lane.OTHER_TIME + j] = time if turns else other_time
        lanes[lane.VELOCITY + j] = across if turns else kept
        lanes[lane.PHASE + j] = moved if back else phase
        lanes[lane.LEFT + j] = left + further if back else left
        lanes[lane.SINE + j] = -sine if back else sine
        lanes[lane.COSINE + j] = -cosine if back else cosine


@inlined
def leaving(velocity: float) -> float:
    """Return a velocity after an impact on a wall, which may give nothing back; 0 is uplift."""
    return max(velocity, STILL)


@compiled
def turn_to(lanes: Floats, j: int, side: int) -> None:
    """Give a lane the constants of this side."""
    if side != lanes[lane.SIDE + j]:
        lanes[lane.SIDE + j] = side
        turn_over(lanes, SIDED, LANES, j)
