"""What a recorded march tells, against 50 digits and dense sampling of the same march."""

import math

import numpy as np
import pytest
from numpy.typing import ArrayLike, NDArray

from rocksteady.kernels.core.tables import OVERTURNED, ROW_DURATION, ROW_SIDE
from rocksteady.kernels.march.replay import fill_states, last_crossing, recorded_peaks
from tests.every import every
from tests.kernels.tables import Piece, Run, both_sides, exact_segments, harmonic, run, table
from tests.oracles import exact_march, mp
from tests.strategies import sample_size

Floats = NDArray[np.float64]


def states(ran: Run, sides: Floats, index: ArrayLike, since: ArrayLike) -> Floats:
    rows, times = (
        np.array(index, np.int64, ndmin=1),
        np.array(since, np.float64, ndmin=1),
    )
    filled = np.full((3, len(rows)), math.nan)
    fill_states(ran.segments, sides, ran.rows, rows, times, filled)
    return filled


@pytest.mark.parametrize(
    ("lean", "rate"), [((1.0, 1.0), (1.0, 1.0)), ((1.0, 0.7), (0.9, 1.2))], ids=["like", "unlike"]
)
def test_the_state_at_any_time_agrees_with_fifty_digits(
    lean: tuple[float, float], rate: tuple[float, float]
) -> None:
    pieces = (
        Piece(1.5, 0.1, -0.2, 1.2, 3.0, 0.4),
        Piece(1.0, jump=0.05),
        Piece(2.0, amplitude=1.5, frequency=6.0, phase=-1.0),
    )
    sides = both_sides((0.8, 0.7), lean, rate)
    ran = run(table(*pieces), sides, side=1, velocity=0.2, until=4.0, rest_velocity=0.0, limit=60)
    exact = exact_march(
        exact_segments(*pieces),
        4,
        side=1,
        velocity=mp.mpf(0.2),
        restitution=(mp.mpf(0.8), mp.mpf(0.7)),
        lean=tuple(map(mp.mpf, lean)),
        rate=tuple(map(mp.mpf, rate)),
        most_impacts=ran.end.impacts,
    )
    checked = 0
    for i, (begin, side, flight) in enumerate(exact.flights[: len(ran.rows) - 1]):
        duration = float(ran.rows[i, ROW_DURATION])
        if duration < 1e-3:
            break
        row = 0 if side > 0 else 1
        to_lean, to_rate = mp.mpf(lean[row]), mp.mpf(rate[row])
        assert abs(begin - ran.times()[i]) < 1e-12
        for share in (0.0, 0.3, 0.9):
            since = share * duration
            found = states(ran, sides, i, since)[:, 0]
            y, v = flight.state(mp.mpf(since) * to_rate)
            pull = y + flight.forcing(mp.mpf(since) * to_rate)
            truth = (side * to_lean * y, side * to_lean * to_rate * v)
            assert abs(found[0] - truth[0]) < 1e-12
            assert abs(found[1] - truth[1]) < 1e-11
            assert abs(found[2] - side * to_lean * to_rate**2 * pull) < 1e-10
            checked += 1
    assert checked > 10


def test_at_rest_nothing_moves() -> None:
    sides = both_sides(0.4)
    ran = run(harmonic(1.05, 2.0), sides, half_cycles=6)
    resting = np.flatnonzero(ran.rows[:, ROW_SIDE] == 0.0)
    assert len(resting) > 1
    assert not states(ran, sides, resting, 0.01 * np.ones(len(resting))).any()


def test_flights_join_without_a_gap() -> None:
    # Each row ends where the next begins: angle 0 at impacts, velocity times the restitution.
    sides = both_sides(0.8)
    ran = run(harmonic(2.0, 4.0), sides, side=1, velocity=0.3, half_cycles=30)
    count = len(ran.rows) - 1
    ends = states(ran, sides, np.arange(count), ran.rows[:count, ROW_DURATION])
    starts = states(ran, sides, np.arange(1, count + 1), np.zeros(count))
    assert np.abs(ends[0]).max() < 1e-14
    assert starts[1] == pytest.approx(0.8 * ends[1], abs=1e-14)


def test_the_highest_angle_and_speed_agree_with_dense_sampling() -> None:
    rng = np.random.default_rng(1)
    for _ in range(sample_size(40, 5)):
        lean = (1.0, float(rng.uniform(0.5, 1.5)))
        sides = both_sides(float(rng.uniform(0.4, 0.9)), lean, (1.0, float(rng.uniform(0.7, 1.3))))
        ran = run(
            harmonic(float(rng.uniform(0.8, 3.0)), float(rng.uniform(1.5, 8.0)), 0.2),
            sides,
            side=1,
            velocity=0.3,
            half_cycles=8,
        )
        last = float(ran.rows[-1, ROW_DURATION])
        last = 1.0 if math.isinf(last) else last
        *peaks, speed = recorded_peaks(ran.segments, sides, ran.rows, last)
        peak = max(own * unit for own, unit in zip(peaks, lean, strict=True))
        best = fastest = 0.0
        for i in range(len(ran.rows)):
            duration = last if i + 1 == len(ran.rows) else float(ran.rows[i, ROW_DURATION])
            samples = np.linspace(0.0, duration, 400)
            angles, speeds, _ = np.abs(states(ran, sides, np.full(400, i), samples))
            best, fastest = max(best, float(angles.max())), max(fastest, float(speeds.max()))
        assert best <= peak * (1.0 + 1e-14)
        assert best == pytest.approx(peak, rel=1e-4)
        assert fastest <= speed * (1.0 + 1e-14)
        assert fastest == pytest.approx(speed, rel=1e-4)


@every("velocity", [1.001, 1.3, 4.0])
def test_when_a_block_thrown_over_passes_its_critical_angle(velocity: float) -> None:
    # y = 1 - cosh t + V sinh t on a still base: y = 1 where tanh t = 1/V.
    sides = both_sides(0.5)
    ran = run(table(Piece()), sides, side=-1, velocity=-velocity)
    assert ran.status == OVERTURNED
    row, since = last_crossing(ran.segments, sides, ran.rows, 1.0)
    assert row == 0
    assert since == pytest.approx(math.atanh(1.0 / velocity), rel=1e-13)


def test_a_block_that_starts_above_a_level_has_been_above_since_its_start() -> None:
    sides = both_sides(0.5)
    ran = run(table(Piece()), sides, side=1, angle=1.5, velocity=0.0)
    assert ran.status == OVERTURNED
    assert last_crossing(ran.segments, sides, ran.rows, 1.0) == (0, 0.0)


def test_the_last_crossing_may_lie_segments_back() -> None:
    # It passes the critical angle in one segment, and the proof comes at the end of a later one.
    pieces = [Piece(0.25, constant=1.5 * (-1.0) ** i) for i in range(40)]
    sides = both_sides(0.5)
    ran = run(table(*pieces, Piece()), sides, side=1, velocity=1.8)
    assert ran.status == OVERTURNED
    row, since = last_crossing(ran.segments, sides, ran.rows, 1.0)
    assert row < len(ran.rows) - 1
    assert states(ran, sides, row, since)[0, 0] == pytest.approx(1.0, abs=1e-13)
    for i in range(row, len(ran.rows)):
        begin = since if i == row else 0.0
        samples = np.linspace(begin, ran.rows[i, ROW_DURATION], 50)[1:]
        assert np.all(states(ran, sides, np.full(49, i), samples)[0] > 1.0)
    assert np.all(np.diff([float(t) for t in ran.times()]) > 0.0)
    # Its motion has no impact, so that all rows are one flight.
    assert ran.end.impacts == 0
