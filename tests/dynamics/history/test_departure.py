"""Departures from an unstable steady state: how far, in which direction, on which side."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from rocksteady import DimensionlessBlock, Harmonic, State, Steady, simulate
from rocksteady.dynamics.history.departure import unstable_direction
from rocksteady.dynamics.history.start import KICK
from rocksteady.formulas import steady_states
from rocksteady.histories import Trajectory
from tests.every import every

BLOCK = DimensionlessBlock(restitution=0.8)


UNSTABLE = [
    # amplitude, frequency ratio, order, branch
    (1.0, 1.0, 1, 2), (1.0, 8.0, 1, 2), (2.0, 4.0, 3, 2), (2.0, 5.0, 3, 2),
    (2.0, 1.9, 1, 1), (2.0, 1.7, 1, 1), (4.0, 6.0, 3, 1), (2.0, 3.0, 3, 1),
]  # fmt: skip


unstable = every(("a", "w", "n", "branch"), UNSTABLE)


def started(
    a: float, w: float, n: int, branch: int, *, kick: float | None = None, side: int = 1
) -> Trajectory:
    start = Steady(order=n, branch=branch, side=side)
    if kick is not None:
        start = replace(start, kick=kick)
    shaking = Harmonic(amplitude=a, frequency_ratio=w)
    return simulate(BLOCK, shaking, start=start, cycles=2 * n)


def shift(run: Trajectory, a: float, w: float, n: int, branch: int) -> tuple[float, float]:
    """How far a run starts from the orbit: phase, and velocity over that of the orbit."""
    states = steady_states(a, w, 0.8, order=n)
    assert isinstance(run.motion, Harmonic)
    velocity = float(states.velocity[branch - 1])
    return (
        run.motion.phase - float(states.phase[branch - 1]),
        float(run.flights.velocity[0]) / velocity - 1.0,
    )


@unstable
@every("kick", [1e-4, 1e-2, 0.1])
def test_a_run_starts_as_far_from_the_orbit_as_the_kick_says(
    a: float, w: float, n: int, branch: int, kick: float
) -> None:
    plus, minus = (
        shift(started(a, w, n, branch, kick=kick, side=side), a, w, n, branch) for side in (1, -1)
    )
    assert math.hypot(*plus) == pytest.approx(kick, rel=1e-9)
    assert plus[1] > 0.0, "the positive side has more velocity"
    np.testing.assert_allclose(plus, np.negative(minus), rtol=1e-9, atol=1e-15)


@unstable
def test_the_direction_does_not_depend_on_the_distance(
    a: float, w: float, n: int, branch: int
) -> None:
    shifts = [
        np.array(shift(started(a, w, n, branch, kick=kick), a, w, n, branch)) / kick
        for kick in (1e-4, 1e-3, 1e-1)
    ]
    np.testing.assert_allclose(shifts[0], shifts[2], atol=1e-10)
    np.testing.assert_allclose(shifts[1], shifts[2], atol=1e-10)


@unstable
def test_it_is_the_direction_that_the_half_cycle_turns_into_its_multiple(
    a: float, w: float, n: int, branch: int
) -> None:
    # The half-cycle map by differences of two marches to the first impact; the multiplier comes
    # from the trace, the direction from the Jacobian.
    states = steady_states(a, w, 0.8, order=n)
    multiplier = float(states.half_cycle_multipliers[branch - 1, 0].real)
    phase, velocity = float(states.phase[branch - 1]), float(states.velocity[branch - 1])

    def landed(d_phase: float, d_velocity: float) -> tuple[float, float]:
        run = simulate(
            BLOCK,
            Harmonic(amplitude=a, frequency_ratio=w, phase=phase + d_phase),
            start=State(angle=0.0, velocity=velocity * (1.0 + d_velocity)),
            cycles=n,
        )
        first = float(run.impacts.pt[0])
        return (
            w * first + d_phase - n * math.pi,
            abs(float(run.impacts.velocity_after[0])) / velocity - 1.0,
        )

    x, y = unstable_direction(a, w, 0.8, n, branch)
    direction = np.array([x, y / velocity])
    assert np.hypot(*direction) == pytest.approx(1.0)
    step = 1e-6
    ahead, behind = (np.array(landed(*(sign * step * direction))) for sign in (1.0, -1.0))
    np.testing.assert_allclose((ahead - behind) / (2.0 * step), multiplier * direction, rtol=1e-4)


@given(st.floats(1e-12, 0.1), st.sampled_from([1, -1]))
def test_a_stable_state_is_started_on_exactly_whatever_the_kick(kick: float, side: int) -> None:
    run = started(2.0, 4.0, 1, 1, kick=kick, side=side)
    assert shift(run, 2.0, 4.0, 1, 1) == (0.0, 0.0)


@given(st.floats(1.5, 1.94), st.floats(1e-5, 1e-3))
def test_where_the_multiplier_is_negative_one_side_is_the_others_mirror_image_later(
    w: float, kick: float
) -> None:
    states = steady_states(2.0, w, 0.8)
    multiplier = float(states.half_cycle_multipliers[0, 0].real)
    assume(multiplier < -1.0)
    # after a half cycle the distance is |multiplier| times as large, to first order
    one = started(2.0, w, 1, 1, kick=kick, side=1)
    velocity = float(states.velocity[0])
    x, y = (float(one.impacts.pt[0]), float(abs(one.impacts.velocity_after[0])) / velocity - 1.0)
    assert isinstance(one.motion, Harmonic)
    turned = (one.motion.phase + w * x - math.pi - float(states.phase[0]), y)
    # to second order in the distance, with a curvature that is moderate here
    expected = multiplier * np.array(shift(one, 2.0, w, 1, 1))
    assert np.hypot(*(turned - expected)) < 60.0 * kick**2 * multiplier**2 + 1e-12


def test_where_nobody_says_it_is_the_default() -> None:
    one = started(2.0, 1.9, 1, 1)
    other = started(2.0, 1.9, 1, 1, kick=KICK)
    np.testing.assert_array_equal(one.rows, other.rows)
    assert KICK == 1e-6
    assert Steady() == Steady(branch=1, order=1, kick=KICK)
