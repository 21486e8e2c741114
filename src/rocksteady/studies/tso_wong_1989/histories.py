"""Figs 8 to 13: time histories that start on a symmetric steady state."""

import math
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from rocksteady import (
    DimensionlessBlock,
    Harmonic,
    Steady,
    SteadyStates,
    Trajectory,
    simulate,
    steady_states,
)
from rocksteady.studies.tso_wong_1989.fates import Fate, fates_over_kicks, settle
from rocksteady.studies.tso_wong_1989.findings import Panel
from rocksteady.studies.tso_wong_1989.words import motion_name, multiplier_text, sign, signed, times

if TYPE_CHECKING:
    from matplotlib.figure import Figure

RESTITUTION = 0.8
"""Of every time history in the paper."""
KICK = 1e-4
"""How far from an unstable orbit the drawn runs begin.  The paper's distance is the rounding of its
computer, which it does not state; this one leaves every orbit within the paper's time axes that the
paper's own run leaves there."""
KICKS = np.geomspace(1e-6, 1e-2, 161)
"""Distances over which fates are counted, on either side."""
SIDES = (1, -1)
ROWS_PER_PERIOD = 60
"""Rows of data in an excitation period; impacts are rows too."""


@dataclass(frozen=True, kw_only=True)
class Case:
    """Parameters of one of the paper's time histories.

    Attributes
    ----------
    id
        As the paper numbers it.
    amplitude, frequency_ratio
        A and Omega, which is the frequency in Hz as well, since p = 2 pi.
    order, branch
        Of the symmetric steady state on which it starts.
    periods
        End of the time axis [excitation periods].
    says
        What the paper shows, in our words.
    chosen
        What the scan does not show and was chosen.
    """

    id: str
    amplitude: float
    frequency_ratio: float
    order: int
    branch: int
    periods: int
    says: str
    chosen: tuple[str, ...] = ()


AXIS_ILLEGIBLE = "The end of the time axis is not legible in the scan."
NO_AMPLITUDE = (
    "The amplitude of Fig. 13 is not printed; the text speaks of the same system as in Fig. 12, so "
    "A = 2 is taken."
)

CASES = (
    Case(
        id="8a", amplitude=1.0, frequency_ratio=1.0, order=1, branch=2, periods=10,
        says="At 1 Hz the block leaves the in-phase harmonic motion after a few cycles and "
        "topples.",
    ),
    Case(
        id="8b", amplitude=1.0, frequency_ratio=2.0, order=1, branch=2, periods=24,
        says="At 2 Hz the block leaves the in-phase harmonic motion and reaches the stable "
        "out-of-phase harmonic one.",
    ),
    Case(
        id="8c", amplitude=1.0, frequency_ratio=8.0, order=1, branch=2, periods=20,
        says="At 8 Hz the block leaves the in-phase harmonic motion and reaches the stable "
        "out-of-phase harmonic one.",
    ),
    Case(
        id="9a", amplitude=2.0, frequency_ratio=3.5, order=3, branch=2, periods=20,
        says="At 3.5 Hz the block leaves the in-phase 1/3 subharmonic and topples.",
    ),
    Case(
        id="9b", amplitude=2.0, frequency_ratio=4.0, order=3, branch=2, periods=40,
        says="At 4 Hz the block leaves the in-phase 1/3 subharmonic and settles to the stable "
        "out-of-phase harmonic motion.",
    ),
    Case(
        id="9c", amplitude=2.0, frequency_ratio=5.0, order=3, branch=2, periods=40,
        says="At 5 Hz the block leaves the in-phase 1/3 subharmonic and settles to the stable "
        "out-of-phase 1/3 subharmonic.",
    ),
    Case(
        id="10", amplitude=6.0, frequency_ratio=4.0, order=1, branch=1, periods=10,
        says="A typical stable out-of-phase harmonic motion.",
    ),
    Case(
        id="11a", amplitude=4.0, frequency_ratio=6.0, order=3, branch=1, periods=32,
        says="A stable out-of-phase 1/3 subharmonic with two peaks in each half cycle.",
    ),
    Case(
        id="11b", amplitude=2.0, frequency_ratio=6.0, order=3, branch=1, periods=28,
        says="A stable out-of-phase 1/3 subharmonic; its second peak has all but gone.",
    ),
    Case(
        id="12a", amplitude=2.0, frequency_ratio=2.0, order=1, branch=1, periods=40,
        says="The symmetric harmonic motion is stable.", chosen=(AXIS_ILLEGIBLE,),
    ),
    Case(
        id="12b", amplitude=2.0, frequency_ratio=1.9, order=1, branch=1, periods=40,
        says="The symmetric harmonic motion is unstable; the block shifts gradually to a stable "
        "unsymmetric harmonic one.",
    ),
    Case(
        id="12c", amplitude=2.0, frequency_ratio=1.8, order=1, branch=1, periods=32,
        says="As at 1.9, with more asymmetry.",
    ),
    Case(
        id="12d", amplitude=2.0, frequency_ratio=1.7, order=1, branch=1, periods=20,
        says="The unsymmetric motion has gone: the block overturns.", chosen=(AXIS_ILLEGIBLE,),
    ),
    Case(
        id="13a", amplitude=2.0, frequency_ratio=4.4, order=3, branch=1, periods=40,
        says="The symmetric 1/3 subharmonic is stable.", chosen=(NO_AMPLITUDE,),
    ),
    Case(
        id="13b", amplitude=2.0, frequency_ratio=4.2, order=3, branch=1, periods=80,
        says="The symmetric 1/3 subharmonic is unstable; the block settles to an unsymmetric one.",
        chosen=(NO_AMPLITUDE,),
    ),
    Case(
        id="13c", amplitude=2.0, frequency_ratio=3.6, order=3, branch=1, periods=32,
        says="No 1/3 subharmonic is stable; the block settles to the symmetric harmonic motion.",
        chosen=(NO_AMPLITUDE,),
    ),
    Case(
        id="13d", amplitude=2.0, frequency_ratio=3.0, order=3, branch=1, periods=32,
        says="After a few subharmonic cycles the block overturns.",
        chosen=(NO_AMPLITUDE, AXIS_ILLEGIBLE),
    ),
)  # fmt: skip


@dataclass(frozen=True, kw_only=True)
class History:
    """One of the paper's time histories, computed: an unstable one on both sides."""

    case: Case

    @cached_property
    def shaking(self) -> Harmonic:
        """The base motion; the steady state decides its phase."""
        return Harmonic(amplitude=self.case.amplitude, frequency_ratio=self.case.frequency_ratio)

    @cached_property
    def start(self) -> Steady:
        """The steady state on which the run starts."""
        return Steady(branch=self.case.branch, order=self.case.order, kick=KICK)

    @cached_property
    def states(self) -> SteadyStates:
        """Both steady states of the order at this point."""
        case = self.case
        return steady_states(case.amplitude, case.frequency_ratio, RESTITUTION, order=case.order)

    @property
    def stable(self) -> bool:
        """Whether the steady state is stable, by its exact multipliers."""
        return bool(self.states.stable[self.case.branch - 1])

    @property
    def multiplier(self) -> complex:
        """Largest multiplier of its half cycle."""
        return complex(self.states.multipliers[self.case.branch - 1, 0])

    @property
    def sides(self) -> tuple[int, ...]:
        """Sides on which it is left: both, or one where it is stable and not left at all."""
        return SIDES[:1] if self.stable else SIDES

    @cached_property
    def runs(self) -> dict[int, Trajectory]:
        """The run within the paper's time axis, for each side."""
        block = DimensionlessBlock(restitution=RESTITUTION)
        return {
            side: simulate(
                block, self.shaking, start=self.start, cycles=self.case.periods, side=side
            )
            for side in self.sides
        }

    @cached_property
    def fates(self) -> dict[int, Fate]:
        """What the drawn runs settle to, for each side."""
        return {
            side: settle(RESTITUTION, self.shaking, self.start, side=side) for side in self.sides
        }

    @cached_property
    def fates_over_kicks(self) -> dict[int, list[Fate]]:
        """Fates over `KICKS`, for each side; empty for a stable state."""
        if self.stable:
            return {}
        return {
            side: fates_over_kicks(RESTITUTION, self.shaking, self.start, side=side, kicks=KICKS)
            for side in SIDES
        }

    @property
    def growth(self) -> float:
        """By what a small distance from the orbit has grown at the end of the paper's axis."""
        return float(abs(self.multiplier) ** (2.0 * self.case.periods / self.case.order))

    def panel(self) -> Panel:
        """Return the figure with its data and its words."""
        case, fates, over_kicks = self.case, self.fates, self.fates_over_kicks  # computed here
        chosen = list(case.chosen)
        if not self.stable:
            chosen.append(
                "The paper leaves an unstable motion by the rounding of its computer; here it is "
                f"left along its unstable direction on both sides, from a distance of {KICK:g}."
            )
        tables = {}
        if over_kicks:
            tables["fates"] = (
                ("side", "kick", "fate", "leans", "overturned_after_periods"),
                [
                    (side, kick, fate.kind.value, fate.bias, fate.overturned_after)
                    for side in SIDES
                    for kick, fate in zip(KICKS.tolist(), over_kicks[side], strict=True)
                ],
            )
        return Panel(
            id=case.id,
            title=self.title,
            says=case.says,
            computed=self._computed(fates),
            choices=tuple(chosen),
            header=(
                "side", "pivot_time", "tau", "excitation_periods", "angle_per_alpha",
                "velocity_per_pivot_time", "base_acceleration_per_alpha_g",
            ),
            rows=list(self._rows()),
            more_tables=tables,
            draw=self._draw,
        )  # fmt: skip

    @property
    def title(self) -> str:
        """What it shows, in one line."""
        case = self.case
        phase = "in phase" if case.branch == 2 else "out of phase"
        return (
            f"Symmetric {motion_name(case.order)} {phase}, A = {case.amplitude:g}, "
            f"Ω = {case.frequency_ratio:g} ({case.frequency_ratio:g} Hz), δ = {RESTITUTION:g}"
        )

    def _computed(self, fates: dict[int, Fate]) -> str:
        """Say what came out."""
        size = multiplier_text(self.multiplier)
        if self.stable:
            fate = fates[1]
            return (
                f"Stable: the half cycle's largest multiplier is {size}. Peak {fate.highest:.5f}, "
                f"of the closed form {float(self._peak):.5f}."
            )
        unstable = (
            f"Unstable: the half cycle's largest multiplier is {size}, so that within the axis a "
            f"small distance from the orbit grows {times(self.growth)}."
        )
        parts = [unstable]
        for side, fate in fates.items():
            ends = fate.label
            if fate.period:
                ends += f", θ/α between {signed(fate.lowest, '.5f')} and {fate.highest:.5f}"
            parts.append(f"Left on the {sign(side)} side: {ends}.")
        for side, found in self.fates_over_kicks.items():
            parts.append(
                f"Of {len(found)} distances from {KICKS[0]:g} to {KICKS[-1]:g} on the "
                f"{sign(side)} side: {counted(found)}."
            )
        return " ".join(parts)

    @property
    def _peak(self) -> float:
        assert self.states.peak is not None
        return float(self.states.peak[self.case.branch - 1])

    def _rows(self) -> Iterator[tuple[object, ...]]:
        for side, run in self.runs.items():
            motion = run(run.times(ROWS_PER_PERIOD))
            assert motion.tau is not None
            columns = (
                motion.s, motion.tau, motion.tau / (2.0 * math.pi), motion.angle, motion.velocity,
                motion.base_acceleration,
            )  # fmt: skip
            for row in zip(*(column.tolist() for column in columns), strict=True):
                yield (side, *row)

    def _draw(self) -> "Figure":
        from rocksteady.studies.tso_wong_1989.history_figure import history_figure

        return history_figure(self)


def histories() -> dict[str, History]:
    """Return every time history of the paper, by the number of its figure; nothing is run yet."""
    return {case.id: History(case=case) for case in CASES}


def counted(fates: Sequence[Fate]) -> str:
    """Return how many fates there are of each kind, the most frequent first."""
    names = Counter(
        "overturned" if math.isfinite(fate.overturned_after) else _leaning(fate) for fate in fates
    )
    return ", ".join(f"{count} {name}" for name, count in names.most_common())


def _leaning(fate: Fate) -> str:
    if fate.bias == 0:
        return fate.label
    return f"{fate.label} leaning to {sign(fate.bias)}"
