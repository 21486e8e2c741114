"""Waiting at rest: the first sample that may lift a block, and the same bits without a search."""

import math

import numpy as np
from numpy.typing import NDArray

from rocksteady.kernels.batch.records import FEW, record_fates
from rocksteady.kernels.batch.waiting import fill_hardest, waits_until
from rocksteady.kernels.core.tables import (
    ALIKE,
    ALPHA,
    AMPLITUDE,
    CEILING,
    JUMP,
    LEAN,
    LEFT_OUT,
    LIFT,
    LIFT_CEILING,
    LIFT_SLOPE,
    NONLINEAR_SEGMENT_COLUMNS,
    NONLINEAR_SIDE_COLUMNS,
    RATE,
    RESTITUTION,
    SEGMENT_COLUMNS,
    SIDE_COLUMNS,
)
from rocksteady.kernels.core.tuples import Blocks, PeakFates
from tests.every import every
from tests.kernels.tables import sampled
from tests.records import synthetic
from tests.strategies import sample_size

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

STEP = 0.02
SAMPLES = 400


def shaken(*, nonlinear: bool, lift: float) -> Floats:
    """Return a record that swells from nothing and dies away, with vertical motion."""
    rng = np.random.default_rng(5)
    grown = np.sin(np.linspace(0.0, math.pi, SAMPLES)) ** 4
    flat = sampled(synthetic(rng, SAMPLES, STEP, 3.0) * grown, STEP)
    if not nonlinear:
        return flat
    wide = np.zeros((len(flat), NONLINEAR_SEGMENT_COLUMNS))
    wide[:, :SEGMENT_COLUMNS] = flat
    up = np.append(synthetic(rng, SAMPLES, STEP, 1.0) * grown * lift, 0.0)
    wide[:, LIFT] = up[: len(flat)]
    wide[:-1, LIFT_SLOPE] = np.diff(up)[: len(flat) - 1] / STEP
    wide[:-2, LIFT_CEILING] = np.maximum.accumulate(np.abs(up[:SAMPLES])[::-1])[::-1][:-2] + 1e-3
    return wide


def blocks(count: int, *, nonlinear: bool) -> Floats:
    """Return unlike sides that lift at anything from almost nothing to more than there is."""
    rng = np.random.default_rng(6)
    sides = np.zeros((count, 2, NONLINEAR_SIDE_COLUMNS if nonlinear else SIDE_COLUMNS))
    sides[:, :, RESTITUTION] = rng.uniform(0.5, 0.95, (count, 2))
    sides[:, :, LEAN] = np.geomspace(0.02, 5.0, count)[:, np.newaxis] * rng.uniform(
        1, 2, (count, 2)
    )
    sides[:, :, RATE] = rng.uniform(1.0, 4.0, (count, 1))
    if nonlinear:
        sides[:, :, ALPHA] = rng.uniform(0.1, 0.3, (count, 1))
        sides[:, :, LEFT_OUT] = 1e-15
    return sides


def uplifts(sides: Floats) -> float:
    """Return the base acceleration, over the weight, that lifts the block."""
    if len(sides[0]) == SIDE_COLUMNS:
        return float(sides[:, LEAN].min())
    return float((sides[:, LEAN] * np.tan(sides[:, ALPHA]) / sides[:, ALPHA]).min())


@every(("nonlinear", "lift"), [(False, 0.0), (True, 0.0), (True, 0.6)])
def test_a_block_waits_for_the_first_sample_beyond_its_uplift(nonlinear: bool, lift: float) -> None:
    segments = shaken(nonlinear=nonlinear, lift=lift)
    hardest = np.empty(len(segments) - 1)
    fill_hardest(segments, nonlinear, hardest)
    ratios = np.abs(segments[:-1, 2]) / (1.0 + (segments[:-1, LIFT] if nonlinear else 0.0))
    waits = []
    for sides in blocks(60, nonlinear=nonlinear):
        beyond = np.flatnonzero(ratios >= uplifts(sides))
        # The line between two samples ends in the second of them.
        expected = max(int(beyond[0]) - 1, 0) if len(beyond) else len(segments) - 1
        assert waits_until(hardest, sides) == expected
        waits.append(expected)
    assert len(set(waits)) > 10
    assert len(segments) - 1 in waits  # some never lift


@every(("nonlinear", "lift"), [(False, 0.0), (True, 0.0), (True, 0.6), (True, 3.0)])
@every("change", ["none", "jump", "sinusoid", "unlike"])
def test_cells_that_share_a_table_fare_as_those_that_wait_step_by_step(
    nonlinear: bool, lift: float, change: str
) -> None:
    segments = shaken(nonlinear=nonlinear, lift=lift)
    if change == "jump":
        segments[30, JUMP] = 0.3
        segments[:30, CEILING] = math.inf
    elif change == "sinusoid":
        segments[30, AMPLITUDE] = 1.0
        segments[30, 5] = 9.0
        segments[:31, CEILING] += 1.0
        segments[:31, ALIKE] = 0.0
    elif change == "unlike":
        segments[:, ALIKE] = 0.0
    count = sample_size(40, 4)
    sides = blocks(count, nonlinear=nonlinear)
    assert count > FEW
    ends = set()
    for limit in sample_size((10**6, 150), (150,)):
        together = fates(segments, sides, limit)
        alone = [fates(segments, sides[i : i + 1], limit) for i in range(count)]
        for column, single in zip(together, zip(*alone, strict=True), strict=True):
            np.testing.assert_array_equal(column, np.concatenate(single))
        ends |= set(together[0].tolist())
    assert len(ends) > 1 or count < 40  # as plain Python, of few cells all may end alike


def fates(segments: Floats, sides: Floats, limit: int) -> tuple[Integers, Integers, Floats]:
    count = len(sides)
    status, impacts = np.zeros(count, np.int64), np.zeros(count, np.int64)
    peaks = np.zeros((count, 2))
    record_fates(
        segments, Blocks(sides, np.full(count, 50.0)), limit, PeakFates(status, impacts, peaks)
    )
    return status, impacts, peaks
