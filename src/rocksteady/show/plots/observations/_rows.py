"""Outcomes of tests and objects as marks, and names of rows beside a plot."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.show.style import layout, palette
from rocksteady.show.style.escaping import literal
from rocksteady.show.style.legends import SMALL, figure_of, text_size
from rocksteady.show.style.tokens import inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

CROWDED = 24
"""Rows from which on their text is smaller."""
LONGEST, SHORTEST = 26, 15
"""Letters of a name in a wide and in a narrow figure."""


def draw_outcomes(
    axes: "Axes",
    at: tuple[ArrayLike, ArrayLike],
    outcomes: Sequence[bool | None],
    size: float,
    other: tuple[str, str, str] = ("", "", ""),
) -> list[Any]:
    """Draw a mark for each outcome, filled where it fell; return the entries of a legend.

    Parameters
    ----------
    axes
        Axes to draw on.
    at
        Abscissas and ordinates, shape (outcomes,).
    outcomes
        Whether each fell; None where that is not known.
    size
        Size of a mark [points].
    other
        Mark, colour and words of what is not known.
    """
    inks, handles = inks_of(axes), []
    across, up = (np.asarray(each) for each in at)
    for outcome, (shape, face, words) in (
        (True, ("o", inks.observed, "fell")),
        (False, ("s", inks.paper, "stood")),
        (None, other),
    ):
        which = np.array([each is outcome for each in outcomes])
        if which.any():
            handles += axes.plot(
                across[which], up[which], shape, ms=size, color=face,
                mec=inks.paper if outcome is None else inks.observed, mew=0.8, label=words,
                ls="none", zorder=3.0,
            )  # fmt: skip
    return handles


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
