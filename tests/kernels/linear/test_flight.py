"""The closed-form flight against 50 digits, and its own invariants."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rocksteady.kernels.core.forcing import Forcing, make_forcing
from rocksteady.kernels.core.tables import FOUND
from rocksteady.kernels.linear.extrema import restarted
from rocksteady.kernels.linear.flight import (
    LONG,
    SHORT,
    Flight,
    Parts,
    flight_acceleration,
    flight_state,
    make_flight,
    shifted_flight,
    velocity_flight,
    wrapped,
)
from rocksteady.kernels.linear.zeros import Zero
from tests.every import every
from tests.oracles import ExactFlight, mp
from tests.strategies import logarithmic, phases, sample_size

EPSILON = 2.0**-52


def at(flight: Flight, forcing: Forcing, time: float) -> tuple[float, float]:
    phase = flight.phase + forcing.frequency * time
    return flight_state(flight, forcing, time, math.sin(phase), math.cos(phase))


def both(
    constant: float,
    slope: float,
    amplitude: float,
    frequency: float,
    angle: float,
    velocity: float,
    phase: float,
) -> tuple[Flight, Forcing, ExactFlight]:
    forcing = make_forcing(constant, slope, amplitude, frequency)
    flight = make_flight(forcing, angle, velocity, phase, math.sin(phase), math.cos(phase))
    numbers = (constant, slope, amplitude, frequency, angle, velocity, phase)
    return flight, forcing, ExactFlight(*(mp.mpf(number) for number in numbers))


cases = st.tuples(
    st.one_of(st.just(-1.0), st.floats(-3.0, 3.0)),
    st.one_of(st.just(0.0), st.floats(-2.0, 2.0)),
    st.one_of(st.just(0.0), st.floats(0.0, 12.0)),
    logarithmic(0.05, 1000.0),
    st.one_of(st.just(0.0), st.floats(-2.0, 2.0)),
    st.floats(-2.0, 2.0),
    phases,
)


@given(cases, logarithmic(1e-9, 40.0))
def test_angle_and_velocity_agree_with_fifty_digits(
    case: tuple[float, float, float, float, float, float, float], time: float
) -> None:
    flight, forcing, exact = both(*case)
    angle, velocity = at(flight, forcing, time)
    y, v = exact.state(time)
    constant, slope, _, frequency, start, speed, _ = case
    # The coefficients are rounded once, and so is the phase, which has turned that far.
    beta, turned = forcing.beta, frequency * time + 5.0
    size = abs(constant) + abs(start) + beta + 1e-290  # above the subnormal numbers
    lift = abs(speed) + abs(slope) + beta * frequency
    grown = math.sinh(time)
    blur = size * math.cosh(time) + lift * grown + abs(slope) * time + beta * turned
    assert abs(angle - y) <= 8 * EPSILON * blur
    blur = size * grown + lift * math.cosh(time) + beta * frequency * turned
    assert abs(velocity - v) <= 8 * EPSILON * blur


@given(
    amplitude=st.floats(0.0, 12.0),
    frequency=logarithmic(0.05, 1000.0),
    phase=phases,
    velocity=logarithmic(1e-12, 1.0),
    share=st.floats(0.01, 1.0),
)
def test_short_flights_keep_their_relative_accuracy(
    amplitude: float, frequency: float, phase: float, velocity: float, share: float
) -> None:
    flight, forcing, exact = both(-1.0, 0.0, amplitude, frequency, 0.0, velocity, phase)
    # Within the first bounce, of which velocity and forcing have about the same share.
    time = min(share * velocity / (1.0 + amplitude), 0.24 / (1.0 + frequency))
    angle, speed = at(flight, forcing, time)
    y, v = exact.state(time)
    assert abs(angle - y) <= 4 * EPSILON * (velocity * time)
    assert abs(speed - v) <= 4 * EPSILON * velocity


@pytest.mark.parametrize("border", ["short", "long"])
def test_the_ways_of_writing_a_flight_meet_at_their_borders(border: str) -> None:
    rng = np.random.default_rng(4)
    for _ in range(sample_size(400, 60)):
        frequency = 10.0 ** rng.uniform(-1.3, 3.0)
        amplitude, velocity = rng.uniform(0.0, 10.0), rng.uniform(-1.0, 1.0)
        angle, slope = rng.uniform(-1.0, 1.0), rng.normal()
        flight, forcing, _ = both(
            -1.0, slope, amplitude, frequency, angle, velocity, rng.uniform(-1.5, 4.7)
        )
        edge = min(SHORT, SHORT / frequency) if border == "short" else LONG
        before = at(flight, forcing, edge * (1.0 - 1e-15))
        after = at(flight, forcing, edge * (1.0 + 1e-15))
        size = 3.0 + abs(slope) + amplitude
        assert before[0] == pytest.approx(after[0], abs=2e-15 * size)
        assert before[1] == pytest.approx(after[1], abs=1e-14 * size)


@given(cases, logarithmic(1e-3, 5.0))
def test_a_flight_run_backwards_comes_home(
    case: tuple[float, float, float, float, float, float, float], time: float
) -> None:
    flight, forcing, _ = both(*case)
    angle, velocity = at(flight, forcing, time)
    constant, slope, amplitude, frequency, start, speed, phase = case
    # Time reversed: sin(phase + w(T - t)) = sin(pi - phase - w T + w t).
    turned = wrapped(math.pi - phase - frequency * time)
    back, against, _ = both(
        constant + slope * time, -slope, amplitude, frequency, angle, -velocity, turned
    )
    home, fall = at(back, against, time)
    grown = math.exp(2.0 * time)
    size = 10.0 + amplitude + abs(slope) * (1.0 + time)
    rounding = 8 * EPSILON * size * grown * (1.0 + frequency * time)
    assert home == pytest.approx(start, abs=rounding)
    assert fall == pytest.approx(-speed, abs=rounding * (1.0 + frequency))


@given(st.floats(-2.0, 2.0), st.floats(-2.0, 2.0), st.floats(0.0, 5.0))
def test_energy_is_kept_on_a_still_base(angle: float, velocity: float, time: float) -> None:
    flight, forcing, _ = both(-1.0, 0.0, 0.0, 0.0, angle, velocity, 0.0)
    y, v = at(flight, forcing, time)
    # v^2 - (y - 1)^2 is conserved.
    before, after = velocity**2 - (angle - 1.0) ** 2, v * v - (y - 1.0) ** 2
    assert after == pytest.approx(before, abs=40 * EPSILON * (1.0 + v * v + y * y + 9.0))


@given(cases, st.floats(0.0, 3.0))
def test_the_equation_of_motion_holds(
    case: tuple[float, float, float, float, float, float, float], time: float
) -> None:
    flight, forcing, exact = both(*case)
    phase = flight.phase + forcing.frequency * time
    angle, _ = at(flight, forcing, time)
    step = mp.mpf(10) ** -25
    pull = (exact.state(time + step)[1] - exact.state(time - step)[1]) / (2 * step)
    found = flight_acceleration(forcing, time, angle, math.sin(phase))
    size = 10.0 + 2.0 * abs(angle) + 12.0 * math.exp(time) + forcing.amplitude * (1 + abs(phase))
    assert abs(found - pull) <= 16 * EPSILON * size


@every("growing", [1e-3, 1e-9, 1e-15, 0.0])
def test_a_tiny_growing_part_decides_a_long_flight(growing: float) -> None:
    # On the balanced motion but for `growing`: y - balanced = growing e^t, to its own precision.
    forcing = make_forcing(-1.0, 0.0, 2.0, 3.0)
    flight = Flight(1.0, growing, 0.0, 0.0, 1.0, Parts(0.6, 0.0, growing, 0.0, 0.0))
    for time in (2.0, 10.0, 40.0):
        angle, _ = at(flight, forcing, time)
        balanced = 1.0 - 0.2 * math.sin(3.0 * time)
        assert angle - balanced == pytest.approx(
            growing * math.exp(time), rel=1e-14, abs=4 * EPSILON * (1.0 + growing * math.exp(time))
        )


@given(cases, st.floats(0.0, 4.0), st.floats(0.0, 4.0))
def test_a_flight_told_from_a_later_start_is_the_same_flight(
    case: tuple[float, float, float, float, float, float, float], first: float, second: float
) -> None:
    flight, forcing, exact = both(*case)
    angle, velocity = at(flight, forcing, first)
    phase = flight.phase + forcing.frequency * first
    zero = Zero(FOUND, first, 0, phase, math.sin(phase), math.cos(phase), angle, velocity)
    later, shifted = restarted(flight, forcing, zero)
    y, v = exact.state(mp.mpf(first) + mp.mpf(second))
    found, speed = at(later, shifted, second)
    turned = 1.0 + forcing.frequency * (first + second)
    size = (10.0 + forcing.amplitude) * math.exp(first + second) + forcing.amplitude * turned
    assert abs(found - y) <= 32 * EPSILON * size
    assert abs(speed - v) <= 32 * EPSILON * (size + forcing.amplitude * turned)


@given(cases, st.floats(0.0, 4.0), st.floats(-2.0, 2.0))
def test_velocity_and_a_lowered_angle_are_flights_too(
    case: tuple[float, float, float, float, float, float, float], time: float, level: float
) -> None:
    flight, forcing, exact = both(*case)
    y, v = exact.state(time)
    turned = 1.0 + forcing.frequency * time
    size = (10.0 + forcing.amplitude) * math.exp(time) + forcing.amplitude * turned
    lowered, shifted = shifted_flight(flight, forcing, level)
    found, speed = at(lowered, shifted, time)
    assert abs(found - (y - level)) <= 16 * EPSILON * size
    assert abs(speed - v) <= 16 * EPSILON * size
    velocity, rate = velocity_flight(flight, forcing)
    found, pull = at(velocity, rate, time)
    assert abs(found - v) <= 16 * EPSILON * size
    truth = y + exact.forcing(time)
    assert abs(pull - truth) <= 16 * EPSILON * size * (1.0 + forcing.frequency)
