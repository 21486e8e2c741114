"""Attractor of a block under periodic shaking: its long-term motion."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rocksteady.dynamics.history.simulate import simulate
from rocksteady.dynamics.history.start import (
    HasStart,
    ImpactState,
    Rest,
    Start,
    State,
    initial_march,
    start_of,
)
from rocksteady.dynamics.history.trajectory import Trajectory
from rocksteady.dynamics.orbits.orbit import Orbit, orbit_from, section_row
from rocksteady.dynamics.orbits.return_map import make_system, periodic_motion, state_of
from rocksteady.kernels.elementary.arrays import exp
from rocksteady.kernels.orbits import settle as kernel
from rocksteady.kernels.orbits.periodic import ORBIT_COLUMNS
from rocksteady.kernels.orbits.return_map import AnyState
from rocksteady.kernels.orbits.systems import for_system
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.bounds import Whole
from rocksteady.model.checks.validation import whole_number
from rocksteady.model.equations import (
    Linear,
    Model,
    ModelChoice,
    chosen_model,
)
from rocksteady.model.motions.fourier import PeriodicMotion
from rocksteady.model.units import framed
from rocksteady.outcomes import AttractorKind
from rocksteady.results.result import Result

if TYPE_CHECKING:
    import pandas as pd

CHAOTIC = 0.01
"""Lyapunov exponent per forcing period from which a motion without repetition counts as aperiodic,
over each of the two last quarters of its run."""


MOST_CYCLES = 1_000_000
FORCING_PERIODS = Whole(1, MOST_CYCLES, "give forcing periods to follow")
"""Some seconds."""
LONGEST_RUN = 4000
"""Most forcing periods of a run without an orbit."""
AFTERWARDS = 5
"""Forcing periods of such a run beyond those after which its kind was known."""
ROUNDED = 1e12
"""Growth of small differences from which on a rounding may decide."""

KINDS = tuple(AttractorKind)
"""The kinds by their codes in grids; stored results hold them, so that none changes its place."""


def kind_codes(
    outcome: ArrayLike, symmetric: ArrayLike, least: ArrayLike, restitution: ArrayLike
) -> NDArray[np.int8]:
    """Return what motions settle to, as indices of `KINDS`.

    Parameters
    ----------
    outcome, least
        As in `rocksteady.kernels.orbits.settle.Settled`, arrays of one shape.
    symmetric
        Whether the orbit is; without one it does not count.
    restitution
        The smaller of both impacts', or minus a wall's.  Without loss (1) nothing is aperiodic:
        motions do not settle.
    """
    exponents, lossy = np.asarray(least), np.abs(restitution) < 1.0
    ends = np.asarray(outcome)
    chosen = {
        AttractorKind.SYMMETRIC: (ends == kernel.PERIODIC) & np.asarray(symmetric, dtype=np.bool_),
        AttractorKind.UNSYMMETRIC: ends == kernel.PERIODIC,
        AttractorKind.REST: ends == kernel.STAYS,
        AttractorKind.OVERTURNED: ends == kernel.FALLS,
        AttractorKind.APERIODIC: lossy & (exponents > CHAOTIC),
    }
    codes: NDArray[np.int8] = np.select(
        list(chosen.values()),
        [np.int8(KINDS.index(kind)) for kind in chosen],
        default=np.int8(KINDS.index(AttractorKind.UNDECIDED)),
    )
    return codes


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Attractor(Result):
    """Attractor of a motion: the stable orbit or other outcome that it settles to.

    Attributes
    ----------
    block, motion
        Block and base motion; the phase of `motion` is that at the start.
    kind
        What it is.
    orbit
        The stable periodic motion; None for every other kind.
    lyapunov
        Largest Lyapunov exponent per forcing period; nan for rest and overturned.
    after
        Forcing periods until the attractor was known.
    growth
        Largest growth of a small difference on the way there.  Where it is above 1e12, a rounding
        may have decided which of several attractors was reached.
    reason
        Why it is undecided; empty otherwise.
    state
        The last state after an impact or at an uplift, from which the motion can be followed on;
        None at rest, and where the block falls without one.
    initial
        The start from which the motion was followed.
    model
        Which equations of motion hold: `Linear` or `Nonlinear`.
    """

    block: Block | DimensionlessBlock
    motion: PeriodicMotion
    kind: AttractorKind
    orbit: Orbit | None
    lyapunov: float
    after: int
    growth: float
    reason: str
    state: ImpactState | None
    initial: Start = field(default_factory=Rest)
    model: Model = field(default_factory=Linear)

    @property
    def period(self) -> int | None:
        """Forcing periods of the orbit; None without one."""
        return None if self.orbit is None else self.orbit.period

    @property
    def peaks(self) -> tuple[float, float] | None:
        """Highest and lowest u = theta/alpha of the orbit; 0 at rest, None without an orbit."""
        if self.orbit is not None:
            return self.orbit.highest, self.orbit.lowest
        return (0.0, 0.0) if self.kind is AttractorKind.REST else None

    @property
    def start(self) -> ImpactState | Rest | None:
        """A start on the attractor, for `rocksteady.simulate` with its `motion`.

        Without an orbit it is the last state after an impact, from which the motion can be followed
        on; None where the block falls without an impact.
        """
        if self.kind is AttractorKind.REST:
            return Rest()
        return self.state if self.orbit is None else self.orbit.start

    def trajectory(self, *, last: int | None = None) -> Trajectory:
        """Return one period of the orbit; without an orbit the run from the initial state.

        Parameters
        ----------
        last
            Number of last forcing periods of a run without an orbit.

        Returns
        -------
        Trajectory
            Of a run without an orbit 5 forcing periods more than it took to be known, up to 4000.

        Examples
        --------
        >>> from rocksteady import DimensionlessBlock, Harmonic
        >>> motion = Harmonic(amplitude=6.0, frequency_ratio=2.0)
        >>> attractor = find_attractor(DimensionlessBlock(restitution=0.8), motion)
        >>> print(attractor.kind, attractor.trajectory().status.label)
        overturned overturned
        """
        if self.orbit is not None:
            return self.orbit.trajectory()
        cycles = min(self.after + AFTERWARDS, LONGEST_RUN)
        run = simulate(self.block, self.motion, start=self.initial, cycles=cycles, model=self.model)
        if last is None:
            return run
        periods = whole_number("last", last, at_least=1, hint="give a number of forcing periods")
        span = periods * 2.0 * math.pi / self.motion.frequency_ratio
        if run.end_time_pt <= span:
            return run
        since = run.end_time_pt - span
        trajectory = run(since)
        turned = run.motion.phase + self.motion.frequency_ratio * since  # type: ignore[union-attr]
        return simulate(
            self.block,
            replace(self.motion, phase=math.fmod(turned, 2.0 * math.pi)),
            start=State(angle=float(trajectory.angle), velocity=float(trajectory.velocity)),
            cycles=periods,
            model=self.model,
        )

    def rows(self) -> list[dict[str, Any]]:
        """Return one row per impact: of an orbit's period, or of the second half of a long run."""
        states: Sequence[ImpactState] = ()
        if self.orbit is not None:
            states = self.orbit.states
        elif self.kind in (AttractorKind.APERIODIC, AttractorKind.UNDECIDED):
            run = self.trajectory()
            impacts = run.impacts
            late = impacts.pt >= 0.5 * run.end_time_pt
            phases = (impacts.half_cycles[late] % 2) * math.pi + impacts.phase[late]
            states = [
                ImpactState(side=1 if speed > 0.0 else -1, phase=phase, speed=abs(speed))
                for phase, speed in zip(
                    phases.tolist(), impacts.velocity_after[late].tolist(), strict=True
                )
            ]
        return [section_row(state) for state in states]

    def to_dataframe(self) -> "pd.DataFrame":
        """Return one row per impact: of an orbit's period, or of the second half of a long run."""
        return framed(self.rows(), self.block, *self.columns)

    @property
    def columns(self) -> list[str]:
        """Names of the values of each row."""
        return list(section_row(ImpactState(side=1, phase=0.0, speed=0.0)))


@checked
def find_attractor(
    block: Block | DimensionlessBlock,
    motion: PeriodicMotion,
    *,
    start: Start | HasStart | None = None,
    max_cycles: int = 2000,
    model: ModelChoice = None,
) -> Attractor:
    """Follow a motion under periodic shaking until its attractor is known.

    Recognised by returning states, polished by Newton's method on the return map to a residual of
    1e-12, and believed only if it is stable by its exact multipliers and the motion comes to within
    1e-7 of it, or nears a weakly attracting one at the rate of its multiplier.  An unstable orbit
    is never returned.

    Parameters
    ----------
    block
        Its restitution counts, and how its sides differ: no motion of an asymmetric block, or of
        one against a wall, is symmetric, whatever it looks like; none is under a series with even
        orders.
    motion
        Its phase is that at the start, unless a `Steady` or `ImpactState` start decides on it.
    start
        `Rest` (default), `State`, `Steady`, `ImpactState` or a result that has a start.
    max_cycles
        Forcing periods after which the motion counts as aperiodic or undecided.
    model
        ``"linear"`` or ``"nonlinear"``; by default nonlinear for a `Block`.

    Returns
    -------
    Attractor
        Its kind, and its orbit if it is periodic.

    Raises
    ------
    InputError, ModelError
        If a number is outside its range, the shaking is not periodic, or the start does not fit.

    Examples
    --------
    >>> from rocksteady import DimensionlessBlock, Harmonic, Steady
    >>> block = DimensionlessBlock(restitution=0.8)
    >>> motion = Harmonic(amplitude=2.0, frequency_ratio=1.9)
    >>> attractor = find_attractor(block, motion, start=Steady(side=-1))
    >>> print(attractor.kind, attractor.period, [round(peak, 5) for peak in attractor.peaks])
    unsymmetric 1 [0.90035, -0.44427]
    """
    bare, shaken = block.dimensionless(), periodic_motion(motion)
    periods = FORCING_PERIODS("max_cycles", max_cycles)
    equations = chosen_model(model, block)
    initial = start_of(start)
    moved, begin = initial_march(initial, bare, shaken, equations.sides(block))
    shaken = periodic_motion(moved)
    memory, table = (
        np.empty((rows, ORBIT_COLUMNS)) for rows in (kernel.MEMORY, kernel.LONGEST_ORBIT)
    )
    system = make_system(block, shaken, equations)
    state = AnyState(begin.side, begin.half_cycles, begin.phase, begin.angle, begin.velocity)
    settled = for_system(kernel.settle, system)(system, state, periods, memory, table)
    orbit = None
    if settled.outcome == kernel.PERIODIC:
        orbit = orbit_from(
            block, shaken, table[: settled.passages], settled.periods, settled.residual, equations
        )
    symmetric = orbit is not None and orbit.symmetric
    least = min(abs(restitution) for restitution, _, _ in bare.sides)  # a wall's is negative
    kind = KINDS[int(kind_codes(settled.outcome, symmetric, settled.least, least))]
    return Attractor(
        block=block,
        motion=shaken,
        kind=kind,
        orbit=orbit,
        lyapunov=settled.lyapunov,
        after=settled.after,
        growth=exp(min(settled.growth, 700.0)),
        reason=_reason(settled, bare) if kind is AttractorKind.UNDECIDED else "",
        state=state_of(settled.state) if settled.state.side != 0 else None,
        initial=initial,
        model=equations,
    )


def _reason(end: kernel.Settled, block: DimensionlessBlock) -> str:
    """Return why a motion is undecided, and what to do."""
    if block.lossless:
        return "without loss (restitution 1) motions do not settle"
    if end.after == 0:
        return "the block balances upright, and nothing brings it down"
    if end.passages > 0 and end.passages <= kernel.LONGEST_ORBIT:
        return (
            f"it rests again and again, the last time after {end.passages} impacts in "
            f"{end.periods} forcing periods, on which a small difference may grow "
            f"{exp(min(end.growth, 700.0)):.1g}-fold: rounding decides how it goes on"
        )
    if end.passages > 0:
        return (
            f"from one rest to the same again it has {end.passages} impacts in {end.periods} "
            f"forcing periods, more than an orbit may have, {kernel.LONGEST_ORBIT}: it repeats "
            "itself, and no more cycles help"
        )
    start = f"no repetition within {end.after} forcing periods"
    if math.isnan(end.lyapunov):
        return (
            f"{start}, too few, or with rests or a graze too near the end, for a Lyapunov "
            "exponent: follow more cycles"
        )
    return (
        f"{start}, and a Lyapunov exponent of {end.lyapunov:.2g} a period, too small or too "
        "unsteady for chaos: follow more cycles"
    )
