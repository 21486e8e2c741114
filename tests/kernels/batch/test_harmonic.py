"""Many cases at once: as the march alone, whatever threads they are dealt to."""

import math
from concurrent.futures import ThreadPoolExecutor
from typing import NamedTuple

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady.kernels.batch.harmonic import harmonic_segment
from rocksteady.kernels.core.tables import AT_REST, OVERTURNED, ROCKING
from tests.kernels.fates import harmonic_fates
from tests.kernels.tables import both_sides, harmonic, run
from tests.strategies import PLAIN, sample_size

Floats = NDArray[np.float64]


class Fates(NamedTuple):
    status: NDArray[np.int64]
    impacts: NDArray[np.int64]
    final: Floats


def fates(columns: Floats, cycles: int) -> Fates:
    """Run cells given as rows of amplitude, frequency, restitution, angle, velocity, phase."""
    count = len(columns)
    found = Fates(np.zeros(count, np.int64), np.zeros(count, np.int64), np.zeros((count, 3)))
    amplitude, frequency, restitution, angle, velocity, phase = columns.T.copy()
    harmonic_fates(amplitude, frequency, restitution, angle, velocity, phase, cycles, *found)
    return found


def unit_b1(side: int, velocity: float = 0.3) -> Floats:
    """Return work unit B1 on a grid of side x side."""
    frequency, amplitude = np.meshgrid(np.linspace(1.0, 12.0, side), np.linspace(1.0, 6.0, side))
    columns = np.zeros((side * side, 6))
    columns[:, 0], columns[:, 1] = amplitude.ravel(), frequency.ravel()
    columns[:, 2], columns[:, 4] = 0.8, velocity
    return columns


@pytest.mark.skipif(PLAIN, reason="two million impacts need compiled code")
def test_the_survivors_of_work_unit_b1() -> None:
    found = fates(unit_b1(100), 200)
    assert int((found.status != OVERTURNED).sum()) == 6397
    # The number of impacts depends on when chatter is cut short: 2.169 million without.
    assert 2.14e6 < found.impacts.sum() < 2.17e6


def test_a_batch_is_its_marches_one_by_one() -> None:
    cycles = sample_size(200, 20)
    columns = unit_b1(sample_size(20, 4))
    columns = np.vstack([columns, unit_b1(4, velocity=0.0), unit_b1(4, velocity=-0.2)])
    columns[::3, 5] = 2.5
    columns[1::7, 3] = -0.1
    found = fates(columns, cycles)
    for i, (amplitude, frequency, restitution, angle, velocity, phase) in enumerate(
        columns.tolist()
    ):
        side = 1 if angle > 0.0 or (angle == 0.0 and velocity > 0.0) else -1
        if angle == 0.0 and velocity == 0.0:
            side = 0
        alone = run(
            harmonic(amplitude, frequency, phase),
            both_sides(restitution),
            side=side,
            angle=angle,
            velocity=velocity,
            half_cycles=2 * cycles,
        )
        assert alone.status == found.status[i]
        assert alone.end.impacts == found.impacts[i]
        assert (alone.end.angle, alone.end.velocity, alone.end.phase) == tuple(found.final[i])
    assert {ROCKING, OVERTURNED} <= set(found.status.tolist())


def test_threads_change_nothing_however_the_cells_are_dealt() -> None:
    cycles = sample_size(100, 5)
    columns = unit_b1(sample_size(40, 5))
    whole = fates(columns, cycles)
    for threads in (2, 3):
        with ThreadPoolExecutor(threads) as pool:
            parts = list(
                pool.map(lambda k, n=threads: fates(columns[k::n], cycles), range(threads))
            )
        for k, part in enumerate(parts):
            for one, other in zip(part, whole, strict=True):
                assert np.array_equal(one, other[k::threads])


def test_the_base_still_nothing_moves() -> None:
    columns = unit_b1(3, velocity=0.0)
    columns[:, 0] = 0.0
    found = fates(columns, 10)
    assert np.all(found.status == AT_REST)
    assert np.all(found.impacts == 0)


def test_harmonic_shaking_is_one_endless_segment() -> None:
    row = np.full((1, 9), 7.0)
    harmonic_segment(row, 2.0, 3.0, 0.5)
    assert row[0].tolist() == [math.inf, 0.0, 0.0, 0.0, 2.0, 3.0, 0.5, 2.0, 0.0]
