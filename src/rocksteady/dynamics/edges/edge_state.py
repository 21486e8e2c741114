"""Edge state: what a motion on the border of two basins settles to."""

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.dynamics.edges._edge_facts import case_of, place
from rocksteady.dynamics.edges.hilltop import HilltopSaddle
from rocksteady.dynamics.history.start import State
from rocksteady.dynamics.orbits.attractor import Attractor
from rocksteady.dynamics.orbits.orbit import Orbit
from rocksteady.dynamics.overturning.window_lists import OTHER_WAY
from rocksteady.dynamics.steady.verdicts import multipliers_text, multipliers_value
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked_result
from rocksteady.model.equations import Linear, Model
from rocksteady.model.facts import kick_m_s, kick_text, other_kick_text, solved_text
from rocksteady.model.motions.segments import Harmonic
from rocksteady.model.units import in_units
from rocksteady.results.answer import Answer
from rocksteady.results.description import Description, Fact
from rocksteady.results.numbers import DIGITS, number, number_or_none, plural
from rocksteady.results.result import Result

if TYPE_CHECKING:
    import pandas as pd


MORE_DIGITS = 6
"""Significant digits of a kick below an answer."""
MOST_KICK = 4.0
"""Largest kick that is tried [alpha g/p]."""
MEANING = {
    "hilltop": "On the edge the block balances about its upright position and has no impact.",
    "orbit": "On the edge the block rocks for ever in an unstable orbit.",
    "lost": "On the edge the block could not be followed: one of the two motions beside it falls.",
    "aperiodic": (
        "On the edge the motion has not repeated: the edge is fractal with a chaotic motion in it, "
        "or the motion is slow. More periods, or other states, decide."
    ),
}


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class EdgeState(Result):
    """What a motion on the border of two basins settles to.

    Attributes
    ----------
    block, motion
        Block and base motion; the phase of `motion` is that of `start`, `other`, `boundary` and of
        the tracked states, in [0, 2 pi).
    kind
        "hilltop" or "orbit" for a saddle of that kind; "aperiodic" where the tracked motion does
        not repeat, "lost" where it could not be followed.
    saddle
        `HilltopSaddle` or `Orbit`, found by Newton's method; None without one.
    start, other
        The states between which the border was sought.
    attractors
        What either settles to.
    outcomes
        The same in words, with the side of a fall.
    boundary
        The state on the border between them, to 1e-10 of it, at which the tracking began.
    kick
        The least fatal kick from `start` [alpha g/p], with its sign; None where `other` was given.
    opposite
        The least fatal kick in the other direction; nan where none up to 4 alpha g/p is fatal, None
        where that direction was not searched.
    fractal
        Whether smaller steps of the kick find more borders, so that `kick` is the least one found;
        None where `other` was given.
    width
        Width of the window of fatal kicks that begins at `kick`, to 1 % [alpha g/p]; None where the
        border is not fractal in that direction.
    resolution
        Step of the sizes up to twice the least [alpha g/p]: narrower windows of fatal kicks may be
        missed.
    angle, velocity
        The tracked motion at the phase, period by period, shape (periods + 1,).
    bisections
        States whose outcome was computed.
    exponent
        Rate at which motions leave the border, per forcing period, from the growth of the pairs
        that bracket it: the Lyapunov exponent of the tracked motion.
    distance
        From the last tracked state to the saddle at the phase, in (u, du/d(pt)); nan without one.
    model
        Which equations of motion hold: `Linear` or `Nonlinear`.
    """

    block: Block | DimensionlessBlock
    motion: Harmonic
    kind: str
    saddle: Orbit | HilltopSaddle | None
    start: State
    other: State
    attractors: tuple[Attractor, Attractor]
    outcomes: tuple[str, str]
    boundary: State
    kick: float | None
    opposite: float | None
    fractal: bool | None
    width: float | None
    resolution: float | None
    angle: Floats
    velocity: Floats
    bisections: int
    exponent: float
    distance: float
    model: Model = field(default_factory=Linear)

    @property
    def periods(self) -> int:
        """Forcing periods for which the border was tracked."""
        return len(self.angle) - 1

    @property
    def kick_m_s(self) -> float:
        """The least fatal kick [m/s]; nan of a dimensionless block, or where there is none."""
        return kick_m_s(self.block, self.kick)

    def to_dataframe(self) -> "pd.DataFrame":
        """Return one row per tracked state: periods since the boundary, angle and velocity."""
        import pandas as pd

        columns = {"period": np.arange(len(self.angle)), "angle": self.angle}
        return pd.DataFrame(in_units({**columns, "velocity": self.velocity}, self.block))

    def describe(self) -> Description:
        """Return what the edge state is, what it parts, and how it was tracked."""
        saddle = self.saddle
        words = "hilltop saddle" if self.kind == "hilltop" else self.kind
        if isinstance(saddle, Orbit):
            words = f"unstable orbit of {plural(saddle.period, 'period')}"
        multipliers = None if saddle is None else multipliers_value(saddle.multipliers)
        first, second = self.outcomes
        facts = [
            Fact("kind", self.kind, "edge state", words),
            Fact("outcomes", [first, second], "between", f"{first} and {second}"),
            Fact("period", None if saddle is None else saddle.period),
            Fact("hilltop_side", saddle.side if isinstance(saddle, HilltopSaddle) else None),
            Fact("highest", None if saddle is None else saddle.highest),
            Fact("lowest", None if saddle is None else saddle.lowest),
            Fact(
                "multipliers",
                multipliers,
                "" if multipliers is None else "multipliers",
                "" if multipliers is None else multipliers_text(multipliers),
            ),
            Fact("exponent", self.exponent, "exponent", f"{number(self.exponent)} a period"),
            Fact(
                "least_kick",
                self.kick,
                "" if self.kick is None else "least kick",
                "" if self.kick is None else kick_text(self.block, self.kick, MORE_DIGITS),
            ),
            Fact("least_kick_m_s", number_or_none(self.kick_m_s)),
            Fact("opposite_kick", self.opposite, *self._other_way(MORE_DIGITS)),
            Fact("opposite_kick_m_s", number_or_none(kick_m_s(self.block, self.opposite))),
            Fact("fractal", self.fractal),
            Fact("width", self.width),
            Fact("resolution", self.resolution, *self._searched),
            Fact("start_state", _pair(self.start), "start", _text(self.start)),
            Fact("other_state", _pair(self.other), "other", _text(self.other)),
            Fact("boundary_state", _pair(self.boundary), "boundary", _text(self.boundary)),
            Fact("phase", self.motion.phase, "phase", f"{number(self.motion.phase)} rad"),
            Fact("periods", self.periods, "tracked for", plural(self.periods, "forcing period")),
            Fact("bisections", self.bisections, "outcomes computed"),
            Fact("distance", None if saddle is None else self.distance),
            *case_of(self.block, self.motion, self.model),
        ]
        if saddle is not None:
            facts.append(Fact("", label="distance", text=f"{self.distance:.1e} at the end"))
        headline = f"Edge state, {words}: {place(self.block, self.motion, self.model)}"
        return Description(headline, facts, notes=[MEANING[self.kind]], answer=self._answer)

    @property
    def _answer(self) -> Answer:
        """The least kick or a state of the edge, and what the block does on the edge."""
        plain = {"rest": "rests"}
        first, second = (
            plain.get(each, each.replace("overturned", "falls")) for each in self.outcomes
        )
        start = "rest" if _pair(self.start) == [0.0, 0.0] else _text(self.start)
        if self.kick is None:
            words = f"the edge between both starts passes {_state(self.boundary)}"
        else:
            sign = "negative " if self.kick < 0.0 else "positive "
            kind = sign * (self.opposite is None) + "kick" + " found" * bool(self.fractal)
            size = kick_text(self.block, self.kick)
            words = f"from {start} the least {kind} that makes it fall is {size}"
        sentence, periods = f"{words[0].upper()}{words[1:]}.", plural(self.periods, "period")
        if self.saddle is None:
            ending = "could not be followed beyond" if self.kind == "lost" else "does not repeat in"
            sentence = f"Undecided on the edge, which {ending} {periods}; {words}."
        pair = None if self.saddle is None else multipliers_text(self.saddle.multipliers)
        leaves = f"{number(math.exp(self.exponent))}-fold a period"
        meaning = MEANING[self.kind].split(": ")[0].split(". ")[0].removesuffix(".")
        meaning = meaning.removeprefix("On the edge ").replace("the block", "it")
        return Answer(
            sentence,
            [
                self._other_way(),
                self._searched,
                ("on the edge", solved_text(meaning, self.block)),
                ("leaves the edge", f"{leaves} (multipliers {pair})" if pair else leaves),
                ("between", f"{first} and {second}"),
                ("computed", f"{self.model.name}; {self.bisections} outcomes over {periods}"),
            ],
        )

    def _other_way(self, digits: int = DIGITS) -> tuple[str, str]:
        """Return the least kick in the other direction, as a fact."""
        if self.opposite is None:
            return "", ""
        return OTHER_WAY, other_kick_text(self.block, self.opposite, (0.0, MOST_KICK), digits)

    @property
    def _searched(self) -> tuple[str, str]:
        """The resolution, as a fact, where smaller kicks may be fatal."""
        text = f"in steps of {number(self.resolution or 0.0)} alpha g/p; fractal: smaller kicks "
        text += "may fell it, and larger ones may not"
        if self.width is not None:
            text += f"; this window is {number(self.width, 2)} wide"
        return "searched", text * bool(self.fractal)


def _pair(state: State) -> list[float]:
    return [state.angle, state.velocity]


def _state(state: State) -> str:
    return f"u = {number(state.angle)}, du/d(pt) = {number(state.velocity)}"


def _text(state: State) -> str:
    return f"{state.angle:.10g},{state.velocity:.10g}"
