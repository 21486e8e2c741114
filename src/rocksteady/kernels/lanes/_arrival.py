"""Watch over lanes on their way to an orbit: states to remember, times to look, arrival."""

import math

import numpy as np

from rocksteady.kernels.core.forcing import TWO_PI
from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.lanes._exp_sincos import nearest_whole
from rocksteady.kernels.lanes._fields import (
    ASTRAY,
    IMPACTS,
    LAG,
    LANDED,
    LANES,
    LAUNCH,
    LEFT,
    LIMIT,
    LOOKING,
    PHASE,
    REF_IMPACTS,
    REF_LEFT,
    REF_PHASE,
    REF_VELOCITY,
    SETTLED,
    STAGE,
    VELOCITY,
    WIDEST,
)
from rocksteady.kernels.machine_code.compilation import compiled
from rocksteady.kernels.machine_code.types import Floats3
from rocksteady.kernels.orbits.periodic import SMALLEST_SPEED
from rocksteady.kernels.orbits.settle import ARRIVED, MEMORY

FAR = 2**40
"""Half cycles of a run, which is to have no end; even, and with room in a double for a phase."""

# Other uses of fields: no lane that looks for an orbit leaps over periods.
LOOK = REF_LEFT  # half cycles since the start from which on a state is looked at
NEXT = REF_IMPACTS  # impacts at which the distance to the orbit is looked at


@compiled
def remember(lanes: Floats, memory: Floats3) -> None:
    """Keep the states of lanes that have just landed, while no orbit is known."""
    for j in range(LANES):
        if lanes[STAGE + j] == LANDED and lanes[LAG + j] == 0.0:
            row = (int(lanes[IMPACTS + j]) - 1) % MEMORY
            memory[j, row, 0] = lanes[PHASE + j]
            memory[j, row, 1] = lanes[LEFT + j]
            memory[j, row, 2] = lanes[VELOCITY + j]


@compiled
def watch(lanes: Floats) -> None:
    """Stop lanes that are to look for an orbit, have arrived, gone astray or come to rest."""
    for j in range(LANES):
        stage = lanes[STAGE + j]
        phase = lanes[PHASE + j]
        velocity = lanes[VELOCITY + j]
        impacts = lanes[IMPACTS + j]
        landed = stage == LANDED
        rests = (stage == LAUNCH) & (velocity == 0.0)
        halves = (FAR - lanes[LEFT + j]) + np.floor(phase * (1.0 / math.pi))
        due = landed & (halves >= lanes[LOOK + j])
        back = landed & (impacts == lanes[NEXT + j])
        # As `rocksteady.kernels.orbits.periodic.distance` has it.
        turned = phase - lanes[REF_PHASE + j]
        turned -= TWO_PI * nearest_whole(turned * (1.0 / TWO_PI))
        speed = lanes[REF_VELOCITY + j]
        apart = max(abs(turned), abs(velocity - speed) / max(speed, SMALLEST_SPEED))
        astray = (landed & (impacts > lanes[LIMIT + j])) | (back & (apart > lanes[WIDEST + j]))
        onward = LOOKING if due else stage
        onward = ASTRAY if astray | rests else onward
        lanes[STAGE + j] = SETTLED if back & (apart <= ARRIVED) else onward
        lanes[NEXT + j] += lanes[LAG + j] if back else 0.0
