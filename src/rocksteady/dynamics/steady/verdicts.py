"""Words on the stability of periodic motions."""

import math
from collections.abc import Iterable

import numpy as np

NO_MULTIPLIERS = np.full(2, complex(math.nan, math.nan))
"""Multipliers of a motion that grazes: no derivative exists there."""
NO_MULTIPLIERS.flags.writeable = False
MULTIPLIERS = "multipliers of a period"
"""Label of the multipliers of a motion, in every table: those of one of its periods."""


def verdict(*, admissible: bool, neutral: bool | None, stable: bool | None) -> str:
    """Return the verdict on a solution in a word; a motion that grazes is neither."""
    if not admissible:
        return "inadmissible"
    if stable is None:
        return "grazes"
    if neutral:
        return "neutral"
    return "stable" if stable else "unstable"


def multipliers_value(multipliers: Iterable[complex]) -> list[complex] | None:
    """Return multipliers in plain values; None where the motion grazes."""
    pair = [complex(value) for value in multipliers]
    return None if math.isnan(pair[0].real) else pair


def multipliers_text(multipliers: Iterable[complex] | None) -> str:
    """Return a pair of multipliers as people write it; None and nan where the motion grazes.

    Examples
    --------
    >>> multipliers_text([0.5 + 0.25j, 0.5 - 0.25j]), multipliers_text([1.2e-7, 0.0])
    ('0.500 ± 0.250i', '1.2e-7, 0')
    >>> multipliers_text(None)
    'no derivative: grazes'
    """
    pair = multipliers_value(NO_MULTIPLIERS if multipliers is None else multipliers)
    if pair is None:
        return "no derivative: grazes"
    first, second = pair
    if first.imag != 0.0:
        return f"{first.real:.3f} ± {abs(first.imag):.3f}i"
    text = f"{first.real:.3g}, {second.real:.3g}"
    for sign in ("-", "+"):  # 1e-06 is 1e-6, and 1e+06 is 1e6
        text = text.replace(f"e{sign}0", f"e{sign}")
    return text.replace("e+", "e")
