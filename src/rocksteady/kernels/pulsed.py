"""The plain loop of the march over many sizes and frequencies of one pulse, up to its fate.

The pulse stays as it is, of amplitude 1 and frequency ratio 1: to make it a times as strong is to
divide the block's lean by a, to make it w times as fast to divide the block's rate by w.

**The fate after the pulse, in closed form.**  Each march ends with the pulse, and what follows on
the still base needs none.  From an angle y and a velocity v on a side, in its own units, the
coefficient of e^s is ``(y + v - 1)/2``: where it is above 0 the block never comes back.  Where it
is below 0 the block lands with ``sqrt(v^2 + y (2 - y))``, because ``v^2 - (1 - y)^2`` is kept, and
leaves that impact with a part of it, from y = 0: it overturns on the other side where that is above
1.  Where it is not, the next landing is at the speed of that launch and its own launch slower by
the restitution, in the units of the first side.  Of a symmetric block that is below 1; of one whose
sides differ it may be above.  After these two no later one is faster than the one before it on the
same side.

**The margin** is the largest of y + v - 1 and of the two launches less 1: the block overturns where
it is above 0.  It does not depend on when the pulse is said to end, nor jumps where an impact moves
past that end or where a flight grazes the floor: over the amplitude it is continuous, and fates
change where it is zero.
"""

import math

import numpy as np
from numpy.typing import NDArray

from rocksteady.kernels.clock import segment_start
from rocksteady.kernels.compilation import compiled
from rocksteady.kernels.march import march
from rocksteady.kernels.tables import (
    AT_REST,
    LEAN,
    OVERTURNED,
    RATE,
    RESTITUTION,
    ROCKING,
    ROW_COLUMNS,
    Floats,
    March,
)


@compiled
def pulse_fates(
    segments: Floats,
    sides: Floats,
    amplitude: Floats,
    frequency_ratio: Floats,
    rest_velocity: float,
    limit: int,
    status: NDArray[np.int64],
    impacts: NDArray[np.int64],
    side: NDArray[np.int64],
    during: NDArray[np.int64],
    margin: Floats,
) -> None:
    """March a block from rest through a pulse of many sizes and note what becomes of it.

    Parameters
    ----------
    segments
        Table of the pulse of amplitude 1 and frequency ratio 1, shape (segments, 9), without the
        still base that follows it.
    sides
        Of the block, shape (2, 3).
    amplitude, frequency_ratio
        Of the pulse, above 0, shape (cells,).
    rest_velocity
        Chatter slower than this, in the block's units, comes to rest as soon as that is proved.
    limit
        Flights after which a cell is UNDECIDED.
    status
        Receives AT_REST for whatever does not overturn, OVERTURNED or UNDECIDED.
    impacts, side
        Receive the impacts until overturning and its side; of what does not overturn, the impacts
        while the pulse lasts, and 0.
    during
        Receives ``3 n + 1 + side`` of the n impacts and the side (or rest, 0) at the pulse's end.
    margin
        Receives how far beyond (above 0) or short of overturning the block is; nan if undecided.
    """
    own = np.zeros((2, 3))
    rows, peaks = np.zeros((0, ROW_COLUMNS)), np.zeros(0)
    half, phase = segment_start(segments, 0)
    for i in range(len(amplitude)):
        lean, rate = 1.0 / amplitude[i], 1.0 / frequency_ratio[i]
        for row in range(2):
            own[row, RESTITUTION] = sides[row, RESTITUTION]
            own[row, LEAN] = sides[row, LEAN] * lean
            own[row, RATE] = sides[row, RATE] * rate
        code, end = march(
            segments,
            own,
            March(0, 0.0, 0.0, 0, half, phase, 0, 0),
            0,
            0.0,
            rest_velocity * lean * rate,
            limit,
            rows,
            peaks,
        )
        status[i] = AT_REST
        impacts[i] = end.impacts
        side[i] = 0
        during[i] = 3 * end.impacts + 1 + end.side
        margin[i] = -1.0
        if code == AT_REST:
            continue
        if code not in (ROCKING, OVERTURNED):
            status[i] = code
            margin[i] = math.nan
            continue
        here = 0 if end.side > 0 else 1
        unit, other = own[here, LEAN] * own[here, RATE], own[1 - here, LEAN] * own[1 - here, RATE]
        angle = end.side * end.angle / own[here, LEAN]
        velocity = end.side * end.velocity / unit
        rising = angle + velocity - 1.0
        if code == OVERTURNED or rising > 0.0:
            status[i] = OVERTURNED
            side[i] = end.side
            margin[i] = rising
            continue
        landing = math.sqrt(max(velocity * velocity + angle * (2.0 - angle), 0.0))
        first = sides[here, RESTITUTION] * landing * unit / other
        second = sides[1 - here, RESTITUTION] * first * other / unit
        margin[i] = max(rising, first - 1.0, second - 1.0)
        if margin[i] > 0.0:
            status[i] = OVERTURNED
            impacts[i] = end.impacts + (1 if first > 1.0 else 2)
            side[i] = -end.side if first > 1.0 else end.side
