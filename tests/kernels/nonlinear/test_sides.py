"""Nonlinear blocks whose sides differ: mirror images to the last bit, proofs, the return map."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady.kernels.core.clock import clock
from rocksteady.kernels.core.tables import (
    AMPLITUDE,
    CEILING,
    CONSTANT,
    DURATION,
    FREQUENCY,
    JUMP,
    LEFT_OUT,
    LIFT,
    LIFT_CEILING,
    LIFT_SLOPE,
    NONLINEAR_SEGMENT_COLUMNS,
    NONLINEAR_SIDE_COLUMNS,
    PEAK_COLUMNS,
    ROW_ANGLE,
    ROW_COLUMNS,
    ROW_HALF_CYCLES,
    ROW_SIDE,
    ROW_VELOCITY,
    SLOPE,
    March,
)
from rocksteady.kernels.core.tuples import Kept, Tables, Until
from rocksteady.kernels.march.march import march
from rocksteady.kernels.nonlinear.drive import Drive, acceleration
from rocksteady.kernels.nonlinear.landing import lost_under_shaking
from rocksteady.kernels.nonlinear.proofs import point_of_no_return
from rocksteady.kernels.orbits.return_map import IMPACT, Section, highest_after, next_passage
from rocksteady.kernels.orbits.systems import like_sides, make_system
from tests.every import every

Floats = NDArray[np.float64]


def random_sides(rng: np.random.Generator) -> Floats:
    """Return two sides, neither of which is the reference."""
    sides = np.empty((2, NONLINEAR_SIDE_COLUMNS))
    sides[:, 0] = rng.uniform(0.6, 0.95, 2)
    sides[:, 1] = rng.uniform(0.6, 1.6, 2)
    sides[:, 2] = rng.uniform(0.8, 1.2, 2)
    sides[:, 3] = rng.uniform(0.05, 0.8, 2)
    sides[:, LEFT_OUT] = 1e-15
    return sides


def steps(rng: np.random.Generator) -> Floats:
    """Return segments with slopes, impulses and vertical motion, then a still base."""
    segments = np.zeros((5, NONLINEAR_SEGMENT_COLUMNS))
    segments[:, DURATION] = (0.9, 0.7, 1.1, 0.8, math.inf)
    segments[:4, CONSTANT] = rng.uniform(-0.8, 0.8, 4)
    segments[:4, SLOPE] = rng.uniform(-1.0, 1.0, 4)
    segments[1:4, JUMP] = rng.uniform(-0.2, 0.2, 3)
    segments[:4, LIFT] = rng.uniform(-0.4, 0.4, 4)
    segments[:4, LIFT_SLOPE] = rng.uniform(-0.2, 0.2, 4)
    segments[:3, CEILING] = math.inf
    segments[3, CEILING] = 3.0
    segments[:4, LIFT_CEILING] = 0.7
    return segments


def shaking(amplitude: float, frequency: float) -> Floats:
    segments = np.zeros((1, NONLINEAR_SEGMENT_COLUMNS))
    segments[0, [DURATION, AMPLITUDE, FREQUENCY, CEILING]] = (
        math.inf,
        amplitude,
        frequency,
        amplitude,
    )
    return segments


def marched(
    segments: Floats, sides: Floats, start: March, half: int, phase: float
) -> tuple[int, Floats, Floats]:
    """Return status, rows and peaks of a march."""
    given = Tables(segments, sides), start, Until(half, phase, 1e-8, 500)
    peaks = np.zeros(PEAK_COLUMNS)
    _, end = march(*given, Kept(np.zeros((0, ROW_COLUMNS)), np.zeros(0)))
    rows = np.zeros((end.flights, ROW_COLUMNS))
    status, _ = march(*given, Kept(rows, peaks))
    return status, rows, peaks


@every("seed", [0, 1, 2, 3, 5, 6])  # not those that fall at once
def test_mirrored_sides_on_the_reversed_base_move_mirrored_to_the_last_bit(seed: int) -> None:
    rng = np.random.default_rng(seed)
    sides, segments = random_sides(rng), steps(rng)
    angle, velocity = rng.uniform(-0.2, 0.2, 2).tolist()
    half, phase = clock(float(rng.uniform(0.0, 6.0)))
    swinging = shaking(float(rng.uniform(0.5, 1.0)), float(rng.uniform(4.0, 8.0)))
    turned = segments.copy()
    turned[:, [CONSTANT, SLOPE, JUMP]] *= -1.0
    side = 1 if angle > 0.0 else -1
    start, image = (
        March(sign * side, sign * angle, sign * velocity, 0, 0, 0.0, 0, 0) for sign in (1, -1)
    )
    runs = [
        marched(segments, sides, start, 0, 1e4),
        marched(turned, sides[::-1].copy(), image, 0, 1e4),
    ]
    # Of a sinusoid half a period more is the reversed base.
    for first, begin, table in ((half, start, sides), (half + 1, image, sides[::-1].copy())):
        at = begin._replace(half_cycles=first, phase=phase)
        runs.append(marched(swinging, table, at, first + 20, phase))
    for one, other, shift in ((runs[0], runs[1], 0), (runs[2], runs[3], 1)):
        assert one[0] == other[0]
        expected = one[1].copy()
        expected[:, [ROW_SIDE, ROW_ANGLE, ROW_VELOCITY]] *= -1.0
        expected[:, ROW_HALF_CYCLES] += shift
        assert len(expected) > 3
        assert np.array_equal(other[1], expected)
        assert np.array_equal(one[2], other[2])


@pytest.mark.parametrize("side", [1, -1])
def test_beyond_the_point_of_no_return_the_strongest_base_does_not_pull_a_side_back(
    side: int,
) -> None:
    sides = random_sides(np.random.default_rng(side + 5))
    _, lean, _, alpha, _ = sides[0 if side > 0 else 1].tolist()
    segments = steps(np.random.default_rng(1))[3:]
    angle = point_of_no_return(segments, 0, sides, side)
    # As large as the ceilings allow, and against the fall.
    strongest = Drive(alpha, -3.0 / lean, 0.0, 0.0, 0.0, -0.7, 0.0)
    assert acceleration(strongest, 0.0, angle, 0.0) == pytest.approx(0.0, abs=1e-14)
    assert acceleration(strongest, 0.0, angle * (1.0 + 1e-6), 0.0) > 0.0
    assert point_of_no_return(steps(np.random.default_rng(1)), 0, sides, side) == math.inf
    swung = Drive(alpha, 0.0, 0.0, 1.7 / lean, 4.0, 0.0, 0.0)
    lost = lost_under_shaking(swung)
    assert acceleration(swung, 0.0, lost, -1.0) == pytest.approx(0.0, abs=1e-14)
    assert lost == pytest.approx(point_of_no_return(shaking(1.7, 4.0), 0, sides, side), rel=1e-15)


@every("seed", range(12))
def test_passages_are_mirrored_and_have_the_determinant_of_their_side(seed: int) -> None:
    rng = np.random.default_rng(seed)
    sides = random_sides(rng)
    amplitude, frequency = float(rng.uniform(0.1, 1.5)), float(rng.uniform(2.0, 9.0))
    system = make_system(amplitude, frequency, sides)
    image = make_system(amplitude, frequency, sides[::-1].copy())
    side = int(rng.choice([-1, 1]))
    state = Section(side, 0, float(rng.uniform(0.0, math.pi)), float(rng.uniform(0.1, 0.4)))
    opposite = Section(-side, 1, state.phase, state.speed)
    here, there = next_passage(system, state, -1.0), next_passage(image, opposite, -1.0)
    assert there.kind == here.kind
    assert there.state == Section(
        -here.state.side, here.state.half_cycles + 1, here.state.phase, here.state.speed
    )
    assert (there.time, there.landing, there.jacobian) == (here.time, here.landing, here.jacobian)
    if here.kind != IMPACT:
        pytest.skip("no impact follows")
    assert highest_after(system, state, here) == highest_after(image, opposite, there)
    j11, j12, j21, j22 = here.jacobian
    restitution = sides[0 if side > 0 else 1, 0]
    expected = restitution**2 * state.speed / here.state.speed
    size = abs(j11 * j22) + abs(j12 * j21)
    assert j11 * j22 - j12 * j21 == pytest.approx(expected, abs=2e-13 * size)

    def landed(phase: float, speed: float) -> Floats:
        moved = Section(side, 0, state.phase + phase, state.speed + speed)
        after = next_passage(system, moved, -1.0).state
        return np.array([math.pi * after.half_cycles + after.phase, after.speed])

    h = 1e-5
    differences = [landed(h, 0.0) - landed(-h, 0.0), landed(0.0, h) - landed(0.0, -h)]
    jacobian = np.array(here.jacobian).reshape(2, 2)
    near = np.column_stack(differences) / (2.0 * h)
    np.testing.assert_allclose(near, jacobian, atol=1e-5 * np.abs(jacobian).max())


@every("column", range(4))
def test_sides_are_alike_only_if_every_column_is(column: int) -> None:
    sides = np.tile([0.8, 1.0, 1.0, 0.3, 1e-15], (2, 1))
    assert like_sides(make_system(2.0, 4.0, sides))
    sides[1, column] *= 1.1
    assert not like_sides(make_system(2.0, 4.0, sides))
