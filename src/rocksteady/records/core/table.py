"""Tables of numbers in text files: column separators, column names, rows."""

import re
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Final

from rocksteady.records.core.column_names import column_name
from rocksteady.records.core.directions import together
from rocksteady.records.core.numbers import apart, number, numbers
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


@dataclass(frozen=True, kw_only=True)
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
    rows
        The numbers of each line.
    lines
        Index of the line of each row.
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
    rows: tuple[tuple[float, ...], ...]
    lines: tuple[int, ...]
    separator: str | None
    comma: bool
    trailing: int | None = None

    @cached_property
    def columns(self) -> int:
        """Numbers of the widest row."""
        return max(map(len, self.rows))


def table(text: RecordText) -> Table | None:
    """Return the table of a file, or None where it has no line of numbers.

    Raises
    ------
    RecordFileError
        If anything but numbers stands below the first line of numbers.
    """
    # A line of separators alone is a blank one of a spreadsheet.
    filled = [at for at, line in enumerate(text.lines) if line.strip(" \t,;")]
    if not filled:
        return None
    separator, comma = _dialect(text, filled)
    rows_from = (_row(text.lines[at], separator, comma=comma) for at in filled[:_LONGEST_HEADER])
    numeric = [row is not None for row in rows_from]
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
    rows, lines, trailing = _rows(text, filled[first:], separator, comma=comma)
    header = tuple(text.heads[at].strip().lstrip("#%!*/ ") for at in filled[:first])
    named, names = _names(header, separator, max(map(len, rows)))
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
        rows=rows,
        lines=lines,
        separator=separator,
        comma=comma,
        trailing=trailing,
    )


def _rows(
    text: RecordText, filled: list[int], separator: str | None, *, comma: bool
) -> tuple[tuple[tuple[float, ...], ...], tuple[int, ...], int | None]:
    """Return the rows from the first one on, the index of each, and that of words below them.

    Raises
    ------
    RecordFileError
        If another line stands among them, or blank lines part them into blocks of one length.
    """
    parsed = [_row(text.lines[at], separator, comma=comma) for at in filled]
    last = max(place for place, row in enumerate(parsed) if row is not None)
    kept, rest = filled[: last + 1], filled[last + 1 :]
    rows = tuple(row for row in parsed if row is not None)
    after = [at for at in rest if not text.lines[at].lstrip().startswith(_COMMENT)]
    odd = [at for at, row in zip(kept, parsed, strict=False) if row is None]
    odd += [at for at in after[:1] if not _OF_WORDS.match(text.lines[at])]
    odd += [at for at in range(kept[0], kept[-1]) if text.lines[at].strip() in _SEPARATORS]
    if odd:
        at = min(odd)
        header = at < kept[-1] and (
            _HEADS.match(text.lines[at]) or (at + 1 in odd and text.lines[at][:1].isalpha())
        )
        valid, hint = (_BLOCKS, _APART) if header else (_NO_ROW, _TAKE_OUT)
        raise text.error(valid, hint, at=at)
    starts = [place for place in range(1, len(kept)) if kept[place] > kept[place - 1] + 1]
    lengths = {end - start for start, end in pairwise([0, *starts, len(kept)])}
    if 0 < len(starts) < _MOST_BLOCKS and len(lengths) == 1 and min(lengths) >= _SHORTEST:
        raise text.error(_BLOCKS, _APART, at=kept[starts[0]] - 1)
    return rows, tuple(kept), after[0] if after else None


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
    columns = len(_row(text.lines[filled[-1]], separator, comma=comma) or ())
    for place, at in enumerate(filled[:-1]):
        if len(_row(text.lines[at], separator, comma=comma) or ()) == columns:
            raise text.error(_NO_ROW, _TAKE_OUT, at=filled[place + 1])


def _refuse_spoilt(
    text: RecordText, at: int, first: int, separator: str | None, *, comma: bool
) -> None:
    """Raise where the line above the first row is a row itself, with something that is no number.

    Taken for names it would be a sample lost, and all others would come too early.
    """
    columns = len(_row(text.lines[first], separator, comma=comma) or ())
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


def _row(line: str, separator: str | None, *, comma: bool) -> tuple[float, ...] | None:
    """Return the numbers of a line, or None where it holds anything else."""
    if comma:
        line = line.replace(",", ".")
    if separator is None:
        row = numbers(line)
        return tuple(row) if row else None
    fields = line.split(separator)
    quickly = apart(fields, None)
    if quickly is not None:
        return tuple(quickly)
    fields = [field.strip().strip('"') for field in fields]
    while fields and not fields[-1]:  # a separator at the end of the line
        fields.pop()
    values = [number(field) for field in fields]
    kept = tuple(value for value in values if value is not None)
    return kept if kept and len(kept) == len(values) else None


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
