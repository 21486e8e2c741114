"""Insets: a crowded part of a plot, magnified."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.show.style.legends import size_of, text_size
from rocksteady.show.style.tokens import inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Box = tuple[float, float, float, float]

FEWEST = 8
"""Marks that make a crowd."""
APART = 12.0
"""Distance of marks that do not touch [points]."""
LARGEST = 0.25
"""Side of a crowd, in parts of the axes; a larger one would hardly grow in an inset."""
SIZES = ((0.42, 0.4), (0.42, 0.3), (0.3, 0.3), (0.2, 0.26))
"""Widths and heights of insets, in parts of the axes; the first with room is drawn."""
MOST_HIDDEN = 0.02
"""Part of what is drawn that an inset may hide."""
CELL = 1.0 / 256.0
"""Parts of the axes within which all that is drawn counts once."""
LEAST_ROOM = (220.0, 120.0)
"""Width and height of axes [points] that have room for one."""


def crowd_of(axes: "Axes", marks: Sequence[tuple[float, float]]) -> Box | None:
    """Return the ends of the largest crowd of marks: x, y, x, y in the units of the axes.

    Parameters
    ----------
    axes
        With their final limits and scales.
    marks
        Abscissa and ordinate of each.

    Returns
    -------
    tuple or None
        None where marks are apart, or the axes have no room for an inset.
    """
    from scipy.cluster.hierarchy import fcluster, linkage

    size = np.array(size_of(axes))
    if not room_for_inset(axes) or len(marks) < FEWEST:
        return None
    points = np.array(marks)
    places = axes.transAxes.inverted().transform(axes.transData.transform(points))
    inside = ((places >= -1e-9) & (places <= 1.0 + 1e-9)).all(axis=1)
    points, places = points[inside], places[inside]
    if len(places) < FEWEST:
        return None
    groups = fcluster(linkage(places * size, "single"), APART, "distance")
    best: Box | None = None
    most = FEWEST - 1
    for group in np.unique(groups):
        among = groups == group
        low, high = places[among].min(axis=0), places[among].max(axis=0)
        if among.sum() > most and (high - low < LARGEST).all():
            most = int(among.sum())
            best = (*points[among].min(axis=0).tolist(), *points[among].max(axis=0).tolist())
    return best


def room_for_inset(axes: "Axes") -> bool:
    """Return whether axes are wide and high enough for an inset."""
    return all(side >= least for side, least in zip(size_of(axes), LEAST_ROOM, strict=True))


def draw_inset(
    axes: "Axes", crowd: Box, drawn: Sequence[Floats], marks: Sequence[tuple[float, float]]
) -> "Axes | None":
    """Return an inset, empty, where least is drawn, or None where it would hide too much.

    Parameters
    ----------
    axes
        With their final limits and scales.
    crowd
        From `crowd_of`.
    drawn
        Abscissas and ordinates of what is drawn, each of shape (points, 2).
    marks
        As for `crowd_of`; hidden least of all.
    """
    across = axes.transAxes.inverted()
    dense = [_dense(across.transform(axes.transData.transform(line))) for line in drawn]
    points = np.unique(np.round(np.concatenate(dense) / CELL), axis=0) * CELL  # ink, not samples
    spots = across.transform(axes.transData.transform(np.reshape(marks, (-1, 2))))
    corners = across.transform(axes.transData.transform(np.array(crowd).reshape(2, 2)))
    here = (*corners[0].tolist(), *corners[1].tolist())
    left, low = (24.0, 14.0) / np.array(size_of(axes))  # of the tick labels
    for wide, high in SIZES:
        choices = [
            (x, y, x + wide, y + high)
            for y in np.linspace(low + 0.05, 0.95 - high, 24).tolist()
            for x in np.linspace(left + 0.04, 0.97 - wide, 24).tolist()
        ]
        hidden, (x0, y0, x1, y1) = min(
            (_hidden((box[0] - left, box[1] - low, *box[2:]), points, spots, here), box)
            for box in choices
        )
        if hidden <= MOST_HIDDEN:
            break
    else:
        return None
    inset = axes.inset_axes((x0, y0, x1 - x0, y1 - y0), zorder=5.0)
    inks = inks_of(axes)
    inset.patch.set_facecolor(inks.paper)
    inset.set(xlim=_wider(crowd[0], crowd[2]), ylim=_wider(crowd[1], crowd[3], axes.get_ylim()))
    inset.tick_params(labelsize=text_size(axes, 7.0), length=2.0, colors=inks.ink)
    inset.locator_params(nbins=4)
    inset.grid(visible=False)
    for spine in inset.spines.values():
        spine.set(visible=True, edgecolor=inks.quiet, linewidth=0.8)
    axes.indicate_inset_zoom(inset, edgecolor=inks.quiet, alpha=1.0, lw=0.8)
    return inset


def _dense(path: Floats) -> Floats:
    """Return places along a path so close together that none of it is overlooked."""
    path = path[np.isfinite(path).all(axis=1)]
    if len(path) < 2:
        return path
    steps = np.linspace(0.0, 1.0, 9)[:, np.newaxis, np.newaxis]
    return (path[:-1] + steps * np.diff(path, axis=0)).reshape(-1, 2)


def _hidden(box: Box, points: Floats, marks: Floats, crowd: Box) -> float:
    """Return how much an inset with its tick labels would hide; nearer to its crowd is better."""
    x0, y0, x1, y1 = box[0], box[1], box[2] + 0.02, box[3] + 0.02
    if x0 < crowd[2] and crowd[0] < x1 and y0 < crowd[3] and crowd[1] < y1:
        return math.inf
    hidden = 0.0
    for places in (points, marks):
        x, y = places.T
        inside = (x > x0) & (x < x1) & (y > y0) & (y < y1)
        hidden += inside.sum() / max(len(inside), 1)
    middle = (
        0.5 * (x0 + x1) - 0.5 * (crowd[0] + crowd[2]),
        0.5 * (y0 + y1) - 0.5 * (crowd[1] + crowd[3]),
    )
    return hidden + 1e-3 * float(np.hypot(*middle))


def _wider(
    low: float, high: float, within: tuple[float, float] | None = None
) -> tuple[float, float]:
    """Return ends with a margin, for axes that are not cut off at others."""
    margin = 0.12 * (high - low) or 0.05 * max(abs(high), 1e-3)
    ends = low - margin, high + margin
    return ends if within is None else (max(ends[0], within[0]), ends[1])
