"""The three parameters of a block under harmonic shaking, and how one of them is moved."""

from dataclasses import replace

from rocksteady.model.block import DimensionlessBlock
from rocksteady.model.motions import Harmonic

PARAMETERS = ("amplitude", "frequency_ratio", "restitution")
"""What orbits are followed in and motions are carried along."""


def moved_to(
    block: DimensionlessBlock, shaking: Harmonic, parameter: str, value: float
) -> tuple[DimensionlessBlock, Harmonic]:
    """Return block and shaking with one of the parameters at a value.

    Raises
    ------
    InputError
        If the value is outside the parameter's range.
    """
    if parameter == "restitution":
        return replace(block, restitution=value), shaking
    return block, replace(shaking, **{parameter: value})
