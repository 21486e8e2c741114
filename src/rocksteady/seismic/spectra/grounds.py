"""Ground motions and their levels, as the functions over suites take them."""

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.dynamics.arrays import real_array
from rocksteady.errors import InputError
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.validation import LARGEST, in_range
from rocksteady.model.equations import Model
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.record import Record
from rocksteady.seismic.spectra.batch import GroundShaking


def grounds_of(motions: Record | BaseMotion | Sequence[Record | BaseMotion]) -> list[GroundShaking]:
    """Return one or more ground motions.

    Raises
    ------
    InputError
        If they are no records.
    """
    given: object = motions
    several = [given] if is_single_motion(given) else given
    grounds: list[GroundShaking] = []
    for each in several if isinstance(several, list | tuple) else ():
        across, up = (
            (each.horizontal, each.vertical) if isinstance(each, BaseMotion) else (each, None)
        )
        if not isinstance(across, Record) or not isinstance(up, Record | None):
            grounds = []
            break
        grounds.append(GroundShaking(record=across, vertical=up))
    if not grounds:
        raise InputError(
            "motions",
            given,
            "it must be a record, a BaseMotion of records, or a list of them",
            "give records, as [read_record('example:near-fault')]",
        )
    return grounds


def is_single_motion(value: object) -> bool:
    """Return whether something is one motion, and no list of them."""
    return isinstance(value, Record | BaseMotion)


def is_single_number(value: object) -> bool:
    """Return whether something is one number, and no axis."""
    return np.ndim(value) == 0  # type: ignore[arg-type]


def turned_round(ground: GroundShaking) -> GroundShaking:
    """Return a ground with its horizontal component reversed."""
    return replace(ground, record=ground.record.reversed())


def names_of(records: Iterable[Record | None]) -> list[str]:
    """Return a name for each record, no two alike."""
    names: list[str] = []
    for number, record in enumerate((each for each in records if each is not None), start=1):
        name = record.name or f"record {number}"
        names.append(name if name not in names else f"{name} ({number})")
    return names


def axis_values(name: str, given: ArrayLike) -> list[float]:
    """Return the values of an axis, or the one of a number.

    Raises
    ------
    InputError
        If they are no numbers, or none, no list, or one occurs twice.
    """
    values = np.atleast_1d(real_array(name, given))
    if values.ndim > 1 or not values.size:
        raise InputError(
            name, given, "it must be a number or a list of numbers", "give one value or more"
        )
    if len(np.unique(values)) < len(values):
        raise InputError(name, given, "it may have each value once", "leave the repetition out")
    points: list[float] = values.tolist()
    return points


def scale_values(given: ArrayLike) -> list[float]:
    """Return the values of `scales`.

    Raises
    ------
    InputError
        If one is not above 0, or too large.
    """
    hint = "give a factor, as 1.5; to reverse is another choice"
    return [
        in_range("scales", value, 1.0 / LARGEST, LARGEST, "[]", hint=hint)
        for value in axis_values("scales", given)
    ]


def extremes_of(blocks: Sequence[Block]) -> tuple[Block, Block]:
    """Return the blocks of the largest p and of the least uplift acceleration."""
    return (
        max(blocks, key=lambda block: block.p),
        min(blocks, key=lambda block: block.uplift_acceleration),
    )


def check_grounds(
    grounds: Sequence[GroundShaking],
    largest: Sequence[float],
    blocks: Sequence[Block],
    model: Model,
) -> None:
    """Refuse grounds that a block, or its equations of motion, cannot take.

    Parameters
    ----------
    grounds, largest
        The grounds, and the largest scale of each.
    blocks
        Those that need most of a ground, as `extremes_of` has them.
    model
        The equations.

    Raises
    ------
    InputError
        If a record has too long intervals or too large accelerations.
    ModelError
        If the linear model meets a vertical motion.
    """
    for ground, factor in zip(grounds, largest, strict=True):
        lifting = None if ground.vertical is None else ground.vertical.scaled(factor)
        for block in blocks:
            model.lower(block, ground.record.scaled(factor), lifting)
