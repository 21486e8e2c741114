"""Ranges of one parameter or of two, fixed values of the others, and harmonics of shaking."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from rocksteady.cli.console.refusals import FlagError
from rocksteady.cli.flags import options
from rocksteady.cli.flags.block_and_shaking import BlockFlags, ShakingFlags
from rocksteady.cli.flags.options import FLAG_OF_ARGUMENT
from rocksteady.cli.flags.parsing import number
from rocksteady.dynamics.parameters import moved_to
from rocksteady.errors import InputError
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.motions.fourier import FourierSeries, PeriodicMotion
from rocksteady.model.motions.segments import Harmonic

EXAMPLE = "give one as --harmonic 2,0.5,0"
ACROSS = ("restitution", "frequency_ratio", "amplitude")
"""Of two parameters the first is drawn to the right, the second upwards."""


@dataclass(frozen=True, kw_only=True)
class Range:
    """A parameter that moves, and what it moves between.

    Attributes
    ----------
    parameter
        "amplitude", "frequency_ratio" or "restitution".
    values
        Values of the axis, in ascending order.
    body
        The block; its restitution counts where that is not the axis.
    amplitude, frequency_ratio
        Parameters of the shaking; the one on the axis has its first value.
    """

    parameter: str
    values: tuple[float, ...]
    body: Block | DimensionlessBlock
    amplitude: float
    frequency_ratio: float

    @property
    def motion(self) -> Harmonic:
        """The shaking at the first value."""
        return Harmonic(amplitude=self.amplitude, frequency_ratio=self.frequency_ratio)

    def at(self, value: float) -> tuple[Block | DimensionlessBlock, Harmonic]:
        """Return block and shaking at a value of the axis."""
        return moved_to(self.body, self.motion, self.parameter, value)


def _axes_of(
    shaking: ShakingFlags, block: BlockFlags
) -> tuple[Block | DimensionlessBlock, dict[str, list[float]]]:
    """Return the block, and the values of each parameter that may be an axis.

    Raises
    ------
    InputError
        If a value is missing, given twice or outside its range.
    """
    restitutions = block.restitutions
    if restitutions:
        block = replace(block, restitution=repr(restitutions[0]))
    body = block.described()
    amplitudes, ratios = shaking.of(body)
    for pick in (min, max):  # refuses what is outside its range
        Harmonic(amplitude=pick(amplitudes), frequency_ratio=pick(ratios))
    return body, {
        "amplitude": amplitudes,
        "frequency_ratio": ratios,
        "restitution": restitutions or [body.dimensionless().restitution],
    }


def refuse_flat(name: str, values: Sequence[float], example: str) -> None:
    """Refuse an axis whose ends are one value.

    Raises
    ------
    FlagError
        If they are.
    """
    if values[0] == values[-1]:
        raise FlagError(
            finding=f"{FLAG_OF_ARGUMENT[name]} is {values[0]:.12g} at both ends",
            valid="the ends of an axis must differ",
            hint=f"give a range, as {example}",
        )


def range_of(shaking: ShakingFlags, block: BlockFlags) -> Range:
    """Return the axis that the flags name.

    Raises
    ------
    InputError
        If a value is missing, given twice or outside its range, or there is not exactly one axis.
    """
    body, axes = _axes_of(shaking, block)
    moving = [name for name, values in axes.items() if len(values) > 1]
    if len(moving) != 1:
        raise FlagError(
            finding=f"{len(moving)} of -A, -W and -r are axes"
            if moving
            else "none of -A, -W and -r is an axis",
            valid="exactly one of them is an axis",
            hint="give one as start:stop:count, as -W 1.6:2.4:400, and the others as numbers",
        )
    (name,) = moving
    values = sorted(axes[name])
    refuse_flat(name, values, "1.6:2.4:400")
    return Range(
        parameter=name,
        values=tuple(values),
        body=body,
        amplitude=axes["amplitude"][0],
        frequency_ratio=axes["frequency_ratio"][0],
    )


@dataclass(frozen=True, kw_only=True)
class Plane:
    """Two parameters that move, and what they move between.

    Attributes
    ----------
    parameters
        Their names, the one drawn to the right first.
    within
        The range of each.
    lines
        Number of values of each axis.
    body, motion
        Block and shaking at the first values.
    """

    parameters: tuple[str, str]
    within: tuple[tuple[float, float], tuple[float, float]]
    lines: tuple[int, int]
    body: Block | DimensionlessBlock
    motion: Harmonic


def plane_of(shaking: ShakingFlags, block: BlockFlags) -> Plane:
    """Return the plane that the flags name.

    Raises
    ------
    InputError
        If a value is missing, given twice or outside its range, or there are not exactly two axes.
    """
    body, axes = _axes_of(shaking, block)
    moving = [name for name in ACROSS if len(axes[name]) > 1]
    if len(moving) != 2:
        count = {0: "none", 1: "one", 3: "all three"}[len(moving)]
        raise FlagError(
            finding=f"{count} of -A, -W and -r {'are axes' if len(moving) == 3 else 'is an axis'}",
            valid="exactly two of them are axes",
            hint="give two as start:stop:count, as -W 3:8:3 -A 0.5:6:3, and the third as a number",
        )
    for name in moving:
        refuse_flat(name, axes[name], "3:8:3")
    motion = Harmonic(amplitude=axes["amplitude"][0], frequency_ratio=axes["frequency_ratio"][0])
    first, second = moving
    return Plane(
        parameters=(first, second),
        within=(
            (min(axes[first]), max(axes[first])),
            (min(axes[second]), max(axes[second])),
        ),
        lines=(len(axes[first]), len(axes[second])),
        body=body,
        motion=motion,
    )


@dataclass(frozen=True, kw_only=True)
class SeriesFlags:
    """The harmonics of periodic shaking that is no single sinusoid."""

    harmonic: list[str] | None = options.motion_flag(
        "--harmonic K,SIZE,PHASE",
        "Add a harmonic of periodic shaking: order K, size relative to -A, phase \\[rad]; may "
        "be repeated. -W is then that of the period. Default: a single sinusoid.",
    )

    @property
    def given(self) -> bool:
        """Whether there is any."""
        return bool(self.harmonic)

    def of(self, scale: Harmonic) -> PeriodicMotion:
        """Return the series with the amplitude, frequency and phase of a sinusoid, or that itself.

        Raises
        ------
        InputError
            If a harmonic is no triple of numbers, or the series is not valid.
        """
        waves = tuple(_wave_of(text) for text in self.harmonic or ())
        if not waves:
            return scale
        try:
            return FourierSeries(
                amplitude=scale.amplitude,
                frequency_ratio=scale.frequency_ratio,
                harmonics=waves,
                phase=scale.phase,
            )
        except InputError as error:
            given = " ".join(self.harmonic or ())
            raise InputError("--harmonic", given, error.valid, EXAMPLE) from None


def _wave_of(text: str) -> tuple[int, float, float]:
    """Return order, size and phase of a harmonic.

    Raises
    ------
    InputError
        If it is no triple of numbers, the first of them whole.
    """
    parts = text.split(",")
    if len(parts) != 3:
        valid = "it must be three numbers: order, size, phase"
        raise InputError("--harmonic", text, valid, EXAMPLE)
    order, size, phase = (number("--harmonic", part) for part in parts)
    if not order.is_integer():
        raise InputError("--harmonic", text, "its order must be a whole number", EXAMPLE)
    return int(order), size, phase
