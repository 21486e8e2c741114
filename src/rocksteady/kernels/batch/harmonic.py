"""Fates of many blocks under periodic shaking: a loop of the march over independent cells.

Threads may run disjoint slices side by side: each cell is written by one loop only, so the result
does not depend on how the cells are divided.
"""

import math

import numpy as np

from rocksteady.kernels.core import tables as columns
from rocksteady.kernels.core.clock import clock
from rocksteady.kernels.core.tables import March, is_nonlinear
from rocksteady.kernels.core.tuples import (
    Cells,
    Fates,
    Kept,
    SeriesCells,
    Starts,
    Tables,
    Until,
)
from rocksteady.kernels.core.typed import FALSE, TRUE
from rocksteady.kernels.machine_code.compilation import (
    allocating,
    compiled,
    inlined_allocating,
)
from rocksteady.kernels.machine_code.types import Floats2
from rocksteady.kernels.march.march import linear_march, march, nonlinear_march


@compiled
def harmonic_segment(segments: Floats2, amplitude: float, frequency: float, phase: float) -> None:
    """Fill row 0 with endless harmonic shaking; `amplitude` and `frequency` as for the model."""
    segments[0, :] = 0.0
    segments[0, columns.DURATION] = math.inf
    segments[0, columns.AMPLITUDE] = amplitude
    segments[0, columns.FREQUENCY] = frequency
    segments[0, columns.PHASE] = phase
    segments[0, columns.CEILING] = amplitude


@allocating
def fates_of_sides(cells: Cells, starts: Starts, cycles: int, most: int, fates: Fates) -> None:
    """March blocks under harmonic shaking and note how each ends.

    Parameters
    ----------
    cells, starts, fates
        The blocks, where they start, and what receives how they end: `kernels.core.tuples`.
    cycles
        Forcing periods to run.
    most
        Flights after which a motion is given up as UNDECIDED.
    """
    if len(cells.sides) > 0 and is_nonlinear(cells.sides[0]):
        # On a base without vertical motion.
        segments = np.zeros((1, columns.NONLINEAR_SEGMENT_COLUMNS))
        _fates(cells, starts, cycles, most, fates, segments, TRUE)
    else:
        segments = np.zeros((1, columns.SEGMENT_COLUMNS))
        _fates(cells, starts, cycles, most, fates, segments, FALSE)


@inlined_allocating
def _fates(
    cells: Cells,
    starts: Starts,
    cycles: int,
    most: int,
    fates: Fates,
    segments: Floats2,
    nonlinear: bool,
) -> None:
    """Fill the fates of the cells; inlined once for each model."""
    kept = Kept(np.zeros((0, columns.ROW_COLUMNS)), np.zeros(0))
    for i in range(len(cells.amplitude)):
        harmonic_segment(segments, cells.amplitude[i], cells.frequency_ratio[i], starts.phase[i])
        tables = Tables(segments, cells.sides[i])
        start, until = run_of(starts, cycles, most, i)
        if nonlinear:
            code, end = nonlinear_march(tables, start, until, kept)
        else:
            code, end = linear_march(tables, start, until, kept)
        note(fates, i, code, end)


@allocating
def series_fates(cells: SeriesCells, starts: Starts, cycles: int, most: int, fates: Fates) -> None:
    """Do what `fates_of_sides` does under a Fourier series."""
    segments = np.zeros((1, columns.SHARES + len(cells.shares)))
    kept = Kept(np.zeros((0, columns.ROW_COLUMNS)), np.zeros(0))
    for i in range(len(cells.amplitude)):
        harmonic_segment(segments, cells.amplitude[i], cells.frequency_ratio[i], starts.phase[i])
        segments[0, columns.ORDERS] = len(cells.shares) // 2
        for k in range(len(cells.shares)):
            segments[0, columns.SHARES + k] = cells.shares[k]
        start, until = run_of(starts, cycles, most, i)
        code, end = march(Tables(segments, cells.sides[i]), start, until, kept)
        note(fates, i, code, end)


@compiled
def run_of(starts: Starts, cycles: int, most: int, cell: int) -> tuple[March, Until]:
    """Return where the march of a cell begins, and where it ends after so many forcing periods."""
    start = start_of(starts.angle[cell], starts.velocity[cell], starts.phase[cell])
    return start, Until(start.half_cycles + 2 * cycles, start.phase, math.inf, most)


@compiled
def note(fates: Fates, cell: int, code: int, end: March) -> None:
    """Write how a cell ended."""
    fates.status[cell], fates.impacts[cell] = code, end.impacts
    final = fates.final
    final[cell, 0], final[cell, 1], final[cell, 2] = end.angle, end.velocity, end.phase


@compiled
def note_in_lanes(fates: Fates, cell: int, code: int, end: March, most: int) -> None:
    """Write how a cell ended; one that is UNDECIDED has no end, but `most` impacts."""
    note(fates, cell, code, end)
    if code == columns.UNDECIDED:
        fates.impacts[cell] = most
        fates.final[cell] = math.nan


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
