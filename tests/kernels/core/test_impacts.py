"""How a block leaves an impact: side, velocity, what counts, and what is too slow."""

import math

import numpy as np
import pytest

from rocksteady.kernels.core.impacts import rebound
from rocksteady.kernels.core.tables import COUNTED

UNLIKE = np.array([[0.8, 1.0, 1.0], [0.6, 0.7, 1.3]])
WALL = np.array([[-0.5, 1.2, 0.8], [1.0, 1.0, 1.0]])


def test_a_block_goes_on_to_the_other_side_or_back_from_a_wall() -> None:
    for side, restitution, unit in ((1, 0.8, 1.0), (-1, 0.6, 0.91)):
        later, velocity, impacts, _ = rebound(UNLIKE, side, -0.3, 4, 0.0)
        assert (later, impacts) == (-side, 5)
        # The velocity keeps its sign: what came down on one side goes up on the other.
        assert velocity * later > 0.0
        assert abs(velocity) == pytest.approx(restitution * 0.3 * unit, rel=1e-15)
    later, velocity, impacts, _ = rebound(WALL, 1, -0.3, 4, 0.0)
    assert (later, impacts) == (1, 5)
    assert velocity == pytest.approx(0.5 * 0.3 * 1.2 * 0.8, rel=1e-15)


def test_impacts_count_that_leave_fast_enough() -> None:
    for side in (1, -1):
        restitution, lean, rate = UNLIKE[0 if side > 0 else 1]
        _, there_lean, there_rate = UNLIKE[1 if side > 0 else 0]
        least = COUNTED * there_lean * there_rate / (restitution * lean * rate)
        for factor, counts in ((1.0 - 1e-9, 0), (1.0 + 1e-9, 1)):
            assert rebound(UNLIKE, side, -least * factor, 4, 0.0).impacts == 4 + counts
            # Where none is too slow, lanes count all.
            assert rebound(UNLIKE, side, -least * factor, 4, math.inf).impacts == 5


def test_an_impact_is_slow_up_to_a_velocity_in_the_smaller_of_both_units() -> None:
    for sides, side, restitution, unit in (
        (UNLIKE, 1, 0.8, 1.0),
        (UNLIKE, -1, 0.6, 0.91),
        (WALL, 1, 0.5, 0.96),
    ):
        smaller = 0.96 if sides is WALL else 0.91
        border = 1e-3 * smaller / (restitution * unit)
        for factor, slow in ((1.0 - 1e-9, True), (1.0 + 1e-9, False), (0.0, True), (2.0, False)):
            assert rebound(sides, side, -border * factor, 0, 1e-3).slow == slow
        assert rebound(sides, side, -1e9, 0, math.inf).slow
        assert not rebound(sides, side, -1e-9, 0, 0.0).slow
