"""Rest: uplift at its node, and chatter that is never ended before its bound."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rocksteady.kernels.core.forcing import SINE, Forcing, make_forcing
from rocksteady.kernels.core.tables import (
    AT_REST,
    ENDED_BY_IMPACT,
    ENDED_BY_UPLIFT,
    OVERTURNED,
    ROCKING,
    ROW_DURATION,
    ROW_EVENT,
    ROW_PHASE,
    ROW_SIDE,
    UNDECIDED,
)
from rocksteady.kernels.march.replay import recorded_peaks
from rocksteady.kernels.march.rest import STILL, Bounce, bounce_bounds, settles, uplift_time
from tests.kernels.tables import Piece, Run, both_sides, exact_segments, harmonic, run, table
from tests.oracles import exact_march, mp
from tests.strategies import amplitudes, inner_sample_size, logarithmic, phases, sample_size


@given(st.floats(-3.0, 3.0), st.floats(-3.0, 3.0), amplitudes, logarithmic(0.1, 50.0), phases)
def test_uplift_is_the_first_time_at_which_the_forcing_is_positive(
    constant: float, slope: float, amplitude: float, frequency: float, phase: float
) -> None:
    span = 4.0
    forcing = make_forcing(constant, slope, amplitude, frequency)
    found = uplift_time(forcing, phase, span)
    times = np.linspace(0.0, span, 20_001)
    values = constant + slope * times + amplitude * np.sin(phase + frequency * times)
    positive = np.flatnonzero(values > 1e-9)
    if len(positive) == 0:
        # It may rise through zero between the samples, not by much.
        if math.isfinite(found):
            swing = amplitude * frequency**2 * (span / 20_000) ** 2 + 1e-8
            assert values.max() > -swing
        return
    first = float(times[positive[0]])
    assert found <= first
    before = times < found - 1e-9
    assert np.all(values[before] <= 1e-9)


@given(st.floats(1.0, 12.0, exclude_min=True), logarithmic(0.05, 1000.0), phases)
def test_under_harmonic_shaking_uplift_is_the_node(
    amplitude: float, frequency: float, phase: float
) -> None:
    forcing = make_forcing(-1.0, 0.0, amplitude, frequency)
    if forcing.kind != SINE:
        return
    node = mp.asin(1 / mp.mpf(amplitude))
    found = uplift_time(forcing, phase, math.inf)
    start = mp.mpf(phase)
    if node <= start < mp.pi - node:
        assert found <= 1e-15 / frequency
        return
    ahead = (node - start) if start < node else (node - start + 2 * mp.pi)
    assert abs(found - ahead / mp.mpf(frequency)) <= 1e-15 * (4 + ahead) / frequency


def test_uplift_beyond_the_span_is_none() -> None:
    forcing = make_forcing(-1.0, 0.0, 2.0, 1.0)
    node = math.asin(0.5)
    assert uplift_time(forcing, 0.0, node * (1.0 - 1e-12)) == math.inf
    assert uplift_time(forcing, 0.0, node * (1.0 + 1e-12)) == pytest.approx(node, rel=1e-15)
    assert uplift_time(make_forcing(-1.0, 0.5, 0.0, 0.0), 0.0, 3.0) == 2.0
    assert uplift_time(make_forcing(-1.0, -0.5, 0.0, 0.0), 0.0, 3.0) == math.inf


# ------------------------------------------------------------------------------------- chatter


def uplifts(ran: Run) -> list[tuple[float, float]]:
    """Return side and phase of each uplift from rest."""
    rows = ran.rows
    return [
        (float(rows[i + 1, ROW_SIDE]), float(rows[i + 1, ROW_PHASE]))
        for i in range(len(rows) - 1)
        if rows[i, ROW_EVENT] == ENDED_BY_UPLIFT
    ]


def test_a_march_that_settles_ends_as_one_that_bounces_on() -> None:
    rng = np.random.default_rng(1)
    settled, saved = 0, 0
    for _ in range(sample_size(400, 15)):
        amplitude = rng.choice([rng.uniform(1.0, 1.1), rng.uniform(1.0, 6.0)])
        frequency = 10.0 ** rng.uniform(-0.5, 1.5)
        restitution = rng.uniform(0.1, 0.9)
        segments, sides = harmonic(amplitude, frequency, 0.1), both_sides(restitution)
        proved = run(segments, sides, half_cycles=sample_size(8, 4), limit=100_000)
        bounced = run(
            segments, sides, half_cycles=sample_size(8, 4), rest_velocity=0.0, limit=100_000
        )
        assert {proved.status, bounced.status} <= {ROCKING, AT_REST, OVERTURNED}
        # Compare up to where chaos may have told the two apart: the first few uplifts.
        lifts, slow = uplifts(proved), uplifts(bounced)
        settled += len(lifts) > 1
        saved += bounced.end.impacts - proved.end.impacts
        for one, other in list(zip(lifts, slow, strict=False))[:3]:
            assert one == other, (amplitude, frequency, restitution)
        if len(lifts) < 4:
            assert len(lifts) == len(slow)
            assert proved.status == bounced.status
    assert settled > sample_size(80, 3)
    assert saved > 0


def test_rest_comes_no_earlier_than_the_chatter_ends() -> None:
    # Bouncing on in 50 digits ends before the bound says so and before the uplift that follows.
    for amplitude, frequency, restitution in ((1.3, 3.0, 0.5), (2.0, 4.0, 0.3), (0.8, 9.0, 0.7)):
        piece = Piece(amplitude=amplitude, frequency=frequency, phase=0.2)
        ran = run(table(piece), both_sides(restitution), side=1, velocity=0.01, half_cycles=4)
        rows, times = ran.rows, ran.times()
        rests = [i for i in range(len(rows)) if rows[i, ROW_SIDE] == 0.0]
        assert rests
        first = rests[0]
        exact = exact_march(
            exact_segments(piece),
            times[first] + mp.mpf(float(rows[first, ROW_DURATION])),
            side=1,
            velocity=0.01,
            restitution=(mp.mpf(restitution),) * 2,
            most_impacts=400,
        )
        assert abs(exact.impacts[-1].velocity) < 1e-29
        assert exact.impacts[-1].time < times[first] + mp.mpf(float(rows[first, ROW_DURATION]))
        assert not exact.uplifts or exact.uplifts[0] >= exact.impacts[-1].time


@given(
    amplitude=st.floats(0.0, 3.0),
    frequency=logarithmic(0.1, 30.0),
    phase=phases,
    velocity=logarithmic(1e-6, 0.3),
    restitution=st.floats(0.05, 0.99),
)
def test_chatter_that_is_said_to_settle_does(
    amplitude: float, frequency: float, phase: float, velocity: float, restitution: float
) -> None:
    here = make_forcing(-1.0, 0.0, amplitude, frequency)
    there_phase = phase + math.pi if phase < 0.5 * math.pi else phase - math.pi
    first, second = (Bounce(here, seen, velocity, 1.0) for seen in (phase, there_phase))
    said = settles(restitution, math.inf, first, second, math.inf)
    if not said:
        return
    # No uplift while it bounces, all of them by brute force.
    start = phase % (2.0 * math.pi)
    ran = run(
        harmonic(amplitude, frequency, start),
        both_sides(restitution),
        side=1,
        velocity=velocity,
        half_cycles=4,
        rest_velocity=0.0,
        limit=int(2 + math.log(STILL) / math.log(restitution)),
    )
    bounces = ran.rows[ran.rows[:, ROW_SIDE] != 0.0]
    total = 0.0
    for row in ran.rows:
        if row[ROW_SIDE] == 0.0:
            break
        total += row[ROW_DURATION]
    crest = math.pi / 2 - phase if phase < math.pi / 2 else 5 * math.pi / 2 - phase
    if amplitude > 1.0:
        node = (math.asin(1.0 / amplitude) - phase) % (2.0 * math.pi)
        other = (math.asin(1.0 / amplitude) - there_phase) % (2.0 * math.pi)
        assert total * frequency < min(node, other) + 1e-12
    assert len(bounces) > 0
    assert crest > 0.0
    if ran.status != ROCKING:  # else the run ended before the chatter did
        assert np.all(np.abs(np.diff(np.abs(bounces[:40, 5]))) >= 0.0)
        assert np.all(np.abs(bounces[1:40, 5]) < np.abs(bounces[:39, 5]) + 1e-300)


def test_a_bounce_is_no_longer_and_lands_no_faster_than_bounded() -> None:
    rng = np.random.default_rng(5)
    checked = 0
    for _ in range(inner_sample_size(4000, 300)):
        amplitude, frequency = rng.uniform(0.0, 3.0), 10.0 ** rng.uniform(-1.0, 2.0)
        phase = float(rng.uniform(-0.5 * math.pi, 1.5 * math.pi))
        velocity = 10.0 ** rng.uniform(-4.0, -0.3)
        forcing = make_forcing(-1.0, 0.0, amplitude, frequency)
        window = 4.0 * velocity
        growth, duration, top = bounce_bounds(Bounce(forcing, phase, velocity, 1.0), window)
        if not duration <= window:
            continue
        segments = harmonic(amplitude, frequency, phase % (2.0 * math.pi))
        ran = run(
            segments,
            both_sides(1.0),
            side=1,
            velocity=velocity,
            limit=2,
            rest_velocity=0.0,
        )
        checked += 1
        assert ran.rows[0, ROW_DURATION] <= duration * (1.0 + 1e-12)
        assert ran.rows[1, 5] ** 2 <= growth * velocity**2 * (1.0 + 1e-12)
        height, _, _ = recorded_peaks(
            segments, both_sides(1.0), ran.rows[:1], ran.rows[0, ROW_DURATION]
        )
        assert height <= top * (1.0 + 1e-9)
        if amplitude < 1e-2:
            assert top < 1.1 * height
    assert checked > inner_sample_size(500, 30)


def bounces_fit(
    forcing: Forcing, phases_seen: tuple[float, float], velocity: float, loss: float, window: float
) -> bool:
    """Return whether the geometric sum of the bounds of all bounces fits into a window."""
    bounds = [bounce_bounds(Bounce(forcing, phase, velocity, 1.0), window) for phase in phases_seen]
    kappa = (1.0 - loss) * math.sqrt(max(growth for growth, _, _ in bounds))
    longest = max(duration for _, duration, _ in bounds)
    return kappa < 1.0 and longest / (1.0 - kappa) <= window


def check_chatter(seed: int, count: int) -> None:
    # The proof itself: some window, no longer than the span, holds the sum of the bounds.
    rng = np.random.default_rng(seed)
    said, refused = 0, 0
    for _ in range(count):
        amplitude, frequency = rng.uniform(0.0, 3.0), 10.0 ** rng.uniform(-1.0, 2.0)
        phase = float(rng.uniform(-0.5 * math.pi, 1.5 * math.pi))
        other = phase + math.pi if phase < 0.5 * math.pi else phase - math.pi
        velocity, loss = 10.0 ** rng.uniform(-6.0, -0.5), 10.0 ** rng.uniform(-3.0, -0.1)
        span = 10.0 ** rng.uniform(-3.0, 1.0)
        forcing = make_forcing(-1.0, 0.0, amplitude, frequency)
        first, second = (Bounce(forcing, seen, velocity, 1.0) for seen in (phase, other))
        ends = settles(1.0 - loss, span, first, second, math.inf)
        if ends:
            assert any(
                bounces_fit(forcing, (phase, other), velocity, loss, float(window))
                for window in np.geomspace(1e-9, 1.0, 400) * span
            )
        said += ends
        refused += not ends
    assert min(said, refused) > count // 20


@pytest.mark.slow
def test_the_bounces_of_chatter_that_settles_fit_into_a_window_without_uplift() -> None:
    check_chatter(6, inner_sample_size(4000, 1000))


def test_the_bounces_of_a_little_chatter_that_settles_fit_into_a_window() -> None:
    check_chatter(16, 300)


def test_chatter_cut_off_by_the_next_segment_goes_on_in_it() -> None:
    # Whoever bounces at the end of a segment is not at rest there, however slow.
    for velocity, restitution in ((0.1, 0.5), (0.3, 0.8), (0.02, 0.3)):
        sides = both_sides(restitution)
        alone = run(table(Piece()), sides, side=1, velocity=velocity, rest_velocity=0.0, limit=9)
        for bounces in range(1, 9):
            at = float(sum(alone.durations()[:bounces])) * (1.0 + 1e-6)
            segments = table(Piece(at), Piece(1.0, constant=1.2))
            truth = run(
                segments, sides, side=1, velocity=velocity, until=at + 0.1, rest_velocity=0.0
            )
            ran = run(segments, sides, side=1, velocity=velocity, until=at + 0.1)
            assert abs(truth.end.velocity) > 0.0
            assert ran.end.angle == pytest.approx(truth.end.angle, rel=1e-12)
            assert ran.end.velocity == pytest.approx(truth.end.velocity, rel=1e-12)


def test_without_loss_chatter_never_ends() -> None:
    ran = run(harmonic(0.5, 3.0), both_sides(1.0), side=1, velocity=1e-3, limit=2000)
    assert ran.status == UNDECIDED
    assert np.all(ran.rows[:, ROW_SIDE] != 0.0)
    bounce = Bounce(make_forcing(-1.0, 0.0, 0.0, 0.0), 0.0, 1e-9, 1.0)
    assert not settles(1.0, math.inf, bounce, bounce, math.inf)


def test_chatter_without_a_rest_velocity_still_ends() -> None:
    # Below 1e-100 a bounce lasts less than any clock resolves.
    ran = run(
        harmonic(0.5, 3.0), both_sides(0.5), side=1, velocity=0.1, half_cycles=40, rest_velocity=0.0
    )
    assert ran.status == AT_REST
    assert 300 < np.count_nonzero(ran.rows[:, ROW_EVENT] == ENDED_BY_IMPACT) < 500
    # From 0.1 on half as fast each time, about: 16 or 17 leave with 1e-6 or more.
    assert 15 < ran.end.impacts < 19


def test_unlike_sides_settle_as_the_worse_of_them() -> None:
    # The larger restitution and both sides' clocks count: brute force agrees.
    rng = np.random.default_rng(9)
    compared = 0
    for _ in range(sample_size(300, 20)):
        sides = both_sides(
            (rng.uniform(0.1, 0.9), rng.uniform(0.1, 0.9)),
            (1.0, rng.uniform(0.5, 2.0)),
            (1.0, rng.uniform(0.5, 2.0)),
        )
        segments = harmonic(rng.uniform(1.0, 3.0), rng.uniform(1.0, 8.0), 0.1)
        proved = run(segments, sides, half_cycles=5, limit=20_000)
        bounced = run(segments, sides, half_cycles=5, rest_velocity=0.0, limit=20_000)
        one, other = uplifts(proved)[:2], uplifts(bounced)[:2]
        shared = min(len(one), len(other))
        assert one[:shared] == other[:shared]
        compared += shared > 0
    assert compared > sample_size(100, 10)
