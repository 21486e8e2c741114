"""Blocks on one record in lanes: what spectra, suites of records and ensembles run.

Each lane holds a block in flight within a sample of its own.  One pass takes all lanes through the
rest of their samples, by the same products as the march, where that needs no search: there is no
landing in it and no peak, and it ends below the point of balance (`nonlinear.sample_lanes`).
Lanes that do not pass wait until a third of them do so.  Then one longer pass finds all their
landings, by a search of fixed length, and a sample that is too long for a short step takes the
series.  A lane that waits for anything else is given to the march, which takes it through one
flight, rest or doubt, and gives it back.  So there is one code for all that is rare, and lanes come
to the numbers of the march to the last bit.

They are for the nonlinear model.  In the linear one a plain sample is a few products, less than it
takes to give a lane to the march and back.
"""

from rocksteady.kernels.core import rides
from rocksteady.kernels.core import tables as columns
from rocksteady.kernels.core.impacts import rebound
from rocksteady.kernels.core.tables import Floats, March, left_out_of, speed_in_unit
from rocksteady.kernels.core.tuples import Tables
from rocksteady.kernels.machine_code.compilation import compiled, inlined
from rocksteady.kernels.machine_code.types import Floats2, Floats3, Integers2
from rocksteady.kernels.nonlinear import sample_lanes as lane
from rocksteady.kernels.nonlinear.proofs import HALF_PI
from rocksteady.kernels.nonlinear.sample_lanes import LANES, land_lanes, pass_coarse, step_lanes

FEW = 8
"""Lanes in use below which the march alone is faster."""
OFFSETS = (1 << 40) - 1
"""A mask by which the compiler sees that a segment is not negative."""

# Rows of whole numbers of a lane.
CELL = 0  # -1: none
SIDE = 1
SEGMENT = 2
IMPACTS = 3
FLIGHTS = 4
WHOLES = 5


@compiled
def empty_lanes(lanes: Floats, wholes: Integers2) -> None:
    """Make lanes that hold no block: they step too, and their numbers stay finite."""
    lanes[:] = 0.0
    for j in range(LANES):
        wholes[CELL, j] = -1
        lanes[lane.ALPHA + j] = lanes[lane.RATE + j] = lanes[lane.FLAT + j] = 1.0


@compiled
def put_flight(
    lanes: Floats, wholes: Integers2, j: int, tables: Tables, state: March, ride: Floats
) -> None:
    """Put a held flight into a lane."""
    segments, sides = tables
    wholes[SEGMENT, j] = state.segment
    wholes[IMPACTS, j], wholes[FLIGHTS, j] = state.impacts, state.flights
    lanes[lane.ANGLE + j], lanes[lane.VELOCITY + j] = ride[rides.ANGLE], ride[rides.VELOCITY]
    lanes[lane.TOP_ANGLE + j] = ride[rides.TOP_ANGLE]
    lanes[lane.TOP_SPEED + j] = ride[rides.TOP_SPEED]
    lanes[lane.PHASE + j], lanes[lane.PASSES + j] = state.phase, 1.0
    lanes[lane.DURATION + j] = segments[state.segment, columns.DURATION]
    lanes[lane.LEFT_OUT + j] = left_out_of(sides)
    put_side(lanes, wholes, j, sides, state.side)


@inlined
def put_side(lanes: Floats, wholes: Integers2, j: int, sides: Floats2, side: int) -> None:
    """Put what a lane's flight takes from its side."""
    row = 0 if side > 0 else 1
    lean, rate = sides[row, columns.LEAN], sides[row, columns.RATE]
    pull, slowing = side / lean, 1.0 / rate
    wholes[SIDE, j] = side
    lanes[lane.PULL + j], lanes[lane.SLOWING + j] = pull, slowing
    lanes[lane.STEEPNESS + j] = pull * slowing
    alpha = sides[row, columns.ALPHA]
    lanes[lane.RATE + j] = rate
    lanes[lane.ALPHA + j], lanes[lane.FLAT + j] = alpha, HALF_PI / alpha


@compiled
def taken(lanes: Floats, wholes: Integers2, j: int, ride: Floats) -> March:
    """Return the state of a lane, whose flight the ride then holds."""
    ride[rides.HELD] = 1.0
    ride[rides.ANGLE], ride[rides.VELOCITY] = lanes[lane.ANGLE + j], lanes[lane.VELOCITY + j]
    ride[rides.TOP_ANGLE] = lanes[lane.TOP_ANGLE + j]
    ride[rides.TOP_SPEED] = lanes[lane.TOP_SPEED + j]
    return March(
        wholes[SIDE, j],
        0.0,
        0.0,
        wholes[SEGMENT, j],
        0,
        lanes[lane.PHASE + j],
        wholes[IMPACTS, j],
        wholes[FLIGHTS, j],
    )


@compiled
def step(lanes: Floats, wholes: Integers2, segments: Floats2, limit: int) -> int:
    """Take lanes through a sample where it is plain; return how many stay where they are."""
    _load(lanes, wholes, segments, limit)
    step_lanes(lanes)
    return _count(lanes, wholes)


@compiled
def land(
    lanes: Floats,
    wholes: Integers2,
    segments: Floats2,
    blocks: Floats3,
    passages: Floats2,
    work: Floats,
    limit: int,
) -> tuple[int, int]:
    """Do what `step` does, and take lanes that land within the sample up to their landing.

    `blocks` are the sides of all, `passages` the peaks of each lane, if they are watched.  Returned
    is also how many lanes have landed.
    """
    _load(lanes, wholes, segments, limit)
    land_lanes(lanes)
    waiting, landed = _count(lanes, wholes), 0
    for j in range(LANES):
        time = lanes[lane.LANDING + j]
        if time > 0.0:
            sides, side = blocks[wholes[CELL, j]], wholes[SIDE, j]
            later_side, velocity, impacts, slow = rebound(
                sides, side, lanes[lane.LANDING_VELOCITY + j], wholes[IMPACTS, j], columns.COUNTED
            )
            if slow:
                continue
            lanes[lane.PASSES + j] = 1.0
            wholes[IMPACTS, j] = impacts
            wholes[FLIGHTS, j] += 1
            lanes[lane.PHASE + j] += time * lanes[lane.SLOWING + j]
            row, later_row = 0 if side > 0 else 1, 0 if later_side > 0 else 1
            before = sides[row, columns.LEAN] * sides[row, columns.RATE]
            unit = sides[later_row, columns.LEAN] * sides[later_row, columns.RATE]
            if later_side != side:
                put_side(lanes, wholes, j, sides, later_side)
                lanes[lane.TOP_SPEED + j] = speed_in_unit(
                    passages[j], lanes[lane.TOP_SPEED + j], before, unit
                )
            lanes[lane.ANGLE + j], lanes[lane.VELOCITY + j] = 0.0, later_side * velocity / unit
            landed += 1
        elif lanes[lane.COARSE + j] > 0.0 and pass_coarse(lanes, j, work):
            lanes[lane.PASSES + j] = 1.0
            wholes[SEGMENT, j] += 1
            wholes[FLIGHTS, j] += 1
            waiting -= 1
    return waiting - landed, landed


@inlined
def _load(lanes: Floats, wholes: Integers2, segments: Floats2, limit: int) -> None:
    """Put what lanes take from their samples."""
    for j in range(LANES):
        segment = wholes[SEGMENT, j] & OFFSETS
        # The march takes over in a run of samples alone, and below the limit.
        ready = segments[segment, columns.ALIKE] > 1.0 and wholes[FLIGHTS, j] + 1 < limit
        ready = ready and wholes[CELL, j] >= 0
        lanes[lane.READY + j] = 1.0 if ready else 0.0
        lanes[lane.CONSTANT + j] = segments[segment, columns.CONSTANT]
        lanes[lane.SLOPE + j] = segments[segment, columns.SLOPE]
        lanes[lane.LIFT + j] = segments[segment, columns.LIFT]
        lanes[lane.LIFT_SLOPE + j] = segments[segment, columns.LIFT_SLOPE]


@inlined
def _count(lanes: Floats, wholes: Integers2) -> int:
    """Count the samples that lanes have passed; return how many lanes stay where they are."""
    waiting = 0
    for j in range(LANES):
        passed = 1 if lanes[lane.PASSES + j] > 0.0 else 0
        wholes[SEGMENT, j] += passed
        wholes[FLIGHTS, j] += passed
        waiting += 1 - passed
    return waiting
