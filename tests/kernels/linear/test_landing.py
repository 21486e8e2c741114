"""The landing's Jacobian against differences in 50 digits, and its determinant."""

import math
from typing import Any

import numpy as np
import pytest

from rocksteady.kernels.core.forcing import make_forcing
from rocksteady.kernels.core.tables import FOUND
from rocksteady.kernels.linear.flight import make_flight, wrapped
from rocksteady.kernels.linear.landing import landing_jacobian
from rocksteady.kernels.linear.zeros import Zero, next_zero
from tests.oracles import ExactFlight, mp
from tests.strategies import inner_sample_size, sample_size


def landing(
    amplitude: float, frequency: float, restitution: float, phase: Any, velocity: Any, near: float
) -> tuple[Any, Any]:
    """Return phase and velocity after the impact near a time, in 50 digits."""
    flight = ExactFlight(
        mp.mpf(-1), mp.mpf(0), mp.mpf(amplitude), mp.mpf(frequency), mp.mpf(0), velocity, phase
    )
    time = flight.zero_near(near)
    return phase + mp.mpf(frequency) * time, -mp.mpf(restitution) * flight.state(time)[1]


def check_jacobian(seed: int, count: int) -> None:
    rng = np.random.default_rng(seed)
    checked, step = 0, mp.mpf(10) ** -30
    while checked < count:
        amplitude, restitution = rng.uniform(0.0, 10.0), rng.uniform(0.05, 1.0)
        frequency = 10.0 ** rng.uniform(math.log10(0.05), 3.0)
        phase = wrapped(rng.uniform(0.0, 2.0 * math.pi))
        velocity = rng.uniform(0.05, 1.0) * rng.choice([1.0, (1.0 + amplitude) / (1.0 + frequency)])
        forcing = make_forcing(-1.0, 0.0, amplitude, frequency)
        flight = make_flight(forcing, 0.0, velocity, phase, math.sin(phase), math.cos(phase))
        zero = next_zero(flight, forcing, 12.0, False, False, -1.0)
        if zero.event != FOUND or abs(zero.velocity) < 1e-2:
            continue
        checked += 1
        f, v = mp.mpf(phase), mp.mpf(velocity)
        found = landing_jacobian(forcing, restitution, flight, zero)
        columns = []
        for df, dv in ((step, 0), (0, step)):
            more = landing(amplitude, frequency, restitution, f + df, v + dv, zero.time)
            less = landing(amplitude, frequency, restitution, f - df, v - dv, zero.time)
            columns.append([(b - a) / (2 * step) for a, b in zip(less, more, strict=True)])
        truth = [columns[0][0], columns[1][0], columns[0][1], columns[1][1]]
        # What the rounding of the time of impact and of the coefficients does to it.
        pull = 1.0 + amplitude
        beta = amplitude / (1.0 + frequency**2)
        swing = (1.0 + beta * (1.0 + frequency)) * math.exp(zero.time)
        blur = 2.0**-50 * (1.0 + frequency * zero.time) * swing
        steep = 1.0 / abs(zero.velocity)
        for entry, (exact, got) in enumerate(zip(truth, found, strict=True)):
            size = steep * (frequency if entry < 2 else pull) + 1.0
            allowed = blur * size * (1.0 + steep * pull * (1.0 + frequency))
            assert abs(got - exact) <= allowed + 1e-13 * abs(exact), (entry, amplitude, frequency)


@pytest.mark.slow
def test_the_jacobian_agrees_with_differences_in_fifty_digits() -> None:
    check_jacobian(1, sample_size(300, 40))


def test_the_jacobian_of_a_few_landings_agrees_with_differences_in_fifty_digits() -> None:
    check_jacobian(11, 20)


def test_its_determinant_is_that_of_a_flow_that_keeps_area() -> None:
    # The flow keeps v dv dpsi; an impact multiplies v by the restitution.
    rng = np.random.default_rng(2)
    checked = 0
    while checked < inner_sample_size(2000, 200):
        amplitude, restitution = rng.uniform(0.0, 6.0), rng.uniform(0.05, 1.0)
        frequency, phase = rng.uniform(0.5, 12.0), wrapped(rng.uniform(0.0, 6.28))
        velocity = rng.uniform(0.05, 0.6)
        forcing = make_forcing(-1.0, 0.0, amplitude, frequency)
        flight = make_flight(forcing, 0.0, velocity, phase, math.sin(phase), math.cos(phase))
        zero = next_zero(flight, forcing, 4.0, False, False, -1.0)
        if zero.event != FOUND or abs(zero.velocity) < 1e-2:
            continue
        checked += 1
        a, b, c, d = landing_jacobian(forcing, restitution, flight, zero)
        landed = -restitution * zero.velocity
        # v' dv' dpsi' = restitution^2 v dv dpsi
        size = abs(a * d) + abs(b * c)
        expected = restitution**2 * velocity / landed
        assert a * d - b * c == pytest.approx(expected, abs=1e-11 * size, rel=1e-11)


def test_in_a_long_flight_it_keeps_the_digits_of_the_landing() -> None:
    # So long that the landing velocity, worked out from the start, would be noise: e^30 and more.
    # The flight is found backwards, from a landing velocity, in 50 digits.
    rng = np.random.default_rng(4)
    checked = 0
    while checked < sample_size(60, 12):
        amplitude, frequency = rng.uniform(0.2, 0.9), rng.uniform(0.1, 2.0)
        length, restitution = rng.uniform(30.0, 60.0), rng.uniform(0.3, 1.0)
        phase = mp.mpf(rng.uniform(-0.5 * math.pi, 1.5 * math.pi))
        w, time = mp.mpf(frequency), mp.mpf(length)
        beta = mp.mpf(amplitude) / (1 + w * w)
        psi = phase + w * time
        # y(length) = 0 says what the velocity at the start is.
        held = (beta * mp.sin(phase) - 1) * mp.cosh(time) + 1 - beta * mp.sin(psi)
        velocity = -held / mp.sinh(time) - beta * w * mp.cos(phase)
        exact = ExactFlight(mp.mpf(-1), mp.mpf(0), mp.mpf(amplitude), w, mp.mpf(0), velocity, phase)
        landed = exact.state(time)[1]
        if landed > -0.05 or velocity < 0.05:
            continue
        checked += 1
        # The derivative of the closed form, in 50 digits.
        sinh, cosh = mp.sinh(time), mp.cosh(time)
        sine, cosine, end_cosine = mp.sin(phase), mp.cos(phase), mp.cos(psi)
        y_phase = -beta * w * sine * sinh + beta * cosine * cosh - beta * end_cosine
        v_phase = -beta * w * sine * cosh + beta * cosine * sinh + beta * w * mp.sin(psi)
        pull = amplitude * mp.sin(psi) - 1
        t_phase, t_velocity = -y_phase / landed, -sinh / landed
        truth = [
            1 + w * t_phase,
            w * t_velocity,
            -restitution * (v_phase + pull * t_phase),
            -restitution * (cosh + pull * t_velocity),
        ]
        forcing = make_forcing(-1.0, 0.0, amplitude, frequency)
        start = float(phase)
        flight = make_flight(forcing, 0.0, float(velocity), start, math.sin(start), math.cos(start))
        sine, cosine = float(mp.sin(psi)), float(end_cosine)
        zero = Zero(FOUND, length, 0, float(psi), sine, cosine, 0.0, float(landed))
        found = landing_jacobian(forcing, restitution, flight, zero)
        largest = max(abs(entry) for entry in truth)
        for exact_entry, got in zip(truth, found, strict=True):
            assert abs(got - exact_entry) <= 1e-12 * largest
