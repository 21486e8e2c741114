"""Attractors of the nonlinear model found in lanes: those of the scalar code."""

import math

import numpy as np
import pytest

from rocksteady.kernels.batch.attractors import (
    AFTER,
    ORBIT_PHASE,
    ORBIT_SIDE,
    ORBIT_SPEED,
    OUTCOME,
    PASSAGES,
    PERIODS,
    SYMMETRIC,
)
from rocksteady.kernels.core.queue import LEFT_OVER
from rocksteady.kernels.core.tables import ALPHA, LEAN, RATE, RESTITUTION
from rocksteady.kernels.core.tuples import Cells
from rocksteady.kernels.nonlinear_lanes.loop import FASTEST
from rocksteady.kernels.nonlinear_lanes.settling import nonlinear_lane_attractors
from rocksteady.kernels.orbits.closed_form import symmetric_orbit
from rocksteady.kernels.orbits.settle import FALLS, PERIODIC, STAYS, UNSETTLED
from tests.every import every
from tests.kernels.settling import (
    by_lanes,
    check_against_scalar,
    empty,
    one_by_one,
    random_cells,
    sides_of,
    starting,
    states_of,
)
from tests.strategies import PLAIN, sample_size

# Empty lanes divide by zero, of which kernels warn where nothing compiles them.
pytestmark = pytest.mark.filterwarnings("ignore::RuntimeWarning")


@pytest.mark.skipif(PLAIN, reason="thousands of motions need compiled code")
def test_random_cells_settle_as_one_by_one() -> None:
    left, differ = check_against_scalar(random_cells(1, 4000, nonlinear=True), 200)
    assert 0 < left < 600
    assert differ < 12


@pytest.mark.slow
@pytest.mark.skipif(PLAIN, reason="a hundred thousand motions need compiled code")
def test_many_cells_settle_as_one_by_one() -> None:
    for seed in range(10, 14):
        left, differ = check_against_scalar(random_cells(seed, 15_000, nonlinear=True), 200)
        assert left < 2250
        assert differ < 45


@pytest.mark.skipif(PLAIN, reason="hundreds of motions need compiled code")
def test_a_basin_whose_motions_share_few_orbits_is_that_of_one_by_one() -> None:
    """Whether an orbit is computed or looked up changes no bit."""
    angle, velocity = (grid.ravel() for grid in np.meshgrid(*2 * [np.linspace(-1.2, 1.2, 24)]))
    cells = starting(2.6, 7.06, 0.912, angle, velocity, 0.0, alpha=0.245)
    check_against_scalar(cells, 500)
    together = by_lanes(cells, 500)
    on = together.whole[:, OUTCOME] != LEFT_OVER
    assert np.count_nonzero(together.whole[on, OUTCOME] == PERIODIC) > 100
    for cell in np.flatnonzero(on)[::5]:
        alone = by_lanes(cells.some(np.array([cell])), 500)
        assert np.array_equal(alone.whole[0], together.whole[cell])
        assert np.array_equal(alone.real[0], together.real[cell], equal_nan=True)


def test_rests_still_blocks_and_chaos_are_left_over() -> None:
    a = np.array([0.5, 1.01, 1.7347, 2.0, 6.0])
    w = np.array([2.0, 2.0, 1.6633, 4.0, 1.0])
    r = np.array([0.8, 0.8, 0.5, 0.8, 0.8])
    cells = starting(a, w, r, 0.0, [0.3, 0.0, 0.0, 0.3, 0.3], 0.0, alpha=1e-3)
    lanes, plain = by_lanes(cells, 100), one_by_one(cells, 100)
    assert plain.whole[:, OUTCOME].tolist() == [STAYS, PERIODIC, UNSETTLED, PERIODIC, FALLS]
    assert lanes.whole[:, OUTCOME].tolist() == [LEFT_OVER] * 3 + [PERIODIC, FALLS]


def test_of_a_very_slender_block_the_orbit_is_the_closed_form_of_the_linear_model() -> None:
    orbit = symmetric_orbit(2.0, 4.0, 0.8, 1, 1)
    speed = 4.0 * orbit.velocity
    cells = starting([2.0], 4.0, 0.8, 0.0, 1.003 * speed, orbit.phase + 2e-3, alpha=1e-4)
    whole, real = (part[0] for part in by_lanes(cells, 2000))
    assert (whole[OUTCOME], whole[PASSAGES], whole[PERIODS]) == (PERIODIC, 2, 1)
    assert whole[SYMMETRIC] == 1
    assert real[ORBIT_SPEED] == pytest.approx(speed, rel=1e-7)
    seen = real[ORBIT_PHASE] + (0.0 if whole[ORBIT_SIDE] > 0 else math.pi)
    assert math.remainder(seen - orbit.phase, 2.0 * math.pi) == pytest.approx(0.0, abs=1e-7)


@every("cycles", [1, 3, 16])
def test_few_periods_are_as_many_as_one_by_one(cycles: int) -> None:
    cells = random_cells(5, sample_size(1000, 12), nonlinear=True)
    lanes, plain = by_lanes(cells, cycles), one_by_one(cells, cycles)
    on = lanes.whole[:, OUTCOME] != LEFT_OVER
    assert on.any()
    assert np.array_equal(lanes.whole[on], plain.whole[on])


def test_a_motion_that_begins_leaning_takes_no_flight_outside_the_lanes() -> None:
    """It settles as one by one, and as soon."""
    cells = starting(2.0, 4.0, 0.8, [0.2, -0.2, 1.4], [0.0, 0.1, 0.5], 0.7, alpha=0.3)
    lanes, plain = by_lanes(cells, 200), one_by_one(cells, 200)
    assert lanes.whole[:, OUTCOME].tolist() == [PERIODIC, PERIODIC, FALLS]
    assert np.array_equal(lanes.whole[:, AFTER], plain.whole[:, AFTER])


def test_blocks_that_lanes_do_not_hold_are_left_over() -> None:
    cells = starting([2.0] * 6, 4.0, 0.8, 0.0, 0.3, 0.0, alpha=0.3)
    sides = sides_of(cells)
    sides[1, 0, ALPHA] = 0.31
    sides[2, 1, RESTITUTION] = 0.7
    sides[3, :, LEAN] = 1.1
    sides[4, :, RATE] = 0.9
    frequency = cells.frequency.copy()
    frequency[5] = 2.0 * FASTEST
    found = empty(6)
    given = Cells(cells.amplitude, frequency, sides)
    nonlinear_lane_attractors(given, states_of(cells), 100, found)
    assert found.whole[:, OUTCOME].tolist() == [PERIODIC] + [LEFT_OVER] * 5
