"""Renderings of a description: text for terminals, HTML for notebooks and reports."""

import re
import textwrap
import unicodedata
from collections.abc import Iterator, Sequence
from dataclasses import replace
from html import escape
from typing import TYPE_CHECKING, Literal

from rocksteady.results.description import Description, Table

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table as RichTable
    from rich.text import Text

WIDTH = 80
"""Columns of a summary."""
MOST_LINES = 8
"""Lines of the first screen, beside rows that are the answer."""
MOST_ROWS = 12
"""Rows of a first screen that consists of rows."""

ROLES = {
    "falls": r"^falls\b",
    "rest": r"^(comes to rest|never lifts)\b",
    "undecided": r"^undecided\b",
    "green": r"^green\b|(?<!not )\bsatisfied$",
    "amber": r"^amber\b",
    "red": r"^red\b|\bnot satisfied$",
}
"""Words that a console shows in the style of a role: outcomes, and verdicts against a target.

A console that has no styles of these names, as one of a notebook, leaves the words as they are.
"""

NEXT = "next:"
"""Label of the command that follows."""

PART = re.compile(r"""(?:\$'(?:\\.|[^'\\])*'|'[^']*'|"[^"]*"|.)+?(?= -(?!m )|$)""")
"""Words of a command up to its next flag, or to its end; what is in quotes is one."""

NARROW = 60
"""Columns of a terminal below which a label stands on a line of its own."""

LONG_COMMAND = 3
"""Lines of a command that stays beside facts without room."""

LONGEST = 40
"""Columns of a label; the middle of a longer one, as the name of an object, is left out."""

LEAST = 20
"""Columns of words beside a label, however narrow a console is."""

MANY = 7
"""Columns of a table from which on they stand closer together."""

STYLE = "border-collapse:collapse;font-variant-numeric:tabular-nums;margin:.4em 0"
CELL = "padding:.15em .8em .15em 0;text-align:{};vertical-align:top"


def printable(text: object, *, keep: str = "") -> str:
    r"""Return a text with its unprintable characters escaped, such as a line end in a name.

    Parameters
    ----------
    text
        Or what has one, as a path.
    keep
        Characters that are left as they are.

    Examples
    --------
    >>> print(printable("two\nlines and \u202eback"))
    two\nlines and \u202eback
    """
    return "".join(
        repr(letter)[1:-1] if _unprintable(letter) and letter not in keep else letter
        for letter in str(text)
    )


def print_answer(answer: Description, console: "Console") -> None:
    """Print the first screen: the sentence, rows and facts, and the command that follows.

    Facts are cut to what eight lines of 80 columns hold, whatever the console has; a long command
    makes way for them.  Below 60 columns a label stands on a line of its own.
    """
    from rich.cells import cell_len
    from rich.text import Text

    width = min(console.width, WIDTH)
    _say(console, answer.sentence, "sentence", width)
    rows = [(_cut(label), printable(words)) for label, words in answer.rows[:MOST_ROWS]]
    facts = [(_cut(label), printable(words)) for label, words in answer.screen]
    indent = max([15, *(cell_len(label) for label, _ in (*rows, *facts))]) + 4
    narrow = console.width < NARROW
    start = 4 if narrow else indent
    shown = list(_fitting(answer, facts, indent))
    if len(shown) < len(facts) and len(_command(answer, WIDTH).split("\n")) > LONG_COMMAND:
        answer = replace(answer, follow_up="")  # a caveat is worth more
        shown = list(_fitting(answer, facts, indent))
    for label, words in (*rows, *shown):
        lines = _filled(words, width - start, whole=True).split("\n")
        gap = "\n    " if narrow else " " * (indent - cell_len(label) - 2)
        console.print(_row("  ", label, gap, f"\n{'':{start}}".join(lines)))
    if answer.follow_up:
        command = Text.assemble((NEXT, "next"), f" {_command(answer, width)}")
        console.print(command, soft_wrap=True)  # a line end within quotes is one more character


def _fitting(
    answer: Description, facts: Sequence[tuple[str, str]], indent: int
) -> Iterator[tuple[str, str]]:
    """Yield the facts for which eight lines have room, the first of them first."""
    room = MOST_LINES - len(_filled(printable(answer.sentence), WIDTH).split("\n"))
    if answer.follow_up:
        room -= len(_command(answer, WIDTH).split("\n"))
    for label, words in facts:
        lines = len(_filled(words, WIDTH - indent, whole=True).split("\n"))
        if lines <= room:
            room -= lines
            yield label, words


def _command(answer: Description, width: int) -> str:
    """Return the command that follows, in lines."""
    return _continued(printable(answer.follow_up), width - len(f"{NEXT} "))


def _row(begins: str, label: str, gap: str, words: str) -> "Text":
    """Return a label with what it says, in the styles of their roles."""
    from rich.text import Text

    parts = Text(label), Text(words)
    for part in parts:
        for role, pattern in ROLES.items():
            part.highlight_regex(pattern, role)
    if not parts[0].spans:
        parts[0].stylize("label")
    return Text.assemble(begins, parts[0], gap, parts[1])


def _cut(label: str) -> str:
    """Return a label as it is printed, without the middle of a long one."""
    from rich.cells import cell_len, set_cell_size

    shown = printable(label)
    if cell_len(shown) <= LONGEST:
        return shown
    begin, end = (set_cell_size(each, LONGEST // 2 - 1) for each in (shown, shown[::-1]))
    return f"{begin.rstrip()}…{end[::-1].lstrip()}"


def _say(console: "Console", words: str, role: str, width: int, *, keep: str = "") -> None:
    """Print a text in lines, in the style of a role."""
    from rich.text import Text

    lines = [_filled(line, width) for line in printable(words, keep=keep).split("\n")]
    console.print(Text("\n".join(lines), style=role))


def _continued(command: str, width: int) -> str:
    """Return a command in lines that end in a backslash, broken before its flags.

    Within quotes a backslash would be one more character.
    """
    lines = [""]
    for part in map(str.lstrip, PART.findall(command)):
        if lines[-1] and len(lines[-1]) + len(part) + 3 > width:
            lines[-1] += " \\"
            lines.append(f"  {part}")
        else:
            lines[-1] += f" {part}" if lines[-1] else part
    return "\n".join(lines)


def print_description(description: Description, console: "Console") -> None:
    """Print what follows the first screen: further facts, tables, then notes, dimmed.

    Parameters
    ----------
    description
        What is printed.
    console
        Console of rich: of a terminal, or of a text in memory.
    """
    from rich.cells import cell_len
    from rich.text import Text

    width = min(console.width, WIDTH)
    _say(console, description.headline, "sentence", width)
    facts = [
        (_cut(fact.label), fact) for fact in description.facts if fact.label and not fact.first
    ]
    indent = max((cell_len(label) for label, _ in facts), default=0) + 2
    for label, fact in facts:
        # A path is one word, and stays whole to be copied.
        lines = _filled(printable(fact.words), width - indent, whole=True).split("\n")
        gap = " " * (indent - cell_len(label))
        console.print(_row("", label, gap, f"\n{'':{indent}}".join(lines)))
    for table in description.tables:
        if not (table.columns and table.rows):
            continue
        if table.title:
            console.print(printable(table.title))
        console.print(_rich(table))
        if table.remark:
            console.print(Text(printable(table.remark, keep="\n"), style="note"))
    for note in description.notes:
        _say(console, note, "note", width, keep="\n")


def _filled(text: str, width: int, *, whole: bool = False) -> str:
    """Return a text in lines; no break parts a number from its per cent sign, or a whole word."""
    tied = text.replace(" %", "\N{NO-BREAK SPACE}%")
    width = max(width, LEAST)
    lines = textwrap.fill(tied, width, break_long_words=not whole, break_on_hyphens=not whole)
    return lines.replace("\N{NO-BREAK SPACE}%", " %")


def as_text(description: Description, *, more: bool = True) -> str:
    """Return a description as plain text of 80 columns: its answer, then all of it with `more`."""
    import io

    from rich.console import Console

    stream = io.StringIO()
    # Rich writes to the page of a notebook, not to the file, and FORCE_COLOR adds codes.
    plain = Console(
        file=stream,
        width=WIDTH,
        force_jupyter=False,
        force_terminal=False,
        color_system=None,
        highlight=False,
        markup=False,
        emoji=False,
    )
    if description.sentence:
        print_answer(description, plain)
    if more or not description.sentence:
        print_description(description, plain)
    return "\n".join(line.rstrip() for line in stream.getvalue().splitlines())


def as_html(description: Description) -> str:
    """Return a description as HTML: the answer, the facts, the tables, the notes."""
    sentence = description.sentence or description.headline
    parts = [f'<div class="rocksteady"><strong>{_words(sentence)}</strong>']
    if sentence != description.headline:
        parts.append(f"<p>{_words(description.headline)}</p>")
    further = [
        (each.label, each.words) for each in description.facts if each.label and not each.first
    ]
    rows = [
        f"<tr>{_cell('th', label, 'left')}{_cell('td', words, 'left')}</tr>"
        for label, words in dict.fromkeys((*description.rows, *description.screen, *further))
    ]
    if rows:
        parts.append(f'<table style="{STYLE}">{"".join(rows)}</table>')
    parts += [_table(table) for table in description.tables if table.columns and table.rows]
    parts += [f"<p>{_words(note, keep=chr(10))}</p>" for note in description.notes]
    return "".join(parts) + "</div>"


def _table(table: Table) -> str:
    """Return a table as HTML."""
    sides = ["left" if column.left else "right" for column in table.columns]
    head = "".join(
        _cell("th", column.heading, side) for column, side in zip(table.columns, sides, strict=True)
    )
    body = "".join(
        "<tr>"
        + "".join(
            _cell("td", column.words(row), side)
            for column, side in zip(table.columns, sides, strict=True)
        )
        + "</tr>"
        for row in table.shown
    )
    caption = f"<caption>{_words(table.title)}</caption>" if table.title else ""
    remark = f"<p>{_words(table.remark)}</p>" if table.remark else ""
    return f'<table style="{STYLE}">{caption}<tr>{head}</tr>{body}</table>{remark}'


def _cell(tag: str, words: str, side: str) -> str:
    """Return a cell of a table."""
    return f'<{tag} style="{CELL.format(side)}">{_words(words)}</{tag}>'


def _words(text: str, *, keep: str = "") -> str:
    """Return a text for HTML, without its mark-up and its unprintable characters."""
    return escape(printable(text, keep=keep))


def _rich(table: Table) -> "RichTable":
    """Return a table for a console."""
    from rich.table import Table as RichTable

    gap = 2 if len(table.columns) < MANY else 1
    rich = RichTable(box=None, pad_edge=False, padding=(0, gap, 0, 0))
    for column in table.columns:
        side: Literal["left", "right"] = "left" if column.left else "right"
        # Where a table is too wide words are wrapped: a number is never cut off.
        rich.add_column(printable(column.heading), justify=side, no_wrap=not column.left)
    for row in table.shown:
        rich.add_row(*(printable(column.words(row)) for column in table.columns))
    return rich


def _unprintable(letter: str) -> bool:
    """Return whether a character is a control, a lone surrogate, or the end of a line."""
    category = unicodedata.category(letter)
    return category[0] == "C" or category in ("Zl", "Zp")
