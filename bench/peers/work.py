"""What every solver is given and what it has to bring back.

A module of this folder stands for one solver. Its ``peers()`` sets the solver up, compilation
included, and returns one `Peer` for each way in which it is run; it raises ImportError where the
package is not installed.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rocksteady.outcomes import Status

SIDE = 100  # cells along either axis of the whole map
CYCLES = 200
RESTITUTION = 0.8
START_VELOCITY = 0.3  # d(theta/alpha)/d(pt), at angle 0 and phase 0
SLOW = 1e-8  # velocity after an impact below which a bounce counts as rest, with the base calm
TURN = 2.0 * math.pi
LINEAR = 0.0  # the alpha that stands for the linear model
ALPHA = 0.2  # of the blocks in the nonlinear one

ROCKING = int(Status.ROCKING)
AT_REST = int(Status.AT_REST)
OVERTURNED = int(Status.OVERTURNED)


class Cells(NamedTuple):
    """Cells of the map, shape (cells,)."""

    amplitude: NDArray[np.float64]
    frequency_ratio: NDArray[np.float64]
    index: NDArray[np.int64]  # in the whole map


@dataclass(frozen=True, kw_only=True)
class Outcome:
    """How the cells end, and the CPU time that it took."""

    status: NDArray[np.int64]
    impacts: NDArray[np.int64]
    last_phase: NDArray[np.float64] | None  # of the last impact, in [0, 2 pi); NaN without one
    seconds: float
    remark: str = ""
    final: NDArray[np.float64] | None = None  # of the package: angle, velocity, phase at the end


@dataclass(frozen=True, kw_only=True)
class Peer:
    """One solver with its settings."""

    name: str
    version: str
    settings: str
    thinned: int  # it runs every so many-th cell of either axis
    run: Callable[[Cells], Outcome]
    # What decides whether a class is right, where it is the equation of this solver alone.
    truth: Callable[[Cells], Outcome] | None = None


def cells(thinned: int = 1) -> Cells:
    """Return every so many-th cell of either axis of B1."""
    index = np.arange(SIDE)[::thinned]
    frequency_ratio, amplitude = np.meshgrid(
        np.linspace(1.0, 12.0, SIDE)[index], np.linspace(1.0, 6.0, SIDE)[index]
    )
    return Cells(
        amplitude.ravel(), frequency_ratio.ravel(), (SIDE * index[:, None] + index).ravel()
    )


def lost_angle(amplitude: float, alpha: float) -> float:
    """Return the angle over alpha from which a rising block can never come back."""
    if alpha == LINEAR:
        return 1.0 + amplitude
    return 1.0 + math.atan(alpha * amplitude) / alpha


def uplift_share(alpha: float) -> float:
    """Return the factor of an amplitude that makes the uplift of a block happen at 1."""
    return 1.0 if alpha == LINEAR else alpha / math.tan(alpha)


def uplift(amplitude: float, tau: float) -> tuple[float, int]:
    """Return when (in Omega s) a block at rest lifts next, and on which side it then stands.

    The amplitude is over that of uplift.
    """
    if amplitude <= 1.0:
        return math.inf, 1
    rise = math.asin(1.0 / amplitude)
    phase = tau % TURN
    if amplitude * abs(math.sin(phase)) >= 1.0:
        return tau, 1 if math.sin(phase) > 0.0 else -1
    right, left = (rise - phase) % TURN, (rise + math.pi - phase) % TURN
    return (tau + right, 1) if right < left else (tau + left, -1)
