"""Runs of draws against single fates, motions that are shared, planes of rocking."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from rocksteady import Block, Record, Status
from rocksteady.calibration import ObjectPrior, ShakingTest, compute_test_fates
from rocksteady.risk.calibration.sampler.bench import AUDITED, Bench, in_plane, motions_of
from rocksteady.risk.calibration.sampler.space import Space
from tests.risk.calibration.cases import LINEAR, make_records

FIRST, SECOND = make_records(2)
USUAL = ShakingTest(name="0", record=FIRST, object="block", gain=1.5)
TESTS = [USUAL, replace(USUAL, name="1", record=SECOND), replace(USUAL, name="2", gain=0.9)]
BLOCK = ObjectPrior(name="block", alpha_rad=0.2, p_rad_s=4.0, housner_factor=1.0, scatter=0.0)
STEADY = Space(block=ObjectPrior(name="block", alpha_rad="0.1:0.3", p_rad_s="3:5", scatter=0.0))


def fates_of(block: Block, tests: list[ShakingTest], gain: float) -> Any:
    """Return whether tests fall, each by itself."""
    fates = compute_test_fates(block, tests, gains=[math.exp(gain)], model=LINEAR)
    return (fates.status.values == Status.OVERTURNED).ravel().tolist()


def test_tests_of_one_motion_share_its_runs() -> None:
    tests = [
        USUAL,
        replace(USUAL, name="1", gain=1.53),
        replace(USUAL, name="2", gain=3.0),
        replace(USUAL, name="3", reversed=True),
        replace(USUAL, name="4", transverse=SECOND),
        replace(USUAL, name="5", vertical=SECOND),
        replace(USUAL, name="6", sigma_ln=0.3, session="day"),
        replace(USUAL, name="7", record=SECOND),
    ]
    shaken, motion, shift = motions_of(tests)
    assert motion.tolist() == [0, 0, 1, 2, 3, 4, 0, 5]
    gains = [shaken[k].gain * math.exp(s) for k, s in zip(motion, shift, strict=True)]
    assert gains == pytest.approx([test.gain for test in tests], rel=1e-5)
    assert np.abs(shift).max() == pytest.approx(0.5 * math.log(1.53 / 1.5), abs=1e-6)


def test_each_run_is_a_fate_at_its_gain() -> None:
    bench = Bench(STEADY, TESTS, LINEAR, None)
    values = STEADY.values_of(np.random.default_rng(1).normal(size=(40, STEADY.size)))
    bench.add(values, (5,), np.array([True, True, False]))
    assert (bench.runs, bench.fell.shape, bench.unknown) == (80, (3, 80), 0)
    # A gain in each half of the range, for each draw.
    assert ((bench.gain > 0.0) == np.tile([False, True], 40)).all()
    assert np.abs(bench.gain).max() < 0.5
    assert np.isfinite(bench.fell[:2]).all()
    assert (np.isfinite(bench.fell[2]) == (np.arange(80) < 2 * AUDITED)).all()
    for run in (0, 7, 33, 62):
        block = STEADY.block.block(values[run // 2])
        assert bench.fell[:, run].tolist() == fates_of(block, TESTS, float(bench.gain[run]))
        assert bench.features[run] == pytest.approx(STEADY.features(values)[run // 2])
    assert 0.1 < np.nanmean(bench.fell) < 0.9


def test_runs_of_a_measured_peak_keep_their_largest_angle() -> None:
    measured = replace(USUAL, fell=False, gain=0.8, peak_rad=0.05, sigma_rad=0.005)
    bench = Bench(STEADY, [measured, TESTS[1]], LINEAR, None)
    values = STEADY.values_of(np.random.default_rng(2).normal(size=(20, STEADY.size)))
    bench.add(values, (5,), np.ones(2, dtype=bool))
    assert np.isnan(bench.peaks[1]).all()
    assert (np.isfinite(bench.peaks[0]) == (bench.fell[0] == 0.0)).all()
    run = int(np.nanargmax(bench.peaks[0]))
    block, gain = STEADY.block.block(values[run // 2]), [math.exp(bench.gain[run])]
    alone = compute_test_fates(block, [measured], gains=gain, model=LINEAR)
    exact = math.log(alone.peak_angle.values.ravel()[0] * block.alpha)
    assert bench.peaks[0, run] == pytest.approx(exact, abs=1e-9)
    assert np.nanmin(bench.peaks[0]) >= math.log(0.005)


def test_two_channels_act_in_a_plane() -> None:
    short = Record(acceleration_m_s2=np.array([3.0, -1.0, 2.0]), dt_s=0.02, name="y")
    tests = [replace(USUAL, transverse=short), replace(USUAL, name="1", transverse=short), TESTS[1]]
    turned = in_plane(tests, 0.3)
    expected = math.cos(0.3) * FIRST.acceleration_m_s2
    expected[:3] += math.sin(0.3) * short.acceleration_m_s2
    assert turned[0].record.acceleration_m_s2 == pytest.approx(expected, abs=1e-12)
    assert turned[0].record is turned[1].record
    assert turned[2] is TESTS[1]
    # Draws run near their own plane: of nine draws each has one.
    test = replace(USUAL, transverse=SECOND, gain=0.5)
    bench = Bench(Space(block=replace(BLOCK, orientation_rad="-1.2:1.2")), [test], LINEAR, None)
    angles = np.linspace(-1.2, 1.2, 9)
    bench.add(angles[:, np.newaxis], (1,), np.ones(1, dtype=bool))
    for run, gain in enumerate(bench.gain):
        fate = fates_of(BLOCK.block([]), in_plane([test], angles[run // 2]), gain)
        assert bench.fell[0, run] == fate[0]
    assert 0.0 < bench.fell.mean() < 1.0
