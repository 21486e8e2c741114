"""Axes of plots of facades: ticks with the decimal mark of a language."""

from typing import TYPE_CHECKING

from rocksteady.facades.plots.languages import Language

if TYPE_CHECKING:
    from matplotlib.axes import Axes


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
