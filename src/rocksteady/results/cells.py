"""Cells of CSV files: texts that a spreadsheet would run as formulas, and their way back."""

import math
import re
from typing import Any

FORMULA = re.compile(r"\s*[=+\-@]|[\t\r]")
"""Beginning of a text that a spreadsheet runs."""


def written_cell(value: Any) -> Any:
    """Return a value as a cell; a text that would be run as a formula has an apostrophe before it.

    Numbers stay, as texts too, and so does a sign alone.

    Examples
    --------
    >>> [written_cell(each) for each in ("=1+1", "-1.5", "-", "-a.csv", -1.5)]
    ["'=1+1", '-1.5', '-', "'-a.csv", -1.5]
    """
    if not isinstance(value, str) or value[:1].isalnum():
        return value
    quoted = value.startswith("'") and FORMULA.match(value.lstrip("'")) is not None
    runs = FORMULA.match(value) is not None and value not in ("+", "-") and not _is_number(value)
    return f"'{value}" if runs or quoted else value


def read_cell(text: str) -> str:
    """Return the text that `written_cell` has made a cell of.

    Examples
    --------
    >>> [read_cell(each) for each in ("'=1+1", "-1.5", "'tis")]
    ['=1+1', '-1.5', "'tis"]
    """
    quoted = text.startswith("'") and FORMULA.match(text.lstrip("'")) is not None
    return text[1:] if quoted else text


def _is_number(text: str) -> bool:
    """Return whether a text is a number, without spaces around it."""
    try:
        return not text[:1].isspace() and not math.isnan(float(text))
    except ValueError:
        return False
