"""Uplift and friction: which of rest, rocking and sliding a peak acceleration begins."""

from typing import Literal

from rocksteady.kernels.elementary.arrays import cos, sin, tan
from rocksteady.model.blocks.block import STANDARD_GRAVITY, Block
from rocksteady.model.blocks.sides import Side
from rocksteady.seismic.measures.free_sides import first_side, free_sides

Mode = Literal["rest", "rocks", "slides", "slides and rocks"]
"""How a block at rest answers a peak acceleration."""


def uplift_acceleration_g(block: Block, vertical_g: float = 0.0) -> float:
    """Return the base acceleration [g] that lifts a block at rest.

    Moment about the edge: a M R cos(alpha) = (g + a_v) M R sin(alpha), so a = (g + a_v) tan(alpha),
    a_v being the upward acceleration of the base at that instant.  No edition is implied: it is
    statics, often quoted as West's formula; it holds for any rigid
    block, of the side that lifts first.

    Parameters
    ----------
    block
        The block.
    vertical_g
        Upward base acceleration [g]; below 0 the base falls away and the block lifts sooner.

    Examples
    --------
    >>> block = Block.rectangle(width=0.32, height=1.8)
    >>> print(f"{uplift_acceleration_g(block):.4f} {uplift_acceleration_g(block, -0.2):.4f}")
    0.1778 0.1422
    """
    gravity_g = block.gravity / STANDARD_GRAVITY
    return (gravity_g + vertical_g) * tan(first_side(block).alpha)


def needed_friction(block: Block, pga_g: float, vertical_g: float = 0.0) -> float:
    """Return the friction with which a block at rest lifts and does not slide.

    Shenton (1996) for a rectangle, with a = tan(alpha) and A = PGA/g:
    ``mu >= (A (1 + 4 a^2) + 3 a) / (4 + a^2 + 3 A a)``, equal to a at A = a and growing with A.
    Here in its general form, for any mass distribution, from the
    horizontal and the vertical force at the edge when rotation begins with theta'' = p^2 (A cos
    alpha - sin alpha): ``(A - k (A - a)) / (1 + k a (A - a))`` with k = (p^2 R/g) cos^2(alpha),
    which is Shenton's expression for p^2 R/g = 3/4.  Below uplift it is A.

    For a block whose sides differ it is the greater of both: shaking reverses.  Against a wall it
    is that of the free side: the wall holds what is driven into it.

    Parameters
    ----------
    block
        The block.
    pga_g
        Peak acceleration [g].
    vertical_g
        Upward base acceleration at that instant [g]; it adds to gravity.

    References
    ----------
    H. W. Shenton, J. Eng. Mech. 122, 690-693 (1996).

    Examples
    --------
    >>> block = Block.rectangle(width=0.3, height=1.8)
    >>> print(f"{needed_friction(block, 0.35):.4f}")
    0.2115
    """
    gravity_g = block.gravity / STANDARD_GRAVITY
    ratio = pga_g / (gravity_g + vertical_g)
    return max(_at_side(side, block.gravity, ratio) for side in free_sides(block))


def _at_side(side: Side, gravity: float, ratio: float) -> float:
    """Return the friction that one side needs at a ratio of accelerations."""
    slope = tan(side.alpha)
    excess = ratio - slope
    if excess <= 0.0:
        return ratio
    share = side.p * side.p * side.radius / gravity  # M R^2/I_0
    along = share * cos(side.alpha) * cos(side.alpha)
    across = share * cos(side.alpha) * sin(side.alpha)
    return (ratio - along * excess) / (1.0 + across * excess)


def first_motion(block: Block, pga_g: float, friction: float, vertical_g: float = 0.0) -> Mode:
    """Return how a block at rest answers a peak acceleration, after Shenton (1996).

    Below uplift and below sliding it rests.  It rocks with the friction of `needed_friction`,
    slides with less than a = tan(alpha), and slides and rocks in between.  For a block whose sides
    differ the worse of both directions counts: sliding before both, both before rocking alone.

    Examples
    --------
    >>> block = Block.rectangle(width=0.3, height=1.8)
    >>> [first_motion(block, 0.35, mu) for mu in (0.1, 0.2, 0.3)]
    ['slides', 'slides and rocks', 'rocks']
    """
    ratio = pga_g / (block.gravity / STANDARD_GRAVITY + vertical_g)
    modes: list[Mode] = []
    for side in free_sides(block):
        slope = tan(side.alpha)
        mode: Mode = "rest" if ratio <= slope else "rocks"
        if friction < _at_side(side, block.gravity, ratio):
            mode = "slides" if friction < slope else "slides and rocks"
        modes.append(mode)
    order: tuple[Mode, ...] = ("rest", "rocks", "slides and rocks", "slides")
    return max(modes, key=order.index)
