"""The plain loop of the march over many blocks on one record.

Rows are not kept: what a spectrum asks for is the status, the impacts and the two peaks.  Chatter
comes to rest as soon as that is proved, which leaves out impacts of no effect and no peak.
"""

import math

import numpy as np
from numpy.typing import NDArray

from rocksteady.kernels.compilation import compiled
from rocksteady.kernels.march import march
from rocksteady.kernels.tables import (
    LEAN,
    PEAK_ANGLE,
    PEAK_COLUMNS,
    PEAK_SPEED,
    RATE,
    RESTITUTION,
    ROW_COLUMNS,
    Floats,
    March,
)


@compiled
def record_fates(
    segments: Floats,
    lean: Floats,
    rate: Floats,
    restitution: Floats,
    afterwards: Floats,
    limit: int,
    status: NDArray[np.int64],
    impacts: NDArray[np.int64],
    peaks: Floats,
) -> None:
    """March symmetric blocks from rest through one motion and note how each fares.

    The motion is in units of its own, as seconds and m/s^2, and stays as it is: a block is the
    pair of its uplift acceleration and its p in them.  To scale the motion is to divide the lean.

    Parameters
    ----------
    segments
        Table of the motion, shape (segments, 9); the last segment is a still base without end.
    lean, rate, restitution
        Of each block, shape (blocks,): alpha g over the motion's scale, p, and the restitution.
    afterwards
        Pivot time p t for which each is followed on the still base, shape (blocks,).
    limit
        Flights after which a block is UNDECIDED.
    status, impacts, peaks
        Receive the status code, the number of impacts and, in shape (blocks, 2), the largest
        |theta|/alpha and |d(theta/alpha)/d(p t)| up to the end or the proof of overturning.
    """
    sides = np.zeros((2, 3))
    rows, peak = np.zeros((0, ROW_COLUMNS)), np.zeros(PEAK_COLUMNS)
    for i in range(len(lean)):
        sides[:, RESTITUTION] = restitution[i]
        sides[:, LEAN] = lean[i]
        sides[:, RATE] = rate[i]
        peak[:] = 0.0
        status[i], end = march(
            segments,
            sides,
            March(0, 0.0, 0.0, 0, 0, 0.0, 0, 0),
            0,
            afterwards[i] / rate[i],
            math.inf,
            limit,
            rows,
            peak,
        )
        impacts[i] = end.impacts
        peaks[i, PEAK_ANGLE] = peak[PEAK_ANGLE] / lean[i]
        peaks[i, PEAK_SPEED] = peak[PEAK_SPEED] / (lean[i] * rate[i])
