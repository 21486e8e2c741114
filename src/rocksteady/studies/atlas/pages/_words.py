"""Text of numbers and names in the atlas."""

from collections.abc import Sequence


def percent(share: float) -> str:
    r"""Return a share in percent, with three figures, as far as a picture could show it.

    Examples
    --------
    >>> percent(0.11493), percent(0.00072), percent(0.0), percent(1.0)
    ('11.5\xa0%', '0.072\xa0%', '0\xa0%', '100\xa0%')
    """
    figures = 3 if share >= 0.001 else 2
    return f"{100.0 * share:.{figures}g}\N{NO-BREAK SPACE}%"


def amplitude_text(value: float) -> str:
    """Return a coordinate of a cell, which is known to a rounding and needs no more figures.

    Examples
    --------
    >>> amplitude_text(3.4800000000000004)
    '3.48'
    """
    return f"{value:.6g}"


def listed(things: Sequence[str]) -> str:
    """Return things with commas, and "and" before the last.

    Examples
    --------
    >>> listed(["one"]), listed(["one", "two", "three"])
    ('one', 'one, two and three')
    """
    return things[0] if len(things) == 1 else f"{', '.join(things[:-1])} and {things[-1]}"
