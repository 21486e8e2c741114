"""Figs 8 to 13: time histories started on a symmetric steady state."""

import math
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

from rocksteady import DimensionlessBlock, Harmonic, Steady, plots, simulate
from rocksteady.formulas import steady_states
from rocksteady.histories import Trajectory
from rocksteady.kernels.elementary.arrays import exp, hypot, log
from rocksteady.orbits import SteadyStates
from rocksteady.show.style import palette
from rocksteady.studies.tso_wong_1989.figures._fate_plots import (
    plot_fates,
    plot_key,
    plot_settled,
)
from rocksteady.studies.tso_wong_1989.figures.cases import (
    CASES,
    KICK,
    KICKS,
    RESTITUTION,
    SIDES,
    Case,
)
from rocksteady.studies.tso_wong_1989.figures.fates import Fate, Kind, fates_over_kicks, settle
from rocksteady.studies.tso_wong_1989.figures.panel import Panel
from rocksteady.studies.tso_wong_1989.figures.words import (
    motion_name,
    multiplier_text,
    sign,
    signed,
    times,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure

WORDS = 0.16
"""Room over the motions for two lines of words, in parts of their height."""
ROWS_PER_PERIOD = 60
"""Rows of data in a forcing period; impacts are rows too."""


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
        return complex(self.states.half_cycle_multipliers[self.case.branch - 1, 0])

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
                block, self.shaking, start=replace(self.start, side=side), cycles=self.case.periods
            )
            for side in self.sides
        }

    @cached_property
    def fates(self) -> dict[int, Fate]:
        """What the drawn runs settle to, for each side."""
        return {
            side: settle(RESTITUTION, self.shaking, replace(self.start, side=side))
            for side in self.sides
        }

    @cached_property
    def fates_over_kicks(self) -> dict[int, list[Fate]]:
        """Fates over `KICKS`, for each side; empty for a stable state."""
        if self.stable:
            return {}
        return {
            side: fates_over_kicks(
                RESTITUTION, self.shaking, replace(self.start, side=side), kicks=KICKS
            )
            for side in SIDES
        }

    @property
    def growth(self) -> float:
        """By what a small distance from the orbit has grown at the end of the paper's axis."""
        return exp(log(self.modulus) * 2.0 * self.case.periods / self.case.order)

    @property
    def modulus(self) -> float:
        """Modulus of the half cycle's larger multiplier."""
        return hypot(self.multiplier.real, self.multiplier.imag)

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
        for side, kick_fates in self.fates_over_kicks.items():
            parts.append(
                f"Of {len(kick_fates)} distances from {KICKS[0]:g} to {KICKS[-1]:g} on the "
                f"{sign(side)} side: {counted(kick_fates)}."
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
                motion.pt, motion.tau, motion.tau / (2.0 * math.pi), motion.angle, motion.velocity,
                motion.base_acceleration,
            )  # fmt: skip
            for row in zip(*(column.tolist() for column in columns), strict=True):
                yield (side, *row)

    def _draw(self) -> "Figure":
        """Draw a row for each side and, of an unstable state, a strip of fates."""
        from matplotlib.figure import Figure

        rows = len(self.sides)
        strips = 0 if self.stable else 1
        heights = [2.0] * rows + [0.32] * strips
        with palette.style():
            figure = Figure(figsize=(7.2, 0.9 + sum(heights) + 0.35 * strips))
            grid = figure.add_gridspec(
                rows + strips, 2, width_ratios=(4.6, 1.0), height_ratios=heights
            )
            first = None
            limits: list[tuple[float, float]] = []
            for row, side in enumerate(self.sides):
                motion = figure.add_subplot(grid[row, 0], sharey=first)
                settled = figure.add_subplot(grid[row, 1], sharey=motion)
                first = motion if first is None else first
                fate = self.fates[side]
                motion.set_xlim(0.0, self.case.periods)
                plots.trajectory(self.runs[side], motion)
                limits.append(motion.get_ylim())
                ends = (1.12 * fate.lowest, 1.12 * fate.highest)
                limits.append(ends if fate.period else limits[0])
                motion.set_title(self._heading(side, fate))
                plot_settled(fate, settled)
                if row + 1 < rows:
                    motion.set_xlabel("")
                    settled.set_xlabel("")
            assert first is not None
            low, high = min(low for low, _ in limits), max(high for _, high in limits)
            first.set_ylim(low, high + WORDS * (high - low))
            if strips:
                plot_fates(self.fates_over_kicks, figure.add_subplot(grid[rows, 0]))
                plot_key(self.fates_over_kicks, figure.add_subplot(grid[rows, 1]))
            figure.suptitle(f"Fig. {self.case.id}  {self.title}", x=0.01, ha="left", fontsize=9.5)
        return figure

    def _heading(self, side: int, fate: Fate) -> str:
        words = fate.label.replace("overturns", "falls").replace("at rest", "comes to rest")
        if self.stable:
            return f"stable: {words}"
        later = KICK * self.growth < 0.1 and fate.kind is not Kind.OVERTURNED
        return (
            f"unstable, left on the {sign(side)} side: {words}"
            f"{', later than drawn here' if later else ''}"
        )


def histories() -> dict[str, History]:
    """Return every time history of the paper, by the number of its figure; nothing is run yet."""
    return {case.id: History(case=case) for case in CASES}


def counted(fates: Sequence[Fate]) -> str:
    """Return how many fates there are of each kind, the most frequent first."""
    names = Counter(
        "overturned" if math.isfinite(fate.overturned_after) else _towards(fate) for fate in fates
    )
    return ", ".join(f"{count} {name}" for name, count in names.most_common())


def _towards(fate: Fate) -> str:
    if fate.bias == 0:
        return fate.label
    return f"{fate.label} towards {sign(fate.bias)}"
