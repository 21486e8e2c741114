"""About a hundred closed-form solutions, checked by marches and by eq 7 in a sweep."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rocksteady import DimensionlessBlock, Harmonic, State, simulate
from rocksteady.arrays import Floats
from rocksteady.kernels.elementary.arrays import cos, cosh, sin, sinh
from rocksteady.orbits import SteadyStates, compute_steady_orbit
from rocksteady.sweeps import Axis

LONGEST = 8.0
"""Half cycles in pivot time that are marched from start to end."""


@dataclass(frozen=True, kw_only=True)
class Solution:
    """A symmetric steady state at a point.

    Attributes
    ----------
    amplitude, frequency_ratio, restitution, order
        The point.
    branch
        1 or 2.
    phase, velocity_tau
        Phase and du/d(omega t) of the state after the impact.
    """

    amplitude: float
    frequency_ratio: float
    restitution: float
    order: int
    branch: int
    phase: float
    velocity_tau: float


def followable(states: SteadyStates) -> Axis:
    """Return some hundred admissible solutions that a march can follow, as an axis."""
    assert states.admissible is not None
    # In pt a flight multiplies every rounding by exp(length): longer ones cannot be followed.
    short = states.order * math.pi / states.frequency_ratio < LONGEST
    some = np.argwhere(states.admissible & short)[:: len(states.region) // 500].tolist()
    solutions = [
        Solution(
            amplitude=float(states.amplitude[point]),
            frequency_ratio=float(states.frequency_ratio[point]),
            restitution=float(states.restitution[point]),
            order=int(states.order[point]),
            branch=which + 1,
            phase=float(states.phase[which, point]),
            velocity_tau=float(states.velocity_tau[which, point]),
        )
        for which, point in some
    ]
    names = [f"branch {which + 1} at point {point}" for which, point in some]
    return Axis(name="solution", values=names, items=solutions)


def landed(solution: NDArray[Any]) -> dict[str, Floats]:
    """March from solutions to their first impacts, and return how these miss what they should be.

    Parameters
    ----------
    solution
        Some of them, shape (cells,).

    Returns
    -------
    dict
        ``late``: by how much tau at the impact is not n pi, times the velocity; ``fast``: by how
        much the velocity before it is not -v/delta, relative to v.
    """
    late, fast = np.empty(len(solution)), np.empty(len(solution))
    for cell, point in enumerate(solution):
        w = point.frequency_ratio
        run = simulate(
            DimensionlessBlock(restitution=point.restitution),
            Harmonic(amplitude=point.amplitude, frequency_ratio=w, phase=point.phase),
            start=State.per_tau(angle=0.0, velocity_tau=point.velocity_tau, frequency_ratio=w),
            cycles=point.order,
        )
        # Velocities next to 0 lose digits to rounding, as those of all impacts that graze do.
        scale = max(point.velocity_tau, 1e-3)
        late[cell] = abs(float(run.impacts.pt[0]) * w - point.order * math.pi) * min(1.0, scale)
        before = float(run.impacts.velocity_before[0]) / w
        fast[cell] = abs(before + point.velocity_tau / point.restitution) / scale
    return {"late": late, "fast": fast}


def differing(solution: NDArray[Any]) -> dict[str, Floats]:
    """Evaluate (7) with (14), (15) over half cycles, and compare with the package's orbits.

    Parameters
    ----------
    solution
        Some of them, shape (cells,).

    Returns
    -------
    dict
        ``apart``: largest difference of theta/alpha.
    """
    apart = np.empty(len(solution))
    for cell, point in enumerate(solution):
        a, w = point.amplitude, point.frequency_ratio
        orbit = compute_steady_orbit(
            a, w, point.restitution, order=point.order, branch=point.branch, samples=201
        )
        tau = orbit.tau[:101]
        beta = a / (1.0 + w * w)
        sinh_part = w * (point.velocity_tau + beta * cos(point.phase))  # (14)
        cosh_part = beta * sin(point.phase) - 1.0  # (15)
        angle = (
            sinh_part * sinh(tau / w)
            + cosh_part * cosh(tau / w)
            + 1.0
            - beta * sin(tau + point.phase)
        )
        apart[cell] = np.abs(angle - orbit.angle[:101]).max()
    return {"apart": apart}
