"""One pass over all lanes: which of the loops are worth their time, and in what order they run.

The loops are short: one long loop over all steps takes half as long again, because its constants
and temporaries do not fit into 32 registers.
"""

import math

from rocksteady.kernels.core.queue import together
from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.core.typed import ZERO
from rocksteady.kernels.lanes import _fields as lane
from rocksteady.kernels.lanes._fields import (
    FIELDS,
    GROUP,
    LANES,
    MANY,
    NODES_BITS,
    SHORTS_BITS,
    SPECIALS_BITS,
    WAITING_BITS,
    weight,
    working,
)
from rocksteady.kernels.lanes._launching import begin_special, begin_special_apart, launch
from rocksteady.kernels.lanes._loading import load
from rocksteady.kernels.lanes._newton import approach, bounce, fly, land, shake
from rocksteady.kernels.machine_code.compilation import compiled
from rocksteady.kernels.machine_code.types import Floats2

# A loop over few lanes costs as much as over all: they are let gather ...
GATHERED = 10
WAITING = 3
SPECIALS = 6
PATIENCE = 4  # ... but for no more than so many passes where others would go on without end


@compiled
def fill_empty(lanes: Floats, sides: Floats2) -> None:
    """Fill lanes with a cell that has none: empty ones fly too, and come to no harm."""
    for j in range(LANES):
        load(lanes, j, ZERO, 0.0, 1.0, sides, 0.0)
        lanes[lane.VELOCITY + j] = 1.0
    lanes[lane.GROUPS] = LANES // GROUP


@compiled
def draw_together(lanes: Floats) -> None:
    """Move the lanes that have work to the front, so that loops go over fewer."""
    busy = 0
    for j in range(working(lanes)):
        if lanes[lane.STAGE + j] != lane.EMPTY:
            if j != busy:
                for field in range(0, FIELDS * LANES, LANES):
                    lanes[field + busy] = lanes[field + j]
                lanes[lane.STAGE + j] = lane.EMPTY
            busy += 1
    lanes[lane.GROUPS] = max(1, (busy + GROUP - 1) // GROUP)


@compiled
def census(lanes: Floats) -> int:
    """Count the lanes of each kind of stage."""
    count = 0
    for j in range(working(lanes)):
        count += weight(lanes[lane.STAGE + j])
    return count


@compiled
def in_need(numbers: int) -> bool:
    """Return whether several lanes of a census wait for help, or none goes on without it."""
    nodes, shorts = (numbers >> NODES_BITS) & MANY, (numbers >> SHORTS_BITS) & MANY
    waiting = (numbers >> WAITING_BITS) & MANY
    return waiting >= WAITING or (numbers & MANY) + nodes + shorts == 0


@compiled
def at_nodes(numbers: int) -> bool:
    """Return whether so many lanes of a census are at nodes that their loop is worth its time."""
    nodes = (numbers >> NODES_BITS) & MANY
    return nodes > 0 and (nodes >= GATHERED or nodes >= numbers & MANY)


@compiled
def step(lanes: Floats, numbers: int, bounces: int) -> int:
    """Take a step towards the impacts of a census; return passes since one at short bounces."""
    flying, shorts = numbers & MANY, (numbers >> SHORTS_BITS) & MANY
    shake(lanes)
    fly(lanes)
    below = lane.SHORT
    bounces += 1
    if shorts > 0 and (shorts >= GATHERED or shorts >= flying or bounces >= PATIENCE):
        bounce(lanes)
        below = math.inf
        bounces = 0
    approach(lanes)
    land(lanes, below)
    return bounces


@compiled
def begin(lanes: Floats, delays: int, two_sided: bool) -> tuple[int, int]:
    """Begin flights from the floor; return the census and passes since one at special flights."""
    numbers = together(launch(lanes))
    specials = numbers >> SPECIALS_BITS
    delays += 1
    if specials > 0 and (specials >= SPECIALS or specials >= numbers & MANY or delays >= PATIENCE):
        if two_sided:
            begin_special_apart(lanes)
        else:
            begin_special(lanes)
        return together(census(lanes)), 0
    return numbers, delays
