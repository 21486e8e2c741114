"""Attractors found in lanes: those of the scalar code, whichever cells share the lanes."""

import math
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

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
    RESTS,
    SYMMETRIC,
)
from rocksteady.kernels.core.queue import LEFT_OVER
from rocksteady.kernels.core.tuples import Outcomes
from rocksteady.kernels.orbits.closed_form import symmetric_orbit
from rocksteady.kernels.orbits.settle import FALLS, PERIODIC, STAYS, UNSETTLED
from tests.every import every
from tests.kernels.settling import (
    Integers,
    by_lanes,
    check_against_scalar,
    one_by_one,
    random_cells,
    starting,
    unit,
)
from tests.strategies import PLAIN, sample_size


def test_random_cells_settle_as_one_by_one() -> None:
    count = sample_size(6000, 40)
    left, differ = check_against_scalar(random_cells(1, count), sample_size(200, 40))
    assert 0 < left < 0.2 * count
    assert differ < 2e-3 * count


@pytest.mark.slow
@pytest.mark.skipif(PLAIN, reason="a hundred thousand motions need compiled code")
def test_a_hundred_thousand_cells_settle_as_one_by_one() -> None:
    for seed in range(10, 15):
        left, differ = check_against_scalar(random_cells(seed, 20_000), 200)
        assert left < 3000
        assert differ < 40


@pytest.mark.skipif(PLAIN, reason="ten thousand motions need compiled code")
def test_work_unit_b1_settles_as_one_by_one() -> None:
    left, differ = check_against_scalar(unit(100), 2000)
    assert left < 100
    assert differ <= 1


def test_rests_still_blocks_and_chaos_are_left_over() -> None:
    a = np.array([0.5, 1.01, 1.7347, 2.0, 6.0])
    w = np.array([2.0, 2.0, 1.6633, 4.0, 1.0])
    r = np.array([0.8, 0.8, 0.5, 0.8, 0.8])
    cells = starting(a, w, r, 0.0, [0.3, 0.0, 0.0, 0.3, 0.3], 0.0)
    lanes, plain = by_lanes(cells, 100), one_by_one(cells, 100)
    assert plain.whole[:, OUTCOME].tolist() == [STAYS, PERIODIC, UNSETTLED, PERIODIC, FALLS]
    assert plain.whole[1, RESTS] == 2
    assert lanes.whole[:, OUTCOME].tolist() == [LEFT_OVER] * 3 + [PERIODIC, FALLS]


def test_near_a_stable_orbit_a_motion_settles_to_its_closed_form() -> None:
    for amplitude, frequency, r, order in (
        (2.0, 4.0, 0.8, 1),
        (2.0, 6.0, 0.8, 3),
        (3.0, 8.0, 0.95, 3),
    ):
        orbit = symmetric_orbit(amplitude, frequency, r, order, 1)
        speed = frequency * orbit.velocity
        cells = starting([amplitude], frequency, r, 0.0, 1.003 * speed, orbit.phase + 2e-3)
        whole, real = (part[0] for part in by_lanes(cells, 2000))
        assert (whole[OUTCOME], whole[PASSAGES], whole[PERIODS]) == (PERIODIC, 2, order)
        assert whole[SYMMETRIC] == 1
        assert real[ORBIT_SPEED] == pytest.approx(speed, rel=1e-11)
        seen = real[ORBIT_PHASE] + (0.0 if whole[ORBIT_SIDE] > 0 else math.pi)
        assert math.remainder(seen - orbit.phase, 2.0 * math.pi) == pytest.approx(0.0, abs=1e-11)
        root = np.abs(np.roots([1.0, -orbit.trace, r**2])).max()
        assert real[LYAPUNOV] == pytest.approx(2.0 * math.log(root) / order, rel=1e-7)


@every(
    ("amplitude", "frequency", "order", "branch"),
    [(1.0, 2.0, 1, 2), (2.0, 5.0, 3, 2), (2.0, 1.9, 1, 1)],
)
def test_a_motion_that_starts_on_an_unstable_orbit_never_settles_to_that(
    amplitude: float, frequency: float, order: int, branch: int
) -> None:
    orbit = symmetric_orbit(amplitude, frequency, 0.8, order, branch)
    speed = frequency * orbit.velocity
    cells = starting([amplitude], frequency, 0.8, 0.0, speed, orbit.phase)
    whole, real = (part[0] for part in by_lanes(cells, 2000))
    assert whole[OUTCOME] in (PERIODIC, FALLS, LEFT_OVER)
    if whole[OUTCOME] == PERIODIC:
        assert abs(real[ORBIT_SPEED] - speed) > 1e-3 * speed


@pytest.mark.parametrize("nonlinear", [False, True])
def test_neighbours_change_nothing(nonlinear: bool) -> None:
    cells = random_cells(3, sample_size(1000, 12), nonlinear=nonlinear)
    cycles = sample_size(100, 30)
    whole = by_lanes(cells, cycles)
    order = np.random.default_rng(0).permutation(len(cells.amplitude))
    kept = whole.whole[:, OUTCOME] != LEFT_OVER

    def same(found: Outcomes, chosen: Integers) -> bool:
        rows = Outcomes(whole.whole[chosen], whole.real[chosen])
        assert np.array_equal(found.whole[:, OUTCOME], rows.whole[:, OUTCOME])
        on = kept[chosen]
        assert np.array_equal(found.whole[on], rows.whole[on])
        return np.array_equal(found.real[on], rows.real[on], equal_nan=True)

    assert same(by_lanes(cells.some(order), cycles), order)
    for threads in sample_size((2, 3), (3,)):
        parts = [np.arange(k, len(order), threads) for k in range(threads)]
        with ThreadPoolExecutor(threads) as pool:
            found = list(pool.map(lambda part: by_lanes(cells.some(part), cycles), parts))
        assert all(same(rows, part) for rows, part in zip(found, parts, strict=True))


@pytest.mark.parametrize("nonlinear", [False, True])
def test_a_mirrored_start_settles_to_the_mirror_image(nonlinear: bool) -> None:
    cells = random_cells(4, sample_size(1000, 20), nonlinear=nonlinear)
    image = cells._replace(
        side=-cells.side,
        angle=-cells.angle,
        velocity=-cells.velocity,
        half_cycles=cells.half_cycles + 1,
    )
    cycles = sample_size(100, 30)
    one, other = by_lanes(cells, cycles), by_lanes(image, cycles)
    on = one.whole[:, OUTCOME] != LEFT_OVER
    assert np.array_equal(on, other.whole[:, OUTCOME] != LEFT_OVER)
    for column in (OUTCOME, PASSAGES, PERIODS, SYMMETRIC, AFTER):
        assert np.array_equal(one.whole[on, column], other.whole[on, column])
    assert np.array_equal(one.whole[on, ORBIT_SIDE], -other.whole[on, ORBIT_SIDE])
    assert np.array_equal(one.real[on, HIGHEST], -other.real[on, LOWEST], equal_nan=True)
    assert np.array_equal(one.real[on, ORBIT_SPEED], other.real[on, ORBIT_SPEED], equal_nan=True)


@every("cycles", [1, 3, 16])
def test_few_periods_are_as_many_as_one_by_one(cycles: int) -> None:
    cells = random_cells(5, sample_size(2000, 12))
    lanes, plain = by_lanes(cells, cycles), one_by_one(cells, cycles)
    on = lanes.whole[:, OUTCOME] != LEFT_OVER
    assert on.any()
    assert np.array_equal(lanes.whole[on], plain.whole[on])


@pytest.mark.skipif(PLAIN, reason="many small bounces need compiled code")
def test_bounces_without_loss_are_left_over() -> None:
    cells = starting([0.5, 0.5], [0.01, 4.0], 1.0, 0.0, 1e-3, 0.0)
    assert by_lanes(cells, 200).whole[:, OUTCOME].tolist() == [LEFT_OVER] * 2


@pytest.mark.parametrize("nonlinear", [False, True])
def test_no_cells_at_all(nonlinear: bool) -> None:
    nothing = np.zeros(0, np.int64)
    by_lanes(random_cells(0, 2, nonlinear=nonlinear).some(nothing), 10)
