"""Attractors along a swept parameter, drawn as dots and bars."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.dynamics.orbits.attractor_sweep import AttractorSweep
from rocksteady.show.style import palette
from rocksteady.show.style.axes import lane_of, name_lane, runs
from rocksteady.show.style.legends import line_scale
from rocksteady.show.style.line_colours import inks_of

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes


SWEEPS = {1: ("upward sweep", 0, 4.2, "up"), -1: ("downward sweep", 1, 3.1, "down")}
"""Name, number of the colour, size of the dots and short name of a sweep by its direction: a rim of
a point shows around a line."""
CLOUD = 1.5
"""Size of dots where a value has more than `MOST_DOTS`."""
MOST_DOTS = 32
FATES: dict[str, dict[str, Any]] = {
    "overturned": {"fc": palette.OVERTURNED, "ec": "none", "lw": 0.0},
    "at rest": {"fc": palette.GROUND, "ec": palette.FAINT, "lw": 0.4},
}
"""Look of the bars along the upper edge, one row per sweep."""
KINDS = {"overturned": "overturned", "at rest": "rest"}
"""The kind of attractor that each bar shows."""
NAMES_WIDTH = 24.0
"""Of the names of the rows, to the right of the axes [points]."""


def draw_sweeps(axes: "Axes", sweeps: Sequence[AttractorSweep], *, sizes: bool) -> list["Artist"]:
    """Draw the dots and bars of sweeps and return the entries of the legend.

    Parameters
    ----------
    axes
        Axes to draw on, with room for a row of bars a sweep along its upper edge.
    sweeps
        The sweeps.
    sizes
        Whether the sizes of the angles are drawn, without their sides.
    """
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    handles: dict[str, Artist] = {}
    inks, lane = inks_of(axes), lane_of(axes)
    draw_dots(axes, sweeps, sizes=sizes)
    for row, sweep in enumerate(sweeps):
        way = 1 if sweep.values[-1] >= sweep.values[0] else -1
        word, number, size, short = SWEEPS[way]
        colour = inks.sweeps[number]
        style: dict[str, Any] = {"marker": "o", "color": colour, "mew": 0.0, "ls": "none"}
        if any(len(extremes) for extremes in sweep.peaks):
            handles[word] = Line2D([], [], ms=size, label=word, **style)
        low = 1.0 - (row + 1) * lane
        met = False
        for fate, usual in FATES.items():
            # The dark fill of a fall needs an outline on dark paper.
            look = {**usual, "ec": inks.ink, "lw": 0.6} if inks.dark else usual
            bars = _bars(sweep, fate)
            if bars:
                met = True
                edges = axes.get_xaxis_transform()
                axes.broken_barh(bars, (low, 0.75 * lane), transform=edges, zorder=4.5, **look)
                handles[fate] = Patch(label=fate, **look)
        if met:
            name_lane(axes, short, low + 0.375 * lane, inks.number)
    return sorted(handles.values(), key=lambda handle: str(handle.get_label()) in FATES)


def draw_dots(axes: "Axes", sweeps: Sequence[AttractorSweep], *, sizes: bool) -> None:
    """Draw what sweeps meet; the parameters are those of `draw_sweeps`."""
    inks, scale = inks_of(axes), line_scale(axes)
    for sweep in sweeps:
        way = 1 if sweep.values[-1] >= sweep.values[0] else -1
        _, number, size, _ = SWEEPS[way]
        dots: dict[float, list[Floats]] = {size: [], CLOUD: []}
        for value, extremes in zip(sweep.values, sweep.peaks, strict=True):
            drawn = np.abs(extremes) if sizes else extremes
            dot = CLOUD if len(drawn) > MOST_DOTS else size
            dots[dot].append(np.column_stack([np.full(drawn.shape, value), drawn]))
        for big, places in dots.items():
            x, y = np.concatenate([np.empty((0, 2)), *places]).T
            look: dict[str, Any] = {"color": inks.sweeps[number], "mew": 0.0, "ls": "none"}
            axes.plot(x, y, marker="o", ms=big * scale, zorder=2.0 - 0.1 * way, **look)


def _bars(sweep: AttractorSweep, fate: str) -> list[tuple[float, float]]:
    """Return begin and width of each run of values at which a sweep's motion ended so."""
    order = np.argsort(sweep.values)
    values = sweep.values[order]
    present = np.array([sweep.kinds[index] == KINDS[fate] for index in order])
    # Each value stands for what is nearest to it.
    borders = np.concatenate([values[:1], 0.5 * (values[1:] + values[:-1]), values[-1:]])
    return runs(present, borders)
