"""Texts of pages, marked up, and the cells of tables."""

from dataclasses import dataclass

from markupsafe import Markup


@dataclass(frozen=True)
class Cell:
    """A cell of a table on a page that is more than a text.

    Attributes
    ----------
    content
        A text, or markup.
    look
        Classes of the page's style.
    label
        What a phone shows before it; by default the heading of its column.
    """

    content: str
    look: str = ""
    label: str = ""


Row = dict[str, Cell | str | None]
"""Headings of the columns of a table, and a cell below each; None is an empty one."""


def figure(content: str, label: str = "") -> Cell:
    """Return the cell of a number, or of a text in a column of numbers."""
    return Cell(content, "figure", label)


def named(name: str, width: str = "", more: str = "") -> Cell:
    """Return the cell of a name as its owner gives it, with markup after it."""
    return Cell(isolated(name) + more, f"{width} name".strip())


def badge(word: str, look: str) -> Markup:
    """Return a verdict in a word."""
    return Markup('<span class="badge {}">{}</span>').format(look, word)


def isolated(text: str) -> Markup:
    """Return a name as its owner gives it, which may run from right to left."""
    return Markup("<bdi>{}</bdi>").format(text)


def digest(sha256: str) -> Markup:
    """Return a hash, or its first digits."""
    return Markup('<code class="hash">{}</code>').format(sha256)


def quiet(text: str | None) -> Markup:
    """Return a space and a text in a faint colour; nothing for None."""
    return Markup() if text is None else Markup(' <span class="quiet">{}</span>').format(text)


def under(text: str | None) -> Markup:
    """Return a text as a line of small letters; nothing for None."""
    return Markup() if text is None else Markup('<span class="under">{}</span>').format(text)


def beside(*parts: str) -> Markup:
    """Return the parts that are not empty, a space between them.

    Examples
    --------
    >>> str(beside(badge("low", "green"), "a < b", under(None)))
    '<span class="badge green">low</span> a &lt; b'
    """
    return Markup(" ").join(part for part in parts if part)
