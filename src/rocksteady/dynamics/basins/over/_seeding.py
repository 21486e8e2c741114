"""Attractors along a parameter: those of a window, and what their neighbours settle to."""

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats, Integers
from rocksteady.dynamics.basins.cells import CELL_ATTRACTOR, found_in_cells
from rocksteady.dynamics.basins.labels import (
    BasinAttractor,
    Cells,
    labelled,
    near_state,
)
from rocksteady.dynamics.batch.attractors import settled_cells
from rocksteady.dynamics.batch.initial_states import at_phases
from rocksteady.dynamics.orbits.attractor import KINDS
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.equations import Model
from rocksteady.model.motions.fourier import PeriodicMotion, harmonics_of
from rocksteady.outcomes import AttractorKind

SEEDED = (AttractorKind.SYMMETRIC, AttractorKind.UNSYMMETRIC, AttractorKind.REST)
"""Kinds with a state from which a neighbouring value is tried."""
KEPT = (*SEEDED, AttractorKind.APERIODIC)
"""Kinds that count where only such a state has found them."""


@dataclass(kw_only=True, eq=False)
class Here:
    """What is known of the attractors at one value.

    Attributes
    ----------
    block, motion, sides
        What moves there; the phase is that of the initial states.
    cells
        What each state of the window has found, arrays of shape (states,) by name.
    label, attractors
        Labels and attractors of the states of the window, then of the seeds; once `relabel` is
        called.
    tried
        Attractors whose states have been given to the neighbours, by their names in the code.
    """

    block: Block | DimensionlessBlock
    motion: PeriodicMotion
    sides: Floats
    cells: dict[str, NDArray[np.generic]]
    label: Integers = field(default_factory=lambda: np.zeros(0, dtype=np.int64))
    attractors: tuple[BasinAttractor, ...] = ()
    tried: list[tuple[int, float, float]] = field(default_factory=list)

    def relabel(self, model: Model) -> None:
        """Give the attractors that all cells have found their labels."""
        self.label, self.attractors = labelled(self.block, self.motion, model, self.cells)

    def fresh(self) -> list[tuple[int, float, float]]:
        """Return side, phase and speed of the attractors that have not seeded yet."""
        states = []
        for attractor in self.attractors:
            if attractor.kind not in SEEDED:
                continue
            state = (0, self.motion.phase, 0.0)
            if attractor.orbit is not None:
                first = attractor.orbit.states[0]
                state = (first.side, first.phase, first.speed)
            if not any(_same(state, known) for known in self.tried):
                states.append(state)
        self.tried += states
        return states

    def knows(self, cells: Cells, place: int) -> bool:
        """Return whether what a seed has settled to is known here, or does not count."""
        kind = KINDS[int(cells["kind"][place])]
        if kind not in KEPT or any(
            attractor.kind is kind and attractor.orbit is None for attractor in self.attractors
        ):
            return True
        sample = slice(place, place + 1)
        return any(
            near_state(
                state, cells["side"][sample], cells["phase"][sample], cells["speed"][sample]
            )[0]
            for attractor in self.attractors
            if attractor.orbit is not None
            for state in attractor.orbit.states
        )

    def add(self, cells: Cells, places: list[int]) -> None:
        """Put what seeds have found behind the states of the window."""
        self.cells = {
            name: np.concatenate([values, cells[name][places]])
            for name, values in self.cells.items()
        }


def seed_neighbours(line: list[Here], cycles: int, model: Model) -> None:
    """Complete the attractors at each value by what those of its neighbours settle to there.

    From a state of each attractor the motion is followed at the value before and at the one after,
    until nothing new is found: the outcome does not depend on the order of the values.

    Parameters
    ----------
    line
        The values in their order.
    cycles
        Forcing periods after which a motion counts as unsettled.
    model
        The equations of motion.
    """
    for here in line:
        here.cells = {name: here.cells[name] for name in CELL_ATTRACTOR}
        here.relabel(model)
    while True:
        seeds = [
            (target, *state)
            for place, here in enumerate(line)
            for state in here.fresh()
            for target in (place - 1, place + 1)
            if 0 <= target < len(line)
        ]
        if not seeds:
            return
        targets = np.array([seed[0] for seed in seeds])
        side, phase, speed = (np.array(part) for part in list(zip(*seeds, strict=True))[1:])
        cases = [line[target] for target in targets.tolist()]
        settled = found_in_cells(
            settled_cells(
                np.array([case.motion.amplitude for case in cases]),
                np.array([case.motion.frequency_ratio for case in cases]),
                np.array([case.sides for case in cases]),
                at_phases(np.zeros(len(seeds)), side * speed, phase),
                cycles,
                harmonics_of(line[0].motion),
            )
        )
        for target in np.unique(targets).tolist():
            here = line[target]
            for place in np.flatnonzero(targets == target).tolist():
                if not here.knows(settled, place):
                    here.add(settled, [place])
                    here.relabel(model)


def _same(one: tuple[int, float, float], other: tuple[int, float, float]) -> bool:
    """Return whether two states of attractors are one, except for rounding."""
    turn = 2.0 * math.pi
    apart = abs(one[1] - other[1]) % turn
    near = min(apart, turn - apart) < 1e-6 and abs(one[2] - other[2]) < 1e-6
    return one[0] == other[0] and near
