"""Periodic orbit under harmonic shaking: its impacts, stability and time history."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats
from rocksteady.dynamics.history.simulate import simulate
from rocksteady.dynamics.history.start import ImpactState
from rocksteady.dynamics.history.trajectory import Trajectory
from rocksteady.dynamics.orbits.return_map import (
    has_mirror_images,
    make_system,
    section_of,
    state_of,
)
from rocksteady.dynamics.steady.verdicts import NO_MULTIPLIERS
from rocksteady.errors import ModelError, Words
from rocksteady.kernels.core import tables as columns
from rocksteady.kernels.elementary.arrays import hypot, log
from rocksteady.kernels.orbits import periodic
from rocksteady.kernels.orbits.return_map import UPLIFT, Section, next_passage
from rocksteady.kernels.orbits.systems import for_system
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked_result
from rocksteady.model.equations import Linear, Model
from rocksteady.model.motions.fourier import PeriodicMotion
from rocksteady.model.units import framed
from rocksteady.outcomes import Status
from rocksteady.results.result import Result

if TYPE_CHECKING:
    import pandas as pd


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Orbit(Result):
    """A periodic orbit under periodic shaking.

    Attributes
    ----------
    block, motion
        Block and base motion as given; the phase of `motion` is that at the first of `states`.
    period
        Forcing periods of the whole orbit; above 1 it is subharmonic.
    states
        The orbit just after each of its impacts and at each uplift from rest, in order.  With a
        rest they stand for infinitely many: impacts are listed until their end is proved.  Speeds
        of an inadmissible orbit are moduli: it may go downwards there, and `SteadyStates` has the
        sign.
    rest_phases
        Number of rests in a period of the orbit.
    symmetric
        Whether half of it is the mirror image of the other half; never where the block's sides
        differ.
    highest, lowest
        Extrema of u = theta/alpha, alpha the positive side's; nan where it is not admissible.
    multipliers
        Floquet multipliers of the whole orbit, shape (2,), the larger in modulus first, of a
        conjugate pair the one above the real axis; with a rest both are 0.  nan where an impact
        grazes (`rocksteady.kernels.core.forcing.grazes`): no derivative exists there.
    residual
        Largest error of a flight from one of the states to the next: of the phase [rad], or of the
        speed relative to itself.  At most 1e-12 where Newton's method has found it; the closed
        forms have theirs to the last digit, and a flight may magnify that; nan where their half
        cycles are so long that no flight stays on them.
    admissible
        False for a solution of the symmetric algebra that passes through the floor: no motion.
    branch
        1 or 2 for the symmetric solutions in closed form, and for those of the nonlinear model to
        which they lead; None for others.
    model
        Which equations of motion hold: `Linear` or `Nonlinear`.
    """

    block: Block | DimensionlessBlock
    motion: PeriodicMotion
    period: int
    states: tuple[ImpactState, ...]
    rest_phases: int
    symmetric: bool
    highest: float
    lowest: float
    multipliers: NDArray[np.complex128]
    residual: float
    admissible: bool = True
    branch: int | None = None
    model: Model = field(default_factory=Linear)

    @property
    def kind(self) -> str:
        """Symmetry in a word: "symmetric" or "unsymmetric"."""
        return "symmetric" if self.symmetric else "unsymmetric"

    @property
    def impacts(self) -> int | None:
        """Impacts in a period of the orbit; None, for infinitely many, where it comes to rest."""
        return None if self.rest_phases else len(self.states)

    @property
    def largest_multiplier(self) -> float:
        """Modulus of the larger multiplier."""
        return modulus(self.multipliers[0])

    @property
    def stable(self) -> bool:
        """Whether it is a motion and both multipliers lie inside the unit circle.

        Without loss (restitution 1) their product is 1, and rounding may not put them inside.  Not
        of an orbit that grazes, which has no multipliers.
        """
        return self.admissible and not self.block.lossless and self.largest_multiplier < 1.0

    @property
    def neutral(self) -> bool:
        """Whether both multipliers have modulus 1, as they may without loss (restitution 1)."""
        turning = self.multipliers[0].imag != 0.0
        return bool(self.admissible and self.block.lossless and turning)

    @property
    def lyapunov(self) -> float:
        """Largest Lyapunov exponent per forcing period; -inf with a rest, nan with a graze."""
        size = self.largest_multiplier
        return log(size) / self.period if size != 0.0 else -math.inf

    @property
    def start(self) -> ImpactState:
        """The first of its states, at which `rocksteady.simulate` sets off."""
        return self.states[0]

    @cached_property
    def mirrored(self) -> "Orbit":
        """Its mirror image, started at the mirrored first state; itself if it is symmetric.

        Raises
        ------
        ModelError
            If the block's sides differ, it stands against a wall, or half a period does not turn
            the shaking round: the mirror image is a motion of another block or shaking.
        """
        if self.symmetric:
            return self
        if self.block.one_sided:
            raise ModelError(
                "orbit",
                Words("is one of a block against a wall"),
                "its mirror image lies behind the wall",
                "take the orbit itself",
            )
        if not self.block.symmetric:
            raise ModelError(
                "orbit",
                Words("is one of an asymmetric block"),
                "its mirror image is a motion of the mirrored block",
                "ask for orbits of the block with its sides exchanged",
            )
        if not has_mirror_images(self.block, self.motion):
            raise ModelError(
                "orbit",
                Words("is one under a Fourier series with even orders"),
                "its mirror image is a motion under the series turned round",
                "ask for orbits under the series with minus its sizes",
            )
        return replace(
            self,
            motion=replace(self.motion, phase=self.states[0].mirrored.phase),
            states=tuple(state.mirrored for state in self.states),
            highest=-self.lowest,
            lowest=-self.highest,
        )

    def trajectory(self) -> Trajectory:
        """Return one period of the orbit, each flight from the orbit's own state.

        A run from the first state, ``simulate(block, orbit.motion, start=orbit.start)``,
        multiplies its rounding with the orbit's multipliers, and leaves an unstable orbit in time.
        Here every flight starts from a stored state, so that the course closes as exactly as the
        states are known. Before a rest every bounce that one can see is a flight too.

        Returns
        -------
        Trajectory
            From just after the first of the states to just after the same state again.

        Raises
        ------
        ModelError
            If the solution passes through the floor and is no motion.

        Examples
        --------
        >>> from rocksteady import DimensionlessBlock, Harmonic, find_orbits
        >>> motion = Harmonic(amplitude=1.2, frequency_ratio=0.7)
        >>> orbit = find_orbits(DimensionlessBlock(restitution=0.8), motion)[-1]
        >>> run = orbit.trajectory()
        >>> print(f"multiplier {orbit.largest_multiplier:.0e}, peak {run.peak:.6f}")
        multiplier 5e+11, peak 1.802986
        """
        if not self.admissible:
            raise ModelError(
                "orbit",
                self.kind,
                "this solution passes through the floor and is no motion",
                "choose an orbit that is admissible",
            )
        tables = self.model.lower(self.block, self.motion)
        return Trajectory(
            block=self.block,
            motion=self.motion,
            status=Status.ROCKING,
            segments=tables.segments,
            sides=tables.sides,
            rows=np.array(list(_course(self))),
            model=self.model,
        )

    def to_dataframe(self) -> "pd.DataFrame":
        """Return one row per impact, in order."""
        return framed([section_row(state) for state in self.states], self.block)


def section_row(state: ImpactState) -> dict[str, Any]:
    """Return the row of a state after an impact."""
    return {"side": state.side, "phase_rad": state.phase, "speed_per_pivot_time": state.speed}


def orbit_from(
    block: Block | DimensionlessBlock,
    motion: PeriodicMotion,
    table: Floats,
    periods: int,
    residual: float,
    model: Model,
) -> Orbit:
    """Return the orbit of a table that the kernels have filled.

    Parameters
    ----------
    block, motion
        What moves.
    table
        One row per passage, shape (passages, ORBIT_COLUMNS).
    periods
        Forcing periods of the orbit.
    residual
        Residual with which it was found.
    model
        Model of the orbit.
    """
    system, passages = make_system(block, motion, model), len(table)
    fixed = for_system(periodic.measured, system)(system, passages, periods, table)
    for_system(periodic.fill_peaks, system)(system, passages, table)
    states = tuple(state_of(periodic.state_at(table, k)) for k in range(passages))
    positive = table[:, periodic.SIDE] > 0.0
    peak, other_peak = table[:, periodic.PEAK], table[:, periodic.OTHER_PEAK]
    determinant = for_system(periodic.loss, system)(system, states[0].side, passages, fixed.rests)
    multipliers = ordered(*periodic.multipliers(fixed.jacobian, determinant))
    if fixed.grazes and not fixed.rests:  # a rest forgets what a graze makes of a difference
        multipliers = NO_MULTIPLIERS
    return Orbit(
        block=block,
        motion=replace(motion, phase=states[0].phase),
        period=periods,
        states=states,
        rest_phases=fixed.rests,
        symmetric=bool(for_system(periodic.is_symmetric, system)(system, table, passages, periods)),
        highest=float(np.where(positive, peak, other_peak).max()),
        lowest=0.0 - float(np.where(positive, other_peak, peak).max()),
        multipliers=multipliers,
        residual=residual,
        model=model,
    )


def modulus(value: complex) -> float:
    """Return the modulus, the same bits everywhere."""
    return hypot(value.real, value.imag)


def squared(value: complex) -> complex:
    """Return the square, each product rounded by itself, as a complex product need not."""
    real, imaginary = value.real, value.imag
    return complex(real * real - imaginary * imaginary, 2.0 * real * imaginary)


def ordered(first: complex, second: complex) -> NDArray[np.complex128]:
    """Return two multipliers, the larger first, of a conjugate pair the one above the real axis."""
    if first.imag != 0.0:
        up = complex(first.real, abs(first.imag))
        return np.array([up, up.conjugate()])
    pair = sorted((first.real, second.real), key=abs, reverse=True)
    return np.array([complex(value, 0.0) for value in pair])


def _course(orbit: Orbit) -> Iterator[list[float]]:
    """Yield the rows of a trajectory's table, one per flight and the state at the end."""
    system = make_system(orbit.block, orbit.motion, orbit.model)
    begin = section_of(orbit.states[0])
    half, phase = begin.half_cycles, begin.phase
    for state in orbit.states:
        here = section_of(state)
        # The state's own clock, set on by the whole periods that have passed since the start.
        apart = half - here.half_cycles + (phase - here.phase) / math.pi
        passed = 2 * round(0.5 * apart)
        step = for_system(next_passage, system)(system, here, -1.0)
        if step.kind == UPLIFT:
            yield from _to_rest(orbit, state, step.time, passed)
        else:
            yield _row(here, passed, step.time, columns.ENDED_BY_IMPACT)
        half, phase = step.state.half_cycles + passed, step.state.phase
    yield _row(begin, 2 * orbit.period, 0.0, columns.ENDED_BY_SPAN)


def _to_rest(orbit: Orbit, state: ImpactState, time: float, passed: int) -> Iterator[list[float]]:
    """Yield the rows of the bounces that a state begins and of the rest in which they end."""
    # A little longer than until the uplift, so that the rest is seen to end.
    periods = 1.001 * time * orbit.motion.frequency_ratio / (2.0 * math.pi)
    run = simulate(orbit.block, orbit.motion, start=state, cycles=periods, model=orbit.model)
    for row in run.rows.tolist():
        row[columns.ROW_HALF_CYCLES] += passed
        yield row
        if row[columns.ROW_EVENT] == columns.ENDED_BY_UPLIFT:
            return


def _row(state: Section, passed: int, duration: float, event: int) -> list[float]:
    """Return the row of a flight in a trajectory's table, `passed` half cycles after the start."""
    row = [0.0] * columns.ROW_COLUMNS
    row[columns.ROW_HALF_CYCLES] = state.half_cycles + passed
    row[columns.ROW_PHASE] = state.phase
    row[columns.ROW_SIDE] = state.side
    row[columns.ROW_VELOCITY] = state.side * state.speed
    row[columns.ROW_DURATION] = duration
    row[columns.ROW_EVENT] = event
    return row
