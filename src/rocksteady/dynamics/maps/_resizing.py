"""Blocks resized along a map's axis: which other dimensions stay fixed, which follow."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.dynamics.parameters import ASYMMETRY, SIZES
from rocksteady.errors import ModelError
from rocksteady.kernels.elementary.arrays import atan2, cos, hypot, sin
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.blocks.housner_forms import Restitution

MEASURED = (*SIZES, "acceleration_m_s2", "frequency_hz")
"""What a block without a size does not have."""
HOMOGENEOUS = 1e-9
"""How near p^2 R/g is to 3/4 in a homogeneous rectangle; far above its rounding."""


def sizes_with(names: Sequence[str]) -> tuple[str, ...]:
    """Return the two sizes that determine the block where these parameters are given.

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
        If one of them has units and the block no size, a size is moved of what is no homogeneous
        rectangle (how p follows depends on its constructor), or a ratio of its sides of a block
        with a size, whose sides follow from its shape, or of one against a wall, which has one
        side.
    """
    for name in names:
        if name in ASYMMETRY and block.one_sided:
            raise ModelError(
                "axes",
                name,
                "a block against a wall rocks on its positive side alone",
                "leave it out; restitution is that of the wall",
            )
        if name in ASYMMETRY and isinstance(block, Block):
            raise ModelError(
                "axes",
                name,
                "the sides of a block with a size follow from its shape",
                "take block.dimensionless(), or call once for each Block.asymmetric(...)",
            )
        if name in MEASURED and not isinstance(block, Block):
            raise ModelError(
                "axes",
                name,
                "a block of which only the restitution is known has no size to measure by",
                "give a Block, as Block.rectangle(width=..., height=...)",
            )
    if isinstance(block, Block) and sizes_with(names):
        if block.positive != block.negative:
            raise ModelError(
                "block",
                block,
                "sizes are moved of homogeneous rectangles; the sides of this block differ",
                "move its restitution or the shaking, or call once for each block",
            )
        ratio = block.p * block.p * block.radius / block.gravity
        if abs(ratio - 0.75) > HOMOGENEOUS or not block.fills_outline:
            raise ModelError(
                "block",
                block,
                "sizes are moved of homogeneous rectangles, with the mass centre in the middle, "
                f"whose p^2 R/g is 3/4; of this block it is {ratio:.6g}",
                "move its restitution or the shaking, or call once for each block",
            )


def block_of(
    block: Block | DimensionlessBlock,
    sizes: Sequence[str],
    given: Mapping[str, float],
    restitution: Restitution | None,
) -> Block | DimensionlessBlock:
    """Return a block with other sizes and another restitution.

    Parameters
    ----------
    block
        Its gravity stays.
    sizes
        Sizes from `sizes_with`; without any the block keeps its own.
    given
        Values of these sizes, and of ratios of its sides, by their names.
    restitution
        A number, of both impacts or of the wall; where sizes are given, also a form of "housner";
        None for its own.

    Raises
    ------
    InputError
        If a value is outside its range.
    """
    if isinstance(block, Block) and sizes:
        return resized(block, sizes, given, "housner" if restitution is None else restitution)
    moved = block
    if restitution is not None:
        assert not isinstance(restitution, str | tuple)  # without sizes it is a number
        moved = block.with_restitution(restitution)
    if isinstance(moved, DimensionlessBlock):
        unlike: dict[str, Any] = {name: given[name] for name in ASYMMETRY if name in given}
        return replace(moved, **unlike)
    return moved


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
    how: dict[str, Any] = {"restitution": restitution, "gravity": block.gravity}
    if block.one_sided:  # no impact on the base alone counts, and none is too stocky for one
        how["restitution"] = 1.0
    if "width" in sizes:
        made = Block.rectangle(width=first, height=second, **how)
    elif "p" in sizes:
        made = Block.from_p(alpha=first, p=second, **how)
    else:
        made = Block.from_radius(alpha=first, radius=second, **how)
    return made.against_wall(restitution) if block.one_sided else made


class Measures(NamedTuple):
    """What shaking is measured by, and what an impact leaves: numbers, or arrays over cells."""

    uplift: float | Floats
    """Base acceleration that lifts the block [m/s^2]."""
    p: float | Floats
    """Frequency parameter [rad/s]."""
    restitution: float | Floats
    alpha: float | Floats


def measures_of(
    block: Block,
    sizes: Sequence[str],
    given: Mapping[str, float | Floats],
    *,
    housner: float | None,
) -> Measures:
    """Return what the constructors of `Block` would make of sizes, in many cells at once.

    A block each takes fifteen microseconds, three times what it takes to follow its motion.

    Parameters
    ----------
    block, sizes
        As for `block_of`.
    given
        Parameters, these sizes among them, within their ranges: numbers, or arrays of shape
        (cells,).
    housner
        Factor of Housner's restitution, or of that of the wall, that blocks of other sizes have;
        None for that of `block`.

    Examples
    --------
    >>> block = Block.rectangle(width=0.4, height=1.2)
    >>> given = {"height": 1.2, "width": np.array([0.5, 0.3])}
    >>> sizes = measures_of(block, ("width", "height"), given, housner=1.0)
    >>> print(sizes.p.round(4), sizes.restitution.round(4))
    [3.3638 3.4485] [0.7781 0.9118]
    """
    if not sizes:
        return Measures(block.uplift_acceleration, block.p, block.restitution, block.alpha)
    first, second = (given[name] for name in sizes)
    gravity = block.gravity
    if "p" in sizes:
        alpha, p = first, second
        radius = 0.75 * gravity / (p * p)
    else:
        alpha, radius = first, second
        if "width" in sizes:
            alpha = atan2(first, second)
            radius = 0.5 * hypot(first, second)
        p = np.sqrt(0.75 * gravity / radius)
    restitution: float | Floats = block.restitution
    if housner is not None:
        sine, share = sin(alpha), p * p * radius / gravity
        restitution = 1.0 - 2.0 * share * (sine * sine)
        if block.one_sided:  # on base, wall and base
            cosine = cos(alpha)
            restitution = restitution * restitution * (2.0 * share * cosine * cosine - 1.0)
        restitution = housner * restitution
    return Measures(alpha * gravity, p, restitution, alpha)
