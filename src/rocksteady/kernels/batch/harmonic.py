"""Fates of many blocks under periodic shaking: a loop of the march over independent cells.

Threads may run disjoint slices side by side: each cell is written by one loop only, so the result
does not depend on how the cells are divided.
"""

import math

import numpy as np

from rocksteady.kernels.core.clock import clock
from rocksteady.kernels.core.queue import queue_of, take
from rocksteady.kernels.core.tables import (
    AMPLITUDE,
    CEILING,
    DURATION,
    FREQUENCY,
    NONLINEAR_SEGMENT_COLUMNS,
    ORDERS,
    PHASE,
    ROW_COLUMNS,
    SEGMENT_COLUMNS,
    SHARES,
    UNDECIDED,
    March,
    is_nonlinear,
)
from rocksteady.kernels.core.typed import FALSE, TRUE
from rocksteady.kernels.machine_code.compilation import (
    allocating,
    compiled,
    inlined_allocating,
)
from rocksteady.kernels.machine_code.types import Floats1, Floats2, Floats3, Integers1
from rocksteady.kernels.march.march import linear_march, march, nonlinear_march


@compiled
def harmonic_segment(segments: Floats2, amplitude: float, frequency: float, phase: float) -> None:
    """Fill row 0 with endless harmonic shaking; `amplitude` and `frequency` as for the model."""
    segments[0, :] = 0.0
    segments[0, DURATION] = math.inf
    segments[0, AMPLITUDE] = amplitude
    segments[0, FREQUENCY] = frequency
    segments[0, PHASE] = phase
    segments[0, CEILING] = amplitude


@allocating
def fates_of_sides(
    amplitude: Floats1,
    frequency_ratio: Floats1,
    sides: Floats3,
    angle: Floats1,
    velocity: Floats1,
    phase: Floats1,
    cycles: int,
    most: int,
    status: Integers1,
    impacts: Integers1,
    final: Floats2,
) -> None:
    """March blocks under harmonic shaking and note how each ends.

    Parameters
    ----------
    amplitude, frequency_ratio, angle, velocity, phase
        One value a cell, shape (cells,); `velocity` is d(theta/alpha)/ds.
    sides
        Of the block of each cell, shape (cells, 2, 3) or, in the nonlinear model, (cells, 2, 5), as
        in `rocksteady.kernels.core.tables`.
    cycles
        Forcing periods to run.
    most
        Flights after which a motion is given up as UNDECIDED.
    status, impacts, final
        Receive the status code, the number of impacts and, in shape (cells, 3), the final angle,
        velocity and phase.
    """
    queue = queue_of(len(amplitude))
    if len(sides) > 0 and is_nonlinear(sides[0]):
        queued_nonlinear_fates_of_sides(
            queue,
            amplitude,
            frequency_ratio,
            sides,
            angle,
            velocity,
            phase,
            cycles,
            most,
            status,
            impacts,
            final,
        )
    else:
        queued_fates_of_sides(
            queue,
            amplitude,
            frequency_ratio,
            sides,
            angle,
            velocity,
            phase,
            cycles,
            most,
            status,
            impacts,
            final,
        )


@allocating
def queued_fates_of_sides(
    queue: Integers1,
    amplitude: Floats1,
    frequency_ratio: Floats1,
    sides: Floats3,
    angle: Floats1,
    velocity: Floats1,
    phase: Floats1,
    cycles: int,
    most: int,
    status: Integers1,
    impacts: Integers1,
    final: Floats2,
) -> None:
    """Do what `fates_of_sides` does in the linear model, for the cells taken from a queue."""
    _fates(
        queue,
        amplitude,
        frequency_ratio,
        sides,
        angle,
        velocity,
        phase,
        cycles,
        most,
        status,
        impacts,
        final,
        np.zeros((1, SEGMENT_COLUMNS)),
        FALSE,
    )


@allocating
def queued_nonlinear_fates_of_sides(
    queue: Integers1,
    amplitude: Floats1,
    frequency_ratio: Floats1,
    sides: Floats3,
    angle: Floats1,
    velocity: Floats1,
    phase: Floats1,
    cycles: int,
    most: int,
    status: Integers1,
    impacts: Integers1,
    final: Floats2,
) -> None:
    """Do what `fates_of_sides` does in the nonlinear model, for the cells taken from a queue."""
    # On a base without vertical motion.
    _fates(
        queue,
        amplitude,
        frequency_ratio,
        sides,
        angle,
        velocity,
        phase,
        cycles,
        most,
        status,
        impacts,
        final,
        np.zeros((1, NONLINEAR_SEGMENT_COLUMNS)),
        TRUE,
    )


@inlined_allocating
def _fates(
    queue: Integers1,
    amplitude: Floats1,
    frequency_ratio: Floats1,
    sides: Floats3,
    angle: Floats1,
    velocity: Floats1,
    phase: Floats1,
    cycles: int,
    most: int,
    status: Integers1,
    impacts: Integers1,
    final: Floats2,
    segments: Floats2,
    nonlinear: bool,
) -> None:
    """Fill the fates of the cells of a queue; inlined once for each model."""
    rows, peaks = np.zeros((0, ROW_COLUMNS)), np.zeros(0)
    while True:
        i = take(queue)
        if i < 0:
            return
        harmonic_segment(segments, amplitude[i], frequency_ratio[i], phase[i])
        start = start_of(angle[i], velocity[i], phase[i])
        end_half, stop = start.half_cycles + 2 * cycles, start.phase
        if nonlinear:
            status[i], end = nonlinear_march(
                segments, sides[i], start, end_half, stop, math.inf, most, rows, peaks
            )
        else:
            status[i], end = linear_march(
                segments, sides[i], start, end_half, stop, math.inf, most, rows, peaks
            )
        impacts[i] = end.impacts
        final[i, 0], final[i, 1], final[i, 2] = end.angle, end.velocity, end.phase


@allocating
def series_fates(
    amplitude: Floats1,
    frequency_ratio: Floats1,
    shares: Floats1,
    sides: Floats3,
    angle: Floats1,
    velocity: Floats1,
    phase: Floats1,
    cycles: int,
    most: int,
    status: Integers1,
    impacts: Integers1,
    final: Floats2,
) -> None:
    """Do what `fates_of_sides` does under a Fourier series, whose shares are those of all cells.

    The amplitudes bound the acceleration, as `rocksteady.kernels.core.harmonics` has them.
    """
    segments = np.zeros((1, SHARES + len(shares)))
    rows, peaks = np.zeros((0, ROW_COLUMNS)), np.zeros(0)
    for i in range(len(amplitude)):
        harmonic_segment(segments, amplitude[i], frequency_ratio[i], phase[i])
        segments[0, ORDERS] = len(shares) // 2
        for k in range(len(shares)):
            segments[0, SHARES + k] = shares[k]
        start = start_of(angle[i], velocity[i], phase[i])
        end_half, stop = start.half_cycles + 2 * cycles, start.phase
        status[i], end = march(
            segments, sides[i], start, end_half, stop, math.inf, most, rows, peaks
        )
        impacts[i] = end.impacts
        final[i, 0], final[i, 1], final[i, 2] = end.angle, end.velocity, end.phase


@compiled
def start_of(angle: float, velocity: float, phase: float) -> March:
    """Return the state of the march at an angle, a velocity and a phase of the shaking."""
    half, start_phase = clock(phase)
    side = 1
    if angle < 0.0 or (angle == 0.0 and velocity < 0.0):
        side = -1
    elif angle == 0.0 and velocity == 0.0:
        side = 0
    return March(side, angle, velocity, 0, half, start_phase, 0, 0)


@compiled
def note(
    status: Integers1,
    impacts: Integers1,
    final: Floats2,
    cell: int,
    code: int,
    state: March,
    most: int,
) -> None:
    """Write how a cell ended; one that is UNDECIDED has no end, but `most` impacts."""
    status[cell] = code
    impacts[cell] = state.impacts
    final[cell, 0] = state.angle
    final[cell, 1] = state.velocity
    final[cell, 2] = state.phase
    if code == UNDECIDED:
        impacts[cell] = most
        final[cell] = math.nan
