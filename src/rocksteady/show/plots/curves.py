"""Plots of bifurcation curves in the plane of two parameters."""

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

from rocksteady.dynamics.continuation.points import BranchPoint, PointType
from rocksteady.dynamics.parameters import PARAMETERS
from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked
from rocksteady.show.style import palette
from rocksteady.show.style.layout import axes_or_new
from rocksteady.show.style.legends import LegendPlace, draw_legend, place_of
from rocksteady.show.style.line_colours import Inks, inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.lines import Line2D

CURVES: dict[PointType, tuple[int | None, Any, str]] = {
    PointType.FOLD: (None, "-", "fold"),
    PointType.SYMMETRY_BREAKING: (0, (0, (7, 2)), "symmetry breaking"),
    PointType.PERIOD_DOUBLING: (2, (0, (3.2, 1.6)), "period doubling"),
    PointType.GRAZING: (1, (0, (1, 1.2)), "graze"),
}
"""Line colour (none is ink), dash and name of the curve of each bifurcation."""


@checked
def plot_bifurcation_curves(
    curves: Iterable[Sequence[BranchPoint]],
    ax: "Axes | None" = None,
    *,
    parameters: tuple[str, str] = ("frequency_ratio", "amplitude"),
    legend: LegendPlace | None = None,
) -> "Axes":
    """Draw bifurcation curves in the plane of two parameters.

    Folds are solid, symmetry breakings and period doublings dashed, grazes dotted.

    Parameters
    ----------
    curves
        Each the points that `rocksteady.follow_bifurcation` yields.
    ax
        Axes to draw on, a `rocksteady.plot_regions` for one; those of a new figure without.
    parameters
        What is drawn to the right and upwards: two of "amplitude", "frequency_ratio" and
        "restitution".
    legend
        "inside" the axes, to their "right", "below" them or "none"; by default to their
        right, or below narrow ones.

    Returns
    -------
    matplotlib.axes.Axes
        The axes.

    Raises
    ------
    InputError
        If a parameter has another name, or a point is no bifurcation.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import (
    ...     DimensionlessBlock,
    ...     Harmonic,
    ...     follow_bifurcation,
    ...     follow_branch,
    ...     find_orbits,
    ... )
    >>> shaking = Harmonic(amplitude=1.0, frequency_ratio=2.0)
    >>> start = find_orbits(DimensionlessBlock(restitution=0.8), shaking, max_period=1)[0]
    >>> branch = follow_branch(start, "amplitude", (0.1, 3.0))
    >>> breaking = next(point for point in branch if point.type == "symmetry-breaking")
    >>> plane = ("amplitude", "frequency_ratio")
    >>> curve = follow_bifurcation(breaking, plane, ((0.1, 6.0), (1.0, 4.0)))
    >>> axes = plot_bifurcation_curves([list(curve)], Figure().add_subplot())
    >>> print(axes.get_legend().get_texts()[0].get_text(), len(axes.lines))
    symmetry breaking 1
    """
    for name in parameters:
        if name not in PARAMETERS:
            raise InputError(
                "parameters",
                name,
                "bifurcations are drawn over " + ", ".join(PARAMETERS),
                "name two of them",
            )
    axes = axes_or_new(ax)
    inks, place = inks_of(axes), place_of(axes, legend, "right")
    named: dict[str, Line2D] = {}
    for curve in curves:
        if not curve:
            continue
        if curve[0].type not in CURVES:
            raise InputError(
                "curves",
                curve[0].type.value,
                "a curve is one of " + ", ".join(CURVES),
                "give what follow_bifurcation(...) returns, in lists",
            )
        number, dash, word = CURVES[curve[0].type]
        colour = colour_of(number, inks)
        places = [[getattr(point, name) for name in parameters] for point in curve]
        (line,) = axes.plot(*zip(*places, strict=True), color=colour, ls=dash, lw=1.4, zorder=3.0)
        named.setdefault(word, line)
    axes.set(xlabel=palette.LABELS[parameters[0]], ylabel=palette.LABELS[parameters[1]])
    words = [word for *_, word in CURVES.values() if word in named]
    draw_legend(axes, place, handles=[named[word] for word in words], labels=words)
    return axes


def colour_of(number: int | None, inks: Inks) -> str:
    """Return a line colour, or ink where there is no number."""
    return inks.ink if number is None else inks.lines[number]
