"""Queue of cells, from which workers take the next one until there are none.

A worker is a call of a queued kernel: the one call of a host kernel, or a thread of a device.  The
queue is an array of whole numbers, shape (HEAD + cells,): cells taken so far, workers that have
begun, and the numbers of the cells in the order in which they are taken.  What a cell comes to
depends on the cell alone, not on that order, nor on which worker takes it.
"""

import numpy as np

from rocksteady.kernels.core.typed import MINUS_ONE, ONE, ZERO
from rocksteady.kernels.machine_code.compilation import allocating, compiled
from rocksteady.kernels.machine_code.types import Integers1

TAKEN = ZERO
BEGUN = ONE
HEAD = 2

LEFT_OVER = MINUS_ONE
"""Status or outcome of a cell that a worker leaves to the host kernel."""


@compiled
def add_one(queue: Integers1, place: int) -> int:
    """Add 1 to a number of the queue; return what it was before.

    The build of a device replaces this function by an atomic addition.
    """
    before: int = queue[place]
    queue[place] = before + 1
    return before


@compiled
def take(queue: Integers1) -> int:
    """Return the next cell, or -1 where all have been taken."""
    place = add_one(queue, TAKEN)
    if place >= len(queue) - HEAD:
        return MINUS_ONE
    cell: int = queue[HEAD + place]
    return cell


@compiled
def enter(queue: Integers1) -> int:
    """Return the number of a worker that begins: 0, 1, ..., which is its row of the room."""
    return add_one(queue, BEGUN)


@compiled
def together(number: int) -> int:
    """Return the sum of a number over the workers that run in step with this one.

    On the host a worker runs alone.  On a device the 32 threads of a warp run in step, and are fast
    as long as they take the same branch: what decides about one is added up over them.  All of them
    call this function equally often.  The numbers are below 2^32 in sum, or packed counts whose
    sums stay below 2^8; the build of a device replaces this function.
    """
    return number


@allocating
def queue_of(cells: int) -> Integers1:
    """Return a queue of so many cells in their natural order."""
    queue = np.empty(HEAD + cells, np.int64)
    queue[TAKEN] = queue[BEGUN] = 0
    for cell in range(cells):
        queue[HEAD + cell] = cell
    return queue
