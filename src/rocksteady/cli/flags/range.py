"""Range of a diagram's parameter, and the fixed values of the others."""

from dataclasses import dataclass, replace

from rocksteady.cli.console.refusals import FlagError
from rocksteady.cli.flags.block_and_shaking import BlockFlags, ShakingFlags
from rocksteady.cli.flags.options import FLAG_OF_ARGUMENT
from rocksteady.dynamics.parameters import moved_to
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.motions.segments import Harmonic


@dataclass(frozen=True, kw_only=True)
class Range:
    """A parameter that moves, and what it moves between.

    Attributes
    ----------
    parameter
        "amplitude", "frequency_ratio" or "restitution".
    values
        Of the axis, in ascending order.
    body
        The block; its restitution counts where that is not the axis.
    amplitude, frequency_ratio
        Of the shaking; the one that is the axis has its first value.
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


def range_of(shaking: ShakingFlags, block: BlockFlags) -> Range:
    """Return the axis that the flags name.

    Raises
    ------
    InputError
        If a value is missing, given twice or outside its range, or there is not exactly one axis.
    """
    ratios_of_impact = block.restitutions
    if ratios_of_impact:
        block = replace(block, restitution=repr(ratios_of_impact[0]))
    body = block.described()
    amplitudes, ratios = shaking.of(body)
    axes = {"amplitude": amplitudes, "frequency_ratio": ratios}
    axes["restitution"] = ratios_of_impact or [body.dimensionless().restitution]
    for amplitude, ratio in ((min(amplitudes), min(ratios)), (max(amplitudes), max(ratios))):
        Harmonic(amplitude=amplitude, frequency_ratio=ratio)  # refuses what is outside its range
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
    if values[0] == values[-1]:
        raise FlagError(
            finding=f"{FLAG_OF_ARGUMENT[name]} is {values[0]:.12g} at both ends",
            valid="the ends of an axis must differ",
            hint="give a range, as 1.6:2.4:400",
        )
    return Range(
        parameter=name,
        values=tuple(values),
        body=body,
        amplitude=amplitudes[0],
        frequency_ratio=ratios[0],
    )
