"""Velocity, displacement and Arias intensity of lines: exact, their peaks inside samples too."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from rocksteady import Record
from rocksteady.measures import integrate_record
from tests.records import el_centro
from tests.seismic.sines import noise, refined, sine

seeds = st.integers(0, 10_000)


def test_a_period_of_a_sine_has_its_closed_forms() -> None:
    course = integrate_record(sine())
    # Chords of a sine of h = 1/4000 leave out 2e-7 of it.
    assert course.peak_acceleration.value == pytest.approx(2.0, rel=1e-12)
    assert course.peak_velocity.value == pytest.approx(2.0 / math.pi, rel=5e-7)
    assert course.peak_velocity.t_s == pytest.approx(0.5)
    assert course.displacement_m[-1] == pytest.approx(1.0 / math.pi, rel=5e-7)
    assert course.velocity_m_s[-1] == pytest.approx(0.0, abs=1e-12)
    assert course.arias_m_s[-1] == pytest.approx(math.pi / (2 * 9.80665) * 2.0, rel=5e-7)
    assert not course.drifts


@given(seeds)
def test_integrals_are_those_of_adaptive_quadrature(seed: int) -> None:
    record = noise(seed, samples=8, dt_s=0.5)
    course = integrate_record(record)

    def a(t: float) -> float:
        return float(np.interp(t, course.t_s, record.acceleration_m_s2))

    knots = course.t_s[1:-1]
    end = float(course.t_s[-1])
    velocity = quad(a, 0.0, end, points=knots, limit=200)[0]
    # The displacement is the integral of (end - t) a(t), and needs no velocity.
    displacement = quad(lambda t: (end - t) * a(t), 0.0, end, points=knots, limit=200)[0]
    energy = quad(lambda t: a(t) ** 2, 0.0, end, points=knots, limit=200)[0]
    assert course.velocity_m_s[-1] == pytest.approx(velocity, abs=1e-12)
    assert course.displacement_m[-1] == pytest.approx(displacement, abs=1e-11)
    assert course.arias_m_s[-1] == pytest.approx(math.pi / 2 / 9.80665 * energy, rel=1e-12)


@given(seeds)
def test_peaks_are_those_of_the_same_lines_sampled_a_thousand_times_as_finely(seed: int) -> None:
    record = noise(seed, samples=12, dt_s=0.1)
    course, fine = integrate_record(record), integrate_record(refined(record, 1000))
    # No time is further than half a fine step from a fine sample, and at a peak inside a line the
    # slope is 0: samples miss it by at most h^2/8 of the largest curvature, a' of v and a of d.
    missed = (record.dt_s / 1000) ** 2 / 8.0
    steepest = float(np.abs(np.diff(record.acceleration_m_s2)).max()) / record.dt_s
    largest = record.peak_acceleration_m_s2
    for found, values, curvature in (
        (course.peak_velocity, fine.velocity_m_s, steepest),
        (course.peak_displacement, fine.displacement_m, largest),
    ):
        sampled = float(np.abs(values).max())
        rounding = 1e-12 * (1.0 + sampled)
        assert sampled - rounding <= abs(found.value) <= sampled + missed * curvature + rounding
        # It is where and on the side that it says: of two peaks as large as one another either.
        there = float(np.interp(found.t_s, fine.t_s, values))
        assert there == pytest.approx(found.value, abs=missed * curvature + rounding)


@given(seeds, st.floats(0.01, 1.0))
def test_parts_of_the_arias_intensity_are_reached_when_they_are(seed: int, part: float) -> None:
    record = noise(seed, samples=20)
    course = integrate_record(record)
    t = course.time_of_arias(part)
    assert 0.0 <= t <= course.t_s[-1] * (1 + 1e-12)
    # The record up to then, by itself, has that part of the intensity.
    at = min(int(t / record.dt_s), len(course.t_s) - 2)
    a0 = float(record.acceleration_m_s2[at])
    a = float(np.interp(t, course.t_s, record.acceleration_m_s2))
    since = t - course.t_s[at]
    reached = (
        course.arias_m_s[at] + math.pi / (2 * 9.80665) * since * (a0 * a0 + a0 * a + a * a) / 3.0
    )
    assert reached == pytest.approx(part * course.arias_m_s[-1], rel=1e-9)


def test_a_constant_acceleration_reaches_its_intensity_evenly() -> None:
    course = integrate_record(Record(acceleration_m_s2=np.full(11, 3.0), dt_s=0.1))
    assert course.time_of_arias(0.05) == pytest.approx(0.05)
    assert course.time_of_arias(0.95) == pytest.approx(0.95)
    assert course.husid[-1] == 1.0


def test_an_acceleration_that_is_not_zero_in_the_mean_drifts() -> None:
    record = sine()
    moved = Record(acceleration_m_s2=record.acceleration_m_s2 + 0.1, dt_s=record.dt_s)
    assert integrate_record(moved).drifts
    assert not integrate_record(record).drifts


def test_a_drift_whose_mean_is_taken_off_is_still_one() -> None:
    time = np.linspace(0.0, 60.0, 6001)
    shaking = np.sin(2.0 * math.pi * time) * np.exp(-((time - 10.0) ** 2) / 8.0)
    tilted = shaking + np.where(time > 12.0, 0.01, 0.0)
    course = integrate_record(Record(acceleration_m_s2=tilted - tilted.mean(), dt_s=0.01))
    assert abs(course.velocity_m_s[-1]) < 1e-4 < 0.05 * abs(course.peak_velocity.value)
    assert course.drifts
    assert not integrate_record(Record(acceleration_m_s2=shaking, dt_s=0.01)).drifts


@given(seeds)
def test_scaling_and_reversing_scales_and_reverses(seed: int) -> None:
    record = noise(seed)
    course, other = integrate_record(record), integrate_record(record.scaled(-2.0))
    for one, two in (
        (course.peak_acceleration, other.peak_acceleration),
        (course.peak_velocity, other.peak_velocity),
        (course.peak_displacement, other.peak_displacement),
    ):
        assert two.value == pytest.approx(-2.0 * one.value, rel=1e-12)
        assert two.t_s == pytest.approx(one.t_s)
    assert integrate_record(record.scaled(0.01)).drifts == course.drifts


def test_el_centro_as_chopra_prints_it() -> None:
    """Dynamics of Structures, fig. 6.1.4: .319 g; 8.40 in, of the original digitisation."""
    values, step = el_centro()
    course = integrate_record(Record(acceleration_m_s2=values, dt_s=step))
    assert abs(course.peak_acceleration.value) / 9.80665 == pytest.approx(0.319, abs=5e-4)
    assert abs(course.peak_displacement.value) / 0.0254 == pytest.approx(8.40, rel=0.01)
