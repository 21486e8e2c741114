"""Symmetric orbits of the nonlinear model by their half cycles: fixed points and continuation."""

import math

import numpy as np
import pytest

from rocksteady.kernels.core.clock import clock
from rocksteady.kernels.orbits.closed_form import symmetric_orbit
from rocksteady.kernels.orbits.periodic import mirror
from rocksteady.kernels.orbits.return_map import (
    IMPACT,
    Section,
    next_passage,
    phase_between,
    shifted,
)
from rocksteady.kernels.orbits.symmetric_nonlinear import Half, symmetric_from, symmetric_near
from rocksteady.kernels.orbits.systems import make_system
from tests.every import every
from tests.strategies import PLAIN, sample_size

DELTA = 0.8
POINTS = [
    # amplitude, frequency ratio, order, branch; the last has half-cycle multipliers up to 1e6
    (2.0, 4.0, 1, 1), (1.0, 2.0, 1, 2), (2.0, 4.0, 3, 1), (2.0, 4.0, 3, 2), (1.2, 0.7, 3, 2),
]  # fmt: skip
points = every(("a", "w", "order", "branch"), sample_size(POINTS, POINTS[:-1]))


def table(alpha: float) -> np.ndarray:
    return np.tile([DELTA, 1.0, 1.0, alpha, 1e-15], (2, 1))


def found(alpha: float, a: float, w: float, order: int, branch: int) -> Half:
    seed = symmetric_orbit(a, w, DELTA, order, branch)
    half, phase = clock(seed.phase)
    begin = Section(1, half, phase, w * seed.velocity)
    return symmetric_from(a, w, table(alpha), order, branch, begin)


@points
@every("alpha", [1e-3, 0.1, 0.3])
def test_half_a_cycle_takes_the_state_to_its_mirror_image(
    alpha: float, a: float, w: float, order: int, branch: int
) -> None:
    half = found(alpha, a, w, order, branch)
    assert half.found
    step = next_passage(make_system(a, w, table(alpha)), half.state, -1.0)
    assert step.kind == IMPACT
    there, size = mirror(half.state, order), max(map(abs, half.jacobian))
    assert step.state.side == there.side
    assert abs(phase_between(there, step.state)) <= 1e-13 * (10.0 + size)
    assert abs(step.state.speed - there.speed) <= 1e-13 * (10.0 + size)
    # The flow keeps v dv dphi, an impact takes delta from v: the determinant is delta squared.
    j11, j12, j21, j22 = half.jacobian
    assert j11 * j22 - j12 * j21 == pytest.approx(DELTA**2, abs=1e-9 * (1.0 + size) ** 2)
    fold = 1.0 + DELTA**2
    assert (j11 + j22 < fold) == (branch == 1)


@points
def test_newtons_method_comes_back_from_beside_it(
    a: float, w: float, order: int, branch: int
) -> None:
    half = found(0.2, a, w, order, branch)
    beside = 1e-3 / max(1.0, abs(half.jacobian.phase_by_phase + half.jacobian.speed_by_speed))
    begin = shifted(half.state, beside, -beside)
    again = symmetric_near(make_system(a, w, table(0.2)), begin, order)
    assert again.found
    assert phase_between(half.state, again.state) == pytest.approx(0.0, abs=1e-11)
    assert again.state.speed == pytest.approx(half.state.speed, rel=1e-11)


@pytest.mark.skipif(PLAIN, reason="takes long uncompiled")
def test_beyond_the_fold_there_is_none() -> None:
    # So slight a shaking does not make up for what the impacts take.
    half = found(0.9, 0.28, 2.0, 1, 1)
    seed = symmetric_orbit(0.28, 2.0, DELTA, 1, 1)
    assert math.isfinite(seed.velocity)
    assert not half.found


def test_a_state_from_which_the_block_falls_leads_to_none() -> None:
    system = make_system(2.0, 4.0, table(0.2))
    assert not symmetric_near(system, Section(1, 0, 1.0, 9.0), 1).found
