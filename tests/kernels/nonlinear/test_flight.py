"""Flights of the nonlinear model up to the end of a run."""

import math

import numpy as np
import pytest

from rocksteady.kernels.batch.harmonic import fates_of_sides
from rocksteady.kernels.core.tables import FOUND, NO_RETURN, OVERTURNED, ROCKING, STALLED
from rocksteady.kernels.core.tuples import Cells, Fates, Starts
from rocksteady.kernels.core.typed import FALSE, TRUE
from rocksteady.kernels.linear.zeros import Zero
from rocksteady.kernels.nonlinear.drive import Drive, SteppedFlight
from rocksteady.kernels.nonlinear.flight import fly
from rocksteady.kernels.nonlinear.series import TERMS, WORK_ROWS
from tests.every import every
from tests.strategies import sample_size

ALPHA = 0.3


def test_a_run_that_ends_beyond_the_point_of_no_return_has_overturned() -> None:
    """The verdict at the end of a run is that of its state, however the steps fall."""
    cells = sample_size(4000, 20)
    rng = np.random.default_rng(2011)
    amplitude, ratio = rng.uniform(3.0, 9.0, cells), rng.uniform(1.0, 6.0, cells)
    still, velocity = np.zeros(cells), rng.normal(0.0, 0.5, cells)
    sides = np.tile([0.8, 1.0, 1.0, ALPHA, 1e-15], (cells, 2, 1))
    status, impacts = np.zeros(cells, dtype=np.int64), np.zeros(cells, dtype=np.int64)
    final = np.empty((cells, 3))
    fates_of_sides(
        Cells(amplitude, ratio, sides),
        Starts(still, velocity, still),
        2,
        10**6,
        Fates(status, impacts, final),
    )
    lost_from = 1.0 + np.arctan(ALPHA * amplitude) / ALPHA
    onwards = final[:, 0] * final[:, 1] >= 0.0
    beyond = (np.abs(final[:, 0]) > lost_from) & onwards & (status == ROCKING)
    assert not beyond.any()
    assert np.abs(final[status == ROCKING, 0]).max(initial=0.0) < 0.5 * math.pi / ALPHA
    if cells > 100:
        assert min(np.count_nonzero(status == code) for code in (ROCKING, OVERTURNED)) > 1000


def flown(flight: SteppedFlight, lifting: bool) -> Zero:
    """Return the end of a flight on a base motion that ends."""
    work, none = np.empty((WORK_ROWS, TERMS)), np.empty((0, TERMS))
    return fly(flight, FALSE, math.inf, lifting, np.empty(0), 1.0, 1.0, work, none)


@every("amplitude", [1e10, 1e20, 1e30, 1e40, 1e50])
@every("alpha", [0.001, 0.3, 1.5])
def test_shaking_beyond_all_bounds_throws_a_block_over_at_once(
    amplitude: float, alpha: float
) -> None:
    """Held by its weight against A sin(W t), it lies on its side after some (1/(A W))^(1/3)."""
    drive = Drive(alpha, 0.0, 0.0, amplitude, 2.0, 0.0, 0.0)
    zero = flown(SteppedFlight(drive, 0.0, 0.0, 0.0, 1.0, 1e-15), TRUE)
    assert zero.event == NO_RETURN
    assert zero.angle == pytest.approx(0.5 * math.pi / alpha, rel=1e-9)
    # Of y'' = A W t cos(alpha (1 - y)), times between those with the cosine at its ends.
    least = (6.0 * 0.5 * math.pi / alpha / (2.0 * amplitude)) ** (1.0 / 3.0)
    assert zero.time > least * (1.0 - 1e-6)
    assert zero.time < 3.0 * least / math.cos(alpha)


@every("velocity", [1e-300, 1e-60, 6.807969192843294e-34, 1e-20, 1e-12])
def test_a_bounce_without_acceleration_lands_by_the_slope_alone(velocity: float) -> None:
    """The acceleration starts at 0 to the last bit: y = v t - c t^3/6, back at sqrt(6 v/c)."""
    alpha, slope = 0.24497866312686414, -0.08484947470971271
    drive = Drive(alpha, 1.0204970376156208, slope, 0.0, 0.0, 0.0, 0.0)
    zero = flown(SteppedFlight(drive, 0.0, 0.0, velocity, 0.0267, 1e-15), FALSE)
    assert zero.event == FOUND
    back = math.sqrt(6.0 * velocity / (-slope * math.cos(alpha)))
    assert zero.time == pytest.approx(back, rel=1e-4)
    assert zero.velocity == pytest.approx(-2.0 * velocity, rel=1e-3)


@pytest.mark.parametrize("span", [1.0, 1e6])
def test_a_flight_of_ever_so_many_steps_is_given_up(span: float) -> None:
    """Hung up, with a weight of -1e12 M g, a block swings for ever with a period of 6e-6."""
    drive = Drive(0.3, 0.0, 0.0, 0.0, 0.0, -1e12, 0.0)
    zero = flown(SteppedFlight(drive, 0.0, 0.9, 0.0, span, 1e-15), FALSE)
    assert zero.event == STALLED
    assert abs(zero.angle - 1.0) < 0.1 * (1.0 + 1e-9)
    assert zero.time < 0.1


def test_long_flights_are_not_given_up() -> None:
    """Balanced to the last bit a block hovers, for as many steps as fast shaking needs."""
    drive = Drive(0.3, 0.0, 0.0, 1e-9, 300.0, 0.0, 0.0)
    zero = flown(SteppedFlight(drive, 0.0, 1.0, 0.0, 30.0, 1e-15), FALSE)
    assert zero.event != STALLED
    assert zero.time > 20.0
