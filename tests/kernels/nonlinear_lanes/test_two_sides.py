"""Constants of both sides of a block, and their exchange at an impact."""

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady.kernels.batch.harmonic import harmonic_segment
from rocksteady.kernels.core.tables import ALPHA as SIDE_ALPHA
from rocksteady.kernels.core.tables import (
    LEAN,
    LEFT_OUT,
    NONLINEAR_SEGMENT_COLUMNS,
    NONLINEAR_SIDE_COLUMNS,
    RATE,
    RESTITUTION,
    March,
)
from rocksteady.kernels.nonlinear.drive import foot_forcing, side_drive
from rocksteady.kernels.nonlinear.proofs import point_of_no_return
from rocksteady.kernels.nonlinear_lanes._layout import (
    ACROSS,
    ALPHA,
    AMPLITUDE,
    ANGLE,
    APART,
    CHANGING,
    DELTA,
    FLYING,
    FOOT_SINE,
    FOOT_SWING,
    FREQUENCY,
    LANDED,
    LANES,
    LEAVE,
    LOST,
    SIDED,
    SIZE,
    SLOW,
    SPEED,
    STAGE,
    UNIT,
)
from rocksteady.kernels.nonlinear_lanes._transfer import load, put_lane, taken
from rocksteady.kernels.nonlinear_lanes._two_sides import change_sides, other
from tests.kernels.nonlinear_lanes.flights import PART, in_flight

Floats = NDArray[np.float64]


def random_sides(rng: np.random.Generator) -> Floats:
    sides = np.empty((2, NONLINEAR_SIDE_COLUMNS))
    sides[:, RESTITUTION] = rng.uniform(0.3, 1.0, 2)
    sides[:, LEAN : RATE + 1] = rng.uniform(0.5, 2.0, (2, 2))
    sides[:, SIDE_ALPHA] = rng.uniform(0.01, 1.2, 2)
    sides[:, LEFT_OUT] = PART
    return sides


@pytest.mark.parametrize("side", [1, -1])
def test_a_lane_flies_in_the_units_of_its_side(side: int) -> None:
    rng = np.random.default_rng(4)
    lanes, segments = np.zeros(SIZE), np.zeros((1, NONLINEAR_SEGMENT_COLUMNS))
    for k in range(LANES):
        sides = random_sides(rng)
        amplitude, frequency = rng.uniform(0.1, 8.0), rng.uniform(0.3, 12.0)
        harmonic_segment(segments, amplitude, frequency, 0.0)
        load(lanes, k, k, amplitude, frequency, sides, 0.0)
        angle, velocity = rng.uniform(0.1, 0.5), rng.normal()
        phase, half = rng.uniform(0.0, 3.1), int(rng.integers(-5, 5))
        state = March(side, side * angle, side * velocity, 0, half, phase, 7, 0)
        put_lane(lanes, k, state, 30)
        row = 0 if side > 0 else 1
        lean, rate = sides[row, LEAN], sides[row, RATE]
        drive = side_drive(segments, 0, sides, side, 0.0)
        foot = foot_forcing(drive)
        lost = point_of_no_return(segments, 0, sides, side)
        for name, value in (
            (ALPHA, drive.alpha),
            (AMPLITUDE, drive.amplitude),
            (FREQUENCY, drive.frequency),
            (FOOT_SINE, -foot.constant),
            (FOOT_SWING, foot.amplitude),
            (LOST, lost),
            (DELTA, sides[row, RESTITUTION]),
            (ANGLE, angle / lean),
            (SPEED, velocity / (lean * rate)),
            (ACROSS, lean * rate / np.prod(sides[1 - row, LEAN : RATE + 1])),
        ):
            assert lanes[name + k] == pytest.approx(value, rel=1e-14)
        assert other(lanes, k, ALPHA) == sides[1 - row, SIDE_ALPHA]
        assert lanes[APART + k] > np.pi
        assert taken(lanes, k, 30) == pytest.approx(state, rel=1e-13)


def test_sides_change_in_the_lanes_that_have_landed_alone() -> None:
    lanes = in_flight(np.random.default_rng(6))
    stages = np.resize([FLYING, LANDED, SLOW, LEAVE], LANES)
    lanes[STAGE : STAGE + LANES] = stages
    before = lanes.copy()
    change_sides(lanes)
    landed = (stages == LANDED) | (stages == SLOW)
    for field in range(0, SIDED, LANES):
        for k in range(LANES):
            turned = other(before, k, field) if landed[k] else before[field + k]
            assert lanes[field + k] == turned
    units = np.array([other(before, k, UNIT) for k in range(LANES)])
    assert (before[UNIT : UNIT + LANES] != units).all()
    kept = np.arange(SIZE) >= SIDED
    kept[CHANGING : CHANGING + LANES] = False
    np.testing.assert_array_equal(lanes[kept], before[kept])
