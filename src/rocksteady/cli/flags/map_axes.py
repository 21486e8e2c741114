"""Axes of a map, from flags given as start:stop:count."""

import math
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from rocksteady.cli.console.refusals import FlagError, refuse
from rocksteady.cli.flags import options
from rocksteady.cli.flags.block_and_shaking import BlockFlags, ShakingFlags
from rocksteady.cli.flags.parsing import axis
from rocksteady.cli.flags.start import HINT, TAU, StartFlags, typed_error
from rocksteady.dynamics.parameters import AXES, SIZES, shaking_of
from rocksteady.errors import InputError, ModelError
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.blocks.housner_forms import Housner, form_of_text, form_text
from rocksteady.model.facts import harmonic_values
from rocksteady.model.motions.segments import Harmonic

RESIZED = frozenset({"width", "height", "radius", "p"})
"""Measures that change the frequency parameter of a block."""
LEANER = frozenset({"width", "height", "alpha"})
"""Measures that change alpha, by which amplitudes are measured."""
AMPLITUDE = {"amplitude": "amplitude", "acceleration_m_s2": "accel_g"}
FREQUENCY = {"frequency_ratio": "frequency_ratio", "frequency_hz": "freq_hz"}
"""JSON keys by the parameters that they are."""


@dataclass(frozen=True, kw_only=True)
class MapStartFlags:
    """Where the motions of a map begin; phase, state and kick may be axes."""

    start: str = options.start_flag(
        "--start START",
        "Set the start: rest (default), steady or steady:2 (on branch 1 or 2 of order -n), U,V "
        "(u and du/d(pt)), or U,tau=DU (DU = du/d(omega t)). Both may be axes, as "
        "--start=-1:1:200,0.",
        default="rest",
    )
    order: int = options.order()
    phase: str | None = options.start_flag(
        "--phase RAD",
        "Phase of the shaking at the start \\[rad], default 0, or an axis; not with --start "
        "steady.",
    )
    side: str = options.side()
    kick: str | None = options.start_flag(
        "--kick K",
        "Distance from an unstable steady state at the start, default 1e-6, or an "
        "axis: length of (phase \\[rad], velocity over the orbit's).",
    )

    @cached_property
    def parameters(self) -> dict[str, list[float]]:
        """What is given of phase, kick, angle and velocity, each an axis or one value.

        The velocity is in the unit of the flag.

        Raises
        ------
        InputError
            If one is neither an axis nor a number.
        """
        texts = {"phase": self.phase, "kick": self.kick}
        axes_given = {name: axis(name, text) for name, text in texts.items() if text is not None}
        return axes_given | self._state()

    def _state(self) -> dict[str, list[float]]:
        """Return the two halves of --start U,V or U,tau=DU; nothing of another start."""
        angle, comma, velocity = self.start.partition(",")
        if not comma:
            return {}
        halves = {"angle": angle, "velocity": velocity.removeprefix(TAU)}
        try:
            state = {name: axis("start", text) for name, text in halves.items()}
        except InputError as error:
            valid = error.valid if ":" in self.start else "it is not two numbers"
            raise InputError("start", self.start, valid, HINT) from None
        if not all(math.isfinite(value) for values in state.values() for value in values):
            valid = "its numbers must be finite"
            raise InputError("start", self.start, valid, HINT)
        return state

    def at_first(self) -> StartFlags:
        """Return the flags of a single motion: of the first value of each axis."""
        first = {name: values[0] for name, values in self.parameters.items()}
        start = self.start
        if "angle" in first and ":" in start:
            equals = TAU if self._per_tau else ""
            start = f"{first['angle']!r},{equals}{first['velocity']!r}"
        return StartFlags(
            start=start,
            order=self.order,
            side=self.side,
            phase=first.get("phase"),
            kick=first.get("kick"),
        )

    @contextmanager
    def as_typed(self) -> Iterator[None]:
        """Show in errors what was typed, not the first value of its axis."""
        typed = {"start": self.start, "phase": self.phase, "kick": self.kick}
        try:
            yield
        except ModelError as error:
            text = typed.get(error.name.removeprefix("--"))
            if text is None:
                raise
            raise typed_error(error.name, text, error) from error

    @property
    def _per_tau(self) -> bool:
        """Whether the velocity is du/d(omega t)."""
        return "," + TAU in self.start

    def velocities(self, shaking: Harmonic, *, one_for_all: bool) -> list[float]:
        """Return the velocities du/d(pt) of the start; none where it is no state.

        Parameters
        ----------
        shaking
            At the first value of each axis.
        one_for_all
            Whether its frequency ratio is that of every cell.

        Raises
        ------
        ModelError
            If du/d(omega t) would be another du/d(pt) in each cell.
        """
        values = self.parameters.get("velocity", [])
        if not self._per_tau or not any(values):
            return values
        if not one_for_all:
            raise FlagError(
                "start",
                self.start,
                "where omega/p moves, du/d(omega t) is another velocity in each cell",
                "give du/d(pt), as 0.4,0.1",
            )
        return [velocity * shaking.frequency_ratio for velocity in values]


@dataclass(frozen=True, kw_only=True)
class MapCase:
    """What a map is of.

    Attributes
    ----------
    body, motion, start
        At the first value of each axis.
    axes
        Values by the names of `rocksteady.map_attractors`, in the order of the dimensions.
    fixed
        Parameters that were given one value, as it was given: what follows from it in a cell is
        then what follows from it at that point alone.
        The restitution is a form of "housner" where it follows from the slenderness in each cell.
    """

    body: Block | DimensionlessBlock
    motion: Harmonic
    start: StartFlags
    axes: dict[str, list[float]]
    fixed: dict[str, float | Housner]

    @property
    def values(self) -> dict[str, Any]:
        """Block, motion and start of the flags; None for what is an axis or moves with one."""
        values = harmonic_values(self.body, self.motion)
        values |= self.start.values(self.motion.phase)
        axes = set(self.axes)
        moving = set(axes)
        for names, sizes in ((AMPLITUDE, LEANER), (FREQUENCY, RESIZED)):
            if axes & names.keys():
                moving |= set(names.values())
            elif axes & sizes:  # what was given stays, and moves in the other measure
                moving |= {word for name, word in names.items() if name not in self.fixed}
        if axes & set(SIZES):
            values["block"] = None
            moving |= {"restitution"} & self.fixed.keys()
        if "restitution" in axes:  # of both impacts
            moving |= {"negative_restitution"}
        if moving & {"velocity", "angle"}:
            values["start"] = None
        values |= dict.fromkeys(moving & values.keys())
        form = self.fixed.get("restitution")
        if isinstance(form, tuple):  # no number for all cells
            values["restitution"] = form_text(form[1])
        return values

    @property
    def cells(self) -> int:
        """Number of cells."""
        return math.prod(len(values) for values in self.axes.values())


def map_case(shaking: ShakingFlags, block: BlockFlags, start: MapStartFlags) -> MapCase:
    """Return what the flags describe.

    Raises
    ------
    InputError, ModelError
        If a value is missing, given twice or outside its range, or there is no axis.
    """
    body = block.at_first().described()
    given = shaking.parameters(body)
    first = start.at_first()
    shaken = shaking_of(
        body, {"phase": first.first_phase, **{name: values[0] for name, values in given.items()}}
    )
    with start.as_typed():
        first.check(shaken=True)
    resized = any(len(values) > 1 for values in block.sizes.values())
    if resized:  # else the block has them
        moved = ("offset_m", "mass_centre_height_m", "gyration_m")
        flags = {"--" + name.replace("_", "-"): getattr(block, name) for name in moved}
        refuse(flags, "sizes along an axis are those of homogeneous rectangles")
        given |= block.sizes
    if block.restitutions:
        given["restitution"] = block.restitutions
    given |= start.parameters
    moving = {name for name, values in given.items() if len(values) > 1}
    one_for_all = not (
        moving & {"frequency_ratio", "frequency_hz"}
        or ("frequency_hz" in given and moving & RESIZED)
    )
    if "velocity" in given:
        given["velocity"] = start.velocities(shaken, one_for_all=one_for_all)
    if not moving:
        raise FlagError(
            finding="none of -A, -W, -r and the other flags of the case is an axis",
            valid="at least one flag of block, shaking or start must be",
            hint="give one as start:stop:count, as -A 0.1:6:300",
        )
    follows = form_of_text("housner" if block.restitution is None else block.restitution)
    housner = {} if follows is None or not resized else {"restitution": follows}
    return MapCase(
        body=body,
        motion=shaken,
        start=first,
        axes={name: given[name] for name in AXES if name in moving},
        fixed={
            **{name: given[name][0] for name in AXES if name in given.keys() - moving},
            **housner,
        },
    )
