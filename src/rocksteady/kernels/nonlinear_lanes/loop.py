"""Loop that assigns cells to lanes, and passes undecided motions on to the march."""

import math

import numpy as np

from rocksteady.kernels.batch.harmonic import harmonic_segment, note_in_lanes, start_of
from rocksteady.kernels.core import tables as columns
from rocksteady.kernels.core.clock import clock, elapsed_time, side_phase
from rocksteady.kernels.core.queue import queue_of, take
from rocksteady.kernels.core.scatter import largest_restitution
from rocksteady.kernels.core.tables import Floats, March, free_side
from rocksteady.kernels.core.tuples import Cells, Fates, Kept, Starts, Tables, Until
from rocksteady.kernels.core.typed import FALSE, ZERO
from rocksteady.kernels.machine_code.compilation import (
    allocating,
    compiled,
    inlined,
    inlined_allocating,
)
from rocksteady.kernels.machine_code.types import Floats1, Integers1
from rocksteady.kernels.march.march import nonlinear_march
from rocksteady.kernels.march.rest import STILL
from rocksteady.kernels.nonlinear.proofs import bounces_settle, stepped_bounce
from rocksteady.kernels.nonlinear_lanes import _layout as lane
from rocksteady.kernels.nonlinear_lanes._coefficients import expand
from rocksteady.kernels.nonlinear_lanes._ends import find_places, finish
from rocksteady.kernels.nonlinear_lanes._layout import LANES, SIZE
from rocksteady.kernels.nonlinear_lanes._leaps import compare, leap
from rocksteady.kernels.nonlinear_lanes._signs import count_changes
from rocksteady.kernels.nonlinear_lanes._steps import measure, scale
from rocksteady.kernels.nonlinear_lanes._transfer import at_the_end, load, put_lane, taken
from rocksteady.kernels.nonlinear_lanes._two_sides import change_sides

FASTEST = 1e6
"""Frequency ratio up to which no Taylor coefficient can leave the range of numbers."""
CACHE_LINE = 64
ALIGNMENT = CACHE_LINE if LANES > 1 else 8
"""Bytes of which the address of the lanes is a multiple: one lane has no vectors to be aligned."""
ROOM = SIZE + ALIGNMENT // 8
"""Numbers that hold the lanes, wherever they begin."""


@allocating
def nonlinear_lane_fates(
    cells: Cells, starts: Starts, cycles: int, leaping: bool, most: int, fates: Fates
) -> None:
    """March blocks under harmonic shaking in the nonlinear model; note how each ends.

    Fates are those of `kernels.batch.harmonic.fates_of_sides`, but where the tolerance decides;
    impacts too but for those of chatter.

    Parameters
    ----------
    cells, starts, fates
        The blocks, where they start, and what receives how they end: `kernels.core.tuples`.
    cycles
        Forcing periods to run, at least 1.
    leaping
        Whether to leap over the periods of a motion that has become periodic.
    most
        Impacts after which a motion is given up as UNDECIDED, those leapt over not counted.
    """
    queue = queue_of(len(cells.amplitude))
    queued_nonlinear_lane_fates(queue, cells, starts, cycles, leaping, most, fates)


@allocating
def queued_nonlinear_lane_fates(
    queue: Integers1,
    cells: Cells,
    starts: Starts,
    cycles: int,
    leaping: bool,
    most: int,
    fates: Fates,
) -> None:
    """Do what `nonlinear_lane_fates` does, for the cells that this worker takes from a queue."""
    amplitude, frequency_ratio, sides = cells
    angle, velocity, phase = starts
    segments = np.zeros((1, columns.NONLINEAR_SEGMENT_COLUMNS))
    lanes = aligned(np.zeros(ROOM))
    if len(amplitude) == 0:
        return
    fill_empty(lanes, sides[0])
    two_sided = False  # whether any lane has had an unlike block
    fresh = True  # whether there may be cells to take
    busy = 0  # lanes that are not empty
    waiting = LANES
    while True:
        if waiting > 0:
            for k in range(LANES):
                stage = lanes[lane.STAGE + k]
                if stage >= lane.SLOW:
                    cell = int(lanes[lane.CELL + k])
                    half, stop = clock(phase[cell])
                    end_half = half + 2 * cycles
                    harmonic_segment(segments, amplitude[cell], frequency_ratio[cell], phase[cell])
                    tables = Tables(segments, sides[cell])
                    code, state = settled(lanes, k, tables, end_half, stop, most)
                    if code == columns.UNDECIDED and state.impacts <= most:
                        put_lane(lanes, k, state, end_half)
                    else:
                        note_in_lanes(fates, cell, code, state, most)
                        lanes[lane.STAGE + k] = lane.EMPTY
                        busy -= 1
                while lanes[lane.STAGE + k] == lane.EMPTY and fresh:
                    cell = take(queue)
                    fresh = cell >= 0
                    if not fresh:
                        break
                    harmonic_segment(segments, amplitude[cell], frequency_ratio[cell], phase[cell])
                    start = start_of(angle[cell], velocity[cell], phase[cell])
                    end_half, stop = start.half_cycles + 2 * cycles, start.phase
                    # On a still base energy proves an overturning, which only the march looks at.
                    slowest = min(sides[cell, 0, columns.RATE], sides[cell, 1, columns.RATE])
                    # A block against a wall keeps its side, which no lane does.
                    alone = (
                        frequency_ratio[cell] > FASTEST * slowest
                        or amplitude[cell] == 0.0
                        or free_side(sides[cell]) != 0
                    )
                    flights = most if alone else ZERO
                    tables = Tables(segments, sides[cell])
                    code, state = onwards(tables, start, end_half, stop, most, flights, FALSE)
                    if code != columns.UNDECIDED or alone or state.impacts > most:
                        note_in_lanes(fates, cell, code, state, most)
                        continue
                    load(lanes, k, cell, amplitude[cell], frequency_ratio[cell], sides[cell], stop)
                    two_sided = two_sided or lanes[lane.APART + k] > 0.0
                    put_lane(lanes, k, state, end_half)
                    if lanes[lane.STAGE + k] == lane.FALLEN:
                        note_in_lanes(fates, cell, columns.OVERTURNED, state, most)
                        lanes[lane.STAGE + k] = lane.EMPTY
                        continue
                    busy += 1
            if busy == 0:
                return
        if leaping and compare(lanes, most) > 0:
            leap(lanes)
        waiting = step(lanes, most)
        if two_sided:
            change_sides(lanes)
        if not fresh:
            waiting -= LANES - busy


@inlined_allocating
def aligned(room: Floats1) -> Floats1:
    """Return the part of a room that the lanes take."""
    ahead = (-room.ctypes.data % ALIGNMENT) // 8
    return room[ahead : ahead + SIZE]


@compiled
def fill_empty(lanes: Floats, sides: Floats) -> None:
    """Fill lanes with a cell that has none: empty ones fly too, and come to no harm."""
    for k in range(LANES):
        load(lanes, k, ZERO, 1.0, 1.0, sides, 0.0)
        put_lane(lanes, k, March(1, 0.5, 0.0, 0, 0, 0.0, 0, 0), 2)
        lanes[lane.STAGE + k] = lane.EMPTY


@inlined
def step(lanes: Floats, most: int) -> int:
    """Take all lanes a step further; return how many wait for what loops do not do."""
    expand(lanes)
    measure(lanes)
    scale(lanes)
    count_changes(lanes)
    find_places(lanes)
    return finish(lanes, most)


@allocating
def settled(
    lanes: Floats, k: int, tables: Tables, end_half: int, stop: float, most: int
) -> tuple[int, March]:
    """Return how the run of a waiting lane ended, or its next flight (UNDECIDED)."""
    stage = lanes[lane.STAGE + k]
    state = taken(lanes, k, end_half)
    if stage == lane.FALLEN:
        return columns.OVERTURNED, state
    if stage == lane.ENDED:
        return columns.ROCKING, at_the_end(lanes, k, end_half)
    if stage == lane.GIVEN_UP:
        return columns.UNDECIDED, state
    flights = 1 if stage == lane.LEAVE else 0
    return onwards(tables, state, end_half, stop, most, flights, stage == lane.SLOW)


@allocating
def onwards(
    tables: Tables,
    start: March,
    end_half: int,
    stop: float,
    most: int,
    flights: int,
    bounced: bool,
) -> tuple[int, March]:
    """March until a lane can go on (UNDECIDED), or to the end.

    Parameters
    ----------
    tables
        Of the march.
    start
        State to march from.
    end_half, stop
        Half cycles and phase of the end.
    most
        Impacts after which the motion is given up.
    flights
        Flights that the march has to take, at least.
    bounced
        Whether the block comes from an impact, so that it may come to rest.

    Returns
    -------
    tuple
        Status and state.
    """
    kept = Kept(np.zeros((0, columns.ROW_COLUMNS)), np.zeros(0))
    state, lifting = start, False
    while state.impacts <= most:
        if bounced and bounces_die_out(tables, state, end_half, stop):
            state = March(0, 0.0, 0.0, 0, state.half_cycles, state.phase, state.impacts, 0)
        flies = state.angle != 0.0 or state.velocity != 0.0 or lifting
        if flies and flights == 0:
            break
        limit = state.flights + max(flights, 1)
        before = state
        until = Until(end_half, stop, math.inf, limit)
        code, state = nonlinear_march(tables, before, until, kept)
        if code != columns.UNDECIDED:
            return code, state
        if state.flights < limit:  # a flight that comes to no end, so that no lane may take it up
            half, phase = state.half_cycles, state.phase
            return columns.UNDECIDED, March(0, 0.0, 0.0, 0, half, phase, most + 1, state.flights)
        bounced = state.impacts > before.impacts
        lifting = before.side == 0 and not bounced
        flights = 0
    return columns.UNDECIDED, state


@compiled
def bounces_die_out(tables: Tables, state: March, end_half: int, stop: float) -> bool:
    """Return whether the march would find that the bounces which follow an impact die out."""
    half, phase, side = state.half_cycles, state.phase, state.side
    row, speed = 0 if side > 0 else 1, abs(state.velocity)
    if speed < STILL * tables.sides[row, columns.LEAN] * tables.sides[row, columns.RATE]:
        return True
    frequency = tables.segments[0, columns.FREQUENCY]
    phase_here, _ = side_phase(half, phase, side, frequency)
    phase_there, _ = side_phase(half, phase, -side, frequency)
    next_side = -side if free_side(tables.sides) == 0 else side
    here = stepped_bounce(tables, ZERO, side, 0.0, speed, phase_here)
    there = stepped_bounce(tables, ZERO, next_side, 0.0, speed, phase_there)
    span = elapsed_time(end_half, stop, half, phase, frequency)
    return bounces_settle(largest_restitution(tables.sides), span, here, there, math.inf)
