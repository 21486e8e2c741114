"""Hilltop saddles: closed form, an independent integrator, limits."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from rocksteady import Block, DimensionlessBlock, Harmonic, Nonlinear
from rocksteady.basins import find_hilltop_saddles

Floats = NDArray[np.float64]
TURN = 2.0 * math.pi


@given(st.floats(0.0, 1.5), st.floats(0.3, 8.0), st.floats(0.0, 6.2))
def test_the_linear_saddle_and_its_multipliers_are_the_closed_form(
    amplitude: float, ratio: float, phase: float
) -> None:
    motion = Harmonic(amplitude=amplitude, frequency_ratio=ratio, phase=phase)
    beta = amplitude / (1.0 + ratio**2)
    found = find_hilltop_saddles(DimensionlessBlock(restitution=0.9), motion)
    assert len(found) == (2 if beta < 1.0 else 0)
    for saddle in found:
        begin = saddle.start
        assert begin.angle == pytest.approx(saddle.side - beta * math.sin(phase), abs=1e-13)
        assert begin.velocity == pytest.approx(-beta * ratio * math.cos(phase), abs=1e-12)
        growth = math.exp(TURN / ratio)
        assert saddle.multipliers[0] == pytest.approx(growth, rel=1e-12)
        assert saddle.multipliers[1] == pytest.approx(1.0 / growth, rel=1e-12)
        assert saddle.highest == pytest.approx(saddle.side + beta, abs=1e-9)


@pytest.mark.parametrize(("alpha", "amplitude", "ratio"), [(0.3, 2.0, 2.0), (0.55, 0.6, 0.9)])
def test_the_nonlinear_saddle_closes_and_grows_as_an_integrator_has_it(
    alpha: float, amplitude: float, ratio: float
) -> None:
    block = Block.from_p(alpha=alpha, p=2.0, restitution=0.9)
    motion = Harmonic(amplitude=amplitude, frequency_ratio=ratio, phase=0.4)
    saddle = find_hilltop_saddles(block, motion, model=Nonlinear())[0]
    begin = saddle.start

    def rates(s: float, z: Floats) -> list[float]:
        push = amplitude * math.sin(ratio * s + 0.4)
        tilt = alpha * (1.0 - z[0])
        force = push * math.cos(tilt) - math.sin(tilt) / alpha
        stiff = math.cos(tilt) + alpha * push * math.sin(tilt)
        return [z[1], force, z[4], z[5], stiff * z[2], stiff * z[3]]

    start = [begin.angle, begin.velocity, 1.0, 0.0, 0.0, 1.0]
    run = solve_ivp(rates, (0.0, TURN / ratio), start, method="DOP853", rtol=1e-13, atol=1e-14)
    end = run.y[:, -1]
    # Rounding and the integrator's error grow by the multiplier.
    slack = 1e-12 * saddle.multipliers[0]
    assert end[:2] == pytest.approx([begin.angle, begin.velocity], abs=slack)
    grown = np.linalg.eigvals(end[2:].reshape(2, 2))
    assert np.abs(grown).max() == pytest.approx(saddle.multipliers[0], rel=1e-8)
    along = np.array(saddle.direction("unstable", 0.4))
    moved = end[2:].reshape(2, 2) @ along
    assert moved == pytest.approx(saddle.multipliers[0] * along, rel=1e-8)


def test_a_slender_block_has_the_linear_saddle_to_second_order() -> None:
    motion = Harmonic(amplitude=1.5, frequency_ratio=2.0, phase=0.4)
    plain = find_hilltop_saddles(DimensionlessBlock(restitution=0.9), motion)[0]
    errors = []
    for alpha in (0.02, 0.01):
        block = Block.from_p(alpha=alpha, p=2.0, restitution=0.9)
        saddle = find_hilltop_saddles(block, motion, model=Nonlinear())[0]
        errors.append(abs(saddle.start.angle - plain.start.angle))
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.01)


def test_sides_count_for_themselves_and_a_wall_has_one() -> None:
    motion = Harmonic(amplitude=0.5, frequency_ratio=2.0)
    block = DimensionlessBlock(restitution=0.9, alpha_ratio=1.2, p_ratio=0.8)
    _, (_, lean, rate) = block.sides
    right, left = find_hilltop_saddles(block, motion)
    assert right.highest == pytest.approx(1.0 + 0.5 / 5.0)
    assert left.lowest == pytest.approx(-lean - 0.5 / (1.0 + (2.0 / rate) ** 2))
    assert left.multipliers[0] == pytest.approx(math.exp(TURN * rate / 2.0))
    assert left.lyapunov == pytest.approx(TURN * rate / 2.0)
    walled = DimensionlessBlock(restitution=0.5, one_sided=True)
    assert [saddle.side for saddle in find_hilltop_saddles(walled, motion)] == [1]


def test_its_trajectory_stays_where_a_run_would_leave() -> None:
    motion = Harmonic(amplitude=0.2, frequency_ratio=0.25)  # e^25 over a period
    saddle = find_hilltop_saddles(DimensionlessBlock(restitution=0.9), motion)[1]
    run = saddle.trajectory()
    times = run.times(40)
    angle = run(times).angle
    assert times[-1] == pytest.approx(TURN / 0.25, rel=1e-14)
    expected = -1.0 - 0.2 / (1.0 + 0.0625) * np.sin(0.25 * times)
    assert angle == pytest.approx(expected, abs=1e-12)
    assert "Hilltop saddle on the negative side" in repr(saddle)
    other, _ = find_hilltop_saddles(DimensionlessBlock(restitution=0.9), motion)
    assert "Hilltop saddle on the positive side" in repr(other)
    assert saddle.to_dict()["impacts_per_period"] == 0
