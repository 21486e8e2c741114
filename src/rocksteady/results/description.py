"""Content of a result: facts, tables and notes, from which every rendering is made."""

import math
import textwrap
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Final

from rocksteady.results.numbers import number, plural

if TYPE_CHECKING:
    import pandas as pd

MOST_ROWS = 24
"""Default largest number of rows of a table that a text or a page shows."""
MOST_FACTS = 6
"""Facts of the first screen."""
GIVEN = "block"
"""Label of what was given, which is left out first where there are too many facts."""
SHORT: Final = 55
"""Letters of a doubt on a screen, which fit on one line beside its label."""
MOST_ALARMS = 20
"""Rows of an alarm that are shown however few rows a table has."""


@dataclass(frozen=True)
class Fact:
    """One value of a result: its JSON key, and the words that people read.

    Attributes
    ----------
    key
        In the JSON object, as "overturn_time_s"; empty for what people alone read.
    value
        Plain: a number, text, bool, None, or a list or dict of these.
    label
        The words before it in a summary; empty for what JSON alone has.
    text
        The value as people read it, with its unit; by default three significant digits.  A function
        is called where the fact is printed.
    first
        Whether it stands on the first screen.
    """

    key: str
    value: object = field(default=None, hash=False)
    label: str = ""
    text: str | Callable[[], str] = ""
    first: bool = False

    @property
    def words(self) -> str:
        """The value as people read it; empty where neither a value nor words are known."""
        text = self.text if isinstance(self.text, str) else self.text()
        return text or ("" if self.value is None and not self.key else shown(self.value))


@dataclass(frozen=True)
class Column:
    """One column of a table: its key in each row, its heading, and how a value is written."""

    key: str
    heading: str
    text: Callable[[Any], str] | None = None
    left: bool = False

    def words(self, row: Mapping[str, object]) -> str:
        """Return the cell of a row as people read it."""
        value = row.get(self.key)
        return shown(value) if self.text in (None, number) else self.text(value)


@dataclass(frozen=True)
class Table:
    """Rows of one kind: all of their values for JSON and CSV, some columns for people.

    Attributes
    ----------
    key
        Key of the list of rows in the JSON object; empty for what people alone read.
    rows
        Each a mapping of plain values.
    columns
        Those that people read; none for JSON alone.
    title
        A line above it.
    most
        The most rows that people read: of more the worst ones, the worst first.
    severity
        Returns what is larger the worse a row is, never nan; by default the first rows are shown.
    kind
        Returns what a row counts as among those left out, as "red".
    alarm
        The kind of the worst rows: up to 20 of these are shown, whatever `most` is.
    """

    key: str
    rows: Sequence[Mapping[str, object]]
    columns: Sequence[Column] = ()
    title: str = ""
    most: int = MOST_ROWS
    severity: Callable[[Mapping[str, Any]], Any] | None = None
    kind: Callable[[Mapping[str, Any]], str] | None = None
    alarm: str = ""

    @property
    def shown(self) -> list[Mapping[str, object]]:
        """The rows that people read."""
        return self._parts[0]

    @property
    def remark(self) -> str:
        """How many rows are left out, of each kind; empty where none are."""
        left_out = self._parts[1]
        if not left_out:
            return ""
        counts = Counter(map(self.kind, left_out)) if self.kind else {}
        kinds = ", ".join(f"{count:,} {kind}" for kind, count in counts.items())
        rest = f"{plural(len(left_out), 'more row')} in the file and in JSON"
        return f"{rest}: {kinds}" if kinds else rest

    @property
    def _parts(self) -> tuple[list[Mapping[str, object]], list[Mapping[str, object]]]:
        """The rows that people read, and those left out; the worst first where some are."""
        rows, most = list(self.rows), self.most
        if self.alarm and self.kind:
            alarms = sum(self.kind(row) == self.alarm for row in rows)
            most = max(most, min(alarms, MOST_ALARMS))
        if len(rows) > most and self.severity:
            rows.sort(key=self.severity, reverse=True)
        return rows[:most], rows[most:]

    @property
    def header(self) -> list[str]:
        """The names of all values of a row."""
        return list(dict.fromkeys(key for row in self.rows for key in row))

    def records(self) -> Iterator[list[object]]:
        """Yield the values of each row in the order of `header`."""
        header = self.header
        for row in self.rows:
            yield [row.get(key) for key in header]


def line(label: str, text: str | Callable[[], str]) -> Fact:
    """Return a fact of the first screen, which people alone read."""
    return Fact("", label=label, text=text, first=True)


def left_out(count: int, kinds: str = "") -> Fact:
    """Return the fact that counts the rows that an answer leaves to ``--more``, by their kinds.

    Examples
    --------
    >>> left_out(4, "1 red, 3 green").words, left_out(0).words
    ('4 more with --more: 1 red, 3 green', '')
    """
    words = f"{count:,} more with --more" + (f": {kinds}" if kinds else "")
    return line("not listed", words if count else "")


def doubt(warnings: Sequence[str]) -> str:
    """Return the first warning, shortened to one line, and the number of others.

    Examples
    --------
    >>> doubt(["Two records are weak. Scale them.", "The motions are few."])
    'Two records are weak; 1 more with --more'
    >>> doubt(["Of 12 records the first 11 are far too weak to fell a block of this size at all."])
    'Of 12 records the first 11 are far too weak to fell ...'
    """
    more = f"; {len(warnings) - 1} more with --more" if len(warnings) > 1 else ""
    first = warnings[0].partition(". ")[0].rstrip(".") if warnings else ""
    return textwrap.shorten(first, SHORT - len(more), placeholder=" ...") + more


def aligned(table: Sequence[Sequence[str]]) -> list[Fact]:
    """Return the rows of a table as facts of the first screen, with aligned columns.

    Parameters
    ----------
    table
        Rows of as many cells, the first of them the label; columns but it and the last are numbers.
    """
    widths = [max(map(len, column)) for column in zip(*table, strict=True)]
    facts = []
    for label, *numbers, words in table:
        cells = [cell.rjust(width) for cell, width in zip(numbers, widths[1:-1], strict=True)]
        facts.append(line(label, "  ".join([*cells, words])))
    return facts


@dataclass(frozen=True)
class Description:
    """Description of a result.

    Attributes
    ----------
    headline
        One line: what it is and how it ended, for `repr`, titles and captions.
    facts, tables
        The content, in order; facts of the first screen with the most important first.
    notes
        Sentences at the end: what it means, and what to do next.
    sentence
        The answer, which begins the first screen and which ``--quiet`` prints alone; empty where
        the first screen is the whole description.
    rows
        Label and words of each row of the first screen, the worst first, where rows are the answer.
    follow_up
        A command that runs as it stands; empty where none follows.
    """

    headline: str
    facts: Sequence[Fact] = ()
    tables: Sequence[Table] = ()
    notes: Sequence[str] = ()
    sentence: str = ""
    rows: Sequence[tuple[str, str]] = ()
    follow_up: str = ""

    @property
    def screen(self) -> list[tuple[str, str]]:
        """Label and words of the facts of the first screen that have words, six at most."""
        pairs = [(fact.label, fact.words) for fact in self.facts if fact.first]
        facts = [pair for pair in pairs if pair[1]]
        if len(facts) > MOST_FACTS:
            facts = [pair for pair in facts if pair[0] != GIVEN]
        return facts[:MOST_FACTS]

    def to_dict(self) -> dict[str, Any]:
        """Return the JSON object, in plain values: all facts and rows that have a key."""
        values = {fact.key: fact.value for fact in self.facts if fact.key}
        tables = {table.key: [dict(row) for row in table.rows] for table in self.tables}
        result: dict[str, Any] = plain(values | {key: tables[key] for key in tables if key})
        return result

    def to_dataframe(self) -> "pd.DataFrame":
        """Return the rows of the first table; without a table one row, of the plain facts."""
        import pandas as pd

        if self.tables:
            table = self.tables[0]
        else:
            facts = {fact.key: fact.value for fact in self.facts if fact.key}
            several = (list, tuple, Mapping)
            row = {key: value for key, value in facts.items() if not isinstance(value, several)}
            table = Table("", [row])
        # Of numbers that do not exist pandas makes a column of numbers if they are nan.
        rows = [[math.nan if value is None else value for value in row] for row in table.records()]
        names = table.header or list(dict.fromkeys(column.key for column in table.columns))
        return pd.DataFrame(rows, columns=names)


def shown(value: object) -> str:
    """Return a plain value as people read it."""
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return "—"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return number(value)
    if isinstance(value, int):
        return f"{value:,}"
    if isinstance(value, list | tuple):
        return ", ".join(shown(each) for each in value)
    return str(value)


def plain(value: Any) -> Any:
    """Return a value that JSON can hold: a complex number as [re, im], nan and infinity as None."""
    if isinstance(value, Mapping):
        return {key: plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    if hasattr(value, "tolist"):
        return plain(value.tolist())
    if isinstance(value, complex):
        return [plain(value.real), plain(value.imag)]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value
