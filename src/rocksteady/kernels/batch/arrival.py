"""Watch over lanes on their way to an orbit: states to remember, times to look, arrival.

Lanes of either model have the fields that this takes, each at places of its own.
"""

import math
from typing import NamedTuple

import numpy as np

from rocksteady.kernels.core.forcing import TWO_PI
from rocksteady.kernels.core.law import after_return, drawn_near, law_of, put_law
from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.elementary.bits import nearest_whole
from rocksteady.kernels.machine_code.compilation import compiled, inlined
from rocksteady.kernels.machine_code.types import Floats2, Floats3
from rocksteady.kernels.orbits.periodic import SMALLEST_SPEED
from rocksteady.kernels.orbits.settle import FIRST_LOOK, MEMORY, NEAR

FAR = 2**40
"""Half cycles of a run, which is to have no end; even, and with room in a double for a phase."""
CLOSE = 1e-8
"""Distance of a state from the one a return earlier at which the orbit is computed."""
GRID = 2.0**30
"""Points of a grid of states for each unit: nearer than CLOSE, above what a law leaves open."""
LOST = 10.0 * NEAR
"""The same, at which a motion has lost its way to an orbit."""
MOST_IMPACTS = 3000
"""Impacts after which a motion without an orbit in sight is left over."""

STATE_COLUMNS = 3
"""Of a remembered state: phase, half cycles left and velocity."""

# Stages of a lane of either model that waits.
LEAVE = 4.0  # for the march: one flight
FALLEN = 6.0
LOOKING = 7.25  # at the start of a flight: is there an orbit near?
SETTLED = 7.5  # the same: it has come so close to one that it is to be computed ...
ASTRAY = 7.75  # ... or has turned away


class Places(NamedTuple):
    """Where the fields of lanes begin in their flat array, and how many lanes there are."""

    width: int
    stage: int
    cell: int
    phase: int
    velocity: int
    left: int
    impacts: int
    limit: int  # impacts at which the motion is left over, or the approach ends
    delta: int
    time: int
    ref_phase: int  # of the state that it comes back to, the last time
    ref_velocity: int
    look: int  # half cycles since the start from which on a state is looked at
    next: int  # impacts at which the motion is next back
    lag: int
    known: int  # whether the law of the returns is that of a stable orbit
    law: int
    area: int


class Room(NamedTuple):
    """What lanes that look for orbits share."""

    memory: Floats3  # last states of each lane, shape (lanes, MEMORY, STATE_COLUMNS)
    returns: Floats2  # returns that are watched, shape (lanes, RETURN_COLUMNS)
    known: Floats2  # orbits that have been found: `kernels.batch.known_orbits`
    table: Floats2  # room for an orbit, shape (MEMORY, ORBIT_COLUMNS)


def places_of(width: int, *own: int, reference: int) -> Places:
    """Return the places of the lanes of a model, in order; those of `core.returns` from one on."""
    return Places(width, *own, *(reference + width * field for field in (0, 1, 2, 3, 4, 5, 6, 8)))


@compiled
def expect(lanes: Floats, j: int, places: Places, cycles: int) -> None:
    """Let a lane that begins a motion look for an orbit in time."""
    lanes[places.look + j] = 2.0 * min(FIRST_LOOK, cycles)
    lanes[places.next + j] = math.inf
    lanes[places.limit + j] = MOST_IMPACTS
    lanes[places.ref_phase + j], lanes[places.ref_velocity + j] = 0.0, 1.0


@inlined
def remember(lanes: Floats, places: Places, many: int, memory: Floats3) -> None:
    """Keep the states of so many lanes, each in the row of its last impact."""
    for j in range(many):
        row = (int(lanes[places.impacts + j]) - 1) & (MEMORY - 1)
        memory[j, row, 0] = lanes[places.phase + j]
        memory[j, row, 1] = lanes[places.left + j]
        memory[j, row, 2] = lanes[places.velocity + j]


@inlined
def watched(lanes: Floats, j: int, places: Places, landed: bool, rests: bool) -> float:
    """Return the stage of a lane, which stops to look for an orbit, near one, astray or at rest.

    `landed` and `rests` say whether it is at the start of a flight after an impact, and at a rest.
    """
    stage = lanes[places.stage + j]
    phase = lanes[places.phase + j]
    velocity = lanes[places.velocity + j]
    impacts = lanes[places.impacts + j]
    limit = lanes[places.limit + j]
    ref_phase = lanes[places.ref_phase + j]
    ref_velocity = lanes[places.ref_velocity + j]
    halves = (FAR - lanes[places.left + j]) + np.floor(phase * (1.0 / math.pi))
    due = landed & (halves >= lanes[places.look + j])
    back = landed & (impacts == lanes[places.next + j])
    # As `rocksteady.kernels.orbits.periodic.distance` has it.
    turned = phase - ref_phase
    turned -= TWO_PI * nearest_whole(turned * (1.0 / TWO_PI))
    faster = velocity - ref_velocity
    apart = max(abs(turned), abs(faster) / max(ref_velocity, SMALLEST_SPEED))
    delta = lanes[places.delta + j]
    area = lanes[places.area + j] * (delta * delta if landed else 1.0)
    law, attracted = after_return(
        law_of(lanes, places.law + j, places.width, area),
        back,
        turned if back else 0.0,
        faster if back else 0.0,
    )
    put_law(lanes, places.law + j, places.width, law)
    lanes[places.area + j] = 1.0 if back & (not attracted) else law.area
    lanes[places.known + j] = 1.0 if attracted else lanes[places.known + j]
    astray = back & (apart > LOST)
    over = landed & (lanes[places.lag + j] == 0.0) & (impacts > limit)
    onward = LOOKING if due else stage
    onward = SETTLED if back & (attracted | (apart <= CLOSE) | (impacts >= limit)) else onward
    lanes[places.ref_phase + j] = phase if back else ref_phase
    lanes[places.ref_velocity + j] = velocity if back else ref_velocity
    lanes[places.next + j] += lanes[places.lag + j] if back else 0.0
    return ASTRAY if astray | over | rests else onward


@compiled
def draw_near(lanes: Floats, j: int, places: Places, on_grid: bool) -> None:
    """Put a lane to be computed where the law of its returns leads; `on_grid` if others are too."""
    if lanes[places.stage + j] != SETTLED:
        return
    if lanes[places.known + j] > 0.0:
        law = law_of(lanes, places.law + j, places.width, lanes[places.area + j])
        further, faster = drawn_near(law, math.inf)
        lanes[places.phase + j] += further
        lanes[places.velocity + j] += faster
    if on_grid and lanes[places.velocity + j] > SMALLEST_SPEED:
        for place in (places.phase + j, places.velocity + j):
            lanes[place] = nearest_whole(lanes[place] * GRID) / GRID
