"""The march against 50 digits, against integrated differential equations, and against itself."""

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import brentq

from rocksteady.kernels.march import (
    AT_REST,
    ENDED_BY_IMPACT,
    ENDED_BY_NO_RETURN,
    ENDED_BY_SPAN,
    ENDED_BY_UPLIFT,
    OVERTURNED,
    ROCKING,
    ROW_ANGLE,
    ROW_DURATION,
    ROW_EVENT,
    ROW_HALF_CYCLES,
    ROW_PHASE,
    ROW_SIDE,
    ROW_VELOCITY,
    UNDECIDED,
    March,
    clock,
    march,
)
from rocksteady.kernels.symmetric import symmetric_orbit, symmetry_breaking
from tests.kernels.tables import (
    Piece,
    Run,
    both_sides,
    exact_segments,
    harmonic,
    march_to,
    run,
    signs_hold,
    table,
)
from tests.oracles import ExactImpact, exact_march, integrated_impacts, mp
from tests.strategies import sample_size

TWO_PI = 2.0 * math.pi


# ---------------------------------------------------------------------------------- 50 digits

# Amplitude, frequency ratio, restitution, phase, velocity: all settle on periodic motion.
PERIODIC = [
    (2.0, 4.0, 0.8, 0.0, 0.3),
    (2.0, 6.0, 0.8, 1.78, 0.64),  # order 3
    (3.0, 8.0, 0.95, 2.88, 0.86),  # order 3
    (2.0, 1.9, 0.8, 2.8822, 1.2615),  # unsymmetric
    (2.0, 1.85, 0.8, 2.8843, 1.2831),  # unsymmetric, and above 1 for a while
    (0.109, 0.7, 0.9, 2.35, 0.96),
    (0.48, 1.0, 0.6, 1.89, 0.74),
    (6.0, 40.0, 0.7, 0.5, 0.1),
    (4.0, 300.0, 0.9, 3.0, 0.01),
    (0.6, 3.0, 0.85, 2.5, 0.2),  # never enough to lift a block at rest
]


def exact_harmonic(
    amplitude: float,
    frequency: float,
    restitution: float,
    phase: float,
    velocity: float,
    half_cycles: int,
) -> list[ExactImpact]:
    return exact_march(
        exact_segments(Piece(amplitude=amplitude, frequency=frequency, phase=phase)),
        half_cycles * mp.pi / mp.mpf(frequency),
        side=1,
        velocity=velocity,
        restitution=(mp.mpf(restitution),) * 2,
    ).impacts


def compare(ran: Run, exact: list[ExactImpact]) -> None:
    found = ran.impacts()
    assert len(found) == len(exact)
    assert len(found) > 5
    for (time, side, velocity), truth in zip(found, exact, strict=True):
        assert side == truth.side
        assert abs(time - truth.time) <= 1e-13 * truth.time
        assert abs(velocity - truth.velocity) <= 1e-12 * abs(truth.velocity)


@pytest.mark.parametrize("case", PERIODIC, ids=str)
def test_impacts_lie_where_fifty_digits_put_them(
    case: tuple[float, float, float, float, float],
) -> None:
    amplitude, frequency, restitution, phase, velocity = case
    cycles = sample_size(40, 12)
    ran = run(
        harmonic(amplitude, frequency, phase),
        both_sides(restitution),
        side=1,
        velocity=velocity,
        half_cycles=2 * cycles,
        rest_velocity=0.0,
    )
    assert ran.status == ROCKING
    compare(ran, exact_harmonic(*case, half_cycles=2 * cycles))


@pytest.mark.parametrize("case", sample_size(PERIODIC[:4], PERIODIC[1:2]), ids=str)
def test_the_phase_is_right_to_1e_14_after_200_cycles(
    case: tuple[float, float, float, float, float],
) -> None:
    amplitude, frequency, restitution, phase, velocity = case
    exact = exact_harmonic(*case, half_cycles=400)
    end = march_to(
        harmonic(amplitude, frequency, phase), both_sides(restitution), len(exact), velocity
    )
    truth = phase + mp.mpf(frequency) * exact[-1].time
    assert abs(end.half_cycles * mp.pi + mp.mpf(end.phase) - truth) <= 1e-14
    assert abs(end.velocity - exact[-1].velocity) <= 1e-13 * abs(end.velocity)


# From rest: uplift, bounces that die out in infinitely many impacts, uplift again.
FROM_REST = [(1.2, 3.0, 0.4), (2.0, 4.0, 0.3), (1.5, 6.0, 0.5), (3.0, 50.0, 0.2), (1.05, 2.0, 0.6)]


@pytest.mark.parametrize("case", FROM_REST, ids=str)
def test_from_rest_the_march_follows_fifty_digits_through_chatter(
    case: tuple[float, float, float],
) -> None:
    amplitude, frequency, restitution = case
    piece = Piece(amplitude=amplitude, frequency=frequency, phase=0.25)
    half_cycles = 9
    ran = run(table(piece), both_sides(restitution), half_cycles=half_cycles)
    exact = exact_march(
        exact_segments(piece),
        half_cycles * mp.pi / mp.mpf(frequency),
        restitution=(mp.mpf(restitution),) * 2,
    )
    rests = int((ran.rows[:, ROW_SIDE] == 0.0).sum())
    assert rests > 0
    assert signs_hold(ran.rows)
    # The first uplift, before which the block stands still.
    times = ran.times()
    lifted = [times[i + 1] for i, row in enumerate(ran.rows) if row[ROW_EVENT] == ENDED_BY_UPLIFT]
    assert abs(lifted[0] - exact.uplifts[0]) <= 1e-15 * lifted[0]
    # Between uplifts: the same impacts, as long as the march has not yet said that it ends.
    edges = [*exact.uplifts, mp.mpf(1000)]
    for begin, end in pairwise(edges):
        found = [case for case in ran.impacts() if begin < case[0] <= end]
        truth = [impact for impact in exact.impacts if begin < impact.time <= end]
        assert 0 < len(found) <= len(truth)
        for (time, side, velocity), impact in zip(found, truth, strict=False):
            assert side == impact.side
            assert abs(time - impact.time) <= 1e-13 * impact.time
            if velocity != 0.0:
                assert abs(velocity - impact.velocity) <= 1e-11 * abs(impact.velocity) + 1e-15
    for one, other in zip(lifted, exact.uplifts, strict=False):
        assert abs(one - other) <= 1e-14 * other


def test_a_random_list_of_segments_follows_fifty_digits() -> None:
    rng = np.random.default_rng(7)
    compared = 0
    for _ in range(sample_size(40, 10)):
        pieces = []
        for _ in range(rng.integers(2, 6)):
            wave = rng.random() < 0.6
            pieces.append(
                Piece(
                    duration=rng.uniform(0.1, 1.5),
                    constant=rng.uniform(-1.0, 1.0) if rng.random() < 0.6 else 0.0,
                    slope=rng.normal(0.0, 1.0) if rng.random() < 0.5 else 0.0,
                    amplitude=rng.uniform(0.2, 3.0) if wave else 0.0,
                    frequency=10.0 ** rng.uniform(-0.5, 1.3) if wave else 0.0,
                    phase=rng.uniform(-10.0, 10.0) if wave else 0.0,
                    jump=rng.normal(0.0, 0.1) if rng.random() < 0.3 else 0.0,
                )
            )
        pieces[0] = Piece(**{**vars(pieces[0]), "jump": 0.0})
        until = sum(piece.duration for piece in pieces)
        restitution = rng.uniform(0.5, 0.95)
        velocity = rng.choice([-1.0, 1.0]) * rng.uniform(0.1, 0.5)
        side = 1 if velocity > 0 else -1
        ran = run(
            table(*pieces),
            both_sides(restitution),
            side=side,
            velocity=velocity,
            until=until,
            rest_velocity=0.0,
            limit=40,
        )
        exact = exact_march(
            exact_segments(*pieces),
            until,
            side=side,
            velocity=velocity,
            restitution=(mp.mpf(restitution),) * 2,
            most_impacts=ran.end.impacts,
        )
        assert signs_hold(ran.rows)
        found = ran.impacts()
        assert len(exact.impacts) >= len(found)
        for (time, at, after), truth in zip(found, exact.impacts, strict=False):
            assert at == truth.side
            # Rounded durations of earlier segments shift all that follows.
            assert abs(time - truth.time) <= 2e-13 * (1 + truth.time) * (1 + 1 / abs(after))
            compared += 1
    assert compared > sample_size(100, 20)


# -------------------------------------------------------------------- published: free rocking


@pytest.mark.parametrize("angle", [0.1, 0.37, 0.5, 0.9, 0.999])
def test_a_quarter_of_free_rocking_lasts_as_housner_says(angle: float) -> None:
    ran = run(table(Piece()), both_sides(0.7), side=1, angle=angle)
    # H1: T/4 = acosh(1/(1 - angle)) in pivot time.
    truth = mp.acosh(1 / (1 - mp.mpf(angle)))
    assert abs(ran.rows[0, ROW_DURATION] - truth) <= 2e-15 * truth / (1 - angle)


@pytest.mark.parametrize(
    ("angle", "seconds"), [(0.1, 0.1722212971), (0.5, 0.4855195874), (0.9, 1.1035040108)]
)
def test_quarter_periods_of_a_block_of_one_metre(angle: float, seconds: float) -> None:
    p = math.sqrt(0.75 * 9.81)
    ran = run(table(Piece()), both_sides(0.7), side=1, angle=angle)
    assert ran.rows[0, ROW_DURATION] / p == pytest.approx(seconds, abs=6e-11)


@pytest.mark.parametrize(
    ("ratio", "angle", "peaks"),
    [
        (0.7, 1.0 - 1e-9, (0.4523, 0.2859, 0.1894, 0.1283, 0.0879)),
        (1.0 - 1.5 * math.sin(0.2) ** 2, 0.8, (0.612305, 0.502064, 0.421766)),
    ],
)
def test_free_rocking_dies_out_as_housner_says(
    ratio: float, angle: float, peaks: tuple[float, ...]
) -> None:
    # H3; in the second case `ratio` is a ratio of velocities, of which Housner's r is the square.
    restitution = math.sqrt(ratio) if angle > 0.9 else ratio
    energy = restitution**2
    sides = both_sides(restitution)
    ran = run(table(Piece()), sides, side=1, angle=angle, rest_velocity=0.0, limit=9)
    for n, peak in enumerate(peaks, start=1):
        rest = mp.mpf(energy) ** n * (1 - (1 - mp.mpf(angle)) ** 2)
        assert 1 - mp.sqrt(1 - rest) == pytest.approx(peak, abs=6e-5 if angle > 0.9 else 6e-7)
        row = ran.rows[n]
        assert abs(row[ROW_VELOCITY]) == pytest.approx(math.sqrt(rest), rel=1e-13)
        assert row[ROW_DURATION] == pytest.approx(float(2 * mp.atanh(mp.sqrt(rest))), rel=1e-13)
        assert row[ROW_SIDE] == (-1.0) ** n


def test_half_periods_of_free_rocking() -> None:
    e, p = 1.0 - 1.5 * math.sin(0.2) ** 2, math.sqrt(0.75 * 9.81)
    ran = run(table(Piece()), both_sides(e), side=1, angle=0.8, rest_velocity=0.0, limit=5)
    for row, seconds in zip(ran.rows[1:4], (1.180321, 0.974559, 0.843764), strict=True):
        assert row[ROW_DURATION] / p == pytest.approx(seconds, abs=6e-7)


# -------------------------------------------------------------------------- published: pulses


def topples(*pieces: Piece, restitution: float = 0.9) -> bool:
    ran = run(table(*pieces, Piece()), both_sides(restitution), limit=100_000)
    # At the threshold itself it is balanced for ever, at the critical angle.
    assert ran.status in {AT_REST, OVERTURNED} or abs(ran.end.angle) == pytest.approx(1.0)
    return ran.status == OVERTURNED


def threshold(low: float, high: float, falls: object) -> float:
    """Return where the block begins to fall (or ceases to), by bisection."""
    assert callable(falls)
    first = falls(low)
    assert falls(high) is not first
    for _ in range(70):
        middle = 0.5 * (low + high)
        if not low < middle < high:
            break
        low, high = (middle, high) if falls(middle) is first else (low, middle)
    return high


@pytest.mark.parametrize(
    ("amplitude", "printed"),
    [(1.2, 1.7917595), (1.5, 1.0986123), (2.0, 0.6931472), (3.0, 0.4054651), (1.07, None)],
)
def test_how_long_a_rectangular_pulse_must_last(amplitude: float, printed: float | None) -> None:
    # H4: p t1 = ln(A/(A - 1)).
    truth = math.log(amplitude / (amplitude - 1.0))
    found = threshold(
        0.5 * truth, 1.5 * truth, lambda lasts: topples(Piece(lasts, constant=amplitude))
    )
    assert found == pytest.approx(truth, rel=1e-14)
    if printed is not None:
        assert found == pytest.approx(printed, abs=6e-8)


HALF_SINE = {1: 1.322397, 2: 1.800724, 3: 2.293872, 4: 2.790798, 5: 3.289147, 6: 3.788155}


@pytest.mark.parametrize("w", [0.3, 1, 1.7, 2, 3, 4, 5, 6, 11.0])
def test_the_least_half_sine_pulse_that_topples(w: float) -> None:
    # H7: w sin psi - cos psi = exp(-(pi - psi)/w), A = 1/sin psi.
    psi = brentq(
        lambda f: w * math.sin(f) - math.cos(f) - math.exp(-(math.pi - f) / w),
        1e-9,
        0.5 * math.pi,
        xtol=1e-16,
        rtol=1e-15,
    )
    truth = 1.0 / math.sin(psi)
    found = threshold(
        1.0 + 0.9 * (truth - 1.0),
        1.0 + 1.1 * (truth - 1.0),
        lambda a: topples(Piece(math.pi / w, amplitude=a, frequency=w)),
    )
    assert found == pytest.approx(truth, rel=1e-13)
    if w in HALF_SINE:
        assert found == pytest.approx(HALF_SINE[int(w)], abs=6e-7)


ONE_SINE = {1: 1.418316, 2: 2.349903, 3: 3.631150, 4: 5.238964, 5: 7.168129, 6: 9.416966}


@pytest.mark.parametrize("w", [0.5, 1, 2, 2.6, 3, 4, 5, 6])
def test_the_one_sine_pulse_that_topples_without_an_impact(w: float) -> None:
    # Z1: w sin psi - cos psi = -exp(-(2 pi - psi)/w).
    psi = brentq(
        lambda f: w * math.sin(f) - math.cos(f) + math.exp(-(TWO_PI - f) / w),
        1e-9,
        0.5 * math.pi,
        xtol=1e-16,
        rtol=1e-15,
    )
    truth = 1.0 / math.sin(psi)

    def falls_at_once(amplitude: float) -> bool:
        segments = table(Piece(TWO_PI / w, amplitude=amplitude, frequency=w), Piece())
        ran = run(segments, both_sides(0.9), limit=100_000)
        return ran.status == OVERTURNED and ran.end.impacts == 0

    assert threshold(0.99 * truth, 1.01 * truth, falls_at_once) == pytest.approx(truth, rel=1e-13)
    if w in ONE_SINE:
        assert truth == pytest.approx(ONE_SINE[int(w)], abs=8e-7)  # 1.4183153 at w = 1


def test_the_window_in_which_a_one_sine_pulse_topples_after_an_impact() -> None:
    # Z2: topples between the first two and above the third.
    def falls(amplitude: float) -> bool:
        return topples(Piece(TWO_PI / 5.0, amplitude=amplitude, frequency=5.0))

    assert threshold(2.9, 3.2, falls) == pytest.approx(3.018600, abs=6e-7)
    assert threshold(6.1, 6.5, falls) == pytest.approx(6.318071, abs=6e-7)
    assert threshold(7.0, 7.4, falls) == pytest.approx(7.168129, abs=6e-7)


@pytest.mark.parametrize(
    ("w", "low", "high"),
    [(2.0, 1.225179, 2.314403), (3.0, 1.403565, 3.484663), (4.0, 1.795442, 4.850111)],
)
def test_the_windows_of_one_sine_pulses(w: float, low: float, high: float) -> None:
    def falls_later(amplitude: float) -> bool:
        segments = table(Piece(TWO_PI / w, amplitude=amplitude, frequency=w), Piece())
        ran = run(segments, both_sides(0.9), limit=100_000)
        return ran.status == OVERTURNED and ran.end.impacts > 0

    # Z3
    assert threshold(0.99 * low, 1.01 * low, falls_later) == pytest.approx(low, abs=6e-7)
    assert threshold(0.99 * high, 1.01 * high, falls_later) == pytest.approx(high, abs=6e-7)


@pytest.mark.parametrize(
    ("pieces", "printed"),
    [
        (lambda a: [Piece(1.0, amplitude=a, frequency=math.pi)], 2.36409069),
        (lambda a: [Piece(2.0, amplitude=a, frequency=0.5 * math.pi)], 1.59204939),
        (
            lambda a: [
                Piece(1.0, 0.5 * a, amplitude=0.5 * a, frequency=TWO_PI, phase=-0.5 * math.pi)
            ],
            2.84992425,
        ),
        (
            lambda a: [
                Piece(2.0, 0.5 * a, amplitude=0.5 * a, frequency=math.pi, phase=-0.5 * math.pi)
            ],
            1.83885220,
        ),
        (lambda a: [Piece(0.5, slope=2.0 * a), Piece(0.5, a, -2.0 * a)], 2.97259),
        (lambda a: [Piece(1.0, slope=a), Piece(1.0, a, -a)], 1.96032),
        (lambda a: [Piece(1.0, a)], 1.58197671),
    ],
    ids=["half-sine 1", "half-sine 2", "versed 1", "versed 2", "triangle 1", "triangle 2", "box"],
)
def test_single_pulses_topple_where_the_integral_says(pieces: object, printed: float) -> None:
    # G1
    assert callable(pieces)
    found = threshold(0.98 * printed, 1.02 * printed, lambda a: topples(*pieces(a)))
    assert found == pytest.approx(printed, abs=6e-6 if printed in {2.97259, 1.96032} else 6e-9)


# ------------------------------------------------------------------ unlike sides: an ODE oracle

LOPSIDED = [
    ((0.7, 0.9), (1.0, 0.6), (1.0, 1.0)),
    ((0.5, 0.8), (1.0, 1.1), (0.9, 1.4)),
    ((0.9, 0.6), (0.8, 1.3), (1.2, 0.9)),
]


@pytest.mark.parametrize(("restitution", "lean", "rate"), LOPSIDED)
@pytest.mark.parametrize("side", [1, -1])
def test_unlike_sides_against_an_integrator(
    side: int,
    restitution: tuple[float, float],
    lean: tuple[float, float],
    rate: tuple[float, float],
) -> None:
    for piece in (
        Piece(amplitude=1.6, frequency=5.0, phase=0.5),
        Piece(8.0, constant=0.1, slope=-0.05, amplitude=1.2, frequency=4.0, phase=2.0),
    ):
        truth = integrated_impacts(
            piece.base,
            6.0,
            side=side,
            velocity=0.3 * side,
            restitution=restitution,
            lean=lean,
            rate=rate,
            longest_step=0.05,
        )
        until = 6.0 if math.isinf(piece.duration) else 8.0
        ran = run(
            table(piece),
            both_sides(restitution, lean, rate),
            side=side,
            velocity=0.3 * side,
            until=until,
            rest_velocity=0.0,
            limit=len(truth) + 1,
        )
        found = ran.impacts()
        assert len(truth) > 1
        for (time, _, velocity), (at, after) in zip(found[: len(truth)], truth, strict=True):
            if abs(after) < 1e-3:  # from here on the integrator loses the short bounces
                break
            assert float(time) == pytest.approx(at, abs=2e-9)
            assert velocity == pytest.approx(after, abs=2e-8)


@pytest.mark.parametrize(("restitution", "lean", "rate"), LOPSIDED)
def test_unlike_sides_against_fifty_digits(
    restitution: tuple[float, float], lean: tuple[float, float], rate: tuple[float, float]
) -> None:
    piece = Piece(amplitude=1.6, frequency=5.0, phase=0.5)
    ran = run(
        table(piece),
        both_sides(restitution, lean, rate),
        side=-1,
        velocity=-0.3,
        half_cycles=12,
        rest_velocity=0.0,
        limit=30,
    )
    exact = exact_march(
        exact_segments(piece),
        12 * mp.pi / 5,
        side=-1,
        velocity=-0.3,
        restitution=(mp.mpf(restitution[0]), mp.mpf(restitution[1])),
        lean=(mp.mpf(lean[0]), mp.mpf(lean[1])),
        rate=(mp.mpf(rate[0]), mp.mpf(rate[1])),
        most_impacts=ran.end.impacts,
    )
    found = ran.impacts()
    assert len(found) > 1
    for (time, side, _), truth in zip(found, exact.impacts, strict=False):
        assert side == truth.side
        assert abs(time - truth.time) <= 1e-13 * truth.time


@pytest.mark.parametrize("start", ["flight", "rest"])
def test_a_block_told_in_other_units_moves_the_same(start: str) -> None:
    # Twice the reference slenderness and 1.5 times the reference p on both sides.
    side, velocity = (1, 0.3) if start == "flight" else (0, 0.0)
    limits = {"half_cycles": 60}
    plain = run(harmonic(2.0, 4.0, 0.5), both_sides(0.6), side=side, velocity=velocity, **limits)
    scaled = run(
        harmonic(4.0, 6.0, 0.5),
        both_sides(0.6, (2.0, 2.0), (1.5, 1.5)),
        side=side,
        velocity=3.0 * velocity,
        **limits,
    )
    assert scaled.status == plain.status
    assert np.array_equal(scaled.rows[:, ROW_SIDE], plain.rows[:, ROW_SIDE])
    assert np.array_equal(scaled.rows[:, ROW_EVENT], plain.rows[:, ROW_EVENT])
    for one, other in zip(scaled.phases(), plain.phases(), strict=True):
        assert abs(one - other) <= 1e-13 * (1 + other)
    assert np.allclose(
        scaled.rows[:, ROW_VELOCITY], 3.0 * plain.rows[:, ROW_VELOCITY], rtol=1e-11, atol=1e-16
    )
    assert np.allclose(
        scaled.rows[:, ROW_DURATION], plain.rows[:, ROW_DURATION] / 1.5, rtol=1e-11, atol=1e-16
    )


# ------------------------------------------------------------------------------- invariants

MIRRORS = [
    (2.0, 4.0, 0.8, 0.3),
    (6.0, 1.5, 0.9, 0.1),
    (1.0, 2.0, 0.5, 0.2),
    (3.0, 900.0, 0.7, 1e-3),
]


@pytest.mark.parametrize(("amplitude", "frequency", "restitution", "velocity"), MIRRORS)
@pytest.mark.parametrize("phase", [0.0, 0.7, 2.9])
def test_the_mirrored_march_is_the_same_to_the_last_bit(
    amplitude: float, frequency: float, restitution: float, velocity: float, phase: float
) -> None:
    segments, sides = harmonic(amplitude, frequency), both_sides(restitution)
    for side in (1, 0):
        rows = []
        for mirror in (1, -1):
            start = March(
                mirror * side,
                mirror * side * 0.05,
                mirror * side * velocity,
                0,
                0 if mirror > 0 else 1,
                phase,
                0,
                0,
            )
            stop = 200 if mirror > 0 else 201
            none = np.zeros((0, 8))
            status, end = march(segments, sides, start, stop, phase, math.inf, 5000, none)
            record = np.zeros((end.flights, 8))
            march(segments, sides, start, stop, phase, math.inf, 5000, record)
            rows.append(record)
            assert status in {ROCKING, AT_REST, OVERTURNED}
        one, other = rows
        assert len(one) > 0
        for column, factor in (
            (ROW_PHASE, 1.0),
            (ROW_SIDE, -1.0),
            (ROW_ANGLE, -1.0),
            (ROW_VELOCITY, -1.0),
            (ROW_DURATION, 1.0),
            (ROW_EVENT, 1.0),
        ):
            assert np.array_equal(one[:, column], factor * other[:, column])
        assert np.array_equal(one[:, ROW_HALF_CYCLES] + 1.0, other[:, ROW_HALF_CYCLES])


@pytest.mark.parametrize("record", ["flight", "rest"])
@pytest.mark.parametrize("cut", [0.4321, 1.7, 2.718281828, 9.9])
def test_to_cut_a_segment_in_two_changes_nothing(record: str, cut: float) -> None:
    side, velocity = (1, 0.3) if record == "flight" else (0, 0.0)
    for amplitude, frequency, restitution in ((2.0, 4.0, 0.8), (1.3, 2.0, 0.4), (0.9, 7.0, 0.7)):
        sides = both_sides(restitution)
        whole = harmonic(amplitude, frequency, 0.6)
        first = Piece(cut, 0.0, 0.0, amplitude, frequency, 0.6)
        rest = Piece(math.inf, 0.0, 0.0, amplitude, frequency, 0.6 + frequency * cut)
        cycles = 25
        until = cycles * TWO_PI / frequency
        one = run(whole, sides, side=side, velocity=velocity, until=until)
        two = run(table(first, rest), sides, side=side, velocity=velocity, until=until)
        assert two.status == one.status
        assert two.end.side == one.end.side
        strong = [
            [case for case in ran.impacts() if abs(case[2]) > 1e-6 and case[0] < 0.999 * until]
            for ran in (one, two)
        ]
        assert len(strong[0]) == len(strong[1])
        for (time, before, after), (at, other, later) in zip(*strong, strict=True):
            assert before == other
            assert abs(time - at) <= 1e-13 * (1 + time) / min(1.0, abs(after))
            assert after == pytest.approx(later, rel=1e-9)


@pytest.mark.parametrize("offset", [-1e-9, -1e-15, 0.0, 1e-15, 1e-9])
@pytest.mark.parametrize("event", ["impact", "uplift"])
def test_a_cut_at_an_impact_or_at_uplift_changes_nothing(event: str, offset: float) -> None:
    amplitude, frequency = 2.0, 4.0
    side, velocity = (1, 0.3) if event == "impact" else (0, 0.0)
    sides, whole = both_sides(0.8), harmonic(amplitude, frequency, 0.1)
    one = run(whole, sides, side=side, velocity=velocity, half_cycles=40)
    at = one.rows[0, ROW_DURATION] * (1.0 + offset)
    two = run(
        table(
            Piece(at, 0.0, 0.0, amplitude, frequency, 0.1),
            Piece(math.inf, 0.0, 0.0, amplitude, frequency, 0.1 + frequency * at),
        ),
        sides,
        side=side,
        velocity=velocity,
        until=40 * math.pi / frequency,
    )
    assert signs_hold(two.rows)
    assert two.status == one.status
    # An impact at the cut may fall on either side of it, but it happens once.
    assert two.end.impacts == one.end.impacts
    assert two.end.angle == pytest.approx(one.end.angle, abs=1e-9)
    assert two.end.velocity == pytest.approx(one.end.velocity, abs=1e-9)


def lifts(ran: Run) -> list[tuple[float, float]]:
    """Return time and side of each start from rest."""
    times, found = ran.times(), []
    for i in range(1, len(ran.rows)):
        row, before = ran.rows[i], ran.rows[i - 1]
        still = row[ROW_SIDE] != 0.0 and row[ROW_ANGLE] == 0.0 and row[ROW_VELOCITY] == 0.0
        if still and before[ROW_SIDE] == 0.0:
            found.append((float(times[i]), float(row[ROW_SIDE])))
    return found


def test_cuts_within_rounding_of_any_event_change_nothing() -> None:
    # A flight of some 1e-17 may be rounded into the floor: it must neither fall through it nor be
    # said to overturn there.
    rng = np.random.default_rng(17)
    compared = 0
    for _ in range(sample_size(2500, 60)):
        amplitude = rng.choice([rng.uniform(1.0, 1.01), rng.uniform(1.0, 6.0)])
        frequency, phase = 10.0 ** rng.uniform(-1.0, 2.5), rng.uniform(0.0, 3.1)
        sides = both_sides(float(rng.uniform(0.1, 0.95)))
        side = int(rng.integers(-1, 2))
        velocity = side * rng.uniform(0.01, 0.5)
        whole = harmonic(amplitude, frequency, phase)
        limit = sample_size(3000, 300)
        one = run(whole, sides, side=side, velocity=velocity, half_cycles=12, limit=limit)
        if len(one.rows) < 2:
            continue
        event = float(one.times()[int(rng.integers(1, min(len(one.rows), 6)))])
        at = event * (1.0 + rng.choice([-1.0, 0.0, 1.0]) * 10.0 ** rng.uniform(-19.0, -12.0))
        if at <= 0.0:
            continue
        cut = table(
            Piece(at, 0.0, 0.0, amplitude, frequency, phase),
            Piece(math.inf, 0.0, 0.0, amplitude, frequency, phase + frequency * at),
        )
        until = 12 * math.pi / frequency
        two = run(cut, sides, side=side, velocity=velocity, until=until, limit=limit)
        assert signs_hold(two.rows), (amplitude, frequency, phase, at)
        # The impacts before the first weak one, from which on either may have come to rest.
        for (time, before, after), (other, same, speed) in list(
            zip(one.impacts(), two.impacts(), strict=False)
        )[:4]:
            if min(abs(after), abs(speed)) < 1e-3:
                break
            assert before == same
            assert abs(time - other) <= 1e-9 * (1 + time) / abs(after)
            compared += 1
        for lift, again in list(zip(lifts(one), lifts(two), strict=False))[:1]:
            if again[0] != pytest.approx(at, rel=1e-9):
                assert again == pytest.approx(lift, rel=1e-9)
    assert compared > sample_size(1000, 20)


def test_a_jump_that_meets_an_impact_decides_the_side() -> None:
    # The block lies on its base as the impulse comes: where the sum of velocities points, it goes.
    first = run(table(Piece()), both_sides(0.5), side=1, velocity=0.3, limit=1)
    lands = float(first.rows[0, ROW_DURATION])
    for offset in (0.0, 1e-16, -1e-16):
        pieces = Piece(lands * (1.0 + offset)), Piece(jump=0.8)
        ran = run(table(*pieces), both_sides(0.5), side=1, velocity=0.3, limit=100_000)
        assert signs_hold(ran.rows)
        assert ran.status == AT_REST


def test_a_run_that_ends_on_an_impact_counts_it_once_at_most() -> None:
    rng = np.random.default_rng(3)
    ends = set()
    for _ in range(sample_size(1500, 40)):
        amplitude, frequency = rng.uniform(1.0, 4.0), rng.uniform(3.0, 12.0)
        restitution = rng.uniform(0.6, 0.99)
        orbit = symmetric_orbit(amplitude, frequency, restitution, 1, 1)
        if not (orbit.velocity > 0.0 and abs(orbit.trace) < 0.99 * (1.0 + restitution**2)):
            continue
        cycles = int(rng.integers(0, 12))
        ran = run(
            harmonic(amplitude, frequency, orbit.phase),
            both_sides(restitution),
            side=1,
            velocity=frequency * orbit.velocity,
            half_cycles=2 * cycles,
        )
        assert ran.status == ROCKING
        ends.add((ran.end.impacts - 2 * cycles, ran.end.side))
    assert ends <= {(0, 1), (-1, -1)}


# ------------------------------------------------------------------------------------ no drift


@pytest.mark.parametrize(
    ("frequency", "restitution", "order", "share"),
    [
        (0.5, 0.9, 1, 0.5),
        (1.5, 0.8, 1, 0.4),
        (4.0, 0.8, 1, 0.5),
        (6.0, 0.8, 3, 0.6),
        (40.0, 0.9, 1, 0.02),
        (500.0, 0.7, 1, 0.01),
    ],
)
def test_a_million_cycles_do_not_drift(
    frequency: float, restitution: float, order: int, share: float
) -> None:
    d = (1.0 - restitution) / (1.0 + restitution)
    h = math.tanh(order * math.pi / (2.0 * frequency))
    least = (1.0 + frequency**2) * d * h * h / math.hypot(1.0, d * h * frequency)
    most = symmetry_breaking(frequency, restitution, order)
    amplitude = least + share * (most - least)
    orbit = symmetric_orbit(amplitude, frequency, restitution, order, 1)
    half, phase = clock(orbit.phase)
    impacts = sample_size(2_000_000, 200)
    end = march_to(
        harmonic(amplitude, frequency, phase),
        both_sides(restitution),
        impacts,
        frequency * orbit.velocity,
    )
    assert half == 0
    assert end.impacts == impacts
    assert end.half_cycles == impacts * order
    assert end.phase == pytest.approx(phase, abs=2e-13)
    assert end.velocity == pytest.approx(frequency * orbit.velocity, rel=1e-12)


# ---------------------------------------------------------------------------- rest and extremes


@given(
    amplitude=st.floats(0.0, 1.0),
    frequency=st.floats(0.05, 1000.0),
    restitution=st.floats(1e-6, 1.0),
    phase=st.floats(0.0, 3.14),
)
def test_a_block_at_rest_stays_where_the_base_cannot_lift_it(
    amplitude: float, frequency: float, restitution: float, phase: float
) -> None:
    ran = run(harmonic(amplitude, frequency, phase), both_sides(restitution), half_cycles=200)
    assert ran.status == AT_REST
    assert ran.end.impacts == 0
    assert ran.end.flights == 1


@given(
    amplitude=st.floats(1.0, 12.0, exclude_min=True),
    frequency=st.floats(0.05, 1000.0),
    phase=st.floats(0.0, 3.14),
)
def test_uplift_happens_at_the_node_itself(
    amplitude: float, frequency: float, phase: float
) -> None:
    ran = run(harmonic(amplitude, frequency, phase), both_sides(0.5), half_cycles=4, limit=2)
    node = math.atan2(1.0, math.sqrt((amplitude - 1.0) * (amplitude + 1.0)))
    if node <= phase < math.pi - node:
        assert ran.rows[0, ROW_SIDE] == 1.0  # already above: it lifts at once
        assert ran.rows[0, ROW_PHASE] == phase
        return
    assert ran.rows[0, ROW_EVENT] == ENDED_BY_UPLIFT
    lifted = ran.rows[1]
    assert lifted[ROW_PHASE] == pytest.approx(node, rel=1e-15)
    assert lifted[ROW_HALF_CYCLES] == (0.0 if phase < node else 1.0)
    assert lifted[ROW_SIDE] == (1.0 if phase < node else -1.0)
    assert (lifted[ROW_ANGLE], lifted[ROW_VELOCITY]) == (0.0, 0.0)


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("phase", [0.0, 0.3, 1.0, 2.7, 3.1])
def test_a_side_that_alone_can_lift_waits_for_its_own_node(side: int, phase: float) -> None:
    # The other side is five times as broad: it never lifts, and half of all nodes do nothing.
    lean = (1.0, 5.0) if side > 0 else (5.0, 1.0)
    ran = run(harmonic(2.0, 4.0, phase), both_sides(0.3, lean), half_cycles=4, limit=2)
    node, start = math.asin(0.5), phase if side > 0 else phase - math.pi
    if node <= start < math.pi - node:
        assert ran.rows[0, ROW_SIDE] == side
        return
    ahead = node - start if start < node else node - start + TWO_PI
    assert ran.rows[0, ROW_DURATION] == pytest.approx(ahead / 4.0, rel=1e-14)
    lifted = ran.phases()[1]
    assert float(lifted) == pytest.approx(phase + ahead, rel=1e-14)
    assert ran.rows[1, ROW_SIDE] == side


def test_a_start_exactly_at_uplift_lifts_at_once() -> None:
    node = math.asin(0.5)
    ran = run(harmonic(2.0, 4.0, node), both_sides(0.5), half_cycles=4, limit=1)
    assert (ran.rows[0, ROW_SIDE], ran.rows[0, ROW_PHASE]) == (1.0, node)
    assert ran.rows[0, ROW_EVENT] == ENDED_BY_IMPACT


def test_without_shaking_a_tilted_block_rocks_to_rest() -> None:
    for frequency in (0.0, 3.0):
        ran = run(
            table(Piece(frequency=frequency)), both_sides(0.9), side=-1, angle=-0.9, until=1e6
        )
        assert ran.status == AT_REST
        # Zeno: the whole chatter lasts the sum of its half periods (H3).
        energy, total = 0.81, mp.acosh(1 / (1 - mp.mpf(0.9)))
        for n in range(1, 2000):
            rest = mp.mpf(energy) ** n * (1 - (1 - mp.mpf(0.9)) ** 2)
            total += 2 * mp.atanh(mp.sqrt(rest))
        settled = ran.times()[-1]
        assert settled <= total * (1 + mp.mpf(10) ** -13)
        assert ran.rows[-1, ROW_SIDE] == 0.0


@pytest.mark.parametrize(
    ("angle", "velocity", "status"),
    [
        (1.2, 0.0, OVERTURNED),
        (1.2, -0.21, AT_REST),
        (1.2, -0.19, OVERTURNED),
        (0.9, 0.2, OVERTURNED),
        (0.9, 0.09, AT_REST),
        (-1.2, 0.0, OVERTURNED),
        (-1.2, 0.21, AT_REST),
        (-0.9, -0.2, OVERTURNED),
    ],
)
def test_beyond_the_critical_angle_it_may_come_back(
    angle: float, velocity: float, status: int
) -> None:
    # Free rocking: it falls where |x| + |x'| outwards exceeds 1.
    side = 1 if angle > 0 else -1
    ran = run(table(Piece()), both_sides(0.5), side=side, angle=angle, velocity=velocity)
    assert ran.status == status
    if status == OVERTURNED:
        assert ran.rows[-1, ROW_EVENT] == ENDED_BY_NO_RETURN


@pytest.mark.parametrize("frequency", [0.0, 2.0])
def test_a_block_balanced_exactly_neither_falls_nor_returns(frequency: float) -> None:
    ran = run(table(Piece(frequency=frequency)), both_sides(0.5), side=1, angle=1.0, until=100.0)
    assert ran.status == ROCKING
    assert ran.end.impacts == 0
    assert (ran.end.angle, ran.end.velocity) == (1.0, 0.0)


def test_the_limit_ends_a_march_undecided() -> None:
    ran = run(harmonic(2.0, 4.0), both_sides(0.8), side=1, velocity=0.3, limit=17)
    assert ran.status == UNDECIDED
    assert (ran.end.flights, ran.end.impacts, len(ran.rows)) == (17, 17, 17)


@pytest.mark.parametrize("restitution", [1.0, 0.999999, 1e-3, 1e-6])
@pytest.mark.parametrize("frequency", [0.05, 1.0, 30.0, 1000.0])
@pytest.mark.parametrize("amplitude", [0.9, 1.0, 1.0000001, 3.0, 12.0])
def test_extreme_cases_end_soundly(restitution: float, frequency: float, amplitude: float) -> None:
    for side, velocity in ((0, 0.0), (1, 0.3 / frequency), (-1, -1e-9)):
        ran = run(
            harmonic(amplitude, frequency, 0.3),
            both_sides(restitution),
            side=side,
            velocity=velocity,
            half_cycles=20,
            limit=sample_size(20_000, 500),
        )
        if ran.status == UNDECIDED:
            # Chatter with next to no loss, or none, goes on and on.
            assert restitution > 0.999
        assert signs_hold(ran.rows)
        assert np.all(np.isfinite(ran.rows[:-1]))
        assert np.all(ran.rows[:, ROW_DURATION] >= 0.0)
        ends = set(ran.rows[:-1, ROW_EVENT])
        assert ends <= {float(ENDED_BY_IMPACT), float(ENDED_BY_UPLIFT)}
        assert ran.status != ROCKING or ran.rows[-1, ROW_EVENT] == ENDED_BY_SPAN


def test_a_run_of_no_length_ends_as_it_began() -> None:
    flying = run(harmonic(2.0, 4.0, 1.0), both_sides(0.8), side=1, velocity=0.3, half_cycles=0)
    assert (flying.status, flying.end.impacts, flying.end.velocity) == (ROCKING, 0, 0.3)
    resting = run(harmonic(2.0, 4.0, 1.0), both_sides(0.8), half_cycles=0)
    assert (resting.status, resting.end.impacts, resting.end.side) == (AT_REST, 0, 0)


# -------------------------------------------------------------------------------------- jumps


@pytest.mark.parametrize("jump", [0.2, -0.2, 1.001, -1.001])
def test_an_impulse_sets_a_block_at_rest_in_motion(jump: float) -> None:
    ran = run(table(Piece(0.5), Piece(jump=jump)), both_sides(0.7), limit=100_000)
    # On a still base energy decides: it falls where |x'| > 1.
    assert ran.status == (OVERTURNED if abs(jump) > 1.0 else AT_REST)
    lifted = ran.rows[1]
    assert lifted[ROW_SIDE] == math.copysign(1.0, jump)
    assert lifted[ROW_VELOCITY] == jump
    if abs(jump) < 1.0:
        assert lifted[ROW_DURATION] == pytest.approx(2.0 * math.atanh(abs(jump)), rel=1e-15)


def test_an_impulse_adds_to_the_velocity_in_flight() -> None:
    ran = run(table(Piece(0.3), Piece(jump=-0.25)), both_sides(0.7), side=1, velocity=0.4, limit=2)
    y = 0.4 * math.sinh(0.3) - 2.0 * math.sinh(0.15) ** 2
    v = 0.4 * math.cosh(0.3) - math.sinh(0.3)
    assert ran.rows[1, ROW_ANGLE] == pytest.approx(y, rel=1e-15)
    assert ran.rows[1, ROW_VELOCITY] == pytest.approx(v - 0.25, rel=1e-15)


def test_no_proof_of_falling_is_given_before_the_last_impulse() -> None:
    # It would fall, but an impulse that is still to come throws it back.
    pieces = Piece(5.0), Piece(5.0), Piece(jump=-1000.0)
    ran = run(table(*pieces), both_sides(0.5), side=1, velocity=1.01, limit=100_000)
    assert ran.end.impacts > 0
    ran = run(table(*pieces[:2], Piece()), both_sides(0.5), side=1, velocity=1.01)
    assert (ran.status, ran.end.impacts) == (OVERTURNED, 0)


def test_a_segment_list_overturns_no_later_than_it_must() -> None:
    # sigma x >= 1 + max |a| still to come, with sigma x' >= 0: proved at the end of a segment.
    pieces = [Piece(0.5, constant=2.0 * (-1.0) ** i) for i in range(200)]
    ran = run(table(*pieces, Piece()), both_sides(0.5), side=1, velocity=2.5)
    assert ran.status == OVERTURNED
    angle, velocity = ran.end.angle, ran.end.velocity
    assert angle >= 3.0
    assert velocity >= 0.0
    assert ran.end.flights < 10
