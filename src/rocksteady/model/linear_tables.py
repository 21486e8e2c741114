"""Tables of the linear model: segments of base motions and sides of blocks, without units."""

import math

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats
from rocksteady.errors import InputError, ModelError
from rocksteady.kernels.core import tables as columns
from rocksteady.kernels.core.motions import fill_bounds, fill_lines
from rocksteady.kernels.core.tuples import Tables
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.validation import LARGEST
from rocksteady.model.motions.fourier import shares_of
from rocksteady.model.motions.record import Record
from rocksteady.model.motions.segments import LONGEST_DURATION, Motion, Segment, segments_of


def side_table(block: Block | DimensionlessBlock) -> Floats:
    """Return restitution, lean and rate of a block's sides, shape (2, 3)."""
    return np.array(block.dimensionless().sides)


def lower(block: Block | DimensionlessBlock, motion: Motion | Record) -> Tables:
    """Return the tables of a block and its base motion, with a still base after it.

    Raises
    ------
    ModelError, InputError
        As for `segment_table`.
    """
    return Tables(segment_table(motion, block), side_table(block))


def segment_table(
    motion: Motion | Record, block: Block | DimensionlessBlock | None = None
) -> Floats:
    """Return the table of a motion's segments, with a still base for ever after.

    Parameters
    ----------
    motion
        The base motion.
    block
        The block that it shakes, whose alpha, p and g a record needs.

    Returns
    -------
    ndarray, shape (segments, 9), or (segments, 13 + 2 orders) of a Fourier series
        Columns as in `rocksteady.kernels.core.tables`; the last segment is endless.

    Raises
    ------
    ModelError
        If a record shakes a dimensionless block.
    InputError
        If a record's samples are too long or too strong for the block.
    """
    if isinstance(motion, Record):
        return _record_in_units_of(motion, block)
    segments = list(segments_of(motion))
    if not segments or segments[-1].duration != math.inf:
        segments.append(Segment(duration=math.inf))
    orders = max((wave[0] for segment in segments for wave in segment.harmonics), default=0)
    width = columns.SHARES + 2 * orders if orders else columns.SEGMENT_COLUMNS
    table = np.zeros((len(segments), width))
    for row, segment in zip(table, segments, strict=True):
        row[columns.DURATION] = segment.duration
        row[columns.JUMP] = segment.jump
        row[columns.CONSTANT] = segment.constant
        row[columns.SLOPE] = segment.slope
        row[columns.AMPLITUDE] = segment.amplitude
        # Kept at amplitude 0 too: it is the clock by which harmonic shaking counts its cycles.
        row[columns.FREQUENCY] = segment.frequency
        row[columns.PHASE] = segment.phase if segment.frequency else 0.0
        if segment.harmonics:
            total, shares = shares_of(segment.harmonics)
            row[columns.AMPLITUDE] = segment.amplitude * total
            row[columns.ORDERS] = len(shares) // 2
            row[columns.SHARES : columns.SHARES + len(shares)] = shares
    fill_bounds(table)
    return table


def record_table(record: Record, *, rate: float = 1.0, acceleration: float = 1.0) -> Floats:
    """Return the table of a record, linear between samples, with a still base for ever after.

    Parameters
    ----------
    record
        The record.
    rate, acceleration
        The p [rad/s] and the alpha g [m/s^2] that set the units.  With 1 and 1 they are seconds
        and m/s^2; a block is then one whose sides have its own alpha g for lean and p for rate,
        so that one table does for every block.

    Returns
    -------
    ndarray, shape (samples, 9)
        As for `segment_table`.
    """
    samples = record.acceleration_m_s2 / acceleration
    table = np.zeros((len(samples), columns.SEGMENT_COLUMNS))
    fill_lines(samples, record.dt_s * rate, table)
    return table


def _record_in_units_of(record: Record, block: Block | DimensionlessBlock | None) -> Floats:
    """Return a record's table in the units of a block."""
    if not isinstance(block, Block):
        raise ModelError(
            "motion",
            record,
            "a record in seconds and m/s^2 needs a block with sizes",
            "give a Block, which has p and alpha g, in place of a DimensionlessBlock",
        )
    if record.dt_s * block.p > LONGEST_DURATION:
        raise InputError(
            "dt_s",
            record.dt_s,
            f"for a block with p = {block.p:.6g} rad/s it must be at most "
            f"{LONGEST_DURATION / block.p:.6g}",
            "give the time step in seconds",
        )
    if record.peak_acceleration_m_s2 > LARGEST * block.uplift_acceleration:
        raise InputError(
            "acceleration_m_s2",
            record.peak_acceleration_m_s2,
            f"a block that lifts at {block.uplift_acceleration:.6g} m/s^2 takes at most "
            f"{LARGEST:g} times as much",
            "give the acceleration in m/s^2",
        )
    return record_table(record, rate=block.p, acceleration=block.uplift_acceleration)


def only_side(sides: Floats) -> int:
    """Return the one side of a block against a wall, 1 or -1, or 0 of a block that has two."""
    if sides[0, columns.RESTITUTION] <= 0.0:
        return 1
    return -1 if sides[1, columns.RESTITUTION] <= 0.0 else 0


def mass_centres(block: Block) -> Floats:
    """Return alpha [rad] and R p^2/g of a block's sides, shape (2, 2).

    R is the distance from the pivot to the mass centre, of a frame to that of all its parts.
    """
    lever = 1.0 if block.cap is None else block.cap.lever
    sides = block.positive, block.negative
    return np.array(
        [(each.alpha, lever * each.radius * (each.p * each.p) / block.gravity) for each in sides]
    )


def weight_kn(block: Block, mass_kg: float) -> float:
    """Return the weight of a block of some mass [kN]."""
    return mass_kg * block.gravity / 1000.0


def symmetric_sides(restitution: Floats) -> Floats:
    """Return the sides of symmetric blocks, shape (blocks, 2, 3), from their restitutions."""
    sides = np.ones((len(restitution), 2, 3))
    sides[:, :, columns.RESTITUTION] = restitution[:, np.newaxis]
    return sides


def alike(sides: Floats) -> NDArray[np.bool_]:
    """Return which blocks are symmetric, from their sides, shape (blocks, 2, 3)."""
    same: NDArray[np.bool_] = (sides[:, 0] == sides[:, 1]).all(axis=1)
    return same
