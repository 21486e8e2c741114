"""Where the top of a rotated block is: its motion across the base, and the gap that it needs."""

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.kernels.elementary.arrays import atan2, sin
from rocksteady.model.blocks._measures import Measured


def top_displacement(block: Measured, angle: ArrayLike) -> Floats:
    """Return how far the top of a rotated block has moved across its base [m].

    ``H sin|theta| + B (1 - cos theta)`` of the upper corner of its outline opposite to the pivot, H
    the full height and B the distance of that corner's side from the pivot; for a homogeneous
    rectangle ``2 R (sin alpha - sin(alpha - |theta|))``; for a frame the motion of the cap.

    Parameters
    ----------
    block
        The block.
    angle
        Rotation theta [rad], positive about the left edge; nan gives nan.

    Examples
    --------
    >>> from rocksteady import Block
    >>> print(f"{top_displacement(Block.rectangle(width=0.6, height=1.8), 0.1):.4f} m")
    0.1827 m
    """
    theta = np.asarray(angle, dtype=np.float64)
    left, right = block.overhangs
    turned, across = np.abs(theta), block.width + np.where(theta > 0.0, right, left)
    half = sin(0.5 * turned)
    result: Floats = block.height * sin(turned) + 2.0 * across * half * half
    return result


def clearance(block: Measured, angle: ArrayLike) -> Floats:
    """Return the gap to a neighbour that a block needs to rotate so far [m].

    The upper corner of its outline above the pivot leans out by ``H sin|theta| - d (1 - cos
    theta)``, H the full height and d the overhang on that side, until it has come furthest; the cap
    of a frame, flush with its columns, moves by `top_displacement`.  The neighbour stands as high
    or higher and moves with the base.

    Parameters
    ----------
    block, angle
        As for `top_displacement`; positive rotation leans to the left.

    Examples
    --------
    >>> from rocksteady import Block
    >>> print(f"{clearance(Block.rectangle(width=0.6, height=1.8), 0.1):.4f} m")
    0.1797 m
    >>> bottom_heavy = Block.asymmetric(left=0.25, right=0.25, height=1.8, mass_centre_height=0.5)
    >>> print(f"{clearance(bottom_heavy, 0.1276):.3f} m")
    0.229 m
    """
    if block.cap is not None:
        return top_displacement(block, angle)
    theta = np.asarray(angle, dtype=np.float64)
    left, right = block.overhangs
    beyond = np.where(theta > 0.0, left, right)
    turned = np.minimum(np.abs(theta), atan2(block.height, beyond))
    half = sin(0.5 * turned)
    result: Floats = block.height * sin(turned) - 2.0 * beyond * half * half
    return result
