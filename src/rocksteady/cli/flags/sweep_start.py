"""Initial states of the sweeps in a bifurcation diagram."""

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from rocksteady.cli.console.refusals import FlagError
from rocksteady.cli.flags import options
from rocksteady.cli.flags.range import Range
from rocksteady.cli.flags.start import STEADY, StartFlags
from rocksteady.errors import ModelError

if TYPE_CHECKING:
    from rocksteady.dynamics.history.start import Start
    from rocksteady.dynamics.orbits.attractor_sweep import AttractorSweep

AUTO = "auto"


@dataclass(frozen=True, kw_only=True)
class SweepStart(StartFlags):
    """Where each sweep begins."""

    start: options.SweepStart = AUTO

    def refuse(self, why: str) -> None:
        """Refuse flags that only sweeps give a meaning.

        Raises
        ------
        InputError
            If there is one.
        """
        for name, value in (("start", self.start), ("phase", self.phase), ("kick", self.kick)):
            if value not in (None, AUTO):
                raise FlagError(name, value, f"{why}, it has no meaning", "leave it out")

    def begin(self, span: Range, value: float) -> tuple[str, "Start", float]:
        """Return at the first value of a sweep its start in a word, as a state, and the phase.

        Raises
        ------
        InputError, ModelError
            If it is no start, or there is no such steady state.
        """
        from rocksteady.dynamics.history.start import Rest

        if self.start == AUTO and self.phase is None:
            try:
                return replace(self, start="steady").begin(span, value)
            except ModelError:
                return "rest", Rest(), 0.0
        chosen = "rest" if self.start == AUTO else self.start
        kick = None if self.start == AUTO else self.kick
        order = self.order if chosen in STEADY else 1  # else it is that of the branches alone
        plain = StartFlags(start=chosen, order=order, phase=self.phase, side=self.side, kick=kick)
        bare, shaking = span.at(value)
        begin = plain.of(shaking.frequency_ratio)
        if chosen in STEADY:
            from rocksteady.dynamics.history.start import initial_march

            with self.as_typed():
                initial_march(begin, bare, shaking)  # refuses one that does not exist
        return chosen, begin, self.first_phase


@dataclass(frozen=True, kw_only=True)
class Sweep:
    """A sweep, and where it began."""

    start: str
    trail: "AttractorSweep"
