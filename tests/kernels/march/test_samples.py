"""Runs of samples against the search of each for zeros, against 50 digits, and by invariants."""

import math
from collections.abc import Callable
from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady.kernels.core.tables import (
    AT_REST,
    CEILING,
    CONSTANT,
    DURATION,
    ENDED_BY_NO_RETURN,
    ENDED_BY_UPLIFT,
    OVERTURNED,
    PEAK_ANGLE,
    PEAK_SPEED,
    ROW_ANGLE,
    ROW_DURATION,
    ROW_EVENT,
    ROW_SEGMENT,
    ROW_SIDE,
    ROW_VELOCITY,
    SLOPE,
    UNDECIDED,
    March,
)
from rocksteady.kernels.core.tuples import Kept, Tables, Until
from rocksteady.kernels.march._samples import LONGEST, fly_through, make_stride
from rocksteady.kernels.march.march import march
from rocksteady.kernels.march.replay import fill_states, recorded_peaks
from tests.every import every
from tests.kernels.tables import (
    PLENTY,
    Run,
    both_sides,
    exact_segments,
    one_by_one,
    run,
    sampled,
    sampled_pieces,
)
from tests.oracles import ExactFlight, exact_march, mp
from tests.records import el_centro, rinaldi, synthetic
from tests.strategies import sample_size

Floats = NDArray[np.float64]

UNLIKE = both_sides((0.8, 0.9), (1.0, 0.7), (1.0, 1.3))


def strong_impacts(ran: Run) -> Floats:
    """Return the times of the impacts that leave more than a trembling."""
    starts = np.concatenate([[0.0], np.cumsum(ran.segments[:-1, DURATION])])
    rows = ran.rows
    after = np.flatnonzero(rows[:-1, ROW_EVENT] == 1) + 1
    after = after[np.abs(rows[after, ROW_VELOCITY]) > 1e-5]
    return np.asarray(starts[rows[after, ROW_SEGMENT].astype(int)] + rows[after, 2])


def random_motion(rng: np.random.Generator) -> tuple[Floats, Floats]:
    """Return a table of samples and the sides of a block that it may lift, rock or overturn."""
    p, step = rng.uniform(0.8, 8.0), rng.choice([0.005, 0.01, 0.02])
    values = synthetic(rng, int(rng.integers(100, sample_size(1500, 150))), step, 1.0)
    sides = both_sides(rng.uniform(0.5, 1.0))
    if rng.random() < 0.4:
        lean, rate = rng.uniform(0.6, 1.5, 2), rng.uniform(0.7, 1.4, 2)
        restitution = (rng.uniform(0.5, 1.0), rng.uniform(0.5, 1.0))
        sides = both_sides(restitution, (lean[0], lean[1]), (rate[0], rate[1]))
    return sampled(values * 10.0 ** rng.uniform(-0.2, 0.8), step * p), sides


# ------------------------------------------------------------------------------- the factors


@every("h", [*np.geomspace(1e-8, 1.0, 33).tolist(), 1e-150, 0.25, 0.7071])
def test_the_factors_of_a_sample_are_those_of_50_digits(h: float) -> None:
    stride = make_stride(h)
    with mp.workdps(400):  # the plain formulae cancel
        exact = mp.mpf(h)
        sinh, rise = mp.sinh(exact), mp.cosh(exact) - 1
        factors = (sinh, rise, sinh / exact - 1, rise / exact, exact**2 / 2)
        for factor, truth in zip(stride, factors, strict=True):
            if truth > 1e-300:
                assert abs(factor / truth - 1) < (5e-16 if truth != factors[-1] else 2e-12)


# ------------------------------------------------------------- against one search per segment


def marches_alike(segments: Floats, sides: Floats) -> Run | None:
    """Compare with the march of each segment on its own; None where rounding decides.

    Rocking amplifies rounding: what a jolt in the last digits of the motion makes is the measure.
    """
    jolted = one_by_one(segments)
    jolted[:, [CONSTANT, SLOPE, CEILING]] *= 1.0 + 3e-16
    fast, slow, other = (run(t, sides) for t in (segments, one_by_one(segments), jolted))
    at, truth, moved = (strong_impacts(ran) for ran in (fast, slow, other))
    if len(truth) != len(moved) or np.abs(truth - moved).max(initial=0.0) > 1e-6:
        return None
    assert (fast.status, fast.end.side, len(at)) == (slow.status, slow.end.side, len(truth))
    swell = np.maximum.accumulate(np.abs(truth - moved)) if len(truth) else truth
    assert np.all(np.abs(at - truth) <= 1e-10 + 100.0 * swell)
    if fast.status == OVERTURNED:
        assert fast.end.segment == slow.end.segment
        assert fast.rows[-1, ROW_EVENT] == slow.rows[-1, ROW_EVENT]
    return fast


def check_runs(seed: int, cases: int) -> None:
    rng = np.random.default_rng(seed)
    runs = [marches_alike(*random_motion(rng)) for _ in range(cases)]
    compared = [ran.status for ran in runs if ran is not None]
    assert len(compared) > 0.8 * cases
    if cases > 100:
        assert min(compared.count(AT_REST), compared.count(OVERTURNED)) > 50


@pytest.mark.slow
def test_a_run_marches_as_its_segments_one_by_one() -> None:
    check_runs(1940, sample_size(400, 6))


def test_a_few_runs_march_as_their_segments_one_by_one() -> None:
    check_runs(1941, 4)


@every("record", [el_centro, rinaldi])
@every(("p", "uplift"), [(1.5, 2.5), (2.5, 1.5), (5.0, 2.0), (2.0, 1.0)])
def test_a_real_record_marches_as_its_segments_one_by_one(
    record: Callable[[], tuple[Floats, float]], p: float, uplift: float
) -> None:
    values, step = record()
    values = values[: sample_size(len(values), 600)]
    ran = marches_alike(sampled(values / uplift, step * p), both_sides(0.9))
    assert ran is not None
    assert ran.end.impacts > 0


def test_flights_and_rests_are_rows_a_segment_as_before() -> None:
    rng = np.random.default_rng(7)
    segments = sampled(synthetic(rng, 400, 0.02, 1.6), 0.03)
    for sides in (both_sides(0.7), UNLIKE):
        fast, slow = run(segments, sides), run(one_by_one(segments), sides)
        assert len(fast.rows) == len(slow.rows) > 400
        whole = [ROW_SEGMENT, ROW_SIDE, ROW_EVENT]
        np.testing.assert_array_equal(fast.rows[:, whole], slow.rows[:, whole])
        rest = [ROW_ANGLE, ROW_VELOCITY, ROW_DURATION]
        np.testing.assert_allclose(fast.rows[:, rest], slow.rows[:, rest], rtol=0.0, atol=1e-11)


def test_a_last_sample_of_another_length_is_marched_on_its_own() -> None:
    rng = np.random.default_rng(3)
    values = synthetic(rng, 300, 0.02, 2.0)
    values[-2:] = 1.7, 1.9
    segments = sampled(values, 0.05, 0.013)
    fast, slow = run(segments, both_sides(0.8)), run(one_by_one(segments), both_sides(0.8))
    assert (fast.status, len(fast.rows)) == (slow.status, len(slow.rows))
    np.testing.assert_allclose(strong_impacts(fast), strong_impacts(slow), rtol=0.0, atol=1e-10)


@every("step", [1.01 * LONGEST, 3.0, 40.0])
def test_samples_too_long_for_the_series_are_marched_one_by_one(step: float) -> None:
    # Near the balance of angle 0.5 under 0.5, where the block stays up for long.
    segments = sampled(np.array([0.5, 0.5, 0.50001, 0.5, 0.5, 0.7, -2.0, 0.0, 0.0]), step)
    fast, slow = (
        run(t, both_sides(0.8), side=1, angle=0.5, velocity=1e-6)
        for t in (segments, one_by_one(segments))
    )
    assert fast.end == slow.end
    np.testing.assert_array_equal(fast.rows, slow.rows)


@pytest.mark.parametrize(("velocity", "status"), [(-2.5, AT_REST), (-1.5, OVERTURNED)])
def test_a_block_thrown_back_from_far_out_is_not_given_up(velocity: float, status: int) -> None:
    # (angle - 1 + velocity)/2 grows: thrown back faster than 2 from an angle of 3 it returns.
    segments = sampled(np.zeros(300), 0.05)
    for table in (segments, one_by_one(segments)):
        ran = run(table, both_sides(0.5), side=1, angle=3.0, velocity=velocity)
        assert ran.status == status


# ---------------------------------------------------------------------------- 50 digits


@pytest.mark.slow
@every("seed", range(sample_size(6, 2)))
def test_impacts_are_those_of_50_digits(seed: int) -> None:
    rng = np.random.default_rng(seed)
    values = synthetic(rng, 120, 0.02, rng.uniform(1.4, 4.0))
    step = float(rng.uniform(0.02, 0.06))
    sides = UNLIKE if seed % 2 else both_sides(0.75)
    restitution, lean, rate = (tuple(column) for column in sides.T.tolist())
    until = 120 * step
    truth = exact_march(
        exact_segments(*sampled_pieces(values, step)),
        until,
        side=1,
        angle=0.02,
        restitution=restitution,
        lean=lean,
        rate=rate,
        most_impacts=40,
    )
    ran = run(sampled(values, step), sides, side=1, angle=0.02, until=until, rest_velocity=0.0)
    found = ran.impacts()
    assert len(truth.impacts) > 3
    for (time, side, velocity), exact in zip(found, truth.impacts, strict=False):
        assert side == exact.side
        assert abs(time - exact.time) < 1e-11
        assert abs(velocity - exact.velocity) < 1e-11
    assert len(found) == len(truth.impacts) or len(truth.impacts) == 40


# A block set down upon samples that throw it back: how far it comes down depends on their scale.
GRAZING = np.concatenate([np.linspace(0.9, 2.0, 20), [1.4, 2.3, 1.9, 2.6], np.full(30, 1.5)])
GRAZING_STEP = 0.04
SET_DOWN = (0.35, -0.5)


def lowest_point(scale: float) -> mp.mpf:
    """Return the least angle of the first dip, were there no floor, in 50 digits."""
    h, y, v = mp.mpf(GRAZING_STEP), mp.mpf(SET_DOWN[0]), mp.mpf(SET_DOWN[1])
    for piece in sampled_pieces(scale * GRAZING, GRAZING_STEP):
        flight = ExactFlight(
            mp.mpf(piece.constant) - 1, mp.mpf(piece.slope), mp.mpf(0), mp.mpf(0), y, v, mp.mpf(0)
        )
        if flight.state(h)[1] > 0:
            low, high = mp.mpf(0), h
            for _ in range(100):
                middle = (low + high) / 2
                low, high = (middle, high) if flight.state(middle)[1] < 0 else (low, middle)
            return flight.state(high)[0]
        y, v = flight.state(h)
    raise AssertionError("it never comes back")


@cache
def grazing_scale() -> float:
    """Return the scale at which the dip just touches the floor."""
    low, high = 0.8, 1.0
    while (middle := 0.5 * (low + high)) not in {low, high}:
        low, high = (middle, high) if lowest_point(middle) < 0 else (low, middle)
    return high


@every("offset", [1e-13, 1e-11, 1e-8, 1e-5, 1e-3])
@every("way", [-1, 1])
def test_a_dip_that_just_touches_is_an_impact_and_one_that_just_does_not_is_none(
    offset: float, way: int
) -> None:
    values = grazing_scale() * (1.0 + way * offset) * GRAZING
    until = 1.6
    restitution = (0.9, 0.9)
    truth = exact_march(
        exact_segments(*sampled_pieces(values, GRAZING_STEP)),
        until,
        side=1,
        angle=SET_DOWN[0],
        velocity=SET_DOWN[1],
        restitution=restitution,
        most_impacts=30,
    )
    assert (len(truth.impacts) > 0) == (way < 0)
    ran = run(
        sampled(values, GRAZING_STEP),
        both_sides(restitution),
        side=1,
        angle=SET_DOWN[0],
        velocity=SET_DOWN[1],
        until=until,
        rest_velocity=0.0,
        limit=PLENTY if way > 0 else 200,
    )
    times = [time for time, _, _ in ran.impacts()]
    assert (len(times) > 0) == (len(truth.impacts) > 0)
    for time, exact in zip(times[:1], truth.impacts, strict=False):
        # The touch of a parabola is only as sharp as the root of what rounding leaves.
        assert abs(time - exact.time) < 1e-15 / math.sqrt(offset) + 1e-13


# ------------------------------------------------------------------------------- invariants


def test_without_loss_energy_is_kept_over_a_hundred_thousand_samples() -> None:
    count, energy = sample_size(100_000, 2_000), 0.4
    segments = sampled(np.zeros(count), 0.01)
    ran = run(segments, both_sides(1.0), side=1, velocity=math.sqrt(2.0 * energy), until=count)
    assert ran.end.impacts > count / 1000
    angle, velocity = ran.rows[:, ROW_ANGLE], ran.rows[:, ROW_VELOCITY]
    kept = 0.5 * velocity**2 + np.abs(angle) - 0.5 * angle**2
    np.testing.assert_allclose(kept, energy, rtol=0.0, atol=1e-15 * count)


def test_the_mirrored_march_is_the_same_to_the_last_bit() -> None:
    rng = np.random.default_rng(11)
    values = synthetic(rng, 500, 0.02, 1.7)
    one = run(sampled(values, 0.04), both_sides(0.8))
    other = run(sampled(-values, 0.04), both_sides(0.8))
    mirrored = other.rows.copy()
    mirrored[:, [ROW_SIDE, ROW_ANGLE, ROW_VELOCITY]] *= -1.0
    assert one.end.impacts > 3
    np.testing.assert_array_equal(one.rows, mirrored)


@every("limit", [1, 2, 57, 400, 1001])
def test_the_limit_of_flights_is_kept(limit: int) -> None:
    rng = np.random.default_rng(5)
    segments = sampled(synthetic(rng, 1000, 0.02, 2.0), 0.02)
    whole, part = run(segments, both_sides(0.8)), run(segments, both_sides(0.8), limit=limit)
    assert (part.status, part.end.flights, len(part.rows)) == (UNDECIDED, limit, limit)
    np.testing.assert_array_equal(part.rows, whole.rows[:limit])


@every("sign", [1.0, -1.0])
@every("threshold", [0, 1])
def test_uplift_is_where_the_line_between_two_samples_crosses(sign: float, threshold: int) -> None:
    lean = 0.7 if threshold else 1.0
    sides = both_sides(0.8, (1.0, lean) if sign < 0.0 else (lean, 1.0))
    values = sign * np.array([0.0, 0.3, -0.4, 0.1, 0.5, 1.1 * lean, 0.2, 0.0, 0.0])
    ran = run(sampled(values, 0.25), sides, until=3.0)
    lifted = int(np.flatnonzero(ran.rows[:, ROW_EVENT] == ENDED_BY_UPLIFT)[0])
    assert ran.rows[lifted, ROW_SEGMENT] == 4
    wait = 0.25 * (lean - 0.5) / (1.1 * lean - 0.5)
    assert ran.rows[lifted, ROW_DURATION] == pytest.approx(wait, rel=1e-15)
    assert ran.rows[lifted + 1, ROW_SIDE] == sign


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_motion_that_begins_above_uplift_lifts_at_once(sign: float) -> None:
    ran = run(sampled(sign * np.array([1.5, 0.2, 0.0, 0.0]), 0.1), both_sides(0.8))
    assert ran.rows[0, ROW_SIDE] == sign
    assert ran.end.impacts > 0


def test_samples_at_uplift_to_the_last_bit_do_not_lift() -> None:
    segments = sampled(np.array([0.0, 1.0, 0.4, -1.0, -1.0, 1.0, 0.0]), 0.1)
    ran = run(segments, both_sides(0.8), until=1.0)
    assert ran.status == AT_REST
    assert not ran.rows[:, ROW_SIDE].any()


# ------------------------------------------------------------------------------------ peaks


def peaks_of(segments: Floats, sides: Floats, limit: int = PLENTY) -> tuple[int, March, Floats]:
    start, peaks = March(0, 0.0, 0.0, 0, 0, 0.0, 0, 0), np.zeros(2)
    none = np.zeros((0, 8))
    status, end = march(
        Tables(segments, sides), start, Until(0, math.inf, math.inf, limit), Kept(none, peaks)
    )
    return status, end, peaks


def test_peaks_are_those_of_the_recorded_flights() -> None:
    rng = np.random.default_rng(77)
    fell = 0
    for _ in range(sample_size(60, 3)):
        segments, sides = random_motion(rng)
        ran = run(segments, sides)
        status, end, peaks = peaks_of(segments, sides)
        assert (status, end) == (ran.status, ran.end), "watching changes nothing"
        fell += status == OVERTURNED
        proved = ran.rows[-1, ROW_EVENT] == ENDED_BY_NO_RETURN  # in a flight without end
        rows = ran.rows[:-1] if proved else ran.rows
        *own, swift = recorded_peaks(segments, sides, rows, rows[-1, ROW_DURATION])
        top = max(own)
        if proved:
            assert peaks[PEAK_ANGLE] >= top * (1.0 - 1e-13)
            assert peaks[PEAK_SPEED] >= swift * (1.0 - 1e-13)
        else:
            fast = sampled_speed(ran, sides)
            assert peaks[PEAK_ANGLE] == pytest.approx(top, rel=1e-13)
            assert peaks[PEAK_SPEED] == pytest.approx(swift, rel=1e-13)
            assert fast * (1.0 - 1e-14) <= peaks[PEAK_SPEED] <= fast * (1.0 + 1e-3)
        assert end.flights == len(ran.rows)
    assert sample_size(fell, 1) > 0


def sampled_speed(ran: Run, sides: Floats, points: int = 20) -> float:
    """Return the largest speed at evenly spaced times of each flight, its ends included."""
    moving = np.flatnonzero(ran.rows[:, ROW_SIDE])
    since = np.linspace(0.0, 1.0, points)[:, None] * ran.rows[moving, ROW_DURATION]
    index = np.array(np.broadcast_to(moving, since.shape)).ravel()
    states = np.empty((3, index.size))
    fill_states(ran.segments, sides, ran.rows, index, since.ravel(), states)
    return float(np.abs(states[1]).max(initial=0.0))


def test_peaks_within_samples_are_found_wherever_they_lie() -> None:
    # Strong samples, far above the floor: velocity and acceleration turn within many of them.
    rng = np.random.default_rng(13)
    for case in range(sample_size(600, 120)):
        step, offset = float(rng.uniform(0.02, 0.6)), 50.0
        values = 1.0 - offset + rng.normal(0.0, 6.0, 5)
        segments = sampled(values, step)
        segments[:, CEILING] = math.inf
        angle, velocity = offset + rng.normal(), rng.normal(0.0, 2.0)
        sides = UNLIKE if case % 2 else both_sides(0.8)
        lean, rate = sides[0, 1:]
        # Either peak may be out of reach, so that the other alone calls for a search.
        before = np.array([angle / lean + abs(rng.normal(0.0, 0.2)), abs(rng.normal(0.0, 3.0))])
        before[rng.integers(2)] *= rng.choice([1.0, 100.0])
        peaks, none = before.copy(), np.zeros((0, 8))
        begin = March(1, angle, velocity, 0, 0, 0.0, 0, 0)
        tables, kept = Tables(segments, sides), Kept(none, peaks)
        until = Until(0, math.inf, 0.0, PLENTY)
        state, _, _ = fly_through(tables, begin, until, kept)
        passed = state.segment
        assert passed >= 3
        y, v, tops = angle / lean, velocity / (lean * rate), before / [1.0, lean * rate]
        for piece in sampled_pieces(values, step)[:passed]:
            t = np.linspace(0.0, step * rate, 4001)
            r, m = piece.constant / lean - 1.0, piece.slope / (lean * rate)
            angles = (v + m) * np.sinh(t) + (y + r) * np.cosh(t) - r - m * t
            speeds = (v + m) * np.cosh(t) + (y + r) * np.sinh(t) - m
            tops = np.maximum(tops, [angles.max(), np.abs(speeds).max()])
            y, v = angles[-1], speeds[-1]
        np.testing.assert_allclose(peaks / [1.0, lean * rate], tops, rtol=1e-6)
        # All are searched where nothing was reached before, and none is left out that rises higher.
        reached = np.zeros(2)
        fly_through(tables, begin, until, Kept(none, reached))
        nearly = reached * (1.0 - 1e-9)
        fly_through(tables, begin, until, Kept(none, nearly))
        assert nearly.tobytes() == reached.tobytes()


def test_a_flight_watched_sample_by_sample_peaks_where_the_search_finds_it() -> None:
    # Strong samples: the velocity turns twice within one, and the acceleration in most.
    rng = np.random.default_rng(13)
    for _ in range(sample_size(40, 4)):
        values = rng.normal(0.0, 4.0, 60)
        segments, sides = sampled(values, 0.4), both_sides(0.7)
        status, end, peaks = peaks_of(segments, sides)
        again, same, slow = peaks_of(one_by_one(segments), sides)
        assert (again, same.impacts) == (status, end.impacts)
        np.testing.assert_allclose(peaks, slow, rtol=1e-9)
