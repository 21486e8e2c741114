"""The impact's Jacobian against differences in 50 digits, and its determinant and trace."""

import math
from typing import Any

import numpy as np
import pytest

from rocksteady.kernels.flight import make_flight, wrapped
from rocksteady.kernels.forcing import make_forcing
from rocksteady.kernels.saltation import impact_jacobian
from rocksteady.kernels.symmetric import symmetric_orbit
from rocksteady.kernels.zeros import FOUND, next_zero
from tests.oracles import ExactFlight, mp
from tests.strategies import sample_size


def landing(
    amplitude: float, frequency: float, restitution: float, phase: Any, velocity: Any, near: float
) -> tuple[Any, Any]:
    """Return phase and velocity after the impact near a time, in 50 digits."""
    flight = ExactFlight(
        mp.mpf(-1), mp.mpf(0), mp.mpf(amplitude), mp.mpf(frequency), mp.mpf(0), velocity, phase
    )
    time = flight.zero_near(near)
    return phase + mp.mpf(frequency) * time, -mp.mpf(restitution) * flight.state(time)[1]


def test_the_jacobian_agrees_with_differences_in_fifty_digits() -> None:
    rng = np.random.default_rng(1)
    checked, step = 0, mp.mpf(10) ** -30
    while checked < sample_size(300, 40):
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
        found = impact_jacobian(amplitude, frequency, restitution, phase, velocity, zero.time)
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


def test_its_determinant_is_that_of_a_flow_that_keeps_area() -> None:
    # The flow keeps v dv dpsi; an impact multiplies v by the restitution.
    rng = np.random.default_rng(2)
    checked = 0
    while checked < sample_size(2000, 200):
        amplitude, restitution = rng.uniform(0.0, 6.0), rng.uniform(0.05, 1.0)
        frequency, phase = rng.uniform(0.5, 12.0), wrapped(rng.uniform(0.0, 6.28))
        velocity = rng.uniform(0.05, 0.6)
        forcing = make_forcing(-1.0, 0.0, amplitude, frequency)
        flight = make_flight(forcing, 0.0, velocity, phase, math.sin(phase), math.cos(phase))
        zero = next_zero(flight, forcing, 4.0, False, False, -1.0)
        if zero.event != FOUND or abs(zero.velocity) < 1e-2:
            continue
        checked += 1
        a, b, c, d = impact_jacobian(amplitude, frequency, restitution, phase, velocity, zero.time)
        landed = -restitution * zero.velocity
        # v' dv' dpsi' = restitution^2 v dv dpsi
        size = abs(a * d) + abs(b * c)
        expected = restitution**2 * velocity / landed
        assert a * d - b * c == pytest.approx(expected, abs=1e-11 * size, rel=1e-11)


@pytest.mark.parametrize("order", [1, 3])
def test_on_symmetric_orbits_determinant_and_trace_have_closed_forms(order: int) -> None:
    rng = np.random.default_rng(3)
    checked = 0
    while checked < sample_size(1500, 150):
        frequency, restitution = rng.uniform(0.6 * order, 12.0), rng.uniform(0.3, 1.0)
        amplitude = rng.uniform(0.5, 6.0)
        d, h = (1 - restitution) / (1 + restitution), math.tanh(order * math.pi / 2 / frequency)
        least = (1 + frequency**2) * d * h * h / math.hypot(1.0, d * h * frequency)
        if amplitude < 1.01 * least:
            continue
        for branch in (1, 2):
            orbit = symmetric_orbit(amplitude, frequency, restitution, order, branch)
            velocity = frequency * orbit.velocity
            if velocity < 1e-2:
                continue
            checked += 1
            length = order * math.pi / frequency
            j = impact_jacobian(
                amplitude, frequency, restitution, wrapped(orbit.phase), velocity, length
            )
            size = abs(j[0] * j[3]) + abs(j[1] * j[2]) + math.cosh(length)
            assert j[0] * j[3] - j[1] * j[2] == pytest.approx(restitution**2, abs=1e-12 * size)
            printed = -2 * restitution * math.cosh(length) + restitution * math.sinh(length) / (
                velocity
            ) * ((1 + restitution) - (1 - restitution) * amplitude * orbit.sine)
            size = (abs(j[0]) + abs(j[3]) + math.cosh(length)) / velocity
            assert j[0] + j[3] == pytest.approx(printed, abs=1e-12 * size)
            assert j[0] + j[3] == pytest.approx(orbit.trace, abs=1e-12 * size)
