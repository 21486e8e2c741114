"""Attractors of symmetric blocks in the nonlinear model, followed side by side.

`nonlinear_lane_attractors` does what `rocksteady.kernels.lanes.settling.lane_attractors` does, by
the steps of `loop.nonlinear_lane_fates`.
"""

import numpy as np

from rocksteady.kernels.batch.arrival import (
    FAR,
    STATE_COLUMNS,
    draw_near,
    draw_to_grid,
    expect,
    remember,
    watched,
)
from rocksteady.kernels.batch.attractors import OUTCOME, state_of
from rocksteady.kernels.batch.known_orbits import KNOWN, KNOWN_COLUMNS
from rocksteady.kernels.batch.recurrence import FLOWN, OVER, RETURN_COLUMNS, attended, begun
from rocksteady.kernels.core.other_side import unlike
from rocksteady.kernels.core.queue import LEFT_OVER, enter, queue_of, take
from rocksteady.kernels.core.tables import LEAN, RATE, Floats, March
from rocksteady.kernels.core.tuples import Cells, Outcomes, States
from rocksteady.kernels.core.typed import FALSE, ZERO
from rocksteady.kernels.elementary.circular import sincos_near
from rocksteady.kernels.machine_code.compilation import allocating, compiled
from rocksteady.kernels.machine_code.types import Floats3, Floats4, Integers1
from rocksteady.kernels.nonlinear_lanes import _layout as lane
from rocksteady.kernels.nonlinear_lanes._layout import LANES, PLACES
from rocksteady.kernels.nonlinear_lanes._transfer import load, put_lane, taken
from rocksteady.kernels.nonlinear_lanes.loop import FASTEST, ROOM, aligned, fill_empty, step
from rocksteady.kernels.orbits.periodic import ORBIT_COLUMNS
from rocksteady.kernels.orbits.return_map import Section, comes_to_rest
from rocksteady.kernels.orbits.settle import MEMORY
from rocksteady.kernels.orbits.systems import make_system


@allocating
def nonlinear_lane_attractors(
    cells: Cells, states: States, cycles: int, outcomes: Outcomes
) -> None:
    """Follow motions of symmetric blocks until it is known what they settle to.

    Parameters are those of `rocksteady.kernels.batch.attractors.settle_cells`.  Of a cell that is
    left over to that kernel OUTCOME is LEFT_OVER, and the rest means nothing.
    """
    memories = np.empty((1, LANES, MEMORY, STATE_COLUMNS))
    orbits = np.empty((1, KNOWN, KNOWN_COLUMNS))
    tables = np.empty((1, MEMORY, ORBIT_COLUMNS))
    queue = queue_of(len(cells.amplitude))
    queued_nonlinear_lane_attractors(
        queue, memories, orbits, tables, cells, states, cycles, outcomes
    )


@allocating
def queued_nonlinear_lane_attractors(
    queue: Integers1,
    memories: Floats4,
    orbits: Floats3,
    tables: Floats3,
    cells: Cells,
    states: States,
    cycles: int,
    outcomes: Outcomes,
) -> None:
    """Do what `nonlinear_lane_attractors` does, for the cells taken from a queue.

    The room of a worker are rows of `memories`, `orbits` and `tables`, whose shapes are (workers,
    LANES, MEMORY, STATE_COLUMNS), (workers, 1 or more, KNOWN_COLUMNS) and (workers, MEMORY,
    ORBIT_COLUMNS).
    """
    amplitude, frequency_ratio, blocks = cells
    worker = enter(queue)
    memory, known, table = memories[worker], orbits[worker], tables[worker]
    known[:, 0] = np.nan
    returns = np.empty((LANES, RETURN_COLUMNS))
    if len(amplitude) == 0:
        return
    lanes = aligned(np.zeros(ROOM))
    fill_empty(lanes, blocks[0])
    lanes[lane.REF_PHASE : lane.REF_PHASE + LANES] = 0.0
    lanes[lane.REF_VELOCITY : lane.REF_VELOCITY + LANES] = 1.0
    fresh = True  # whether there may be cells to take
    busy = 0  # lanes that are not empty
    while True:
        for k in range(LANES):
            stage = lanes[lane.STAGE + k]
            if stage >= lane.SLOW:
                cell = int(lanes[lane.CELL + k])
                start, sides = states.half_cycles[cell], blocks[cell]
                system = make_system(amplitude[cell], frequency_ratio[cell], sides)
                draw_near(lanes, k, PLACES)
                draw_to_grid(lanes, k, PLACES)
                march = taken(lanes, k, start + FAR)
                here = Section(march.side, march.half_cycles, march.phase, abs(march.velocity))
                if stage == lane.LEAVE and lanes[lane.START_ANGLE + k] != 0.0:
                    lanes[lane.STAGE + k] = lane.ASTRAY
                elif stage == lane.SLOW:
                    sine, _ = sincos_near(lanes[lane.PHASE + k])
                    rests = comes_to_rest(system, here, sine)
                    lanes[lane.STAGE + k] = lane.ASTRAY if rests else lane.LANDED
                if lanes[lane.STAGE + k] >= lane.LEAVE:
                    end, after = attended(
                        lanes,
                        k,
                        PLACES,
                        memory,
                        returns,
                        known,
                        system,
                        here,
                        start,
                        cycles,
                        table,
                        outcomes,
                    )
                    if end == OVER:
                        lanes[lane.STAGE + k] = lane.EMPTY
                        busy -= 1
                    elif end == FLOWN:
                        put_section(lanes, k, after, start + FAR, march.impacts + 1)
                    else:
                        lanes[lane.STAGE + k] = lane.FLYING
            while lanes[lane.STAGE + k] == lane.EMPTY and fresh:
                cell = take(queue)
                fresh = cell >= 0
                if not fresh:
                    break
                a, w, sides = amplitude[cell], frequency_ratio[cell], blocks[cell]
                if unlike(sides) or sides[0, LEAN] != 1.0 or sides[0, RATE] != 1.0 or w > FASTEST:
                    outcomes.whole[cell, OUTCOME] = LEFT_OVER
                    continue
                begin_at = state_of(states, cell)
                end_half = begin_at.half_cycles + FAR
                load(lanes, k, cell, a, w, sides, 0.0)
                if begin_at.angle != 0.0:
                    side, half, phase, angle, velocity = begin_at
                    put_lane(lanes, k, March(side, angle, velocity, 0, half, phase, 0, 0), end_half)
                else:
                    system = make_system(a, w, sides)
                    impacts, first = begun(system, begin_at, cell, table, outcomes)
                    if impacts < 0:
                        lanes[lane.STAGE + k] = lane.EMPTY
                        continue
                    put_section(lanes, k, first, end_half, impacts)
                    if impacts == 0:
                        lanes[lane.STAGE + k] = lane.FLYING
                expect(lanes, k, PLACES, cycles)
                busy += 1
        if busy == 0:
            return
        remember(lanes, PLACES, LANES, memory)
        watch(lanes)
        step(lanes, FAR)


@compiled
def watch(lanes: Floats) -> None:
    """Stop lanes that are to look for an orbit, come back close enough or go astray."""
    for k in range(LANES):
        landed = lanes[lane.STAGE + k] == lane.LANDED
        lanes[lane.STAGE + k] = watched(lanes, k, PLACES, landed, FALSE)


@compiled
def put_section(lanes: Floats, k: int, state: Section, end_half: int, impacts: int) -> None:
    """Give a lane a state after so many impacts."""
    side, half_cycles, phase, speed = state
    march = March(side, 0.0, side * speed, ZERO, half_cycles, phase, impacts, ZERO)
    put_lane(lanes, k, march, end_half)
