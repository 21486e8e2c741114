"""Plots of branches of periodic motions over a parameter, with sweeps beneath them."""

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.dynamics.continuation.chains.point_types import PointType
from rocksteady.dynamics.continuation.diagram import BifurcationDiagram
from rocksteady.dynamics.continuation.points import Branch
from rocksteady.dynamics.continuation.resting.find_resting import RestingBranches
from rocksteady.dynamics.continuation.resting.resting_branch import RestingBranch
from rocksteady.dynamics.orbits.attractor_sweep import AttractorSweep
from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import positive
from rocksteady.show.plots.branches._resting import draw_resting, low_rest
from rocksteady.show.plots.branches._sweeps import NAMES_WIDTH, draw_dots, draw_sweeps
from rocksteady.show.style import palette
from rocksteady.show.style.axes import lane_of
from rocksteady.show.style.insets import crowd_of, draw_inset
from rocksteady.show.style.layout import axes_or_new, plain_ticks, spaced_by_ratio
from rocksteady.show.style.legends import GAP, LegendPlace, draw_legend, line_scale, place_of
from rocksteady.show.style.line_colours import Inks, inks_of

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.lines import Line2D

Side = Literal["positive", "both"]
Drawn = BifurcationDiagram | Branch | RestingBranch | RestingBranches | AttractorSweep

STABLE: dict[str, Any] = {"ls": "-", "lw": 1.9, "zorder": 3.0}
UNSTABLE: dict[str, Any] = {"ls": (0, (3.2, 1.6)), "lw": 0.9, "zorder": 2.6}
INADMISSIBLE: dict[str, Any] = {"ls": (0, (1, 1.6)), "lw": 0.9, "alpha": 0.5, "zorder": 2.4}
MARKS = {
    PointType.FOLD: "s",
    PointType.SYMMETRY_BREAKING: "D",
    PointType.PERIOD_DOUBLING: "^",
    PointType.GRAZING: "o",
}
"""Marker of each bifurcation."""
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
    which are stable, from all of these; a dot at the highest angle marks an end of these.
    Bifurcations are marked at the highest and at the lowest angle of their orbits.  The motions
    that a sweep meets are dots beneath the lines, larger ones of an upward sweep than of a downward
    one, so that both show where they agree; elsewhere there is hysteresis.  Bars along the upper
    edge, a row for each sweep, show where its motion overturned or came to rest.  The axis of the
    parameter is logarithmic where a sweep's values are spaced by ratio, as `numpy.geomspace` does,
    and where nearly all bifurcations lie in its lowest part.  Bifurcations that crowd in a
    small part of the picture are drawn again in an inset, large enough to be distinguished; where
    orbits that come to rest lie close to the axis, the inset shows these.

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
        Upper end of the axis of angles; default: everything is shown.
    key
        Where the legend goes by default: to the right of the axes, or inside; below narrow ones.
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
    >>> for entry in axes.get_legend().get_texts():
    ...     print(entry.get_text())
    symmetric
    unsymmetric
    unstable
    symmetry breaking
    period doubling
    """
    top = None if top is None else positive("top", top, hint="give where the axis ends")
    listed, resting, swept = _parts(diagram)
    swept += list(sweeps)
    parameter = _parameter([*listed, *resting, *swept])
    axes = axes_or_new(ax)
    inks = inks_of(axes)
    place = place_of(axes, legend, "right" if key == "beside" else "inside", width=110.0)
    colours = _colours(listed, inks)
    marks = _bifurcations(listed, side)
    handles: list[Artist] = [
        *_drawn_branches(axes, listed, colours, side),
        *draw_resting(axes, resting, sizes=side == "positive"),
        *_drawn_bifurcations(axes, marks),
        *draw_sweeps(axes, swept, sizes=side == "positive"),
    ]
    values = [branch.values for branch in listed] + [branch.values for branch in resting]
    values += [sweep.values for sweep in swept]
    ends = np.concatenate(values)
    marked = [x for places in marks.values() for x, _ in places]
    if any(spaced_by_ratio(sweep.values) for sweep in swept) or _lies_low(marked, ends):
        axes.set_xscale("log")
        plain_ticks(axes)
    if ends.min() < ends.max():
        axes.set_xlim(float(ends.min()), float(ends.max()))
    if top is None:  # above what is drawn there is room for the bars
        drawn = [branch.peaks.ravel() for branch in listed]
        drawn += [branch.peaks.ravel() for branch in resting]
        drawn += [peaks for sweep in swept for peaks in sweep.peaks]
        highest = float(np.nanmax(np.abs(np.concatenate(drawn)), initial=0.0))
        top = (highest or 1.0) / (0.96 - lane_of(axes) * len(swept))
    axes.set_ylim(0.0 if side == "positive" else -top, top)
    axes.set(
        xlabel=palette.LABELS[parameter],
        ylabel=palette.LABELS["flight_peak" if side == "positive" else "flight_extreme"],
    )
    if place != "inside":  # which needs the room
        spots = [spot for places in marks.values() for spot in places]
        crowd = low_rest(axes, resting, sizes=side == "positive") or crowd_of(axes, spots)
        if crowd is not None:
            drawn_at = [line.get_xydata() for line in axes.lines]
            inset = draw_inset(axes, crowd, [np.asarray(each) for each in drawn_at], spots)
            _drawn_branches(inset, listed, colours, side)
            draw_resting(inset, resting, sizes=side == "positive")
            _drawn_bifurcations(inset, marks)
            draw_dots(inset, swept, sizes=side == "positive")
    gap = GAP + (NAMES_WIDTH if swept else 0.0)
    draw_legend(axes, place, handles=handles, corner="upper right", gap=gap)
    return axes


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


def _kind_of(branch: Branch) -> tuple[int, bool]:
    """Return the properties by which branches differ in colour."""
    return branch.period, not branch.symmetric


def _colours(branches: Sequence[Branch], inks: Inks) -> dict[tuple[int, bool], str]:
    """Return the colour of each kind of orbit that there is."""
    colours = {(1, False): inks.lines[0], (1, True): inks.lines[4]}
    kinds = sorted({_kind_of(branch) for branch in branches})
    for number, kind in enumerate(kind for kind in kinds if kind[0] > 1):
        shades = inks.subharmonic_lines
        colours[kind] = shades[min(number, len(shades) - 1)]
    return {kind: colours[kind] for kind in kinds}


def _label(kind: tuple[int, bool], kinds: Iterable[tuple[int, bool]]) -> str:
    """Return the words for a kind of orbit; its symmetry only where that distinguishes it."""
    period, leaning = kind
    word = "unsymmetric" if leaning else "symmetric"
    if period == 1:
        return word
    if period % 2 == 0 and (period, not leaning) not in kinds:
        return f"period {period}"
    return f"{word}, period {period}"


def _sided(peaks: Floats, side: Side, branch: Branch) -> Floats:
    """Return what is drawn of the extremes of flights, shape (points, lines)."""
    symmetric = branch.symmetric
    # Of two impacts that merge the flight between them vanishes: its extreme is 0.
    peaks = np.nan_to_num(peaks, nan=0.0)
    if side == "positive":
        return np.abs(peaks[..., : peaks.shape[-1] // 2] if symmetric else peaks)
    # The mirror image of what leans; for a block whose sides differ it is no motion.
    leans = not symmetric and branch.block.symmetric
    return np.concatenate([peaks, -peaks], axis=-1) if leans else peaks


def _drawn_branches(
    axes: "Axes",
    branches: Sequence[Branch],
    colours: dict[tuple[int, bool], str],
    side: Side,
) -> list["Line2D"]:
    """Draw branches and return the entries of the legend."""
    from matplotlib.lines import Line2D

    seen: set[str] = set()
    scale = line_scale(axes)
    for branch in branches:
        lines = _sided(branch.peaks, side, branch)
        for stretch in branch.stretches:
            style, word = UNSTABLE, "unstable"
            if stretch.stable:
                style, word = STABLE, "stable"
            elif not stretch.admissible:
                style, word = INADMISSIBLE, "no motion"
            seen.add(word)
            part = slice(stretch.first, stretch.last + 1)
            look = {**style, "lw": style["lw"] * scale}
            axes.plot(branch.values[part], lines[part], color=colours[_kind_of(branch)], **look)
    handles = [
        Line2D([], [], color=colour, lw=2.0, label=_label(kind, colours))
        for kind, colour in colours.items()
    ]
    for word, style in (("unstable", UNSTABLE), ("no motion", INADMISSIBLE)):
        if word in seen:
            handles.append(Line2D([], [], color=inks_of(axes).ink, label=word, **style))
    return handles


def _bifurcations(
    branches: Sequence[Branch], side: Side
) -> dict[PointType, list[tuple[float, float]]]:
    """Return where bifurcations of each type are marked."""
    marks = {}
    for kind in MARKS:
        places: set[tuple[float, float]] = set()
        for branch in branches:
            for value, peaks, point in zip(branch.values, branch.peaks, branch.points, strict=True):
                if point.type is kind:
                    ends = np.array([max(np.nanmax(peaks), 0.0), min(np.nanmin(peaks), 0.0)])
                    drawn = _sided(ends, side, branch)
                    # A point on two branches is marked once.
                    places |= {(round(float(value), 9), round(u, 6)) for u in drawn.tolist()}
        if places:
            marks[kind] = sorted(places)
    return marks


def _drawn_bifurcations(
    axes: "Axes", marks: dict[PointType, list[tuple[float, float]]]
) -> list["Line2D"]:
    """Mark bifurcations and return the entries of the legend."""
    from matplotlib.lines import Line2D

    handles, inks = [], inks_of(axes)
    for kind, places in marks.items():
        style: dict[str, Any] = {
            "marker": MARKS[kind],
            "ms": 3.8 * line_scale(axes),
            "mfc": inks.paper,
            "mec": inks.ink,
            "mew": 0.8,
            "ls": "none",
        }
        x, y = zip(*places, strict=True)
        axes.plot(x, y, zorder=4.0, **style)
        handles.append(Line2D([], [], label=name_of(kind), **style))
    return handles


def name_of(kind: PointType) -> str:
    """Return the name of a bifurcation in a legend."""
    return "graze" if kind is PointType.GRAZING else kind.value.replace("-", " ")
