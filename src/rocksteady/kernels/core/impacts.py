"""What an impact makes of a motion: velocity and side after it, and the count of impacts."""

import math
from typing import NamedTuple

from rocksteady.kernels.core.scatter import is_scattered, restitution_of
from rocksteady.kernels.core.tables import COUNTED, LEAN, RATE, RESTITUTION, Floats, free_side
from rocksteady.kernels.machine_code.compilation import inlined


class Rebound(NamedTuple):
    """How a block leaves an impact."""

    side: int
    velocity: float  # in reference units
    impacts: int
    slow: bool  # as are those to come, on either side: it may be coming to rest


@inlined
def rebound(
    sides: Floats, side: int, landing: float, impacts: int, rest_velocity: float
) -> Rebound:
    """Return how a block leaves an impact: slower by the restitution (eq 9), on the other side.

    A wall's restitution is negative: the block turns back about the pivot that it has.

    Parameters
    ----------
    sides
        Table of the block's sides.
    side, landing
        The side that it comes from, and the velocity, in the units of that side.
    impacts
        Those that have counted so far.  Where `rest_velocity` is infinite all do: lanes, which
        leave chatter out at any speed, tell periods by their number.
    rest_velocity
        As in `kernels.core.tuples.Until`.
    """
    row = 0 if side > 0 else 1
    later_side = -side if free_side(sides) == 0 else side
    later_row = 0 if later_side > 0 else 1
    restitution = sides[row, RESTITUTION]
    if is_scattered(sides):
        restitution = restitution_of(sides, row, impacts + 1)
    lean, rate = sides[row, LEAN], sides[row, RATE]
    velocity = restitution * side * landing * lean * rate
    there = sides[later_row, LEAN] * sides[later_row, RATE]
    least = COUNTED if rest_velocity < math.inf else 0.0
    if abs(velocity) >= least * there:
        impacts += 1
    slow = abs(velocity) <= rest_velocity * min(there, lean * rate)
    return Rebound(later_side, velocity, impacts, slow)
