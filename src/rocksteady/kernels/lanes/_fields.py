"""Fields of a lane's state, and the codes of its stages."""

from rocksteady.kernels.batch import arrival
from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.machine_code.compilation import inlined
from rocksteady.kernels.machine_code.width import side_by_side

# 16 or fewer lanes would be unrolled and stay scalar; more than 64 leave the first cache.
LANES = side_by_side(48)
GROUP = side_by_side(8)
"""Lanes of one vector, or of several; loops go over so many of these as have work: `working`."""

# Stages of a lane, in the order in which the loops tell them apart.
EMPTY = 0.0
LAUNCH = 1.0  # at the start of a flight from the floor
LIFTED = 2.0  # the same, from rest on the other side
LANDED = 3.0  # the same, after an impact
SPECIAL = 3.5  # the same, and slow or near the end of the run
LEAVE = arrival.LEAVE  # for the march: one flight
ENDED = 5.0  # the run is over, in mid flight
FALLEN = arrival.FALLEN
RESTED = 7.0  # for the march, at rest
DOWN = 8.0  # the end of a piece with r < 0 is to be looked at
UP = 9.0  # the same with r > 0
POLISH = 14.0  # from a guess; the steps are counted on, to one of the `LAST_STEPS`
KNOWN = 20.0  # the same, to a zero that is known to be there
SHORT = 34.0  # the same, by Taylor's polynomial
LAST_STEPS = (19.0, 29.0, 39.0)

# The census: how many lanes are at each kind of stage, in one whole number.
MANY = 255
NODES_BITS = 8
SHORTS_BITS = 16
WAITING_BITS = 24
SPECIALS_BITS = 32

# Fields of the lanes, as offsets into one flat array: of the side that a block is on ...
(
    AMPLITUDE,
    FREQUENCY,
    INVERSE,
    BETA,
    DELTA,
    EXCESS,
    RISING,
    NODE_SINE,
    NODE_COSINE,
    GROWTH_AHEAD,
    DECAY_AHEAD,
    ACROSS,  # its unit of velocity over that of the other side
) = range(0, 12 * LANES, LANES)
SIDED = 12 * LANES
DIFFERENCE = SIDED
"""How much farther on stands what makes a field that of the other side: `core.other_side`."""
# ... and of the lane.
(
    STAGE,
    SIDE,
    APART,  # what is added to a phase on the one side, taken off it on the other; < 0 by a wall
    OTHER_TIME,
    STOP,
    STOP_SINE,
    STOP_COSINE,
    CELL,
    LEFT,
    IMPACTS,
    PHASE,
    SINE,
    COSINE,
    VELOCITY,
    GROWING,
    START_PHASE,
    END_PHASE,
    ENDING,
    START_ANGLE,
    START_VELOCITY,
    TIME,
    GUESS,
    SINE_THERE,
    COSINE_THERE,
    GROWN,
    ANGLE_THERE,
    VELOCITY_THERE,
    REACHED,
    OUTCOME,
    NEXT_ANGLE,
    NEXT_VELOCITY,
    NEXT_DOUBT,
    STEP,
    LIMIT,
    REF_PHASE,  # the reference, and ...
    REF_VELOCITY,
    REF_LEFT,
    REF_IMPACTS,
    LAG,
    WIDEST,
    PRODUCT,  # ... the law of the returns, as `core.returns` has them
    LAST_SQUARE,
    AREA,
    LAST_PHASE,
    LAST_VELOCITY,
    BEFORE_PHASE,
    BEFORE_VELOCITY,
    GROUPS,  # how many groups have work, in the first lane
) = range(2 * SIDED, 2 * SIDED + 48 * LANES, LANES)
FIELDS = 2 * SIDED // LANES + 48

_OWN = STAGE, CELL, PHASE, VELOCITY, LEFT, IMPACTS, LIMIT, DELTA, TIME
PLACES = arrival.places_of(LANES, *_OWN, reference=REF_PHASE)
"""Of what an approach to an orbit takes; no lane on such a way leaps over periods."""

LOSS = 2.0**-49  # sixteen roundings: what a computed number may be off, in units of its terms
FARTHEST = 100.0  # further ahead nothing is known: squares of what has grown are to stay finite
UNKNOWN = 1e140  # a doubt above all that can have grown


@inlined
def working(lanes: Floats) -> int:
    """Return how many lanes a loop goes over: all others are empty.

    By the mask the compiler sees that it is no negative number, and that vectors leave no rest.
    """
    return GROUP * (int(lanes[GROUPS]) & 7)


@inlined
def weight(stage: float) -> int:
    """Return what a lane adds to the census."""
    number = 1 if stage > 0.0 else 0
    number = 1 << SPECIALS_BITS if stage == SPECIAL else number
    number = 1 << WAITING_BITS if stage >= LEAVE else number
    number = 1 << NODES_BITS if stage >= DOWN else number
    number = 1 if stage >= POLISH else number
    return 1 << SHORTS_BITS if stage >= SHORT else number
