"""The march: a motion as flights joined by impacts, uplifts and segment ends.

A motion is a table of segments, the block two rows of side parameters (`kernels.core.tables`
has the columns).  Time is kept as (segment, half cycles, phase), read and moved on by
`kernels.core.clock`.  Runs of samples, segments alike without sinusoid, are passed through at
a few products each (`rocksteady.kernels.march._samples`).

The side table says which equation of motion holds (`kernels.core.tables.is_nonlinear`).  A
flight, the proof that chatter dies out and the proof that a block overturns are then those of
`rocksteady.kernels.nonlinear`; a block that stands on its base feels the same kind of forcing in
both models, so that rest and uplift are one.
"""

import numpy as np

from rocksteady.kernels.core.tables import (
    ORDERS,
    SHARES,
    March,
    is_nonlinear,
)
from rocksteady.kernels.core.typed import FALSE, TRUE
from rocksteady.kernels.machine_code.compilation import allocating
from rocksteady.kernels.machine_code.types import Floats1, Floats2
from rocksteady.kernels.march._flights import march_in_model
from rocksteady.kernels.nonlinear.series import TERMS, WORK_ROWS


@allocating
def march(
    segments: Floats2,
    sides: Floats2,
    start: March,
    stop_half_cycles: int,
    stop_phase: float,
    rest_velocity: float,
    limit: int,
    rows: Floats2,
    peaks: Floats1,
) -> tuple[int, March]:
    """March from `start` to the stop, to overturning, or to the limit.

    Parameters
    ----------
    segments, sides
        Tables of shape (segments, 9) and (2, 3); of the nonlinear model (segments, 12) and (2, 5);
        of either with a Fourier series of so many orders (segments, 13 + 2 orders);
        sides of either with restitution that scatters (2, 7).
    start
        Where to begin, within a segment too, as where another march has stopped.  At rest `side` is
        0; a side with angle and velocity 0 is just lifting off.
    stop_half_cycles, stop_phase
        The clock reading on the last segment at which the run ends, where that is endless.
    rest_velocity
        Chatter slower than this, in du/d(pt) with the alpha and p of either side, ends in rest as
        soon as the bound of `rocksteady.kernels.march.rest` proves that it does.  From COUNTED on,
        impacts on a still base are counted without flights; those left out on a moving base are
        not.  If infinite, impacts slower than COUNTED count too.
    limit
        Flights and rests after which the march gives up as UNDECIDED, as it does before a
        nonlinear flight whose steps come to nothing (`kernels.nonlinear.flight.is_stuck`).  A still
        base on which the bounces before are proved to die out decides.
    rows
        Array of shape (flights, 8) that receives the flights, as many as a first march without
        rows (0, 8) has counted: a march does not depend on whether it is recorded.
    peaks
        Array of shape (2,) in which the largest |theta|/alpha of either side and the largest
        |velocity| are kept, those that it comes with included, up to the end or the proof of
        overturning; or of shape (0,).  In shape (11,) they are followed by what
        `kernels.core.tables.keep_passage` keeps.

    Returns
    -------
    tuple
        Status (ROCKING, AT_REST, OVERTURNED, UNDECIDED or LOST_CONTACT) and final state.  Its
        `impacts` counts those of at least COUNTED after impact, on the side the block leaves to.
    """
    if segments.shape[1] > ORDERS:
        orders = (segments.shape[1] - SHARES) // 2
        return march_in_model(
            segments,
            sides,
            start,
            stop_half_cycles,
            stop_phase,
            rest_velocity,
            limit,
            rows,
            peaks,
            np.empty((WORK_ROWS + orders, TERMS)),
            np.empty((2, orders)),
            is_nonlinear(sides),
            TRUE,
        )
    if is_nonlinear(sides):
        return nonlinear_march(
            segments, sides, start, stop_half_cycles, stop_phase, rest_velocity, limit, rows, peaks
        )
    return linear_march(
        segments, sides, start, stop_half_cycles, stop_phase, rest_velocity, limit, rows, peaks
    )


@allocating
def linear_march(
    segments: Floats2,
    sides: Floats2,
    start: March,
    stop_half_cycles: int,
    stop_phase: float,
    rest_velocity: float,
    limit: int,
    rows: Floats2,
    peaks: Floats1,
) -> tuple[int, March]:
    """March as `march` does in the linear model, on segments without a Fourier series."""
    return march_in_model(
        segments,
        sides,
        start,
        stop_half_cycles,
        stop_phase,
        rest_velocity,
        limit,
        rows,
        peaks,
        np.empty((0, TERMS)),
        np.empty((2, 0)),
        FALSE,
        FALSE,
    )


@allocating
def nonlinear_march(
    segments: Floats2,
    sides: Floats2,
    start: March,
    stop_half_cycles: int,
    stop_phase: float,
    rest_velocity: float,
    limit: int,
    rows: Floats2,
    peaks: Floats1,
) -> tuple[int, March]:
    """March as `march` does in the nonlinear model, on segments without a Fourier series."""
    return march_in_model(
        segments,
        sides,
        start,
        stop_half_cycles,
        stop_phase,
        rest_velocity,
        limit,
        rows,
        peaks,
        np.empty((WORK_ROWS, TERMS)),
        np.empty((2, 0)),
        TRUE,
        FALSE,
    )
