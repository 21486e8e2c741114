"""Plot of published formulas side by side: demand over what each allows."""

from typing import TYPE_CHECKING

from rocksteady.errors import InputError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.results.numbers import number
from rocksteady.risk.screens.screens import Screens
from rocksteady.show.style.layout import axes_or_new, name_rows
from rocksteady.show.style.legends import text_size
from rocksteady.show.style.limits import draw_limit
from rocksteady.show.style.line_ends import write_beside
from rocksteady.show.style.tokens import inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

WORDS = {True: "passes", False: "does not pass", None: "no verdict"}
"""Verdict on a row."""


@checked
def plot_screens(screens: Screens, ax: "Axes | None" = None) -> "Axes":
    """Draw the demand over the threshold of each published formula, the largest on top.

    A bar beyond the dashed line is a demand above the threshold; the ratio and the verdict stand
    beside it, as some thresholds are medians or uplift, which decide nothing. Formulas without a
    threshold in g or m/s have no bar.

    Parameters
    ----------
    screens
        From `rocksteady.screen_block`.
    ax
        Axes to draw on; default: axes of a new figure.

    Returns
    -------
    matplotlib.axes.Axes
        The axes: demand over threshold, and a row for each formula.

    Raises
    ------
    InputError
        If no formula has a threshold for the demand.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import Block, Demand, screen_block
    >>> cabinet = Block.rectangle(width=0.32, height=1.8)
    >>> axes = plot_screens(
    ...     screen_block(cabinet, Demand(pga_g=0.35, pgv_m_s=0.4)), Figure().add_subplot()
    ... )
    >>> axes.get_xlabel(), axes.get_yticklabels()[0].get_text()
    ('demand over threshold', 'Circolare rectangle')
    """
    rows = [(ratio, row) for row in screens.rows if (ratio := screens.ratio(row)) is not None]
    if not rows:
        raise InputError(
            "screens",
            Words("have no threshold in g or m/s"),
            "a bar is a demand over a threshold",
            "give a PGA or a PGV",
        )
    rows.sort(key=lambda each: -each[0])
    axes = axes_or_new(ax)
    inks, small = inks_of(axes), text_size(axes, 8.0)
    lengths = [ratio for ratio, _ in rows]
    axes.barh(range(len(rows)), lengths, height=0.6, color=inks.edge, lw=0.0)
    for place, (ratio, row) in enumerate(rows):
        words = f"{number(ratio)}, {WORDS[row.passes]}"
        write_beside(axes, words, place, inks.ink, small, of_row=True)
    draw_limit(axes, 1.0, "threshold")
    name_rows(axes, [row.name for _, row in rows])
    axes.set(xlabel="demand over threshold", xlim=(0.0, 1.05 * max(1.0, rows[0][0])))
    return axes
