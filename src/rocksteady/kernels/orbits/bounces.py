"""End of the bounces that come to rest: where infinitely many impacts accumulate."""

import math
from typing import NamedTuple

from rocksteady.kernels.core.clock import side_phase
from rocksteady.kernels.elementary.circular import cos, sin
from rocksteady.kernels.machine_code.compilation import compiled
from rocksteady.kernels.orbits.return_map import (
    IMPACT,
    AnyState,
    Section,
    first_passage,
    phase_between,
)
from rocksteady.kernels.orbits.systems import System, forcing_of, next_side

ENOUGH = 1e-14
"""Error of the end of the bounces, as a phase [rad], with which their sum is content."""
MOST_BOUNCES = 400
"""Bounces that are followed for it."""


class Pull(NamedTuple):
    """What brings a block on its base back from a side."""

    size: float
    rate: float  # at which it changes
    loss: float  # the restitution of that side


@compiled
def chatter_end(system: System, begin: Section, state: Section) -> tuple[float, float, int]:
    """Return the phase from an uplift until bounces die out, its error [rad], and their number.

    Bounces are followed until those still to come are known well enough from a series in the speed
    of the next one.  The error leaves out the rounding of each bounce.

    Parameters
    ----------
    system
        The shaken block.
    begin
        The uplift.
    state
        After an impact from which the bounces are proved to die out.
    """
    count = 0
    while True:
        count += 1
        left, error = still_to_come(system, state)
        if error * system.frequency <= ENOUGH or count == MOST_BOUNCES:
            break
        velocity = state.side * state.speed
        start = AnyState(state.side, state.half_cycles, state.phase, 0.0, velocity)
        step = first_passage(system, start)
        if step.kind != IMPACT:  # so slow that it counts as a graze
            break
        state = step.state
    passed = phase_between(begin, state)
    return passed + system.frequency * left, system.frequency * error, count


@compiled
def still_to_come(system: System, state: Section) -> tuple[float, float]:
    """Return the pivot time that bounces still last, and its error.

    With the pull c of a side, which changes at the rate c', a bounce of speed v lasts
    ``2 v/c - 4 c' v^2/(3 c^3)`` and lands with ``v + 2 c' v^2/(3 c^2)``.  Summed over all bounces
    that makes ``a v + b v^2``; each term is smaller than the one before by v/c (1 + c'/c) over what
    two impacts lose, from which the error is estimated.
    """
    v = state.speed
    if v == 0.0:
        return 0.0, 0.0
    here = pull_of(system, state, state.side)
    there = pull_of(system, state, next_side(system, state.side))
    c, d = here.size, there.size
    if c <= 0.0 or d <= 0.0:
        return math.inf, math.inf
    kept = 1.0 - here.loss * there.loss
    linear = 2.0 * (1.0 / c + here.loss / d) / kept
    linear_there = 2.0 * (1.0 / d + there.loss / c) / kept
    drift = -2.0 * (here.rate / (c * c) + here.loss * there.rate / (d * d)) / kept
    drift_there = -2.0 * (there.rate / (d * d) + there.loss * here.rate / (c * c)) / kept
    b = second_of(here, linear_there, drift_there)
    b_there = second_of(there, linear, drift)
    both = here.loss * there.loss
    quadratic = (b + here.loss * here.loss * b_there) / (1.0 - both * both)
    steepest = max((1.0 + abs(here.rate) / c) / c, (1.0 + abs(there.rate) / d) / d)
    size = max(abs(quadratic * v / linear), 2.0 * v * steepest / kept)
    return linear * v + quadratic * v * v, linear * v * size * size


@compiled
def second_of(here: Pull, after: float, moved: float) -> float:
    """Return what the first bounce adds to the square of its speed, and to the bounces after it."""
    c = here.size
    lands = 2.0 * here.rate / (3.0 * c * c)
    lasts = -4.0 * here.rate / (3.0 * c * c * c)
    return lasts + here.loss * (after * lands + moved * 2.0 / c)


@compiled
def pull_of(system: System, state: Section, side: int) -> Pull:
    """Return the pull back from a side at the phase of a state."""
    row = 0 if side > 0 else 1
    forcing = forcing_of(system, side)
    seen, _ = side_phase(state.half_cycles, state.phase, side, system.frequency)
    unit = system.lean[row] * system.rate[row] * system.rate[row]
    pull = -(forcing.constant + forcing.amplitude * sin(seen)) * unit
    rate = -forcing.amplitude * cos(seen) * system.frequency * unit
    return Pull(pull, rate, abs(system.restitution[row]))
