"""Checks of samples against their header: count, layout, duration, time of the peak.

Every reader that takes samples from lines of text ends here, so that a cut, a surplus or a wrong
interval is found in all formats alike.
"""

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from rocksteady.arrays import Floats, Integers
from rocksteady.records.core.numbers import NUMBER, numbers, samples
from rocksteady.records.core.text import CONTRADICTION, CORRECT, RecordText

_LONGEST_WORD: Final = 40
_HINT: Final = "fetch the file again: it is cut or garbled"
_REGULAR: Final = 0.9
"""Part of the lines that share a layout where others are odd."""
_FEWEST: Final = 8
"""Lines or numbers that are needed to recognise a layout."""
_TOKEN: Final = re.compile(NUMBER)
_EXPONENT: Final = re.compile(r"[EeDd][+-]?(\d+)$")


@dataclass(frozen=True, kw_only=True)
class Lines:
    """Where the samples of one channel stand.

    Parameters
    ----------
    stated
        Index of the line of the header that states their number.
    start
        Index of their first line.
    end
        Index of the first line that has not been read.
    alone
        Whether nothing may follow them: the file has one channel.
    """

    stated: int
    start: int
    end: int
    alone: bool = True


def agreed(
    text: RecordText, values: Floats, count: int, lines: Lines
) -> tuple[Floats, tuple[str, ...]]:
    """Return as many samples as the header states, and a warning about all inconsistencies.

    Parameters
    ----------
    text
        The file.
    values
        What has been read, shape (samples,).
    count
        The header's number of samples.
    lines
        Where they stand.

    Raises
    ------
    RecordFileError
        If there are fewer, or the last number is cut.
    """
    if count < 2:
        valid = f"{count} samples are no record"
        raise text.error(valid, "see whether the file is whole", at=lines.stated)
    end = lines.end
    if len(values) < count:
        valid = f"{len(values)} samples are read so far, and line {lines.stated + 1} states {count}"
        if end < len(text.lines):
            words = text.heads[end].split()
            odd = next((word for word in words if numbers(word) is None), words[-1])
            valid = f"{odd[:_LONGEST_WORD]!r} is no number; {valid}"
        raise text.error(valid, _HINT, at=end)
    more, after = samples(text.lines, end)
    surplus = len(values) - count + len(more)
    doubts = []
    if surplus > count:
        valid = f"{count + surplus} samples follow, and it states {count}"
        raise text.error(valid, CORRECT, at=lines.stated, kind=CONTRADICTION)
    if surplus:
        rest = "one is" if surplus == 1 else f"{surplus} are"
        doubts.append(
            f"the file holds {count + surplus} samples, more than the {count} that its header "
            f"states: the last {rest} left out"
        )
    elif lines.alone and any(line.strip() for line in text.lines[end:]):
        doubts.append(f"what stands after the last sample, from line {end + 1}, is left out")
    return values[:count], (*doubts, *layout(text, range(lines.start, after), strict=True))


def timing(
    values: Floats,
    dt_s: float | None,
    *,
    duration: tuple[float, float] | None = None,
    peak_at: float | None = None,
) -> tuple[str, ...]:
    """Return a warning where duration or time of the peak do not fit the interval.

    Parameters
    ----------
    values
        The samples, shape (samples,).
    dt_s
        Interval between them [s].
    duration
        As the header states it, and half a unit of its last digit [s].
    peak_at
        Time of the largest absolute value after the first sample, by the header [s].
    """
    if dt_s is None or not dt_s > 0.0:
        return ()
    doubts = []
    if duration is not None:
        stated, place = duration
        lasts = (len(values) - 1) * dt_s
        # From the first sample to the last, or an interval more.
        if not -1.01 * place - 0.01 * dt_s <= stated - lasts <= 1.01 * (dt_s + place):
            doubts.append(
                f"its {len(values)} samples {dt_s:g} s apart last {lasts:.6g} s, and the header "
                f"states {stated:g} s: see whether the interval is right"
            )
    if peak_at is not None and peak_at >= 0.0:
        size = np.abs(values)
        near = round(min(peak_at / dt_s, 1e15))
        reach = 2 + near // 500
        if size[max(near - reach, 0) : near + reach + 1].max(initial=0.0) < 0.99 * size.max():
            doubts.append(
                f"its peak comes after {int(size.argmax()) * dt_s:.6g} s, and the header states "
                f"{peak_at:g} s: see whether the interval is right"
            )
    return tuple(doubts)


def layout(
    text: RecordText,
    lines: Sequence[int] | Integers,
    *,
    separator: str | None = None,
    comma: bool = False,
    strict: bool = False,
) -> tuple[str, ...]:
    """Return a warning about numbers whose layout differs from that of all others.

    Parameters
    ----------
    text
        The file.
    lines
        Index of each line of numbers; blank ones do not count.
    separator, comma
        What stands between two numbers, and whether a comma is the decimal point.
    strict
        Whether a last number of another form is refused where only the form is odd.

    Raises
    ------
    RecordFileError
        If the last number of the file is one of them: it is cut.

    Notes
    -----
    Where nearly all lines end their numbers in the same columns, the others must; else numbers must
    have as many decimals and digits of the exponent as those above and below them, if nearly all
    have.
    """
    layouts, of_lines = text.layouts
    kept = np.asarray(lines, dtype=np.int64)
    kept = kept[kept < len(text.lines)]
    kept = kept[text.by_layout(lambda line: len(line.strip()))[kept] > 0]
    if not len(kept):
        return ()
    # The last line is a layout of its own.
    ending = f"{text.lines[kept[-1]]}\n"
    order = [*(layouts[at] for at in of_lines[kept[:-1]].tolist()), ending]
    counts = Counter(order)
    rows = {line: _tokens(line, separator, comma=comma) for line in counts}
    odd = _misplaced(rows, counts)
    aligned = odd is not None
    if odd is None:
        odd = _misshapen(rows, counts)
    ends_here = not any(line.strip() for line in text.lines[kept[-1] + 1 :])
    last = rows[ending]
    written = last[-1][0] if last else ""
    # A number that is cut ends early; one that ends late may have a sign more than the others.
    late = aligned and last and last[-1][1] > rows[order[0]][-1][1]
    aligned = aligned and not late
    if ending in odd and ends_here and (aligned or (strict and not text.ended)):
        valid = f"the file ends inside its last number, {written!r}"
        raise text.error(valid, _HINT, at=int(kept[-1]))
    if odd:
        first, *more = (at for at, line in zip(kept, order, strict=True) if line in odd)
        others = f" and {len(more)} more lines are" if more else " is"
        return (f"line {first + 1}{others} not laid out as the others: a character may be lost",)
    if text.ended or not ends_here:
        return ()
    ends = [row[-1][0] for row in map(rows.__getitem__, order) if row]
    digits = {each: sum(map(str.isdigit, each)) for each in {*ends}}
    if len(ends) > _FEWEST and _shape(ends[-1]) < max(map(_shape, digits)):
        # Of uneven numbers the longest may be cut by as much as the last is shorter.
        return (f"the file may end inside its last number, {written!r}: its last line has no end",)
    if len(ends) > _FEWEST and digits[ends[-1]] < min(digits[each] for each in {*ends[:-1]}):
        return (f"the file may end inside its last number, {written!r}, which has few digits",)
    return ()


def _tokens(line: str, separator: str | None, *, comma: bool) -> list[tuple[str, int]]:
    """Return the numbers of a line as they are written, each with the column of its end."""
    if separator is not None:
        fields = [field.strip().strip('"') for field in line.split(separator)]
        while fields and not fields[-1]:
            fields.pop()
        return [(field.replace(",", ".") if comma else field, -1) for field in fields]
    if comma:
        line = line.replace(",", ".")
    return [(match[0], match.end()) for match in _TOKEN.finditer(line)]


def _misplaced(rows: dict[str, list[tuple[str, int]]], counts: Counter[str]) -> set[str] | None:
    """Return which layouts end their numbers elsewhere than the others; None where all do.

    Parameters
    ----------
    rows
        The numbers of each layout, the last line's at the end.
    counts
        Lines of each layout.
    """
    ends = {line: tuple(end for _, end in row) for line, row in rows.items()}
    *above, last = rows
    total = counts.total() - 1
    if total < _FEWEST or any(-1 in row for row in ends.values()):
        return None
    counted: Counter[tuple[int, ...]] = Counter()
    for line in above:
        counted[ends[line]] += counts[line]
    usual, share = counted.most_common(1)[0]
    # A row of one number decides nothing, nor do numbers of different length by chance.
    lengths = {len(token) for row in rows.values() for token, _ in row}
    if share < _REGULAR * total or (len(lengths) == 1 and len(usual) == 1):
        return None
    gaps = [
        min(_gaps(row)[column] for row in rows.values() if len(row) > column)
        for column in range(len(usual))
    ]
    plain = next(row for line, row in rows.items() if ends[line] == usual)
    odd = {line for line in above if ends[line] != usual and not _outgrown(rows[line], plain, gaps)}
    return odd if ends[last] == usual[: len(ends[last])] else odd | {last}


def _gaps(row: list[tuple[str, int]]) -> list[int]:
    """Return how many characters stand before each number of a row."""
    starts = (end - len(token) for token, end in row)
    return [
        start - before for start, before in zip(starts, [0, *(end for _, end in row)], strict=False)
    ]


def _outgrown(row: list[tuple[str, int]], usual: list[tuple[str, int]], gaps: list[int]) -> bool:
    """Return whether a row ends its numbers late for one that is longer than its column alone."""
    late = next(
        (at for at, pair in enumerate(zip(row, usual, strict=False)) if pair[0][1] != pair[1][1]),
        None,
    )
    alike = len(row) == len(usual) and all(
        _shape(token) == _shape(plain) for (token, _), (plain, _) in zip(row, usual, strict=False)
    )
    return (
        late is not None
        and alike
        and row[late][1] > usual[late][1]
        and _gaps(row)[late] == gaps[late]
    )


def _misshapen(rows: dict[str, list[tuple[str, int]]], counts: Counter[str]) -> set[str]:
    """Return which layouts have a number of other decimals than all others of its column."""
    shapes: dict[int, Counter[tuple[int, int]]] = {}
    of_rows = {line: [_shape(token) for token, _ in row] for line, row in rows.items()}
    for line, row in of_rows.items():
        for column, shape in enumerate(row):
            shapes.setdefault(column, Counter())[shape] += counts[line]
    usual = {}
    for column, counted in shapes.items():
        shape, share = counted.most_common(1)[0]
        total = sum(counted.values())
        if total > _FEWEST and total - share <= max(1, 0.005 * total):
            usual[column] = shape
    return {
        line
        for line, row in of_rows.items()
        if any(usual.get(column, shape) != shape for column, shape in enumerate(row))
    }


def _shape(token: str) -> tuple[int, int]:
    """Return the decimals of a number and the digits of its exponent; -1 without a point."""
    exponent = _EXPONENT.search(token)
    mantissa = token if exponent is None else token[: exponent.start()]
    decimals = len(mantissa) - mantissa.index(".") - 1 if "." in mantissa else -1
    return decimals, 0 if exponent is None else len(exponent[1])
