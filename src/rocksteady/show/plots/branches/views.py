"""Scales of a diagram of branches: its parameter, and the extremes of flights."""

from collections.abc import Iterable
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.show.style import palette
from rocksteady.show.style.scales import Scale, scale_of

AnyBlock = Block | DimensionlessBlock
Side = Literal["positive", "both"]


class View(NamedTuple):
    """How a diagram is drawn.

    Attributes
    ----------
    across, up
        Scales of the parameter and of extremes.
    sizes
        Whether the sizes of extremes are drawn, without their sides.
    """

    across: Scale
    up: Scale
    sizes: bool

    def x(self, values: ArrayLike) -> Floats:
        """Return values of the parameter as they are drawn."""
        drawn: Floats = self.across.factor * np.asarray(values, dtype=np.float64)
        return drawn

    def y(self, extremes: ArrayLike) -> Floats:
        """Return extremes as they are drawn."""
        drawn: Floats = self.up.factor * np.asarray(extremes, dtype=np.float64)
        return np.abs(drawn) if self.sizes else drawn


def view_of(parameter: str, block: AnyBlock | None, side: Side) -> View:
    """Return the scales of a diagram, in the units of a block of known size."""
    name, tilt = "flight_peak" if side == "positive" else "flight_extreme", scale_of("peak", block)
    up = Scale(1.0, palette.LABELS[name])
    if tilt.far:
        up = Scale(tilt.factor, palette.LABELS[f"{name}_deg"], palette.LABELS[name])
    return View(scale_of(parameter, block), up, side == "positive")


def shared_size(blocks: Iterable[AnyBlock]) -> Block | None:
    """Return the first of several blocks if all have its size; None without one.

    Examples
    --------
    >>> block = Block.rectangle(width=0.4, height=1.2)
    >>> shared_size([block, block.with_restitution(0.8)]) is block
    True
    >>> shared_size([block, Block.rectangle(width=0.4, height=1.3)]) is None
    True
    """
    listed = list(blocks)
    sizes = {_size(block) for block in listed}
    first = listed[0]
    return first if isinstance(first, Block) and len(sizes) == 1 else None


def _size(block: AnyBlock) -> tuple[float, ...]:
    if isinstance(block, DimensionlessBlock):
        return ()
    sides = (block.positive, block.negative)
    return (block.gravity, *(value for side in sides for value in (side.alpha, side.p)))
