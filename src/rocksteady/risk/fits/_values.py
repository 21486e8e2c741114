"""Checks of what curves are evaluated at, and plain values for their descriptions."""

import math

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.errors import InputError
from rocksteady.model.checks.bounds import Bounds
from rocksteady.results.description import Fact
from rocksteady.results.numbers import number, number_or_none, quantity
from rocksteady.results.words import Label

LOG_LIKELIHOOD = Label("log-likelihood")
MEDIAN = Label(plain=number_or_none)
MISFIT = Label("largest misfit of a stripe", plain=number_or_none)

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


def measure_fact(measure: tuple[str, str]) -> Fact:
    """Return the fact of name and unit of an intensity."""
    name, unit = measure
    return Fact("measure", name, "intensity", f"{name} [{unit}]" if unit else name)


def value_words(value: float, unit: str, band: tuple[float, float] | None) -> str:
    """Return a number with its unit and its band."""
    text = quantity(value, unit) if unit and not math.isnan(value) else number(value)
    return text if band is None else f"{text} ({number(band[0])} to {number(band[1])})"


def range_words(ends: tuple[float, float], unit: str) -> str:
    """Return a range with its unit."""
    return f"{number(ends[0])} to {value_words(ends[1], unit, None)}"
