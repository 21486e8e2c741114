"""Attractors of symmetric blocks: motions side by side until they settle, orbits one by one.

`lane_attractors` does what `rocksteady.kernels.batch.attractors.settle_cells` does, for the cells
whose motion overturns or settles to an orbit without rest, as `kernels.batch.recurrence` has it.
"""

import numpy as np

from rocksteady.kernels.batch import arrival
from rocksteady.kernels.batch.arrival import FAR, STATE_COLUMNS, Room
from rocksteady.kernels.batch.attractors import state_of
from rocksteady.kernels.batch.known_orbits import KNOWN_COLUMNS
from rocksteady.kernels.batch.recurrence import FLOWN, OVER, RETURN_COLUMNS, attended, begun
from rocksteady.kernels.core.queue import enter, queue_of, take, together
from rocksteady.kernels.core.tables import LEAN, RATE, RESTITUTION, Floats
from rocksteady.kernels.core.tuples import Outcomes, States, SymmetricCells
from rocksteady.kernels.core.typed import FALSE, ZERO
from rocksteady.kernels.lanes import _fields as lane
from rocksteady.kernels.lanes._fields import FIELDS, LANES, PLACES, working
from rocksteady.kernels.lanes._loading import load, put_lane, taken
from rocksteady.kernels.lanes._nodes import node_decision, node_state
from rocksteady.kernels.lanes._passes import at_nodes, begin, census, fill_empty, in_need, step
from rocksteady.kernels.machine_code.compilation import allocating, compiled
from rocksteady.kernels.machine_code.types import Floats3, Floats4, Integers1
from rocksteady.kernels.orbits.periodic import ORBIT_COLUMNS
from rocksteady.kernels.orbits.settle import MEMORY
from rocksteady.kernels.orbits.systems import make_system


@allocating
def lane_attractors(cells: SymmetricCells, states: States, cycles: int, outcomes: Outcomes) -> None:
    """Follow motions of symmetric blocks until it is known what they settle to.

    Parameters are those of `rocksteady.kernels.batch.attractors.settle_cells`.  Of a cell that is
    left over to that kernel OUTCOME is LEFT_OVER, and the rest means nothing.
    """
    memories = np.empty((1, LANES, MEMORY, STATE_COLUMNS))
    tables = np.empty((1, MEMORY, ORBIT_COLUMNS))
    queue = queue_of(len(cells.amplitude))
    queued_lane_attractors(queue, memories, tables, cells, states, cycles, outcomes)


@allocating
def queued_lane_attractors(
    queue: Integers1,
    memories: Floats4,
    tables: Floats3,
    cells: SymmetricCells,
    states: States,
    cycles: int,
    outcomes: Outcomes,
) -> None:
    """Do what `lane_attractors` does, for the cells that this worker takes from a queue.

    Its room are rows of `memories` and `tables`, whose shapes are (workers, LANES, MEMORY,
    STATE_COLUMNS) and (workers, MEMORY, ORBIT_COLUMNS).
    """
    amplitude, frequency_ratio, restitution = cells
    worker = enter(queue)
    sides = np.zeros((2, 3))
    sides[:, LEAN] = 1.0
    sides[:, RATE] = 1.0
    returns, known = np.empty((LANES, RETURN_COLUMNS)), np.empty((0, KNOWN_COLUMNS))
    room = Room(memories[worker], returns, known, tables[worker])
    lanes = np.zeros(FIELDS * LANES)
    sides[:, RESTITUTION] = 0.5
    fill_empty(lanes, sides)
    lanes[lane.REF_PHASE : lane.REF_PHASE + LANES] = 0.0
    lanes[lane.REF_VELOCITY : lane.REF_VELOCITY + LANES] = 1.0
    fresh = True  # whether there may be cells to take
    busy = 0  # lanes that are not empty
    bounces = ZERO  # passes since the last look at short bounces ...
    delays = ZERO  # ... and at special flights
    numbers = together(census(lanes))
    while True:
        if in_need(numbers):
            for j in range(LANES):
                if lane.LEAVE <= lanes[lane.STAGE + j] < lane.DOWN:
                    cell = int(lanes[lane.CELL + j])
                    start = states.half_cycles[cell]
                    sides[:, RESTITUTION] = restitution[cell]
                    system = make_system(amplitude[cell], frequency_ratio[cell], sides)
                    arrival.draw_near(lanes, j, PLACES, FALSE)
                    march = taken(lanes, j, start + FAR, sides)
                    end, march = attended(
                        lanes, j, PLACES, room, system, march, start, cycles, outcomes
                    )
                    if end == OVER:
                        lanes[lane.STAGE + j] = lane.EMPTY
                        busy -= 1
                    elif end == FLOWN:
                        put_lane(lanes, j, march, start + FAR, sides)
                        lanes[lane.STAGE + j] = lane.LANDED
                    else:
                        lanes[lane.STAGE + j] = lane.LAUNCH
                while lanes[lane.STAGE + j] == lane.EMPTY and fresh:
                    cell = take(queue)
                    fresh = cell >= 0
                    if not fresh:
                        break
                    a, w = amplitude[cell], frequency_ratio[cell]
                    sides[:, RESTITUTION] = restitution[cell]
                    begin_at = state_of(states, cell)
                    system = make_system(a, w, sides)
                    march = begun(system, begin_at, cell, room.table, outcomes)
                    if march.impacts < 0:
                        continue
                    load(lanes, j, cell, a, w, sides, 0.0)
                    put_lane(lanes, j, march, begin_at.half_cycles + FAR, sides)
                    if march.impacts > 0:
                        lanes[lane.STAGE + j] = lane.LANDED
                    arrival.expect(lanes, j, PLACES, cycles)
                    busy += 1
            if together(busy) == 0:
                return
        elif at_nodes(numbers):
            node_state(lanes)
            numbers = together(node_decision(lanes))
            continue
        else:
            bounces = step(lanes, numbers, bounces)
        arrival.remember(lanes, PLACES, working(lanes), room.memory)
        watch(lanes)
        numbers, delays = begin(lanes, delays, FALSE)


@compiled
def watch(lanes: Floats) -> None:
    """Stop lanes that are to look for an orbit, come back close enough, go astray or rest."""
    for j in range(working(lanes)):
        stage = lanes[lane.STAGE + j]
        rests = (stage == lane.LAUNCH) & (lanes[lane.VELOCITY + j] == 0.0)
        lanes[lane.STAGE + j] = arrival.watched(lanes, j, PLACES, stage == lane.LANDED, rests)
