"""A hazard file as lines and fields; errors name the file, the line and what stands there."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np

from rocksteady.errors import InputError, RecordFileError
from rocksteady.records.core.numbers import number as read_number
from rocksteady.records.core.text import as_text, file_bytes
from rocksteady.results.numbers import plural
from rocksteady.risk.hazard.hazard_curve import HIGHEST, LOWEST, HazardCurve

SEPARATORS: Final = (";", "\t", ",", None)
"""Between fields; None is blanks."""
_LONGEST: Final = 100_000
"""Characters of a line."""
_WHERE: Final = "give an OpenQuake hazard curve, or two columns of level and annual rate"


@dataclass(frozen=True, kw_only=True)
class HazardText:
    """The lines of a file that are not blank, each with its number.

    Parameters
    ----------
    path
        The file.
    lines
        Number, the first being 1, and text of each line.
    """

    path: Path
    lines: tuple[tuple[int, str], ...]

    def error(self, valid: str, hint: str = _WHERE, *, line: int | None = None) -> InputError:
        """Return the error about the file, or about the line of a number."""
        if line is not None:
            text = next(text for number, text in self.lines if number == line)
            shown = text if len(text) <= 40 else f"{text[:40]}..."
            valid = f"line {line}, {shown.strip()!r}: {valid}"
        return InputError("hazard", str(self.path), valid, hint)


def read_lines(path: Path) -> HazardText:
    """Return the lines of a file: any line ends, UTF-8 with or without its mark, UTF-16, Latin-1.

    Raises
    ------
    InputError
        If it is not there, empty, too large, not text, or cannot be read.
    """
    try:
        lines = as_text(path, file_bytes(path)).lines
    except RecordFileError as error:
        raise InputError("hazard", str(path), error.valid, _WHERE) from None
    if any(len(line) > _LONGEST for line in lines):
        raise InputError("hazard", str(path), "it has lines of 100,000 characters", _WHERE)
    filled = ((at, line) for at, line in enumerate(lines, 1) if line.strip(" \t,;"))
    return HazardText(path=path, lines=tuple(filled))


def fields_of(line: str, separator: str | None) -> list[str]:
    """Return the fields of a line without quotes; separators at its end are none."""
    fields = [field.strip().strip("\"'").strip() for field in line.split(separator)]
    while fields and not fields[-1]:
        fields.pop()
    return fields


def number_of(field: str, separator: str | None) -> float | None:
    """Return the number of a field, with a decimal comma where commas do not separate; or None."""
    return read_number(field if separator == "," else field.replace(",", "."))


def make_curve(
    text: HazardText,
    levels: Sequence[float],
    rates: Sequence[float],
    *,
    line: int | Sequence[int],
    **known: object,
) -> HazardCurve:
    """Return a curve without levels of infinite and of no rate, with a remark on them.

    Parameters
    ----------
    text
        The file.
    levels, rates
        As read, ascending; a rate may be infinite or 0.
    line
        The line of the curve, or of each of its points.
    known
        All else that the curve is made with.

    Raises
    ------
    InputError
        If levels do not rise, rates do, or fewer than two levels have a rate.
    """
    lines = [line] * len(levels) if isinstance(line, int) else list(line)
    x, y = np.array(levels), np.array(rates)
    for at in range(1, len(x)):
        if x[at] <= x[at - 1]:
            what = "is repeated" if x[at] == x[at - 1] else f"follows {x[at - 1]:g}"
            raise text.error(
                f"the level {x[at]:g} {what}, and levels must rise",
                "sort the levels, and give each once",
                line=lines[at],
            )
        if y[at] > y[at - 1]:
            raise text.error(
                f"the rate of {x[at]:g} is above that of {x[at - 1]:g}, and rates of exceedance "
                "never rise",
                "see whether the columns are those of one hazard curve",
                line=lines[at],
            )
    remarks = []
    for gone, why in ((np.isinf(y), "a probability of 1, an infinite rate"), (y == 0.0, "no rate")):
        if gone.any():
            remarks.append(f"{plural(int(gone.sum()), 'level')} left out: {why}.")
    kept = np.isfinite(y) & (y > 0.0)
    if kept.sum() < 2:
        raise text.error(
            "fewer than two levels have a rate that is neither 0 nor infinite",
            "give a curve with two such levels or more",
            line=lines[0],
        )
    for values, what in ((x[kept], "level"), (y[kept], "rate")):
        if not ((values >= LOWEST) & (values <= HIGHEST)).all():
            raise text.error(
                f"a {what} is not in [{LOWEST:g}, {HIGHEST:g}]",
                "leave out what is no level of shaking",
                line=lines[0],
            )
    return HazardCurve(levels=x[kept], rates=y[kept], remarks=tuple(remarks), **known)  # type: ignore[arg-type]
