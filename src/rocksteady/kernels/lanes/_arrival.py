"""Watch over lanes on their way to an orbit: states to remember, times to look, arrival."""

import math

import numpy as np

from rocksteady.kernels.core.forcing import TWO_PI
from rocksteady.kernels.core.law import after_return, law_of, put_law
from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.lanes import _fields as lane
from rocksteady.kernels.lanes._exp_sincos import nearest_whole
from rocksteady.kernels.lanes._fields import LANES, working
from rocksteady.kernels.machine_code.compilation import compiled
from rocksteady.kernels.machine_code.types import Floats3
from rocksteady.kernels.orbits.periodic import SMALLEST_SPEED
from rocksteady.kernels.orbits.settle import MEMORY, NEAR

FAR = 2**40
"""Half cycles of a run, which is to have no end; even, and with room in a double for a phase."""
CLOSE = 1e-8
"""Distance of a state from the one a return earlier at which the orbit is computed."""
LOST = 10.0 * NEAR
"""The same, at which a motion has lost its way to an orbit."""

# Other uses of fields: no lane that looks for an orbit leaps over periods.
LOOK = lane.REF_LEFT  # half cycles since the start from which on a state is looked at
# Impacts at which the motion is next back; REF_PHASE and REF_VELOCITY are of the last time.
NEXT = lane.REF_IMPACTS
KNOWN_LAW = lane.WIDEST  # whether the law of the returns is that of a stable orbit


@compiled
def remember(lanes: Floats, memory: Floats3) -> None:
    """Keep the states of lanes, each in the row of its last impact."""
    for j in range(working(lanes)):
        row = (int(lanes[lane.IMPACTS + j]) - 1) & (MEMORY - 1)
        memory[j, row, 0] = lanes[lane.PHASE + j]
        memory[j, row, 1] = lanes[lane.LEFT + j]
        memory[j, row, 2] = lanes[lane.VELOCITY + j]


@compiled
def watch(lanes: Floats) -> None:
    """Stop lanes that are to look for an orbit, come back close enough, go astray or rest."""
    for j in range(working(lanes)):
        stage = lanes[lane.STAGE + j]
        phase = lanes[lane.PHASE + j]
        velocity = lanes[lane.VELOCITY + j]
        impacts = lanes[lane.IMPACTS + j]
        limit = lanes[lane.LIMIT + j]
        ref_phase = lanes[lane.REF_PHASE + j]
        ref_velocity = lanes[lane.REF_VELOCITY + j]
        landed = stage == lane.LANDED
        rests = (stage == lane.LAUNCH) & (velocity == 0.0)
        halves = (FAR - lanes[lane.LEFT + j]) + np.floor(phase * (1.0 / math.pi))
        due = landed & (halves >= lanes[LOOK + j])
        back = landed & (impacts == lanes[NEXT + j])
        # As `rocksteady.kernels.orbits.periodic.distance` has it.
        turned = phase - ref_phase
        turned -= TWO_PI * nearest_whole(turned * (1.0 / TWO_PI))
        faster = velocity - ref_velocity
        apart = max(abs(turned), abs(faster) / max(ref_velocity, SMALLEST_SPEED))
        delta = lanes[lane.DELTA + j]
        area = lanes[lane.AREA + j] * (delta * delta if landed else 1.0)
        law, attracted = after_return(
            law_of(lanes, lane.PRODUCT + j, LANES, area),
            back,
            turned if back else 0.0,
            faster if back else 0.0,
        )
        put_law(lanes, lane.PRODUCT + j, LANES, law)
        lanes[lane.AREA + j] = 1.0 if back & (not attracted) else law.area
        lanes[KNOWN_LAW + j] = 1.0 if attracted else lanes[KNOWN_LAW + j]
        astray = back & (apart > LOST)
        over = landed & (lanes[lane.LAG + j] == 0.0) & (impacts > limit)
        onward = lane.LOOKING if due else stage
        onward = (
            lane.SETTLED if back & (attracted | (apart <= CLOSE) | (impacts >= limit)) else onward
        )
        lanes[lane.STAGE + j] = lane.ASTRAY if astray | over | rests else onward
        lanes[lane.REF_PHASE + j] = phase if back else ref_phase
        lanes[lane.REF_VELOCITY + j] = velocity if back else ref_velocity
        lanes[NEXT + j] += lanes[lane.LAG + j] if back else 0.0
