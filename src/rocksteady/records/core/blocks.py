"""A file of text as tables: headers in forms that tables have, blocks one below the other."""

import re
from dataclasses import replace
from datetime import datetime
from itertools import pairwise
from typing import Final

from rocksteady.errors import RecordFileError
from rocksteady.records.core.header_statements import stated_count
from rocksteady.records.core.moments import moment
from rocksteady.records.core.numbers import numbers
from rocksteady.records.core.text import RecordText

_DATED: Final = re.compile(
    r"\s*\"?(?P<date>\d{4}-\d\d-\d\d[T ])?(?P<clock>\d\d:\d\d:\d\d(?:\.\d+)?)"
    r"(?:Z|[+-]\d\d:?\d\d)?\"?(?=[\s,;])"
)
_TIMESERIES: Final = re.compile(
    r"TIMESERIES (\S+), (\d+) samples, ([\d.]+ sps), ([^,]+), \w+, \w+, (.+)"
)
_OF_TIMESERIES: Final = r"channel: \1; samples: \2; sampling rate: \3; start time: \4; units: \5"
"""The header of EarthScope's lists of samples."""
_QUOTED: Final = re.compile(r"\"([+-]?\d*),(\d+(?:[eE][+-]?\d+)?)\"")
"""A decimal comma between quotes, which is no separator."""
_EQUAL: Final = re.compile(r"([:=]\s*)/([^/\s]+)(?:/\2)+\s*$")
_PER_CHANNEL: Final = re.compile(r",?\s*C1-C\d+(?=\s*[,(:])")
"""Values of several channels that are one, and the words that number the channels."""
_HEADER: Final = 200
_WORDS: Final = re.compile("[A-Za-z]{3}|/&")
"""What a line of words has, and no line of numbers."""


def plain(text: RecordText) -> tuple[RecordText, datetime | None]:
    """Return a file with lists of equal values as one, and dates as seconds; and its first date."""
    lines = [_PER_CHANNEL.sub("", _EQUAL.sub(r"\1\2", line)) for line in text.lines[:_HEADER]]
    lines = [_TIMESERIES.sub(_OF_TIMESERIES, line) for line in lines] + [*text.lines[_HEADER:]]
    lines = [_QUOTED.sub(r"\1.\2", line) if '"' in line else line for line in lines]
    text = replace(text, lines=tuple(lines))
    if 2 * text.by_layout(lambda line: _DATED.match(line) is not None).sum() < len(lines):
        return text, None
    dates = {at: match for at, line in enumerate(lines) if (match := _DATED.match(line))}
    times = {
        at: moment(f"{match['date'] or '2000-01-01 '}{match['clock']}")
        for at, match in dates.items()
    }
    first = next(iter(times.values()))
    for at, time in times.items():
        if time is not None and first is not None:
            seconds = f"{(time - first).total_seconds():.6f}"
            lines[at] = f"{seconds}{lines[at][dates[at].end() :]}"
    known = next(iter(dates.values()))["date"]
    return replace(text, lines=tuple(lines)), first if known else None


def numeric(line: str) -> bool:
    """Return whether a line holds numbers alone, whatever stands between them."""
    return numbers(re.sub(r"[,;]", " ", line)) is not None


def blocks(text: RecordText) -> list[RecordText]:
    """Return the tables of a file, each with the words above it; one where it is one table.

    Each of several must have as many samples as it, or the one before, states, for a line of words
    among samples may be one that is damaged.
    """
    of_words = {*text.by_layout(lambda line: _WORDS.search(line) is not None).nonzero()[0].tolist()}
    if not any(map(numeric, text.lines[: max(of_words, default=0) + 1])):
        return [text]
    held = [at for at, line in enumerate(text.lines) if line.strip(" \t,;")]
    starts = [at for before, at in pairwise(held) if at in of_words and before not in of_words]
    tables = []
    stated: tuple[int, int] | None = None
    for start, end in pairwise([0, *starts, len(text.lines)]):
        block = replace(text, lines=("",) * start + text.lines[start:end])
        rows = [text.lines[at] for at in held if start <= at < end and at not in of_words]
        try:
            words = [at for at in sorted(of_words) if start <= at < end]
            stated = stated_count(block, words) or stated
        except RecordFileError:
            return [text]
        count = sum(len(re.split(r"[\s,;]+", row.strip(" \t,;"))) for row in rows)
        if stated is None or stated[0] not in {len(rows), count}:
            return [text]
        tables.append(block)
    return tables
