"""The march: a motion as flights joined by impacts, uplifts and segment ends.

A motion is a table of segments, the block two rows of side parameters (`kernels.core.tables`
has the columns).  Time is kept as (segment, half cycles, phase), read and moved on by
`kernels.core.clock`.  Runs of samples, segments alike without sinusoid, are passed through at
a few products each (`rocksteady.kernels.march._samples`).

The side table says which equation of motion holds (`kernels.core.tables.is_nonlinear`).  A
flight, the proof that chatter dies out and the proof that a block overturns are then those of
`rocksteady.kernels.nonlinear`; a block that stands on its base feels the same kind of forcing in
both models, so that rest and uplift are one.

To record a march, callers run it twice: without rows to count the flights, then into an array of
that size.  A march that stopped at a full buffer and went on would have to restore the state of its
loop, or differ in the last bit.
"""

import numpy as np

from rocksteady.kernels.core.tables import ORDERS, SHARES, Floats, March, is_nonlinear
from rocksteady.kernels.core.tuples import Kept, Tables, Until
from rocksteady.kernels.core.typed import FALSE, TRUE
from rocksteady.kernels.machine_code.compilation import allocating, compiled
from rocksteady.kernels.march._flights import march_in_model
from rocksteady.kernels.nonlinear.series import TERMS, WORK_ROWS


@allocating
def march(tables: Tables, start: March, until: Until, kept: Kept) -> tuple[int, March]:
    """March from `start` to the stop, to overturning, or to the limit.

    Parameters
    ----------
    tables, until, kept
        The motion and the block, where to end, and what to keep: `kernels.core.tuples`.
    start
        Where to begin, within a segment too, as where another march has stopped.  At rest `side` is
        0; a side with angle and velocity 0 is just lifting off.

    Returns
    -------
    tuple
        Status (ROCKING, AT_REST, OVERTURNED, UNDECIDED or LOST_CONTACT) and final state.  Its
        `impacts` counts those of at least COUNTED after impact, on the side the block leaves to.
    """
    columns = tables.segments.shape[1]
    if columns > ORDERS:
        orders = (columns - SHARES) // 2
        work, lifts = np.empty((WORK_ROWS + orders, TERMS)), np.empty((2, orders))
        nonlinear = is_nonlinear(tables.sides)
        return march_in_model(
            tables, start, until, kept, work, lifts, kept.peaks[:0], nonlinear, TRUE
        )
    if is_nonlinear(tables.sides):
        return nonlinear_march(tables, start, until, kept)
    return linear_march(tables, start, until, kept)


@allocating
def linear_march(tables: Tables, start: March, until: Until, kept: Kept) -> tuple[int, March]:
    """March as `march` does in the linear model, on segments without a Fourier series."""
    work, lifts = np.empty((0, TERMS)), np.empty((2, 0))
    return march_in_model(tables, start, until, kept, work, lifts, kept.peaks[:0], FALSE, FALSE)


@allocating
def nonlinear_march(tables: Tables, start: March, until: Until, kept: Kept) -> tuple[int, March]:
    """March as `march` does in the nonlinear model, on segments without a Fourier series."""
    return nonlinear_ride(tables, start, until, kept, np.empty((WORK_ROWS, TERMS)), kept.peaks[:0])


@compiled
def nonlinear_ride(
    tables: Tables, start: March, until: Until, kept: Kept, work: Floats, ride: Floats
) -> tuple[int, March]:
    """March as `nonlinear_march` does, until a flight in samples ends: UNDECIDED, and it is held.

    Parameters are those of `march`, with the working space of a step, and a `ride` of
    `kernels.core.rides`; with an empty one the march goes on.
    """
    return march_in_model(tables, start, until, kept, work, work[:0], ride, TRUE, FALSE)
