"""Tables of the nonlinear model: the linear ones plus slenderness and vertical motion.

Each segment of the horizontal motion is cut where the vertical acceleration, which is linear from
sample to sample, bends; so both are in closed form on every segment.
"""

import math

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.errors import ModelError
from rocksteady.kernels.core import tables as columns
from rocksteady.kernels.core.motions import fill_bounds
from rocksteady.kernels.core.tuples import Tables
from rocksteady.model.blocks.block import Block
from rocksteady.model.linear_tables import segment_table
from rocksteady.model.motions.record import Record
from rocksteady.model.motions.segments import Motion

SHARE_OF_TOLERANCE = 1e-5
"""What a step may leave out, over the tolerance: that of ten thousand steps stays below it."""

SAME_TIME = 1e-9
"""Part of a segment by which a bend of the vertical motion may miss its ends and still be there."""


def side_table(block: Block, tolerance: float) -> Floats:
    """Return a block's sides, with slenderness and what a step may leave out, shape (2, 5)."""
    sides = np.zeros((2, columns.NONLINEAR_SIDE_COLUMNS))
    sides[:, : columns.ALPHA] = block.dimensionless().sides
    sides[:, columns.ALPHA] = block.positive.alpha, block.negative.alpha
    sides[:, columns.LEFT_OUT] = SHARE_OF_TOLERANCE * tolerance
    return sides


def lower(
    block: Block, motion: Motion | Record, vertical: Motion | Record | None, tolerance: float
) -> Tables:
    """Return the tables of a block and its base motion, with a still base after it.

    Raises
    ------
    ModelError, InputError
        As for `rocksteady.model.equations.Nonlinear.lower`.
    """
    flat, lifted = segment_table(motion, block), None
    if vertical is not None:
        if flat.shape[1] > columns.ORDERS:
            raise ModelError(
                "vertical",
                vertical,
                "no vertical motion goes with a Fourier series",
                "leave it out, or sample the horizontal motion into a Record",
            )
        lifted = segment_table(vertical, block)
        last = lifted[-1]
        if lifted[:, columns.AMPLITUDE].any() or lifted[:, columns.JUMP].any() or last[2:4].any():
            raise ModelError(
                "vertical",
                vertical,
                "vertical motion is linear between samples, and comes to an end",
                "give a Record of its samples, or a Piecewise of straight lines",
            )
    return Tables(lifted_table(flat, lifted, block.positive.alpha), side_table(block, tolerance))


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
        Columns as in `rocksteady.kernels.core.tables`; the last segment is endless.
    """
    if flat.shape[1] > columns.ORDERS:
        return flat  # with room for the vertical motion that there is none of
    if lifted is None:
        table = np.zeros((len(flat), columns.NONLINEAR_SEGMENT_COLUMNS))
        table[:, : columns.SEGMENT_COLUMNS] = flat
        return table
    starts, bends = (
        np.concatenate([[0.0], np.cumsum(each[:-1, columns.DURATION])]) for each in (flat, lifted)
    )
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
