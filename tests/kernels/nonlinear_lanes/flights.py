"""Lanes in flight on either side, with the coefficients and the signs of their next step."""

import numpy as np
from numpy.typing import NDArray

from rocksteady.kernels.core.tables import (
    ALPHA,
    LEAN,
    LEFT_OUT,
    NONLINEAR_SIDE_COLUMNS,
    RATE,
    RESTITUTION,
    March,
)
from rocksteady.kernels.nonlinear_lanes._coefficients import expand
from rocksteady.kernels.nonlinear_lanes._layout import LANES, SIZE, TAYLOR, TERMS
from rocksteady.kernels.nonlinear_lanes._signs import count_changes
from rocksteady.kernels.nonlinear_lanes._steps import measure, scale
from rocksteady.kernels.nonlinear_lanes._transfer import load, put_lane

Floats = NDArray[np.float64]

PART = 1e-15
"""What a step leaves out."""


def in_flight(rng: np.random.Generator) -> Floats:
    """Return lanes of random blocks with unlike sides, half of them just off the floor."""
    lanes = np.zeros(SIZE)
    sides = np.ones((2, NONLINEAR_SIDE_COLUMNS))
    sides[:, LEFT_OUT] = PART
    for k in range(LANES):
        sides[:, RESTITUTION] = rng.uniform(0.2, 1.0, 2)
        sides[:, ALPHA] = np.exp(rng.uniform(np.log(0.01), 0.3, 2))
        sides[:, LEAN : RATE + 1] = rng.uniform(0.7, 1.4, (2, 2))
        load(lanes, k, k, rng.uniform(0.0, 8.0), np.exp(rng.uniform(-2.0, 3.0)), sides, 0.0)
        angle = 0.0 if k % 2 else rng.uniform(0.01, 0.8)
        velocity = np.exp(rng.uniform(-6.0, 0.0)) if k % 2 else rng.normal()
        side = 1 if k % 3 else -1
        state = March(side, side * angle, side * velocity, 0, 0, rng.uniform(0.0, 3.14), 0, 0)
        put_lane(lanes, k, state, 1000)
    return lanes


def one_step(lanes: Floats) -> None:
    """Find the step of each lane, and what its signs say."""
    expand(lanes)
    measure(lanes)
    scale(lanes)
    count_changes(lanes)


def field(lanes: Floats, offset: int) -> Floats:
    return lanes[offset : offset + LANES]


def polynomials(lanes: Floats) -> Floats:
    """Return the terms of y at the ends of the steps, shape (terms, lanes)."""
    return lanes[TAYLOR : TAYLOR + TERMS * LANES].reshape(TERMS, LANES)
