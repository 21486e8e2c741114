"""Fates of many symmetric blocks by the march alone, cell by cell: what lanes are compared with."""

import numpy as np
from numpy.typing import NDArray

from rocksteady.kernels.batch.harmonic import fates_of_sides
from rocksteady.kernels.core.tables import RESTITUTION, SIDE_COLUMNS, Floats
from rocksteady.kernels.core.tuples import Cells, Fates, Starts
from rocksteady.kernels.lanes.driver import lane_fates

NO_LIMIT = 2**62
"""Flights: no motion is given up."""


def empty(count: int) -> Fates:
    """Return room for the fates of so many motions."""
    return Fates(np.zeros(count, np.int64), np.zeros(count, np.int64), np.zeros((count, 3)))


def like_sides(restitution: Floats) -> Floats:
    """Return the sides, shape (cells, 2, 3), of symmetric blocks with one restitution a cell."""
    sides = np.ones((len(restitution), 2, SIDE_COLUMNS))
    sides[:, :, RESTITUTION] = restitution[:, np.newaxis]
    return sides


def harmonic_fates(
    amplitude: Floats,
    frequency_ratio: Floats,
    restitution: Floats,
    angle: Floats,
    velocity: Floats,
    phase: Floats,
    cycles: int,
    status: NDArray[np.int64],
    impacts: NDArray[np.int64],
    final: Floats,
) -> None:
    """Call `fates_of_sides` with one restitution a cell, shape (cells,), in place of its sides."""
    fates_of_sides(
        Cells(amplitude, frequency_ratio, like_sides(restitution)),
        Starts(angle, velocity, phase),
        cycles,
        NO_LIMIT,
        Fates(status, impacts, final),
    )


def fates_in_lanes(
    columns: Floats, cycles: int, leaping: bool, found: Fates, most: int = NO_LIMIT
) -> None:
    """Call `lane_fates` with symmetric blocks.

    `columns` has shape (6, cells): amplitude, frequency ratio, restitution; angle, velocity, phase.
    """
    amplitude, frequency_ratio, restitution, angle, velocity, phase = columns
    shaken = Cells(amplitude, frequency_ratio, like_sides(restitution))
    lane_fates(shaken, Starts(angle, velocity, phase), cycles, leaping, most, found)
