"""Fields and Taylor rows of the lanes, as offsets into one flat array, and the stages of a lane."""

from rocksteady.kernels.batch import arrival
from rocksteady.kernels.machine_code.width import side_by_side

# 16 or fewer lanes would be unrolled and stay scalar; more than 32 leave the first cache.
LANES = side_by_side(32)

HIGHEST = 23
"""Degree of a step's polynomial, an odd one: coefficients are summed two at a time."""
TERMS = HIGHEST + 1
TOP = 10
"""Degree up to which its signs are looked at; the terms above are a doubt about them."""

# Stages of a lane.
EMPTY = 0.0
FLYING = 1.0
LANDED = 2.0  # flying, from an impact that is to be compared with earlier ones
SLOW = 3.0  # the same, and so slow that it may come to rest
LEAVE = arrival.LEAVE  # for the march: one flight
ENDED = 5.0  # the run is over, in mid flight
FALLEN = arrival.FALLEN
GIVEN_UP = 7.0
ASTRAY = arrival.ASTRAY

# Fields of the side that a lane's block is on.
(
    ALPHA,
    INVERSE,  # 1/alpha
    SQUARE,  # alpha^2
    AMPLITUDE,
    FREQUENCY,
    SWING_RATE,
    TURN,  # -Omega^2
    LEAN,
    UNIT,  # of velocity: lean times rate
    ACROSS,  # this unit over that of the other side
    DELTA,
    LOST,
    FLAT,
    FOOT_SINE,
    FOOT_SWING,
    DRIFT,
) = range(0, 16 * LANES, LANES)
SIDED = 16 * LANES
DIFFERENCE = SIDED
"""How much farther on stands what makes a field that of the other side: `core.other_side`."""

# Fields of a lane.
(
    FORCE,  # accumulators of a coefficient of h C, ...
    BY_COSINE,  # ... of y' C ...
    BY_SINE,  # ... and of y' S
    NEXT_FORCE,  # and those of the next order
    NEXT_BY_COSINE,
    NEXT_BY_SINE,
    STAGE,
    CHANGING,
    CELL,
    SIDE,
    APART,  # what is added to a phase on the one side, taken off it on the other, to tell them
    ALLOWED,  # log2 of what a step may leave out
    CALMING,
    STOP,
    LEFT,
    IMPACTS,
    PHASE,
    START_ANGLE,
    VELOCITY,
    TIME,
    ANGLE,
    SPEED,
    LIMIT,
    HALVINGS,
    STEP,
    REMAINING,  # side time to the end of the run
    TOTAL,  # of the moduli of the terms up to the TOP, ...
    REST,  # ... of those above ...
    CURVING,  # ... and of the terms of y''
    POWER,
    CHANGES,
    PLACE,
    LOW,
    HIGH,
    OPEN,
    VALUE,
    SLOPE,
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
    MOST,  # impacts of a motion that is followed to its orbit
) = range(2 * SIDED, 2 * SIDED + 51 * LANES, LANES)
FIELDS = 2 * SIDED // LANES + 51

_OWN = STAGE, CELL, PHASE, VELOCITY, LEFT, IMPACTS, MOST, DELTA, TIME
PLACES = arrival.places_of(LANES, *_OWN, reference=REF_PHASE)
"""Of what an approach to an orbit takes; no lane on such a way leaps over periods."""

# Rows of Taylor coefficients, one for each power of time.
SHAKING = FIELDS * LANES  # of h
SPEEDS = SHAKING + TERMS * LANES  # of y'
COSINES = SPEEDS + TERMS * LANES  # of C
SINES = COSINES + TERMS * LANES  # of S
SIZE = SINES + TERMS * LANES
# Once the coefficients are known, two of them make room.
TAYLOR = SINES  # of y, times powers of the step
POINTS = SHAKING  # of its control points

OFFSETS = (1 << 20) - 1
"""A mask by which the compiler sees that an offset is not negative."""
