"""Returns near an orbit: what the linear law of them foretells."""

import numpy as np
import pytest

from rocksteady.kernels.core.law import Law, drawn_near
from tests.every import every


@every(
    ("first", "second"),
    [(0.7, 0.6), (0.9, 0.1), (-0.8, 0.5), (0.55 + 0.6j, 0.55 - 0.6j), (0.95j, -0.95j)],
)
@every("times", [1, 7, 64, 3000])
def test_returns_that_are_leapt_follow_the_linear_law(
    first: complex, second: complex, times: int
) -> None:
    basis = np.array([[1.0, 0.3], [-0.4, 2.0]])
    mean, half = (first + second).real / 2.0, ((first - second) / 2.0) ** 2
    turn = basis @ np.array([[mean, half.real], [1.0, mean]]) @ np.linalg.inv(basis)
    fixed, state = np.array([1.0, 0.5]), np.array([1.0 + 3e-6, 0.5 - 1e-6])
    states = [fixed + np.linalg.matrix_power(turn, k) @ (state - fixed) for k in range(4)]
    before, last = states[2] - states[1], states[3] - states[2]
    law = Law(3.0 * (first + second).real, 3.0, (first * second).real, *last, *before)
    there = fixed + np.linalg.matrix_power(turn, 3 + times) @ (state - fixed)
    assert states[3] + drawn_near(law, float(times)) == pytest.approx(there, abs=2e-14)
