"""Attractors of many motions in one call: a loop of `settle` over independent cells."""

import math

import numpy as np

from rocksteady.kernels.core.clock import clock
from rocksteady.kernels.core.queue import enter, queue_of, take
from rocksteady.kernels.core.tables import NONLINEAR_SIDE_COLUMNS, SIDE_COLUMNS, is_nonlinear
from rocksteady.kernels.core.typed import ZERO
from rocksteady.kernels.machine_code.compilation import allocating, compiled, inlined
from rocksteady.kernels.machine_code.types import Floats1, Floats2, Floats3, Integers1, Integers2
from rocksteady.kernels.orbits.periodic import (
    ORBIT_COLUMNS,
    OTHER_PEAK,
    PEAK,
    SIDE,
    fill_peaks,
    is_symmetric,
    measured,
    state_at,
)
from rocksteady.kernels.orbits.settle import LONGEST_ORBIT, MEMORY, PERIODIC, Settled, settle
from rocksteady.kernels.orbits.systems import EitherSystem, System, make_series_system, make_system

# Columns of the whole numbers of a cell.
OUTCOME = 0
ORBIT_SIDE = 1  # of a state on the orbit, whose phase and speed are below
PASSAGES = 2
PERIODS = 3
RESTS = 4
SYMMETRIC = 5
AFTER = 6  # forcing periods until it was known
WHOLE_COLUMNS = 7

# Columns of its other numbers: nan where they mean nothing.
ORBIT_PHASE = 0  # in [0, 2 pi)
ORBIT_SPEED = 1
HIGHEST = 2  # theta/alpha
LOWEST = 3
LYAPUNOV = 4
LEAST = 5
REAL_COLUMNS = 6


@compiled
def fill_clocks(phase: Floats1, half_cycles: Integers1, rest: Floats1) -> None:
    """Split phases into whole half cycles and rests in [0, pi), all of shape (cells,)."""
    for i in range(len(phase)):
        half_cycles[i], rest[i] = clock(phase[i])


@allocating
def settle_cells(
    amplitude: Floats1,
    frequency_ratio: Floats1,
    sides: Floats3,
    side: Integers1,
    angle: Floats1,
    velocity: Floats1,
    half_cycles: Integers1,
    phase: Floats1,
    cycles: int,
    whole: Integers2,
    real: Floats2,
) -> None:
    """Follow motions until it is known what they settle to.

    Parameters
    ----------
    amplitude, frequency_ratio
        One value a cell, shape (cells,).
    sides
        Of the block of each cell, shape (cells, 2, 3) or, in the nonlinear model, (cells, 2, 5), as
        in `rocksteady.kernels.core.tables`.
    side, angle, velocity, half_cycles, phase
        The state at the start, as in `rocksteady.kernels.core.tables.March`; `side` 0 at rest.
    cycles
        Forcing periods after which a motion counts as unsettled.
    whole, real
        Receive the columns above, shape (cells, WHOLE_COLUMNS) and (cells, REAL_COLUMNS).
    """
    queue = queue_of(len(amplitude))
    memories = np.empty((1, MEMORY, ORBIT_COLUMNS))
    tables = np.empty((1, LONGEST_ORBIT, ORBIT_COLUMNS))
    if len(sides) > 0 and is_nonlinear(sides[0]):
        queued_nonlinear_settle_cells(
            queue,
            memories,
            tables,
            amplitude,
            frequency_ratio,
            sides,
            side,
            angle,
            velocity,
            half_cycles,
            phase,
            cycles,
            whole,
            real,
        )
    else:
        queued_settle_cells(
            queue,
            memories,
            tables,
            amplitude,
            frequency_ratio,
            sides,
            side,
            angle,
            velocity,
            half_cycles,
            phase,
            cycles,
            whole,
            real,
        )


@allocating
def queued_settle_cells(
    queue: Integers1,
    memories: Floats3,
    tables: Floats3,
    amplitude: Floats1,
    frequency_ratio: Floats1,
    sides: Floats3,
    side: Integers1,
    angle: Floats1,
    velocity: Floats1,
    half_cycles: Integers1,
    phase: Floats1,
    cycles: int,
    whole: Integers2,
    real: Floats2,
) -> None:
    """Do what `settle_cells` does in the linear model, for the cells taken from a queue.

    The room of a worker are rows of `memories` and `tables`, whose shapes are (workers, MEMORY,
    5 or more) and (workers, MEMORY or more, ORBIT_COLUMNS).  A cell whose orbit may have more
    passages than the table has rows is LEFT_OVER.
    """
    _settle_cells(
        queue,
        memories,
        tables,
        amplitude,
        frequency_ratio,
        sides,
        side,
        angle,
        velocity,
        half_cycles,
        phase,
        cycles,
        whole,
        real,
        np.empty((2, SIDE_COLUMNS)),
    )


@allocating
def queued_nonlinear_settle_cells(
    queue: Integers1,
    memories: Floats3,
    tables: Floats3,
    amplitude: Floats1,
    frequency_ratio: Floats1,
    sides: Floats3,
    side: Integers1,
    angle: Floats1,
    velocity: Floats1,
    half_cycles: Integers1,
    phase: Floats1,
    cycles: int,
    whole: Integers2,
    real: Floats2,
) -> None:
    """Do what `queued_settle_cells` does in the nonlinear model."""
    _settle_cells(
        queue,
        memories,
        tables,
        amplitude,
        frequency_ratio,
        sides,
        side,
        angle,
        velocity,
        half_cycles,
        phase,
        cycles,
        whole,
        real,
        np.empty((2, NONLINEAR_SIDE_COLUMNS)),
    )


@inlined
def _settle_cells(
    queue: Integers1,
    memories: Floats3,
    tables: Floats3,
    amplitude: Floats1,
    frequency_ratio: Floats1,
    sides: Floats3,
    side: Integers1,
    angle: Floats1,
    velocity: Floats1,
    half_cycles: Integers1,
    phase: Floats1,
    cycles: int,
    whole: Integers2,
    real: Floats2,
    block: Floats2,
) -> None:
    """Settle the cells of a queue; inlined once for each model: `block` has its columns."""
    worker = enter(queue)
    memory, table = memories[worker], tables[worker]
    while True:
        i = take(queue)
        if i < 0:
            return
        for row in range(block.shape[0]):
            for column in range(block.shape[1]):
                block[row, column] = sides[i, row, column]
        system = make_system(amplitude[i], frequency_ratio[i], block)
        found = settle(
            system,
            side[i],
            half_cycles[i],
            phase[i],
            angle[i],
            velocity[i],
            cycles,
            memory,
            table,
        )
        note_settled(system, found, table, whole, real, i)


@allocating
def settle_series_cells(
    amplitude: Floats1,
    frequency_ratio: Floats1,
    shares: Floats1,
    sides: Floats3,
    side: Integers1,
    angle: Floats1,
    velocity: Floats1,
    half_cycles: Integers1,
    phase: Floats1,
    cycles: int,
    whole: Integers2,
    real: Floats2,
) -> None:
    """Do what `settle_cells` does under a Fourier series, whose shares are those of all cells."""
    memory, table = np.empty((MEMORY, ORBIT_COLUMNS)), np.empty((LONGEST_ORBIT, ORBIT_COLUMNS))
    lifts = np.empty((2, len(shares) // 2))
    for i in range(len(amplitude)):
        system: EitherSystem = make_series_system(
            amplitude[i], frequency_ratio[i], sides[i], shares, lifts
        )
        found = settle(
            system,
            side[i],
            half_cycles[i],
            phase[i],
            angle[i],
            velocity[i],
            cycles,
            memory,
            table,
        )
        note_settled(system, found, table, whole, real, i)


@compiled
def note_settled(
    system: EitherSystem,
    found: Settled,
    table: Floats2,
    whole: Integers2,
    real: Floats2,
    cell: int,
) -> None:
    """Write what a cell settles to, and find the peaks of its orbit."""
    if found.outcome == PERIODIC:
        # As for one orbit alone: its times are where the peaks are searched from.
        measured(system, found.passages, found.periods, table)
        fill_peaks(system, found.passages, table)
    note_attractor(system, found, table, whole, real, cell)


@compiled
def note_attractor(
    system: System, found: Settled, table: Floats2, whole: Integers2, real: Floats2, cell: int
) -> None:
    """Write what a cell settles to, whose orbit, if it has one, is in a table with its peaks."""
    whole[cell, :] = 0
    real[cell, :] = math.nan
    whole[cell, OUTCOME] = found.outcome
    whole[cell, AFTER] = found.after
    real[cell, LYAPUNOV] = found.lyapunov
    real[cell, LEAST] = found.least
    if found.outcome != PERIODIC:
        return
    passages, periods = found.passages, found.periods
    highest = lowest = 0.0
    for k in range(passages):
        here, there = table[k, PEAK], table[k, OTHER_PEAK]
        if table[k, SIDE] < 0.0:
            here, there = there, here
        highest, lowest = max(highest, here), max(lowest, there)
    state = state_at(table, ZERO)
    whole[cell, ORBIT_SIDE] = state.side
    whole[cell, PASSAGES] = passages
    whole[cell, PERIODS] = periods
    whole[cell, RESTS] = found.rests
    whole[cell, SYMMETRIC] = 1 if is_symmetric(system, table, passages, periods) else 0
    real[cell, ORBIT_PHASE] = (state.half_cycles % 2) * math.pi + state.phase
    real[cell, ORBIT_SPEED] = state.speed
    real[cell, HIGHEST], real[cell, LOWEST] = highest, 0.0 - lowest
