"""Words and thresholds of estimates that do not exist, or rest on too little.

Fits, posteriors and intervals of the package take their rules from here; the table in
``docs/decisions.md`` lists them.
"""

import math
from typing import Final

from rocksteady.results.numbers import number

NOT_IDENTIFIED: Final = "not identified"
"""Word in place of an estimate that the data do not determine."""
TOO_FEW: Final = "too few"
"""Word in place of an estimate or an interval of too small a sample."""
FEWEST_DRAWS: Final = 50.0
"""Effective draws of a posterior, below which no interval of it is stated."""
ENOUGH_DRAWS: Final = 100.0
"""Effective draws that a calibration goes on for, and below which no number is identified."""
FEWEST_RECORDS: Final = 11
"""Records below which a curve has no confidence band."""
FEW_RECORDS: Final = 22
"""Records below which a curve has a warning."""
FEWEST_GROUPS: Final = 2
"""Groups of tests below which a score has no interval."""
FEWEST_BOXES: Final = 20
"""Boxes on a boundary below which their mean entropy decides nothing."""
FEWEST_SIZES: Final = 3
"""Points of a fitted line, below which it has no error, and so no slope is stated."""
MOST_MISFIT: Final = 0.1
"""Distance of a curve and a counted share, above which the first line of an answer states it."""


def misfit_words(misfit: float) -> str:
    """Return words on a curve that misses its counted shares; empty of a good one.

    Examples
    --------
    >>> misfit_words(0.26), misfit_words(0.05)
    ('poor fit: up to 26 points from the counted shares', '')
    """
    if not misfit > MOST_MISFIT:  # NaN of data without a curve
        return ""
    return f"poor fit: up to {number(100.0 * misfit, 2)} points from the counted shares"


def with_misfit(line: str, misfit: float) -> str:
    """Return the first line of an answer, with the misfit of a poor curve."""
    words = misfit_words(misfit)
    return f"{line}; {words}" if words else line


def marked(label: str, misfit: float) -> str:
    """Return a legend entry, which has little room, with the misfit of a poor curve."""
    return f"{label}, poor fit ({misfit:.2f})" if misfit > MOST_MISFIT else label


def counted_otherwise(probability: float, counted: float) -> bool:
    """Return whether a curve is too far from the share counted at a demand.

    Examples
    --------
    >>> counted_otherwise(0.70, 0.82), counted_otherwise(0.36, 0.32)
    (True, False)
    """
    return math.isfinite(counted) and abs(probability - counted) > MOST_MISFIT


def far_above(probability: float, counted: float) -> float:
    """Return a share counted at a demand where it is far above the curve, else the probability.

    Examples
    --------
    >>> far_above(0.04, 0.5), far_above(0.7, 0.5), far_above(0.36, 0.4)
    (0.5, 0.7, 0.36)
    """
    return max(probability, counted) if counted_otherwise(probability, counted) else probability
