"""Changed records: what each change leaves of sines and straight lines."""

from dataclasses import replace

import numpy as np
import pytest

from rocksteady import Record
from rocksteady.calibration import ShakingTest
from rocksteady.records import Cleaning
from rocksteady.risk.calibration._flips import _changed, _halved


def sine(hertz: float, dt_s: float, count: int) -> np.ndarray:
    time = dt_s * np.arange(count)
    values: np.ndarray = np.sin(2.0 * np.pi * hertz * time) * np.sin(np.pi * time / time[-1]) ** 2
    return values


def record(samples: np.ndarray, dt_s: float = 0.01) -> Record:
    return Record(acceleration_m_s2=samples, dt_s=dt_s, name="r")


def test_half_the_interval_has_the_sine_between_its_samples() -> None:
    given = record(sine(5.0, 0.01, 1001))
    (test,) = _changed([ShakingTest(name="t", record=given, object="o", fell=True)], _halved)
    assert test.record.dt_s == 0.005
    exact = sine(5.0, 0.005, 2001)
    assert test.record.acceleration_m_s2[:2001] == pytest.approx(exact, abs=2e-3)


@pytest.mark.parametrize("change", [Cleaning(filter_hz="0.1:"), Cleaning(baseline="linear")])
def test_a_record_that_cannot_be_changed_stays(change: Cleaning) -> None:
    """One has its Nyquist frequency at the filter's end, one is its own baseline."""
    given = record(np.array([1.0, 2.0, 3.0]), 5.0)
    (test,) = _changed([ShakingTest(name="t", record=given, object="o", fell=True)], change.apply)
    assert test.record is given


def test_each_record_is_changed_once_and_a_vertical_one_too() -> None:
    across, up = record(sine(1.0, 0.01, 300)), record(sine(3.0, 0.01, 300))
    usual = ShakingTest(name="t", record=across, object="o", fell=True)
    tests = [usual, replace(usual, vertical=up), replace(usual, vertical=up, transverse=across)]
    result = _changed(tests, lambda given: replace(given, record=given.record.scaled(2.0)))
    assert result[0].vertical is None
    assert result[0].record is result[2].record is result[2].transverse
    assert result[2].vertical is result[1].vertical is not None
    assert result[0].record.acceleration_m_s2 == pytest.approx(2.0 * across.acceleration_m_s2)
