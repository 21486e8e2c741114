"""Attractors of symmetric blocks in the nonlinear model, followed side by side.

`nonlinear_lane_attractors` does what `rocksteady.kernels.lanes.settling.lane_attractors` does, by
the steps of `loop.nonlinear_lane_fates`.
"""

import math

import numpy as np

from rocksteady.kernels.batch import arrival
from rocksteady.kernels.batch.arrival import FAR, STATE_COLUMNS, Room
from rocksteady.kernels.batch.attractors import OUTCOME, state_of
from rocksteady.kernels.batch.known_orbits import KNOWN, KNOWN_COLUMNS
from rocksteady.kernels.batch.recurrence import (
    FLOWN,
    OVER,
    RETURN_COLUMNS,
    attended,
    begun,
    section_of,
)
from rocksteady.kernels.core.other_side import unlike
from rocksteady.kernels.core.queue import LEFT_OVER, enter, queue_of, take
from rocksteady.kernels.core.tables import LEAN, RATE, Floats, March
from rocksteady.kernels.core.tuples import Cells, Outcomes, States
from rocksteady.kernels.core.typed import FALSE, TRUE
from rocksteady.kernels.machine_code.compilation import allocating, compiled
from rocksteady.kernels.machine_code.types import Floats3, Floats4, Integers1
from rocksteady.kernels.nonlinear_lanes import _layout as lane
from rocksteady.kernels.nonlinear_lanes._layout import LANES, PLACES
from rocksteady.kernels.nonlinear_lanes._transfer import load, put_lane, taken
from rocksteady.kernels.nonlinear_lanes.loop import FASTEST, ROOM, aligned, fill_empty, step
from rocksteady.kernels.orbits.periodic import ORBIT_COLUMNS
from rocksteady.kernels.orbits.return_map import comes_to_rest
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
    returns = np.empty((LANES, RETURN_COLUMNS))
    room = Room(memories[worker], returns, orbits[worker], tables[worker])
    room.known[:, 0] = math.nan
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
                arrival.draw_near(lanes, k, PLACES, TRUE)
                march = taken(lanes, k, start + FAR)
                if stage == lane.LEAVE and lanes[lane.START_ANGLE + k] != 0.0:
                    lanes[lane.STAGE + k] = lane.ASTRAY
                elif stage == lane.SLOW:
                    rests = comes_to_rest(system, section_of(march), 0.0)
                    lanes[lane.STAGE + k] = lane.ASTRAY if rests else lane.LANDED
                if lanes[lane.STAGE + k] >= lane.LEAVE:
                    end, march = attended(
                        lanes, k, PLACES, room, system, march, start, cycles, outcomes
                    )
                    if end == OVER:
                        lanes[lane.STAGE + k] = lane.EMPTY
                        busy -= 1
                    elif end == FLOWN:
                        put_lane(lanes, k, march, start + FAR)
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
                side, half, phase, angle, velocity = begin_at = state_of(states, cell)
                march = March(side, angle, velocity, 0, half, phase, 0, 0)
                if angle == 0.0:
                    system = make_system(a, w, sides)
                    march = begun(system, begin_at, cell, room.table, outcomes)
                    if march.impacts < 0:
                        continue
                load(lanes, k, cell, a, w, sides, 0.0)
                put_lane(lanes, k, march, half + FAR)
                if march.impacts == 0 and lanes[lane.STAGE + k] == lane.LANDED:
                    lanes[lane.STAGE + k] = lane.FLYING
                arrival.expect(lanes, k, PLACES, cycles)
                busy += 1
        if busy == 0:
            return
        arrival.remember(lanes, PLACES, LANES, room.memory)
        watch(lanes)
        step(lanes, FAR)


@compiled
def watch(lanes: Floats) -> None:
    """Stop lanes that are to look for an orbit, come back close enough or go astray."""
    for k in range(LANES):
        landed = lanes[lane.STAGE + k] == lane.LANDED
        lanes[lane.STAGE + k] = arrival.watched(lanes, k, PLACES, landed, FALSE)
