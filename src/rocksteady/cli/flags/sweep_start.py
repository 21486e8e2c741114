"""Initial states of the sweeps in a bifurcation diagram."""

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from rocksteady.cli.console.refusals import FlagError
from rocksteady.cli.flags import options
from rocksteady.cli.flags.range import Range
from rocksteady.cli.flags.start import STEADY, StartFlags

if TYPE_CHECKING:
    from rocksteady.dynamics.history.start import Start

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

    def chosen(self, span: Range) -> "Start":
        """Return the start of the sweeps along an axis.

        Without --start it is a steady state: the library begins at rest where there is none.

        Raises
        ------
        InputError, ModelError
            If it is no start, or a steady state that was typed does not exist at either end.
        """
        if self.start == AUTO and self.phase is None:
            return replace(self, start="steady").of(span.motion.frequency_ratio)
        typed = "rest" if self.start == AUTO else self.start
        kick = None if self.start == AUTO else self.kick
        order = self.order if typed in STEADY else 1  # else it is that of the branches alone
        plain = StartFlags(start=typed, order=order, phase=self.phase, side=self.side, kick=kick)
        begin = plain.of(span.motion.frequency_ratio)
        if typed in STEADY:
            from rocksteady.dynamics.history.start import initial_march

            with self.as_typed():
                for value in (span.values[0], span.values[-1]):
                    body, motion = span.at(value)
                    initial_march(begin, body.dimensionless(), motion)
        return begin

    def as_given(self, values: dict[str, Any]) -> dict[str, Any]:
        """Return the values of a diagram with the start of each sweep as it was typed."""
        if self.start == AUTO:
            return values
        sweeps = [{**sweep, "start": self.start} for sweep in values["sweeps"]]
        return {**values, "sweeps": sweeps}
