"""Peaks and level crossings against dense sampling and refinement."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import brentq

from rocksteady.kernels.core.forcing import Forcing, make_forcing
from rocksteady.kernels.linear.extrema import flight_peaks, highest_angle, inner_extrema, last_rise
from rocksteady.kernels.linear.flight import Flight, Parts, make_flight
from rocksteady.kernels.linear.zeros import next_zero
from tests.every import every
from tests.strategies import (
    ANGLE,
    PHASE,
    SPAN,
    VELOCITY,
    inner_sample_size,
    random_flights,
)

Floats = NDArray[np.float64]


def made(case: Floats) -> tuple[Flight, Forcing]:
    forcing = make_forcing(*(float(value) for value in case[:4]))
    phase = float(case[PHASE])
    flight = make_flight(
        forcing, float(case[4]), float(case[5]), phase, math.sin(phase), math.cos(phase)
    )
    return flight, forcing


def curves(case: Floats, times: Floats) -> tuple[Floats, Floats]:
    """Angle and velocity at many times, in extended precision."""
    constant, slope, amplitude, w, angle, velocity, phase = (np.longdouble(x) for x in case[:7])
    t = times.astype(np.longdouble)
    beta = amplitude / (1 + w * w)
    a = velocity + slope + beta * w * np.cos(phase)
    b = angle + constant + beta * np.sin(phase)
    y = a * np.sinh(t) + b * np.cosh(t) - constant - slope * t - beta * np.sin(phase + w * t)
    v = a * np.cosh(t) + b * np.sinh(t) - slope - beta * w * np.cos(phase + w * t)
    return y.astype(np.float64), v.astype(np.float64)


def sampled_roots(case: Floats, column: int, level: float) -> tuple[Floats, bool]:
    """Return where angle or velocity passes a level, and whether the samples can tell."""
    span = float(case[SPAN])
    times = np.linspace(0.0, span, int(1000 + 50 * case[3] * span))
    values = curves(case, times)[column] - level
    turns = np.flatnonzero(values[:-1] * values[1:] < 0.0)

    def function(time: float) -> float:
        return float(curves(case, np.array([time]))[column][0] - level)

    roots = [brentq(function, times[i], times[i + 1], xtol=1e-15) for i in turns]
    bends = np.flatnonzero(np.diff(np.sign(np.diff(values))) != 0.0) + 1
    touch = np.abs(values[bends]).min() if len(bends) else math.inf
    between = np.abs(np.diff(values, 2)).max()  # how far a sample may miss a bend, four times over
    least = between + 64 * 2.0**-52 * scale(case)
    return np.array(roots), bool(min(touch, abs(values[0]), abs(values[-1])) > least)


def scale(case: Floats) -> float:
    w, span = float(case[3]), float(case[SPAN])
    beta = float(case[2]) / (1.0 + w * w)
    start = float(np.abs(case[[0, 1, 4, 5]]).sum()) + beta * (1.0 + w)
    return start * math.exp(span) + beta * w * span


def cases(seed: int, count: int) -> Floats:
    flights = random_flights(np.random.default_rng(seed), count)
    flights[:, SPAN] = np.minimum(flights[:, SPAN], 6.0)
    return flights


def check_extrema(seed: int, count: int) -> None:
    counted, several = 0, 0
    for case in cases(seed, count):
        flight, forcing = made(case)
        span = float(case[SPAN])
        roots, sure = sampled_roots(case, 1, 0.0)
        largest, lowest, when, extrema = inner_extrema(flight, forcing, span)
        highest, again = highest_angle(flight, forcing, span)
        assert extrema == again
        blur = 64 * 2.0**-52 * scale(case)
        if sure:
            assert extrema == len(roots), case.tolist()
            counted += 1
            several += len(roots) > 2
            if len(roots):
                truth = curves(case, roots)[0].max()
                assert largest == pytest.approx(truth, abs=blur)
                # Between two neighbouring roots the velocity has one sign, after a minimum a plus.
                middles = 0.5 * (roots + np.append(roots[1:], span))
                dips = roots[curves(case, middles)[1] > 0.0]
                least = curves(case, dips)[0].min(initial=math.inf)
                assert lowest == pytest.approx(least, abs=blur)
                if len(dips):
                    assert curves(case, np.array([when]))[0][0] == pytest.approx(least, abs=blur)
                else:
                    assert math.isnan(when)
            else:
                assert largest == -math.inf
        ends = curves(case, np.array([0.0, span]))[0]
        inside = curves(case, roots)[0].tolist() if len(roots) else []
        truth = max([*ends.tolist(), *inside])
        if sure:
            assert highest == pytest.approx(truth, abs=blur), case.tolist()
        else:
            assert highest >= truth - blur
    assert counted > count // 3
    assert several > count // 30


@pytest.mark.slow
def test_extrema_and_peaks_agree_with_dense_sampling() -> None:
    check_extrema(1, inner_sample_size(1000, 150))


def test_extrema_and_peaks_of_a_few_flights_agree_with_dense_sampling() -> None:
    check_extrema(11, 40)


def check_last_rises(level: float, seed: int, count: int) -> None:
    counted = 0
    for case in cases(seed, count):
        flight, forcing = made(case)
        span = float(case[SPAN])
        roots, sure = sampled_roots(case, 0, level)
        if not sure:
            continue
        rising = [root for root in roots if curves(case, np.array([root]))[1][0] > 0.0]
        found = last_rise(flight, forcing, level, span, False)
        if not rising:
            assert found == -1.0, case.tolist()
            continue
        counted += 1
        steep = curves(case, np.array([rising[-1]]))[1][0]
        blur = 64 * 2.0**-52 * scale(case) / steep
        assert found == pytest.approx(rising[-1], abs=blur + 1e-12), case.tolist()
    assert counted > count // 20


@pytest.mark.slow
@every("level", [0.02, 0.3, 1.0, -0.4])
def test_the_last_rise_through_a_level_agrees_with_dense_sampling(level: float) -> None:
    check_last_rises(level, 2, inner_sample_size(500, 100))


@every("level", [0.02, 1.0, -0.4])
def test_the_last_rise_of_a_few_flights_agrees_with_dense_sampling(level: float) -> None:
    check_last_rises(level, 12, 25)


def test_a_falling_block_rises_through_the_critical_angle_for_the_last_time() -> None:
    # y = 1 - cosh t + 1.05 sinh t on a still base: y = 1 where tanh t = 1/1.05.
    forcing = make_forcing(-1.0, 0.0, 0.0, 0.0)
    flight = make_flight(forcing, 0.0, 1.05, 0.0, 0.0, 1.0)
    found = last_rise(flight, forcing, 1.0, math.inf, True)
    assert found == pytest.approx(math.atanh(1.0 / 1.05), rel=1e-14)
    # Hovering about the level under shaking before it falls: the last of many rises.
    forcing = make_forcing(-1.0, 0.0, 4.0, 5.0)
    hovering = Flight(1.0, 0.0, 0.0, 0.0, 1.0, Parts(1e-9, 0.0, 1e-9, 0.0, 0.0))
    last = last_rise(hovering, forcing, 1.0, math.inf, True)
    beta = 4.0 / 26.0
    later = last + np.linspace(1e-6, 5.0, 20_000)
    assert 1e-9 * math.exp(last) == pytest.approx(beta * math.sin(5.0 * last), rel=1e-6)
    assert np.all(1e-9 * np.exp(later) > beta * np.sin(5.0 * later))
    assert last > 10.0
    # It turns back below: 1 - cosh t + 0.5 sinh t stays under 1 - sqrt(0.75).
    sinking = make_flight(make_forcing(-1.0, 0.0, 0.0, 0.0), 0.0, 0.5, 0.0, 0.0, 1.0)
    assert last_rise(sinking, make_forcing(-1.0, 0.0, 0.0, 0.0), 1.0, 3.0, False) == -1.0


def test_an_inflection_is_no_extremum() -> None:
    # Velocity touches zero from above: v = y' with v = 0 and v' = 0 at the touch.
    forcing = make_forcing(-1.0, 0.0, 3.0, 2.0)
    beta = 0.6
    touch = 1.1
    # Solve for the free part so that velocity and acceleration vanish at phase `touch`.
    pull = -(2.0**2) * beta * math.sin(touch)
    rate = 2.0 * beta * math.cos(touch)
    # y = G e^t + H e^-t + 1 - beta sin: G - H = rate, G + H = pull (at the touch).
    growing, decaying = 0.5 * (rate + pull), 0.5 * (pull - rate)
    back = 0.5
    g, h = growing * math.exp(-back), decaying * math.exp(back)
    phase = touch - 2.0 * back
    angle = g + h + 1.0 - beta * math.sin(phase)
    velocity = g - h - 2.0 * beta * math.cos(phase)
    for nudge, least in ((1e-6, 0), (-1e-6, 2)):
        sign = 1.0 if velocity > 0.0 else -1.0
        flight = make_flight(
            forcing, angle, velocity + sign * nudge, phase, math.sin(phase), math.cos(phase)
        )
        *_, extrema = inner_extrema(flight, forcing, 2.0 * back)
        assert extrema in {least, least + 1}
    flight = make_flight(forcing, angle, velocity, phase, math.sin(phase), math.cos(phase))
    inner_extrema(flight, forcing, 2.0 * back)  # ends


def check_peaks(seed: int, count: int) -> None:
    rng, short = np.random.default_rng(6), 0
    for case in cases(seed, count):
        case[ANGLE] = abs(case[ANGLE])
        if case[ANGLE] == 0.0:
            case[VELOCITY] = abs(case[VELOCITY])
        case[SPAN] *= rng.choice([0.05, 1.0])
        flight, forcing = made(case)
        zero = next_zero(flight, forcing, float(case[SPAN]), False, False, -1.0)
        span = zero.time
        peaks = (zero.angle, zero.velocity)
        angle, speed = flight_peaks(flight, forcing, span, *peaks, 0.0, 0.0)
        times = np.linspace(0.0, span, int(1000 + 50 * case[3] * span))
        y, v = curves(case, times)
        blur = 64 * 2.0**-52 * scale(case)
        for found, dense in ((angle, y), (speed, np.abs(v))):
            between = np.abs(np.diff(dense, 2)).max()
            assert dense.max() - blur <= found <= dense.max() + between + blur
        # What earlier flights have reached is kept, and surpassed where it can be.
        short += span <= 1.0
        for share in (0.9, 1.0 - 1e-9, 1.0, 1.0 + 1e-9, 1.5, 100.0):
            for before in ((share * angle, 0.0), (0.0, share * speed), (share * angle, 1e9)):
                again = flight_peaks(flight, forcing, span, *peaks, *before)
                assert again == (max(angle, before[0]), max(speed, before[1]))
    assert short > count // 3


@pytest.mark.slow
def test_peaks_of_flights_above_the_floor_are_those_of_dense_sampling() -> None:
    check_peaks(5, inner_sample_size(400, 80))


def test_peaks_of_a_few_flights_above_the_floor_are_those_of_dense_sampling() -> None:
    check_peaks(15, 30)
