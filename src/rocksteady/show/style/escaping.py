"""Escaping of external names, such as file names, for figures."""

import functools
import textwrap

from rocksteady.results.rendering import printable

UNKNOWN = "\N{REPLACEMENT CHARACTER}"
"""Stands for a character that no font of a picture has."""


def literal(text: str, *, line: int | None = None) -> str:
    r"""Return text as Matplotlib shows it character by character, without mathematics.

    Matplotlib reads what stands between two dollar signs as mathematics, leaves an entry of a
    legend out whose text begins with an underscore, and warns of characters that its font lacks.

    Parameters
    ----------
    text
        Text of a user: a name, a title.
    line
        Most characters in a line; one line by default.

    Examples
    --------
    >>> print(literal(r"$\frac{$.at2"))
    \$\frac{\$.at2
    >>> literal("two\nlines"), literal("wave 波")
    ('two lines', 'wave �')
    """
    known = "".join(
        letter if ord(letter) in _characters() else UNKNOWN
        for letter in printable("".join(" " if letter.isspace() else letter for letter in text))
    )
    lines = [known] if line is None else textwrap.wrap(known, line) or [""]
    shown = "\n".join(lines).replace("$", r"\$")
    return f"\N{ZERO WIDTH SPACE}{shown}" if shown.startswith("_") else shown


@functools.cache
def _characters() -> frozenset[int]:
    """Return the characters that the font of the house style has."""
    from matplotlib.font_manager import FontProperties, findfont, get_font

    return frozenset(get_font(findfont(FontProperties(family="DejaVu Sans"))).get_charmap())
