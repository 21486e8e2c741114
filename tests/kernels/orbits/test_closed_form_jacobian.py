"""The derivative of the half-cycle map on symmetric orbits: determinant, trace, the return map."""

import math

import numpy as np
import pytest

from rocksteady.kernels.orbits.closed_form import (
    half_cycle_jacobian,
    half_cycle_shape,
    symmetric_orbit,
)
from rocksteady.kernels.orbits.return_map import IMPACT, next_passage
from tests.every import every
from tests.kernels.passages import even_system, state_at_phase
from tests.strategies import sample_size


def least_amplitude(frequency: float, restitution: float, order: int) -> float:
    """Return eq 23 as printed."""
    d, h = (1 - restitution) / (1 + restitution), math.tanh(order * math.pi / 2 / frequency)
    return (1 + frequency**2) * d * h * h / math.hypot(1.0, d * h * frequency)


@every("order", [1, 3, 5])
def test_its_determinant_and_trace_have_closed_forms(order: int) -> None:
    rng = np.random.default_rng(3)
    checked = 0
    while checked < sample_size(1500, 100):
        # Half cycles of up to e^60.
        frequency = 10.0 ** rng.uniform(math.log10(order * math.pi / 60.0), 2.0)
        restitution = rng.uniform(0.05, 1.0)
        amplitude = least_amplitude(frequency, restitution, order) * rng.uniform(1.01, 6.0)
        if restitution > 0.99:
            amplitude = rng.uniform(0.5, 6.0)
        for branch in (1, 2):
            orbit = symmetric_orbit(amplitude, frequency, restitution, order, branch)
            velocity = frequency * orbit.velocity
            if velocity < 1e-2:
                continue
            checked += 1
            length = order * math.pi / frequency
            j = half_cycle_jacobian(amplitude, frequency, restitution, order, orbit)
            square = sum(entry * entry for entry in j)
            assert abs(j[0] * j[3] - j[1] * j[2] - restitution**2) <= 1e-12 * square
            # TW5, which is a difference of such terms in long half cycles.
            printed = -2 * restitution * math.cosh(length) + restitution * math.sinh(length) / (
                velocity
            ) * ((1 + restitution) - (1 - restitution) * amplitude * orbit.sine)
            size = (abs(j[0]) + abs(j[3]) + math.cosh(length)) * (1.0 + amplitude) / velocity
            assert abs(j[0] + j[3] - printed) <= 1e-12 * size
            assert abs(j[0] + j[3] - orbit.trace) <= 1e-12 * size


def test_it_is_one_passage_of_the_return_map() -> None:
    rng = np.random.default_rng(5)
    checked = 0
    while checked < sample_size(500, 60):
        frequency, restitution = rng.uniform(1.0, 20.0), rng.uniform(0.3, 1.0)
        order = int(rng.choice([1, 3]))
        least = least_amplitude(frequency, restitution, order)
        amplitude = max(least, 0.3) * rng.uniform(1.05, 4.0)
        orbit = symmetric_orbit(amplitude, frequency, restitution, order, 1)
        length = order * math.pi / frequency
        _, _, admissible = half_cycle_shape(amplitude, frequency, restitution, order, orbit)
        if not admissible or length > 4.0 or frequency * orbit.velocity < 1e-2:
            continue
        checked += 1
        system = even_system(amplitude, frequency, restitution)
        state = state_at_phase(1, orbit.phase, frequency * orbit.velocity)
        step = next_passage(system, state, -1.0)
        assert step.kind == IMPACT
        assert step.time == pytest.approx(length, rel=1e-9)
        j = half_cycle_jacobian(amplitude, frequency, restitution, order, orbit)
        assert np.allclose(step.jacobian, j, rtol=0.0, atol=1e-8 * max(abs(entry) for entry in j))
