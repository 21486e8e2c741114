"""Plots of bifurcation curves in the plane of two parameters."""

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

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
from rocksteady.show.plots.branches._branch_lines import name_of
from rocksteady.show.plots.branches.curve_labels import Words
from rocksteady.show.plots.branches.views import shared_size
from rocksteady.show.style.layout import axes_or_new
from rocksteady.show.style.legends import GAP, LegendPlace, draw_legend, line_scale, place_of
from rocksteady.show.style.scales import FAR_ROOM, Scale, draw_far_axes, scale_of
from rocksteady.show.style.tokens import inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.lines import Line2D

CURVES: dict[PointType, Any] = {
    PointType.FOLD: (0, (9, 1.5)),
    PointType.SYMMETRY_BREAKING: (0, (7, 2, 1.2, 2)),
    PointType.PERIOD_DOUBLING: (0, (3.2, 1.6)),
    PointType.GRAZING: (0, (1, 1.2)),
}
"""Dashes of the curve of each bifurcation."""
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


class Plane(NamedTuple):
    """The two parameters that are drawn, and their scales."""

    names: tuple[str, str]
    scales: Sequence[Scale]

    def places(self, points: Sequence[BranchPoint]) -> Floats:
        """Return where points are drawn, shape (points, 2)."""
        values = [[getattr(point, name) for name in self.names] for point in points]
        return np.array(values) * [scale.factor for scale in self.scales]


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

    Folds, symmetry breakings, period doublings and grazes differ in their dashes; those of the
    longer motions are thin.  Each line has its name along it where there is room, once for lines
    that lie on each other; what has no name is in the legend.  Points of codimension two are marked
    and named, and words in italics name which of the motions that were followed are stable there.
    For a block of known size the axes are in g and Hz, with the dimensionless scales on the far
    sides.

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
        "inside" the axes, to their "right", "below" them (default) or "none".

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
    >>> print(axes.texts[0].get_text(), len(axes.lines))
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
    place = place_of(axes, legend, "below")
    block = shared_size(points[0].block for _, points in drawn) if drawn else None
    scales = [scale_of(name, block) for name in named]
    plane = Plane(named, scales)
    _draw_lines(axes, drawn, plane)
    special = _special(drawn, plane)
    for kind, places in special.items():
        axes.plot(*zip(*places, strict=True), zorder=4.0, **_mark(kind, axes))
    axes.set(xlabel=scales[0].label, ylabel=scales[1].label)
    if isinstance(curves, BifurcationCurves):
        ranges = dict(zip(curves.parameters, curves.within, strict=True))
        if set(named) == set(ranges):
            x, y = (
                scale.factor * np.array(ranges[name])
                for name, scale in zip(named, scales, strict=True)
            )
            axes.set(xlim=x.tolist(), ylim=y.tolist())
    far = FAR_ROOM * draw_far_axes(axes, *scales)
    entries = _entries(axes, drawn, special)
    draw_legend(axes, place, handles=[*entries.values()], gap=GAP + far)
    if labels and drawn:
        explained = _written(axes, curves, drawn, plane, special)
        left = [entry for kind, entry in entries.items() if kind not in explained]
        draw_legend(axes, place, handles=left, gap=GAP + far)
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


def _draw_lines(axes: "Axes", drawn: Sequence[Curve], plane: Plane) -> None:
    """Draw curves."""
    scale = line_scale(axes)
    fewest = min((_length(points) for _, points in drawn), default=0)
    for kind, points in drawn:
        thin = _length(points) > fewest and kind is not PointType.SYMMETRY_BREAKING
        axes.plot(
            *plane.places(points).T,
            color=inks_of(axes).limit,
            ls=CURVES[kind],
            lw=(0.9 if thin else 1.4) * scale,
            zorder=2.8 if thin else 3.0,
        )


def _length(points: Sequence[BranchPoint]) -> int:
    """Return the impacts in a period of the motions of a curve."""
    return points[len(points) // 2].impacts


def _special(drawn: Sequence[Curve], plane: Plane) -> dict[PointType, list[Place]]:
    """Return the places of points of codimension two, each once."""
    positions: dict[PointType, list[Place]] = {kind: [] for kind in MARKS}
    for _, points in drawn:
        for point in points:
            if point.type in CODIMENSION_TWO:
                x, y = np.round(plane.places([point])[0], 7).tolist()
                if (x, y) not in positions[point.type]:
                    positions[point.type].append((x, y))
    return {kind: places for kind, places in positions.items() if places}


def _mark(kind: PointType, axes: "Axes") -> dict[str, Any]:
    """Return the look of a point of codimension two."""
    inks, size = inks_of(axes), 4.6 * line_scale(axes)
    look = {"mfc": inks.paper, "mec": inks.ink, "mew": 0.9, "ls": "none"}
    return {"marker": MARKS[kind], "ms": size, **look}


def _entries(
    axes: "Axes", drawn: Sequence[Curve], special: Iterable[PointType]
) -> dict[PointType, "Line2D"]:
    """Return the entry of the legend of each kind of line and point."""
    from matplotlib.lines import Line2D

    lines = {kind for kind, _ in drawn}
    looks: dict[PointType, dict[str, Any]] = {
        kind: {"color": inks_of(axes).limit, "ls": dash, "lw": 1.4 * line_scale(axes)}
        for kind, dash in CURVES.items()
        if kind in lines
    }
    looks |= {kind: _mark(kind, axes) for kind in special}
    return {kind: Line2D([], [], label=name_of(kind), **look) for kind, look in looks.items()}


def _written(
    axes: "Axes",
    curves: object,
    drawn: Sequence[Curve],
    plane: Plane,
    special: dict[PointType, list[Place]],
) -> set[PointType]:
    """Name points, lines and regions; return the kinds all of which have their names."""
    words = Words(axes, [plane.places(points) for _, points in drawn])
    for places in special.values():
        words.take(places, 4.0)
    names, ink = _names(drawn), inks_of(axes).ink
    written = words.along(names, [ink] * len(names))
    nameless = {kind for (kind, _), name in zip(drawn, names, strict=True) if name not in written}
    for kind, places in special.items():
        written_here = [words.beside(place, name_of(kind)) for place in places]
        nameless |= set() if all(written_here) else {kind}
    if isinstance(curves, BifurcationCurves) and set(plane.names) <= set(curves.parameters):
        _name_regions(words, curves, plane)
    return {*special, *(kind for kind, _ in drawn)} - nameless


def _name_regions(words: Words, curves: BifurcationCurves, plane: Plane) -> None:
    """Name the motions that are stable in each region, the widest first."""
    order = [curves.parameters.index(name) for name in plane.names]
    regions: dict[str, list[tuple[float, Place]]] = {}
    for region in curves.regions:
        axis, low, high = region.extent
        share = (high - low) / (curves.within[axis][1] - curves.within[axis][0])
        x, y = (
            scale.factor * region.place[k] for scale, k in zip(plane.scales, order, strict=True)
        )
        text = "\nand ".join(region.motions)
        if len(region.motions) == 1:
            text = text.replace(", ", "\n")
        regions.setdefault(f"stable:\n{text}", []).append((share, (x, y)))
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
