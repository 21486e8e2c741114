"""A state taken from any result starts `simulate` where that result has it."""

import math
from typing import Any

import numpy as np
import pytest

from rocksteady import (
    DimensionlessBlock,
    Harmonic,
    RocksteadyError,
    State,
    Status,
    compute_basins,
    compute_erosion,
    find_attractor,
    find_fatal_kicks,
    find_orbits,
    map_fates,
    simulate,
)
from rocksteady.basins import find_hilltop_saddles
from rocksteady.branches import follow_branch, follow_resting_branch
from rocksteady.formulas import steady_states
from rocksteady.orbits import compute_steady_orbit

BLOCK = DimensionlessBlock(restitution=0.8)
A, W = 2.0, 4.0
"""Away from Omega = 1, where both velocities of a state are one number."""


def test_a_steady_state_repeats_itself_from_either_velocity() -> None:
    states = steady_states(A, W, 0.8)
    shaking = Harmonic(amplitude=A, frequency_ratio=W, phase=float(states.phase[0]))
    velocity, velocity_tau = float(states.velocity[0]), float(states.velocity_tau[0])
    for start in (
        State(angle=0.0, velocity=velocity),
        State.per_tau(angle=0.0, velocity_tau=velocity_tau, frequency_ratio=W),
    ):
        run = simulate(BLOCK, shaking, start=start, cycles=3.25)
        np.testing.assert_allclose(np.abs(run.impacts.velocity_after), velocity, rtol=1e-9)
        assert len(run.impacts) == 6


def test_any_point_of_a_steady_orbit_is_a_start() -> None:
    orbit = compute_steady_orbit(A, W, 0.8, samples=801)
    phase = float(steady_states(A, W, 0.8).phase[0])
    assert np.allclose(orbit.velocity, W * orbit.velocity_tau, rtol=1e-15)
    for first in (100, 555):
        late = 120
        run = simulate(
            BLOCK,
            Harmonic(amplitude=A, frequency_ratio=W, phase=phase + float(orbit.tau[first])),
            start=State(angle=float(orbit.angle[first]), velocity=float(orbit.velocity[first])),
            cycles=1,
        )
        end = run(float(orbit.tau[late]) / W)
        assert float(end.angle) == pytest.approx(orbit.angle[first + late], abs=1e-9)
        assert float(end.velocity) == pytest.approx(orbit.velocity[first + late], abs=1e-9)


def test_a_cell_of_basins_and_a_state_of_its_attractor_are_starts() -> None:
    window = np.linspace(-0.9, 0.9, 7)
    shaking = Harmonic(amplitude=A, frequency_ratio=W, phase=0.4)
    found = compute_basins(BLOCK, shaking, angles=window, velocities=window)
    seen = set()
    for row, velocity in enumerate(found.velocity.tolist()):
        for column, angle in enumerate(found.angle.tolist()):
            start = State(angle=angle, velocity=velocity)
            here = found.attractors[found.label[row, column]]
            assert find_attractor(BLOCK, shaking, start=start).kind is here.kind
            fell = simulate(BLOCK, shaking, start=start, cycles=100).status is Status.OVERTURNED
            assert fell is (here.kind.value == "overturned")
            seen.add(fell)
    assert seen == {True, False}
    ((angle, velocity),) = found.stroboscopic[-1]
    back = simulate(BLOCK, shaking, start=State(angle=angle, velocity=velocity), cycles=1)
    end = back(2.0 * math.pi / W)
    assert (float(end.angle), float(end.velocity)) == pytest.approx((angle, velocity), abs=1e-9)


def test_a_cell_of_an_erosion_is_a_start() -> None:
    window = np.linspace(-1.1, 1.1, 8)
    shaking = Harmonic(amplitude=1.5, frequency_ratio=W, phase=0.4)
    found = compute_erosion(BLOCK, shaking, [1.5], angles=window, velocities=window, cycles=10)
    for row, column in np.ndindex(8, 8):
        start = State(angle=float(found.angle[column]), velocity=float(found.velocity[row]))
        run = simulate(BLOCK, shaking, start=start, cycles=10)
        assert found.safe[0, row, column] == (run.status is not Status.OVERTURNED)
    assert 0.0 < found.safe_share[0] < 1.0


def test_a_state_of_an_orbit_and_of_a_trajectory_are_starts() -> None:
    orbit = find_attractor(BLOCK, Harmonic(amplitude=A, frequency_ratio=W)).orbit
    assert orbit is not None
    for first in orbit.states:
        start = State(angle=0.0, velocity=first.side * first.speed)
        shaking = Harmonic(amplitude=A, frequency_ratio=W, phase=first.phase)
        run = simulate(BLOCK, shaking, start=start, cycles=1)
        assert run.peak == pytest.approx(max(orbit.highest, -orbit.lowest), rel=1e-9)
        # From any moment of the run it goes on as the run does.
        middle, end = run(0.6), run(1.1)
        later = simulate(
            BLOCK,
            Harmonic(amplitude=A, frequency_ratio=W, phase=first.phase + 0.6 * W),
            start=State(angle=float(middle.angle), velocity=float(middle.velocity)),
            cycles=1,
        )(0.5)
        assert float(later.angle) == pytest.approx(float(end.angle), abs=1e-9)
        assert float(later.velocity) == pytest.approx(float(end.velocity), abs=1e-9)


def test_a_result_stands_for_its_start() -> None:
    shaking = Harmonic(amplitude=A, frequency_ratio=W)
    orbit = find_orbits(BLOCK, shaking, max_period=1)[0]
    points = list(follow_branch(orbit, "amplitude", within=(1.9, 2.1)))
    window = np.linspace(-6.0, 6.0, 3)
    cells = compute_basins(BLOCK, shaking, angles=window, velocities=window).attractors
    (fallen,) = (cell for cell in cells if cell.kind.value == "overturned")
    rocking = next(cell for cell in cells if cell.orbit is not None)
    with_rest = find_attractor(BLOCK, Harmonic(amplitude=1.05, frequency_ratio=2.0)).orbit
    assert with_rest is not None
    resting = follow_resting_branch(with_rest, "amplitude", within=(1.04, 1.06))
    results: list[Any] = [
        *(orbit, find_attractor(BLOCK, shaking, start=orbit), points[0], points[-1]),
        *(resting.points[0], simulate(BLOCK, shaking, start=orbit, cycles=1), rocking),
    ]
    for point in (points[0], points[-1]):
        assert point.start == point.orbit.states[0] != point.orbit.states[1]
    for result in results:
        assert result.start is not None
        plain, taken = (
            simulate(BLOCK, shaking, start=start, cycles=1) for start in (result.start, result)
        )
        assert (taken.peak, taken.start, taken.motion) == (plain.peak, plain.start, plain.motion)
    for nothing in (fallen, "rest", slice(1, 2)):
        with pytest.raises(RocksteadyError, match="start"):
            simulate(BLOCK, shaking, start=nothing)  # type: ignore[arg-type]
    still = find_fatal_kicks(BLOCK, start=State(angle=0.5, velocity=0.0))
    assert (find_fatal_kicks(BLOCK, start=still).signed == still.signed).all()
    saddle = find_hilltop_saddles(BLOCK, shaking)[0]
    one, other = (
        map_fates(BLOCK, shaking, axes={"angle": [0.0]}, start=begin)
        for begin in (saddle, saddle.start)
    )
    assert one.equals(other)
