"""Many motions at once settle as each does alone, whatever threads they are dealt to."""

import math
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from numpy.typing import NDArray

from rocksteady import DimensionlessBlock, Harmonic, State, find_attractor
from rocksteady.kernels.batch.attractors import (
    AFTER,
    HIGHEST,
    LOWEST,
    LYAPUNOV,
    ORBIT_PHASE,
    ORBIT_SIDE,
    ORBIT_SPEED,
    OUTCOME,
    PASSAGES,
    PERIODS,
    REAL_COLUMNS,
    SYMMETRIC,
    WHOLE_COLUMNS,
    settle_cells,
)
from rocksteady.kernels.core.clock import clock
from rocksteady.kernels.core.tables import RESTITUTION
from rocksteady.kernels.core.tuples import Cells, Outcomes, States
from rocksteady.kernels.orbits.periodic import ORBIT_COLUMNS, distance, state_at
from rocksteady.kernels.orbits.return_map import AnyState, Section
from rocksteady.kernels.orbits.settle import LONGEST_ORBIT, MEMORY, PERIODIC, settle
from rocksteady.kernels.orbits.systems import make_system
from tests.kernels.tables import both_sides
from tests.strategies import sample_size

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

COUNT = sample_size(150, 12)
CYCLES = sample_size(300, 40)


def drawn() -> tuple[Floats, Integers]:
    """Return amplitude, frequency, restitution, angle, velocity, phase; and side, half cycles."""
    rng = np.random.default_rng(11)
    real = np.empty((6, COUNT))
    real[0] = 10.0 ** rng.uniform(-0.3, 0.8, COUNT)
    real[1] = 10.0 ** rng.uniform(-0.2, 1.0, COUNT)
    real[2] = rng.uniform(0.1, 0.95, COUNT)
    real[3] = rng.uniform(-0.6, 0.6, COUNT)
    real[4] = rng.uniform(-0.3, 0.3, COUNT)
    real[5] = rng.uniform(0.0, math.pi, COUNT)
    real[3:5, ::4] = 0.0
    side = np.sign(real[3]).astype(np.int64)
    return real, np.array([side, rng.integers(0, 2, COUNT)])


def settled(real: Floats, whole: Integers) -> tuple[Integers, Floats]:
    count = real.shape[1]
    whole_rows = np.empty((count, WHOLE_COLUMNS), dtype=np.int64)
    found = Outcomes(whole_rows, np.empty((count, REAL_COLUMNS)))
    a, w, r, angle, velocity, phase = np.ascontiguousarray(real)
    side, half = np.ascontiguousarray(whole)
    sides = np.ones((count, 2, 3))
    sides[:, :, RESTITUTION] = r[:, np.newaxis]
    settle_cells(Cells(a, w, sides), States(side, angle, velocity, half, phase), CYCLES, found)
    return found


def test_each_cell_is_a_motion_alone() -> None:
    real, whole = drawn()
    numbers, values = settled(real, whole)
    memory, table = np.zeros((MEMORY, ORBIT_COLUMNS)), np.zeros((LONGEST_ORBIT, ORBIT_COLUMNS))
    outcomes = set()
    for i in range(COUNT):
        a, w, r, angle, velocity, phase = real[:, i].tolist()
        side, half = whole[:, i].tolist()
        system = make_system(a, w, both_sides(r))
        alone = settle(system, AnyState(side, half, phase, angle, velocity), CYCLES, memory, table)
        outcomes.add(alone.outcome)
        assert numbers[i, OUTCOME] == alone.outcome
        assert numbers[i, AFTER] == alone.after
        assert np.array_equal(values[i, LYAPUNOV], alone.lyapunov, equal_nan=True)
        if alone.outcome != PERIODIC:
            assert np.isnan(values[i, [ORBIT_PHASE, ORBIT_SPEED, HIGHEST, LOWEST]]).all()
            continue
        assert (numbers[i, PASSAGES], numbers[i, PERIODS]) == (alone.passages, alone.periods)
        on, turned = clock(values[i, ORBIT_PHASE])
        state = Section(int(numbers[i, ORBIT_SIDE]), on, turned, values[i, ORBIT_SPEED])
        assert distance(state_at(table, 0), state) < 1e-12
        assert values[i, HIGHEST] >= 0.0 >= values[i, LOWEST]
        if numbers[i, SYMMETRIC]:
            assert abs(values[i, HIGHEST] + values[i, LOWEST]) < 1e-7
    assert len(outcomes) >= 2


def test_peaks_are_those_of_the_orbit_alone_to_the_last_bit() -> None:
    # Where an impact lies to rounding depends on where the search for it sets out.
    real, whole = drawn()
    real[3], real[5], whole[0], whole[1] = 0.0, 0.0, np.sign(real[4]), 0
    _, values = settled(real, whole)
    compared = 0
    for i in range(COUNT):
        a, w, r, _, velocity, _ = real[:, i].tolist()
        found = find_attractor(
            DimensionlessBlock(restitution=r),
            Harmonic(amplitude=a, frequency_ratio=w),
            start=State(angle=0.0, velocity=velocity),
            max_cycles=CYCLES,
        )
        if found.orbit is not None:
            assert found.peaks == (values[i, HIGHEST], values[i, LOWEST])
            compared += 1
    assert compared > COUNT // 10


def test_threads_change_nothing_however_the_cells_are_dealt() -> None:
    real, whole = drawn()
    numbers, values = settled(real, whole)
    for threads in (2, 3):
        with ThreadPoolExecutor(threads) as pool:
            parts = list(
                pool.map(
                    lambda k, n=threads: settled(real[:, k::n], whole[:, k::n]), range(threads)
                )
            )
        for k, (some, more) in enumerate(parts):
            assert np.array_equal(some, numbers[k::threads])
            assert np.array_equal(more, values[k::threads], equal_nan=True)


def test_a_mirrored_start_settles_to_the_mirror_image() -> None:
    real, whole = drawn()
    numbers, values = settled(real, whole)
    image = real.copy()
    image[3:5] *= -1.0
    turned = np.array([-whole[0], 1 - whole[1]])
    others, more = settled(image, turned)
    assert np.array_equal(numbers[:, OUTCOME], others[:, OUTCOME])
    assert np.array_equal(numbers[:, PERIODS], others[:, PERIODS])
    assert np.array_equal(values[:, HIGHEST], -more[:, LOWEST], equal_nan=True)
    assert np.array_equal(values[:, ORBIT_SPEED], more[:, ORBIT_SPEED], equal_nan=True)
