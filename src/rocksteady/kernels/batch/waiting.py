"""How long blocks wait at rest under one motion: a table made once, a search for each block.

A block at rest feels the base acceleration over its weight, and waits while that is below its
uplift value.  The largest so far, from segment to segment, says for all blocks how long.
"""

import math

from rocksteady.kernels.core import tables as columns
from rocksteady.kernels.core.tables import Floats, free_side, is_nonlinear
from rocksteady.kernels.core.typed import ONE, ZERO
from rocksteady.kernels.machine_code.compilation import compiled
from rocksteady.kernels.machine_code.types import Floats1, Floats2
from rocksteady.kernels.nonlinear.drive import WEIGHTLESS
from rocksteady.kernels.nonlinear.samples import uplift_at


@compiled
def fill_hardest(segments: Floats2, nonlinear: bool, hardest: Floats1) -> None:
    """Fill the largest |a|/(1 + l) up to the end of each segment but the endless one.

    It is infinite from where a sinusoid, an impulse, or a base that falls away needs a march.
    """
    top = 0.0
    for index in range(len(hardest)):
        duration = segments[index, columns.DURATION]
        start = segments[index, columns.CONSTANT]
        end = start + segments[index, columns.SLOPE] * duration
        weight = later = 1.0
        if nonlinear:
            weight += segments[index, columns.LIFT]
            later = weight + segments[index, columns.LIFT_SLOPE] * duration
        if (
            segments[index, columns.AMPLITUDE] != 0.0
            or segments[index + 1, columns.JUMP] != 0.0
            or min(weight, later) <= WEIGHTLESS
        ):
            top = math.inf
        else:
            top = max(top, abs(start) / weight, abs(end) / later)
        hardest[index] = top


@compiled
def waits_until(hardest: Floats, sides: Floats) -> int:
    """Return the first segment at which a block at rest may lift, or the endless one."""
    least: float = min(sides[0, columns.LEAN], sides[1, columns.LEAN])
    if is_nonlinear(sides):
        least = min(uplift_at(sides, ZERO), uplift_at(sides, ONE))
    free = free_side(sides)
    if free != 0:
        row = ZERO if free > 0 else ONE
        least = uplift_at(sides, row) if is_nonlinear(sides) else sides[row, columns.LEAN]
    low, high = 0, len(hardest)
    while low < high:
        middle = (low + high) // 2
        if hardest[middle] < columns.SAFELY * least:
            low = middle + 1
        else:
            high = middle
    return low
