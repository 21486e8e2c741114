"""States of a window: where they are drawn, what they settle to, and attractors at a phase."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats
from rocksteady.dynamics.basins.labels import BasinAttractor
from rocksteady.dynamics.batch.attractors import Attractors, settled_cells, starting
from rocksteady.model.checks.bounds import LARGEST_SEED, Whole
from rocksteady.model.linear_tables import only_side
from rocksteady.model.motions.fourier import PeriodicMotion, harmonics_of
from rocksteady.outcomes import AttractorKind
from rocksteady.sweep.cases.draws import uniform
from rocksteady.sweep.cases.outputs import Output

SEED = Whole(0, LARGEST_SEED, "give a seed, as 1, or leave it out")
TINY = 1e-300
"""Least angle of a state that is drawn beside a wall."""
CELL_ATTRACTOR = ("kind", "side", "phase", "speed", "period", "passages", "rests")
CELL_OUTPUTS = (
    Output(name="kind", dtype=np.int8),
    *(Output(name=name, dtype=np.int64) for name in ("side", "period", "passages", "rests")),
    *(Output(name=name) for name in ("phase", "speed", "start_angle", "start_velocity")),
)


def states_at_phase(one: BasinAttractor, motion: PeriodicMotion) -> Floats:
    """Return the states of an attractor at the phase of a motion, shape (states, 2)."""
    if one.orbit is None:
        return np.zeros((1 if one.kind is AttractorKind.REST else 0, 2))
    run, ratio = one.orbit.trajectory(), motion.frequency_ratio
    turn = 2.0 * math.pi
    first = one.orbit.states[0].phase
    since = (motion.phase - first) % turn + turn * np.arange(one.orbit.period)
    here = run(np.minimum(since / ratio, run.end_time_pt))
    points: Floats = np.column_stack([here.angle, here.velocity])
    return points


def settled_states(
    velocities: Floats,
    angles: Floats,
    number: NDArray[np.int64],
    *,
    motion: PeriodicMotion,
    sides: Floats,
    half_cycles: int,
    phase: float,
    cycles: int,
    seed: int | None,
    cell: tuple[float, float],
) -> dict[str, NDArray[Any]]:
    """Return what the states of some cells settle to."""
    angle, velocity = drawn_states(angles, velocities, number, seed, cell, sides)
    count = len(number)
    attractors = settled_cells(
        np.full(count, motion.amplitude),
        np.full(count, motion.frequency_ratio),
        sides,
        starting(angle, velocity, half_cycles, phase),
        cycles,
        harmonics_of(motion),
    )
    return {**found_in_cells(attractors), "start_angle": angle, "start_velocity": velocity}


def drawn_states(
    angles: Floats,
    velocities: Floats,
    number: NDArray[np.int64],
    seed: int | None,
    cell: tuple[float, float],
    sides: Floats,
) -> tuple[Floats, Floats]:
    """Return the angle and the velocity of a state in each cell of a window.

    Parameters
    ----------
    angles, velocities
        Middles of the cells, shape (cells,).
    number
        Numbers of the cells in the window.
    seed
        Seed of the draw; None for the middles of the cells.
    cell
        Width of a cell in angle and in velocity.
    sides
        Sides of the block, which may stand against a wall.
    """
    if seed is None:
        return angles, velocities
    part = uniform(seed, number, 2) - 0.5
    angle, velocity = angles + part[:, 0] * cell[0], velocities + part[:, 1] * cell[1]
    # A cell begins at the wall, except for rounding.
    return (np.maximum(angle, TINY) if only_side(sides) > 0 else angle), velocity


def found_in_cells(attractors: Attractors) -> dict[str, NDArray[Any]]:
    """Return what `labelled` reads of the attractors of some cells."""
    return {name: getattr(attractors, name) for name in CELL_ATTRACTOR}
