"""Initial states: at rest, anywhere, or on a steady state, as the march begins with them."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rocksteady import (
    DimensionlessBlock,
    Harmonic,
    Linear,
    Piecewise,
    Rest,
    State,
    Status,
    Steady,
    Still,
    simulate,
)
from rocksteady.dynamics.history.start import (
    FARTHEST,
    LARGEST_KICK,
    Start,
    initial_march,
    start_of,
)
from rocksteady.errors import InputError, ModelError
from rocksteady.formulas import steady_states
from rocksteady.kernels.core.tables import March
from rocksteady.motions import Segment
from rocksteady.orbits import compute_region_boundaries
from tests.every import every

BLOCK = DimensionlessBlock(restitution=0.8)
ASYMMETRY = DimensionlessBlock(restitution=0.8, alpha_ratio=1.3, p_ratio=0.9)
SHAKING = Harmonic(amplitude=2.0, frequency_ratio=4.0)


def begun(start: Start, block: DimensionlessBlock = BLOCK, motion: Any = SHAKING) -> March:
    return initial_march(start, block, motion, Linear().sides(block))[1]


@given(st.floats(-1e3, 1e3), st.floats(-2.0, 2.0), st.floats(-2.0, 2.0))
def test_a_state_begins_at_its_phase_on_the_side_where_it_leans_or_goes(
    phase: float, angle: float, velocity: float
) -> None:
    motion = Harmonic(amplitude=2.0, frequency_ratio=4.0, phase=phase)
    state = begun(State(angle=angle, velocity=velocity), ASYMMETRY, motion)
    assert (state.angle, state.velocity) == (angle, velocity)
    assert state.side == (np.sign(angle) or np.sign(velocity))
    assert 0.0 <= state.phase < math.pi
    assert math.pi * state.half_cycles + state.phase == pytest.approx(phase, abs=1e-12)


def test_rest_is_upright_and_still() -> None:
    assert begun(Rest()) == begun(State(angle=0.0, velocity=0.0))
    assert begun(Rest()).side == 0


@pytest.mark.parametrize(("angle", "rate"), [(0.3, 1.0), (-0.3, 0.9)])
def test_an_impulse_at_the_start_acts_by_the_square_of_p_of_the_side(
    angle: float, rate: float
) -> None:
    struck = Piecewise(pieces=(Segment(duration=1.0, constant=0.0, jump=0.25),))
    state = begun(State(angle=angle, velocity=0.1), ASYMMETRY, struck)
    assert state.velocity == pytest.approx(0.1 + 0.25 * rate**2)
    upright = begun(Rest(), ASYMMETRY, struck)
    assert (upright.side, upright.velocity) == (1, 0.25)
    back = begun(
        Rest(),
        ASYMMETRY,
        Piecewise(pieces=(Segment(duration=1.0, constant=0.0, jump=-0.25),)),
    )
    assert back.side == -1
    assert back.velocity == pytest.approx(-0.25 * 0.9**2)


def test_a_velocity_by_tau_is_one_by_pivot_time_over_the_frequency_ratio() -> None:
    state = State.per_tau(angle=0.2, velocity_tau=-0.5, frequency_ratio=4.0)
    assert state == State(angle=0.2, velocity=-2.0)


def test_a_stable_steady_state_decides_on_the_phase() -> None:
    motion, state = initial_march(Steady(), BLOCK, SHAKING, Linear().sides(BLOCK))
    found = steady_states(2.0, 4.0, 0.8)
    assert isinstance(motion, Harmonic)
    assert motion.phase == float(found.phase[0])
    assert (state.angle, state.velocity) == (0.0, float(found.velocity[0]))
    assert state.side == 1


@every(
    ("start", "block", "motion", "words"),
    [
        (Steady(), BLOCK, Still(), "a steady state needs harmonic shaking"),
        (Steady(), ASYMMETRY, SHAKING, "a steady state to start on"),
        (Steady(branch=2), BLOCK, SHAKING, "passes through the floor"),
    ],
)
def test_a_steady_state_that_does_not_fit_is_refused(
    start: Steady, block: DimensionlessBlock, motion: Any, words: str
) -> None:
    with pytest.raises(ModelError, match=words):
        begun(start, block, motion)


def test_where_there_is_none_the_least_amplitude_is_named() -> None:
    least = float(compute_region_boundaries(4.0, 0.8).existence)
    with pytest.raises(ModelError, match=f"raise the amplitude to {least:.6g} or above"):
        begun(Steady(), BLOCK, Harmonic(amplitude=0.9 * least, frequency_ratio=4.0))
    begun(Steady(), BLOCK, Harmonic(amplitude=1.01 * least, frequency_ratio=4.0))


@every("start", ["rest", 0.0, (0.1, 0.2), Rest])
def test_anything_else_is_no_start(start: object) -> None:
    with pytest.raises(InputError, match="must be a Rest, a State, a Steady, an ImpactState, or"):
        start_of(start)


@every(
    "value",
    [0.0, -1e-6, 0.1000001, 1.0, math.nan, math.inf, "1e-6", None, True],
)
def test_a_bad_kick_is_refused_with_its_range(value: Any) -> None:
    with pytest.raises(InputError, match=r"^kick = ") as caught:
        Steady(kick=value)
    assert "1e-6" in str(caught.value)


@every("value", [5e-324, 1e-300, 1e-6, LARGEST_KICK, 0.1, np.float64(0.01)])
def test_every_kick_in_the_range_is_a_number(value: float) -> None:
    assert Steady(kick=value).kick == value
    assert type(Steady(kick=value).kick) is float


@every("size", [1e3, 1e9, FARTHEST])
@every("excess", [-1.0, 1.0])
def test_the_farthest_start_ends_as_the_closed_form_says(size: float, excess: float) -> None:
    """On a still base u + u' - 1 grows as e^t: below 0 the block lands, and falls behind."""
    start = State(angle=size, velocity=1.0 - size + excess)
    run = simulate(BLOCK, Still(), start=start, model=Linear())
    assert run.status is Status.OVERTURNED
    landings = 0 if excess > 0.0 else 1
    assert len(run.impacts) == landings
    if landings:  # the energy of y = u - 1: y'^2 - y^2 is kept
        y, v = size - 1.0, 1.0 - size + excess
        landing = math.sqrt(1.0 + (v - y) * (v + y))
        assert abs(run.impacts.velocity_before[0]) == pytest.approx(landing, rel=1e-3)


@every("size", [1.01 * FARTHEST, 1e50])
def test_a_start_beyond_the_farthest_is_refused(size: float) -> None:
    for keys in ({"angle": size, "velocity": 0.0}, {"angle": 0.0, "velocity": -size}):
        with pytest.raises(InputError, match=r"lie in \[-1000000000000, 1000000000000\]"):
            State(**keys)
