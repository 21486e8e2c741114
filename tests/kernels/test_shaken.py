"""Many blocks on one record: each is what a march of its own gives."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady.kernels.march import AT_REST, OVERTURNED, ROCKING, UNDECIDED, March, march
from rocksteady.kernels.shaken import record_fates
from tests.kernels.tables import both_sides, sampled
from tests.records import synthetic
from tests.strategies import sample_size

Floats = NDArray[np.float64]

STEP = 0.02  # s
AFTERWARDS = 50.0


def fates(
    values: Floats, uplift: Floats, p: Floats, restitution: Floats, limit: int = 10**6
) -> tuple[NDArray[np.int64], NDArray[np.int64], Floats]:
    count = len(uplift)
    status, impacts = np.zeros(count, np.int64), np.zeros(count, np.int64)
    peaks, after = np.zeros((count, 2)), np.full(count, AFTERWARDS)
    segments = sampled(values, STEP)
    record_fates(segments, uplift, p, restitution, after, limit, status, impacts, peaks)
    return status, impacts, peaks


def blocks(count: int) -> tuple[Floats, Floats, Floats]:
    """Return uplift accelerations [m/s^2], p [rad/s] and restitutions."""
    rng = np.random.default_rng(2)
    return rng.uniform(0.8, 3.5, count), rng.uniform(1.0, 6.0, count), rng.uniform(0.5, 0.9, count)


def record(samples: int, peak: float = 3.0) -> Floats:
    return synthetic(np.random.default_rng(9), samples, STEP, peak)


def test_each_block_fares_as_in_a_march_in_its_own_units() -> None:
    values, (uplift, p, restitution) = record(400, 8.0), blocks(sample_size(60, 4))
    status, impacts, peaks = fates(values, uplift, p, restitution)
    for i in range(len(uplift)):
        own, top = sampled(values / uplift[i], STEP * p[i]), np.zeros(2)
        start, none = March(0, 0.0, 0.0, 0, 0, 0.0, 0, 0), np.zeros((0, 8))
        code, end = march(
            own, both_sides(restitution[i]), start, 0, AFTERWARDS, math.inf, 10**6, none, top
        )
        assert status[i] == code
        # The last bounces of a chatter are counted until they are slower than a bound.
        assert abs(impacts[i] - end.impacts) <= 2
        np.testing.assert_allclose(peaks[i], top, rtol=1e-9, atol=1e-9)
    if len(uplift) > 10:
        assert {AT_REST, OVERTURNED} <= set(status.tolist())


def test_to_halve_the_lean_is_to_double_the_motion() -> None:
    values, (uplift, p, restitution) = record(200), blocks(sample_size(20, 3))
    one, other = (fates(factor * values, factor * uplift, p, restitution) for factor in (1.0, 2.0))
    for column, again in zip(one, other, strict=True):
        np.testing.assert_array_equal(column, again)


def test_a_cell_does_not_depend_on_its_neighbours() -> None:
    values, (uplift, p, restitution) = record(150), blocks(8)
    together = fates(values, uplift, p, restitution)
    for i in range(8):
        alone = fates(values, uplift[i : i + 1], p[i : i + 1], restitution[i : i + 1])
        for column, single in zip(together, alone, strict=True):
            np.testing.assert_array_equal(column[i], single[0])


def test_a_block_that_is_not_lifted_stays_at_rest() -> None:
    status, impacts, peaks = fates(record(100), np.full(1, 3.1), np.ones(1), np.full(1, 0.8))
    assert (status[0], impacts[0], peaks[0].tolist()) == (AT_REST, 0, [0.0, 0.0])


def test_no_block_is_followed_beyond_the_limit_or_the_time_afterwards() -> None:
    values = record(200)
    one, half = np.ones(1), np.full(1, 0.5)
    assert fates(values, half, one, one, limit=150)[0][0] == UNDECIDED
    hard = synthetic(np.random.default_rng(4), 100, STEP, 1.2)
    assert fates(hard, one, one, one)[0][0] in {ROCKING, OVERTURNED}


def test_the_peak_of_a_rectangular_pulse_in_closed_form() -> None:
    # a = 1.5 for t = 0.4, from a jump at the start to a still base: then G e^t + H e^-t + 1.
    t = 0.4
    values = np.concatenate([np.full(21, 1.5), np.zeros(1)])
    segments = sampled(values, t / 20.0, 1e-12)
    status, impacts, peaks = np.zeros(1, np.int64), np.zeros(1, np.int64), np.zeros((1, 2))
    one = np.ones(1)
    record_fates(segments, one, one, 0.5 * one, 50 * one, 10**6, status, impacts, peaks)
    angle, velocity = 0.5 * (math.cosh(t) - 1.0), 0.5 * math.sinh(t)
    # (u - 1)^2 - u'^2 is kept on the still base.
    top = 1.0 - math.sqrt((1.0 - angle) ** 2 - velocity**2)
    assert peaks[0, 0] == pytest.approx(top, abs=1e-11)
    landing = math.sqrt(1.0 - (1.0 - top) ** 2)
    assert peaks[0, 1] == pytest.approx(max(velocity, landing), abs=1e-11)
    assert status[0] == AT_REST
