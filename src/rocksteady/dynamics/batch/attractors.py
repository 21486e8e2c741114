"""Attractors of many motions: the table that a kernel fills, and the outputs of grids."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats, Integers
from rocksteady.dynamics.batch.left_over import run_left_over
from rocksteady.dynamics.history.start import ImpactState
from rocksteady.dynamics.orbits.attractor import KINDS, kind_codes
from rocksteady.errors import ModelError
from rocksteady.kernels.batch import attractors as column
from rocksteady.kernels.core.queue import LEFT_OVER
from rocksteady.kernels.core.tables import RESTITUTION, SIDE_COLUMNS
from rocksteady.kernels.core.tuples import Cells, Outcomes, SeriesCells, States, SymmetricCells
from rocksteady.kernels.devices import run_cells
from rocksteady.kernels.lanes.settling import lane_attractors
from rocksteady.kernels.nonlinear_lanes.settling import nonlinear_lane_attractors
from rocksteady.model.checks.arguments import checked_result
from rocksteady.model.checks.validation import whole_number
from rocksteady.model.equations import OfLinear
from rocksteady.model.linear_tables import alike
from rocksteady.model.motions.fourier import shares_of
from rocksteady.model.motions.harmonics import Harmonics
from rocksteady.outcomes import INFINITELY_MANY, NO_START, NO_START_LABEL, AttractorKind
from rocksteady.results.result import Result
from rocksteady.sweep.cases.outputs import Output

KIND_FLAGS = {
    **{code: str(kind.value) for code, kind in enumerate(KINDS)},
    NO_START: NO_START_LABEL,
}

BATCH = 4096
"""The most motions that the kernel follows in one call,"""
MOST_PERIODS = 4_096_000
"""and the forcing periods that they may take together: some seconds where many are chaotic, for
which an interruption waits.  Calls grow only while they are short, so that such cells come in large
numbers only where quick ones go before them."""

KIND_OUTPUT = Output(
    name="kind", dtype=np.int8, long_name="what the motion settles to", flags=KIND_FLAGS
)


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Attractors(OfLinear, Result):
    """Attractors of many motions, as arrays of shape (cells,).

    Attributes
    ----------
    kind
        Indices of `rocksteady.dynamics.orbits.attractor.KINDS`.
    side, phase, speed
        A state on the orbit; 0 and nan without one.
    period, passages, rests
        Forcing periods, states and rests of the orbit; 0 without one.
    highest, lowest
        Extrema of theta/alpha; 0 at rest, nan without an orbit.
    lyapunov
        Per forcing period.
    after
        Forcing periods until the attractor was known.
    """

    kind: NDArray[np.int8]
    side: Integers
    phase: Floats
    speed: Floats
    period: Integers
    passages: Integers
    rests: Integers
    highest: Floats
    lowest: Floats
    lyapunov: Floats
    after: Integers

    @property
    def labels(self) -> NDArray[np.str_]:
        """Kind of each in words, as "symmetric"."""
        return np.array([str(kind.value) for kind in KINDS])[self.kind]

    def are(self, kind: AttractorKind) -> NDArray[np.bool_]:
        """Return which of them are of a kind."""
        return np.equal(self.kind, KINDS.index(kind))

    def start(self, index: int) -> ImpactState:
        """Return a state on the orbit of one of them, from which `simulate` starts.

        Raises
        ------
        InputError
            If there is no motion of that number.
        ModelError
            If it has no orbit.
        """
        most = len(self.period) - 1
        hint = "give the number of a motion"
        index = whole_number("index", index, at_least=0, at_most=max(most, 0), hint=hint)
        if index > most or self.period[index] == 0:
            raise ModelError(
                "index",
                index,
                "that motion has no orbit" + (f": it is {self.labels[index]}" if most >= 0 else ""),
                "choose one whose period is above 0",
            )
        return ImpactState(
            side=int(self.side[index]),
            phase=float(self.phase[index]),
            speed=float(self.speed[index]),
        )

    @property
    def impacts(self) -> Integers:
        """Impacts in a period of the orbit; 0 without one, -1 for infinitely many."""
        return np.where(self.rests > 0, INFINITELY_MANY, self.passages)


def settled_cells(
    amplitude: Floats,
    frequency_ratio: Floats,
    sides: Floats,
    begin: States,
    cycles: int,
    harmonics: Harmonics,
) -> Attractors:
    """Return what motions settle to, each from its own state.

    Symmetric blocks are followed side by side until they are near an orbit, all others, those
    against a wall too, one by one: a cell's answer depends on nothing but the cell.

    Parameters
    ----------
    amplitude, frequency_ratio
        Shape (cells,).
    sides
        Sides of the block of all cells, or of each, as `model.equations.Linear.sides`
        has them, shape (2, 3) or (cells, 2, 3), with five columns in the nonlinear model.
    begin
        Where they start.
    cycles
        Forcing periods after which a motion counts as unsettled.
    harmonics
        Harmonics of a Fourier series, scaled by the amplitudes; by default a single sinusoid.
    """
    cells = len(amplitude)
    whole = np.empty((cells, column.WHOLE_COLUMNS), dtype=np.int64)
    real = np.empty((cells, column.REAL_COLUMNS))
    # A view of it would be read-only, which is another type to the kernel.
    tables = np.broadcast_to(sides, (cells, *sides.shape[-2:])).copy()
    same = alike(tables) & (not harmonics)
    whole[:, column.OUTCOME] = LEFT_OVER
    for step in ("in lanes", "one by one", "left over"):
        left = whole[:, column.OUTCOME] == LEFT_OVER
        if step != "left over":
            left &= same if step == "in lanes" else ~same
        chosen = np.flatnonzero(left)
        # Without any cells the kernels of the first two are to be loaded.
        if not len(chosen) and (cells or step == "left over"):
            continue
        shaken, blocks = (amplitude[chosen], frequency_ratio[chosen]), tables[chosen]
        parts = Outcomes(whole[chosen], real[chosen])
        run = States._make(each[chosen] for each in begin), cycles, parts
        if harmonics:
            total, shares = shares_of(harmonics)
            series = SeriesCells(total * shaken[0], shaken[1], shares, blocks)
            column.settle_series_cells(series, *run)
        elif step == "in lanes" and tables.shape[2] != SIDE_COLUMNS:
            run_cells(nonlinear_lane_attractors, Cells(*shaken, blocks), *run)
        elif step == "in lanes":
            ratio = blocks[:, 0, RESTITUTION].copy()
            run_cells(lane_attractors, SymmetricCells(*shaken, ratio), *run)
        elif step == "one by one":
            run_cells(column.settle_cells, Cells(*shaken, blocks), *run)
        else:  # by lanes, or for want of room on a device
            run_left_over(column.settle_cells, Cells(*shaken, blocks), *run)
        whole[chosen], real[chosen] = parts
    kind = kind_codes(
        whole[:, column.OUTCOME],
        whole[:, column.SYMMETRIC],
        real[:, column.LEAST],
        np.abs(tables[:, :, RESTITUTION]).min(axis=1),  # a wall's is negative
    )
    still = kind == KINDS.index(AttractorKind.REST)
    return Attractors(
        kind=kind,
        side=whole[:, column.ORBIT_SIDE],
        phase=real[:, column.ORBIT_PHASE],
        speed=real[:, column.ORBIT_SPEED],
        period=whole[:, column.PERIODS],
        passages=whole[:, column.PASSAGES],
        rests=whole[:, column.RESTS],
        highest=np.where(still, 0.0, real[:, column.HIGHEST]),
        lowest=np.where(still, 0.0, real[:, column.LOWEST]),
        lyapunov=real[:, column.LYAPUNOV],
        after=whole[:, column.AFTER],
    )


def load_kernel() -> None:
    """Load the kernel, or compile it, so that what is timed afterwards is computation alone."""
    nothing = np.empty(0)
    begin = starting(nothing, nothing, 0, 0.0)
    settled_cells(nothing, nothing, np.empty((0, 2, 3)), begin, 1, ())


def starting(
    angle: Floats, velocity: Floats, half_cycles: int | Integers, phase: float | Floats
) -> States:
    """Return states of any angles and velocities, at one moment of the shaking or each its own.

    Parameters
    ----------
    angle, velocity
        theta/alpha, and its derivative by pivot time, shape (cells,).
    half_cycles, phase
        Time of the shaking: whole half periods, and the rest in [0, pi).
    """
    leaning = np.where(angle != 0.0, angle, velocity)
    half_periods = np.full(len(angle), half_cycles, dtype=np.int64)
    side = np.sign(leaning).astype(np.int64)
    return States(side, angle, velocity, half_periods, np.full(len(angle), phase))


def batch_size(cycles: int) -> int:
    """Return how many motions one call takes, each followed for a number of forcing periods."""
    return max(1, min(BATCH, MOST_PERIODS // cycles))


def outputs_of_orbits() -> tuple[Output, ...]:
    """Return the values of a grid of attractors in each cell, by the names of `Attractors`."""
    integer: dict[str, Any] = {"dtype": np.int32}
    return (
        KIND_OUTPUT,
        Output(name="period", long_name="forcing periods of the orbit; 0 without one", **integer),
        Output(
            name="impacts",
            long_name="impacts in a period of the orbit; 0 without one, -1 for infinitely many",
            attrs={"infinitely_many": INFINITELY_MANY},
            **integer,
        ),
        Output(name="highest", long_name="largest theta/alpha of the orbit"),
        Output(name="lowest", long_name="smallest theta/alpha of the orbit"),
        Output(name="lyapunov", long_name="largest Lyapunov exponent per forcing period"),
        Output(name="after", long_name="forcing periods until that was known", **integer),
    )
