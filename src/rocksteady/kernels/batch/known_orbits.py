"""Orbits that lanes have found, for the next motion that comes to the same state on one.

Lanes that settle are put on a grid (`kernels.batch.arrival`), so that motions which come to one
orbit begin Newton's method with the same bits.  What that finds is a function of these bits alone,
and so is the answer: it is the same whether it is computed or looked up.  Each key has one row, in
which the last orbit is kept.
"""

import math

from rocksteady.kernels.batch.arrival import GRID
from rocksteady.kernels.batch.attractors import AFTER, REAL_COLUMNS, WHOLE_COLUMNS
from rocksteady.kernels.core.tuples import Outcomes
from rocksteady.kernels.core.typed import MINUS_ONE, ZERO
from rocksteady.kernels.machine_code.compilation import compiled
from rocksteady.kernels.machine_code.types import Floats2
from rocksteady.kernels.orbits.periodic import Fixed
from rocksteady.kernels.orbits.return_map import Jacobian, Section
from rocksteady.kernels.orbits.settle import Near
from rocksteady.kernels.orbits.systems import System

KNOWN = 64
"""Rows of orbits on the host: more than the passages of those in a usual basin."""
Key = tuple[float, ...]

# Columns: the key, the orbit, and the outcome of a cell.
NEAR_AT = 12
WHOLE_AT = NEAR_AT + 9
REAL_AT = WHOLE_AT + WHOLE_COLUMNS
KNOWN_COLUMNS = REAL_AT + REAL_COLUMNS


@compiled
def key_of(system: System, here: Section, passages: int, periods: int, folded: bool) -> Key:
    """Return all that a search for an orbit near a state depends on, of a symmetric block."""
    begin = (here.phase, here.speed, 1.0 * here.side, 1.0 * (here.half_cycles % 2))
    way = (1.0 * passages, 1.0 * periods, 1.0 * folded, system.left_out)
    return (
        begin + way + (system.amplitude, system.frequency, system.restitution[0], system.alpha[0])
    )


@compiled
def row_of(key: Key, known: Floats2) -> int:
    """Return the row of a key; -1 where no orbits are kept."""
    place = 31 * int(key[0] * GRID) + int(key[1] * GRID) + int(5.0 * key[4] + key[2])
    return place % len(known) if len(known) > 0 else MINUS_ONE


@compiled
def is_known(known: Floats2, row: int, key: Key) -> bool:
    """Return whether the orbit of a key is in its row."""
    same = row >= 0
    for column in range(NEAR_AT):
        same = same and known[row, column] == key[column]
    return same


@compiled
def recalled(known: Floats2, row: int) -> Near:
    """Return the orbit of a row; how exact it is is not kept."""
    kept = known[row, NEAR_AT:WHOLE_AT]
    orbit = Section(int(kept[0]), int(kept[1]), kept[2], kept[3])
    jacobian = Jacobian(kept[5], kept[6], kept[7], kept[8])
    return Near(True, orbit, kept[4], Fixed(True, math.nan, jacobian, ZERO, ZERO))


@compiled
def keep(known: Floats2, row: int, key: Key, near: Near, cell: int, outcomes: Outcomes) -> None:
    """Keep an orbit and the outcome of the cell that settles to it."""
    for column in range(NEAR_AT):
        known[row, column] = key[column]
    (side, half, phase, speed), jacobian = near.orbit, near.fixed.jacobian
    begin = (1.0 * side, 1.0 * half, phase, speed)
    for place in range(4):
        known[row, NEAR_AT + place] = begin[place]
        known[row, NEAR_AT + 5 + place] = jacobian[place]
    known[row, NEAR_AT + 4] = near.largest
    for column in range(WHOLE_COLUMNS):
        known[row, WHOLE_AT + column] = outcomes.whole[cell, column]
    for column in range(REAL_COLUMNS):
        known[row, REAL_AT + column] = outcomes.real[cell, column]


@compiled
def answer(known: Floats2, row: int, after: int, cell: int, outcomes: Outcomes) -> None:
    """Write that a cell settles to the orbit of a row, and after how many forcing periods."""
    for column in range(WHOLE_COLUMNS):
        outcomes.whole[cell, column] = int(known[row, WHOLE_AT + column])
    for column in range(REAL_COLUMNS):
        outcomes.real[cell, column] = known[row, REAL_AT + column]
    outcomes.whole[cell, AFTER] = after
