"""Conversion of command-line text to numbers and axes."""

import math
import re

from rocksteady.cli.console.refusals import FlagError, missing
from rocksteady.cli.flags.options import FLAG_OF_ARGUMENT
from rocksteady.errors import InputError
from rocksteady.model.blocks.housner_forms import (
    VALID_TEXT,
    Restitution,
    Restitutions,
    form_of_text,
)
from rocksteady.sweep.cases.spacing import in_equal_ratios

MOST_AXIS_POINTS = 1_000_000
UNITS = {
    "-m-s2": "m/s^2",
    "-rad-s": "rad/s",
    "-m-s": "m/s",
    "-rad": "radians",
    "-deg": "degrees",
    "-hz": "Hz",
    "-kg": "kilograms",
    "-g": "g",
    "-m": "metres",
    "-s": "seconds",
}
"""Units by the ends of flags, the longer ones first."""


def without_unit(flag: str) -> str:
    """Return the name of a flag without the unit at its end."""
    return next((flag.removesuffix(unit) for unit in UNITS if flag.endswith(unit)), flag)


def decimal(text: str) -> float:
    """Return the number that a text is; of Python's, only digits that everyone reads.

    Raises
    ------
    ValueError
        If the text is no number.
    """
    if not text.isascii() or "_" in text:
        raise ValueError(text)
    return float(text)


def number(flag: str, text: str) -> float:
    """Return the number that a flag was given.

    Raises
    ------
    InputError
        If the text is no number.
    """
    try:
        return decimal(text)
    except ValueError:
        raise no_number(flag, text) from None


def no_number(flag: str, text: str) -> InputError:
    """Return the error of a text that is no number, with the unit that the flag's name has."""
    unit = next((words for suffix, words in UNITS.items() if flag.endswith(suffix)), None)
    hint = f"give it in {unit}, without the unit, as 0.35" if unit else "write it as 2 or 0.35"
    return InputError(flag, text, "it must be a number", hint)


def axis(flag: str, text: str) -> list[float]:
    """Return the values of ``start:stop:count``, both ends included; ``log:`` before it spaces them
    logarithmically.  A single number is an axis of one.

    Raises
    ------
    InputError
        If the text is neither.
    """  # noqa: D205 -- one sentence
    parts = text.split(":")
    logarithmic = parts[0] == "log"
    ends = parts[1:] if logarithmic else parts
    if len(parts) == 1:
        return [number(flag, text)]
    hint = "write start:stop:count or log:start:stop:count, as 0.5:12:200"
    if len(ends) != 3 or not (ends[2].isascii() and ends[2].isdigit()):
        raise InputError(flag, text, "it must be a number or an axis", hint)
    start, stop = number(flag, ends[0]), number(flag, ends[1])
    count = int(ends[2].lstrip("0")[:9] or "0")  # nine digits are too many, as are any more
    if not (math.isfinite(start) and math.isfinite(stop)):
        raise InputError(flag, text, "the ends must be finite", hint)
    if not 2 <= count <= MOST_AXIS_POINTS:
        valid = f"an axis has from 2 to {MOST_AXIS_POINTS} points"
        raise InputError(flag, text, valid, hint)
    if logarithmic and not (start > 0.0 and stop > 0.0):
        valid = "the ends of a logarithmic axis must be above 0"
        raise InputError(flag, text, valid, hint)
    last = count - 1
    if logarithmic:
        quotient = stop / start
        if not 0.0 < quotient < math.inf:
            valid = "the ends of a logarithmic axis must not lie so far apart"
            raise InputError(flag, text, valid, hint)
        return in_equal_ratios(start, stop, count)
    return [start, *(start + (stop - start) * i / last for i in range(1, last)), stop]


def values_of(flag: str, text: str) -> list[float]:
    """Return the values of an axis, or those with commas between them.

    Raises
    ------
    InputError
        If one is no number.
    """
    if "," in text:
        return [number(flag, part) for part in text.split(",")]
    return axis(flag, text)


def restitution_from(
    text: str | None, *, default: Restitution | None, wall: bool = False
) -> Restitutions:
    """Return a restitution: numbers, a form of "housner", or the default where none was given.

    Parameters
    ----------
    text
        What was typed, if anything.
    default
        In its place; none where it is needed.
    wall
        Whether it is that of a wall, of which there is one.

    Raises
    ------
    InputError
        If it is missing and has no default, or is neither.
    """
    if text is None:
        if default is None:
            raise missing(
                "--restitution/-r",
                valid="without a block it is needed",
                hint="add -r 0.8, or describe a block to take Housner's value",
            )
        return default
    first, comma, second = text.partition(",")
    try:
        return (decimal(first), decimal(second)) if comma else decimal(text)
    except ValueError:
        form = form_of_text(text)
    if form is None:
        valid = VALID_TEXT.replace("],", "], two of them,")
        pair = " or -r 0.8,0.9"
        if wall:
            valid, pair = VALID_TEXT.replace("(0", "[0"), ""
        near = re.fullmatch(r"[hH][a-zA-Z]*[\s*]*([0-9]*\.?[0-9]+)", text)
        hint = f"write it as -r 'housner*{near[1]}'" if near else f"write it as -r 0.8{pair}"
        raise InputError("restitution", text, valid, hint)
    if default is None:
        raise InputError(
            "restitution",
            text,
            "Housner's value follows from a block's slenderness",
            f"describe a block, or give a number in {'[' if wall else '('}0, 1]",
        )
    return form


def single(flag: str, values: list[float]) -> float:
    """Return the one value of an axis of one.

    Raises
    ------
    FlagError
        If it is an axis of several.
    """
    if len(values) > 1:
        raise FlagError(
            finding=f"{FLAG_OF_ARGUMENT.get(flag, flag)} has {len(values)} values",
            valid="this command takes one value",
            hint="give a number, not an axis",
        )
    return values[0]
