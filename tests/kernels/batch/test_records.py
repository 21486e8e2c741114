"""Many blocks on one record: each is what a march of its own gives."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady.kernels.batch.records import record_fates
from rocksteady.kernels.core.tables import (
    ALIKE,
    ALPHA,
    AT_REST,
    COUNTED,
    LEAN,
    LEFT_OUT,
    LIFT,
    LIFT_CEILING,
    LIFT_SLOPE,
    LOST_CONTACT,
    NONLINEAR_SEGMENT_COLUMNS,
    NONLINEAR_SIDE_COLUMNS,
    OVERTURNED,
    RATE,
    RESTITUTION,
    ROCKING,
    SIDE_COLUMNS,
    UNDECIDED,
    March,
)
from rocksteady.kernels.core.tuples import Blocks, Kept, PeakFates, Tables, Until
from rocksteady.kernels.march.march import march
from rocksteady.kernels.march.replay import peaks_until_overturning
from rocksteady.model.nonlinear_tables import lifted_table
from tests.every import every
from tests.kernels.scattering import scattered
from tests.kernels.tables import sampled
from tests.records import synthetic
from tests.strategies import sample_size

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

STEP = 0.02  # s
AFTERWARDS = 50.0
GRAVITY = 9.81
PLENTY = 10**6


def blocks(
    count: int, *, nonlinear: bool, alike: bool = True, deviation: float | None = None
) -> Floats:
    """Return sides in m/s^2 and rad/s; with a deviation their restitution scatters."""
    rng = np.random.default_rng(2)
    sides = np.zeros((count, 2, NONLINEAR_SIDE_COLUMNS if nonlinear else SIDE_COLUMNS))
    alpha = rng.uniform(0.08, 0.36, (count, 2))
    sides[:, :, LEAN] = GRAVITY * alpha
    sides[:, :, RATE] = rng.uniform(1.0, 6.0, (count, 1)) * rng.uniform(0.8, 1.2, (count, 2))
    sides[:, :, RESTITUTION] = rng.uniform(0.5, 0.9, (count, 2))
    if nonlinear:
        sides[:, :, ALPHA] = alpha
        sides[:, :, LEFT_OUT] = 1e-15
    if alike:
        sides[:, 1] = sides[:, 0]
    if deviation is not None:
        return np.stack([scattered(sides[i], deviation, 7 * i) for i in range(count)])
    return sides


def record(samples: int, peak: float = 3.0) -> Floats:
    return synthetic(np.random.default_rng(9), samples, STEP, peak)


def table(values: Floats, step: float, *, nonlinear: bool) -> Floats:
    flat = sampled(values, step)
    if not nonlinear:
        return flat
    wide = np.zeros((len(flat), NONLINEAR_SEGMENT_COLUMNS))
    wide[:, :ALIKE] = flat[:, :ALIKE]
    return wide


def fates(
    segments: Floats, sides: Floats, limit: int = PLENTY, after: float = AFTERWARDS
) -> tuple[Integers, Integers, Floats]:
    count = len(sides)
    status, impacts = np.zeros(count, np.int64), np.zeros(count, np.int64)
    peaks = np.zeros((count, 2))
    record_fates(
        segments, Blocks(sides, np.full(count, after)), limit, PeakFates(status, impacts, peaks)
    )
    return status, impacts, peaks


def plain(restitution: Floats, uplift: Floats, p: Floats) -> Floats:
    """Return the sides of symmetric blocks of the linear model."""
    return np.repeat(np.column_stack([restitution, uplift, p])[:, np.newaxis], 2, axis=1)


@every("alike", [True, False])
@every("nonlinear", [False, True])
def test_each_block_fares_as_in_a_march_in_its_own_units(nonlinear: bool, alike: bool) -> None:
    count = sample_size(30 if nonlinear else 60, 3)
    values, sides = record(300, 6.0), blocks(count, nonlinear=nonlinear, alike=alike)
    status, impacts, peaks = fates(table(values, STEP, nonlinear=nonlinear), sides)
    for i in range(count):
        lean, rate = sides[i, 0, [LEAN, RATE]].tolist()
        own = sides[i].copy()
        own[:, LEAN] /= lean
        own[:, RATE] /= rate
        segments = table(values / lean, STEP * rate, nonlinear=nonlinear)
        start, top = March(0, 0.0, 0.0, 0, 0, 0.0, 0, 0), np.zeros(2)
        tables, until = Tables(segments, own), Until(0, AFTERWARDS, COUNTED, PLENTY)
        code, end = march(tables, start, until, Kept(np.zeros((0, 8)), top))
        assert status[i] == code
        assert impacts[i] == end.impacts
        if code == OVERTURNED:
            rows = np.zeros((end.flights, 8))
            march(tables, start, until, Kept(rows, np.zeros(0)))
            *angles, top[1] = peaks_until_overturning(segments, own, rows)
            top[0] = max(angles)
        np.testing.assert_allclose(peaks[i], top, rtol=1e-8, atol=1e-9)
    if count > 10:
        assert {AT_REST, OVERTURNED} <= set(status.tolist())
        # No other side of the fall goes beyond the slenderness here.
        assert (peaks[status == OVERTURNED, 0] >= 1.0).all()


def drawn(rng: np.random.Generator, count: int, nonlinear: bool) -> tuple[Floats, Floats]:
    """Return a record and blocks on it with every parameter drawn."""
    step, samples = float(rng.choice([0.002, 0.01, 0.02, 0.05])), int(rng.integers(20, 400))
    quiet = int(rng.integers(10, 200)) if rng.random() < 0.5 else 0  # where blocks chatter
    lifted = nonlinear and rng.random() < 0.5
    values = synthetic(rng, samples, step, 10.0 ** rng.uniform(0.0, 1.2))
    flat = sampled(np.concatenate([values, 0.2 * synthetic(rng, quiet + 2, step, 1.0)]), step)
    heave = synthetic(rng, samples, step, float(rng.choice([0.3, 0.9, 1.4])))
    segments = flat
    if nonlinear:
        share = float(rng.choice([1.0, 0.77, 1.31]))  # not always at the same instants
        segments = lifted_table(flat, sampled(heave, step * share) if lifted else None)
    sides = np.zeros((count, 2, NONLINEAR_SIDE_COLUMNS if nonlinear else SIDE_COLUMNS))
    alpha = np.exp(rng.uniform(math.log(0.01), math.log(0.9), (count, 2)))
    sides[:, :, LEAN] = GRAVITY * alpha
    # Lanes take other steps where all samples are brief than where some are.
    quickest = 4.0 if rng.random() < 0.4 else 30.0
    sides[:, :, RATE] = np.exp(rng.uniform(math.log(0.3), math.log(quickest), (count, 2)))
    sides[:, :, RESTITUTION] = rng.uniform(float(rng.choice([0.05, 0.9])), 1.0, (count, 2))
    if nonlinear:
        sides[:, :, ALPHA] = alpha
        sides[:, :, LEFT_OUT] = 10.0 ** rng.uniform(-15.0, -11.0)
    alike = rng.random(count) < 0.5
    sides[alike, 1] = sides[alike, 0]
    wall = rng.random(count) < 0.2
    sides[wall, 0, RESTITUTION] *= -1.0
    sides[wall, 1, RESTITUTION] = 1.0
    if rng.random() < 0.3:
        deviation = float(rng.choice([0.0, 0.1]))
        sides = np.stack([scattered(sides[i], deviation, 7 * i) for i in range(count)])
    return segments, sides


@every("nonlinear", [False, True])
def test_lanes_are_the_march_to_the_last_bit(nonlinear: bool) -> None:
    rng = np.random.default_rng(49)
    count, seen = sample_size(45, 3), set()
    for _ in range(sample_size(60, 1)):
        segments, sides = drawn(rng, count, nonlinear)
        limit = int(rng.choice([150, 20_000]))
        status, impacts, peaks = fates(segments, sides, limit)
        for i in range(count):
            top = np.zeros(2)
            until = Until(0, AFTERWARDS / sides[i, 0, RATE], COUNTED, limit)
            start, kept = March(0, 0.0, 0.0, 0, 0, 0.0, 0, 0), Kept(np.zeros((0, 8)), top)
            code, end = march(Tables(segments, sides[i]), start, until, kept)
            assert (status[i], impacts[i]) == (code, end.impacts)
            top[1] /= sides[i, 0, LEAN] * sides[i, 0, RATE]
            if code != OVERTURNED:
                np.testing.assert_array_equal(peaks[i], top)
            seen.add(code)
    if count > 10:
        assert {AT_REST, OVERTURNED} <= seen


@pytest.mark.parametrize("nonlinear", [False, True])
def test_without_room_for_peaks_status_and_impacts_are_the_same(nonlinear: bool) -> None:
    sides = blocks(sample_size(40, 3), nonlinear=nonlinear, alike=False)
    segments = table(record(300, 6.0), STEP, nonlinear=nonlinear)
    status, impacts, _ = fates(segments, sides)
    bare, fewer = np.zeros_like(status), np.full_like(impacts, -1)
    afterwards = np.full(len(sides), AFTERWARDS)
    record_fates(
        segments,
        Blocks(sides, afterwards),
        PLENTY,
        PeakFates(bare, fewer, np.zeros((len(sides), 0))),
    )
    np.testing.assert_array_equal(bare, status)
    np.testing.assert_array_equal(fewer, impacts)


@pytest.mark.parametrize("nonlinear", [False, True])
def test_to_halve_the_lean_is_to_double_the_motion(nonlinear: bool) -> None:
    values, sides = record(200), blocks(sample_size(20, 3), nonlinear=nonlinear, alike=False)
    half = sides.copy()
    half[:, :, LEAN] *= 0.5
    one = fates(table(values, STEP, nonlinear=nonlinear), half)
    other = fates(table(2.0 * values, STEP, nonlinear=nonlinear), sides)
    for column, again in zip(one, other, strict=True):
        np.testing.assert_array_equal(column, again)


@every("deviation", [None, 0.1])
@every("nonlinear", [False, True])
def test_a_reversed_motion_moves_the_mirrored_block_the_same(
    nonlinear: bool, deviation: float | None
) -> None:
    values = record(200, 5.0)
    sides = blocks(sample_size(20, 3), nonlinear=nonlinear, alike=False, deviation=deviation)
    one = fates(table(values, STEP, nonlinear=nonlinear), sides)
    other = fates(table(-values, STEP, nonlinear=nonlinear), sides[:, ::-1].copy())
    np.testing.assert_array_equal(one[0], other[0])
    np.testing.assert_array_equal(one[1], other[1])
    np.testing.assert_allclose(one[2][:, 0], other[2][:, 0], rtol=1e-12)
    # The velocity is in the units of the positive side, which is another one now.
    units = (sides[:, :, LEAN] * sides[:, :, RATE]).T
    np.testing.assert_allclose(one[2][:, 1] * units[0], other[2][:, 1] * units[1], rtol=1e-12)


def test_slender_blocks_of_the_nonlinear_model_move_as_the_linear_model_says() -> None:
    values, wide = record(200, 6.0), blocks(sample_size(20, 3), nonlinear=True)
    wide[:, :, ALPHA] = 1e-7
    status, _, peaks = fates(table(values, STEP, nonlinear=True), wide)
    flat = wide[:, :, :SIDE_COLUMNS].copy()
    expected, _, tops = fates(table(values, STEP, nonlinear=False), flat)
    np.testing.assert_array_equal(status, expected)
    np.testing.assert_allclose(peaks, tops, rtol=1e-7, atol=1e-9)


def test_a_base_that_falls_away_ends_a_march_in_lost_contact() -> None:
    segments = table(record(200), STEP, nonlinear=True)
    segments[50:52, LIFT] = -0.5, -1.5
    segments[50, LIFT_SLOPE] = -1.0 / STEP
    segments[:52, LIFT_CEILING] = 1.5
    status, _, _ = fates(segments, blocks(5, nonlinear=True))
    assert set(status.tolist()) == {LOST_CONTACT}


@every("deviation", [None, 0.1])
@every("nonlinear", [False, True])
def test_a_cell_does_not_depend_on_its_neighbours(nonlinear: bool, deviation: float | None) -> None:
    segments = table(record(150, 6.0), STEP, nonlinear=nonlinear)
    sides = blocks(8, nonlinear=nonlinear, deviation=deviation)
    together = fates(segments, sides)
    for i in range(8):
        alone = fates(segments, sides[i : i + 1])
        for column, single in zip(together, alone, strict=True):
            np.testing.assert_array_equal(column[i], single[0])


@pytest.mark.parametrize("nonlinear", [False, True])
def test_without_deviation_scattered_restitution_changes_no_bit(nonlinear: bool) -> None:
    segments = table(record(150, 6.0), STEP, nonlinear=nonlinear)
    count = sample_size(60, 4)
    one, other, scattering = (
        fates(segments, blocks(count, nonlinear=nonlinear, alike=False, deviation=deviation))
        for deviation in (None, 0.0, 0.05)
    )
    for column, again in zip(one, other, strict=True):
        np.testing.assert_array_equal(column, again)
    assert (scattering[-1] != one[-1]).any()  # the peaks


def test_a_block_that_is_not_lifted_stays_at_rest() -> None:
    one = np.ones(1)
    status, impacts, peaks = fates(sampled(record(100), STEP), plain(0.8 * one, 3.1 * one, one))
    assert (status[0], impacts[0], peaks[0].tolist()) == (AT_REST, 0, [0.0, 0.0])


def test_no_block_is_followed_beyond_the_limit_or_the_time_afterwards() -> None:
    one, values = np.ones(1), record(200)
    assert fates(sampled(values, STEP), plain(one, 0.5 * one, one), limit=150)[0][0] == UNDECIDED
    hard = synthetic(np.random.default_rng(4), 100, STEP, 1.2)
    assert fates(sampled(hard, STEP), plain(one, one, one))[0][0] in {ROCKING, OVERTURNED}


def test_the_peak_of_a_rectangular_pulse_in_closed_form() -> None:
    # a = 1.5 for t = 0.4, from a jump at the start to a still base: then G e^t + H e^-t + 1.
    t = 0.4
    values = np.concatenate([np.full(21, 1.5), np.zeros(1)])
    one = np.ones(1)
    segments = sampled(values, t / 20.0, 1e-12)
    status, _, peaks = fates(segments, plain(0.5 * one, one, one))
    angle, velocity = 0.5 * (math.cosh(t) - 1.0), 0.5 * math.sinh(t)
    # (u - 1)^2 - u'^2 is kept on the still base.
    top = 1.0 - math.sqrt((1.0 - angle) ** 2 - velocity**2)
    assert peaks[0, 0] == pytest.approx(top, abs=1e-11)
    landing = math.sqrt(1.0 - (1.0 - top) ** 2)
    assert peaks[0, 1] == pytest.approx(max(velocity, landing), abs=1e-11)
    assert status[0] == AT_REST


def test_the_peaks_of_a_fall_are_those_when_it_passes_the_slenderness() -> None:
    # a = 3 from rest for ever long enough: u = 2 (cosh s - 1), which is 1 at cosh s = 1.5.
    values = np.concatenate([np.full(200, 3.0), np.zeros(1)])
    one = np.ones(1)
    status, impacts, peaks = fates(sampled(values, STEP), plain(0.5 * one, one, one))
    assert (status[0], impacts[0]) == (OVERTURNED, 0)
    assert peaks[0].tolist() == [1.0, pytest.approx(2.0 * math.sqrt(1.25), rel=1e-12)]


@every("deviation", [None, 0.1])
@every("nonlinear", [False, True])
def test_the_peaks_of_a_fall_are_those_of_all_its_flights_up_to_the_last_passage(
    nonlinear: bool, deviation: float | None
) -> None:
    count = sample_size(150, 4)
    sides = blocks(count, nonlinear=nonlinear, alike=False, deviation=deviation)
    sides[:, :, RATE] *= 2.0
    segments = table(record(150, 6.0), STEP, nonlinear=nonlinear)
    status, _, peaks = fates(segments, sides)
    falls = turned = 0
    for i in np.flatnonzero(status == OVERTURNED):
        tables, start = Tables(segments, sides[i]), March(0, 0.0, 0.0, 0, 0, 0.0, 0, 0)
        until = Until(0, AFTERWARDS / sides[i, 0, RATE], math.inf, PLENTY)
        _, end = march(tables, start, until, Kept(np.zeros((0, 8)), np.zeros(0)))
        rows = np.zeros((end.flights, 8))
        march(tables, start, until, Kept(rows, np.zeros(0)))
        *angles, speed = peaks_until_overturning(segments, sides[i], rows)
        unit = sides[i, 0, LEAN] * sides[i, 0, RATE]
        np.testing.assert_allclose(peaks[i], [max(angles), speed / unit], rtol=1e-13)
        lean = np.where(rows[:, 3] > 0.0, sides[i, 0, LEAN], sides[i, 1, LEAN])
        beyond, inwards = np.abs(rows[:, 4]) > lean, rows[:, 3] * rows[:, 5] < 0.0
        turned += bool((beyond & inwards).any())
        falls += 1
    if count > 10:
        assert falls > turned > 0
