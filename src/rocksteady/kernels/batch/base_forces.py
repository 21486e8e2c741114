"""Largest forces on the bases of many blocks under one motion."""

import math

import numpy as np

from rocksteady.kernels.core import tables as columns
from rocksteady.kernels.core.tables import March
from rocksteady.kernels.core.tuples import Blocks, Kept, Tables, Until
from rocksteady.kernels.core.typed import ZERO
from rocksteady.kernels.machine_code.compilation import allocating
from rocksteady.kernels.machine_code.types import Floats2, Floats3
from rocksteady.kernels.march.forces import ACROSS, DOWN, FORCES, largest_forces
from rocksteady.kernels.march.march import march


@allocating
def record_forces(
    segments: Floats2, blocks: Blocks, centres: Floats3, limit: int, forces: Floats2
) -> None:
    """Fill the largest forces over the weight of blocks at rest before a motion.

    They are nan of a block that falls or never rocks.  Each is marched with its flights recorded,
    chatter too, as a single run is.

    Parameters
    ----------
    segments, blocks, limit
        As for `rocksteady.kernels.batch.records.record_fates`.
    centres
        Of each block, as `rocksteady.kernels.march.forces.fill_forces` has them.
    forces
        Shape (blocks, 2): across and down.
    """
    largest, none = np.empty(FORCES), np.zeros((0, columns.ROW_COLUMNS))
    start = March(0, 0.0, 0.0, 0, 0, 0.0, 0, 0)
    for i in range(len(forces)):
        tables = Tables(segments, blocks.sides[i])
        stop = blocks.afterwards[i] / tables.sides[0, columns.RATE]
        until = Until(ZERO, stop, columns.SMALLEST_BOUNCE, limit)
        status, end = march(tables, start, until, Kept(none, largest[:0]))
        forces[i, ACROSS] = forces[i, DOWN] = math.nan
        if status != columns.OVERTURNED:
            rows = np.empty((end.flights, columns.ROW_COLUMNS))
            march(tables, start, until, Kept(rows, largest[:0]))
            last = rows[end.flights - 1, columns.ROW_DURATION] if end.flights > 0 else 0.0
            largest_forces(tables, rows, last, centres[i], largest)
            forces[i, ACROSS], forces[i, DOWN] = largest[ACROSS], largest[DOWN]
