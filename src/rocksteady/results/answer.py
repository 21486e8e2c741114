"""Answer of a result: what a screen shows by default, in at most eight lines.

One sentence with the number that matters, its doubt and its reason; up to six facts; the command
that goes on from here.  Tables, caveats and further facts of the result follow with ``--more``.
"""

import textwrap
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Final

MOST_LINES: Final = 8
"""Lines of an answer, beside rows that are the answer."""
MOST_FACTS: Final = 6
"""Facts of an answer."""
MOST_ROWS: Final = 12
"""Rows of an answer that consists of rows."""
GIVEN: Final = "block"
"""Label of what was given, which is left out first where there are too many facts."""
SHORT: Final = 55
"""Letters of a doubt on a screen, which fit on one line beside its label."""


@dataclass(frozen=True)
class Answer:
    """Answer to the question of a command.

    Attributes
    ----------
    sentence
        The first line, which ``--quiet`` prints alone.
    facts
        Label and words of each fact, the most important first; words that are computed are a
        function, which is called where the answer is printed.
    rows
        Label and words of each row, the worst first, where the rows are the answer; other short
        tables are facts.
    follow_up
        A command that runs as it stands; empty where none follows.
    """

    sentence: str
    facts: Sequence[tuple[str, str | Callable[[], str]]] = ()
    rows: Sequence[tuple[str, str]] = ()
    follow_up: str = ""

    @property
    def stated(self) -> list[tuple[str, str]]:
        """Label and words of the facts that have words, six at most."""
        pairs = [
            (label, words if isinstance(words, str) else words()) for label, words in self.facts
        ]
        facts = [fact for fact in pairs if fact[1]]
        if len(facts) > MOST_FACTS:
            facts = [fact for fact in facts if fact[0] != GIVEN]
        return facts[:MOST_FACTS]


def left_out(count: int, kinds: str = "") -> tuple[str, str]:
    """Return the fact that counts the rows that an answer leaves to ``--more``, by their kinds.

    Examples
    --------
    >>> left_out(4, "1 red, 3 green"), left_out(0)
    (('not listed', '4 more with --more: 1 red, 3 green'), ('not listed', ''))
    """
    words = f"{count:,} more with --more" + (f": {kinds}" if kinds else "")
    return "not listed", words if count else ""


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


def aligned(table: Sequence[Sequence[str]]) -> list[tuple[str, str]]:
    """Return the cells of a table as rows of an answer, with columns that stand below each other.

    Parameters
    ----------
    table
        Rows of as many cells, the first of them the label; columns but it and the last are numbers.
    """
    widths = [max(map(len, column)) for column in zip(*table, strict=True)]
    return [
        (
            row[0],
            "  ".join(
                [
                    *(
                        cell.rjust(width)
                        for cell, width in zip(row[1:-1], widths[1:-1], strict=True)
                    ),
                    row[-1],
                ]
            ),
        )
        for row in table
    ]
