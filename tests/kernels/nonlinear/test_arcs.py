"""Arcs of the nonlinear model against SciPy's DOP853, differences, and the linear limit."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from rocksteady.kernels.core.forcing import make_forcing
from rocksteady.kernels.linear.arcs import Arc, make_arc
from rocksteady.kernels.nonlinear import _pieces as piece
from rocksteady.kernels.nonlinear.arcs import (
    nonlinear_arc,
    nonlinear_extrema,
    pieces_of,
    seed,
    seed_series,
)
from rocksteady.kernels.nonlinear.drive import Drive
from rocksteady.kernels.nonlinear.series import make_work
from tests.every import every
from tests.strategies import inner_sample_size

CASES = (  # alpha, amplitude, frequency, first phase, duration
    (0.2, 2.0, 2.0, 1.0, 1.5),
    (0.4, 3.0, 3.0, 2.0, 0.7),
    (0.3, 1.5, 5.0, 0.3, 3.0),
    (0.5, 2.0, 2.0, 1.0, -0.4),
    (0.1, 2.0, 2.0, 1.0, -2.3),
    (0.1, 2.0, 2.0, 1.0, 1e-6),
    (0.6, 6.0, 8.0, 0.5, 0.5),
    (0.05, 0.0, 2.0, 0.5, 1.0),
)


def drive_of(alpha: float, amplitude: float, frequency: float) -> Drive:
    return Drive(alpha, 0.0, 0.0, amplitude, frequency, 0.0, 0.0)


def arc_of(alpha: float, amplitude: float, frequency: float, first: float, last: float) -> Arc:
    duration = (last - first) / frequency
    return nonlinear_arc(drive_of(alpha, amplitude, frequency), duration, first, last, None)


def flown(
    alpha: float, amplitude: float, frequency: float, first: float, duration: float, speed: float
) -> np.ndarray:
    """Return angles and speeds at many times, by the equation of motion (1)."""

    def slopes(time: float, y: np.ndarray) -> list[float]:
        tilt = alpha * (1.0 - y[0])
        base = amplitude * math.sin(first + frequency * time)
        return [y[1], base * math.cos(tilt) - math.sin(tilt) / alpha]

    times = np.linspace(0.0, duration, 2001)
    run = solve_ivp(slopes, (0.0, duration), [0.0, speed], "DOP853", times, rtol=1e-13, atol=1e-17)
    return np.asarray(run.y)


@every("case", CASES)
def test_a_flight_from_the_start_of_an_arc_ends_on_the_floor_at_its_speed(
    case: tuple[float, ...],
) -> None:
    alpha, amplitude, frequency, first, duration = case
    arc = arc_of(alpha, amplitude, frequency, first, first + frequency * duration)
    y = flown(alpha, amplitude, frequency, first, duration, arc.start)
    size = abs(arc.start) + abs(arc.landing)
    assert abs(y[0, -1]) < 1e-12 * size
    assert -y[1, -1] == pytest.approx(arc.landing, abs=1e-12 * size + 1e-16)


@pytest.mark.slow
@every("case", CASES)
def test_each_derivative_of_an_arc_is_its_difference(case: tuple[float, ...]) -> None:
    alpha, amplitude, frequency, first, duration = case
    place = np.array([max(amplitude, 1e-3), frequency, first, first + frequency * duration])
    arc = arc_of(alpha, *place)
    exact = {
        2: (arc.start_by_first, arc.landing_by_first),
        3: (arc.start_by_last, arc.landing_by_last),
        0: (arc.start_by_amplitude, arc.landing_by_amplitude),
        1: (arc.start_by_frequency, arc.landing_by_frequency),
    }
    for index, derivatives in exact.items():
        shift = np.zeros(4)
        shift[index] = 1e-4
        # Of fourth order: -f(2h) + 8 f(h) - 8 f(-h) + f(-2h) over 12 h.
        at = {k: arc_of(alpha, *(place + k * shift)) for k in (-2, -1, 1, 2)}
        for end in ("start", "landing"):
            value = {k: getattr(each, end) for k, each in at.items()}
            slope = (8.0 * (value[1] - value[-1]) - (value[2] - value[-2])) / (12.0 * 1e-4)
            found = derivatives[0 if end == "start" else 1]
            assert slope == pytest.approx(found, abs=3e-11), (index, end)


def test_an_arc_without_duration_is_the_limit_of_short_ones() -> None:
    still = arc_of(0.3, 2.0, 3.0, 1.2, 1.2)
    for duration in (1e-9, -1e-9):
        near = arc_of(0.3, 2.0, 3.0, 1.2, 1.2 + 3.0 * duration)
        np.testing.assert_allclose(near, still, atol=1e-8)
    assert still.start == still.landing == 0.0


def test_the_speeds_of_short_arcs_keep_their_digits() -> None:
    # For T to 0 they are -rT/2 each, up to terms of higher order: the ratio of two is that of T.
    first, frequency = 1.0, 2.0
    for duration in (1e-5, 1e-8, 1e-11, 1e-14):
        drive = drive_of(0.3, 2.0, frequency)
        whole = nonlinear_arc(drive, duration, first, first + frequency * duration, None)
        half = nonlinear_arc(drive, 0.5 * duration, first, first + 0.5 * frequency * duration, None)
        assert whole.start / half.start == pytest.approx(2.0, abs=4.0 * duration + 1e-15)
        assert whole.landing / half.landing == pytest.approx(2.0, abs=4.0 * duration + 1e-15)


def test_slender_arcs_are_the_linear_ones_to_the_square_of_the_slenderness() -> None:
    rng = np.random.default_rng(26)
    for _ in range(inner_sample_size(40, plain=4)):
        amplitude, frequency = rng.uniform(0.2, 4.0), rng.uniform(0.5, 8.0)
        first, duration = rng.uniform(0.0, 6.0), rng.uniform(-0.5, 4.0)
        last = first + frequency * duration
        straight = np.array(
            make_arc(make_forcing(-1.0, 0.0, amplitude, frequency), duration, first, last)
        )
        apart = [
            np.abs(np.array(arc_of(alpha, amplitude, frequency, first, last)) - straight).max()
            for alpha in (0.02, 0.01)
        ]
        assert apart[0] / apart[1] == pytest.approx(4.0, rel=0.02)


def test_long_arcs_are_as_exact_as_short_ones() -> None:
    # A flight from the start loses e^T of its digits; the two halves of it do not.
    alpha, amplitude, frequency, first, duration = 0.25, 1.4, 0.7, 0.4, 30.0
    last = first + frequency * duration
    arc = arc_of(alpha, amplitude, frequency, first, last)
    # In the middle it stays near the bounded motion about the upright position, whatever its ends.
    early = flown(alpha, amplitude, frequency, first, 8.0, arc.start)
    backwards = flown(alpha, amplitude, -frequency, last, 8.0, arc.landing)
    assert np.abs(early[0]).max() < 3.0
    assert np.abs(backwards[0]).max() < 3.0
    longer = arc_of(alpha, amplitude, frequency, first, last + 2.0 * math.pi)
    assert longer.start == pytest.approx(arc.start, abs=1e-11)
    assert abs(arc.start_by_last) < 1e-11


@every("case", [case for case in CASES if case[4] > 1e-3 and case[1] > 0.0])
def test_extrema_of_an_arc_are_those_of_a_dense_flight(case: tuple[float, ...]) -> None:
    alpha, amplitude, frequency, first, duration = case
    arc = arc_of(alpha, amplitude, frequency, first, first + frequency * duration)
    angles, speeds = flown(alpha, amplitude, frequency, first, duration, arc.start)
    drive = drive_of(alpha, amplitude, frequency)
    highest, lowest, when = nonlinear_extrema(
        drive, duration, first, first + frequency * duration, None
    )
    turns = np.flatnonzero(np.diff(np.signbit(speeds)))
    dips = [k for k in turns if speeds[k] < 0.0]
    assert (highest == -math.inf) == (len(turns) == 0)
    assert highest == pytest.approx(max(angles[turns].max(), angles[turns + 1].max()), abs=1e-5)
    assert math.isfinite(lowest) == bool(dips)
    if dips:
        least = min(dips, key=lambda k: angles[k])
        assert lowest == pytest.approx(angles[least], abs=1e-5)
        assert when == pytest.approx(duration * least / 2000, abs=duration / 1000)


def test_what_is_no_arc_is_not_a_number() -> None:
    drive = drive_of(0.3, 2.0, 3.0)
    for duration in (math.inf, math.nan, 1e9):
        assert all(map(math.isnan, nonlinear_arc(drive, duration, 1.0, 2.0, None)))
    assert math.isnan(nonlinear_extrema(drive, -1.0, 1.0, 0.0, None)[0])


@pytest.mark.slow
@every("alpha", [0.0, 0.4])
@every("duration", [1.3, -0.7, 6.0])
@every("side", [1.0, -1.0])
def test_an_arc_under_a_series(alpha: float, duration: float, side: float) -> None:
    amplitude, frequency, first = 2.1, 1.9, 0.7
    last = first + frequency * duration
    shares = np.array([0.5, 0.1, 0.2, -0.3])

    def arc(drawn: np.ndarray, series: np.ndarray) -> np.ndarray:
        begin, end, size, turn = drawn
        drive = Drive(alpha, 0.0, 0.0, size, turn, 0.0, 0.0, side)
        return np.array(nonlinear_arc(drive, (end - begin) / turn, begin, end, series))

    # Of one sinusoid: what the other side sees of minus it is what this one sees of it.
    alone = arc(np.array([first, last, amplitude, frequency]), np.array([side, 0.0]))
    forcing = make_forcing(-1.0, 0.0, amplitude, frequency)
    drive = Drive(alpha, 0.0, 0.0, amplitude, frequency, 0.0, 0.0)
    plain = (
        nonlinear_arc(drive, duration, first, last, None)
        if alpha > 0.0
        else make_arc(forcing, duration, first, last)
    )
    assert alone == pytest.approx(np.array(plain), abs=1e-13)
    # Derivatives by both phases, amplitude and frequency.
    place = np.array([first, last, amplitude, frequency])
    here = arc(place, shares)
    for which, columns in enumerate(((2, 4), (3, 5), (6, 7), (8, 9))):
        step = 1e-5 * np.eye(4)[which]
        slope = (arc(place + step, shares) - arc(place - step, shares)) / 2e-5
        assert here[list(columns)] == pytest.approx(slope[:2], abs=2e-9)


@every(("shares", "turned"), [((1.0, 0.0), 0.0), ((0.0, 1.0), 0.5 * math.pi)])
@every("case", [case for case in CASES if case[-1] > 0.0])
def test_a_series_of_one_wave_begins_at_the_arc_of_the_sinusoid(
    shares: tuple[float, float], turned: float, case: tuple[float, ...]
) -> None:
    alpha, amplitude, frequency, first, duration = case
    last = first + frequency * duration
    plain, summed = (np.zeros((pieces_of(duration) + 1, piece.PIECE_COLUMNS)) for _ in range(2))
    drive = drive_of(alpha, amplitude, frequency)
    seed(drive, duration, first + turned, last + turned, plain)
    work = make_work(np.array(shares))
    seed_series(drive._replace(series=1.0), duration, first, last, summed, work)
    for column in (piece.TIME, piece.ANGLE_THERE, piece.SPEED_THERE):
        size = np.abs(plain[:, column]).max()
        np.testing.assert_allclose(summed[:, column], plain[:, column], atol=1e-12 * size)
