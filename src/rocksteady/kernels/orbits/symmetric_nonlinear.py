"""Symmetric orbits of the nonlinear model: Newton's method on half cycles, continued in alpha.

The half cycle of a symmetric orbit takes a state to its mirror image, n half periods of the shaking
later, in one passage.  In coordinates (phase, speed) that image is the state itself, so that the
half cycle is a map with a fixed point, and the derivative of the passage is its own.  That
derivative has determinant ``delta^2`` and trace T.  Both models have two such orbits above a fold,
at which ``T = 1 + delta^2``: branch 1 has a smaller trace, branch 2 a larger one.
"""

import math
from typing import NamedTuple

from rocksteady.kernels.core.tables import ALPHA, RESTITUTION
from rocksteady.kernels.machine_code.compilation import allocating, compiled
from rocksteady.kernels.machine_code.types import Floats2
from rocksteady.kernels.orbits.periodic import (
    CLOSED,
    EXACT,
    LARGEST_STEP,
    SMALLEST_SPEED,
    STEPS,
    mirror,
)
from rocksteady.kernels.orbits.return_map import (
    IMPACT,
    Jacobian,
    Section,
    identity,
    next_passage,
    phase_between,
    shifted,
)
from rocksteady.kernels.orbits.systems import System, make_system

SHORTEST = 2.0**-20
"""Part of the square of the slenderness below which a step is given up."""
FARTHEST = 0.2
"""Change of phase [rad], or of the speed relative to itself, that one step may bring."""


class Half(NamedTuple):
    """An attempt to find a symmetric orbit."""

    found: bool
    state: Section
    jacobian: Jacobian  # of its half cycle


@compiled
def symmetric_near(system: System, state: Section, order: int) -> Half:
    """Find the symmetric orbit near a state whose half cycle takes n half periods.

    It counts as found where its half cycle closes as any orbit does, or where its state is known as
    well: a very unstable half cycle magnifies the last digit of a state beyond that.

    Parameters
    ----------
    system
        The shaken block, whose sides are alike.
    state
        Where the search begins.
    order
        n, odd.
    """
    nothing = Half(False, state, identity())
    error = math.inf
    for _ in range(STEPS):
        step = next_passage(system, state, -1.0)
        if step.kind != IMPACT or state.speed <= 0.0:
            return nothing
        there, size = mirror(state, order), max(state.speed, SMALLEST_SPEED)
        phase, speed = phase_between(there, step.state), step.state.speed - state.speed
        a, b = step.jacobian.phase_by_phase - 1.0, step.jacobian.phase_by_speed
        c, d = step.jacobian.speed_by_phase, step.jacobian.speed_by_speed - 1.0
        determinant = a * d - b * c
        if determinant == 0.0 or not math.isfinite(determinant):
            return nothing
        by_phase = -(d * phase - b * speed) / determinant
        by_speed = -(a * speed - c * phase) / determinant
        length = max(abs(by_phase), abs(by_speed) / size)
        before, error = error, min(max(abs(phase), abs(speed) / size), length)
        if not math.isfinite(length):
            return nothing
        if error <= EXACT or (before <= CLOSED and error >= 0.5 * before):  # rounding
            return Half(min(error, before) <= CLOSED, state, step.jacobian)
        part = 1.0 / max(1.0, length / LARGEST_STEP)
        state = shifted(state, part * by_phase, part * by_speed)
    return nothing


@allocating
def symmetric_from(
    amplitude: float,
    frequency_ratio: float,
    sides: Floats2,
    order: int,
    branch: int,
    state: Section,
) -> Half:
    """Return the symmetric orbit of the nonlinear model to which one of the linear model leads.

    The slenderness is raised from 0 to the block's own, in as few steps of its square as Newton's
    method can follow; on the way the trace stays on its side of that of the fold.

    Parameters
    ----------
    amplitude, frequency_ratio
        Of the shaking.
    sides
        Of the block, both alike, shape (2, 5).
    order, branch
        n, and 1 or 2.
    state
        Of the linear model's orbit, on the positive side.

    Returns
    -------
    Half
        Not found where the branch ends before, in a fold or as the floor comes in its way.
    """
    table = sides.copy()
    fold = 1.0 + sides[0, RESTITUTION] * sides[0, RESTITUTION]
    reached, step = 0.0, 1.0
    found = Half(False, state, identity())
    # How the orbit moves with the square of the slenderness.  Of a very unstable one Newton's
    # method finds nothing but what is predicted to a part of its multiplier.
    turn = gain = 0.0
    while reached < 1.0:
        part = min(reached + step, 1.0)
        root = math.sqrt(part)
        for row in range(2):
            table[row, ALPHA] = root * sides[row, ALPHA]
        system = make_system(amplitude, frequency_ratio, table)
        passed = part - reached
        found = symmetric_near(system, shifted(state, passed * turn, passed * gain), order)
        trace = found.jacobian.phase_by_phase + found.jacobian.speed_by_speed
        phase = phase_between(state, found.state)
        speed = found.state.speed - state.speed
        near = max(abs(phase), abs(speed) / state.speed) <= FARTHEST
        if found.found and near and (trace < fold) == (branch == 1):
            turn, gain = phase / passed, speed / passed
            state, reached, step = found.state, part, 2.0 * step
        else:
            step *= 0.5
            if step < SHORTEST:
                return Half(False, state, found.jacobian)
    return found
