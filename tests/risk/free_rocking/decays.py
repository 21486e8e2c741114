"""Made-up free rocking: energy from impact to impact, solved for the angles by bisection."""

import math

import numpy as np
from numpy.typing import NDArray

from rocksteady import Block

Floats = NDArray[np.float64]


def energy(theta: Floats, alpha: float, *, linear: bool = False) -> Floats:
    """Return the energy of a peak over m g R, as the textbook has it."""
    if linear:
        return np.asarray(alpha * theta - 0.5 * theta * theta)
    return np.asarray(np.cos(alpha - theta) - math.cos(alpha))


def decay(
    block: Block, start: float, ratios: NDArray[np.float64], *, linear: bool = False
) -> Floats:
    """Return the peaks [rad], shape (impacts + 1,), of restitutions that are given one by one.

    The first peak is on the positive side; sides alternate.  Rotation about a pivot keeps
    ``omega^2/2 = p^2 energy``, and each impact multiplies omega.
    """
    sides = block.positive, block.negative
    peaks = [start]
    omega = math.sqrt(2.0 * energy(np.array(start), sides[0].alpha, linear=linear)) * sides[0].p
    for number, ratio in enumerate(ratios.tolist(), 1):
        omega *= ratio
        side = sides[number % 2]
        low, high = 0.0, side.alpha
        for _ in range(200):
            middle = 0.5 * (low + high)
            reached = side.p**2 * energy(np.array(middle), side.alpha, linear=linear)
            low, high = (middle, high) if reached < 0.5 * omega * omega else (low, middle)
        peaks.append(0.5 * (low + high))
    return np.array(peaks)
