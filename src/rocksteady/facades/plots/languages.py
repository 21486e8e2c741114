"""Languages of the pages and plots of facades: their words, and how they write numbers."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from rocksteady.errors import InputError
from rocksteady.facades.plots._words_en import ENGLISH
from rocksteady.facades.plots._words_it import ITALIAN
from rocksteady.results.numbers import number

if TYPE_CHECKING:
    from matplotlib.axes import Axes

TABLES = {
    code: {key: text.replace("'", "\N{RIGHT SINGLE QUOTATION MARK}") for key, text in table.items()}
    for code, table in (("en", ENGLISH), ("it", ITALIAN))
}
"""All words by language; every table has the same keys."""


@dataclass(frozen=True)
class Language:
    r"""A language: its code, its words, and its decimal mark.

    Examples
    --------
    >>> italian = language_of("it")
    >>> italian["wall"], italian.number(0.0987654), italian.quantity(1.958, "s")
    ('parete', '0,0988', '1,96\xa0s')
    """

    code: str

    def __getitem__(self, key: str) -> str:
        """Return the words of a key."""
        return TABLES[self.code][key]

    def __call__(self, key: str, *places: str, **values: Any) -> str:
        """Return the words of a key with values in their places."""
        return self[key].format(*places, **values)

    def has(self, key: str) -> bool:
        """Return whether there are words of a key."""
        return key in TABLES[self.code]

    def marked(self, text: str) -> str:
        """Return the text of a number with the decimal mark of the language."""
        return text.replace(".", ",") if self.code == "it" else text

    def number(self, value: float | None, digits: int = 3) -> str:
        """Return a number with some significant digits; a dash of None."""
        return "\N{EM DASH}" if value is None else self.marked(number(value, digits))

    def quantity(self, value: float | None, unit: str, digits: int = 3) -> str:
        """Return a number with its unit on the same line."""
        words = self.number(value, digits)
        return words if value is None or not unit else f"{words}\N{NO-BREAK SPACE}{unit}"

    def joined(self, parts: list[str]) -> str:
        """Return an enumeration.

        Examples
        --------
        >>> language_of("en").joined(["a", "b", "c"]), language_of("it").joined(["a", "b"])
        ('a, b and c', 'a e b')
        """
        if len(parts) < 2:
            return "".join(parts)
        return f"{', '.join(parts[:-1])} {self['and']} {parts[-1]}"


def language_of(code: str) -> Language:
    """Return a language by its code.

    Raises
    ------
    InputError
        If there is no such language.
    """
    if code not in TABLES:
        raise InputError(
            "language", code, "the languages are en and it", "write en for English, it for Italian"
        )
    return Language(code)


def decimal_marks(axes: "Axes", words: Language, *, vertical: bool = True) -> None:
    """Write the ticks of one axis or both with the decimal mark of a language."""
    from matplotlib.ticker import FuncFormatter

    for axis in (axes.xaxis, *([axes.yaxis] if vertical else [])):
        axis.set_major_formatter(
            FuncFormatter(lambda value, _: words.number(value).replace("-", "\N{MINUS SIGN}"))
        )


def symbol(name: str) -> str:
    r"""Return a symbol of the circular as mathematics.

    Examples
    --------
    >>> symbol("d_SLV"), symbol("d_0")
    ('$d_\\mathrm{SLV}$', '$d_\\mathrm{0}$')
    """
    letter, _, index = name.partition("_")
    return rf"${letter}_\mathrm{{{index}}}$"
