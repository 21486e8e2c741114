"""Intensity measures of hazard curves and of fragilities: names, words, units, factors."""

import math
from typing import Final

from rocksteady.errors import InputError
from rocksteady.kernels.elementary.arrays import tan
from rocksteady.model.blocks.block import STANDARD_GRAVITY, Block
from rocksteady.records.core.numbers import number as read_number

GROUND: Final = {
    "pga_g": ("PGA", "g"),
    "pgv_m_s": ("PGV", "m/s"),
    "sa_g": ("Sa", "g"),
    "sa_avg_g": ("Sa_avg", "g"),
}
"""Words and unit of what a hazard curve can be of."""
OF_A_BLOCK: Final = {"p_pgv_per_uplift": "pgv_m_s", "pga_per_uplift": "pga_g"}
"""Dimensionless measures, each with the measure of the ground that it is a multiple of."""

SAME_PERIOD: Final = 1e-6
"""Relative difference of two periods that are the same, written with fewer digits."""


def split_measure(name: str, measure: object, *, block: bool = False) -> tuple[str, float | None]:
    """Return a measure's name and its period [s], which a spectral acceleration has.

    Parameters
    ----------
    name
        The argument's name, for the message.
    measure
        As ``"pga_g"`` or ``"sa_g:1.0"``.
    block
        Whether the dimensionless measures of a block are valid too.

    Raises
    ------
    InputError
        If it is no such measure.
    """
    known = [*GROUND, *(OF_A_BLOCK if block else ())]
    word, colon, period = measure.partition(":") if isinstance(measure, str) else ("", "", "")
    period_s = read_number(period) if colon else None
    fits = word in known and bool(colon) == (word == "sa_g")
    if not fits or (colon and (period_s is None or not 1e-6 <= period_s <= 1e6)):
        names = ", ".join("sa_g:PERIOD" if each == "sa_g" else each for each in known)
        raise InputError(
            name, measure, f"it must be one of {names}", 'write a period in seconds, as "sa_g:1.0"'
        )
    return word, period_s


def measure_name(name: str, measure: object, *, block: bool = False) -> str:
    """Return a measure as it is written everywhere, as ``sa_g:1.0`` for ``sa_g:1``.

    Parameters and errors are those of `split_measure`.
    """
    word, period_s = split_measure(name, measure, block=block)
    return word if period_s is None else f"{word}:{period_s!r}"


def label(measure: str) -> str:
    """Return the words of a valid measure of the ground, as ``Sa(1.0 s)``."""
    word, period_s = split_measure("measure", measure)
    return GROUND[word][0] if period_s is None else f"{GROUND[word][0]}({period_s!r} s)"


def unit(measure: str) -> str:
    """Return the unit of a valid measure of the ground."""
    return GROUND[split_measure("measure", measure)[0]][1]


def fragility_factor(measure: str, hazard: str, block: Block | None) -> float:
    """Return what a hazard's intensity is multiplied by to be the fragility's.

    p PGV/(g tan alpha) of a PGV [m/s] is PGV times p/(g tan alpha), and PGA/(g tan alpha) of a PGA
    in units of 9.80665 m/s^2 is PGA times 9.80665/(g tan alpha), of the side that lifts first.

    Raises
    ------
    InputError
        If the two measures are of different things, or the block is missing.
    """
    word, period_s = split_measure("measure", measure, block=True)
    of_hazard, hazard_s = split_measure("measure", hazard)
    if OF_A_BLOCK.get(word, word) != of_hazard or not _same(period_s, hazard_s):
        raise InputError(
            "measure",
            measure,
            f"the hazard curve is over {label(hazard)}, and the two cannot be converted",
            f"fit the fragility over {hazard}, or give a hazard curve of the fragility's measure",
        )
    if word == of_hazard:
        return 1.0
    if block is None:
        raise InputError(
            "block",
            block,
            f"a fragility over {word} needs the block's slenderness to meet a curve of "
            f"{label(hazard)}",
            "give block=",
        )
    side = min((block.positive, block.negative), key=lambda each: each.alpha)
    uplift = block.gravity * float(tan(side.alpha))
    return float(side.p / uplift if of_hazard == "pgv_m_s" else STANDARD_GRAVITY / uplift)


def _same(one: float | None, other: float | None) -> bool:
    """Return whether two periods are the same, or both are none."""
    if one is None or other is None:
        return one is other
    return math.isclose(one, other, rel_tol=SAME_PERIOD)
