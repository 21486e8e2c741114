"""Windows of initial states, and the moment of the shaking at which they are taken."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rocksteady import DimensionlessBlock, Harmonic, State, Status, simulate
from rocksteady.dynamics.basins.window import (
    centred,
    moment,
    reach,
    spacing,
    window_axis,
    window_of,
)
from rocksteady.errors import InputError
from rocksteady.model.equations import Linear
from tests.every import every


@given(st.floats(0.0, 12.0), st.floats(0.05, 50.0), st.floats(0.0, 6.3))
def test_the_growing_part_is_above_zero_at_the_reach_whatever_the_phase(
    amplitude: float, ratio: float, phase: float
) -> None:
    # G = (u + v - 1 + beta (sin phi + Omega cos phi))/2, at its least over all phases 0.
    beta = amplitude / (1.0 + ratio**2)
    swing = beta * (math.sin(phase) + ratio * math.cos(phase))
    assert reach(amplitude, ratio) - 1.0 + swing >= -1e-12 * (1.0 + amplitude)
    worst = math.atan2(1.0, ratio) + math.pi
    swing = beta * (math.sin(worst) + ratio * math.cos(worst))
    assert reach(amplitude, ratio) - 1.0 + swing == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize(
    "block",
    [
        DimensionlessBlock(restitution=0.9),
        DimensionlessBlock(restitution=0.9, alpha_ratio=1.4, p_ratio=0.8),
    ],
)
def test_from_the_edge_of_the_window_a_block_at_high_frequency_falls(
    block: DimensionlessBlock,
) -> None:
    # Fast shaking hardly moves the block: no dip brings it back to its base.
    shaking = Harmonic(amplitude=2.0, frequency_ratio=30.0)
    angle, velocity = window_of(Linear().sides(block), 2.0, 30.0)
    sides = [side for side in (1, -1) if angle == pytest.approx(_reach(block, side)[0])]
    for side in sides:
        run = simulate(block, shaking, start=State(angle=1.001 * side * angle, velocity=0.0))
        assert run.status is Status.OVERTURNED
    assert sides
    assert velocity == pytest.approx(max(_reach(block, side)[1] for side in (1, -1)))


def _reach(block: DimensionlessBlock, side: int) -> tuple[float, float]:
    """Return the reach of a side in u and in du/ds of the positive side."""
    _, lean, rate = block.sides[0 if side > 0 else 1]
    own = lean * reach(2.0 / lean, 30.0 / rate)
    return own, rate * own


@given(st.floats(1e-3, 1e3), st.integers(2, 301))
def test_the_middles_of_cells_are_even_and_mirrored_exactly(half: float, points: int) -> None:
    middles = centred(half, points)
    assert len(middles) == points
    np.testing.assert_array_equal(middles, -middles[::-1])
    np.testing.assert_allclose(np.diff(middles), 2.0 * half / points, rtol=1e-9)
    # Half a cell is left at either end.
    assert half - middles[-1] == pytest.approx(half / points)
    axis = window_axis("angles", middles, "an angle")
    assert spacing(axis) == pytest.approx(2.0 * half / points)


@every("values", [[1.0], [2.0, 1.0], [0.0, 0.0], [0.0, 1.0, 2.1], [0.0, math.inf], [0.0, 1e60]])
def test_what_is_no_even_axis_is_refused(values: list[float]) -> None:
    with pytest.raises(InputError) as refused:
        window_axis("angles", values, "an angle")
    assert "\n" not in str(refused.value)


@given(st.floats(-20.0, 20.0), st.integers(-4, 4))
def test_moments_whole_half_periods_apart_are_the_same_to_the_last_digit(
    phase: float, halves: int
) -> None:
    def at(radians: float) -> tuple[int, float]:
        return moment(Harmonic(amplitude=1.0, frequency_ratio=1.0, phase=radians))

    (half, rest), (other, same) = at(phase), at(phase + halves * math.pi)
    assert half in (0, 1)
    assert 0.0 <= rest < math.pi
    apart = abs(math.remainder(math.pi * (other - half - halves) + same - rest, 2.0 * math.pi))
    assert apart < 3e-12, "to the 12 digits that are kept"


def test_a_phase_just_below_a_half_period_is_its_end() -> None:
    shaking: dict[str, Any] = {"amplitude": 1.0, "frequency_ratio": 1.0}
    assert moment(Harmonic(**shaking, phase=math.pi - 1e-13)) == (1, 0.0)
    assert moment(Harmonic(**shaking, phase=-1e-13)) == (0, 0.0)
    assert moment(Harmonic(**shaking, phase=2.0 * math.pi)) == (0, 0.0)
    exact = moment(Harmonic(**shaking, phase=1.0))
    for turns in range(1, 6):
        later = moment(Harmonic(**shaking, phase=1.0 + 2.0 * math.pi * turns))
        assert later == exact
