"""The march against published numbers: free rocking and pulses."""

import math

import pytest
from scipy.optimize import brentq

from rocksteady.kernels.core.tables import AT_REST, OVERTURNED, ROW_DURATION, ROW_SIDE, ROW_VELOCITY
from tests.every import every
from tests.kernels.tables import (
    Piece,
    both_sides,
    run,
    table,
)
from tests.oracles import mp

TWO_PI = 2.0 * math.pi


# -------------------------------------------------------------------- published: free rocking


@every("angle", [0.1, 0.37, 0.5, 0.9, 0.999])
def test_a_quarter_of_free_rocking_lasts_as_housner_says(angle: float) -> None:
    ran = run(table(Piece()), both_sides(0.7), side=1, angle=angle)
    # H1: T/4 = acosh(1/(1 - angle)) in pivot time.
    truth = mp.acosh(1 / (1 - mp.mpf(angle)))
    assert abs(ran.rows[0, ROW_DURATION] - truth) <= 2e-15 * truth / (1 - angle)


@every(("angle", "seconds"), [(0.1, 0.1722212971), (0.5, 0.4855195874), (0.9, 1.1035040108)])
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


@every(
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


@every("w", [0.3, 1, 1.7, 2, 3, 4, 5, 6, 11.0])
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


@every("w", [0.5, 1, 2, 2.6, 3, 4, 5, 6])
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


@every(
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


@every(
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
)
def test_single_pulses_topple_where_the_integral_says(pieces: object, printed: float) -> None:
    # G1
    assert callable(pieces)
    found = threshold(0.98 * printed, 1.02 * printed, lambda a: topples(*pieces(a)))
    assert found == pytest.approx(printed, abs=6e-6 if printed in {2.97259, 1.96032} else 6e-9)
