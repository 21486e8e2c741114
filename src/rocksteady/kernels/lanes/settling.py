"""Attractors of symmetric blocks: motions side by side until they settle, orbits one by one.

`lane_attractors` does what `rocksteady.kernels.batch.attractors.settle_cells` does, for the cells
whose motion overturns or settles to an orbit without rest.  A lane remembers its last states
after impacts and looks at the same times as `rocksteady.kernels.orbits.settle.settle` whether it
has come back near one of them.  If so it flies on, until it comes back much closer; the scalar
code then finds the orbit in a step or two of Newton's method and judges it (`computed`).  Whatever
else happens (a rest, a motion that does not settle, a return that leads to no stable orbit) is
left to the scalar code from the start: a cell that the lanes settle has the answer of that, but
for roundings on the way to the orbit.
"""

import math

import numpy as np

from rocksteady.kernels.batch.attractors import OUTCOME, note_attractor, state_of
from rocksteady.kernels.core.law import drawn_near, law_of
from rocksteady.kernels.core.queue import LEFT_OVER, enter, queue_of, take, together
from rocksteady.kernels.core.tables import LEAN, RATE, RESTITUTION, Floats, March
from rocksteady.kernels.core.tuples import Outcomes, States, SymmetricCells
from rocksteady.kernels.core.typed import FALSE, ONE, ZERO
from rocksteady.kernels.lanes import _fields as lane
from rocksteady.kernels.lanes._arrival import FAR, KNOWN_LAW, LOOK, NEXT, remember, watch
from rocksteady.kernels.lanes._fields import FIELDS, LANES
from rocksteady.kernels.lanes._loading import load, put_lane, taken
from rocksteady.kernels.lanes._nodes import node_decision, node_state
from rocksteady.kernels.lanes._passes import at_nodes, begin, census, fill_empty, in_need, step
from rocksteady.kernels.lanes._periods import put_state
from rocksteady.kernels.lanes._recurrence import RETURN_COLUMNS, computed, returning
from rocksteady.kernels.machine_code.compilation import allocating, compiled
from rocksteady.kernels.machine_code.types import (
    Floats2,
    Floats3,
    Floats4,
    Integers1,
)
from rocksteady.kernels.orbits.periodic import (
    ORBIT_COLUMNS,
)
from rocksteady.kernels.orbits.return_map import (
    FALL,
    IMPACT,
    STAY,
    UPLIFT,
    Section,
    first_passage,
    next_passage,
)
from rocksteady.kernels.orbits.settle import (
    FALLS,
    FIRST_LOOK,
    MEMORY,
    STAYS,
    unsettled,
)
from rocksteady.kernels.orbits.systems import make_system

MOST_IMPACTS = 3000
"""Impacts after which a motion without an orbit in sight is left over."""
STATE_COLUMNS = 3
"""Of a remembered state: phase, half cycles left and velocity."""


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
    memory, table = memories[worker], tables[worker]
    sides = np.zeros((2, 3))
    sides[:, LEAN] = 1.0
    sides[:, RATE] = 1.0
    returns = np.empty((LANES, RETURN_COLUMNS))
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
                    begun = states.half_cycles[int(lanes[lane.CELL + j])]
                    if attended(lanes, j, memory, returns, sides, begun, cycles, table, outcomes):
                        lanes[lane.STAGE + j] = lane.EMPTY
                        busy -= 1
                while lanes[lane.STAGE + j] == lane.EMPTY and fresh:
                    cell = take(queue)
                    fresh = cell >= 0
                    if not fresh:
                        break
                    a, w = amplitude[cell], frequency_ratio[cell]
                    sides[:, RESTITUTION] = restitution[cell]
                    load(lanes, j, cell, a, w, sides, 0.0)
                    start = state_of(states, cell)
                    half = start.half_cycles
                    toward = start.side * start.velocity
                    if start.angle == 0.0 and toward > 0.0:
                        flight = Section(start.side, half, start.phase, toward)
                        put_section(lanes, j, flight, half + FAR, ZERO, sides)
                        lanes[lane.STAGE + j] = lane.LAUNCH
                    else:
                        system = make_system(a, w, sides)
                        first = first_passage(system, start)
                        after = (first.state.half_cycles - half) // 2
                        if first.kind in (FALL, STAY):
                            outcome = FALLS if first.kind == FALL else STAYS
                            found = unsettled(outcome, first.state, math.nan, math.nan, after, 0.0)
                            note_attractor(system, found, table, outcomes, cell)
                            continue
                        if first.kind not in (IMPACT, UPLIFT):
                            outcomes.whole[cell, OUTCOME] = LEFT_OVER
                            continue
                        put_section(lanes, j, first.state, half + FAR, ONE, sides)
                    lanes[LOOK + j] = 2.0 * min(FIRST_LOOK, cycles)
                    lanes[NEXT + j] = math.inf
                    lanes[lane.LIMIT + j] = MOST_IMPACTS
                    lanes[lane.REF_PHASE + j], lanes[lane.REF_VELOCITY + j] = 0.0, 1.0
                    busy += 1
            if together(busy) == 0:
                return
        elif at_nodes(numbers):
            node_state(lanes)
            numbers = together(node_decision(lanes))
            continue
        else:
            bounces = step(lanes, numbers, bounces)
        remember(lanes, memory)
        watch(lanes)
        numbers, delays = begin(lanes, delays, FALSE)


@compiled
def put_section(
    lanes: Floats, j: int, state: Section, end_half: int, impacts: int, sides: Floats2
) -> None:
    """Give a lane a state after so many impacts."""
    side, half_cycles, phase, speed = state
    march = March(side, 0.0, side * speed, ZERO, half_cycles, phase, impacts, ZERO)
    put_lane(lanes, j, march, end_half, sides)
    lanes[lane.STAGE + j] = lane.LANDED


@compiled
def attended(
    lanes: Floats,
    j: int,
    memory: Floats3,
    returns: Floats2,
    sides: Floats2,
    start: int,
    cycles: int,
    table: Floats2,
    outcomes: Outcomes,
) -> bool:
    """Help a waiting lane on; return whether its motion is over, with its row written."""
    stage = lanes[lane.STAGE + j]
    cell = int(lanes[lane.CELL + j])
    if stage == lane.SETTLED and lanes[KNOWN_LAW + j] > 0.0:
        law = law_of(lanes, lane.PRODUCT + j, LANES, lanes[lane.AREA + j])
        further, faster = drawn_near(law, math.inf)
        put_state(lanes, j, lanes[lane.PHASE + j] + further, lanes[lane.VELOCITY + j] + faster)
    taken_up = taken(lanes, j, start + FAR, sides)
    here = Section(taken_up.side, taken_up.half_cycles, taken_up.phase, abs(taken_up.velocity))
    passed = (here.half_cycles - start) // 2
    falls = stage == lane.FALLEN and lanes[lane.LAG + j] == 0.0
    if stage == lane.LOOKING:
        if returning(lanes, j, memory, returns, passed):
            lanes[lane.STAGE + j] = lane.LAUNCH
            return False
        if passed < cycles:
            lanes[LOOK + j] = 2.0 * min(passed + passed // 2, cycles)
            lanes[lane.STAGE + j] = lane.LAUNCH
            return False
    sides[:, RESTITUTION] = lanes[lane.DELTA + j]
    system = make_system(lanes[lane.AMPLITUDE + j], lanes[lane.FREQUENCY + j], sides)
    if stage == lane.LEAVE:
        after = next_passage(system, here, -1.0)
        if after.kind == IMPACT:
            put_section(lanes, j, after.state, start + FAR, taken_up.impacts + 1, sides)
            return False
        falls = after.kind == FALL and lanes[lane.LAG + j] == 0.0
    if stage == lane.SETTLED and computed(lanes, j, memory, returns, system, here, table, outcomes):
        return True
    if falls:
        found = unsettled(FALLS, here, math.nan, math.nan, passed, 0.0)
        note_attractor(system, found, table, outcomes, cell)
        return True
    outcomes.whole[cell, OUTCOME] = LEFT_OVER
    return True
