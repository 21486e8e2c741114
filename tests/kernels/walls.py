"""Blocks against a wall: tables of their sides, and an integrator that knows nothing of kernels."""

import math
from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from rocksteady.kernels.core.tables import (
    ALPHA,
    LEFT_OUT,
    NONLINEAR_SEGMENT_COLUMNS,
    NONLINEAR_SIDE_COLUMNS,
    SEGMENT_COLUMNS,
    SIDE_COLUMNS,
)
from tests.kernels.tables import Piece

Floats = NDArray[np.float64]
Pull = Callable[[float, float], float]

TINY = 1e-4
"""Length of the first step of a flight, a Taylor polynomial that leaves the zero at its start."""
SLOWEST = 1e-2
"""Of a bounce that the integrator still follows: the flight is a hundred times that step."""


def against_wall(
    restitution: float, lean: float = 1.0, rate: float = 1.0, *, free: int = 1
) -> Floats:
    """Return the sides of a block against a wall, shape (2, 3), as blocks of the package have."""
    sides = np.array([[-restitution, lean, rate], [1.0, 1.0, 1.0]])
    return sides if free > 0 else sides[::-1].copy()


def in_model(segments: Floats, sides: Floats, alpha: float) -> tuple[Floats, Floats]:
    """Return tables of the linear model as they are (alpha 0), or those of the nonlinear one."""
    if alpha == 0.0:
        return segments, sides
    wide = np.zeros((len(segments), NONLINEAR_SEGMENT_COLUMNS))
    wide[:, :SEGMENT_COLUMNS] = segments
    more = np.zeros((2, NONLINEAR_SIDE_COLUMNS))
    more[:, :SIDE_COLUMNS] = sides
    more[:, ALPHA], more[:, LEFT_OUT] = alpha, 1e-15
    return wide, more


def integrated_bounces(
    pieces: Sequence[Piece],
    until: float,
    *,
    velocity: float,
    restitution: float,
    lean: float = 1.0,
    rate: float = 1.0,
    alpha: float = 0.0,
) -> list[tuple[float, float]]:
    """Return times and velocities after impacts on the wall, by Runge-Kutta of order 8.

    It ends with the first bounce slower than `SLOWEST`.  With `alpha` 0 the model is linear.
    """
    impacts: list[tuple[float, float]] = []
    angle, begin = 0.0, 0.0
    for piece in pieces:
        if begin >= until:
            break
        pull = pull_of(piece, lean, rate, alpha)
        tilt = alpha * (1.0 - angle / lean)
        velocity += piece.jump * rate * rate * math.cos(tilt)
        now, end = 0.0, min(piece.duration, until - begin)
        while now < end:
            if angle == 0.0:
                now, angle, velocity = first_step(pull, now, velocity, min(TINY, end - now))
            fallen, now, angle, velocity = flown(pull, now, end, angle, velocity)
            if fallen:
                return impacts
            if angle == 0.0:
                velocity *= -restitution
                impacts.append((begin + now, velocity))
                if velocity < SLOWEST:
                    return impacts
        begin += piece.duration
    return impacts


def pull_of(piece: Piece, lean: float, rate: float, alpha: float) -> Pull:
    """Return the angular acceleration by time and angle, in reference units."""

    def pull(time: float, angle: float) -> float:
        base, y = piece.base(time) / lean, angle / lean
        tilt = alpha * (1.0 - y)
        held = math.sin(tilt) / alpha if alpha > 0.0 else 1.0 - y
        return lean * rate * rate * (base * math.cos(tilt) - held)

    return pull


def first_step(
    pull: Pull, now: float, velocity: float, length: float
) -> tuple[float, float, float]:
    """Return time, angle and velocity after a short step from angle 0."""
    here = pull(now, 0.0)
    bend = (pull(now + length, length * velocity) - here) / length
    angle = length * (velocity + length * (here / 2.0 + length * bend / 6.0))
    return now + length, angle, velocity + length * (here + length * bend / 2.0)


def flown(
    pull: Pull, now: float, end: float, angle: float, velocity: float
) -> tuple[bool, float, float, float]:
    """Return whether a block falls, and time, angle and velocity at its landing or at the end."""

    def landing(_time: float, state: Floats) -> float:
        return float(state[0])

    def far(_time: float, state: Floats) -> float:
        return float(state[0]) - 8.0

    landing.terminal = far.terminal = True  # type: ignore[attr-defined]
    landing.direction = -1.0  # type: ignore[attr-defined]
    run = solve_ivp(
        lambda time, state: [state[1], pull(time, state[0])],
        (now, end),
        [angle, velocity],
        method="DOP853",
        rtol=1e-12,
        atol=1e-14,
        events=(landing, far),
        max_step=0.05,
    )
    assert run.t_events is not None
    assert run.y_events is not None
    if len(run.t_events[0]):
        return False, float(run.t_events[0][0]), 0.0, float(run.y_events[0][0][1])
    return len(run.t_events[1]) > 0, end, float(run.y[0, -1]), float(run.y[1, -1])
