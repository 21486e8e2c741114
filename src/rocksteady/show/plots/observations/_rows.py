"""Names of rows beside a plot."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from rocksteady.show.style import layout, palette
from rocksteady.show.style.escaping import literal
from rocksteady.show.style.legends import SMALL, figure_of, text_size

if TYPE_CHECKING:
    from matplotlib.axes import Axes

CROWDED = 24
"""Rows from which on their text is smaller."""
LONGEST, SHORTEST = 26, 15
"""Letters of a name in a wide and in a narrow figure."""


def name_rows(axes: "Axes", names: Sequence[str], endings: Sequence[str] = ()) -> None:
    """Write a name beside each row, the first on top, and lay the figure out for them.

    Parameters
    ----------
    axes
        With their abscissa finished; their rows are 0, 1, 2, ...
    names
        As a user wrote them; long ones lose their middle.
    endings
        What follows each name, whole; nothing by default.
    """
    figure = figure_of(axes)
    longest = LONGEST if 72.0 * figure.get_figwidth() >= SMALL else SHORTEST
    size = text_size(axes, 8.0 if len(names) <= CROWDED else 7.0)
    shown = [literal(palette.shortened(each, longest)) for each in names]
    if endings:
        shown = [each + ending for each, ending in zip(shown, endings, strict=True)]
    layout.name_rows(axes, shown, fontsize=size)
    if figure.get_layout_engine() is not None:
        figure.draw_without_rendering()  # a legend below needs the place of the axes
