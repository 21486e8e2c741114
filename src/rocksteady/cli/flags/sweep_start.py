"""Initial states of the sweeps in a bifurcation diagram."""

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from rocksteady.cli.console.refusals import FlagError
from rocksteady.cli.flags import options
from rocksteady.cli.flags.range import Range, SeriesFlags
from rocksteady.cli.flags.start import STEADY, StartFlags
from rocksteady.model.equations import Model

if TYPE_CHECKING:
    from rocksteady.dynamics.history.start import Start

AUTO = "auto"
SINUSOID = SeriesFlags()
"""Shaking without harmonics of its own."""


@dataclass(frozen=True, kw_only=True)
class SweepStart:
    """Where each sweep begins; for several orders, the first is that of a steady state."""

    start: str = options.start_flag(
        "--start START",
        "Where a sweep begins, and begins again after a fall: auto (steady where its first value "
        "has that, else rest), rest, steady or steady:2 (branch 1 or 2 of the first -n), U,DU (u "
        "and du/d(pt)), or U,tau=DU (DU = du/d(omega t)). After a rest it goes on from rest.",
        default=AUTO,
    )
    order: list[int] | None = options.orders()
    phase: float | None = options.phase()
    side: str = options.side()
    kick: float | None = options.kick()

    @property
    def orders(self) -> tuple[int, ...]:
        """The orders in which branches start."""
        return tuple(self.order or (1,))

    @property
    def first_phase(self) -> float:
        """Phase of the shaking at the start, 0 where none is given."""
        return 0.0 if self.phase is None else self.phase

    @property
    def _plain(self) -> StartFlags:
        return StartFlags(
            start=self.start,
            order=self.orders[0],
            phase=self.phase,
            side=self.side,
            kick=self.kick,
        )

    def check(self) -> None:
        """Refuse flags that are none or contradict each other, as `StartFlags.check` does."""
        self._plain.check(shaken=True)

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

    def chosen(self, span: Range, model: Model, series: SeriesFlags = SINUSOID) -> "Start":
        """Return the start of the sweeps along an axis.

        Without --start it is a steady state: the library begins at rest where there is none.

        Parameters
        ----------
        span
            The axis.
        model
            Which equations of motion hold.
        series
            The harmonics of the shaking; by default it is a sinusoid.

        Raises
        ------
        InputError, ModelError
            If it is no start, or a steady state that was typed does not exist at either end.
        """
        if self.start == AUTO and self.phase is None:
            return replace(self._plain, start="steady").of(span.motion.frequency_ratio)
        typed = "rest" if self.start == AUTO else self.start
        kick = None if self.start == AUTO else self.kick
        order = self.orders[0] if typed in STEADY else 1  # else it is that of the branches alone
        plain = replace(self._plain, start=typed, order=order, kick=kick)
        begin = plain.of(span.motion.frequency_ratio)
        if typed in STEADY:
            from rocksteady.dynamics.history.start import initial_march

            with self._plain.as_typed():
                for value in (span.values[0], span.values[-1]):
                    body, motion = span.at(value)
                    sides = model.sides(body)
                    initial_march(begin, body.dimensionless(), series.of(motion), sides)
        return begin

    def as_given(self, values: dict[str, Any]) -> dict[str, Any]:
        """Return the values of a diagram with the start of each sweep as it was typed."""
        if self.start == AUTO:
            return values
        sweeps = [{**sweep, "start": self.start} for sweep in values["sweeps"]]
        return {**values, "sweeps": sweeps}
