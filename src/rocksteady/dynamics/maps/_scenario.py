"""Scenario of a map: block, shaking and start, some of whose parameters are axes.

What is no axis keeps its value in the measure in which it was given.  Converted at one block and
back at another, it would depend on the block that the caller began with.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import product

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats
from rocksteady.dynamics.arrays import order_of_orbit
from rocksteady.dynamics.batch.initial_states import at_phases, on_orbits
from rocksteady.dynamics.history.start import (
    ImpactState,
    Rest,
    Start,
    State,
    Steady,
    refuse_behind_wall,
    start_of,
)
from rocksteady.dynamics.maps._resizing import block_of, check_sizes, measures_of, sizes_with
from rocksteady.dynamics.orbits.return_map import periodic_motion
from rocksteady.dynamics.parameters import ASYMMETRY, shaking_of, validated_axes
from rocksteady.dynamics.steady.states import refuse_asymmetric
from rocksteady.errors import InputError, ModelError, Words
from rocksteady.kernels.core.tables import ALPHA, LEAN, RATE, RESTITUTION, is_nonlinear
from rocksteady.kernels.core.tuples import States
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.blocks.housner_forms import Restitution, form_text
from rocksteady.model.checks.validation import finite
from rocksteady.model.equations import Linear, Model, chosen_model
from rocksteady.model.motions.floor import Floor
from rocksteady.model.motions.fourier import FourierSeries, PeriodicMotion

AMPLITUDES = frozenset({"amplitude", "acceleration_m_s2"})
FREQUENCIES = frozenset({"frequency_ratio", "frequency_hz"})
STATE = frozenset({"angle", "velocity"})


@dataclass(frozen=True, kw_only=True, eq=False)
class Cells:
    """Motions as the kernels see them, arrays of shape (cells,).

    Attributes
    ----------
    amplitude, frequency_ratio
        A and Omega.
    sides
        As `model.equations.Linear.sides` has them, shape (cells, 2, 3) or
        (cells, 2, 5) in the nonlinear model.
    angle, velocity, phase
        theta/alpha and its derivative by pivot time at the start, and where the shaking is then
        [rad].
    there
        Where there is such a start; a steady state does not exist everywhere.
    """

    amplitude: Floats
    frequency_ratio: Floats
    sides: Floats
    angle: Floats
    velocity: Floats
    phase: Floats
    there: NDArray[np.bool_]

    @property
    def begin(self) -> States:
        """The states at the start, their phases split into whole half cycles and a rest."""
        return at_phases(self.angle, self.velocity, self.phase)


@dataclass(frozen=True, kw_only=True)
class Scenario:
    """A block, its shaking and its start, and which of their parameters are moved.

    All that is in it are frozen nouns, numbers and names, so that it can be stored, and sent to
    another process.

    Parameters
    ----------
    axes
        Names from `rocksteady.dynamics.parameters.AXES`, one or more.
    block
        What is neither axis nor fixed keeps the value that it has here, in the measures in which it
        is given here; `sizes_with` lists the sizes that remain.
    motion
        None only where amplitude and frequency are axes or fixed.
    start
        A rest with an angle or a velocity is a `State`, the other of them 0.
    fixed
        Names of the same kind, each with a value that takes the place of that of block, shaking or
        start.
    housner
        Factor of Housner's restitution, which follows from the slenderness, in place of the
        block's own; None (default) for the block's own.
    model
        `Linear()` or `Nonlinear()`, which needs a `Block`.
    floor
        Floor of a `Block`; amplitude and phase are then those of the ground.

    Raises
    ------
    InputError, ModelError
        If a name is unknown, or the parts do not go together.

    Examples
    --------
    >>> block = Block.rectangle(width=0.4, height=1.2, restitution=0.9)
    >>> base = (("acceleration_m_s2", 5.0), ("frequency_hz", 1.0))
    >>> scenario = Scenario(axes=("width",), block=block, fixed=base)
    >>> cells = scenario.cells({"width": np.array([0.4, 0.8])})
    >>> print(cells.amplitude.round(4), cells.frequency_ratio.round(4))
    [1.5846 0.8671] [1.8425 1.9674]
    """

    axes: tuple[str, ...]
    block: Block | DimensionlessBlock
    motion: PeriodicMotion | None = None
    start: Start = field(default_factory=Rest)
    fixed: tuple[tuple[str, float], ...] = ()
    housner: float | None = None
    model: Model = field(default_factory=Linear)
    floor: Floor | None = None

    def __post_init__(self) -> None:
        """Validate each part, and whether they go together."""
        names = [name for name, _ in self.fixed]
        object.__setattr__(self, "axes", validated_axes(self.axes, names))
        hint = "give a number, or a list of the values of an axis"
        fixed = tuple((name, finite(name, value, hint=hint)) for name, value in self.fixed)
        object.__setattr__(self, "fixed", fixed)
        self.block.dimensionless()  # refuses sides too unlike
        if self.motion is not None:
            periodic_motion(self.motion)
        object.__setattr__(self, "start", start_of(self.start))
        object.__setattr__(self, "model", chosen_model(self.model, self.block))
        check_sizes(self.block, self.given)
        self._check_restitution()
        if self.floor is not None and not isinstance(self.block, Block):
            valid = "a block of which only the restitution is known has no hertz"
            raise ModelError("motion", self.floor, valid, "give a Block")
        self._check_motion()
        self._check_start()

    @cached_property
    def given(self) -> tuple[str, ...]:
        """The parameters that are axes or fixed."""
        return (*self.axes, *(name for name, _ in self.fixed))

    @property
    def sizes(self) -> tuple[str, ...]:
        """The two sizes that determine the block; empty where it keeps its own."""
        return sizes_with(self.given)

    @cached_property
    def kept(self) -> dict[str, float]:
        """The parameters that are no axes, by their names, with the values that they keep.

        Without the restitution where it follows from the slenderness of each cell.
        """
        block, given = self.block, set(self.given)
        attributes: dict[str, float] = {name: getattr(block, name) for name in self.sizes}
        if self.housner is None and (block.symmetric or block.one_sided):
            attributes["restitution"] = block.restitution
        elif self.housner is not None and isinstance(block, Block) and not self.sizes:
            attributes["restitution"] = block.with_restitution(
                ("housner", self.housner)
            ).restitution
        if not isinstance(self.start, Steady):  # which decides on the phase
            attributes["phase"] = 0.0 if self.motion is None else self.motion.phase
        if self.motion is not None and not given & AMPLITUDES:
            attributes["amplitude"] = self.motion.amplitude
        if self.motion is not None and not given & FREQUENCIES:
            attributes["frequency_ratio"] = self.motion.frequency_ratio
        if isinstance(self.start, Steady):
            attributes["kick"] = self.start.kick
        elif isinstance(self.start, State):
            attributes.update(angle=self.start.angle, velocity=self.start.velocity)
        elif STATE & given:
            attributes.update(angle=0.0, velocity=0.0)
        attributes.update(self.fixed)
        return {name: value for name, value in attributes.items() if name not in self.axes}

    @property
    def attributes(self) -> dict[str, float | int | str]:
        """What a dataset over the axes was computed from: numbers and words."""
        attributes: dict[str, float | int | str] = {**self.kept}
        if isinstance(self.block, Block):
            attributes["gravity"] = self.block.gravity
            if not self.sizes:
                attributes.update(
                    {name: getattr(self.block, name) for name in ("alpha", "radius", "p")}
                )
            if self.block.parts:
                attributes["parts"] = self.block.parts
        if self.block.one_sided:
            attributes["one_sided"] = 1
        elif not self.block.symmetric:
            (first, _, _), (second, alpha_ratio, p_ratio) = self.block.dimensionless().sides
            attributes.setdefault("alpha_ratio", alpha_ratio)
            attributes.setdefault("p_ratio", p_ratio)
            if "restitution" not in self.given:
                attributes.update(restitution=first)
                attributes.setdefault("negative_restitution", second)
            attributes = {
                name: value for name, value in attributes.items() if name not in self.axes
            }
        if self.housner is not None:
            attributes.setdefault("restitution", form_text(self.housner))
        if isinstance(self.start, Steady):
            steady = self.start
            attributes.update(
                start="steady", branch=steady.branch, order=steady.order, side=steady.side
            )
        else:
            moved = isinstance(self.start, State) or STATE & set(self.given)
            attributes["start"] = "state" if moved else "rest"
        if isinstance(self.motion, FourierSeries):
            attributes["harmonics"] = str(self.motion.harmonics)
        if self.floor is not None:
            attributes["floor"] = self.floor.label
        attributes["model"] = self.model.name
        return attributes

    def at(
        self, cell: Mapping[str, float]
    ) -> tuple[Block | DimensionlessBlock, PeriodicMotion, Start]:
        """Return block, shaking and start where the axes have these values.

        Raises
        ------
        InputError
            If a value is outside its parameter's range.
        """
        given = {**self.kept, **cell}
        factor = 1.0 if self.housner is None else self.housner
        like = self.block.symmetric or self.block.one_sided
        block_restitution: Restitution | None = ("housner", factor) if like else None
        restitution: Restitution | None = given.get("restitution", block_restitution)
        block = block_of(self.block, self.sizes, given, restitution)
        shaking: PeriodicMotion = shaking_of(block, given)
        if self.floor is not None and isinstance(block, Block):
            size, phase = self._felt(shaking.amplitude, shaking.frequency_ratio, block.p)
            shaking = replace(shaking, amplitude=float(size), phase=shaking.phase + float(phase))
        if isinstance(self.motion, FourierSeries):
            ratios = {name: getattr(shaking, name) for name in ("amplitude", "frequency_ratio")}
            shaking = replace(self.motion, phase=shaking.phase, **ratios)
        start = self.start
        if isinstance(start, Steady):
            start = replace(start, kick=given["kick"])
        elif "angle" in given:
            start = State(angle=given["angle"], velocity=given["velocity"])
            refuse_behind_wall(block, start.angle, start.velocity)
        return block, shaking, start

    def check(self, values: Mapping[str, Floats]) -> None:
        """Refuse values of the axes before anything is computed.

        Every limit rises or falls with each of the parameters alone, so that all cells are within
        it where those at the corners of the grid are.

        Raises
        ------
        InputError
            The one that block, shaking or start give.
        """
        if isinstance(self.start, Steady):
            order_of_orbit(self.start.order)
        ends = ((points.min().item(), points.max().item()) for points in values.values())
        for corner in product(*ends):
            self.at(dict(zip(values, corner, strict=True)))

    def cells(self, coordinates: Mapping[str, Floats]) -> Cells:
        """Return many cells as arrays; each to the last bit as from `at`.

        A loop over `at` in Python would hold up the other threads.

        Parameters
        ----------
        coordinates
            Values of the axes, within their ranges, shape (cells,) each.
        """
        count = len(coordinates[self.axes[0]])
        given: dict[str, float | Floats] = {**self.kept, **coordinates}
        if isinstance(self.block, Block):
            felt = measures_of(self.block, self.sizes, given, housner=self.housner)
            if "acceleration_m_s2" in given:
                given["amplitude"] = np.abs(given["acceleration_m_s2"]) / felt.uplift
            if "frequency_hz" in given:
                given["frequency_ratio"] = 2.0 * math.pi * given["frequency_hz"] / felt.p
            if self.sizes:
                given.setdefault("restitution", felt.restitution)
                given.setdefault("alpha", felt.alpha)
            if self.floor is not None:
                ratio = given["frequency_ratio"]
                given["amplitude"], lead = self._felt(given["amplitude"], ratio, felt.p)
                given["phase"] = given.get("phase", 0.0) + lead
        full = {name: np.full(count, value) for name, value in given.items()}
        sides = self._sides(full, count)
        shaken = full["amplitude"], full["frequency_ratio"], sides
        upright = np.zeros(count)
        exists = np.ones(count, dtype=np.bool_)
        if isinstance(self.start, Steady):
            angle = upright
            velocity, phase, exists = on_orbits(self.start, full["kick"], *shaken)
        else:
            angle, velocity = full.get("angle", upright), full.get("velocity", upright)
            phase = full["phase"]
        return Cells(
            amplitude=full["amplitude"],
            frequency_ratio=full["frequency_ratio"],
            sides=sides,
            angle=angle,
            velocity=velocity,
            phase=phase,
            there=exists,
        )

    def _felt(
        self, amplitude: float | Floats, ratio: float | Floats, p: float | Floats
    ) -> tuple[Floats, Floats]:
        """Return the amplitude on the floor, and by how much its phase is ahead."""
        assert self.floor is not None
        hertz = ratio * p / (2.0 * math.pi)
        return amplitude * self.floor.amplification(hertz), self.floor.phase_lead(hertz)

    def _sides(self, given: Mapping[str, Floats], count: int) -> Floats:
        """Return the sides of the blocks of many cells."""
        rows = self.model.sides(self.block)
        sides = np.empty((count, *rows.shape))
        sides[:] = rows
        if "restitution" in given and self.block.one_sided:
            sides[:, 0, RESTITUTION] = -given["restitution"]
        elif "restitution" in given:
            sides[:, :, RESTITUTION] = given["restitution"][:, np.newaxis]
        for name, column in zip(ASYMMETRY, (RESTITUTION, LEAN, RATE), strict=True):
            if name in given:
                sides[:, 1, column] = given[name]
        if is_nonlinear(rows) and "alpha" in given:
            sides[:, :, ALPHA] = given["alpha"][:, np.newaxis]
        return sides

    def _check_restitution(self) -> None:
        if self.housner is None:
            return
        if not (self.block.symmetric or self.block.one_sided):
            raise ModelError(
                "axes",
                Words("hold restitution='housner'"),
                "it moves with the slenderness of symmetric blocks, and the sides of this "
                "one differ",
                "leave it out: Block.asymmetric takes the restitutions of its shape",
            )
        if not isinstance(self.block, Block):
            raise ModelError(
                "axes",
                Words("hold restitution='housner'"),
                "a block of which only the restitution is known has no slenderness",
                "give a Block, as Block.rectangle(width=..., height=...)",
            )

    def _check_motion(self) -> None:
        given = set(self.given)
        if self.motion is None and not (given & AMPLITUDES and given & FREQUENCIES):
            raise InputError(
                "motion",
                None,
                "it may be left out only where its amplitude and its frequency are given",
                "give a Harmonic(amplitude=..., frequency_ratio=...)",
            )

    def _check_start(self) -> None:
        if isinstance(self.start, Steady) and isinstance(self.motion, FourierSeries):
            raise ModelError(
                "start",
                self.start,
                "steady states in closed form are those of a single sinusoid",
                "start from Rest() or a State",
            )
        if isinstance(self.start, ImpactState):
            raise ModelError(
                "start",
                self.start,
                "its phase and velocity belong to one cell of a map",
                "start from Rest(), a State or a Steady",
            )
        if isinstance(self.start, State) and self.start.phase is not None:
            raise ModelError(
                "start",
                self.start,
                "the phase of a map is that of its motion, or an axis",
                'leave phase out of the State, or give axes={"phase": ...}',
            )
        steady = isinstance(self.start, Steady)
        if steady:
            refuse_asymmetric(self.block, "start", "a steady state to start on")
        for name in self.given:
            if steady and name in ASYMMETRY:
                raise ModelError(
                    "axes",
                    name,
                    "a block whose sides differ has no symmetric steady state to start on",
                    "start from Rest() or a State, or leave it out",
                )
            if steady and (name == "phase" or name in STATE):
                raise ModelError(
                    "axes",
                    name,
                    "a steady state to start on decides on it",
                    "start from Rest() or a State, or leave it out",
                )
            if name == "kick" and not steady:
                raise ModelError(
                    "axes",
                    name,
                    "it is how far from a steady state the block is set off",
                    "give start=Steady(branch=..., order=...)",
                )
