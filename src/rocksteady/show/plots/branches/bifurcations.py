"""Plots of branches of periodic motions over a parameter, with sweeps beneath them."""

from collections.abc import Iterable, Sequence
from collections.abc import Set as AbstractSet
from typing import TYPE_CHECKING, Literal

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.dynamics.continuation.chains.point_types import PointType
from rocksteady.dynamics.continuation.diagram import BifurcationDiagram
from rocksteady.dynamics.continuation.points import Branch
from rocksteady.dynamics.continuation.resting.find_resting import RestingBranches
from rocksteady.dynamics.continuation.resting.resting_branch import RestingBranch
from rocksteady.dynamics.orbits.attractor_sweep import AttractorSweep
from rocksteady.errors import InputError
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import positive
from rocksteady.show.plots.branches._branch_lines import (
    EVENTS,
    LOOKS,
    Flight,
    Marks,
    bifurcations_of,
    draw_bifurcations,
    draw_branches,
    mark_of,
    name_of,
    spots_of,
)
from rocksteady.show.plots.branches._resting import LABEL, RESTING, draw_resting, low_rest
from rocksteady.show.plots.branches._sweeps import NAMES_WIDTH, dots_of, draw_dots, draw_sweeps
from rocksteady.show.plots.branches.curve_labels import Words, explain, limit_entries
from rocksteady.show.plots.branches.views import (
    AnyBlock,
    Side,
    View,
    shared_size,
    view_of,
)
from rocksteady.show.style.axes import lane_of
from rocksteady.show.style.insets import Box, crowd_of, draw_inset
from rocksteady.show.style.layout import axes_or_new, plain_ticks, spaced_by_ratio
from rocksteady.show.style.legends import GAP, LegendPlace, place_of
from rocksteady.show.style.scales import FAR_ROOM, draw_far_axes
from rocksteady.show.style.tokens import DASHED, inks_of

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.transforms import Bbox

Drawn = BifurcationDiagram | Branch | RestingBranch | RestingBranches | AttractorSweep
Named = tuple[PointType, float]
"""Type and place of a bifurcation."""
MOST_NAMED = 6
"""Bifurcations whose names stand beside their marks."""
LONG_ENOUGH = 25.0
"""Length of a stable line that is named [points]; of shorter ones an unstable one is."""
NEAR_TIPPING = 0.75
"""Part of the tipping angle from which on the axis of angles reaches it."""
WIDE = 8.0
"""Factor between the ends of an axis that is logarithmic where bifurcations lie in its lowest"""
LOWEST_PART = 0.25
"""part."""
CROWDED = 8
"""Bifurcations that decide about it."""


@checked
def plot_bifurcations(
    diagram: Drawn | Iterable[Branch | RestingBranch],
    sweeps: Iterable[AttractorSweep] = (),
    ax: "Axes | None" = None,
    *,
    side: Side = "positive",
    top: float | None = None,
    key: Literal["inside", "beside"] = "beside",
    legend: LegendPlace | None = None,
) -> "Axes":
    """Draw branches of periodic motions over their parameter, with sweeps beneath them.

    Every flight of an orbit is a line, the extreme u = theta/alpha that it reaches: solid where the
    motion is stable, dashed where it is unstable, dotted and faint where the solution is no motion.
    Colours distinguish symmetric and unsymmetric motions, periods, and orbits that come to rest,
    which are stable, from all of these; a dot at the highest angle marks an end of these.  Kinds
    are named along their lines where there is room, else in the legend.  Bifurcations are marked at
    the highest and at the lowest angle of their orbits; those at which motions become unstable have
    their names and places beside them.  The motions that a sweep meets are triangles beneath the
    lines that point its way, or dots where they do not repeat.  Bars along the upper edge, a row
    for each sweep, show where its motion fell or came to rest.

    For a block of known size the parameter is in g or Hz and extremes are in degrees, with the
    dimensionless scales on the far sides.  The axis of the parameter is logarithmic where a sweep's
    values are spaced by ratio, as `numpy.geomspace` does, and where nearly all bifurcations lie in
    its lowest part.  Bifurcations that crowd in a small part of the picture are drawn again in an
    inset, large enough to be distinguished, if there is room; where orbits that come to rest lie
    close to the axis, the inset shows these.

    Parameters
    ----------
    diagram
        From `rocksteady.find_bifurcations`; or branches from `rocksteady.branches.find_branches`
        and `rocksteady.branches.find_resting_branches`, all over one parameter, or a sweep alone.
    sweeps
        From `rocksteady.orbits.sweep_attractor`, over the same parameter; those of a diagram are
        drawn.
    ax
        Axes to draw on; default: axes of a new figure.
    side
        "positive" draws the size of every extreme: what leans has its higher and its lower peaks in
        one half of the picture, and nothing is lost.  "both" draws each to its side, of what leans
        the mirror image too.
    top
        Upper end of the axis of angles, in units of alpha; default: everything is shown.
    key
        Where the legend goes by default: inside the axes, or outside, which is below them.
    legend
        "inside" the axes, to their "right", "below" them or "none".

    Returns
    -------
    matplotlib.axes.Axes
        The axes: the parameter, and the extreme of each flight.

    Raises
    ------
    ModelError
        If they are over different parameters, or there are none.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import DimensionlessBlock, Harmonic, find_orbits
    >>> from rocksteady.branches import find_branches
    >>> shaking = Harmonic(amplitude=2.0, frequency_ratio=2.2)
    >>> starts = find_orbits(DimensionlessBlock(restitution=0.8), shaking, max_period=1)
    >>> branches = find_branches(starts[:1], "frequency_ratio", (1.6, 2.4), max_period=1)
    >>> axes = plot_bifurcations(branches, ax=Figure().add_subplot())
    >>> for word in sorted(word.get_text() for word in axes.texts):
    ...     print(word)
    period doubles 1.79
    symmetric
    symmetry breaks 1.95
    tipping angle
    unsymmetric
    """
    top = None if top is None else positive("top", top, hint="give where the axis ends")
    branches, resting, swept = _parts(diagram)
    drawn = _Diagram(branches, resting, [*swept, *sweeps])
    view = view_of(drawn.parameter, drawn.block, side)
    axes = axes_or_new(ax)
    place = place_of(axes, legend, "below" if key == "beside" else "inside", width=160.0)
    drawn.draw(axes, view, top)
    drawn.explain(axes, view, place)
    return axes


class _Diagram:
    """Branches, those of orbits with rest, and sweeps over one parameter."""

    def __init__(
        self,
        branches: Sequence[Branch],
        resting: Sequence[RestingBranch],
        sweeps: Sequence[AttractorSweep],
    ) -> None:
        self.branches, self.resting, self.sweeps = branches, resting, sweeps
        self.everything: list[Branch | RestingBranch | AttractorSweep]
        self.everything = [*branches, *resting, *sweeps]
        self.parameter = _parameter(self.everything)
        self.block = shared_size(each.block for each in self.everything)

    def draw(self, axes: "Axes", view: View, top: float | None) -> None:
        """Draw everything but names and the legend."""
        inks = inks_of(axes)
        self.marks = bifurcations_of(self.branches, view)
        self.spots = [spot for places in self.marks.values() for spot in places]
        self.flights, looks = draw_branches(axes, self.branches, inks, view)
        rests = draw_resting(axes, self.resting, view)
        self.flights += [Flight(each, LABEL, inks.quiet, True) for each in rests]
        looks |= {"solid: stable"} if rests else set()
        self.note = ", ".join(word for word in LOOKS if word in looks)
        draw_bifurcations(axes, self.marks)
        self.fates = draw_sweeps(axes, self.sweeps, view)
        self.lanes = lane_of(axes) * len(self.sweeps)
        self._set_axes(axes, view, top)
        blocks = [each.block for each in self.everything]
        self.tipping = _drawn_tipping(axes, blocks, self.block, view)
        self.far = draw_far_axes(axes, view.across, view.up)
        if self.far and self.sweeps:  # whose names stand above the highest tick
            far, ends = axes.child_axes[-1], np.array(axes.get_ylim()) / view.up.factor
            ticks = far.yaxis.get_major_locator().tick_values(*ends.tolist())
            highest = ends[1] - (self.lanes + 0.03) * np.ptp(ends)
            far.set_yticks([y for y in ticks if ends[0] <= y < highest])

    def _set_axes(self, axes: "Axes", view: View, top: float | None) -> None:
        """Set scales, limits and labels of both axes."""
        ends = view.x(np.concatenate([each.values for each in self.everything]))
        by_ratio = any(spaced_by_ratio(sweep.values) for sweep in self.sweeps)
        if by_ratio or _lies_low([x for x, _ in self.spots], ends):
            axes.set_xscale("log")
        if ends.min() < ends.max():
            axes.set_xlim(float(ends.min()), float(ends.max()))
        plain_ticks(axes)
        if top is None:  # above what is drawn there is room for the bars
            drawn = [branch.peaks.ravel() for branch in self.branches]
            drawn += [branch.peaks.ravel() for branch in self.resting]
            drawn += [peaks for sweep in self.sweeps for peaks in sweep.peaks]
            highest = float(np.nanmax(np.abs(np.concatenate(drawn)), initial=0.0))
            top = max(highest, 1.0 if highest > NEAR_TIPPING else 0.0)
            top = (top or 1.0) / (0.96 - self.lanes)
        axes.set_ylim(0.0 if view.sizes else -top * view.up.factor, top * view.up.factor)
        axes.set(xlabel=view.across.label, ylabel=view.up.label)

    def explain(self, axes: "Axes", view: View, place: LegendPlace) -> None:
        """Name bifurcations, kinds of motion and the tipping angle; the legend has the rest."""
        labels = {flight.label for flight in self.flights}
        self._draw_legend(axes, place, {*labels, *self.marks, *self.tipping})
        lines = [*(flight.places for flight in self.flights), *self.tipping.values()]
        words = Words(axes, lines, [dots_of(sweep, view) for sweep in self.sweeps])
        words.take(self.spots, 3.0)
        words.take_box(0.0, 1.0 - self.lanes, 1.0, 1.0)
        present = axes.get_legend()
        if present is not None and place == "inside":
            words.take_box(*_box_within(axes, present.get_window_extent()))
        low, crowd = low_rest(axes, self.resting, view), crowd_of(axes, self.spots)
        inset = None
        shown = low or crowd
        if shown is not None and place != "inside":  # which needs the room
            inset = self._draw_inset(axes, view, shown)
        if inset is not None:
            x0, y0, x1, y1 = _box_within(axes, inset.bbox)
            words.take_box(x0 - 0.06, y0 - 0.06, x1, y1)
        crowds = [each for each in (low, crowd) if each is not None]
        named = _named_points(words, self.branches, view, crowds)
        kinds = {
            kind for kind, spots in self.marks.items() if {(kind, x) for x, _ in spots} <= named
        }
        kept = _named_lines(words, self.flights, [*self.tipping])
        self._draw_legend(axes, place, kept | kinds)

    def _draw_inset(self, axes: "Axes", view: View, crowd: Box) -> "Axes | None":
        lines = [np.asarray(line.get_xydata()) for line in axes.lines]
        inset = draw_inset(axes, crowd, lines, self.spots)
        if inset is not None:
            draw_branches(inset, self.branches, inks_of(axes), view)
            draw_resting(inset, self.resting, view)
            draw_bifurcations(inset, self.marks)
            draw_dots(inset, self.sweeps, view)
        return inset

    def _draw_legend(
        self, axes: "Axes", place: LegendPlace, names: AbstractSet[str | PointType]
    ) -> None:
        """Draw the legend of what has no name in the picture."""
        handles = _entries(self.flights, self.marks, names, axes) + self.fates
        left = [name for name in self.tipping if name not in names]
        handles += limit_entries(axes, left)
        gap = GAP + NAMES_WIDTH * bool(self.sweeps) + FAR_ROOM * self.far
        explain(axes, place, handles, self.note, gap=gap)


def _box_within(axes: "Axes", box: "Bbox") -> tuple[float, float, float, float]:
    """Return the ends of a box in parts of the axes."""
    (x0, y0), (x1, y1) = axes.transAxes.inverted().transform(box)
    return float(x0), float(y0), float(x1), float(y1)


def _parts(
    diagram: Drawn | Iterable[Branch | RestingBranch],
) -> tuple[list[Branch], list[RestingBranch], list[AttractorSweep]]:
    """Return the branches, those of orbits with rest, and the sweeps of what is drawn."""
    if isinstance(diagram, BifurcationDiagram):
        return list(diagram.branches), list(diagram.resting), list(diagram.sweeps)
    if isinstance(diagram, AttractorSweep):
        return [], [], [diagram]
    if isinstance(diagram, RestingBranches):
        return [], list(diagram.branches), []
    each = [diagram] if isinstance(diagram, Branch | RestingBranch) else list(diagram)
    return (
        [branch for branch in each if isinstance(branch, Branch)],
        [branch for branch in each if isinstance(branch, RestingBranch)],
        [],
    )


def _lies_low(marked: Sequence[float], ends: Floats) -> bool:
    """Return whether nearly all bifurcations lie in the lowest part of a wide axis."""
    low, high = float(ends.min()), float(ends.max())
    if len(marked) < CROWDED or not 0.0 < WIDE * low < high:
        return False
    return float(np.quantile(marked, 0.9)) < low + LOWEST_PART * (high - low)


def _parameter(drawn: Sequence[Branch | RestingBranch | AttractorSweep]) -> str:
    """Return the parameter over which all that is drawn is.

    Raises
    ------
    ModelError
        If there are several, or none.
    """
    names = sorted({each.parameter for each in drawn})
    if len(names) != 1:
        raise InputError(
            "branches",
            ", ".join(names) or "none",
            "they must all be over one parameter, and there must be one",
            "draw others on axes of their own",
        )
    return names[0]


def _entries(
    flights: Sequence[Flight],
    marks: Marks,
    named: AbstractSet[str | PointType],
    axes: "Axes",
) -> "list[Artist]":
    """Return the entries of a legend for what has no name in the picture."""
    from matplotlib.lines import Line2D

    colours = {flight.label: flight.colour for flight in flights}
    handles: list[Artist] = [
        Line2D([], [], color=colour, lw=RESTING["lw"] if label == LABEL else 2.0, label=label)
        for label, colour in colours.items()
        if label not in named
    ]
    looks = {kind: mark_of(kind, axes) for kind in marks if kind not in named}
    return handles + [Line2D([], [], label=name_of(kind), **look) for kind, look in looks.items()]


def _drawn_tipping(
    axes: "Axes", blocks: Sequence[AnyBlock], sized: Block | None, view: View
) -> dict[str, Floats]:
    """Draw the tipping angle of each side within the axes, and return the lines by their names."""
    bare = blocks[0].dimensionless()
    tilts = {"": 1.0}
    if not bare.one_sided and not (bare.symmetric and view.sizes):
        tilts = {", positive side": 1.0, ", negative side": -bare.alpha_ratio}
    drawn = {}
    for side, tilt in tilts.items():
        y = float(view.y(tilt))
        low, high = axes.get_ylim()
        if low < y < high:
            name = f"tipping angle{side}" + (f" {abs(y):.3g}°" if sized else "")
            drawn[name] = np.array([[x, y] for x in axes.get_xlim()])
            axes.axhline(y, color=inks_of(axes).limit, ls=DASHED, lw=0.8, zorder=2.2)
    return drawn


def _named_points(
    words: Words, branches: Sequence[Branch], view: View, crowds: Sequence[Box]
) -> set[Named]:
    """Name the ends of the longest stable parts; return type and place of what has its name.

    In a crowd there is room for none.
    """
    points: dict[Named, tuple[float, int, float]] = {}
    for branch in branches:
        for stretch in branch.stretches:
            ends = (stretch.first, stretch.last)
            length = abs(float(np.subtract(*branch.values[[*ends]])))
            for index in ends:
                kind = branch.points[index].type
                if kind in EVENTS:
                    x, y = max(spots_of(branch, index, view), key=lambda spot: spot[1])
                    longest, period, _ = points.get((kind, x), (0.0, branch.period, y))
                    longest = max(longest, length if stretch.stable else 0.0)
                    points[kind, x] = (longest, min(period, branch.period), y)
    stable = [
        (kind, x)
        for (kind, x), (length, _, y) in points.items()
        if length > 0.0 and not any(x0 <= x <= x1 and y0 <= y <= y1 for x0, y0, x1, y1 in crowds)
    ]
    stable.sort(key=lambda point: -points[point][0])
    named = set()
    for kind, x in stable[:MOST_NAMED]:
        _, period, y = points[kind, x]
        again = kind is PointType.PERIOD_DOUBLING and period % 2 == 0
        if words.beside((x, y), f"{'doubles again' if again else EVENTS[kind]} {x:.3g}"):
            named.add((kind, x))
    return named


def _named_lines(words: Words, flights: Sequence[Flight], tipping: Sequence[str]) -> set[str]:
    """Name the tipping angle and the kinds of motion; return the names that stand there."""
    long = [
        flight.stable and words.length(number) > LONG_ENOUGH
        for number, flight in enumerate(flights)
    ]
    solid = {flight.label for flight, enough in zip(flights, long, strict=True) if enough}
    names = [
        flight.label if enough or flight.label not in solid else ""
        for flight, enough in zip(flights, long, strict=True)
    ]
    ink = inks_of(words.axes).ink
    colours = [flight.colour for flight in flights] + [ink] * len(tipping)
    return words.along([*names, *tipping], colours, aside=True, once=True)
