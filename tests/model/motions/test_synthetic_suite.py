"""Synthetic suites: named so, repeatable, and like records in what matters to rocking."""

import numpy as np
import pytest

from rocksteady.model.motions.synthetic_suite import make_synthetic_suite
from rocksteady.seismic.measures.time_course import integrate_record


def test_a_suite_is_named_repeated_by_its_seed_and_begins_another() -> None:
    suite = make_synthetic_suite(5, seed=3)
    assert [record.name for record in suite] == [f"synthetic {n}" for n in range(1, 6)]
    assert suite == make_synthetic_suite(5, seed=3)
    assert make_synthetic_suite(2, seed=3)[0].dt_s == suite[0].dt_s
    assert suite[0] != make_synthetic_suite(5, seed=4)[0]
    assert len({float(record.acceleration_m_s2.sum()) for record in suite}) == 5


def test_its_velocities_end_at_zero_and_are_of_the_size_of_records() -> None:
    for record in make_synthetic_suite():
        course = integrate_record(record)
        peak = float(np.abs(course.velocity_m_s).max())
        assert abs(course.velocity_m_s[-1]) < 1e-9 * peak
        assert 0.02 < peak / record.peak_acceleration_m_s2 < 0.4
        assert 1.0 < record.peak_acceleration_m_s2 < 6.0


def test_grounds_are_of_1_2_to_5_hz_evenly_in_the_logarithm() -> None:
    """The step of a motion is one part of the period of its ground."""
    suite = make_synthetic_suite(200)
    steps = np.sort([record.dt_s for record in suite])
    assert steps[-1] / steps[0] == pytest.approx(5.0 / 1.2, rel=0.02)
    assert np.median(steps) == pytest.approx(np.sqrt(steps[0] * steps[-1]), rel=0.02)
    assert len(make_synthetic_suite()) == 24


def test_durations_levels_and_grounds_are_as_stated() -> None:
    suite = make_synthetic_suite(90, seed=5)
    lasting = [round(record.duration_s, 9) for record in suite]
    assert lasting == [12.0, 18.0, 27.0] * 30
    strong = []
    for record in suite:
        # The envelope is 1 from .15 to .5 of the duration.
        samples = record.acceleration_m_s2
        strong.append(np.mean(samples[int(0.15 * len(samples)) : int(0.5 * len(samples))] ** 2))
    assert np.sqrt(np.mean(strong)) == pytest.approx(1.0, rel=0.1)
    # 40 samples for each period of the ground, to which a whole number of steps is fitted.
    hertz = np.array([1.0 / (40.0 * record.dt_s) for record in suite])
    assert 1.19 < hertz.min() < 1.3
    assert 4.8 < hertz.max() < 5.01
    # Each part of the range, in the logarithm, is met by each duration.
    parts = np.log(hertz / 1.2) / np.log(5.0 / 1.2)
    for first in range(3):
        assert (np.histogram(parts[first::3], 5, (-0.01, 1.01))[0] >= 4).all()
    (alone,) = make_synthetic_suite(1)
    assert 1.0 / (40.0 * alone.dt_s) == pytest.approx(np.sqrt(1.2 * 5.0), rel=0.01)
