"""Drawing of an object to true scale: outline, edges, mass centre and slenderness."""

import math
from typing import TYPE_CHECKING

import numpy as np

from rocksteady.results.numbers import length, number
from rocksteady.risk.assess.described.objects import DescribedObject
from rocksteady.seismic.measures.free_sides import first_side
from rocksteady.show.style import palette
from rocksteady.show.style.tokens import DOTTED, inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

WIDTH, TALLEST, LOWEST = 3.0, 3.4, 1.6
"""Of the figure [inches]."""
BESIDE = 0.32
"""Room to either side of the object, in its larger size."""
SMALL = 8.0
"""Size of text [points]."""


def draw_object(described: DescribedObject) -> "Figure":
    """Draw an object on its two edges, in metres or millimetres.

    Where the outline is not given, a dotted line stands for it, twice as high as the mass centre,
    and says so.
    """
    from matplotlib.figure import Figure

    block = described.block
    left, right = block.positive.distance, block.negative.distance
    centre = (0.5 * (left - right), block.positive.centre_height)
    shape = described.given.geometry
    width, height = left + right + sum(block.overhangs), block.height
    known = shape.height_m is not None or shape.p_rad_s is not None
    size = max(width, height)
    factor, unit = (1.0, "m") if size >= 1.0 else (1000.0, "mm")
    margin = BESIDE * size
    across, up = width + 2.0 * margin, height * 1.09 + 0.2 * size
    with palette.style():
        figure = Figure(figsize=(WIDTH, min(TALLEST, max(LOWEST, 0.9 * WIDTH * up / across))))
        axes = figure.add_subplot()
        inks = inks_of(axes)
        words = "" if known else "outline not given"
        if block.cap is not None:
            words = f"each of {block.cap.columns} columns under a cap"
        _draw_body(axes, factor * width, factor * height, known=known, words=words)
        _draw_ground(axes, factor * (0.5 * width + margin), factor * size)
        half = 0.5 * factor * (left + right)
        x, y = factor * centre[0], factor * centre[1]
        for edge in (-half, half):
            axes.plot([edge, x], [0.0, y], color=inks.ink, lw=0.8, zorder=3.0)
        axes.plot([-half, half], [0.0, 0.0], "^", ms=7.0, color=inks.ink, zorder=4.0)
        axes.plot([x, x], [0.0, y], color=inks.quiet, lw=0.7, zorder=2.9)
        axes.plot([x], [y], "o", ms=7.0, mfc=inks.paper, mec=inks.ink, mew=1.3, zorder=4.0)
        _write_angle(axes, described, (half, x, y))
        axes.annotate(
            f"mass centre\n{length(centre[1])} up", (x, y),
            (factor * (0.5 * width + 0.04 * size), y), va="center", fontsize=SMALL,
            arrowprops={"arrowstyle": "-", "color": inks.quiet, "lw": 0.6, "shrinkB": 5.0},
        )  # fmt: skip
        axes.set_aspect("equal")
        axes.set(
            xlim=(-factor * 0.5 * across, factor * 0.5 * across),
            ylim=(-0.12 * factor * size, factor * 1.09 * height),
            xlabel=f"position [{unit}]",
            ylabel=f"height [{unit}]",
        )
        axes.locator_params(axis="x", nbins=4)
        axes.grid(visible=False)
    return figure


def _draw_body(axes: "Axes", width: float, height: float, *, known: bool, words: str) -> None:
    """Draw the outline, with words above it."""
    from matplotlib.patches import Rectangle

    inks = inks_of(axes)
    axes.add_patch(
        Rectangle(
            (-0.5 * width, 0.0), width, height, facecolor=inks.rest,
            edgecolor=inks.ink, lw=1.1, ls="-" if known else DOTTED, zorder=2.0,
        )
    )  # fmt: skip
    if words:
        axes.annotate(
            words, (0.0, height), (0.0, 3.0), textcoords="offset points",
            ha="center", va="bottom", fontsize=SMALL, color=inks.quiet,
        )  # fmt: skip


def _draw_ground(axes: "Axes", half: float, size: float) -> None:
    """Draw the ground with its hatching."""
    inks, deep = inks_of(axes), 0.035 * size
    axes.plot([-half, half], [0.0, 0.0], color=inks.ink, lw=1.1, zorder=2.2)
    for place in np.arange(-half + deep, half, deep):
        axes.plot([place, place - 0.7 * deep], [0.0, -0.7 * deep], color=inks.edge, lw=0.6)


def _write_angle(
    axes: "Axes", described: DescribedObject, place: tuple[float, float, float]
) -> None:
    """Draw the slenderness of the side that lifts first, between edge, mass centre and vertical."""
    from matplotlib.patches import Arc

    (half, x, y), inks = place, inks_of(axes)
    side = first_side(described.block)
    sign = -1.0 if side.distance == described.block.positive.distance else 1.0
    reach = 0.55 * y
    degrees = math.degrees(side.alpha)
    ends = (270.0 - degrees, 270.0) if sign < 0.0 else (270.0, 270.0 + degrees)
    axes.add_patch(
        Arc((x, y), 2 * reach, 2 * reach, theta1=ends[0], theta2=ends[1],
            color=inks.ink, lw=1.3, zorder=3.2)
    )  # fmt: skip
    angle = 0.5 * side.alpha
    at = (x + sign * reach * math.sin(angle), y - reach * math.cos(angle))
    axes.annotate(
        f"α = {number(degrees)}°", at, (sign * (half + 0.1 * y), at[1]),
        ha="right" if sign < 0.0 else "left", va="center",
        fontsize=SMALL, color=inks.ink,
        arrowprops={"arrowstyle": "-", "color": inks.ink, "lw": 0.6, "shrinkB": 0.0},
    )  # fmt: skip
