"""Attractors found in a window of initial states, distinguished and numbered."""

import math
import string
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats, Integers
from rocksteady.dynamics.history.start import ImpactState, Rest
from rocksteady.dynamics.orbits.attractor import KINDS
from rocksteady.dynamics.orbits.orbit import Orbit, orbit_from
from rocksteady.dynamics.orbits.return_map import make_system, section_of
from rocksteady.dynamics.orbits.search import SAME
from rocksteady.errors import ModelError, Words
from rocksteady.kernels.orbits import periodic
from rocksteady.kernels.orbits.systems import for_system
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked_result
from rocksteady.model.equations import Model
from rocksteady.model.motions.fourier import PeriodicMotion
from rocksteady.outcomes import AttractorKind
from rocksteady.results.result import Result

Cells = Mapping[str, NDArray[Any]]

ORDER = (
    AttractorKind.OVERTURNED,
    AttractorKind.REST,
    AttractorKind.SYMMETRIC,
    AttractorKind.UNSYMMETRIC,
    AttractorKind.APERIODIC,
    AttractorKind.UNDECIDED,
)
"""Of the labels, symmetric and unsymmetric orbits together by period."""
PERIODIC = {AttractorKind.SYMMETRIC, AttractorKind.UNSYMMETRIC}
TURN = 2.0 * math.pi


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class BasinAttractor(Result):
    """Attractor of the states of one basin.

    Attributes
    ----------
    label
        Its number in `Basins.label`.
    kind
        What it is.
    name
        Its own among the attractors of a window: the kind, and of orbits the period too, with a
        letter where several have both in common.
    orbit
        The periodic motion, started at its state of the smallest phase; None of every other kind.
    """

    label: int
    kind: AttractorKind
    name: str
    orbit: Orbit | None

    @property
    def period(self) -> int | None:
        """Forcing periods of the orbit; None without one."""
        return None if self.orbit is None else self.orbit.period

    @property
    def impacts(self) -> int | None:
        """Impacts in a period of the orbit; 0 without one, None for infinitely many."""
        return 0 if self.orbit is None else self.orbit.impacts

    @property
    def start(self) -> Rest | ImpactState:
        """A start on the attractor, for `simulate` with the block and the motion of the basins.

        Raises
        ------
        ModelError
            If it is neither an orbit nor the rest.
        """
        if self.orbit is not None:
            return self.orbit.states[0]
        if self.kind is AttractorKind.REST:
            return Rest()
        raise ModelError(
            "start",
            Words(f"is on the attractor {self.name}"),
            "only an orbit and the rest have a state to start from",
            "start from a cell of the basin, as basins.state(row, column)",
        )


def labelled(
    block: Block | DimensionlessBlock, motion: PeriodicMotion, model: Model, cells: Cells
) -> tuple[Integers, tuple[BasinAttractor, ...]]:
    """Return the labels of cells and the attractors in the order of their labels.

    Parameters
    ----------
    block, motion, model
        What moves, and by which equations.
    cells
        What each cell has found, arrays of one shape by the names of
        `rocksteady.dynamics.batch.attractors.Attractors`.
    """
    kind = cells["kind"]
    classes: list[tuple[AttractorKind, Orbit | None, NDArray[np.bool_]]] = [
        (which, None, kind == KINDS.index(which))
        for which in ORDER
        if which not in PERIODIC and (kind == KINDS.index(which)).any()
    ]
    classes += [
        (AttractorKind(orbit.kind), orbit, of) for orbit, of in _orbits(block, motion, model, cells)
    ]
    classes.sort(key=lambda entry: _order(entry[0], entry[1]))
    names = attractor_names([(which, orbit) for which, orbit, _ in classes])
    label = np.full(kind.shape, -1, dtype=np.int64)
    for place, (_, _, of) in enumerate(classes):
        label[of] = place
    return label, tuple(
        BasinAttractor(label=number, kind=which, name=name, orbit=orbit)
        for number, ((which, orbit, _), name) in enumerate(zip(classes, names, strict=True))
    )


def _order(kind: AttractorKind, orbit: Orbit | None) -> tuple[object, ...]:
    """Return where an attractor stands among others; mirror images stand side by side."""
    if orbit is None:
        return (ORDER.index(kind),)
    largest = max(orbit.highest, -orbit.lowest)
    return (
        ORDER.index(AttractorKind.SYMMETRIC),
        orbit.period,
        len(orbit.states),
        not orbit.symmetric,
        -round(largest, 9),
        orbit.highest < -orbit.lowest,
    )


def attractor_names(attractors: list[tuple[AttractorKind, Orbit | None]]) -> Iterator[str]:
    """Yield a name for each attractor: kind and period, with a letter where several share them."""
    plain = [
        str(kind.value) if orbit is None else f"{kind.value}-{orbit.period}"
        for kind, orbit in attractors
    ]
    several, before = Counter(plain), Counter[str]()
    for name in plain:
        letter = before[name]
        before[name] += 1
        if several[name] == 1:
            yield name
        else:
            suffix = string.ascii_lowercase[letter] if letter < 26 else f"-{letter + 1}"
            yield name + suffix


def _orbits(
    block: Block | DimensionlessBlock, motion: PeriodicMotion, model: Model, cells: Cells
) -> Iterator[tuple[Orbit, NDArray[np.bool_]]]:
    """Yield each orbit that cells have found, and which cells."""
    left = cells["period"] > 0
    while left.any():
        first = np.unravel_index(int(np.argmax(left)), left.shape)
        cell = {name: values[first].item() for name, values in cells.items()}
        orbit = _orbit(block, motion, model, cell)
        same = left.copy()
        for name in ("period", "passages", "rests"):
            same &= cells[name] == cell[name]
        on = np.zeros_like(left)
        for state in orbit.states:
            on[same] |= near_state(
                state, cells["side"][same], cells["phase"][same], cells["speed"][same]
            )
        on[first] = True  # whatever rounding gives
        yield orbit, on
        left &= ~on


def near_state(
    state: ImpactState, side: Integers, phase: Floats, speed: Floats
) -> NDArray[np.bool_]:
    """Return which states are one with another, as in `rocksteady.dynamics.orbits.search`."""
    apart = np.abs(phase - state.phase)
    apart = np.minimum(apart, TURN - apart)
    size = np.maximum(np.minimum(speed, state.speed), periodic.SMALLEST_SPEED)
    near: NDArray[np.bool_] = (
        (side == state.side) & (apart <= SAME) & (np.abs(speed - state.speed) <= SAME * size)
    )
    return near


def _orbit(
    block: Block | DimensionlessBlock,
    motion: PeriodicMotion,
    model: Model,
    cell: Mapping[str, Any],
) -> Orbit:
    """Return the orbit of a cell, started where it would be whichever cell had found it."""
    state = ImpactState(side=cell["side"], phase=cell["phase"], speed=cell["speed"])
    orbit = _through(block, motion, model, state, cell)
    # A phase that is 0 except for rounding may have come out as a whole turn; and an orbit with
    # rests is closed from an uplift on, whose speed is 0.
    begin = min(orbit.states, key=lambda here: (here.speed > 0.0, (here.phase + SAME) % TURN))
    return orbit if begin is orbit.states[0] else _through(block, motion, model, begin, cell)


def _through(
    block: Block | DimensionlessBlock,
    motion: PeriodicMotion,
    model: Model,
    state: ImpactState,
    cell: Mapping[str, Any],
) -> Orbit:
    """Return the orbit through a state that lies on it."""
    system = make_system(block, motion, model)
    passages, periods = cell["passages"], cell["period"]
    table = np.zeros((passages, periodic.ORBIT_COLUMNS))
    fixed = for_system(periodic.polish, system)(system, section_of(state), passages, periods, table)
    return orbit_from(block, motion, table, periods, fixed.residual, model)
