"""Loop that assigns cells to lanes, and passes undecided motions on to the march."""

import math

import numpy as np

from rocksteady.kernels.batch.harmonic import harmonic_segment, note_in_lanes, start_of
from rocksteady.kernels.core import tables as columns
from rocksteady.kernels.core.clock import clock
from rocksteady.kernels.core.queue import queue_of, take, together
from rocksteady.kernels.core.returns import LEAPT
from rocksteady.kernels.core.tables import Floats, March
from rocksteady.kernels.core.tuples import Cells, Fates, Kept, Starts, Tables, Until
from rocksteady.kernels.core.typed import ONE
from rocksteady.kernels.lanes import _fields as lane
from rocksteady.kernels.lanes._both_sides import change_sides, row_of, unit_of
from rocksteady.kernels.lanes._fields import FIELDS, GROUP, LANES, working
from rocksteady.kernels.lanes._loading import at_the_end, load, put_lane, taken
from rocksteady.kernels.lanes._nodes import node_decision, node_state
from rocksteady.kernels.lanes._passes import (
    at_nodes,
    begin,
    census,
    draw_together,
    fill_empty,
    in_need,
    step,
)
from rocksteady.kernels.lanes._periods import compare, leap
from rocksteady.kernels.machine_code.compilation import allocating, compiled
from rocksteady.kernels.machine_code.types import Integers1
from rocksteady.kernels.march.march import linear_march
from rocksteady.kernels.march.rest import STILL

ROUNDS = 4096  # passes from one look at the numbers of impacts to the next


@allocating
def lane_fates(
    cells: Cells, starts: Starts, cycles: int, leaping: bool, most: int, fates: Fates
) -> None:
    """March blocks under harmonic shaking and note how each ends.

    Fates are those of `kernels.batch.harmonic.fates_of_sides`; impacts too but for those of
    chatter; final states agree to rounding, which a chaotic motion amplifies, and to 1e-9 after a
    leap.

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
    queued_lane_fates(queue_of(len(cells.amplitude)), cells, starts, cycles, leaping, most, fates)


@allocating
def queued_lane_fates(
    queue: Integers1,
    cells: Cells,
    starts: Starts,
    cycles: int,
    leaping: bool,
    most: int,
    fates: Fates,
) -> None:
    """Do what `lane_fates` does, for the cells that this worker takes from a queue."""
    amplitude, frequency_ratio, blocks = cells
    angle, velocity, phase = starts
    segments = np.zeros((1, columns.SEGMENT_COLUMNS))
    if len(amplitude) == 0:
        return
    lanes = np.zeros(FIELDS * LANES)
    fill_empty(lanes, blocks[0])
    two_sided = False  # whether any lane has had an unlike block, or one against a wall
    fresh = True  # whether there may be cells to take
    busy = 0  # lanes that are not empty
    bounces = 0  # passes since the last look at short bounces ...
    delays = 0  # ... and at special flights
    rounds = 0
    numbers = together(census(lanes))
    while True:
        help_wanted = in_need(numbers)
        rounds += 1
        if rounds % ROUNDS == 0:
            lost = 0
            for j in range(LANES):
                if exhausted(lanes, j, most):
                    lanes[lane.STAGE + j] = lane.LEAVE
                    lost += 1
            help_wanted = together(lost) > 0 or help_wanted
        if help_wanted:
            for j in range(LANES):
                if lane.LEAVE <= lanes[lane.STAGE + j] < lane.DOWN:
                    cell = int(lanes[lane.CELL + j])
                    harmonic_segment(segments, amplitude[cell], frequency_ratio[cell], phase[cell])
                    tables = Tables(segments, blocks[cell])
                    end_half = clock(phase[cell])[0] + 2 * cycles
                    code, state = settled(lanes, j, tables, end_half, most)
                    if code == columns.UNDECIDED and not exhausted(lanes, j, most):
                        put_lane(lanes, j, state, end_half, blocks[cell])
                    else:
                        note_in_lanes(fates, cell, code, state, most)
                        lanes[lane.STAGE + j] = lane.EMPTY
                        busy -= 1
                while lanes[lane.STAGE + j] == lane.EMPTY and fresh:
                    cell = take(queue)
                    fresh = cell >= 0
                    if not fresh:
                        break
                    a, w, sides = amplitude[cell], frequency_ratio[cell], blocks[cell]
                    harmonic_segment(segments, a, w, phase[cell])
                    start = start_of(angle[cell], velocity[cell], phase[cell])
                    end_half, stop = start.half_cycles + 2 * cycles, start.phase
                    code, state = launched(Tables(segments, sides), start, end_half, stop)
                    if code != columns.UNDECIDED:
                        note_in_lanes(fates, cell, code, state, most)
                        continue
                    load(lanes, j, cell, a, w, sides, stop)
                    two_sided = two_sided or lanes[lane.APART + j] != 0.0
                    put_lane(lanes, j, state, end_half, sides)
                    busy += 1
            if together(busy) == 0:
                return
            if not fresh and busy <= working(lanes) - GROUP:
                draw_together(lanes)
        elif at_nodes(numbers):
            node_state(lanes)
            numbers = together(node_decision(lanes))
            continue
        else:
            bounces = step(lanes, numbers, bounces)
        if two_sided:
            change_sides(lanes)
        if leaping and compare(lanes, most) > 0:
            leap(lanes)
        numbers, delays = begin(lanes, delays, two_sided)


@compiled
def exhausted(lanes: Floats, j: int, most: int) -> bool:
    """Return whether the motion of a lane, not leapt, has had more impacts than it is given."""
    flies = lanes[lane.STAGE + j] != lane.EMPTY and lanes[lane.LAG + j] != LEAPT
    return bool(flies and lanes[lane.IMPACTS + j] > most)


@allocating
def launched(tables: Tables, start: March, end_half: int, end_phase: float) -> tuple[int, March]:
    """March until the block is in flight from the floor (UNDECIDED), or to the end."""
    code, state = columns.UNDECIDED, start
    kept = Kept(np.zeros((0, columns.ROW_COLUMNS)), np.zeros(0))
    while code == columns.UNDECIDED and (state.side == 0 or state.angle != 0.0):
        until = Until(end_half, end_phase, math.inf, state.flights + 1)
        code, state = linear_march(tables, state, until, kept)
    return code, state


@allocating
def settled(lanes: Floats, j: int, tables: Tables, end_half: int, most: int) -> tuple[int, March]:
    """Return how the run of a waiting lane ended, or its next flight from the floor (UNDECIDED)."""
    stage = lanes[lane.STAGE + j]
    sides = tables.sides
    state = taken(lanes, j, end_half, sides)
    if exhausted(lanes, j, most):
        return columns.UNDECIDED, state
    if stage == lane.FALLEN:
        return columns.OVERTURNED, state
    if stage == lane.ENDED:
        return columns.ROCKING, at_the_end(lanes, j, end_half, sides)
    if stage == lane.RESTED:
        state = March(0, 0.0, 0.0, 0, state.half_cycles, state.phase, state.impacts, 0)
    stop = lanes[lane.STOP + j]
    kept = Kept(np.zeros((0, columns.ROW_COLUMNS)), np.zeros(0))
    until = Until(end_half, stop, math.inf, ONE)
    code, state = linear_march(tables, state, until, kept)
    if code != columns.UNDECIDED:
        return code, state
    still = STILL * unit_of(sides, row_of(state.side))
    if stage != lane.RESTED and state.angle == 0.0 and abs(state.velocity) < still:
        # As the march has it, which would have come to this at the next flight.
        state = March(0, 0.0, 0.0, 0, state.half_cycles, state.phase, state.impacts, 0)
    return launched(tables, state, end_half, stop)
