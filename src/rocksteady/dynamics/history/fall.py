"""Fall of a block from the end of its time history down to the ground."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.dynamics.history import base_motion
from rocksteady.dynamics.history.trajectory import Trajectory
from rocksteady.kernels.core import tables as columns
from rocksteady.model.motions.fourier import PeriodicMotion
from rocksteady.outcomes import Status

FLAT = 0.5 * math.pi
"""|theta| at which a block lies on its side [rad]."""
LONGEST_STEP = 1.0 / 128.0
"""Pivot time of a step; shorter where the base shakes quickly."""
STEPS_A_PERIOD = 64
MOST_STEPS = 20_000
"""Steps after which a fall is given up."""
TOGETHER = 256
"""Steps for which the accelerations of the base are computed together."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Fall:
    """Rotation of a block between the end of its time history and the ground.

    Attributes
    ----------
    pt
        Pivot times, the first at the end of the history, the last when the block lies.
    theta
        Rotation at these times [rad].
    rate
        d(theta)/d(pt) at these times [rad].
    """

    pt: Floats
    theta: Floats
    rate: Floats

    @property
    def lands_pt(self) -> float:
        """Pivot time at which the block lies on the ground."""
        return float(self.pt[-1])

    def __call__(self, pt: ArrayLike) -> Floats:
        """Return the rotation [rad] at pivot times after the end of the history."""
        times = np.asarray(pt, dtype=np.float64)
        if len(self.pt) == 1:
            return np.full(times.shape, self.theta[-1])
        index = np.clip(np.searchsorted(self.pt, times) - 1, 0, len(self.pt) - 2)
        step = self.pt[index + 1] - self.pt[index]
        part = np.clip((times - self.pt[index]) / step, 0.0, 1.0)
        ends = self.theta[index], self.theta[index + 1]
        return _cubic(part, ends, (step * self.rate[index], step * self.rate[index + 1]))


def fall_to_ground(trajectory: Trajectory, alpha: float) -> Fall | None:
    r"""Return how a block that overturns falls from the end of its history to the ground.

    A history ends when the fall is certain, in the air.  From its last state on the block turns
    about the same edge by the full equation of motion, whichever model the history has:

    .. math:: \theta'' = \rho^2 [-\sigma (1 + a_v/g) \sin(\alpha_\sigma - \sigma\theta)
              + \alpha a \cos(\alpha_\sigma - \sigma\theta)]

    with a prime for d/d(pt), the side :math:`\sigma`, its slenderness :math:`\alpha_\sigma` and its
    rate :math:`\rho` over the reference rate, and the base acceleration a in units of
    :math:`\alpha g`.  It lies where :math:`|\theta| = \pi/2`, with no bounce.  The equation is
    integrated by the classical Runge-Kutta method of order 4, each step within one segment of the
    base motion.

    Parameters
    ----------
    trajectory
        Time history.
    alpha
        Slenderness of the positive side [rad], which a dimensionless block does not have.

    Returns
    -------
    Fall or None
        None where the block does not overturn; and where the full equation does not take it to
        the ground, which may be so after a history of the linear model.
    """
    if trajectory.status is not Status.OVERTURNED:
        return None
    last = trajectory(trajectory.end_time_pt)
    side = 1 if last.angle > 0.0 else -1
    row = trajectory.sides[0 if side > 0 else 1]
    lean, square = alpha * float(row[columns.LEAN]), float(row[columns.RATE]) ** 2
    turned, rate = side * float(last.angle) * alpha, side * float(last.velocity) * alpha
    times, angles, rates = [trajectory.end_time_pt], [turned], [rate]

    def pull(y: float, across: float, up: float) -> float:
        """Return y'', seen from the side, under accelerations in radians and in g."""
        return square * (across * math.cos(lean - y) - (1.0 + up) * math.sin(lean - y))

    while 0.0 < turned < FLAT:
        if len(times) > MOST_STEPS:
            return None
        steps, across, up, jumps = _accelerations(trajectory, times[-1])
        if len(times) == 1:  # what strikes at the very end of the history has struck in it
            jumps[0] = 0.0
        across, jumps = side * alpha * across, side * alpha * jumps
        for k, step in enumerate(np.diff(steps).tolist()):
            first, middle, end = zip(across[k].tolist(), up[k].tolist(), strict=True)
            half = 0.5 * step
            if jumps[k] != 0.0:  # two rates at one time
                rate += square * float(jumps[k]) * math.cos(lean - turned)
                times.append(times[-1])
                angles.append(turned)
                rates.append(rate)
            a = pull(turned, *first)
            b = pull(turned + half * rate, *middle)
            c = pull(turned + half * (rate + half * a), *middle)
            d = pull(turned + step * (rate + half * b), *end)
            turned += step * (rate + step * (a + b + c) / 6.0)
            rate += step * (a + 2.0 * b + 2.0 * c + d) / 6.0
            times.append(float(steps[k + 1]))
            angles.append(turned)
            rates.append(rate)
            if not 0.0 < turned < FLAT:
                break
    if not turned >= FLAT:
        return None
    fall = Fall(pt=np.array(times), theta=side * np.array(angles), rate=side * np.array(rates))
    return _landed(fall, side)


def _accelerations(trajectory: Trajectory, start: float) -> tuple[Floats, Floats, Floats, Floats]:
    """Return times of steps, and what the base does in them.

    The accelerations across and upwards are those at the beginning, in the middle and at the end
    of each step, shape (steps, 3); the jumps are the changes of velocity at its beginning.
    """
    table, longest = trajectory.segments, LONGEST_STEP
    if isinstance(trajectory.motion, PeriodicMotion):
        orders = max(1.0, (table.shape[1] - columns.SHARES) // 2)
        quickest = table[0, columns.FREQUENCY] * orders
        longest = min(longest, 2.0 * math.pi / (quickest * STEPS_A_PERIOD))
    even = start + longest * np.arange(TOGETHER + 1)
    starts = base_motion.segment_starts(table)
    within = starts[(starts > even[0]) & (starts < even[-1])]
    steps = np.union1d(even, within)
    first = np.searchsorted(starts, steps[:-1], side="right") - 1
    index = np.repeat(first, 3)
    middles = 0.5 * (steps[:-1] + steps[1:])
    places = np.column_stack([steps[:-1], middles, steps[1:]]).ravel()
    across, up = base_motion.accelerations_in(table, starts, index, places)
    jumps = np.where(starts[first] == steps[:-1], table[first, columns.JUMP], 0.0)
    return steps, across.reshape(-1, 3), up.reshape(-1, 3), jumps


def _landed(fall: Fall, side: int) -> Fall:
    """Return a fall cut off where the block lies."""
    if len(fall.pt) == 1:
        return Fall(pt=fall.pt, theta=np.array([side * FLAT]), rate=fall.rate)
    low, high = fall.pt[-2], fall.pt[-1]
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if abs(fall(middle)) >= FLAT else (middle, high)
    span = fall.pt[-1] - fall.pt[-2]
    part = (high - fall.pt[-2]) / span
    rate = fall.rate[-2] + part * (fall.rate[-1] - fall.rate[-2])
    return Fall(
        pt=np.append(fall.pt[:-1], high),
        theta=np.append(fall.theta[:-1], side * FLAT),
        rate=np.append(fall.rate[:-1], rate),
    )


def _cubic(part: Floats, ends: tuple[Floats, Floats], slopes: tuple[Floats, Floats]) -> Floats:
    """Return the cubic with given ends and slopes over [0, 1]."""
    rest = 1.0 - part
    value: Floats = (
        (1.0 + 2.0 * part) * rest * rest * ends[0]
        + (1.0 + 2.0 * rest) * part * part * ends[1]
        + part * rest * (rest * slopes[0] - part * slopes[1])
    )
    return value
