"""Intensity measures of hazard curves and of fragilities: as texts, and as multiples."""

import math
from contextlib import suppress
from dataclasses import replace
from typing import Final

from rocksteady.errors import InputError
from rocksteady.kernels.elementary.arrays import tan
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.records.core.numbers import number as read_number
from rocksteady.seismic.measures.free_sides import first_side
from rocksteady.seismic.measures.scalar import Measure

GROUND: Final = {"pga_g": False, "pgv_m_s": False, "sa_g": True, "sa_avg_g": True}
"""What a hazard curve can be over, and whether it has a period."""
OF_A_BLOCK: Final = {"p_pgv_per_uplift": "pgv_m_s", "pga_per_uplift": "pga_g"}
"""Dimensionless measures, each with the measure of the ground that it is a multiple of."""

SAME_PERIOD: Final = 1e-6
"""Relative difference of two periods that are the same, written with fewer digits."""


def intensity_named(name: str, measure: object) -> Measure:
    """Return a measure from its text, as ``"pga_g"`` or ``"sa_g:1.0"``.

    Parameters
    ----------
    name
        The argument's name, for the message.
    measure
        The text, or a measure.

    Raises
    ------
    InputError
        If it is neither.
    """
    if isinstance(measure, Measure):
        return measure
    word, colon, period = measure.partition(":") if isinstance(measure, str) else ("", "", "")
    period_s = read_number(period) if colon else None
    try:
        intensity = Measure(word, period_s)
    except InputError as error:
        raise InputError(name, measure, error.valid, error.hint) from None
    if colon and period_s is None:
        hint = 'write a period in seconds, as "sa_g:1.0"'
        raise InputError(name, measure, "its period must be a number", hint)
    return intensity


def ground_measure(name: str, measure: object) -> Measure:
    """Return a measure of the ground alone, with its period where it needs one.

    Parameters and errors are those of `intensity_named`; what needs a block, or does not grow with
    the shaking, is refused too.
    """
    intensity = None
    with suppress(InputError):
        intensity = intensity_named(name, measure)
    fits = intensity is not None and GROUND.get(intensity.name) == (intensity.period_s is not None)
    if intensity is None or not fits or (intensity.period_s or 1.0) < 1e-6:
        names = ", ".join(f"{each}:PERIOD" if needs else each for each, needs in GROUND.items())
        raise InputError(
            name,
            written(measure) if isinstance(measure, Measure) else measure,
            f"a hazard curve is over one of {names}",
            'write a period in seconds, as "sa_g:1.0"',
        )
    return intensity


def written(measure: Measure) -> str:
    """Return the text of a measure, as ``sa_g:1.0``."""
    return measure.name if measure.period_s is None else f"{measure.name}:{measure.period_s!r}"


def fragility_factor(measure: Measure, hazard: Measure, block: Block | None) -> float:
    """Return what a hazard's intensity is multiplied by to be the fragility's.

    p PGV/(g tan alpha) of a PGV [m/s] is PGV times p/(g tan alpha), and PGA/(g tan alpha) of a PGA
    in units of 9.80665 m/s^2 is PGA times 9.80665/(g tan alpha), of the side that lifts first.

    Raises
    ------
    InputError
        If the two measures are of different things, or the block is missing.
    """
    if block is None and measure.needs_block:
        raise InputError(
            "block",
            block,
            f"a fragility over {measure.label} needs the block to meet a curve over {hazard.label}",
            "give block=",
        )
    if block is not None and measure.needs_block and GROUND.get(measure.name):
        measure = replace(measure, period_s=2.0 * math.pi / first_side(block).p)
    of_ground = OF_A_BLOCK.get(measure.name, measure.name)
    if of_ground != hazard.name or not _same(measure.period_s, hazard.period_s):
        raise InputError(
            "measure",
            written(measure),
            f"the hazard curve is over {hazard.label}, and the two cannot be converted",
            f"fit the fragility over {written(hazard)}, or give a hazard curve of the fragility's "
            "measure",
        )
    if measure.name == of_ground or block is None:
        return 1.0
    side = first_side(block)
    uplift = block.gravity * float(tan(side.alpha))
    return float(side.p / uplift if of_ground == "pgv_m_s" else STANDARD_GRAVITY / uplift)


def _same(one: float | None, other: float | None) -> bool:
    """Return whether two periods are the same, or both are none."""
    if one is None or other is None:
        return one is other
    return math.isclose(one, other, rel_tol=SAME_PERIOD)
