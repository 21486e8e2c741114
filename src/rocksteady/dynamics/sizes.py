"""Blocks of other sizes: what a block becomes where one of its measures is moved."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rocksteady.dynamics.parameters import SIZES
from rocksteady.errors import ModelError
from rocksteady.model.block import Block, DimensionlessBlock, Restitution

Floats = NDArray[np.float64]

MEASURED = (*SIZES, "acceleration_m_s2", "frequency_hz")
"""What a block without a size does not have."""
HOMOGENEOUS = 1e-9
"""How near p^2 R/g is to 3/4 in a homogeneous rectangle; far above its rounding."""


def sizes_with(names: Sequence[str]) -> tuple[str, ...]:
    """Return the two sizes that say what block it is where these parameters are given.

    Width and height keep each other; the slenderness keeps the half-diagonal, and a half-diagonal
    or a frequency parameter keeps the slenderness.  Empty where no size is given.

    Examples
    --------
    >>> sizes_with(["amplitude", "width"]), sizes_with(["p"]), sizes_with(["restitution"])
    (('width', 'height'), ('alpha', 'p'), ())
    """
    if "width" in names or "height" in names:
        return "width", "height"
    if "p" in names:
        return "alpha", "p"
    if "alpha" in names or "radius" in names:
        return "alpha", "radius"
    return ()


def check_sizes(block: Block | DimensionlessBlock, names: Sequence[str]) -> None:
    """Refuse parameters that a block does not have.

    Raises
    ------
    ModelError
        If one of them has units and the block no size, or a size is moved of what is no homogeneous
        rectangle: how p follows, only its maker knows.
    """
    for name in names:
        if name in MEASURED and not isinstance(block, Block):
            raise ModelError(
                name="axes",
                value=name,
                valid="a block of which only the restitution is known has no size to measure by",
                hint="give a Block, as Block.rectangle(width=..., height=...)",
            )
    if isinstance(block, Block) and sizes_with(names):
        ratio = block.p**2 * block.radius / block.gravity
        if abs(ratio - 0.75) > HOMOGENEOUS:
            raise ModelError(
                name="block",
                value=block,
                valid="sizes are moved of homogeneous rectangles, whose p^2 R/g is 3/4; of this "
                f"block it is {ratio:.6g}",
                hint="move its restitution or the shaking, or call once for each block",
            )


def block_of(
    block: Block | DimensionlessBlock,
    sizes: Sequence[str],
    given: Mapping[str, float],
    restitution: Restitution,
) -> Block | DimensionlessBlock:
    """Return a block with other sizes and another restitution.

    Parameters
    ----------
    block
        Its gravity stays.
    sizes
        What `sizes_with` says; without any the block keeps its own.
    given
        Values of these sizes, by their names.
    restitution
        A number; where sizes are given, also "housner".

    Raises
    ------
    InputError
        If a value is outside its range.
    """
    if isinstance(block, Block) and sizes:
        return resized(block, sizes, given, restitution)
    ratio = float(restitution)
    if isinstance(block, DimensionlessBlock):
        return DimensionlessBlock(restitution=ratio)
    side = replace(block.positive, restitution=ratio)
    return replace(block, positive=side, negative=side)


def resized(
    block: Block, sizes: Sequence[str], given: Mapping[str, float], restitution: Restitution
) -> Block:
    """Return a homogeneous rectangle of two sizes; arguments as for `block_of`.

    Examples
    --------
    >>> block = Block.rectangle(width=0.4, height=1.2, restitution=0.9)
    >>> sizes = {"width": 0.6, "height": 1.2}
    >>> other = resized(block, ("width", "height"), sizes, "housner")
    >>> print(f"{other.width:.4f} m, {other.restitution:.4f}")
    0.6000 m, 0.7000
    """
    first, second = (given[name] for name in sizes)
    if "width" in sizes:
        return Block.rectangle(
            width=first, height=second, restitution=restitution, gravity=block.gravity
        )
    if "p" in sizes:
        return Block.from_p(alpha=first, p=second, restitution=restitution, gravity=block.gravity)
    return Block.from_radius(
        alpha=first, radius=second, restitution=restitution, gravity=block.gravity
    )


def blocks_of(
    block: Block,
    sizes: Sequence[str],
    kept: Mapping[str, float],
    cells: Mapping[str, Floats],
    *,
    housner: bool,
) -> tuple[list[Block], NDArray[np.intp]]:
    """Return the different blocks in some cells, and the place of that of each cell among them.

    Parameters
    ----------
    block, sizes
        As for `block_of`.
    kept, cells
        Parameters, sizes among them, that all cells have in common, and those of each cell, one or
        more, shape (cells,) each.
    housner
        Whether the restitution of blocks of other sizes is Housner's; else it is that of `block`.

    Examples
    --------
    >>> block = Block.rectangle(width=0.4, height=1.2)
    >>> widths = {"width": np.array([0.5, 0.3, 0.5])}
    >>> both = ("width", "height")
    >>> blocks, places = blocks_of(block, both, {"height": 1.2}, widths, housner=True)
    >>> [f"{one.width:.1f} m" for one in blocks], places
    (['0.3 m', '0.5 m'], array([1, 0, 1]))
    """
    count = len(next(iter(cells.values())))
    restitution: Restitution = "housner" if housner else block.restitution
    moved = [name for name in sizes if name in cells]
    if not moved:
        one = resized(block, sizes, kept, restitution) if sizes else block
        return [one], np.zeros(count, dtype=np.intp)
    columns = np.stack([cells[name] for name in moved], axis=1)
    points, places = np.unique(columns, axis=0, return_inverse=True)
    blocks = [
        resized(block, sizes, {**kept, **dict(zip(moved, point, strict=True))}, restitution)
        for point in points.tolist()
    ]
    return blocks, places.ravel()
