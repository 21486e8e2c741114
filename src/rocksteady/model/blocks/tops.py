"""Where the top of a rotated block is: its motion across the base, and the gap that it needs."""

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.kernels.elementary.arrays import sin
from rocksteady.model.blocks._measures import Measured


def top_displacement(block: Measured, angle: ArrayLike) -> Floats:
    """Return how far the top of a rotated block has moved across its base [m].

    ``2 h sin|theta| + 2 b (1 - cos theta)`` of the upper corner opposite to the pivot, of a
    symmetric block ``2 R (sin alpha - sin(alpha - |theta|))``; for a frame it is the motion of the
    cap.  The top is at the block's `height`.

    Parameters
    ----------
    block
        The block.
    angle
        Rotation theta [rad]; nan gives nan.

    Examples
    --------
    >>> from rocksteady import Block
    >>> print(f"{top_displacement(Block.rectangle(width=0.6, height=1.8), 0.1):.4f} m")
    0.1827 m
    """
    turned = np.abs(np.asarray(angle, dtype=np.float64))
    half = sin(0.5 * turned)
    result: Floats = block.height * sin(turned) + 2.0 * block.width * half * half
    return result


def overhang(block: Measured, angle: ArrayLike) -> Floats:
    """Return the gap to a neighbour that a rotated block needs on its side [m].

    The upper corner above the pivot leans out by ``2 h sin|theta|``; the cap of a frame, flush with
    its columns, moves by `top_displacement`.  The neighbour stands as high or higher and moves with
    the base.

    Parameters
    ----------
    block, angle
        As for `top_displacement`.

    Examples
    --------
    >>> from rocksteady import Block
    >>> print(f"{overhang(Block.rectangle(width=0.6, height=1.8), 0.1):.4f} m")
    0.1797 m
    """
    if block.cap is not None:
        return top_displacement(block, angle)
    result: Floats = block.height * sin(np.abs(np.asarray(angle, dtype=np.float64)))
    return result
