"""Attractors along a swept parameter, drawn as dots and bars."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.dynamics.orbits.attractor_sweep import AttractorSweep
from rocksteady.outcomes import AttractorKind
from rocksteady.show.plots.branches.views import View
from rocksteady.show.style.axes import lane_of, name_lane, runs
from rocksteady.show.style.legends import figure_of, line_scale
from rocksteady.show.style.tokens import HATCHES, Inks, inks_of

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes


SWEEPS = {1: ("upward sweep", "^", "quiet", "up"), -1: ("downward sweep", "v", "edge", "down")}
"""Name, marker, colour role and short name of each sweep, by direction."""
SIZE, CLOUD = 3.6, 1.5
"""Size of dots, and of those of motions that do not repeat."""
APERIODIC = AttractorKind.APERIODIC.label
FATES = {kind.plain: kind for kind in (AttractorKind.OVERTURNED, AttractorKind.REST)}
"""The kind of attractor that each bar along the upper edge shows; one row per sweep."""
ASIDE = 2.0
"""Distance of the dots of a sweep from what they mean, up or down [points]."""
NAMES_WIDTH = 24.0
"""Of the names of the rows, to the right of the axes [points]."""


def draw_sweeps(axes: "Axes", sweeps: Sequence[AttractorSweep], view: View) -> "list[Artist]":
    """Draw the dots and bars of sweeps and return the entries of the legend.

    Parameters
    ----------
    axes
        Axes to draw on, with room for a row of bars a sweep along its upper edge.
    sweeps
        The sweeps.
    view
        Scales of the diagram.
    """
    from matplotlib.patches import Patch

    inks, lane = inks_of(axes), lane_of(axes)
    handles: dict[str, Artist] = draw_dots(axes, sweeps, view)
    for row, sweep in enumerate(sweeps):
        low = 1.0 - (row + 1) * lane
        drawn: list[tuple[float, float]] = []
        for fate, kind in FATES.items():
            bars = _bars(sweep, kind, view)
            if bars:
                drawn += bars
                edges, look = axes.get_xaxis_transform(), _look(fate, inks)
                axes.broken_barh(bars, (low, 0.75 * lane), transform=edges, zorder=4.5, **look)
                handles[fate] = Patch(label=fate, **look)
        if drawn:
            name_lane(axes, SWEEPS[_way(sweep)][3], drawn, low + 0.375 * lane, inks.quiet)
    return sorted(handles.values(), key=lambda handle: str(handle.get_label()) in FATES)


def draw_dots(axes: "Axes", sweeps: Sequence[AttractorSweep], view: View) -> "dict[str, Artist]":
    """Draw what sweeps meet and return the entries of the legend by their labels."""
    from matplotlib.lines import Line2D
    from matplotlib.transforms import ScaledTranslation

    inks, scale, figure = inks_of(axes), line_scale(axes), figure_of(axes)
    handles: dict[str, Artist] = {}
    for sweep in sweeps:
        way = _way(sweep)
        word, marker, role, _ = SWEEPS[way]
        # Sweeps that meet the same motions stand apart, on both sides of its line.
        aside = ScaledTranslation(0.0, way * ASIDE / 72.0, figure.dpi_scale_trans)
        looks: dict[str, dict[str, Any]] = {
            word: {"marker": marker, "ms": SIZE, "color": getattr(inks, role), "mfc": inks.paper,
                   "mew": 0.7, "transform": axes.transData + aside},
            APERIODIC: {"marker": "o", "ms": CLOUD, "color": inks.aperiodic_line, "mew": 0.0},
        }  # fmt: skip
        for label, look in looks.items():
            chosen = [
                (kind == AttractorKind.APERIODIC) == (label == APERIODIC) for kind in sweep.kinds
            ]
            places = dots_of(sweep, view, chosen)
            if len(places):
                drawn = {**look, "ls": "none", "ms": scale * look["ms"]}
                axes.plot(*places.T, zorder=2.0 - 0.1 * way, **drawn)
                key = {**look, "ls": "none", "ms": SIZE, "transform": None}
                handles[label] = Line2D([], [], label=label, **key)
    return handles


def dots_of(sweep: AttractorSweep, view: View, chosen: Sequence[bool] | None = None) -> Floats:
    """Return the places of the dots of a sweep, of chosen values alone, shape (dots, 2)."""
    chosen = [True] * len(sweep.values) if chosen is None else chosen
    places = [
        np.column_stack([np.full(extremes.shape, view.x(value)), view.y(extremes)])
        for value, extremes, drawn in zip(sweep.values, sweep.peaks, chosen, strict=True)
        if drawn
    ]
    return np.concatenate([np.empty((0, 2)), *places])


def _way(sweep: AttractorSweep) -> int:
    return 1 if sweep.values[-1] >= sweep.values[0] else -1


def _look(fate: str, inks: Inks) -> dict[str, Any]:
    """Return the look of a bar; its hatch has the colour of its outline."""
    if fate == "falls":
        return {"fc": inks.falls, "ec": inks.edge, "lw": 0.5, "hatch": HATCHES["falls"]}
    return {"fc": inks.rest, "ec": inks.edge, "lw": 0.5}


def _bars(sweep: AttractorSweep, kind: AttractorKind, view: View) -> list[tuple[float, float]]:
    """Return begin and width of each run of values at which a sweep's motion ended so."""
    order = np.argsort(sweep.values)
    values = view.x(sweep.values[order])
    present = np.array([sweep.kinds[index] == kind for index in order])
    # Each value stands for what is nearest to it.
    borders = np.concatenate([values[:1], 0.5 * (values[1:] + values[:-1]), values[-1:]])
    return runs(present, borders)
