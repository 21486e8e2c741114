"""Outline of a block: the rectangle around its base and everything that stands on it."""

import math
from dataclasses import dataclass, replace
from functools import partial
from typing import Annotated

from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import Bounds
from rocksteady.model.checks.validation import positive

ROUNDING = 1e-12
"""Relative difference of heights that is rounding."""

OVERHANG = Bounds(0.0, 1e50, "[]", "give how far it reaches beyond the edge in metres, 0 or more")


@checked
@dataclass(frozen=True, kw_only=True)
class Outline:
    """The rectangle around a block as it stands.

    It does not enter the equation of motion: it sets how far the block's top moves and which gap a
    neighbour needs.

    Parameters
    ----------
    height
        Full height above the base [m]; at least that of the mass centre.
    left_overhang, right_overhang
        How far it reaches beyond the left and the right edge of the base [m]; default 0.

    Raises
    ------
    InputError
        If the height is not positive, or an overhang is negative.

    Examples
    --------
    A vase 0.3 m wide and 0.8 m high on a foot of 0.2 m:

    >>> from dataclasses import replace
    >>> from rocksteady import Block
    >>> foot = Block.asymmetric(left=0.1, right=0.1, height=0.8, mass_centre_height=0.45)
    >>> vase = replace(foot, outline=Outline(height=0.8, left_overhang=0.05, right_overhang=0.05))
    >>> vase.height, vase.overhangs
    (0.8, (0.05, 0.05))
    """

    height: Annotated[float, partial(positive, hint="give the full height in metres")]
    left_overhang: Annotated[float, OVERHANG] = 0.0
    right_overhang: Annotated[float, OVERHANG] = 0.0


def outline_around(centre_height: float, given: Outline | None) -> Outline:
    """Return the outline of a block, by default twice as high as its mass centre [m].

    A given height that differs from this by rounding alone becomes it, so that blocks made in two
    ways are equal.

    Raises
    ------
    InputError
        If the mass centre is above it.
    """
    twice = 2.0 * centre_height
    if given is None:
        return Outline(height=twice)
    if math.isclose(given.height, twice, rel_tol=ROUNDING):
        return replace(given, height=twice)
    if given.height < centre_height * (1.0 - ROUNDING):
        raise InputError(
            "height",
            given.height,
            f"it is at least that of the mass centre, {centre_height:.6g} m above the base",
            "give the full height in metres",
        )
    return given
