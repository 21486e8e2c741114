"""Changed records: what each change leaves of sines and straight lines."""

from dataclasses import replace

import numpy as np
import pytest

from rocksteady import Record
from rocksteady.calibration import ShakingTest
from rocksteady.risk.calibration._flips import _changed, _halved, _high_passed, _levelled


def sine(hertz: float, dt_s: float, count: int) -> np.ndarray:
    time = dt_s * np.arange(count)
    values: np.ndarray = np.sin(2.0 * np.pi * hertz * time) * np.sin(np.pi * time / time[-1]) ** 2
    return values


def record(samples: np.ndarray, dt_s: float = 0.01) -> Record:
    return Record(acceleration_m_s2=samples, dt_s=dt_s, name="r")


def test_half_the_interval_has_the_sine_between_its_samples() -> None:
    result = _halved(record(sine(5.0, 0.01, 1001)))
    assert result.dt_s == 0.005
    assert len(result.acceleration_m_s2) == 2002
    exact = sine(5.0, 0.005, 2001)
    assert result.acceleration_m_s2[:2001] == pytest.approx(exact, abs=2e-3)


def test_a_straight_line_is_taken_off() -> None:
    time = 0.01 * np.arange(500)
    result = _levelled(record(sine(2.0, 0.01, 500) + 0.3 - 0.2 * time))
    assert result is not None
    assert np.polyfit(time, result.acceleration_m_s2, 1) == pytest.approx([0.0, 0.0], abs=1e-12)


def test_the_high_pass_keeps_what_shakes_and_drops_what_drifts() -> None:
    """Second order both ways: a quarter of the power is left at 0.1 Hz."""
    for hertz, low, high in (
        (2.0, 0.99, 1.01),
        (0.5, 0.95, 1.01),
        (0.01, 0.0, 0.02),
        (0.1, 0.4, 0.6),
    ):
        samples = sine(hertz, 0.02, 20_000)
        result = _high_passed(record(samples, 0.02)).acceleration_m_s2
        share = float(np.square(result).sum() / np.square(samples).sum()) ** 0.5
        assert low <= share <= high, (hertz, share)
        assert _high_passed(record(samples, 0.02)).dt_s == 0.02
    for dt_s, kept in ((4.999, False), (5.0, True), (6.0, True)):
        slow = record(np.array([0.0, 1.0, -1.0, 0.5, -0.5, 0.2, 0.0]), dt_s)
        assert (_high_passed(slow) is slow) == kept, dt_s


def test_each_record_is_changed_once_and_a_vertical_one_too() -> None:
    across, up = record(sine(1.0, 0.01, 300)), record(sine(3.0, 0.01, 300))
    usual = ShakingTest(name="t", record=across, object="o", fell=True)
    tests = [usual, replace(usual, vertical=up), replace(usual, vertical=up, transverse=across)]
    result = _changed(tests, lambda given: given.scaled(2.0))
    assert result[0].vertical is None
    assert result[0].record is result[2].record is result[2].transverse
    assert result[2].vertical is result[1].vertical is not None
    assert result[0].record.acceleration_m_s2 == pytest.approx(2.0 * across.acceleration_m_s2)
