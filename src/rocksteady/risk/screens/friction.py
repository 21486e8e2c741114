"""Uplift and friction: which of rest, rocking and sliding a peak acceleration begins.

A vertical acceleration at that instant is a magnitude: its direction is not known, so the worse one
counts.  That is downwards, in all of this module: a base that accelerates downwards by a_v takes
a_v from gravity, and a block under a smaller gravity lifts, slides and needs more friction sooner.
The need grows with A/(g - a_v) since ``I_0 > M R^2``.
"""

from typing import Literal, NamedTuple

from rocksteady.errors import InputError
from rocksteady.kernels.elementary.arrays import cos, sin, tan
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.gravity import ROUNDED, STANDARD_GRAVITY
from rocksteady.model.blocks.sides import Side, impact_friction
from rocksteady.seismic.measures.free_sides import first_side, free_sides

Mode = Literal["rest", "rocks", "slides", "slides and rocks"]
"""How a block at rest answers a peak acceleration."""
MODES: tuple[Mode, ...] = ("rest", "rocks", "slides and rocks", "slides")
"""All of them, the worst last: sliding alone has no answer by rocking."""
SLIDES: tuple[Mode, ...] = ("slides", "slides and rocks")
"""Modes for which formulas of rocking have no answer."""


class FrictionNeed(NamedTuple):
    """Least coefficients of friction with which a block rocks and does not slide.

    Attributes
    ----------
    at_uplift
        As rotation begins, after Shenton (1996).
    at_impact
        As the other edge strikes the base; 0 of a block that does not lift, or against a wall.
    """

    at_uplift: float
    at_impact: float

    @property
    def largest(self) -> float:
        """The need: the greater of both."""
        return max(self)

    @property
    def cause(self) -> str:
        """What the need comes from."""
        return "impacts" if self.at_impact > self.at_uplift else "uplift"


def least_gravity_g(block: Block, vertical_g: float) -> float:
    """Return gravity on a base that accelerates downwards, over the standard one.

    Raises
    ------
    InputError
        If the base falls as fast as the block: what then lifts or slides is no question.
    """
    gravity_g = block.gravity / STANDARD_GRAVITY
    if vertical_g >= gravity_g:
        raise InputError(
            "vertical_g",
            vertical_g,
            f"at the horizontal peak it must stay below {gravity_g:g} g: the base else falls as "
            "fast as the block",
            "give a smaller share of it, as 0.4, where the two peaks do not coincide",
        )
    return gravity_g - vertical_g


def uplift_acceleration_g(block: Block, vertical_g: float = 0.0) -> float:
    """Return the base acceleration [g] that lifts a block at rest.

    Moment about the edge: a M R cos(alpha) = (g - a_v) M R sin(alpha), so a = (g - a_v) tan(alpha),
    a_v being the vertical acceleration of the base at that instant, downwards.  No edition is
    implied: it is statics, often quoted as West's formula; it holds for any rigid block, of the
    side that lifts first.

    Parameters
    ----------
    block
        The block.
    vertical_g
        Magnitude of the vertical base acceleration at that instant [g]; default 0.

    Raises
    ------
    InputError
        If the base falls as fast as the block.

    Examples
    --------
    >>> block = Block.rectangle(width=0.32, height=1.8)
    >>> print(f"{uplift_acceleration_g(block):.4f} {uplift_acceleration_g(block, 0.2):.4f}")
    0.1778 0.1422
    """
    return least_gravity_g(block, vertical_g) * tan(first_side(block).alpha)


def exceeds(peak: float, bound: float) -> bool:
    """Return whether a peak is above a bound: by more than rounding makes it."""
    return peak > bound * (1.0 + ROUNDED)


def lifts(block: Block, pga_g: float, vertical_g: float = 0.0) -> bool:
    """Return whether a peak acceleration of the base lifts a block; parameters as those above."""
    return exceeds(pga_g, uplift_acceleration_g(block, vertical_g))


def needed_friction(block: Block, pga_g: float, vertical_g: float = 0.0) -> FrictionNeed:
    """Return the friction with which a block at rest lifts, rocks and does not slide.

    Shenton (1996) for a rectangle, with a = tan(alpha) and A = PGA/g:
    ``mu >= (A (1 + 4 a^2) + 3 a) / (4 + a^2 + 3 A a)``, equal to a at A = a and growing with A.
    Here in its general form, for any mass distribution, from the
    horizontal and the vertical force at the edge when rotation begins with theta'' = p^2 (A cos
    alpha - sin alpha): ``(A - k (A - a)) / (1 + k a (A - a))`` with k = (p^2 R/g) cos^2(alpha),
    which is Shenton's expression for p^2 R/g = 3/4.  Of a frame R is that of the mass centre of
    columns and cap together, as in `Trajectory.forces_per_weight`.  Below uplift it is A.

    For a block whose sides differ it is the greater of both: shaking reverses, and a block that
    lifts on the weaker side turns about the other edge after its impact, where the same expression
    holds below a: it is more than A there.  Against a wall it is that of the free side: the wall
    holds what is driven into it.

    A block that lifts has impacts, whose impulses need friction too, whatever the acceleration.
    With Housner's restitution a rectangle needs less than a for them (`impact_friction`).  Impacts
    on a wall are left out.

    Parameters
    ----------
    block
        The block.
    pga_g
        Peak acceleration [g].
    vertical_g
        Magnitude of the vertical base acceleration at that instant [g]; default 0.

    Raises
    ------
    InputError
        If the base falls as fast as the block.

    References
    ----------
    H. W. Shenton, J. Eng. Mech. 122, 690-693 (1996).

    Examples
    --------
    >>> block = Block.rectangle(width=0.3, height=1.8)
    >>> print("{:.4f} at uplift, {:.4f} at impacts".format(*needed_friction(block, 0.35)))
    0.2115 at uplift, 0.1241 at impacts
    """
    ratio = pga_g / least_gravity_g(block, vertical_g)
    if not lifts(block, pga_g, vertical_g):
        return FrictionNeed(at_uplift=ratio, at_impact=0.0)
    return FrictionNeed(
        at_uplift=max(_at_side(side, block, ratio) for side in free_sides(block)),
        at_impact=_at_impacts(block),
    )


def _at_impacts(block: Block) -> float:
    """Return the friction that the impacts of a block on its base need; 0 of one at a wall."""
    if block.one_sided:
        return 0.0
    positive, negative = block.positive, block.negative
    return max(impact_friction(positive, negative), impact_friction(negative, positive))


def _at_side(side: Side, block: Block, ratio: float) -> float:
    """Return the friction that one side needs at a ratio of accelerations as it begins to turn."""
    excess = ratio - tan(side.alpha)
    share = side.p * side.p * side.radius / block.gravity  # M R^2/I_0
    share *= 1.0 if block.cap is None else block.cap.lever
    along = share * cos(side.alpha) * cos(side.alpha)
    across = share * cos(side.alpha) * sin(side.alpha)
    return (ratio - along * excess) / (1.0 + across * excess)


def first_motion(block: Block, pga_g: float, friction: float, vertical_g: float = 0.0) -> Mode:
    """Return how a block at rest answers a peak acceleration, after Shenton (1996).

    Below uplift and below sliding it rests.  It rocks with the friction of `needed_friction`,
    slides with less than a = tan(alpha), and slides and rocks in between.  For a block whose sides
    differ the worse of both directions counts: sliding before both, both before rocking alone.

    Parameters
    ----------
    block, pga_g, vertical_g
        As for `needed_friction`.
    friction
        Coefficient between block and base.

    Examples
    --------
    >>> block = Block.rectangle(width=0.3, height=1.8)
    >>> [first_motion(block, 0.35, mu) for mu in (0.1, 0.2, 0.3)]
    ['slides', 'slides and rocks', 'rocks']
    """
    ratio = pga_g / least_gravity_g(block, vertical_g)
    rises = lifts(block, pga_g, vertical_g)
    modes: list[Mode] = []
    for side in free_sides(block):
        slope = tan(side.alpha)
        mode: Mode = "rocks" if exceeds(ratio, slope) else "rest"
        if friction < min(ratio, slope):
            mode = "slides"
        elif rises and friction < max(_at_side(side, block, ratio), _at_impacts(block)):
            mode = "slides and rocks"
        modes.append(mode)
    return max(modes, key=MODES.index)
