"""Numbers in text files, including Fortran's: run together, or with D as exponent.

A value is taken by its own line, so that the line that is wrong can be named.
"""

import math
import re
from collections.abc import Sequence
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from rocksteady.arrays import Floats

NUMBER: Final = r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[EeDd][+-]?[0-9]+)?"
"""Pattern of a number."""

_LONGEST: Final = 60
"""Characters of the longest number: what is longer is none, and takes its time to be found so."""

_BLOCK: Final = 256
"""Lines that are read at once."""

_WHOLE: Final = re.compile(NUMBER)
_EXPONENTS: Final = str.maketrans("Dd", "EE")
# A sign that follows a digit or a point begins the next number: that of an exponent follows a
# letter.
_STUCK: Final = re.compile(r"(?<=[\d.])(?=[+-])")
# Where an exponent has three digits, Fortran leaves out its letter: 0.1234-105.
_WITHOUT_LETTER: Final = re.compile(r"((?:\d\.|\.\d)\d*)([+-]\d{3})(?![\d.])")


def number(text: str) -> float | None:
    """Return the number that a text is, or None.

    Examples
    --------
    >>> number(" .1234D-02"), number("1_0"), number("inf")
    (0.001234, None, None)
    """
    text = text.strip()
    if len(text) > _LONGEST or _WHOLE.fullmatch(text) is None:
        return None
    value = float(text.replace("D", "E").replace("d", "e"))
    return value if math.isfinite(value) else None


def numbers(line: str, width: int | None = None) -> list[float] | None:
    """Return the numbers of a line, or None where it holds anything else.

    Numbers that run together are separated at the sign of the second one. Two that run together
    without a sign need the width of a column, or are refused: where the first ends is a guess.

    Parameters
    ----------
    line
        The line.
    width
        Characters of one number, where the file states them.

    Examples
    --------
    >>> numbers(" 1.234-5.678"), numbers("1.0E-03-2.0D-03"), numbers("0.1234-105")
    ([1.234, -5.678], [0.001, -0.002], [1.234e-106])
    >>> numbers("12.3456712.34567"), numbers("12.3456712.34567", 8)
    (None, [12.34567, 12.34567])
    """
    plain = apart(line.split(), width)
    if plain is not None:
        return plain
    # Signs before widths: programs in C write what does not fit its column and push on the rest.
    signed = apart(_taken_apart(line).split(), width)
    if signed is not None or width is None:
        return signed
    text = line.rstrip()
    cut = [text[at : at + width] for at in range(0, len(text), width)]
    values = [number(piece) for piece in cut if piece.strip()]
    kept = [value for value in values if value is not None]
    return kept if len(kept) == len(values) else None


def samples(
    lines: Sequence[str], start: int, *, at_most: int | None = None, width: int | None = None
) -> tuple["Floats", int]:
    """Return the numbers of consecutive lines, up to the first line that holds anything else.

    Parameters
    ----------
    lines
        Lines of a file.
    start
        Index of the first one.
    at_most
        Number of values after which to stop, with their line; by default read on.
    width
        Characters of one number, where the file states them.

    Returns
    -------
    values
        Shape (samples,); more than `at_most` where the last line holds more.
    end
        Index of the first line that has not been read.

    Notes
    -----
    Of a line that ends in words, the numbers before them count where they are the last ones wanted.
    """
    import numpy as np

    values: list[float] = []
    end = start
    # Many lines at once where blanks or signs separate their numbers; else by line.
    while at_most is None or len(values) < at_most:
        block = lines[end : end + _BLOCK]
        if not block:
            break
        joined = " ".join(block)
        pieces = apart(joined.split(), width)
        if pieces is None:
            pieces = apart(_taken_apart(joined).split(), width)
        if pieces is None or (at_most is not None and len(values) + len(pieces) > at_most):
            break
        values += pieces
        end += len(block)
    while end < len(lines) and (at_most is None or len(values) < at_most):
        line = lines[end]
        row = numbers(line, width) if line and not line.isspace() else []
        if row is None:
            row = _leading(line, width)
            # Words after the last sample, on its own line, are no harm; after any other they are.
            if at_most is None or len(values) + len(row) < at_most:
                break
            row = row[: at_most - len(values)]
        values += row
        end += 1
    return np.array(values, dtype=np.float64), end


def _taken_apart(line: str) -> str:
    """Return a line with a blank before each sign that begins a number, and E in exponents."""
    return _STUCK.sub(" ", _WITHOUT_LETTER.sub(r"\1E\2", line)).translate(_EXPONENTS)


def _leading(line: str, width: int | None) -> list[float]:
    """Return the numbers that a line begins with."""
    values: list[float] = []
    for token in line.split():
        row = numbers(token, width)
        if row is None:
            break
        values += row
    return values


def apart(tokens: list[str], width: int | None) -> list[float] | None:
    """Return the numbers of tokens, as fast as Python can, or None where one is anything else.

    Parameters
    ----------
    tokens
        What stands between blanks or separators.
    width
        Characters of one number, where the file states them.
    """
    longest = max(map(len, tokens), default=0)
    if longest > _LONGEST:
        return None
    # A whole number longer than its column is two that run together.
    cut = width is not None and longest > width
    if cut and any(len(token) > (width or 0) and "." not in token for token in tokens):
        return None
    try:
        values = list(map(float, tokens))
    except ValueError:
        return None
    # What float takes and a file of numbers does not hold: 1_000, nan, inf, digits of other scripts
    joined = "".join(tokens)
    ok = "_" not in joined and joined.isascii() and math.isfinite(sum(values))
    return values if ok else None
