"""Fates of many blocks under periodic shaking: a loop of the march over independent cells.

Threads may run disjoint slices side by side: each cell is written by one loop only, so the result
does not depend on how the cells are divided.
"""

import math

import numpy as np

from rocksteady.kernels.core.clock import clock
from rocksteady.kernels.core.tables import (
    AMPLITUDE,
    CEILING,
    DURATION,
    FREQUENCY,
    NONLINEAR_SEGMENT_COLUMNS,
    ORDERS,
    PHASE,
    ROW_COLUMNS,
    SHARES,
    March,
)
from rocksteady.kernels.machine_code.compilation import allocating, compiled
from rocksteady.kernels.machine_code.types import Floats1, Floats2, Floats3, Integers1
from rocksteady.kernels.march.march import march


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
    # On a base without vertical motion; the linear model does not look at its columns.
    segments = np.zeros((1, NONLINEAR_SEGMENT_COLUMNS))
    rows, peaks = np.zeros((0, ROW_COLUMNS)), np.zeros(0)
    for i in range(len(amplitude)):
        harmonic_segment(segments, amplitude[i], frequency_ratio[i], phase[i])
        status[i], impacts[i] = fate_on(
            segments, sides[i], angle[i], velocity[i], phase[i], cycles, most, rows, peaks, final[i]
        )


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
        status[i], impacts[i] = fate_on(
            segments, sides[i], angle[i], velocity[i], phase[i], cycles, most, rows, peaks, final[i]
        )


@allocating
def fate_on(
    segments: Floats2,
    sides: Floats2,
    angle: float,
    velocity: float,
    phase: float,
    cycles: int,
    most: int,
    rows: Floats2,
    peaks: Floats1,
    final: Floats1,
) -> tuple[int, int]:
    """Return how one motion ends on one endless segment, and its impacts."""
    half, start_phase = clock(phase)
    side = 1
    if angle < 0.0 or (angle == 0.0 and velocity < 0.0):
        side = -1
    elif angle == 0.0 and velocity == 0.0:
        side = 0
    start = March(side, angle, velocity, 0, half, start_phase, 0, 0)
    status, end = march(
        segments,
        sides,
        start,
        half + 2 * cycles,
        start_phase,
        math.inf,
        most,
        rows,
        peaks,
    )
    final[0], final[1], final[2] = end.angle, end.velocity, end.phase
    return status, end.impacts
