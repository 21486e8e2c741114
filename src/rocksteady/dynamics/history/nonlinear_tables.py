"""Tables of the nonlinear model: the linear ones plus slenderness and vertical motion.

Each segment of the horizontal motion is cut where the vertical acceleration, which is linear from
sample to sample, bends; so both are in closed form on every segment.
"""

import math

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.dynamics.history.base_motion import segment_starts
from rocksteady.dynamics.history.lowering import (
    segment_table,
    side_attributes,
)
from rocksteady.errors import ModelError
from rocksteady.kernels.core import tables as columns
from rocksteady.kernels.core.motions import fill_bounds
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.equations import Linear, Model, Nonlinear, slender_block
from rocksteady.model.motions.record import Record
from rocksteady.model.motions.segments import Motion

SHARE_OF_TOLERANCE = 1e-5
"""What a step may leave out, over the tolerance: that of ten thousand steps stays below it."""

SAME_TIME = 1e-9
"""Part of a segment by which a bend of the vertical motion may miss its ends and still be there."""


def sides_of(block: Block | DimensionlessBlock, model: Model) -> Floats:
    """Return the block's sides for a model, shape (2, 3) or (2, 5).

    Raises
    ------
    ModelError
        If the nonlinear model meets a block without slenderness.
    """
    if isinstance(model, Linear):
        return np.array(block.dimensionless().sides)
    return nonlinear_side_table(block, model.tolerance)


def attributes_of(block: Block | DimensionlessBlock, model: Model) -> dict[str, float | str]:
    """Return the attributes of a dataset for its block and its model."""
    attributes: dict[str, float | str] = {**side_attributes(block), "model": model.name}
    if isinstance(model, Nonlinear):
        attributes["alpha"] = slender_block(block).positive.alpha
    return attributes


def nonlinear_side_table(block: Block | DimensionlessBlock, tolerance: float) -> Floats:
    """Return the block's sides for the nonlinear model, shape (2, 5).

    Parameters
    ----------
    block
        The block; its slenderness matters.
    tolerance
        What errors may amount to, as a part of the motion.

    Raises
    ------
    ModelError
        If the block has no slenderness.
    """
    body = slender_block(block)
    sides = np.zeros((2, columns.NONLINEAR_SIDE_COLUMNS))
    sides[:, : columns.ALPHA] = body.dimensionless().sides
    sides[:, columns.ALPHA] = body.positive.alpha, body.negative.alpha
    sides[:, columns.LEFT_OUT] = SHARE_OF_TOLERANCE * tolerance
    return sides


def nonlinear_segment_table(
    motion: Motion | Record,
    block: Block | DimensionlessBlock,
    vertical: Motion | Record | None = None,
) -> Floats:
    """Return the table of a horizontal and a vertical base motion, with a still base after both.

    Parameters
    ----------
    motion
        The horizontal base motion.
    block
        The block that it shakes.
    vertical
        The vertical base motion, upwards positive: a record, or segments without sinusoid.

    Returns
    -------
    ndarray, shape (segments, 12)
        Columns as in `rocksteady.kernels.core.tables`; the last segment is endless.

    Raises
    ------
    ModelError
        If the block has no slenderness, the vertical motion has a sinusoid, an impulse or no end,
        or there is one beside a Fourier series.
    InputError
        As for `rocksteady.dynamics.history.lowering.segment_table`.
    """
    body = slender_block(block)
    flat = segment_table(motion, body)
    if vertical is None:
        return lifted_table(flat)
    if flat.shape[1] > columns.ORDERS:
        raise ModelError(
            "vertical",
            vertical,
            "no vertical motion goes with a Fourier series",
            "leave it out, or sample the horizontal motion into a Record",
        )
    lifted = segment_table(vertical, body)
    last = lifted[-1]
    if lifted[:, columns.AMPLITUDE].any() or lifted[:, columns.JUMP].any() or last[2:4].any():
        raise ModelError(
            "vertical",
            vertical,
            "vertical motion is linear between samples, and comes to an end",
            "give a Record of its samples, or a Piecewise of straight lines",
        )
    return lifted_table(flat, lifted, body.positive.alpha)


def lifted_table(flat: Floats, lifted: Floats | None = None, share: float = 1.0) -> Floats:
    """Return the table of a horizontal and a vertical motion, cut where either has a new segment.

    Parameters
    ----------
    flat, lifted
        Their tables, shape (segments, 9), in one unit of time and one of acceleration; none for a
        base that does not move vertically.
    share
        What the unit of acceleration is in g: the vertical motion counts in that.

    Returns
    -------
    ndarray, shape (segments, 12)
        As for `nonlinear_segment_table`.
    """
    if flat.shape[1] > columns.ORDERS:
        return flat  # with room for the vertical motion that there is none of
    if lifted is None:
        table = np.zeros((len(flat), columns.NONLINEAR_SEGMENT_COLUMNS))
        table[:, : columns.SEGMENT_COLUMNS] = flat
        return table
    starts, bends = segment_starts(flat), segment_starts(lifted)
    # A bend that rounding puts beside a start is at the start.
    after = np.searchsorted(starts, bends)
    later = np.append(starts, math.inf)[after]
    nearest = np.minimum(np.abs(later - bends), np.abs(bends - starts[np.maximum(after - 1, 0)]))
    lengths = lifted[:, columns.DURATION].copy()
    lengths[-1] = lengths[-2] if len(lengths) > 1 else 1.0
    kept = bends[nearest > SAME_TIME * lengths]
    cuts = np.union1d(starts, kept)
    table = np.zeros((len(cuts), columns.NONLINEAR_SEGMENT_COLUMNS))
    index = np.searchsorted(starts, cuts, side="right") - 1
    since = cuts - starts[index]
    table[:, : columns.ALIKE] = flat[index, : columns.ALIKE]
    ends = np.append(cuts[1:], math.inf)
    whole = (since == 0.0) & np.isin(ends, np.append(starts, math.inf))
    table[:, columns.DURATION] = np.where(whole, flat[index, columns.DURATION], ends - cuts)
    table[:, columns.JUMP] = np.where(since == 0.0, flat[index, columns.JUMP], 0.0)
    table[:, columns.CONSTANT] += flat[index, columns.SLOPE] * since
    table[:, columns.PHASE] += flat[index, columns.FREQUENCY] * since
    fill_bounds(table)
    middle = np.append(0.5 * (cuts[:-1] + cuts[1:]), math.inf)
    above = np.searchsorted(bends, middle, side="right") - 1
    slope = lifted[above, columns.SLOPE]
    table[:, columns.LIFT] = share * (
        lifted[above, columns.CONSTANT] + slope * np.maximum(cuts - bends[above], 0.0)
    )
    table[:, columns.LIFT_SLOPE] = share * slope
    lift = np.zeros((len(cuts), columns.SEGMENT_COLUMNS))
    lift[:, columns.DURATION] = table[:, columns.DURATION]
    lift[:, columns.CONSTANT] = table[:, columns.LIFT]
    lift[:, columns.SLOPE] = table[:, columns.LIFT_SLOPE]
    fill_bounds(lift)
    table[:, columns.LIFT_CEILING] = lift[:, columns.CEILING]
    return table


def refuse_vertical(vertical: Motion | Record | None) -> None:
    """Refuse vertical motion in the linear model.

    Raises
    ------
    ModelError
        If there is one.
    """
    if vertical is not None:
        raise ModelError(
            "vertical",
            vertical,
            "the linear equations of motion have no term for it",
            "take Nonlinear(), or leave it out",
        )
