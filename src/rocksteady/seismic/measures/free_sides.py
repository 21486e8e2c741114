"""Sides to which a block can rock: both, or of a block against a wall the positive one alone."""

import math
from collections.abc import Sequence
from typing import Any

from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.sides import Side


def free_sides(block: Block) -> tuple[Side, ...]:
    """Return the sides to which a block rocks, the positive one first.

    Examples
    --------
    >>> from rocksteady import Block
    >>> block = Block.rectangle(width=0.4, height=1.6)
    >>> len(free_sides(block)), len(free_sides(block.against_wall()))
    (2, 1)
    """
    return (block.positive,) if block.one_sided else (block.positive, block.negative)


def first_side(block: Block) -> Side:
    """Return the free side with the smaller alpha, which lifts first."""
    return min(free_sides(block), key=lambda side: side.alpha)


def impact_ratios(block: Block) -> tuple[float, float]:
    """Return the restitutions of a block's impacts; twice that of the wall where it has one."""
    if block.one_sided:
        return block.restitution, block.restitution
    return block.positive.restitution, block.negative.restitution


def side_coordinates(blocks: Sequence[Block]) -> dict[str, Any]:
    """Return alpha and p of the sides of blocks, and which stand against a wall, for a dataset.

    ``alpha`` and ``p`` are those of the positive side; ``negative_alpha`` and ``negative_p`` exist
    where the sides of a block differ, nan of a block without that side; ``one_sided`` where
    a block stands against a wall.
    """
    two = any(not block.symmetric and not block.one_sided for block in blocks)
    coordinates: dict[str, Any] = {}
    for prefix, side in (("", "positive"), ("negative_", "negative"))[: 1 + two]:
        of = f" of the {side} side" if two else ""
        for name, unit, words in (
            ("alpha", "rad", "slenderness"),
            ("p", "rad s-1", "frequency parameter"),
        ):
            values = [
                math.nan if prefix and block.one_sided else getattr(getattr(block, side), name)
                for block in blocks
            ]
            coordinates[f"{prefix}{name}"] = (
                "block",
                values,
                {"units": unit, "long_name": words + of},
            )
    if any(block.one_sided for block in blocks):
        against = [block.one_sided for block in blocks]
        coordinates["one_sided"] = (
            "block",
            against,
            {"long_name": "whether it stands against a wall"},
        )
    return coordinates
