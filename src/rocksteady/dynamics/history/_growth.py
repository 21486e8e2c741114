"""Growth of a small initial difference along a time history of the linear model."""

import math

import numpy as np
from numpy.typing import NDArray

from rocksteady.dynamics.history.samples import Impacts
from rocksteady.kernels.core import tables as columns
from rocksteady.kernels.elementary.arrays import exp, log

Floats = NDArray[np.float64]

LARGEST_LOGARITHM = 700.0
"""Of a growth that is still a float."""


def growth_of(
    rows: Floats, sides: Floats, durations: Floats, impacts: Impacts, base: Floats
) -> float:
    """Return the largest factor by which a small difference at the start has grown.

    In a flight of duration t on a side of rate rho differences of angle and velocity follow
    ``[[cosh, sinh/rho], [rho sinh, cosh]]`` of ``rho t``, whatever the base does.  Through an
    impact they follow ``[[r, 0], [(b - r a)/v, r]]``, with the velocity v before it, the
    restitution r, and the block's acceleration a before and b after it.

    Parameters
    ----------
    rows, sides
        Of a time history of the linear model, shapes (flights, 8) and (2, 3).
    durations
        Of the flights, shape (flights,); the last one up to the end of the history.
    impacts
        Those that end a flight.
    base
        The base acceleration at each of them, in alpha g, shape (impacts,).
    """
    turns = _impacts(rows, sides, impacts, base)
    rates = sides[:, columns.RATE].tolist()
    one, other = (1.0, 0.0), (0.0, 1.0)  # images of a unit of angle and of velocity
    gone = largest = 0.0  # logarithms: of what has been divided out, and of the growth
    on = rows[:, columns.ROW_SIDE].astype(int)
    turned = durations * np.where(on > 0, rates[0], rates[1])  # rho t
    flights = zip(on.tolist(), turned.tolist(), exp(-2.0 * turned).tolist(), strict=True)
    for row, (side, turn, left) in enumerate(flights):
        if side == 0:
            one, other, gone = (1.0, 0.0), (0.0, 1.0), 0.0
            continue
        rate = rates[0 if side > 0 else 1]
        # cosh and sinh times exp(-rho t), which is put aside.
        gone += turn
        cosh, sinh = 0.5 * (1.0 + left), 0.5 * (1.0 - left)
        one, other = (
            (cosh * u + sinh / rate * v, rate * sinh * u + cosh * v) for u, v in (one, other)
        )
        if row in turns:
            ratio, kink = turns[row]
            one, other = ((ratio * u, kink * u + ratio * v) for u, v in (one, other))
        (a, b), (c, d) = one, other
        size = math.sqrt(a * a + b * b + c * c + d * d)
        if not 0.0 < size < math.inf:
            return math.inf
        gone += log(size)
        one, other = ((u / size, v / size) for u, v in (one, other))
        largest = max(largest, gone)
    return exp(largest) if largest < LARGEST_LOGARITHM else math.inf


def _impacts(
    rows: Floats, sides: Floats, impacts: Impacts, base: Floats
) -> dict[int, tuple[float, float]]:
    """Return restitution and kink of the impact that ends each row, by the row."""
    ended = np.flatnonzero(rows[:, columns.ROW_EVENT] == columns.ENDED_BY_IMPACT)
    here = np.where(impacts.side > 0, 0, 1)
    before, after = (
        np.square(sides[side, columns.RATE]) * (base - sign * sides[side, columns.LEAN])
        for side, sign in ((here, impacts.side), (1 - here, -impacts.side))
    )
    ratios = sides[here, columns.RESTITUTION]
    with np.errstate(divide="ignore", invalid="ignore"):
        kinks = (after - ratios * before) / impacts.velocity_before
    pairs = zip(ratios.tolist(), kinks.tolist(), strict=True)
    return dict(zip(ended.tolist(), pairs, strict=True))
