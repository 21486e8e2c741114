"""Checks of what curves are evaluated at, and plain values for their descriptions."""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rocksteady.errors import InputError
from rocksteady.model.checks.bounds import Bounds
from rocksteady.results.numbers import number, quantity

Floats = NDArray[np.float64]

SHARE = Bounds(0.0, 1.0, "()", "give a share, as 0.5")


def intensities(given: ArrayLike) -> Floats:
    """Return intensities of 0 or above, infinite ones included."""
    at = np.asarray(given, dtype=np.float64)
    bad = ~(at >= 0.0)
    if bad.any():
        raise InputError(
            "intensity", float(at[bad].flat[0]), "it must be 0 or above", "give an intensity"
        )
    return at


def listed(pair: tuple[float, float] | None) -> list[float] | None:
    """Return a pair for JSON."""
    return None if pair is None else list(pair)


def value_words(value: float, unit: str, band: tuple[float, float] | None) -> str:
    """Return a number with its unit and its band."""
    text = quantity(value, unit) if unit and not math.isnan(value) else number(value)
    return text if band is None else f"{text} ({number(band[0])} to {number(band[1])})"


def range_words(ends: tuple[float, float], unit: str) -> str:
    """Return a range with its unit."""
    return f"{number(ends[0])} to {value_words(ends[1], unit, None)}"
