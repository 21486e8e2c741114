"""Lines of the first screen, which is at most eight of them.

One sentence with the number that matters, its doubt and its reason; up to six facts; the command
that goes on from here.  Tables, caveats and further facts of the result follow with ``--more``.
"""

import textwrap
from collections.abc import Sequence
from typing import Final

from rocksteady.results.description import Fact, line

SHORT: Final = 55
"""Letters of a doubt on a screen, which fit on one line beside its label."""


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
