"""Plots of bifurcation curves in the plane of two parameters."""

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.dynamics.continuation.chains.point_types import CODIMENSION_TWO, PointType
from rocksteady.dynamics.continuation.curves.bifurcation_curves import (
    BifurcationCurve,
    BifurcationCurves,
)
from rocksteady.dynamics.continuation.points import BranchPoint
from rocksteady.dynamics.parameters import PARAMETERS
from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked
from rocksteady.show.plots.branches._curve_labels import Words
from rocksteady.show.plots.branches.bifurcations import name_of
from rocksteady.show.style import palette
from rocksteady.show.style.layout import axes_or_new
from rocksteady.show.style.legends import LegendPlace, draw_legend, line_scale, place_of
from rocksteady.show.style.line_colours import Inks, inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.lines import Line2D

CURVES: dict[PointType, tuple[int | None, Any]] = {
    PointType.FOLD: (None, "-"),
    PointType.SYMMETRY_BREAKING: (0, (0, (7, 2))),
    PointType.PERIOD_DOUBLING: (2, (0, (3.2, 1.6))),
    PointType.GRAZING: (1, (0, (1, 1.2))),
}
"""Line colour (none is ink) and dash of the curve of each bifurcation."""
MARKS = {
    PointType.CUSP: "v",
    PointType.GENERALISED_BREAKING: "D",
    PointType.GENERALISED_DOUBLING: "^",
    PointType.FOLD_GRAZE: "s",
    PointType.BREAKING_GRAZE: "p",
    PointType.DOUBLING_GRAZE: "o",
    PointType.DOUBLE_GRAZE: "h",
    PointType.RESONANT_GRAZE: "P",
}
"""Marker of each point of codimension two."""
Place = tuple[float, float]
Curve = tuple[PointType, Sequence[BranchPoint]]


@checked
def plot_bifurcation_curves(
    curves: BifurcationCurves | BifurcationCurve | Iterable[Sequence[BranchPoint]],
    ax: "Axes | None" = None,
    *,
    parameters: tuple[str, str] | None = None,
    labels: bool = True,
    legend: LegendPlace | None = None,
) -> "Axes":
    """Draw bifurcation curves in the plane of two parameters.

    Folds are solid, symmetry breakings and period doublings dashed, grazes dotted; those of the
    longer motions are thin.  Each line has its name along it where there is room, once for lines
    that lie on each other.  Points of codimension two are marked and named, and words in italics
    name which of the motions that were followed are stable there.

    Parameters
    ----------
    curves
        From `rocksteady.find_bifurcation_curves`, or one of its curves; or lists, each the points
        that `rocksteady.branches.follow_bifurcation` yields.
    ax
        Axes to draw on, for example of `rocksteady.plots.steady_regions`; default: axes of a new
        figure.
    parameters
        What is drawn to the right and upwards: two of "amplitude", "frequency_ratio" and
        "restitution"; by default those of the curves, or the frequency ratio and the amplitude.
    labels
        Whether lines, points and regions are named (default).
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
    >>> from rocksteady import DimensionlessBlock, Harmonic, find_orbits
    >>> from rocksteady.branches import follow_bifurcation, follow_branch
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
    named: tuple[str, str] = ("frequency_ratio", "amplitude")
    if parameters is not None:
        named = parameters
    elif isinstance(curves, BifurcationCurves | BifurcationCurve):
        named = curves.parameters
    for name in named:
        if name not in PARAMETERS:
            raise InputError(
                "parameters",
                name,
                "bifurcations are drawn over " + ", ".join(PARAMETERS),
                "name two of them",
            )
    drawn = _listed(curves)
    axes = axes_or_new(ax)
    place = place_of(axes, legend, "right")
    handles = _drawn_lines(axes, drawn, named)
    handles += _drawn_points(axes, drawn, named)
    axes.set(xlabel=palette.LABELS[named[0]], ylabel=palette.LABELS[named[1]])
    if isinstance(curves, BifurcationCurves):
        ranges = dict(zip(curves.parameters, curves.within, strict=True))
        if set(named) == set(ranges):
            axes.set(xlim=ranges[named[0]], ylim=ranges[named[1]])
    draw_legend(axes, place, handles=handles)
    if labels and drawn:
        _written(axes, curves, drawn, named)
    return axes


def _listed(
    curves: BifurcationCurves | BifurcationCurve | Iterable[Sequence[BranchPoint]],
) -> list[Curve]:
    """Return the type and the points of each curve.

    Raises
    ------
    InputError
        If one begins at what is no bifurcation.
    """
    if isinstance(curves, BifurcationCurves):
        return [(curve.type, curve.points) for curve in curves.curves]
    if isinstance(curves, BifurcationCurve):
        return [(curves.type, curves.points)]
    listed = []
    for points in curves:
        if not points:
            continue
        if points[0].type not in CURVES:
            raise InputError(
                "curves",
                points[0].type.value,
                "a curve is one of " + ", ".join(CURVES),
                "give what rs.branches.follow_bifurcation(...) returns, in lists",
            )
        listed.append((points[0].type, points))
    return listed


def _drawn_lines(
    axes: "Axes", drawn: Sequence[Curve], parameters: tuple[str, str]
) -> list["Line2D"]:
    """Draw curves and return the entries of the legend."""
    from matplotlib.lines import Line2D

    inks, scale = inks_of(axes), line_scale(axes)
    fewest = min((_length(points) for _, points in drawn), default=0)
    for kind, points in drawn:
        number, dash = CURVES[kind]
        thin = _length(points) > fewest and kind is not PointType.SYMMETRY_BREAKING
        axes.plot(
            *_places(points, parameters).T,
            color=colour_of(number, inks),
            ls=dash,
            lw=(0.9 if thin else 1.6) * scale,
            zorder=2.8 if thin else 3.0,
        )
    kinds_drawn = {kind for kind, _ in drawn}
    return [
        Line2D([], [], color=colour_of(number, inks), ls=dash, lw=1.6 * scale, label=name_of(kind))
        for kind, (number, dash) in CURVES.items()
        if kind in kinds_drawn
    ]


def _length(points: Sequence[BranchPoint]) -> int:
    """Return the impacts in a period of the motions of a curve."""
    return points[len(points) // 2].impacts


def _places(points: Sequence[BranchPoint], parameters: tuple[str, str]) -> Floats:
    return np.array([[getattr(point, name) for name in parameters] for point in points])


def _special(drawn: Sequence[Curve], parameters: tuple[str, str]) -> dict[PointType, list[Place]]:
    """Return the places of points of codimension two, each once."""
    positions: dict[PointType, list[Place]] = {}
    for _, points in drawn:
        for point in points:
            if point.type in CODIMENSION_TWO:
                x, y = (round(getattr(point, name), 7) for name in parameters)
                places = positions.setdefault(point.type, [])
                if (x, y) not in places:
                    places.append((x, y))
    return positions


def _drawn_points(
    axes: "Axes", drawn: Sequence[Curve], parameters: tuple[str, str]
) -> list["Line2D"]:
    """Mark points of codimension two and return the entries of the legend."""
    inks, handles = inks_of(axes), []
    special = _special(drawn, parameters)
    for kind, marker in MARKS.items():
        if kind in special:
            (line,) = axes.plot(
                *zip(*special[kind], strict=True),
                marker=marker,
                ms=4.6 * line_scale(axes),
                mfc=inks.paper,
                mec=inks.ink,
                mew=0.9,
                ls="none",
                zorder=4.0,
                label=name_of(kind),
            )
            handles.append(line)
    return handles


def _written(
    axes: "Axes",
    curves: object,
    drawn: Sequence[Curve],
    parameters: tuple[str, str],
) -> None:
    """Name points, lines and regions."""
    inks = inks_of(axes)
    special = _special(drawn, parameters)
    words = Words(axes, [_places(points, parameters) for _, points in drawn])
    for places in special.values():
        words.take(places, 4.0)
    words.along(_names(drawn), [colour_of(CURVES[kind][0], inks) for kind, _ in drawn])
    for kind, places in special.items():
        for place in places:
            words.beside(place, name_of(kind))
    if isinstance(curves, BifurcationCurves):
        order = [curves.parameters.index(name) for name in parameters if name in curves.parameters]
        if len(order) < 2:
            return
        regions: dict[str, list[tuple[float, Place]]] = {}
        for region in curves.regions:
            axis, low, high = region.extent
            share = (high - low) / (curves.within[axis][1] - curves.within[axis][0])
            place = (region.place[order[0]], region.place[order[1]])
            text = "\nand ".join(region.motions)
            if len(region.motions) == 1:
                text = text.replace(", ", "\n")
            regions.setdefault(f"stable:\n{text}", []).append((share, place))
        for text, listed in sorted(regions.items(), key=lambda each: -max(each[1])[0]):
            words.inside([place for _, place in sorted(listed, reverse=True)], text)


def _names(drawn: Sequence[Curve]) -> list[str]:
    """Return the name of each curve, with what distinguishes it from others of its type."""
    kinds = [(kind, *_motion(points)) for kind, points in drawn]
    names = []
    for kind, period, impacts in kinds:
        word = name_of(kind)
        if kind is PointType.PERIOD_DOUBLING:
            word = f"doubling {period} to {2 * period}"
        elif len({period_drawn for _, period_drawn, _ in kinds}) > 1:
            word += f", period {period}"
        if len({place for same, at, place in kinds if (same, at) == (kind, period)}) > 1:
            word += f", {impacts} impacts"
        names.append(word)
    return names


def _motion(points: Sequence[BranchPoint]) -> tuple[int, int]:
    point = points[len(points) // 2]
    return point.period, point.impacts


def colour_of(number: int | None, inks: Inks) -> str:
    """Return a line colour, or ink where there is no number."""
    return inks.ink if number is None else inks.lines[number]
