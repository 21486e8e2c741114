"""Picture of a table of objects: the share of the runs in which each falls, the worst on top."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import whole_number
from rocksteady.results.numbers import CONFIDENCE, chance
from rocksteady.results.stated import share_words
from rocksteady.risk.assess.objects_table import ObjectsTable
from rocksteady.risk.counted.verdict import Target
from rocksteady.risk.hazard.failure_risk import in_years
from rocksteady.show.plots.risk._words import FALLING
from rocksteady.show.plots.value_rows import MOST, draw_interval
from rocksteady.show.style import palette
from rocksteady.show.style.escaping import literal
from rocksteady.show.style.layout import axes_or_new, name_rows, percent_ticks
from rocksteady.show.style.legends import figure_of, text_size
from rocksteady.show.style.limits import draw_limit
from rocksteady.show.style.line_ends import write_beside
from rocksteady.show.style.tokens import inks_of
from rocksteady.show.style.wording import BADGES, LOOKS

if TYPE_CHECKING:
    from matplotlib.axes import Axes

NARROW = 4.2
"""Width of a figure [in] up to which names and ticks are short."""


@checked
def plot_objects(table: ObjectsTable, ax: "Axes | None" = None, *, most: int = 20) -> "Axes":
    """Draw the share of runs in which each kind of object falls, the worst on top.

    Of a target in 50 years it is the probability of a fall.  A thin line is the 90 % interval, a
    dashed one the target.  The verdict stands beside each row; an object without a count has no
    bar.

    Parameters
    ----------
    table
        From `rocksteady.assess_objects`.
    ax
        Axes to draw on; default: axes of a new figure.
    most
        Number of kinds of object, from 1 to 200; of more the worst are drawn.  Default 20.

    Returns
    -------
    matplotlib.axes.Axes
        The axes: share of the runs, and a row for each kind of object.

    Raises
    ------
    InputError
        If the number is outside its range.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import assess_objects
    >>> from rocksteady.motions import make_synthetic_suite
    >>> from rocksteady.risk import DescribedObject, Peaks
    >>> vases = [
    ...     DescribedObject(values={"name": name, "geometry": {"width_m": 0.12, "height_m": 0.5}})
    ...     for name in ("vase", "urn")
    ... ]
    >>> table = assess_objects(
    ...     vases, make_synthetic_suite(12), demand=Peaks(pga_g=0.4, pgv_m_s=0.5)
    ... )
    >>> axes = plot_objects(table, Figure().add_subplot())
    >>> [name.get_text() for name in axes.get_yticklabels()]
    ['2 × vase']
    """
    most = whole_number("most", most, at_least=1, at_most=MOST, hint="give a number of objects")
    kinds = table.kinds
    axes = axes_or_new(ax)
    inks, small = inks_of(axes), text_size(axes, 8.0)
    letters = 24 if figure_of(axes).get_figwidth() > NARROW else 16
    names = []
    for place, (row, count) in enumerate(kinds[:most]):
        if (bar := _bar(row, table.target)) is not None:
            share, band = bar
            colour = inks.risk_step(share)
            axes.barh(place, share, height=0.62, color=colour, ec=inks.edge, lw=0.6)
            if band is not None:
                draw_interval(axes, place, share, band)
        look = LOOKS.get(row["verdict"], "")
        colour = {"red": inks.verdict_red, "green": inks.verdict_green}.get(look, inks.ink)
        write_beside(axes, _words(row, table.target), place, colour, small, of_row=True)
        alike = f"{count:,} × " if count > 1 else ""
        names.append(alike + literal(palette.shortened(row["name"], letters - len(alike))))
    left = len(kinds) - len(names)
    target = f"target {table.target.words}"
    draw_limit(axes, table.target.share, target + f"; {left:,} more below" * (left > 0))
    name_rows(axes, names)
    percent_ticks(axes, "x")
    label = FALLING if table.target.years is None else "probability of a fall in 50 years"
    axes.set(xlabel=f"{label} (line: {100.0 * CONFIDENCE:g} %)", xlim=(0.0, 1.03))
    return axes


def _bar(row: Mapping[str, Any], target: Target) -> tuple[float, tuple[float, float] | None] | None:
    """Return what the target is for, and its interval; None without a count."""
    if target.years is not None:
        value, ends = row["probability_50_years"], (row["rate_low"], row["rate_high"])
        if value is None or None in ends:
            return None if value is None else (value, None)
        low, high = (in_years(end, target.years) for end in ends)
        return value, (low, high)
    if row["share"] is None or row["by"] == "statics":
        return None
    return row["share"], (row["low"], row["high"])


def _words(row: Mapping[str, Any], target: Target) -> str:
    """Return share and verdict of a kind of object."""
    verdict = BADGES[row["verdict"]][0]
    if target.years is not None and row["probability_50_years"] is not None:
        return f"{chance(row['probability_50_years'])}, {verdict}"
    if row["share"] is None or row["by"] == "statics":
        return verdict
    band = (row["low"], row["high"])
    share = share_words(row["fall"], row["runs"], band, row["share"]).partition(" (")[0]
    return f"{share}, {verdict}"
