"""Units of acceleration: the one table of what files and users may write.

One g is standard gravity and one gal 1 cm/s^2, both by definition.
"""

import re
from typing import Final

from rocksteady.errors import InputError
from rocksteady.model.block import STANDARD_GRAVITY

__all__ = ["COUNTS", "UNITS", "acceleration_unit", "in_m_s2"]

COUNTS: Final = "counts"
"""What a file holds whose numbers are an instrument's, with or without their scale."""

UNITS: Final = {
    "g": STANDARD_GRAVITY,
    "mg": 1.0e-3 * STANDARD_GRAVITY,
    "m/s^2": 1.0,
    "cm/s^2": 1.0e-2,
    "mm/s^2": 1.0e-3,
    "gal": 1.0e-2,
    "mgal": 1.0e-5,
    "in/s^2": 0.0254,
    "ft/s^2": 0.3048,
}
"""Units by name, each with its size in m/s^2."""

_LENGTHS: Final = {"m": "m", "cm": "cm", "mm": "mm", "in": "in", "inch": "in", "ft": "ft"}
_PER_SECOND_SQUARED: Final = re.compile(
    r"(?P<length>[a-z]+)[ ./*]*(?:s|sec|second)s?[ ]*"
    r"(?:\*\*|\^)?[ ]*(?P<power>-?2|[./*]?[ ]*(?:s|sec)|-?[ ]*squared)$"
)
_OTHERS: Final = {"gals": "gal", "milli-g": "mg", "mgals": "mgal", "g's": "g", "gn": "g", "g0": "g"}


def acceleration_unit(written: str) -> str | None:
    """Return the name of a unit of acceleration, however it is written, or None.

    Parameters
    ----------
    written
        As a file or a user has it: ``CM/S/S``, ``cm/sec2``, ``Gal``, ``m s-2``.

    Examples
    --------
    >>> [acceleration_unit(text) for text in ("G", "cm/sec/sec", "M/S**2", "m s-2", "km/h")]
    ['g', 'cm/s^2', 'm/s^2', 'm/s^2', None]
    """
    text = written.strip().strip("()[].").lower().replace("\N{SUPERSCRIPT TWO}", "2")
    text = _OTHERS.get(text, text)
    if text in UNITS:
        return text
    found = _PER_SECOND_SQUARED.fullmatch(text)
    if found is None or found["length"] not in _LENGTHS:
        return None
    return f"{_LENGTHS[found['length']]}/s^2"


def unit_named(units: object, name: str = "units") -> str:
    """Return the package's word for a unit of acceleration that a caller names.

    Raises
    ------
    InputError
        If it is none; the message calls it `name`.
    """
    found = acceleration_unit(units) if isinstance(units, str) else None
    if found is None:
        raise InputError(
            name=name,
            value=units,
            valid="it must be a unit of acceleration",
            hint=f"use one of {', '.join(UNITS)}",
        )
    return found


def in_m_s2(units: str) -> float:
    """Return the size of a unit of acceleration in m/s^2.

    Raises
    ------
    InputError
        If it is not a unit of acceleration.

    Examples
    --------
    >>> in_m_s2("g"), in_m_s2("cm/s/s")
    (9.80665, 0.01)
    """
    return UNITS[unit_named(units)]
