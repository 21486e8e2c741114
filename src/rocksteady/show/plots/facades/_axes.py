"""Axes of plots of facades: ticks with the decimal mark of a language."""

from typing import TYPE_CHECKING

from rocksteady.show.plots.facades.languages import Language

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def decimal_marks(axes: "Axes", words: Language, *, vertical: bool = True) -> None:
    """Write the ticks of one axis or both with the decimal mark of a language."""
    from matplotlib.ticker import FuncFormatter

    for axis in (axes.xaxis, *([axes.yaxis] if vertical else [])):
        axis.set_major_formatter(FuncFormatter(lambda value, _: words.number(value).replace("-", "\N{MINUS SIGN}")))
