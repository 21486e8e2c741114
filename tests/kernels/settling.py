"""Motions that settle, in lanes of either model and one by one, and what may differ."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rocksteady.kernels.batch.attractors import (
    HIGHEST,
    LOWEST,
    LYAPUNOV,
    ORBIT_PHASE,
    ORBIT_SPEED,
    OUTCOME,
    REAL_COLUMNS,
    RESTS,
    WHOLE_COLUMNS,
    fill_clocks,
    settle_cells,
)
from rocksteady.kernels.core import tuples
from rocksteady.kernels.core.queue import LEFT_OVER
from rocksteady.kernels.core.tables import (
    ALPHA,
    LEFT_OUT,
    NONLINEAR_SIDE_COLUMNS,
    RESTITUTION,
    SIDE_COLUMNS,
)
from rocksteady.kernels.core.tuples import Outcomes, States, SymmetricCells
from rocksteady.kernels.lanes.settling import lane_attractors
from rocksteady.kernels.nonlinear_lanes.settling import nonlinear_lane_attractors
from rocksteady.kernels.orbits.periodic import ORBIT_COLUMNS
from rocksteady.kernels.orbits.return_map import AnyState
from rocksteady.kernels.orbits.settle import (
    FALLS,
    LONGEST_ORBIT,
    MEMORY,
    PERIODIC,
    STAYS,
    settle,
)
from rocksteady.kernels.orbits.systems import make_system

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

DIGITS_LOST = math.log(1e10)
"""Growth of a small difference from which on two computations may part: one rounding becomes as
large as the differences by which `settle` decides."""
STEPS_LOST = math.log(1e8)
"""The same of steps, which leave out 1e-15."""


class Cells(NamedTuple):
    amplitude: Floats
    frequency: Floats
    restitution: Floats
    side: Integers
    angle: Floats
    velocity: Floats
    half_cycles: Integers
    phase: Floats
    alpha: Floats
    """Of blocks of the nonlinear model; 0 in the linear one."""

    @property
    def nonlinear(self) -> bool:
        return bool(len(self.alpha) and self.alpha[0] > 0.0)

    def some(self, chosen: Integers) -> "Cells":
        return Cells._make(column[chosen] for column in self)


def empty(count: int) -> Outcomes:
    return Outcomes(np.zeros((count, WHOLE_COLUMNS), np.int64), np.zeros((count, REAL_COLUMNS)))


def sides_of(cells: Cells) -> Floats:
    columns = NONLINEAR_SIDE_COLUMNS if cells.nonlinear else SIDE_COLUMNS
    sides = np.ones((len(cells.amplitude), 2, columns))
    sides[:, :, RESTITUTION] = cells.restitution[:, np.newaxis]
    if cells.nonlinear:
        sides[:, :, ALPHA] = cells.alpha[:, np.newaxis]
        sides[:, :, LEFT_OUT] = 1e-15
    return sides


def states_of(cells: Cells) -> States:
    return States(cells.side, cells.angle, cells.velocity, cells.half_cycles, cells.phase)


def by_lanes(cells: Cells, cycles: int) -> Outcomes:
    found = empty(len(cells.amplitude))
    shaken, begin = (cells.amplitude, cells.frequency), states_of(cells)
    if cells.nonlinear:
        given = tuples.Cells(*shaken, sides_of(cells))
        nonlinear_lane_attractors(given, begin, cycles, found)
    else:
        lane_attractors(SymmetricCells(*shaken, cells.restitution), begin, cycles, found)
    return found


def one_by_one(cells: Cells, cycles: int) -> Outcomes:
    found = empty(len(cells.amplitude))
    shaken = tuples.Cells(cells.amplitude, cells.frequency, sides_of(cells))
    settle_cells(shaken, states_of(cells), cycles, found)
    return found


def unit(count: int) -> Cells:
    """Return work unit B1 on a grid of count x count."""
    w, a = np.meshgrid(np.linspace(1.0, 12.0, count), np.linspace(1.0, 6.0, count))
    return starting(a.ravel(), w.ravel(), 0.8, 0.0, 0.3, 0.0)


def starting(*columns: ArrayLike, alpha: ArrayLike = 0.0) -> Cells:
    """Return cells of amplitude, frequency, restitution, angle, velocity and any phase."""
    given = np.broadcast_arrays(*(np.asarray(column, dtype=np.float64) for column in columns))
    a, w, r, angle, velocity, phase = (column.copy() for column in given)
    half, rest = np.zeros(len(a), np.int64), np.zeros(len(a))
    fill_clocks(phase, half, rest)
    side = np.sign(np.where(angle != 0.0, angle, velocity)).astype(np.int64)
    slender = np.broadcast_to(np.asarray(alpha, dtype=np.float64), a.shape).copy()
    return Cells(a, w, r, side, angle, velocity, half, rest, slender)


def random_cells(seed: int, count: int, *, nonlinear: bool = False) -> Cells:
    """Return blocks at rest, leaning and in flight; below, at and above uplift; slow and fast."""
    rng = np.random.default_rng(seed)
    some = rng.random((3, count))
    a = np.where(some[0] < 0.2, rng.uniform(0.8, 1.2, count), rng.uniform(0.9, 7.0, count))
    w = 10.0 ** rng.uniform(-0.3, 1.3, count)
    angle = np.where(some[1] < 0.4, rng.uniform(-0.7, 0.7, count), 0.0)
    velocity = np.where(some[2] < 0.7, rng.normal(0.0, 0.4, count), 0.0)
    r = rng.uniform(0.2, 0.97, count)
    phase = rng.uniform(-10.0, 10.0, count)
    alpha = rng.uniform(0.05, 0.6, count) if nonlinear else 0.0
    return starting(a, w, r, angle, velocity, phase, alpha=alpha)


def growth(cells: Cells, cell: int, cycles: int) -> float:
    """Return the logarithm of the largest growth of a small difference on the way of a cell."""
    memory, table = np.zeros((MEMORY, ORBIT_COLUMNS)), np.zeros((LONGEST_ORBIT, ORBIT_COLUMNS))
    a, w, _, side, angle, velocity, half, phase, _ = (column[cell].item() for column in cells)
    system = make_system(a, w, sides_of(cells)[cell].copy())
    return settle(
        system, AnyState(side, half, phase, angle, velocity), cycles, memory, table
    ).growth


def check_against_scalar(cells: Cells, cycles: int) -> tuple[int, int]:
    """Hold the lanes against the scalar code; return how many they leave, and how many differ.

    Cells may differ only where rounding decides.
    """
    lanes, plain = by_lanes(cells, cycles), one_by_one(cells, cycles)
    done = lanes.whole[:, OUTCOME] != LEFT_OVER
    differ = done & (lanes.whole != plain.whole).any(axis=1)
    for cell in np.flatnonzero(differ):
        lost = STEPS_LOST if cells.nonlinear else DIGITS_LOST
        assert growth(cells, int(cell), cycles) > lost, cell
    same = done & ~differ
    orbits = same & (plain.whole[:, OUTCOME] == PERIODIC)
    for column, tolerance in (
        (ORBIT_SPEED, 1e-9),
        (HIGHEST, 1e-9),
        (LOWEST, 1e-9),
        (LYAPUNOV, 1e-6),
    ):
        assert np.abs(lanes.real[orbits, column] - plain.real[orbits, column]).max() < tolerance
    turn = 2.0 * math.pi
    turned = lanes.real[orbits, ORBIT_PHASE] - plain.real[orbits, ORBIT_PHASE]
    assert np.abs(turned - turn * np.round(turned / turn)).max() < 1e-9
    assert np.isnan(lanes.real[same & ~orbits]).all()
    # What the lanes do not settle they leave: rests, and what does not settle at all.
    assert not (plain.whole[same, RESTS] > 0).any()
    assert {PERIODIC, FALLS} <= set(plain.whole[same, OUTCOME].tolist()) <= {PERIODIC, FALLS, STAYS}
    return int(np.count_nonzero(~done)), int(np.count_nonzero(differ))
