"""Tables of numbers in text files: column separators, column names, rows."""

import contextlib
import re
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import chain, compress, pairwise
from typing import Final

import numpy as np

from rocksteady.arrays import Floats, Integers
from rocksteady.records.core.column_names import column_name
from rocksteady.records.core.directions import together
from rocksteady.records.core.numbers import number, numbers
from rocksteady.records.core.text import CONTRADICTION, CORRECT, RecordText
from rocksteady.records.core.units import in_seconds, quantity_of

_COMMENT: Final = ("#", "%", "//")
"""What a comment between rows begins with; stars stand for a number that did not fit."""

_NO_ROW: Final = "it must be a row of numbers, as the ones around it"
_TAKE_OUT: Final = "correct the line"
_BLOCKS: Final = "below it numbers follow that may be another channel or quantity"
_APART: Final = "give each block as a file of its own"
_SEPARATORS: Final = frozenset(",;")
_SAMPLE: Final = 200
_DECIMAL_COMMA: Final = re.compile(r"[+-]?\d*,\d+(?:[eEdD][+-]?\d+)?|[+-]?\d+(?:[eEdD][+-]?\d+)?")
_LONGEST_HEADER: Final = 200
_LONGEST_NAME: Final = 40
_RULE: Final = re.compile(r"\W*|.{0,20}\(?\d*[fFeE]\d+\.\d+\)?\s*")
"""A line of dashes, or the format of the rows."""
_KEY: Final = re.compile(r"^[A-Za-z ]+:\s+")
_OF_SENTENCES: Final = {"history", "histories", "series", "corrected", "uncorrected"} | set(
    {"in", "of", "the", "and", "is", "are", "at", "for", "from", "de"}
)
_OF_WORDS: Final = re.compile(r"\s*(?![+-]?\.?\d)(?:.*[A-Za-z]{3}|/&)")
_MOST_BLOCKS: Final = 30
_SHORTEST: Final = 50
"""Blocks of a file, and rows of one, that are told from rows that are merely set apart."""
_HEADS: Final = re.compile(r"\s*(?:[#%/].*|[^\W\d_]{2}\S*[\s,]+\S*)[^\W\d_]")
"""What may head another block: a remark, or two words."""
_NEAR: Final = 3
"""Lines above the rows among which their names are looked for."""
_TRUE_SPACES: Final = re.compile(r"\t|\s{2,}")
_NO_VALUE: Final = re.compile(
    r"[+-]?(?:nan|inf(?:inity)?|null|none|n/?a|\*+|#\w+[!?/].*)", re.IGNORECASE
)
"""What programs write where a number is missing or did not fit."""
_NOT_INSIDE: Final = r"(?![^()\[\]]*[)\]])"
_BEFORE_UNIT: Final = re.compile(r"\s+(?=[(\[])")


@dataclass(frozen=True, kw_only=True, eq=False)
class Table:
    """Rows of numbers with what stands above them.

    Parameters
    ----------
    header
        Lines of words above the rows, without the marks of a comment.
    header_lines
        Index of each of them.
    names
        Fields of the last of them, where there are as many as columns.
    names_at
        Index of their line.
    values
        The numbers, row after row, shape (numbers,).
    widths
        How many of them each row has, shape (rows,).
    lines
        Index of the line of each row, shape (rows,).
    separator
        What stands between two numbers; None for blanks.
    comma
        Whether a comma stands for the decimal point.
    trailing
        Index of the first line of words below the last row, or None.
    """

    header: tuple[str, ...]
    header_lines: tuple[int, ...]
    names: tuple[str, ...]
    names_at: int
    values: Floats
    widths: Integers
    lines: Integers
    separator: str | None
    comma: bool
    trailing: int | None = None

    @cached_property
    def columns(self) -> int:
        """Numbers of the widest row."""
        return int(self.widths.max())

    def column(self, at: int) -> Floats:
        """Return the numbers of a column, from the rows that have it."""
        starts = self.widths.cumsum() - self.widths
        return self.values[starts[self.widths > at] + at]

    def below(self, count: int) -> "Table":
        """Return the table without its first rows."""
        values, widths = self.values[self.widths[:count].sum() :], self.widths[count:]
        return replace(self, values=values, widths=widths, lines=self.lines[count:])


def table(text: RecordText) -> Table | None:
    """Return the table of a file, or None where it has no line of numbers.

    Raises
    ------
    RecordFileError
        If anything but numbers stands below the first line of numbers.
    """
    # A line of separators alone is a blank one of a spreadsheet.
    filled: list[int] = text.by_layout(lambda line: len(line.strip(" \t,;"))).nonzero()[0].tolist()
    if not filled:
        return None
    separator, comma = _dialect(text, filled)
    beginning = (text.lines[at] for at in filled[:_LONGEST_HEADER])
    numeric = [bool(_row(line, separator, comma=comma)) for line in beginning]
    # One line of numbers may be words of a header, a date or a count; two are the table. A file of
    # one line is one too.
    first = next((place for place, pair in enumerate(pairwise(numeric)) if all(pair)), None)
    if first is None and numeric[-1] and len(numeric) == len(filled):
        first = len(numeric) - 1
    if first is None:
        return None
    _refuse_torn(text, filled[: first + 1], separator, comma=comma)
    if first:
        _refuse_spoilt(text, filled[first - 1], filled[first], separator, comma=comma)
    values, widths, lines, trailing = _rows(text, filled[first:], separator, comma=comma)
    header = tuple(text.heads[at].strip().lstrip("#%!*/ ") for at in filled[:first])
    named, names = _names(header, separator, int(widths.max()))
    above = _fields(header[named - 1], separator, len(names)) if named else ()
    if (
        len(above) == len(names)
        and all(map(_known, above))
        and any(" / " in (together(pair) or "") for pair in zip(above, names, strict=True))
    ):
        valid = "the line above names other directions"
        raise text.error(valid, CORRECT, at=filled[named], kind=CONTRADICTION)
    return Table(
        header=header,
        header_lines=tuple(filled[:first]),
        names=names,
        names_at=filled[named] if first else 0,
        values=values,
        widths=widths,
        lines=lines,
        separator=separator,
        comma=comma,
        trailing=trailing,
    )


def _rows(
    text: RecordText, filled: list[int], separator: str | None, *, comma: bool
) -> tuple[Floats, Integers, Integers, int | None]:
    """Return the numbers from the first row on, how many each row has, its line, and words below.

    Raises
    ------
    RecordFileError
        If another line stands among them, or blank lines part them into blocks of one length.
    """
    values, widths = _values(text, filled, separator, comma=comma)
    last = int(np.flatnonzero(widths)[-1])
    kept, rest = np.array(filled[: last + 1], dtype=np.int64), filled[last + 1 :]
    after = [at for at in rest if not text.lines[at].lstrip().startswith(_COMMENT)]
    alone = text.by_layout(lambda line: line.strip() in _SEPARATORS)[kept[0] : kept[-1]]
    odd = kept[widths[: last + 1] == 0].tolist()
    odd += [at for at in after[:1] if not _OF_WORDS.match(text.lines[at])]
    odd += (kept[0] + alone.nonzero()[0]).tolist()
    if odd:
        at = min(odd)
        header = at < kept[-1] and (
            _HEADS.match(text.lines[at]) or (at + 1 in odd and text.lines[at][:1].isalpha())
        )
        valid, hint = (_BLOCKS, _APART) if header else (_NO_ROW, _TAKE_OUT)
        raise text.error(valid, hint, at=at)
    starts = (np.flatnonzero(np.diff(kept) > 1) + 1).tolist()
    lengths = {end - start for start, end in pairwise([0, *starts, len(kept)])}
    if 0 < len(starts) < _MOST_BLOCKS and len(lengths) == 1 and min(lengths) >= _SHORTEST:
        raise text.error(_BLOCKS, _APART, at=int(kept[starts[0]]) - 1)
    return values, widths[: last + 1], kept, after[0] if after else None


def _values(
    text: RecordText, filled: list[int], separator: str | None, *, comma: bool
) -> tuple[Floats, Integers]:
    """Return the numbers of rows, and how many each line holds: 0 where it is no row.

    They are read at once, and line by line only where numbers run together or overflow.
    """
    row = partial(_row, separator=separator, comma=comma)
    widths = text.by_layout(lambda line: len(row(line)))[filled]
    lines = [text.lines[at] for at in filled]
    joined = (separator or " ").join(compress(lines, widths)).replace('"', "")
    joined = (joined.replace(",", ".") if comma else joined).replace("D", "E").replace("d", "e")
    with contextlib.suppress(ValueError):
        values = np.fromiter(map(float, filter(None, joined.split(separator))), np.float64)
        # No row of numbers below 1e300 has a sum that overflows.
        if len(values) == widths.sum() and np.abs(values).max() < 1.0e300:
            return values, widths
    rows = [row(line) for line in lines]
    return np.array([*chain.from_iterable(rows)]), np.array([*map(len, rows)], dtype=np.int64)


def _refuse_torn(
    text: RecordText, filled: list[int], separator: str | None, *, comma: bool
) -> None:
    """Raise where a row like those of the table stands above it, with words in between.

    Parameters
    ----------
    text
        The file.
    filled
        Index of each line that is not blank, down to the first row.
    separator, comma
        As in the table.
    """
    columns = len(_row(text.lines[filled[-1]], separator, comma=comma))
    for place, at in enumerate(filled[:-1]):
        if len(_row(text.lines[at], separator, comma=comma)) == columns:
            raise text.error(_NO_ROW, _TAKE_OUT, at=filled[place + 1])


def _refuse_spoilt(
    text: RecordText, at: int, first: int, separator: str | None, *, comma: bool
) -> None:
    """Raise where the line above the first row is a row itself, with something that is no number.

    Taken for names it would be a sample lost, and all others would come too early.
    """
    columns = len(_row(text.lines[first], separator, comma=comma))
    fields = [field.strip().strip('"') for field in text.heads[at].split(separator)]
    if len(fields) != columns:
        return
    begins = columns > 1 and number(fields[0].replace(",", ".") if comma else fields[0]) is not None
    if begins or any(_NO_VALUE.fullmatch(field) for field in fields):
        raise text.error(_NO_ROW, _TAKE_OUT, at=at)


def _dialect(text: RecordText, filled: list[int]) -> tuple[str | None, bool]:
    """Return the separator of columns, and whether a comma is the decimal point.

    They are recognised in the second half of the file, where no header stands.
    """
    sample = [text.lines[at].strip() for at in filled[len(filled) // 2 :][:_SAMPLE]]
    for separator in (";", "\t"):
        if _most(sample, separator):
            body = "".join(sample)
            return separator, "," in body and "." not in body
    if not _most(sample, ","):
        return None, False
    tokens = [line.split() for line in sample]
    decimal = all(_DECIMAL_COMMA.fullmatch(token) for line in tokens for token in line)
    if not decimal:
        return ",", False
    if all(len(line) == 1 for line in tokens):
        # 0,5: two columns, or one number? The names of two columns decide.
        above = [text.heads[at] for at in filled[:3]]
        named = any("," in line and re.search("[A-Za-z]", line) is not None for line in above)
        return ("," if named else None), not named
    return None, True


def _most(lines: list[str], separator: str) -> bool:
    """Return whether a separator stands in most lines."""
    return 2 * sum(separator in line for line in lines) > len(lines)


def _row(line: str, separator: str | None, *, comma: bool) -> list[float]:
    """Return the numbers of a line; none where it holds anything else."""
    if comma:
        line = line.replace(",", ".")
    if separator is None:
        return numbers(line) or []
    fields = [field.strip().strip('"') for field in line.split(separator)]
    while fields and not fields[-1]:  # a separator at the end of the line
        fields.pop()
    values = [number(field) for field in fields]
    kept = [value for value in values if value is not None]
    return kept if len(kept) == len(values) else []


def _names(
    header: tuple[str, ...], separator: str | None, columns: int
) -> tuple[int, tuple[str, ...]]:
    """Return the place of the columns' names in the header, and the names with their units.

    They are nothing where there are none. Below them may stand a rule, a format or their units.
    """
    if not header:
        return 0, ()
    place = len(header) - 1
    while place > 0 and len(header) - place <= _NEAR and _RULE.fullmatch(header[place]):
        place -= 1
    line = header[place]
    last = _fields(line, separator, columns)
    if place < len(header) - 1:
        last = _fields(_KEY.sub("", line).replace(";", " "), separator, columns)
        if not all(map(_known, last)):
            return len(header) - 1, ()
    elif separator is None:
        # A line such as "units: cm/s^2" or "acceleration time series in g" is not one of names.
        sentence = {field.lower() for field in last} & _OF_SENTENCES
        last = () if sentence or set(line) & set(":=") else last
    elif len(last) != columns:
        last = tuple(name for name in _fields(line, None, columns) if _known(name))
    if len(last) != columns:
        return len(header) - 1, ()
    above = _fields(header[place - 1], separator, columns) if place else ()
    if columns > 1 and len(above) == columns and all(map(_is_unit, last)):
        pairs = zip(above, last, strict=True)
        return place, tuple(f"{name} ({unit.strip('()[] ')})" for name, unit in pairs)
    return place, last


def _known(field: str) -> bool:
    """Return whether a name states what its column holds."""
    return column_name(field).kind != "unknown"


def _is_unit(field: str) -> bool:
    """Return whether a field below a name is its unit."""
    known = quantity_of(field) is not None or in_seconds(field) is not None
    return known or field.strip("()[] ") in {"", "-"}


def _fields(line: str, separator: str | None, columns: int) -> tuple[str, ...]:
    """Return the fields of a line of names."""
    if separator is not None:
        # A separator in brackets or quotes stands inside a name.
        apart_by = re.escape(separator) + _NOT_INSIDE
        fields = [field.strip().strip('"').strip() for field in re.split(apart_by, line)]
        while fields and not fields[-1]:
            fields.pop()
        return tuple(fields)
    if columns == 1:
        return (line.strip(),) if len(line) <= _LONGEST_NAME else ()
    # Names may hold blanks: first apart by wide ones, then with their units joined on.
    wide = tuple(part.strip() for part in _TRUE_SPACES.split(line) if part.strip())
    if len(wide) == columns:
        return wide
    for candidate in (_BEFORE_UNIT.sub("", line), line.replace(",", " ")):
        parts = tuple(candidate.split())
        if len(parts) == columns:
            return parts
    return ()
