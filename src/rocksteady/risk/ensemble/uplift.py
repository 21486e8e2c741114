"""The first uplift from rest, in closed form on the lines of a record: at which scale, and when.

A block at rest lifts to the side that the base drives when a > (g + a_v) tan alpha, unless a wall
stands there.  Between two
samples both sides of this are lines, so that the moment is a crossing of two lines.
"""

from collections.abc import Iterator, Sequence
from itertools import product
from typing import NamedTuple

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.kernels.elementary.arrays import tan
from rocksteady.model.blocks.block import Block
from rocksteady.model.motions.record import Record
from rocksteady.seismic.spectra.batch import GroundShaking
from rocksteady.seismic.spectra.many import DIRECTIONS


class Lines(NamedTuple):
    """Straight lines one after the other, shape (lines,) each."""

    start_s: Floats
    length_s: Floats
    first: Floats
    last: Floats

    def first_above(self, levels: Floats) -> Floats:
        """Return when the lines first rise above some levels [s]; nan where they never do."""
        most = np.maximum.accumulate(np.maximum(self.first, self.last))
        at = np.searchsorted(most, levels, side="right")
        reached = at < len(most)
        at = np.minimum(at, len(most) - 1)
        first, last = self.first[at], self.last[at]
        with np.errstate(divide="ignore", invalid="ignore"):
            part = np.where(first > levels, 0.0, (levels - first) / (last - first))
        return np.where(reached, self.start_s[at] + part * self.length_s[at], np.nan)


def driving(
    record: Record, sign: float, lift: float = 0.0, vertical: Record | None = None
) -> Lines:
    """Return the lines of ``sign a - lift a_v``.

    Parameters
    ----------
    record, vertical
        The horizontal and the vertical component, if any.
    sign
        1 or -1, for the side that is driven.
    lift
        tan alpha of that side; it matters with a vertical component alone.
    """
    samples: Floats = sign * record.acceleration_m_s2
    if vertical is None:
        count = len(samples) - 1
        start: Floats = record.dt_s * np.arange(count, dtype=np.float64)
        return Lines(start, np.full(count, record.dt_s), samples[:-1], samples[1:])
    record_times = record.dt_s * np.arange(len(samples))
    vertical_times = vertical.dt_s * np.arange(len(vertical.acceleration_m_s2))
    times = np.union1d(record_times, vertical_times)
    ends = []
    for at, beside in ((times[:-1], times[1:]), (times[1:], times[:-1])):
        value = np.zeros(len(at))
        for t, y, factor in (
            (record_times, samples, 1.0),
            (vertical_times, vertical.acceleration_m_s2, -lift),
        ):
            # After its last sample a component is nothing, at once.
            shaken = np.maximum(at, beside) <= t[-1]
            value += factor * np.where(shaken, np.interp(at, t, y), 0.0)
        ends.append(value)
    lengths: Floats = np.diff(times)
    return Lines(times[:-1], lengths, ends[0], ends[1])


def uplift_limits(blocks: Sequence[Block], *, linear: bool) -> tuple[Floats, Floats]:
    """Return the base acceleration that lifts each side, over g and in m/s^2.

    It is g tan(alpha), of the linear model g alpha, and in m/s^2 inf of a side against a wall.

    Returns
    -------
    tuple of ndarray, shape (blocks, 2)
    """
    alphas = [(block.positive.alpha, block.negative.alpha) for block in blocks]
    ratios = np.array(alphas if linear else [[tan(angle) for angle in pair] for pair in alphas])
    limits: Floats = ratios * np.array([block.gravity for block in blocks])[:, np.newaxis]
    limits[[block.one_sided for block in blocks], 1] = np.inf  # the wall holds it
    return ratios, limits


def uplift_scales(
    blocks: Sequence[Block],
    grounds: Sequence[GroundShaking],
    directions: Sequence[str],
    lifts: Sequence[str],
    *,
    linear: bool,
) -> Floats:
    """Return the factor of the accelerations above which blocks at rest lift; inf where none does.

    Parameters
    ----------
    blocks, grounds, directions, lifts, linear
        As for `uplift_times`.

    Returns
    -------
    ndarray, shape (blocks, records, directions, verticals)
    """
    ratios, limits = uplift_limits(blocks, linear=linear)
    least = np.full((len(blocks), len(grounds), len(directions), len(lifts)), np.inf)
    for place, column, driven in _drives(ratios, grounds, directions, lifts):
        tops = np.array([max(lines.first.max(), lines.last.max()) for lines in driven])
        with np.errstate(divide="ignore"):
            scales = np.where(tops > 0.0, limits[:, column] / tops, np.inf)
        least[:, *place] = np.minimum(least[:, *place], scales)
    return least


def _drives(
    ratios: Floats,
    grounds: Sequence[GroundShaking],
    directions: Sequence[str],
    lifts: Sequence[str],
) -> Iterator[tuple[tuple[int, int, int], int, list[Lines]]]:
    """Yield place, driven side and the lines of each block, for both sides of each run."""
    runs = product(enumerate(grounds), enumerate(directions), enumerate(lifts))
    for (i, ground), (j, direction), (k, lift) in runs:
        vertical = ground.vertical if lift == "with" else None
        sign = -1.0 if direction == DIRECTIONS[1] else 1.0
        for column, side in ((0, sign), (1, -sign)):
            shares = ratios[:, column].tolist()
            if vertical is None:  # the lines are the same for all blocks
                driven = [driving(ground.record, side)] * len(shares)
            else:
                driven = [driving(ground.record, side, share, vertical) for share in shares]
            yield (i, j, k), column, driven


def uplift_times(
    blocks: Sequence[Block],
    grounds: Sequence[GroundShaking],
    scale: Floats,
    directions: Sequence[str],
    lifts: Sequence[str],
    *,
    linear: bool,
) -> Floats:
    """Return when blocks at rest first lift [s], nan where they do not.

    Parameters
    ----------
    blocks, grounds
        The blocks and what shakes them.
    scale
        Factor of the accelerations, shape (blocks, records, levels).
    directions, lifts
        As in the coordinates of the result.
    linear
        Whether a block lifts above alpha g, not above g tan alpha.

    Returns
    -------
    ndarray, shape (blocks, records, directions, verticals, levels)
    """
    ratios, limits = uplift_limits(blocks, linear=linear)
    count, records, levels = scale.shape
    earliest = np.full((count, records, len(directions), len(lifts), levels), np.nan)
    for place, column, driven in _drives(ratios, grounds, directions, lifts):
        thresholds = limits[:, column, np.newaxis] / scale[:, place[0]]
        rows = zip(driven, thresholds, strict=True)
        times = np.stack([lines.first_above(row) for lines, row in rows])
        earliest[:, *place] = np.fmin(earliest[:, *place], times)
    return earliest
