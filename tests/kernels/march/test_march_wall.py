"""A block against a wall, against an integrator, 110 digits, closed forms and its mirror image."""

import math
from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady.kernels.core.clock import side_phase
from rocksteady.kernels.core.forcing import side_forcing
from rocksteady.kernels.core.tables import (
    AMPLITUDE,
    AT_REST,
    CONSTANT,
    ENDED_BY_IMPACT,
    ENDED_BY_SPAN,
    ENDED_BY_UPLIFT,
    FREQUENCY,
    JUMP,
    LIFT,
    LIFT_CEILING,
    LIFT_SLOPE,
    LOST_CONTACT,
    OVERTURNED,
    PASSAGE_COLUMNS,
    ROW_ANGLE,
    ROW_COLUMNS,
    ROW_DURATION,
    ROW_EVENT,
    ROW_HALF_CYCLES,
    ROW_PHASE,
    ROW_SEGMENT,
    ROW_SIDE,
    ROW_VELOCITY,
    SLOPE,
    March,
    free_side,
)
from rocksteady.kernels.core.tuples import Kept, Tables, Until
from rocksteady.kernels.march.march import march
from tests.every import every
from tests.kernels.scattering import draws, scattered
from tests.kernels.tables import (
    NONE,
    Piece,
    both_sides,
    exact_segments,
    harmonic,
    run,
    sampled,
    sampled_pieces,
    signs_hold,
    table,
)
from tests.kernels.walls import against_wall, in_model, integrated_bounces
from tests.oracles import exact_march, first_zero_in_double, mp
from tests.records import synthetic
from tests.strategies import sample_size

Floats = NDArray[np.float64]
Generator = np.random.Generator

MOST_GROWN = 30.0
"""Growth of a small difference up to which an impact is compared: see below."""


def test_the_sign_of_the_restitution_names_the_free_side() -> None:
    assert free_side(both_sides(1.0)) == free_side(both_sides(5e-324)) == 0
    for restitution in (1.0, 0.5, 0.0, -0.0):
        assert free_side(against_wall(restitution)) == 1
        assert free_side(against_wall(restitution, free=-1)) == -1


# ------------------------------------------------------------------------------ an integrator


def harmonic_pieces(rng: Generator) -> list[Piece]:
    amplitude, frequency, phase = rng.uniform((0.8, 2.0, 0.0), (3.0, 8.0, 6.2)).tolist()
    return [Piece(amplitude=amplitude, frequency=frequency, phase=phase)]


def pulse_pieces(rng: Generator) -> list[Piece]:
    amplitude, frequency, phase = rng.uniform((0.8, 1.5, 0.0), (3.0, 5.0, 6.2)).tolist()
    constant, slope, jump = rng.uniform(-0.6, 0.6, 3).tolist()
    return [
        Piece(float(rng.uniform(1.0, 4.0)), 0.1, -0.1, amplitude, frequency, phase),
        Piece(float(rng.uniform(1.0, 2.0)), constant, slope, jump=jump),
        Piece(),
    ]


def record_pieces(rng: Generator) -> list[Piece]:
    return sampled_pieces(synthetic(rng, 60, 0.1, float(rng.uniform(1.0, 3.0))), 0.1)


def segments_of(pieces: list[Piece]) -> Floats:
    """Return the table; of samples one that knows that they are alike."""
    if len(pieces) < 10:
        return table(*pieces)
    values = [piece.constant for piece in pieces[:-1]]
    last = pieces[-2]
    return sampled(np.array([*values, last.base(last.duration)]), last.duration)


@every("alpha", [0.0, 0.3])
@every("drawn", [harmonic_pieces, pulse_pieces, record_pieces])
def test_flights_and_impacts_are_those_of_an_integrator(
    drawn: Callable[[Generator], list[Piece]], alpha: float
) -> None:
    # The integrator is run twice, the second time with a velocity at the start that differs by a
    # part of 1e-7.  An impact counts while that difference has grown to no more than 30 times its
    # size: the integrator's own error, 1e-11 or less, has then grown to less than 1e-9.
    compared = 0
    for seed in range(sample_size(6, 1)):
        rng = np.random.default_rng(seed)
        pieces = drawn(rng)
        restitution, velocity = rng.uniform((0.2, 0.1), (1.0, 0.5)).tolist()
        lean, rate = rng.uniform((0.8, 0.8), (1.5, 1.3)).tolist()
        truth, beside = (
            integrated_bounces(
                pieces,
                9.0,
                velocity=start,
                restitution=restitution,
                lean=lean,
                rate=rate,
                alpha=alpha,
            )
            for start in (velocity, velocity * (1.0 + 1e-7))
        )
        segments, sides = in_model(
            segments_of(pieces), against_wall(restitution, lean, rate), alpha
        )
        ran = run(
            segments, sides, side=1, velocity=velocity, until=9.0, rest_velocity=0.0, limit=3000
        )
        assert signs_hold(ran.rows)
        assert np.all(ran.rows[:, ROW_SIDE] >= 0.0)
        found = ran.impacts()
        for k, (at, after) in enumerate(truth):
            if k >= len(beside):
                break
            grown = max(abs(beside[k][0] - at), abs(beside[k][1] - after))
            if grown > MOST_GROWN * velocity * 1e-7:
                break
            time, side, speed = found[k]
            assert side == 1
            assert float(time) == pytest.approx(at, abs=1e-9)
            assert speed == pytest.approx(after, abs=1e-9)
            compared += 1
    assert compared > sample_size(15, 2)


def test_no_impact_is_missed_by_a_slow_search_through_every_flight() -> None:
    checked = 0
    for seed in range(sample_size(60, 4)):
        rng = np.random.default_rng(seed)
        segments = harmonic(float(rng.uniform(0.5, 6.0)), 10.0 ** float(rng.uniform(-0.3, 1.3)))
        if seed % 2:
            segments = sampled(synthetic(rng, 300, 0.1, 3.0), 0.1)
        sides = against_wall(float(rng.uniform(0.1, 1.0)))
        ran = run(segments, sides, rest_velocity=math.inf, until=60.0, limit=400)
        for row in ran.rows:
            if row[ROW_SIDE] == 0.0 or row[ROW_EVENT] not in (ENDED_BY_IMPACT, ENDED_BY_SPAN):
                continue
            if row[ROW_ANGLE] == 0.0 and row[ROW_VELOCITY] < 1e-6:
                continue  # the slow search knows no lift-off, and no bounces as short
            index, half, phase = int(row[ROW_SEGMENT]), int(row[ROW_HALF_CYCLES]), row[ROW_PHASE]
            frequency = float(segments[index, FREQUENCY])
            forcing = side_forcing(segments, index, sides, 1, 0.0 if frequency else float(phase))
            seen, _ = side_phase(half, float(phase), 1, frequency)
            struck = row[ROW_EVENT] == ENDED_BY_IMPACT
            span = float(row[ROW_DURATION])
            truth, closest = first_zero_in_double(
                forcing.constant,
                forcing.slope,
                float(segments[index, AMPLITUDE]),
                frequency,
                float(row[ROW_ANGLE]),
                float(row[ROW_VELOCITY]),
                seen,
                2.0 * span + 1.0 if struck else span,
                1.0,
            )
            if closest < 1e-9:
                continue  # a graze that rounding decides
            checked += 1
            if struck:
                assert truth == pytest.approx(span, rel=1e-7, abs=1e-9)
            else:
                assert truth >= span * (1.0 - 1e-12)
    assert checked > sample_size(2000, 50)


# ------------------------------------------------------------------------------- closed forms


@every("velocity", [0.05, 0.5, 0.95])
def test_without_loss_a_block_on_a_still_base_bounces_for_ever_as_fast(velocity: float) -> None:
    # y = v sinh t + 1 - cosh t is 0 again at tanh(t/2) = v.
    count = sample_size(500, 60)
    ran = run(table(Piece()), against_wall(1.0), side=1, velocity=velocity, limit=count)
    assert ran.end.impacts == count
    np.testing.assert_allclose(ran.rows[:, ROW_DURATION], 2.0 * math.atanh(velocity), rtol=2e-12)
    np.testing.assert_allclose(ran.rows[:, ROW_VELOCITY], velocity, rtol=2e-12)
    assert np.all(ran.rows[:, ROW_SIDE] == 1.0)


@every("velocity", [0.05, 0.5, 0.9])
def test_so_does_a_nonlinear_one_whose_flights_last_as_energy_says(velocity: float) -> None:
    alpha, count = 0.4, sample_size(300, 20)
    segments, sides = in_model(table(Piece()), against_wall(1.0), alpha)
    ran = run(segments, sides, side=1, velocity=velocity, limit=count)
    assert ran.end.impacts == count
    np.testing.assert_allclose(ran.rows[:, ROW_VELOCITY], velocity, rtol=1e-11)
    # v'^2 = v^2 - 2 (cos(alpha (1 - y)) - cos alpha)/alpha^2; with y = Y - x^2 there is no pole.
    v, a = mp.mpf(velocity), mp.mpf(alpha)
    top = 1 - mp.acos(mp.cos(a) + a * a * v * v / 2) / a

    def slowness(x: mp.mpf) -> mp.mpf:
        y = top - x * x
        gained = 2 * (mp.cos(a * (1 - top)) - mp.cos(a * (1 - y))) / (a * a)
        return 2 * x / mp.sqrt(gained)

    with mp.workdps(30):
        lasts = 2 * mp.quad(slowness, [mp.mpf(10) ** -14, mp.sqrt(top)])
    np.testing.assert_allclose(ran.rows[:, ROW_DURATION], float(lasts), rtol=1e-11)


@every("alpha", [0.0, 0.3])
@every("zero", [0.0, -0.0])
def test_off_a_wall_that_does_not_throw_it_back_it_rests_and_lifts_at_the_node(
    zero: float, alpha: float
) -> None:
    amplitude, frequency, lean = 1.5, 4.0, 0.8
    segments, sides = in_model(harmonic(amplitude, frequency), against_wall(zero, lean), alpha)
    sides[0, 0] = zero
    ran = run(segments, sides, side=1, velocity=0.02, half_cycles=sample_size(40, 8))
    rows = ran.rows
    struck = np.flatnonzero(rows[:-1, ROW_EVENT] == ENDED_BY_IMPACT)
    assert len(struck) > 3
    assert np.all(rows[struck + 1, ROW_SIDE] == 0.0)
    lifted = np.flatnonzero(rows[:-1, ROW_EVENT] == ENDED_BY_UPLIFT) + 1
    assert len(lifted) > 2
    uplift = lean * (math.tan(alpha) / alpha if alpha else 1.0)
    for row in rows[lifted]:
        assert (row[ROW_SIDE], row[ROW_ANGLE], row[ROW_VELOCITY]) == (1.0, 0.0, 0.0)
        assert row[ROW_HALF_CYCLES] % 2 == 0
        assert row[ROW_PHASE] == pytest.approx(math.asin(uplift / amplitude), rel=4e-16)


def test_off_it_while_the_base_pushes_outwards_it_lifts_at_once() -> None:
    # Slow shaking: the block, thrown up early, lands where the base is above uplift.
    ran = run(harmonic(1.2, 0.2, 1.2), against_wall(0.0), side=1, velocity=-0.0, limit=3)
    assert ran.rows[0, ROW_SIDE] == 1.0
    pushed = run(table(Piece(constant=1.5)), against_wall(0.0), side=1, angle=0.1, velocity=-2.0)
    assert pushed.status == OVERTURNED
    first, second = pushed.rows
    assert first[ROW_EVENT] == ENDED_BY_IMPACT
    assert (second[ROW_ANGLE], second[ROW_VELOCITY]) == (0.0, 0.0)
    assert second[ROW_PHASE] == pytest.approx(float(first[ROW_DURATION]), rel=1e-15)


@pytest.mark.parametrize("alpha", [0.0, 0.25])
def test_however_hard_the_base_pushes_into_the_wall_a_block_at_rest_stays(alpha: float) -> None:
    pieces = [Piece(1.0, constant=-9.0), Piece(1.0, constant=-2.0, slope=-3.0, jump=-0.7), Piece()]
    segments, sides = in_model(table(*pieces), against_wall(0.5), alpha)
    ran = run(segments, sides, until=5.0)
    assert (ran.status, ran.end.impacts) == (AT_REST, 0)
    assert np.all(ran.rows[:, ROW_SIDE] == 0.0)
    values = np.array([0.0, *[-8.0] * 30, 0.0])
    segments, sides = in_model(sampled(values, 0.05), against_wall(0.5), alpha)
    ran = run(segments, sides, until=5.0)
    assert (ran.status, ran.end.impacts) == (AT_REST, 0)
    segments[:, [CONSTANT, SLOPE]] *= -1.0
    assert run(segments, sides, until=5.0).status == OVERTURNED


@pytest.mark.parametrize("alpha", [0.0, 0.25])
def test_an_impulse_throws_a_block_at_rest_off_the_wall_and_one_in_flight_at_it(
    alpha: float,
) -> None:
    thrown = [Piece(1.0), Piece(0.05, jump=0.3), Piece(jump=-0.9)]
    segments, sides = in_model(table(*thrown), against_wall(0.5, rate=1.2), alpha)
    ran = run(segments, sides, until=60.0, limit=3)
    share = 1.2**2 * math.cos(alpha)
    assert ran.rows[1, ROW_VELOCITY] == pytest.approx(0.3 * share, rel=1e-15)
    # Thrown back before it has risen far, it strikes the wall about as fast.
    assert ran.rows[2, ROW_VELOCITY] == pytest.approx(-0.6 * share, rel=0.15)
    assert ran.rows[2, ROW_EVENT] == ENDED_BY_IMPACT
    assert 0.25 * share < ran.end.velocity < 0.4 * share


@every("alpha", [0.0, 0.25])
@every("free", [1, -1])
@every("restitution", [0.5, 0.0])
def test_an_impulse_at_the_instant_of_lift_off_strikes_the_wall(
    restitution: float, free: int, alpha: float
) -> None:
    # It has lifted at the very end of a segment, at whose end the base turns against it.
    jump = -0.7 * free
    segments, sides = in_model(
        table(Piece(1.0), Piece(0.5, jump=jump), Piece()),
        against_wall(restitution, free=free),
        alpha,
    )
    start, rows = March(free, 0.0, 0.2 * free, 0, 0, 1.0, 0, 0), np.zeros((2, ROW_COLUMNS))
    _, end = march(Tables(segments, sides), start, Until(0, 9.0, math.inf, 2), Kept(rows, NONE))
    struck = 0.7 * math.cos(alpha) - 0.2
    assert end.impacts >= 1
    assert rows[1, ROW_SIDE] == (free if restitution else 0)
    assert rows[1, ROW_VELOCITY] == pytest.approx(free * restitution * struck, rel=1e-15)
    wide = scattered(sides, 0.1, 5)
    _, again = march(Tables(segments, wide), start, Until(0, 9.0, math.inf, 2), Kept(rows, NONE))
    drawn = float(draws(restitution, 0.1, 5, 1))
    assert rows[1, ROW_VELOCITY] == pytest.approx(free * drawn * struck, rel=1e-12)
    assert again.impacts >= 1


@pytest.mark.parametrize("angle", [0.0, 0.2])
def test_where_the_base_falls_away_contact_is_lost_as_without_a_wall(angle: float) -> None:
    ends = []
    for sides in (against_wall(0.5), both_sides(0.5)):
        segments, own = in_model(table(Piece(1.0), Piece()), sides, 0.3)
        segments[0, LIFT], segments[0, LIFT_SLOPE], segments[0, LIFT_CEILING] = 0.0, -1.25, 1.25
        start = March(1 if angle else 0, angle, 0.4 if angle else 0.0, 0, 0, 0.0, 0, 0)
        none = np.zeros((0, ROW_COLUMNS))
        ends.append(
            march(Tables(segments, own), start, Until(0, 9.0, math.inf, 100), Kept(none, NONE))
        )
    assert ends[0] == ends[1]
    code, state = ends[0]
    assert code == LOST_CONTACT
    assert state.phase == pytest.approx(0.8, rel=1e-14)


# ----------------------------------------------------------------------------------- the wall


@pytest.mark.slow
def test_chatter_is_never_ended_while_bounces_in_many_digits_go_on_at_uplift() -> None:
    rests = alive = 0
    for seed in range(sample_size(8, 3)):
        rng = np.random.default_rng(seed)
        amplitude, frequency = float(rng.uniform(1.05, 2.5)), float(rng.uniform(1.5, 8.0))
        # High up, the bounces outlast the time that the base leaves them, and do not rest.
        restitution = float(rng.uniform(0.3, 0.95))
        piece = Piece(amplitude=amplitude, frequency=frequency, phase=2.0)
        start = float(rng.uniform(0.02, 0.1))
        ran = run(table(piece), against_wall(restitution), side=1, velocity=start, half_cycles=3)
        node = (math.asin(1.0 / amplitude) + 2.0 * math.pi - 2.0) / frequency
        exact = exact_march(
            exact_segments(piece),
            node,
            side=1,
            velocity=start,
            restitution=(-mp.mpf(restitution), mp.mpf(1)),
            lean=(mp.mpf(1), mp.inf),
            most_impacts=1500,
        )
        assert len(exact.impacts) < 1500
        still = abs(exact.impacts[-1].velocity) < mp.mpf(10) ** -29
        times = ran.times()
        rested = [
            i
            for i, row in enumerate(ran.rows)
            if row[ROW_SIDE] == 0.0 and times[i] < node * (1.0 - 1e-12)
        ]
        for (at, side, after), truth in zip(ran.impacts(), exact.impacts, strict=False):
            if abs(truth.velocity) < 1e-9 or at > node or after == 0.0:  # proved to come to rest
                break
            assert side == truth.side == 1
            assert abs(at - truth.time) <= 1e-11
            assert after == pytest.approx(float(truth.velocity), rel=1e-6)
        if rested:
            assert still, seed
            assert exact.impacts[-1].time < times[rested[0]] + mp.mpf(
                float(ran.rows[rested[0], ROW_DURATION])
            )
            rests += 1
        alive += not still
    assert rests > sample_size(3, 0)
    assert alive > sample_size(1, -1)


def test_a_march_that_settles_lifts_where_one_that_bounces_on_does() -> None:
    settled = 0
    for seed in range(sample_size(300, 12)):
        rng = np.random.default_rng(seed)
        alpha = 0.0 if seed % 2 else 0.3
        segments, sides = in_model(
            harmonic(float(rng.uniform(1.1, 4.0)), 10.0 ** float(rng.uniform(-0.3, 1.2)), 0.1),
            against_wall(float(rng.uniform(0.05, 0.9))),
            alpha,
        )
        proved, bounced = (
            run(segments, sides, half_cycles=8, rest_velocity=slow, limit=20_000)
            for slow in (math.inf, 0.0)
        )
        lifts, late = (
            [
                tuple(ran.rows[i + 1, [ROW_HALF_CYCLES, ROW_PHASE]])
                for i in range(len(ran.rows) - 1)
                if ran.rows[i, ROW_EVENT] == ENDED_BY_UPLIFT
            ]
            for ran in (proved, bounced)
        )
        assert lifts[:2] == late[:2]
        assert proved.end.impacts <= bounced.end.impacts
        settled += len(lifts) > 1
    assert settled > sample_size(40, 0)


# ----------------------------------------------------------------------------- mirror images


@every("alpha", [0.0, 0.35])
@every("seed", range(sample_size(6, 2)))
def test_a_wall_on_the_other_side_gives_the_mirror_image_to_the_last_bit(
    seed: int, alpha: float
) -> None:
    rng = np.random.default_rng(seed)
    restitution = float(rng.uniform(0.0, 1.0)) if seed else 0.0
    lean, rate = rng.uniform(0.8, 1.3, 2).tolist()
    here, there = (against_wall(restitution, lean, rate, free=free) for free in (1, -1))
    values = synthetic(rng, 300, 0.05, 3.0)
    swing = harmonic(float(rng.uniform(1.1, 3.0)), float(rng.uniform(2.0, 7.0)))
    pulse = table(*pulse_pieces(rng))
    compared = 0
    for segments in (sampled(values, 0.05), pulse, swing):
        turned = segments.copy()
        turned[:, [CONSTANT, SLOPE, JUMP]] *= -1.0
        shift = 0
        if segments is pulse:  # a sinusoid is reversed by half a period
            turned[0, AMPLITUDE] = segments[0, AMPLITUDE] = 0.0
            turned[0, FREQUENCY] = segments[0, FREQUENCY] = 0.0
        elif segments is swing:
            shift = 1
        outcomes = []
        for flat, sides, side, half in ((segments, here, 1, 0), (turned, there, -1, shift)):
            own = in_model(flat, sides, alpha)
            start = March(side, 0.0, side * 0.2, 0, half, 0.0, 0, 0)
            stop = (half + 30, 0.0) if segments is swing else (0, 30.0)
            limits = Tables(*own), start, Until(*stop, 1e-8, 2000)
            peaks = np.zeros(PASSAGE_COLUMNS)
            _, end = march(*limits, Kept(np.zeros((0, ROW_COLUMNS)), NONE))
            rows = np.zeros((end.flights, ROW_COLUMNS))
            status, end = march(*limits, Kept(rows, peaks))
            outcomes.append((status, end, rows, peaks))
        one, other = outcomes
        expected = one[2].copy()
        expected[:, [ROW_SIDE, ROW_ANGLE, ROW_VELOCITY]] *= -1.0
        expected[:, ROW_HALF_CYCLES] += shift
        assert other[0] == one[0]
        assert (other[1].side, other[1].angle, other[1].impacts) == (
            -one[1].side,
            -one[1].angle,
            one[1].impacts,
        )
        assert np.array_equal(other[2], expected)
        assert np.array_equal(other[3][:2], one[3][:2])
        compared += len(expected)
    assert compared > 20


@every("alpha", [0.0, 0.3])
@every("phase", [0.3, 1.2, 2.9])
def test_a_march_interrupted_within_a_flight_goes_on_as_if_it_had_not_been(
    phase: float, alpha: float
) -> None:
    segments, sides = in_model(harmonic(2.0, 4.0), against_wall(0.5), alpha)
    none, start = np.zeros((0, ROW_COLUMNS)), March(1, 0.0, 0.3, 0, 0, 0.4, 0, 0)
    code, whole = march(
        Tables(segments, sides), start, Until(14, 0.0, math.inf, 5000), Kept(none, NONE)
    )
    _, halfway = march(
        Tables(segments, sides), start, Until(3, phase, math.inf, 5000), Kept(none, NONE)
    )
    assert halfway.angle > 1e-3
    assert halfway.impacts > 0
    again, end = march(
        Tables(segments, sides), halfway, Until(14, 0.0, math.inf, 5000), Kept(none, NONE)
    )
    assert (again, end.side, end.impacts) == (code, whole.side, whole.impacts)
    assert end.impacts > halfway.impacts
    np.testing.assert_allclose(end[1:3], whole[1:3], rtol=1e-9)
