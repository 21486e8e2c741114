"""Plot of a table of objects: the probability of falling of each, the worst on top."""

from typing import TYPE_CHECKING

from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import whole_number
from rocksteady.results.numbers import chance
from rocksteady.risk.assess.objects_table import ObjectsTable
from rocksteady.show.plots.value_rows import MOST, draw_interval
from rocksteady.show.style import palette
from rocksteady.show.style.escaping import literal
from rocksteady.show.style.layout import axes_or_new, name_rows, percent_ticks
from rocksteady.show.style.legends import figure_of, text_size
from rocksteady.show.style.limits import draw_limit
from rocksteady.show.style.line_ends import write_beside
from rocksteady.show.style.tokens import inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

NARROW = 4.2
"""Width of a figure [in] up to which names and ticks are short."""


@checked
def plot_objects(table: ObjectsTable, ax: "Axes | None" = None, *, most: int = 20) -> "Axes":
    """Draw the probability of falling of each object as a bar, the worst on top.

    The verdict stands beside each bar; the target is a dashed line. A thin line is the 90 %
    interval of a probability that was counted. An object without a probability has no bar.

    Parameters
    ----------
    table
        From `rocksteady.assess_objects`.
    ax
        Axes to draw on; default: axes of a new figure.
    most
        Number of objects, from 1 to 200; of more the worst are drawn.  Default 20.

    Returns
    -------
    matplotlib.axes.Axes
        The axes: probability of falling, and a row for each object.

    Raises
    ------
    InputError
        If the number is outside its range.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import assess_objects
    >>> from rocksteady.motions import make_synthetic_suite
    >>> from rocksteady.risk import DescribedObject
    >>> vase = DescribedObject(
    ...     values={"name": "vase", "geometry": {"width_m": 0.12, "height_m": 0.5}}
    ... )
    >>> table = assess_objects([vase], make_synthetic_suite(4), pga_g=0.4, pgv_m_s=0.5)
    >>> axes = plot_objects(table, Figure().add_subplot())
    >>> [name.get_text() for name in axes.get_yticklabels()], axes.get_xlabel()
    (['vase'], 'probability of falling')
    """
    most = whole_number("most", most, at_least=1, at_most=MOST, hint="give a number of objects")
    worst = table.worst[:most]
    axes = axes_or_new(ax)
    inks, small = inks_of(axes), text_size(axes, 8.0)
    for place, row in enumerate(worst):
        share, words = row["probability"], row["verdict"]
        if share:
            colour = inks.risk_step(share)
            axes.barh(place, share, height=0.62, color=colour, ec=inks.edge, lw=0.6)
        band = (row["band_low"], row["band_high"])
        if None not in band:
            draw_interval(axes, place, share, band)
        if share is not None and row["basis"] != "statics":
            words = f"{chance(share, row['tried'] * (row['basis'] == 'count'))}, {words}"
        write_beside(axes, words, place, inks.ink, small, of_row=True)
    target = table.target_probability
    left = len(table.rows) - len(worst)
    name = f"target {chance(target)}" + (f"; {left:,} more objects below" if left else "")
    draw_limit(axes, target, name, zorder=0.9)
    wide = figure_of(axes).get_figwidth() > NARROW
    letters = 24 if wide else 14
    name_rows(axes, [literal(palette.shortened(row["name"], letters)) for row in worst])
    percent_ticks(axes, "x")
    axes.set(xlabel=palette.LABELS["falling"], xlim=(0.0, 1.03))
    return axes
