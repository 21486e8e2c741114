"""Stability across a graze: docs/theory/continuation.md, held to flights in closed form."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from matplotlib.figure import Figure
from scipy.optimize import brentq

from rocksteady import DimensionlessBlock, Harmonic, Steady, find_orbits, plots, simulate
from rocksteady.basins import compute_manifold
from rocksteady.branches import Branch, BranchPoint, find_branches, follow_branch
from rocksteady.errors import ModelError
from rocksteady.formulas import steady_states
from rocksteady.words.branches import point_row

RESTITUTION, AMPLITUDE = 0.87, 5.0
BLOCK = DimensionlessBlock(restitution=RESTITUTION)


@pytest.fixture(scope="module", name="branch")
def _branch() -> Branch:
    """The unsymmetric orbits of three periods and two impacts, whose branch ends at a graze."""
    motion = Harmonic(amplitude=AMPLITUDE, frequency_ratio=8.0)
    found = find_orbits(BLOCK, motion, max_period=3, max_impacts=2)
    start = next(orbit for orbit in found if (orbit.period, orbit.branch) == (3, 1))
    branches = find_branches(
        [start], "frequency_ratio", (6.0, 8.5), max_period=3, max_impacts=2, largest_step=0.01
    )
    return next(each for each in branches if not each.symmetric)


@pytest.fixture(scope="module", name="graze")
def _graze(branch: Branch) -> BranchPoint:
    return next(point for point in branch.points if point.type == "grazing")


@pytest.fixture(scope="module", name="beyond")
def _beyond(graze: BranchPoint) -> list[BranchPoint]:
    """Orbits with two impacts more, 1e-6 to 1e-3 from the graze."""
    points = follow_branch(graze, "frequency_ratio", (6.0, 6.2), switch=True, largest_step=5e-4)
    return [point for point, _ in zip(points, range(12), strict=False)][1:]


def distances(points: list[BranchPoint], graze: BranchPoint) -> np.ndarray:
    return np.array([point.frequency_ratio - graze.frequency_ratio for point in points])


def limit(values: np.ndarray, at: np.ndarray) -> float:
    """The value at 0 of the parabola through values."""
    return float(np.polyfit(at, values, 2)[-1])


Flight = tuple[Callable[[float], float], Callable[[float], float]]


def flight(ratio: float, phase: float, velocity: float) -> Flight:
    """Angle and velocity of a flight from the floor: (7) with (14) and (15)."""
    beta = AMPLITUDE / (1.0 + ratio**2)
    a = velocity + beta * ratio * math.cos(phase)
    b = beta * math.sin(phase) - 1.0
    return (
        lambda t: a * math.sinh(t) + b * math.cosh(t) + 1.0 - beta * math.sin(phase + ratio * t),
        lambda t: a * math.cosh(t) + b * math.sinh(t) - beta * ratio * math.cos(phase + ratio * t),
    )


def height_at_the_next_touch(graze: BranchPoint, velocity: float) -> tuple[float, float]:
    """The least height one period after a touch that is left with a velocity, and y'' there."""
    chain, ratio = graze.chain, graze.frequency_ratio
    row = int(np.argmin(chain.shape[:, 1]))
    touch = float(chain.shape[row, 2])
    start = (chain.turns[row] + row % 2) * math.pi + chain.phases[row]  # seen from its side
    phase = start + ratio * touch
    rest = float(chain.durations[row]) - touch
    for duration in (rest, float(chain.durations[1 - row])):
        angle, speed = flight(ratio, phase, velocity)
        landing = brentq(angle, 0.5 * duration, 1.2 * duration, xtol=1e-15)
        velocity, phase = -RESTITUTION * speed(landing), phase + ratio * landing + math.pi
    angle, speed = flight(ratio, phase, velocity)
    lowest = brentq(speed, 0.9 * touch, 1.1 * touch, xtol=1e-15)
    return angle(lowest), AMPLITUDE * math.sin(phase + ratio * lowest) - 1.0


def test_the_multiplier_grows_as_one_over_the_distance_and_the_touch_shrinks_with_it(
    graze: BranchPoint, beyond: list[BranchPoint]
) -> None:
    x = np.abs(distances(beyond, graze))
    sizes = np.array([abs(point.multipliers[0]) for point in beyond])
    touches = np.array([point.chain.durations.min() for point in beyond])
    assert x.max() > 50.0 * x.min()
    assert np.diff(np.log(sizes)) / np.diff(np.log(x)) == pytest.approx(-1.0, abs=2e-3)
    assert np.diff(np.log(touches)) / np.diff(np.log(x)) == pytest.approx(1.0, abs=2e-3)
    for point in beyond:
        assert math.prod(m.real for m in point.multipliers) == pytest.approx(RESTITUTION**8)


def test_the_multiplier_is_that_of_the_square_root(
    branch: Branch, graze: BranchPoint, beyond: list[BranchPoint]
) -> None:
    step = 1e-6
    lower, upper = (height_at_the_next_touch(graze, sign * step) for sign in (-1.0, 1.0))
    at_rest, gamma = height_at_the_next_touch(graze, 0.0)
    assert abs(at_rest) < 1e-12  # the touch repeats itself
    slope = (upper[0] - lower[0]) / (2.0 * step)
    kick = (1.0 - RESTITUTION) ** 2 + 4.0 * RESTITUTION / (2.0 + gamma)
    x = distances(beyond, graze)
    large = np.array([point.multipliers[0].real for point in beyond])
    # The landing speed, from the duration of the hop on the other side.
    hops = np.array([point.chain.durations.min() for point in beyond])
    speeds = hops * (2.0 + gamma) / (2.0 * RESTITUTION)
    assert limit(large * speeds, x) == pytest.approx(-kick * gamma * slope, rel=1e-5)
    # And over the parameter, by the height that the orbit without the touch has or would have.
    near = sorted(branch.points, key=lambda p: abs(p.frequency_ratio - graze.frequency_ratio))[1:5]
    away = distances(near, graze)
    heights = np.array([point.chain.shape[:, 1].min() for point in near])
    rate = limit(heights / away, away)
    closing = np.prod([1.0 - m for m in graze.chain.multipliers]).real
    expected = (kick * slope) ** 2 * gamma / (closing * rate)
    assert limit(large * x, x) == pytest.approx(expected, rel=1e-3)


def test_a_stable_orbit_is_not_followed_by_a_stable_one(
    graze: BranchPoint, beyond: list[BranchPoint]
) -> None:
    assert max(abs(graze.chain.multipliers)) < 1.0
    assert all(point.admissible and not point.stable for point in beyond)
    assert all(point.multipliers[0].real < -100.0 for point in beyond)  # where it is no motion
    assert (distances(beyond, graze) < 0.0).all()


def test_a_symmetric_orbit_that_touches_in_both_halves_has_the_square_of_it() -> None:
    motion = Harmonic(amplitude=1.1, frequency_ratio=2.0)
    found = find_orbits(DimensionlessBlock(restitution=0.8), motion, max_period=1)
    start = next(orbit for orbit in found if orbit.branch == 2)
    branch = follow_branch(start, "amplitude", (1.0, 1.3))
    graze = next(point for point in branch if point.type == "grazing")
    points = follow_branch(graze, "amplitude", (0.9, 1.3), switch=True, largest_step=1e-3)
    near = [point for point, _ in zip(points, range(7), strict=False)][1:]
    x = np.array([point.amplitude - graze.amplitude for point in near])
    sizes = np.array([point.multipliers[0].real for point in near])
    assert all(point.symmetric and point.impacts == 6 for point in near)
    assert np.diff(np.log(sizes)) / np.diff(np.log(-x)) == pytest.approx(-2.0, abs=0.01)


def test_no_number_stands_for_a_derivative_at_a_graze(graze: BranchPoint) -> None:
    # Two impacts merge on A = 1 + Omega^2, which any block's motion meets; the other one touches.
    motion = Harmonic(amplitude=3.0, frequency_ratio=1.6)
    start = find_orbits(DimensionlessBlock(restitution=0.8), motion, max_period=1)[-1]
    ways = [list(follow_branch(start, "amplitude", (0.5, 8.0), direction=d)) for d in (1, -1)]
    (merging,) = (way[-1] for way in ways if way[-1].type == "grazing")
    assert merging.amplitude == pytest.approx(1.0 + 1.6**2, abs=1e-12)
    assert merging.chain.shortest == pytest.approx(0.0, abs=1e-12)
    for point in (merging, graze):
        assert np.isnan(point.multipliers).all()
        assert not point.stable
        assert point.to_dict()["multipliers"] is None
        assert "no derivative: grazes" in point.summary()
        row: dict[str, Any] = point_row(1, point, 1.0, DimensionlessBlock(restitution=0.8))
        assert all(math.isnan(row[name]) for name in row if name.startswith("multiplier"))
    data = Branch(parameter="amplitude", points=tuple(ways[0])).to_dataset()
    grazing = np.array([point.type == "grazing" for point in ways[0]])
    np.testing.assert_array_equal(np.isnan(data.multiplier_1_re), grazing)
    # Right beside the merging the multipliers are large, as they must be, and there.
    assert abs(ways[0][-2].multipliers[0]) > 1.0


def test_an_orbit_that_grazes_has_no_multipliers_exponent_or_verdict() -> None:
    for ratio in (2.0, 3.3, 4.7):
        amplitude = float(steady_states(2.0, ratio, 0.8).sign)  # eq 24: no speed at impact
        for near in (np.nextafter(amplitude, 0.0), amplitude):
            motion = Harmonic(amplitude=float(near), frequency_ratio=ratio)
            block = DimensionlessBlock(restitution=0.8)
            states = steady_states(float(near), ratio, 0.8)
            assert abs(states.velocity[1]) < 1e-15
            assert np.isnan(states.trace[1])
            assert np.isnan(states.multipliers[1]).all()
            assert not states.stable[1]
            told = states.to_dict()["solutions"][1]
            assert told["half_cycle_multipliers"] is told["stable"] is told["neutral"] is None
            found = find_orbits(block, motion, max_period=1, max_impacts=2, seeds=2)
            (orbit,) = (each for each in found if each.branch == 2)
            values = orbit.to_dict()
            assert values["multipliers"] is values["stable"] is values["neutral"] is None
            assert math.isnan(orbit.lyapunov)
            assert orbit.stable is orbit.neutral is False
            assert "no derivative: grazes" in orbit.summary()
            if not orbit.admissible:
                continue
            assert orbit.summary().startswith("Grazes symmetric")
            assert plots.multipliers([orbit], Figure().add_subplot()).lines
            with pytest.raises(ModelError, match="grazes"):
                compute_manifold(orbit, kind="unstable")
            with pytest.raises(ModelError, match="without speed"):
                simulate(block, motion, start=Steady(branch=2), cycles=1)
