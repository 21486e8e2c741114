"""From the nouns of the model to the flat tables of the kernels."""

import math

import numpy as np
from numpy.typing import NDArray

from rocksteady.kernels import march as columns
from rocksteady.model.block import DimensionlessBlock
from rocksteady.model.motions import Motion, Segment

Floats = NDArray[np.float64]


def segment_table(motion: Motion) -> Floats:
    """Return the table of a motion's segments, with a still base for ever after.

    Returns
    -------
    ndarray, shape (segments, 8)
        Columns as in `rocksteady.kernels.march`; the last segment is endless.
    """
    segments = list(motion.segments())
    if not segments or segments[-1].duration != math.inf:
        segments.append(Segment(duration=math.inf))
    table = np.zeros((len(segments), columns.SEGMENT_COLUMNS))
    for row, segment in zip(table, segments, strict=True):
        row[columns.DURATION] = segment.duration
        row[columns.JUMP] = segment.jump
        row[columns.CONSTANT] = segment.constant
        row[columns.SLOPE] = segment.slope
        row[columns.AMPLITUDE] = segment.amplitude
        # Kept at amplitude 0 too: it is the clock by which harmonic shaking counts its cycles.
        row[columns.FREQUENCY] = segment.frequency
        row[columns.PHASE] = segment.phase if segment.frequency else 0.0
    table[:, columns.CEILING] = _ceilings(table)
    return table


def _ceilings(table: Floats) -> Floats:
    """Return an upper bound of |a| from each segment's start on; infinite before a jump to come."""
    start = table[:, columns.CONSTANT]
    endless = np.isinf(table[:, columns.DURATION])  # without a slope, whose product would be nan
    rise = table[:, columns.SLOPE] * np.where(endless, 0.0, table[:, columns.DURATION])
    largest = np.maximum(np.abs(start), np.abs(start + rise)) + table[:, columns.AMPLITUDE]
    ceilings: Floats = np.maximum.accumulate(largest[::-1])[::-1]
    jumps = np.flatnonzero(table[:, columns.JUMP])
    if len(jumps):
        ceilings[: jumps[-1]] = math.inf
    return ceilings


def side_table(block: DimensionlessBlock) -> Floats:
    """Return the block's sides, shape (2, 3): restitution, alpha ratio and p ratio."""
    return np.array(block.sides)
