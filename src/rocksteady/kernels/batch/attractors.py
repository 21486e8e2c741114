"""Attractors of many motions in one call: a loop of `settle` over independent cells."""

import math

import numpy as np

from rocksteady.kernels.core.clock import clock
from rocksteady.kernels.core.queue import enter, queue_of, take
from rocksteady.kernels.core.tables import NONLINEAR_SIDE_COLUMNS, SIDE_COLUMNS, is_nonlinear
from rocksteady.kernels.core.tuples import Cells, Outcomes, SeriesCells, States
from rocksteady.kernels.core.typed import ZERO
from rocksteady.kernels.machine_code.compilation import allocating, compiled, inlined
from rocksteady.kernels.machine_code.types import Floats1, Floats2, Floats3, Integers1
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
from rocksteady.kernels.orbits.return_map import AnyState
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
def settle_cells(cells: Cells, states: States, cycles: int, outcomes: Outcomes) -> None:
    """Follow motions until it is known what they settle to.

    Parameters
    ----------
    cells, states, outcomes
        The blocks, where they start, and what receives the columns above: `kernels.core.tuples`.
    cycles
        Forcing periods after which a motion counts as unsettled.
    """
    queue = queue_of(len(cells.amplitude))
    memories = np.empty((1, MEMORY, ORBIT_COLUMNS))
    tables = np.empty((1, LONGEST_ORBIT, ORBIT_COLUMNS))
    if len(cells.sides) > 0 and is_nonlinear(cells.sides[0]):
        queued_nonlinear_settle_cells(queue, memories, tables, cells, states, cycles, outcomes)
    else:
        queued_settle_cells(queue, memories, tables, cells, states, cycles, outcomes)


@allocating
def queued_settle_cells(
    queue: Integers1,
    memories: Floats3,
    tables: Floats3,
    cells: Cells,
    states: States,
    cycles: int,
    outcomes: Outcomes,
) -> None:
    """Do what `settle_cells` does in the linear model, for the cells taken from a queue.

    The room of a worker are rows of `memories` and `tables`, whose shapes are (workers, MEMORY,
    5 or more) and (workers, MEMORY or more, ORBIT_COLUMNS).  A cell whose orbit may have more
    passages than the table has rows is LEFT_OVER.
    """
    block = np.empty((2, SIDE_COLUMNS))
    _settle_cells(queue, memories, tables, cells, states, cycles, outcomes, block)


@allocating
def queued_nonlinear_settle_cells(
    queue: Integers1,
    memories: Floats3,
    tables: Floats3,
    cells: Cells,
    states: States,
    cycles: int,
    outcomes: Outcomes,
) -> None:
    """Do what `queued_settle_cells` does in the nonlinear model."""
    block = np.empty((2, NONLINEAR_SIDE_COLUMNS))
    _settle_cells(queue, memories, tables, cells, states, cycles, outcomes, block)


@inlined
def _settle_cells(
    queue: Integers1,
    memories: Floats3,
    tables: Floats3,
    cells: Cells,
    states: States,
    cycles: int,
    outcomes: Outcomes,
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
                block[row, column] = cells.sides[i, row, column]
        system = make_system(cells.amplitude[i], cells.frequency_ratio[i], block)
        end = settle(system, state_of(states, i), cycles, memory, table)
        note_settled(system, end, table, outcomes, i)


@allocating
def settle_series_cells(
    cells: SeriesCells, states: States, cycles: int, outcomes: Outcomes
) -> None:
    """Do what `settle_cells` does under a Fourier series."""
    memory, table = np.empty((MEMORY, ORBIT_COLUMNS)), np.empty((LONGEST_ORBIT, ORBIT_COLUMNS))
    shares = cells.shares
    lifts = np.empty((2, len(shares) // 2))
    for i in range(len(cells.amplitude)):
        system: EitherSystem = make_series_system(
            cells.amplitude[i], cells.frequency_ratio[i], cells.sides[i], shares, lifts
        )
        end = settle(system, state_of(states, i), cycles, memory, table)
        note_settled(system, end, table, outcomes, i)


@compiled
def state_of(states: States, cell: int) -> AnyState:
    """Return where the motion of a cell starts."""
    return AnyState(
        states.side[cell],
        states.half_cycles[cell],
        states.phase[cell],
        states.angle[cell],
        states.velocity[cell],
    )


@compiled
def note_settled(
    system: EitherSystem, end: Settled, table: Floats2, outcomes: Outcomes, cell: int
) -> None:
    """Write what a cell settles to, and find the peaks of its orbit."""
    if end.outcome == PERIODIC:
        # As for one orbit alone: its times are where the peaks are searched from.
        measured(system, end.passages, end.periods, table)
        fill_peaks(system, end.passages, table)
    note_attractor(system, end, table, outcomes, cell)


@compiled
def note_attractor(
    system: System, end: Settled, table: Floats2, outcomes: Outcomes, cell: int
) -> None:
    """Write what a cell settles to, whose orbit, if it has one, is in a table with its peaks."""
    whole, real = outcomes
    whole[cell, :] = 0
    real[cell, :] = math.nan
    whole[cell, OUTCOME] = end.outcome
    whole[cell, AFTER] = end.after
    real[cell, LYAPUNOV] = end.lyapunov
    real[cell, LEAST] = end.least
    if end.outcome != PERIODIC:
        return
    passages, periods = end.passages, end.periods
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
    whole[cell, RESTS] = end.rests
    whole[cell, SYMMETRIC] = 1 if is_symmetric(system, table, passages, periods) else 0
    real[cell, ORBIT_PHASE] = (state.half_cycles % 2) * math.pi + state.phase
    real[cell, ORBIT_SPEED] = state.speed
    real[cell, HIGHEST], real[cell, LOWEST] = highest, 0.0 - lowest
