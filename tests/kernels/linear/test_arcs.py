"""Arcs against their boundary value problem in 50 digits, against flights, and their symmetries."""

import math
from typing import Any

import numpy as np
import pytest

from rocksteady.kernels.core.forcing import make_forcing
from rocksteady.kernels.core.tables import FOUND
from rocksteady.kernels.linear.arcs import (
    Arc,
    arc_flight,
    exponentials,
    make_arc,
    sine_ratio,
    sinh_ratio,
)
from rocksteady.kernels.linear.flight import flight_state, make_flight, wrapped
from rocksteady.kernels.linear.zeros import next_zero
from tests.every import every
from tests.oracles import mp
from tests.strategies import sample_size

STEP = mp.mpf(10) ** -30
"""Of the differences, in phase, amplitude and frequency."""


def arc_between(amplitude: float, frequency: float, first: float, duration: float) -> Arc:
    forcing = make_forcing(-1.0, 0.0, amplitude, frequency)
    return make_arc(forcing, duration, first, wrapped(first + frequency * duration))


def exact_speeds(amplitude: Any, frequency: Any, first: Any, last: Any) -> tuple[Any, Any]:
    """Solve y'' = y - 1 + A sin psi with y = 0 at both phases: speeds leaving and landing."""
    beta = amplitude / (1 + frequency * frequency)
    time = (last - first) / frequency
    if time == 0:
        return mp.mpf(0), mp.mpf(0)
    b = beta * mp.sin(first) - 1
    a = (beta * mp.sin(last) - 1 - b * mp.cosh(time)) / mp.sinh(time)
    start = a - beta * frequency * mp.cos(first)
    end = a * mp.cosh(time) + b * mp.sinh(time) - beta * frequency * mp.cos(last)
    return start, -end


def exact_arc(amplitude: float, frequency: float, first: float, duration: float) -> list[Any]:
    """Return what an arc holds, its derivatives by central differences in 110 digits."""
    here = [mp.mpf(amplitude), mp.mpf(frequency), mp.mpf(first)]
    here.append(here[2] + here[1] * mp.mpf(duration))
    slopes = []
    for index in (2, 3, 0, 1):
        more, less = list(here), list(here)
        more[index] += STEP
        less[index] -= STEP
        pairs = zip(exact_speeds(*more), exact_speeds(*less), strict=True)
        slopes.append([(up - down) / (2 * STEP) for up, down in pairs])
    start, landing = exact_speeds(*here)
    (s0, l0), (s1, l1), (sa, la), (sw, lw) = slopes
    return [start, landing, s0, s1, l0, l1, sa, la, sw, lw]


def far_from(found: Arc, truth: list[Any], frequency: float, amplitude: float) -> float:
    """Return the largest error of an arc, over the sizes of the numbers it is made of."""
    beta = amplitude / (1.0 + frequency**2)
    pull = (1.0 + beta) + beta * frequency
    bend = 1.0 + beta * (1.0 + frequency)
    by_phase = (bend + beta * frequency**2 + pull) / min(1.0, frequency)
    turn = (1.0 + frequency) * bend / frequency
    share = (1.0 + frequency) / (1.0 + frequency**2)
    sizes = [pull] * 2 + [by_phase + beta * frequency] * 4 + [share] * 2 + [turn] * 2
    errors = zip(found, truth, sizes, strict=True)
    return max(abs(float(got - exact)) / size for got, exact, size in errors)


def random_arc(rng: np.random.Generator) -> tuple[float, float, float]:
    frequency = 10.0 ** rng.uniform(math.log10(0.05), 3.0)
    return 10.0 ** rng.uniform(-2.0, 1.3), frequency, rng.uniform(-1.5, 4.7)


def check_arcs(seed: int, count: int) -> None:
    rng = np.random.default_rng(seed)
    for _ in range(count):
        amplitude, frequency, first = random_arc(rng)
        duration = 10.0 ** rng.uniform(-3.0, math.log10(60.0)) * rng.choice([1.0, -1.0])
        found = arc_between(amplitude, frequency, first, duration)
        truth = exact_arc(amplitude, frequency, first, duration)
        # The phase at the end is rounded, and with it what it turns.
        blur = 2.0**-52 * (1.0 + frequency * abs(duration))
        assert far_from(found, truth, frequency, amplitude) <= 1e-13 + 8.0 * blur


@pytest.mark.slow
def test_speeds_and_derivatives_are_those_of_the_boundary_value_problem_in_50_digits() -> None:
    check_arcs(1, sample_size(400, 150))


def test_speeds_and_derivatives_of_a_few_arcs_are_those_of_50_digits() -> None:
    check_arcs(11, 40)


def check_short_arcs(duration: float, count: int) -> None:
    # Speeds are half the duration times the pull on the block: relative to that.
    rng = np.random.default_rng(2)
    for _ in range(count):
        amplitude, frequency, first = random_arc(rng)
        for signed in (duration, -duration):
            found = arc_between(amplitude, frequency, first, signed)
            truth = exact_arc(amplitude, frequency, first, signed)
            size = (1.0 + amplitude) * (1.0 + frequency * duration)
            for got, exact in zip(found[:2], truth[:2], strict=True):
                assert abs(got - exact) <= 1e-15 * size * duration * 8.0
            for got, exact in zip(found[2:6], truth[2:6], strict=True):
                assert abs(got - exact) <= 1e-14 * size / frequency
            for got, exact in zip(found[6:8], truth[6:8], strict=True):
                assert abs(got - exact) <= 1e-14 * size * duration
            for got, exact in zip(found[8:], truth[8:], strict=True):
                assert abs(got - exact) <= 1e-15 * size


@pytest.mark.slow
@every("duration", [1e-4, 1e-6, 1e-9, 1e-12, 1e-15, 1e-30, 0.0])
def test_a_short_arc_keeps_its_digits(duration: float) -> None:
    check_short_arcs(duration, sample_size(60, 30))


@every("duration", [1e-4, 1e-9, 1e-30, 0.0])
def test_a_few_short_arcs_keep_their_digits(duration: float) -> None:
    check_short_arcs(duration, 4)


@pytest.mark.slow
def test_a_long_arc_is_two_ends_that_know_nothing_of_each_other() -> None:
    for duration in (40.0, 200.0, 699.0, 701.0, 5000.0):
        found = arc_between(0.8, 0.3, 1.0, duration)
        with mp.workdps(110 + round(duration)):  # which cancels as many
            truth = exact_arc(0.8, 0.3, 1.0, duration)
        assert far_from(found, truth, 0.3, 0.8) <= 1e-12
        assert all(math.isfinite(each) for each in found)
        assert abs(found.start_by_last) <= 100.0 * math.exp(-duration)


@every("frequency", [0.05, 1.0, 7.0, 1000.0])
def test_nothing_happens_where_the_duration_changes_sign(frequency: float) -> None:
    # The formulae are smooth there: the two sides and the middle lie on one line.
    reach = 1e-6 / max(1.0, frequency)
    before, middle, after = (
        np.array(arc_between(2.0, frequency, 0.7, time)) for time in (-reach, 0.0, reach)
    )
    size = np.maximum(np.abs(middle), 2.0 * (1.0 + frequency))
    assert (np.abs(before + after - 2.0 * middle) <= 1e-9 * size).all()
    assert (np.abs(after - middle) <= 1e-4 * size).all()


def test_an_arc_run_backwards_swaps_its_ends() -> None:
    # y(T - t) solves the equation with the phase pi - psi.
    rng = np.random.default_rng(3)
    for _ in range(sample_size(500, 100)):
        amplitude, frequency, first = random_arc(rng)
        duration = rng.uniform(0.01, 8.0)
        last = first + frequency * duration
        forcing = make_forcing(-1.0, 0.0, amplitude, frequency)
        here = make_arc(forcing, duration, first, last)
        back = make_arc(forcing, duration, math.pi - last, math.pi - first)
        size = (1.0 + amplitude) * (1.0 + frequency * duration)
        assert back.start == pytest.approx(here.landing, abs=1e-14 * size)
        assert back.landing == pytest.approx(here.start, abs=1e-14 * size)
        assert back.start_by_first == pytest.approx(-here.landing_by_last, abs=1e-13 * size)
        assert back.landing_by_first == pytest.approx(-here.start_by_last, abs=1e-13 * size)


def test_the_flow_keeps_area() -> None:
    # start dstart dpsi0 = landing dlanding dpsi1, so that the mixed derivatives hang together.
    rng = np.random.default_rng(4)
    for _ in range(sample_size(500, 100)):
        amplitude, frequency, first = random_arc(rng)
        arc = arc_between(amplitude, frequency, first, rng.uniform(0.01, 8.0))
        left, right = arc.start * arc.start_by_last, -arc.landing * arc.landing_by_first
        assert left == pytest.approx(right, rel=1e-12, abs=1e-300)


def test_a_flight_with_the_speed_of_an_arc_lands_where_the_arc_does() -> None:
    rng, checked = np.random.default_rng(5), 0
    while checked < sample_size(500, 60):
        frequency = 10.0 ** rng.uniform(math.log10(0.05), 2.0)
        amplitude, first = 10.0 ** rng.uniform(-1.0, 1.0), wrapped(rng.uniform(0.0, 6.28))
        duration = rng.uniform(0.05, 4.0)
        arc = arc_between(amplitude, frequency, first, duration)
        if arc.start < 0.05 or arc.landing < 0.05:
            continue
        forcing = make_forcing(-1.0, 0.0, amplitude, frequency)
        flight = make_flight(forcing, 0.0, arc.start, first, math.sin(first), math.cos(first))
        zero = next_zero(flight, forcing, 2.0 * duration, False, False, -1.0)
        assert zero.event == FOUND
        if zero.time < duration - 1e-6:  # it meets the base before, and is no motion
            continue
        checked += 1
        steep = (1.0 + amplitude) * (1.0 + frequency * duration) * math.exp(duration)
        assert zero.time == pytest.approx(duration, abs=1e-14 * steep / arc.landing)
        assert -zero.velocity == pytest.approx(arc.landing, abs=1e-13 * steep / arc.landing)


def test_an_arc_as_a_flight_ends_at_the_base_however_long() -> None:
    rng = np.random.default_rng(6)
    for _ in range(sample_size(500, 100)):
        amplitude, frequency, first = random_arc(rng)
        duration = 10.0 ** rng.uniform(-2.0, math.log10(690.0))
        forcing = make_forcing(-1.0, 0.0, amplitude, frequency)
        last = first + frequency * duration
        flight = arc_flight(forcing, duration, first, last)
        arc = make_arc(forcing, duration, first, last)
        assert flight.angle == 0.0
        assert flight.velocity == pytest.approx(arc.start, abs=1e-14 * (1.0 + amplitude))
        angle, velocity = flight_state(flight, forcing, duration, math.sin(last), math.cos(last))
        size = (1.0 + amplitude) * (1.0 + frequency * duration)
        assert abs(angle) <= 1e-14 * size
        assert -velocity == pytest.approx(arc.landing, abs=1e-13 * size)


def test_exponentials_take_their_values_at_both_ends() -> None:
    for duration in (1e-3, 1.0, 30.0, 700.0):
        growing, decaying = exponentials(0.3, -0.7, duration)
        size = abs(growing) + abs(decaying)
        assert growing * math.exp(-duration) + decaying == pytest.approx(0.3, abs=1e-15 * size)
        assert growing + decaying * math.exp(-duration) == pytest.approx(-0.7, abs=1e-15 * size)


@every("x", [0.0, 1e-30, 1e-9, 9e-5, 1.1e-4, 1e-3, 0.3, 2.0, 30.0])
def test_ratios_without_a_hole_at_zero(x: float) -> None:
    exact = mp.mpf(x)
    for ratio, function in ((sine_ratio, mp.sin), (sinh_ratio, mp.sinh)):
        truth = float(function(exact) / exact) if x else 1.0
        truth = 1.0 / truth if ratio is sinh_ratio else truth
        assert ratio(x) == ratio(-x) == pytest.approx(truth, rel=4e-16, abs=1e-17)


def test_the_ratio_of_the_hyperbolic_sine_vanishes_without_overflow() -> None:
    assert sinh_ratio(699.0) > 0.0
    assert sinh_ratio(1e9) == sinh_ratio(-1e9) == 0.0
