"""Tables of the sides of blocks: which block they are of, and where its mass is."""

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats
from rocksteady.kernels.core import tables as columns
from rocksteady.model.blocks.block import Block


def only_side(sides: Floats) -> int:
    """Return the one side of a block against a wall, 1 or -1, or 0 of a block that has two."""
    if sides[0, columns.RESTITUTION] <= 0.0:
        return 1
    return -1 if sides[1, columns.RESTITUTION] <= 0.0 else 0


def mass_centres(block: Block) -> Floats:
    """Return alpha [rad] and R p^2/g of a block's sides, shape (2, 2).

    R is the distance from the pivot to the mass centre, of a frame to that of all its parts.
    """
    lever = 1.0 if block.cap is None else block.cap.lever
    sides = block.positive, block.negative
    return np.array(
        [(each.alpha, lever * each.radius * (each.p * each.p) / block.gravity) for each in sides]
    )


def weight_kn(block: Block, mass_kg: float) -> float:
    """Return the weight of a block of some mass [kN]."""
    return mass_kg * block.gravity / 1000.0


def symmetric_sides(restitution: Floats) -> Floats:
    """Return the sides of symmetric blocks, shape (blocks, 2, 3), from their restitutions."""
    sides = np.ones((len(restitution), 2, 3))
    sides[:, :, columns.RESTITUTION] = restitution[:, np.newaxis]
    return sides


def alike(sides: Floats) -> NDArray[np.bool_]:
    """Return which blocks are symmetric, from their sides, shape (blocks, 2, 3)."""
    same: NDArray[np.bool_] = (sides[:, 0] == sides[:, 1]).all(axis=1)
    return same
