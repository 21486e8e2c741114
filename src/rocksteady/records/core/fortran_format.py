"""Fortran formats stated in files, and header values read with them."""

import re
from typing import Final

from rocksteady.records.core.numbers import number

_FORMAT: Final = re.compile(r"\(\s*(?:\d+\s*[pP]\s*,?)?\s*(\d*)\s*[iIfFeEgGdD]\s*(\d+)")


def stated_width(line: str) -> int | None:
    """Return the characters of one number by the format that a line states.

    Examples
    --------
    >>> stated_width("units=cm/sec2(04),Format=(8F10.5)"), stated_width("in cm/sec2.")
    (10, None)
    """
    match = _FORMAT.search(line)
    width = 0 if match is None else int(match[2])
    return width if 1 <= width <= 80 else None


def fixed_values(lines: tuple[str, ...], width: int) -> list[float | None]:
    """Return the numbers of lines of columns, None for each that is blank or no number.

    Parameters
    ----------
    lines
        Lines of a header.
    width
        Characters of one number.
    """
    values: list[float | None] = []
    for line in lines:
        text = line.rstrip()
        values += [number(text[at : at + width]) for at in range(0, len(text), width)]
    return values
