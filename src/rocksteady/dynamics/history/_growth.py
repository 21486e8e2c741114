"""How a small difference at the start of a time history grows, in the linear model."""

import math
from typing import TYPE_CHECKING

import numpy as np

from rocksteady.kernels.core import tables as columns
from rocksteady.model.motions.segments import Harmonic

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from rocksteady.dynamics.history.trajectory import Trajectory

    Floats = NDArray[np.float64]

LARGEST_LOGARITHM = 700.0
"""Of a growth that is still a float."""


def growth_of(run: "Trajectory") -> float:
    """Return the largest factor by which a small difference at the start has grown.

    In a flight of duration t on a side of rate rho differences of angle and velocity follow
    ``[[cosh, sinh/rho], [rho sinh, cosh]]`` of ``rho t``, whatever the base does.  Through an
    impact they follow ``[[r, 0], [(b - r a)/v, r]]``, with the velocity v before it, the
    restitution r, and the block's acceleration a before and b after it.

    Parameters
    ----------
    run
        A time history of the linear model.
    """
    durations = run.rows[:, columns.ROW_DURATION].copy()
    durations[-1] = run._last_duration
    turns = _impacts(run)
    rates = run.sides[:, columns.RATE].tolist()
    one, other = (1.0, 0.0), (0.0, 1.0)  # images of a unit of angle and of velocity
    gone = largest = 0.0  # logarithms: of what has been divided out, and of the growth
    sides = run.flights.side.tolist()
    for row, (side, duration) in enumerate(zip(sides, durations.tolist(), strict=True)):
        if side == 0:
            one, other, gone = (1.0, 0.0), (0.0, 1.0), 0.0
            continue
        rate = rates[0 if side > 0 else 1]
        # cosh and sinh times exp(-rho t), which is put aside.
        gone += rate * duration
        left = math.exp(-2.0 * rate * duration)
        cosh, sinh = 0.5 * (1.0 + left), 0.5 * (1.0 - left)
        one, other = (
            (cosh * u + sinh / rate * v, rate * sinh * u + cosh * v) for u, v in (one, other)
        )
        if row in turns:
            ratio, kink = turns[row]
            one, other = ((ratio * u, kink * u + ratio * v) for u, v in (one, other))
        size = math.hypot(*one, *other)
        if not 0.0 < size < math.inf:
            return math.inf
        gone += math.log(size)
        one, other = ((u / size, v / size) for u, v in (one, other))
        largest = max(largest, gone)
    return math.exp(largest) if largest < LARGEST_LOGARITHM else math.inf


def _impacts(run: "Trajectory") -> dict[int, tuple[float, float]]:
    """Return restitution and kink of the impact that ends each row, by the row."""
    impacts = run.impacts
    rows = np.flatnonzero(run.rows[:, columns.ROW_EVENT] == columns.ENDED_BY_IMPACT)
    if isinstance(run.motion, Harmonic):  # the clock keeps its digits in long runs
        sign = np.where(impacts.half_cycles % 2 == 0, 1.0, -1.0)
        base = run.motion.amplitude * sign * np.sin(impacts.phase)
    else:
        base = run.base_acceleration(impacts.s)
    here = np.where(impacts.side > 0, 0, 1)
    before, after = (
        run.sides[side, columns.RATE] ** 2 * (base - sign * run.sides[side, columns.LEAN])
        for side, sign in ((here, impacts.side), (1 - here, -impacts.side))
    )
    ratios = run.sides[here, columns.RESTITUTION]
    with np.errstate(divide="ignore", invalid="ignore"):
        kinks = (after - ratios * before) / impacts.velocity_before
    pairs = zip(ratios.tolist(), kinks.tolist(), strict=True)
    return dict(zip(rows.tolist(), pairs, strict=True))
