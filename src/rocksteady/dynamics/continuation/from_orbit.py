"""Chain that starts a branch, from an orbit or a point of another branch."""

import math

import numpy as np

from rocksteady.dynamics.continuation.chains.chain import Chain
from rocksteady.dynamics.continuation.points import BranchPoint
from rocksteady.dynamics.orbits.orbit import Orbit
from rocksteady.dynamics.orbits.return_map import make_system, section_of
from rocksteady.errors import InputError, ModelError, Words
from rocksteady.kernels.orbits.return_map import next_passage, phase_between
from rocksteady.kernels.orbits.systems import for_system
from rocksteady.model.motions.fourier import harmonics_of


def chain_at(origin: object) -> Chain:
    """Return the chain of an orbit or of a point of a branch.

    Raises
    ------
    InputError, ModelError
        If it is neither, or comes to rest.
    """
    if isinstance(origin, BranchPoint):
        return origin.chain
    if isinstance(origin, Orbit):
        return chain_of(origin)
    raise InputError(
        "origin",
        origin,
        "it must be an orbit or a point of a branch",
        "take one of `find_orbits`, or of another branch",
    )


def chain_of(orbit: Orbit) -> Chain:
    """Return the chain of an orbit: half of it where it is symmetric.

    Raises
    ------
    ModelError
        If the orbit comes to rest, or is one of a block against a wall.
    """
    if orbit.block.one_sided:
        # A touch of the wall adds one impact: that branches end only at grazes is not proved there.
        raise ModelError(
            "origin",
            Words("is an orbit of a block against a wall"),
            "branches are followed of blocks that rock on both sides: against a wall an orbit ends "
            "in other ways than by a graze",
            "move the parameter with `sweep_attractor`, or ask for `find_orbits` at several values",
        )
    if orbit.rest_phases:
        raise ModelError(
            "origin",
            Words("is an orbit with rests"),
            "an orbit that comes to rest forgets its past and does not bifurcate smoothly",
            "start from an orbit without rest, as one of find_steady_states",
        )
    motion = orbit.motion
    states = orbit.states
    if states[0].side < 0:  # an orbit without rest goes to either side in turn
        states = (*states[1:], states[0])
    system = make_system(orbit.block, motion, orbit.model)
    following = for_system(next_passage, system)
    turns, phases = [], []
    here = section_of(states[0])
    since = 0
    for number, state in enumerate(states):
        at = section_of(state)
        if number:
            # Only a flight has the number of periods it takes.
            before = section_of(states[number - 1])
            passed = 0.0
            if orbit.admissible:
                passed = phase_between(before, following(system, before, -1.0).state)
            elif orbit.branch is not None:  # half a symmetric orbit in closed form
                passed = orbit.period * math.pi
            halves = passed / math.pi - (at.phase - before.phase) / math.pi
            since += round(halves)
        turns.append(here.half_cycles + since)
        phases.append(at.phase)
    count = len(states)
    half = orbit.symmetric
    restitution = orbit.block.dimensionless().restitution
    return Chain(
        parameters=np.array([motion.amplitude, motion.frequency_ratio, restitution]),
        turns=np.array(turns[: count // 2 if half else count], dtype=np.int64),
        phases=np.array(phases[: count // 2 if half else count]),
        half_cycles=orbit.period if half else 2 * orbit.period,
        block=orbit.block,
        model=orbit.model,
        harmonics=harmonics_of(motion),
    )
