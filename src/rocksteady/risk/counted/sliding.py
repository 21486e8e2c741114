"""Friction that rocking needs under the motions of a suite, and the level where it is spent."""

from collections.abc import Sequence
from typing import Final

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.errors import ModelError
from rocksteady.model.blocks.block import Block
from rocksteady.results.numbers import number
from rocksteady.risk.counted.motions import Motion, across
from rocksteady.risk.counted.suite import PGA
from rocksteady.risk.screens.friction import FrictionNeed, needed_friction, uplift_acceleration_g
from rocksteady.seismic.measures.scalar import compute_measure

HALVINGS: Final = 60
"""Of the interval of levels, to the last digit."""
JUST_ABOVE: Final = 1.0 + 1e-6
"""Multiple of an uplift at which it lifts: the need can jump there."""
WIDEST: Final = 1e6
"""Multiple of the lowest level up to which sliding is looked for."""


def friction_at(blocks: Sequence[Block], pga_g: Floats, vertical_g: float = 0.0) -> FrictionNeed:
    """Return the friction that the worst of some blocks needs under the worst of some peaks [g]."""
    worst = float(np.max(pga_g))
    needs = [needed_friction(block, worst, vertical_g) for block in blocks]
    return max(needs, key=lambda need: need.largest)


def sliding_level(
    blocks: Sequence[Block], motions: Sequence[Motion], at_one: Floats, friction: float
) -> float:
    """Return the level above which a block slides under some motion; inf where none does.

    Parameters
    ----------
    blocks, motions
        The blocks, and the motions as they are.
    at_one
        Measure of the levels of the motions as they are, shape (blocks, motions).
    friction
        Coefficient of friction.

    Raises
    ------
    ModelError
        If a block slides before it lifts.
    """
    peaks = np.array([compute_measure(across(each), PGA) for each in motions])
    lowest = np.inf
    for block, ones in zip(blocks, at_one, strict=True):
        worst = float((peaks / ones).max())  # peak acceleration [g] of the worst motion at level 1

        def need(level: float, block: Block = block, worst: float = worst) -> float:
            return needed_friction(block, level * worst).largest

        uplift = JUST_ABOVE * uplift_acceleration_g(block) / worst
        if need(uplift) > friction:
            raise ModelError(
                "friction",
                friction,
                f"it slides before it lifts: rocking takes {number(need(uplift))} or more",
                "give a higher friction, or leave it out to see what is needed",
            )
        low, high = uplift, WIDEST * uplift
        if need(high) > friction:
            for _ in range(HALVINGS):
                middle = 0.5 * (low + high)
                low, high = (middle, high) if need(middle) <= friction else (low, middle)
            lowest = min(lowest, low)
    return lowest
