"""Flags for a window of initial states, and for the moment at which they are taken."""

from dataclasses import dataclass

from rocksteady.cli.console.refusals import FlagError, both
from rocksteady.cli.flags.options import Panel
from rocksteady.cli.flags.parsing import axis
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock

window_flag = Panel("Window")


@dataclass(frozen=True, kw_only=True)
class WindowFlags:
    """A window of angles and velocities: a state in each of its cells, at one moment."""

    phase: str = window_flag(
        "--phase RAD",
        "Phase of the shaking at which the states are taken, or an axis of it \\[rad].",
        default="0",
    )
    angles: str | None = window_flag(
        "--angles AXIS",
        "u = theta/alpha, start:stop:count; by default the middles of 144 cells up to 1.2 on "
        "either side, as on the page; for an erosion, a record or a pulse 200 up to 1.5 or "
        "further.  With --one-sided from 0.",
    )
    velocities: str | None = window_flag(
        "--velocities AXIS",
        "du/d(pt), start:stop:count; by default 108 up to 1.5; for an erosion, a record or a "
        "pulse as for the angles.",
    )
    seed: int | None = window_flag(
        "--seed N",
        "Draw a random state in each cell of the window with this seed; default: its middle.",
    )
    time_pt: float | None = window_flag(
        "--at-pt PT",
        "Pivot time p t of the record or the pulse at which the states are taken; default 0.",
    )
    time_s: float | None = window_flag(
        "--at-s T", "The same in seconds, for a block of known size."
    )

    @property
    def axes(self) -> dict[str, list[float]]:
        """Angles and velocities that are given.

        Raises
        ------
        InputError
            If one is no axis.
        """
        texts = {"angles": self.angles, "velocities": self.velocities}
        return {name: axis(name, text) for name, text in texts.items() if text is not None}

    def moment(self, body: Block | DimensionlessBlock) -> float:
        """Return the pivot time of --at-pt or --at-s.

        Raises
        ------
        FlagError
            If both are given, or seconds for a block without a size.
        """
        if self.time_s is None:
            return 0.0 if self.time_pt is None else self.time_pt
        if self.time_pt is not None:
            raise both("--at-pt", "--at-s", valid="they are one moment")
        if isinstance(body, Block):
            return self.time_s * body.p
        raise FlagError(
            "--at-s",
            self.time_s,
            "seconds need a block of known size",
            "describe a block, or give --at-pt",
        )
