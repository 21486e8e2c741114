"""The return map of the nonlinear model: its determinant, differences, and the linear limit."""

import math

import numpy as np
import pytest

from rocksteady.kernels.nonlinear import _expansion, series
from rocksteady.kernels.nonlinear._variation import COLUMNS, ROWS, STATE, advance, begin
from rocksteady.kernels.nonlinear.drive import Drive, Instant
from rocksteady.kernels.orbits.return_map import IMPACT, Section, next_passage
from rocksteady.kernels.orbits.systems import (
    System,
    for_series,
    make_series_system,
    make_system,
)
from tests.every import every


def system_of(alpha: float, amplitude: float, frequency: float, restitution: float) -> System:
    row = (restitution, 1.0, 1.0, alpha, 1e-15)
    return make_system(amplitude, frequency, np.array([row, row]))


def drawn(seed: int) -> tuple[float, float, float, float, Section]:
    rng = np.random.default_rng(seed)
    state = Section(
        int(rng.choice([-1, 1])), 0, float(rng.uniform(0.0, math.pi)), float(rng.uniform(0.2, 0.8))
    )
    return (
        float(rng.uniform(0.02, 1.0)),
        float(rng.uniform(0.1, 3.0)),
        float(rng.uniform(1.0, 12.0)),
        float(rng.uniform(0.5, 1.0)),
        state,
    )


@every("seed", range(40))
def test_the_flow_keeps_the_area(seed: int) -> None:
    *parameters, state = drawn(seed)
    system = system_of(*parameters)
    found = next_passage(system, state, -1.0)
    if found.kind != IMPACT:
        pytest.skip("no impact follows")
    j11, j12, j21, j22 = found.jacobian
    expected = parameters[3] ** 2 * state.speed / found.state.speed
    size = abs(j11 * j22) + abs(j12 * j21)
    assert j11 * j22 - j12 * j21 == pytest.approx(expected, abs=2e-13 * size)


@every("seed", range(10))
def test_the_derivative_is_that_of_differences(seed: int) -> None:
    *parameters, state = drawn(seed)
    system = system_of(*parameters)
    found = next_passage(system, state, -1.0)
    if found.kind != IMPACT:
        pytest.skip("no impact follows")

    def landed(phase: float, speed: float) -> np.ndarray:
        moved = Section(state.side, 0, state.phase + phase, state.speed + speed)
        after = next_passage(system, moved, -1.0).state
        return np.array([math.pi * after.half_cycles + after.phase, after.speed])

    h = 1e-5
    columns = [(landed(h, 0.0) - landed(-h, 0.0)), (landed(0.0, h) - landed(0.0, -h))]
    jacobian = np.array(found.jacobian).reshape(2, 2)
    difference = np.column_stack(columns) / (2.0 * h)
    np.testing.assert_allclose(difference, jacobian, atol=1e-6 * np.abs(jacobian).max())


@every("seed", range(10))
def test_small_slenderness_is_the_linear_map(seed: int) -> None:
    _, *parameters, state = drawn(seed)
    amplitude, frequency, restitution = parameters
    full = next_passage(system_of(1e-7, amplitude, frequency, restitution), state, -1.0)
    row = (restitution, 1.0, 1.0)
    plain = next_passage(make_system(amplitude, frequency, np.array([row, row])), state, -1.0)
    assert full.kind == plain.kind
    if full.kind == IMPACT:
        assert full.time == pytest.approx(plain.time, rel=1e-12)
        size = np.abs(plain.jacobian).max()
        np.testing.assert_allclose(full.jacobian, plain.jacobian, atol=1e-11 * size)


@every("alpha", [0.0, 0.3])
@every("seed", range(6))
def test_a_series_of_one_sine_has_the_map_of_the_sinusoid(alpha: float, seed: int) -> None:
    _, amplitude, frequency, restitution, state = drawn(seed)
    row = (restitution, 1.0, 1.0, alpha, 1e-15)
    # A block without slenderness is one of the linear model, which is solved in closed form.
    plain = make_system(amplitude, frequency, np.array([row if alpha else row[:3]] * 2))
    shares, lifts = np.array([1.0, 0.0]), np.empty((2, 1))
    summed = make_series_system(amplitude, frequency, np.array([row] * 2), shares, lifts)
    expected = next_passage(plain, state, -1.0)
    found = for_series(next_passage)(summed, state, -1.0)
    assert found.kind == expected.kind
    if found.kind == IMPACT:
        assert found.time == pytest.approx(expected.time, rel=1e-12)
        size = np.abs(expected.jacobian).max()
        np.testing.assert_allclose(found.jacobian, expected.jacobian, atol=1e-11 * size)


def test_what_stood_in_the_working_space_changes_no_derivative() -> None:
    """Terms beyond the degree are what was in memory; plain Python warns of their overflow."""
    rng = np.random.default_rng(3)
    short = 0
    for _ in range(20):
        alpha, amplitude, frequency, angle, speed, turned = rng.uniform(
            [0.05, 0.1, 1.0, 0.0, -0.8, 0.0], [1.0, 3.0, 12.0, 0.9, 0.8, 6.0]
        ).tolist()
        drive = Drive(alpha, 0.0, 0.0, amplitude, frequency, 0.0, 0.0, 0.0)
        states = []
        for left in (0.0, 1e300, -1e300):
            work = np.full((series.WORK_ROWS, series.TERMS), left)
            course = np.full((ROWS, COLUMNS), left)
            begin(course)
            at = Instant(0.0, angle, speed, math.sin(turned), math.cos(turned), False)
            for reach in (0.3, 0.02):
                degree, step = _expansion.expand(drive, at, reach, 1e-15, work)
                advance(drive, work, degree, step, course)
                short += degree < series.TERMS - 1
            states.append(course[STATE, :4].tobytes())
        assert len(set(states)) == 1
    assert short > 60
