"""Returns to an orbit: from where Newton's method leads to it."""

import math

import numpy as np

from rocksteady.kernels.batch.recurrence import (
    PHASE_BEFORE,
    PHASE_THEN,
    RETURN_COLUMNS,
    VELOCITY_BEFORE,
    VELOCITY_THEN,
    WITHIN,
    in_reach,
)
from rocksteady.kernels.orbits.periodic import Fixed
from rocksteady.kernels.orbits.return_map import Jacobian, Section
from rocksteady.kernels.orbits.settle import Near
from tests.every import every
from tests.kernels.passages import even_system
from tests.strategies import sample_size


@every(
    ("apart", "bent", "reached"),
    [
        (0.9, 0.0, True),
        (0.9, 0.09, True),
        (0.9, 0.11, False),
        (0.1, 0.09, True),
        (0.1, 0.11, False),
        (1.1, 0.0, False),
        (1e-7, 10.0, True),
        (1e-7, 1000.0, False),
    ],
)
def test_newton_leads_where_what_bends_the_map_displaces_its_fixed_point_little(
    apart: float, bent: float, reached: bool
) -> None:
    """`bent` is the displacement in parts of the distance, that in parts of `WITHIN`."""
    rng = np.random.default_rng(3)
    system = even_system(2.0, 4.0, 0.8)
    for _ in range(sample_size(200, 40)):
        side, phase = rng.choice([-1, 1]), rng.uniform(0.0, 3.0)
        speed = 10.0 ** rng.uniform(-2.0, 1.0)
        basis = rng.normal(size=(2, 2))
        unit = np.array([1.0, speed])
        turn = basis @ np.diag(rng.uniform(-0.8, 0.8, 2)) @ np.linalg.inv(basis)
        directions = rng.uniform(-1.0, 1.0, (2, 2))
        then, off = directions / np.abs(directions).max(axis=1, keepdims=True)
        then *= apart * WITHIN
        off *= bent * apart * WITHIN
        # then = turn @ before + (1 - turn) @ off: its fixed point is `off`, not the orbit.
        before = np.linalg.solve(turn, then - off + turn @ off)
        orbit = Section(int(side), 0 if side > 0 else 1, phase, speed)
        (a, b), (c, d) = (turn * unit[:, np.newaxis] / unit).tolist()
        fixed = Fixed(True, 0.0, Jacobian(a, b, c, d), 0, 0)
        returns = np.zeros((2, RETURN_COLUMNS))
        turns = 2.0 * math.pi * rng.integers(-1, 2, 2)
        returns[1, [PHASE_THEN, VELOCITY_THEN]] = (phase + turns[0], speed) + unit * then
        returns[1, [PHASE_BEFORE, VELOCITY_BEFORE]] = (phase + turns[1], speed) + unit * before
        if np.abs(before[0]) < 3.0:
            assert in_reach(returns, 1, system, Near(True, orbit, 0.8, fixed)) is reached
