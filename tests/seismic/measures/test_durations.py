"""Durations above a threshold and cumulative absolute velocity: crossings inside samples."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rocksteady import Record
from rocksteady.seismic.measures._durations import absolute_velocity, strong_shaking
from tests.seismic.sines import noise, refined, sine


def test_a_sine_is_above_half_its_amplitude_two_thirds_of_the_time() -> None:
    found = strong_shaking(sine(), 1.0)
    assert found.uniform_s == pytest.approx(2.0 / 3.0, abs=1e-6)
    assert found.bracketed_s == pytest.approx(5.0 / 6.0, abs=1e-6)  # from 30 to 330 degrees


def test_one_line_may_cross_both_signs_of_the_threshold() -> None:
    found = strong_shaking(Record(acceleration_m_s2=np.array([-2.0, 2.0]), dt_s=1.0), 1.0)
    assert found.uniform_s == pytest.approx(0.5)
    assert found.bracketed_s == pytest.approx(1.0)


def test_a_threshold_that_is_not_reached_has_no_duration() -> None:
    found = strong_shaking(sine(), 2.1)
    assert (found.bracketed_s, found.uniform_s) == (0.0, 0.0)


def test_samples_at_the_threshold_are_above_it_where_the_line_between_them_is() -> None:
    # Uniform and bracketed duration of lines through whole numbers, above 1.
    for values, uniform, bracketed in (
        ([0.0, 1.0, 0.0], 0.0, 0.0),
        ([0.0, 1.0, 2.0, 1.0, 0.0], 2.0, 2.0),
        ([0.0, 1.0, 1.0, 0.0], 1.0, 1.0),
        ([0.0, -1.0, -1.0, 0.0], 1.0, 1.0),
        ([1.0, 3.0], 1.0, 1.0),
        ([3.0, 1.0, 0.0, 1.0, 3.0], 2.0, 4.0),
        ([0.0, 2.0, 0.0, -2.0, 0.0], 2.0, 3.0),
    ):
        shaking = strong_shaking(Record(acceleration_m_s2=np.array(values), dt_s=1.0), 1.0)
        assert (shaking.uniform_s, shaking.bracketed_s) == (uniform, bracketed), values


@given(st.integers(0, 10_000), st.floats(0.1, 2.0))
def test_durations_are_those_of_a_very_fine_count(seed: int, threshold: float) -> None:
    record = noise(seed, samples=20)
    found = strong_shaking(record, threshold)
    fine = refined(record, 500)
    above = np.abs(fine.acceleration_m_s2) >= threshold
    assert found.uniform_s == pytest.approx(above.sum() * fine.dt_s, abs=42 * fine.dt_s)
    if above.any():
        first, last = np.flatnonzero(above)[[0, -1]]
        assert found.bracketed_s == pytest.approx((last - first) * fine.dt_s, abs=2.1 * fine.dt_s)


def test_the_absolute_velocity_of_lines_through_zero() -> None:
    for values, expected in (([0.0, 2.0], 1.0), ([-1.0, 0.0, 1.0], 1.0), ([-1.0, 1.0], 0.5)):
        record = Record(acceleration_m_s2=np.array(values), dt_s=1.0)
        assert absolute_velocity(record) == expected, values


def test_the_absolute_velocity_of_a_sine() -> None:
    assert absolute_velocity(sine()) == pytest.approx(4.0 / np.pi, rel=5e-7)


@given(st.integers(0, 10_000))
def test_the_absolute_velocity_does_not_depend_on_where_a_line_is_sampled(seed: int) -> None:
    record = noise(seed)
    expected = absolute_velocity(record)
    assert absolute_velocity(refined(record, 7)) == pytest.approx(expected, rel=1e-12)
