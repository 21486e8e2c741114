"""Axes of time histories: their scales and limits, the wall, and names of horizontal lines."""

import math
import re
from collections.abc import Sequence
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.dynamics.history.trajectory import Trajectory
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.motions.fourier import PeriodicMotion
from rocksteady.model.motions.segments import Motion
from rocksteady.outcomes import Status
from rocksteady.show.plots.records import Quantity
from rocksteady.show.style import palette
from rocksteady.show.style.layout import CORNERS, Corner, extent
from rocksteady.show.style.legends import size_of, text_size
from rocksteady.show.style.scales import Scale, scale_of
from rocksteady.show.style.tokens import inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

HEADROOM = 0.15
"""Part of the height of a time history that is left free above it for words and the legend."""
WALL_SHARE = 0.08
"""Depth of the wall below 0, in parts of the angles above it."""
Box = tuple[float, float, float, float]
"""Left and lower end, width and height, in parts of the axes."""


class TimeScale(NamedTuple):
    """How time is drawn.

    Attributes
    ----------
    factor
        Factor of pivot times before they are drawn.
    label
        Label of the axis, with its unit.
    unit
        What follows a time in words.
    far
        Scale of the axis on the far side.
    """

    factor: float
    label: str
    unit: str
    far: Scale

    def words(self, pt: float) -> str:
        """Return a pivot time in words."""
        return f"{pt * self.factor:.3g}{self.unit}"


def time_scale(shown: Trajectory | Motion) -> TimeScale:
    """Return how time is drawn: in seconds for a block of known size, else in forcing periods."""
    motion = shown.motion if isinstance(shown, Trajectory) else shown
    periods, pivot = palette.LABELS["periods"], palette.LABELS["pivot_time"]
    turns = 0.0
    if isinstance(motion, PeriodicMotion):
        turns = motion.frequency_ratio / (2.0 * math.pi)
    if isinstance(shown, Trajectory) and isinstance(shown.block, Block):
        p = shown.block.p
        far = Scale(1.0 / (p * turns), "", periods) if turns else Scale(1.0 / p, "", pivot)
        return TimeScale(1.0 / p, palette.LABELS["seconds"], " s", far)
    if turns:
        return TimeScale(turns, periods, " periods", Scale(1.0, ""))
    return TimeScale(1.0, pivot, "/p", Scale(1.0, ""))


def sided(trajectory: Trajectory, name: str) -> Scale:
    """Return the scale of a quantity, whose alpha is the positive side's where the sides differ."""
    scale = scale_of(name, trajectory.block)
    negative, positive = trajectory.balances
    if trajectory.block.one_sided or -negative == positive:
        return scale
    label, far = (text.replace(r"\alpha", r"\alpha_+") for text in (scale.label, scale.far))
    return Scale(scale.factor, label, far)


def name_level(
    axes: "Axes",
    level: float,
    name: str,
    path: tuple[Floats, Floats],
    taken: Sequence[Box] = (),
) -> None:
    """Write the name of a horizontal line above or below it, where it hides least of a curve.

    Parameters
    ----------
    axes
        With their final limits, on linear scales.
    level
        Ordinate of the line.
    name
        Its name.
    path
        Abscissas and ordinates of the curve.
    taken
        Where words and legends stand.
    """
    inks, size = inks_of(axes), text_size(axes, 8.0)
    letters = len(re.sub(r"\$[^$]*\$", "xx", name))
    wide, tall = extent(axes, width=0.56 * size * letters + 2.0, height=size + 3.0)
    (x0, x1), (y0, y1) = axes.get_xlim(), axes.get_ylim()
    across, up = (path[0] - x0) / (x1 - x0), (path[1] - y0) / (y1 - y0)
    line = (level - y0) / (y1 - y0)

    def hidden(choice: tuple[bool, float]) -> float:
        above, left = choice
        foot = line if above else line - tall
        inside = (across > left) & (across < left + wide) & (up > foot) & (up < foot + tall)
        clashes = sum(
            left < x + w and x < left + wide and foot < y + h and y < foot + tall
            for x, y, w, h in taken
        )
        outside = foot < 0.0 or foot + tall > 1.0
        return float(inside.mean()) + clashes + 2.0 * outside

    lefts = np.linspace(0.01, max(0.01, 0.99 - wide), 24).tolist()
    above, left = min(((side, x) for side in (True, False) for x in lefts), key=hidden)
    axes.annotate(
        name,
        (left, level),
        (0.0, 1.5 if above else -1.5),
        xycoords=("axes fraction", "data"),
        textcoords="offset points",
        ha="left",
        va="bottom" if above else "top",
        fontsize=size,
        color=inks.ink,
        bbox={"fc": inks.paper, "ec": "none", "alpha": 0.75, "pad": 0.3},
        zorder=2.4,
        annotation_clip=True,
    )


def angle_limits(
    trajectory: Trajectory, angle: Floats, factor: float = 1.0, *, headroom: float = HEADROOM
) -> tuple[float, float]:
    """Return the ends of the angle axis: what is there, the tipping angles, and headroom.

    Parameters
    ----------
    trajectory
        The run.
    angle
        What is drawn of it.
    factor
        Factor of angles before they are drawn.
    headroom
        Part of the height that is left free above.
    """
    lowest, highest = float(angle.min()), float(angle.max())
    negative, positive = (factor * level for level in trajectory.balances)
    if trajectory.status is Status.OVERTURNED and (lowest < negative or highest > positive):
        high = max(1.15 * positive, 1.1 * highest)
        wall = trajectory.block.one_sided
        low = -WALL_SHARE * high if wall else min(1.15 * negative, 1.1 * lowest)
        return low, high + headroom * (high - low)
    # A block that hardly rocks fills the picture; one that does not move has no scale of its own.
    peak = factor * trajectory.peak
    least = 0.0 if 0.0 < trajectory.peak < 0.6 else max(positive, -negative)
    reach = 1.12 * max(-lowest, highest, least)
    if reach == 0.0:  # at rest in this part of the run
        reach = 1.12 * peak
    if trajectory.block.one_sided:
        return -WALL_SHARE * reach, reach * (1.0 + headroom)
    return -reach, reach * (1.0 + 2.0 * headroom)


def draw_wall(axes: "Axes", angles: Literal["x", "y"]) -> None:
    """Draw the wall at the negative angles of an axis, its face at 0, named where that fits."""
    inks = inks_of(axes)
    low, high = axes.get_ylim() if angles == "y" else axes.get_xlim()
    span, line = (axes.axhspan, axes.axhline) if angles == "y" else (axes.axvspan, axes.axvline)
    span(2.0 * low, 0.0, facecolor=inks.soil, lw=0, zorder=0.8)
    line(0.0, color=inks.ink, lw=1.2)
    size = text_size(axes, 7.0)
    if size_of(axes)[1 if angles == "y" else 0] * -low / (high - low) < size + 1.0:
        return
    middle = (0.985, 0.5 * low) if angles == "y" else (0.5 * low, 0.985)
    axes.text(
        *middle,
        "wall",
        transform=axes.get_yaxis_transform() if angles == "y" else axes.get_xaxis_transform(),
        rotation=0.0 if angles == "y" else 90.0,
        ha="right" if angles == "y" else "center",
        va="center_baseline" if angles == "y" else "top",
        fontsize=size,
        color=inks.ink,
    )


def time_limits(trajectory: Trajectory, start: float, end: float) -> tuple[float, float]:
    """Return the ends of the time axis; a fall from the start on keeps clear of the left end."""
    if start == end:
        return start - 0.5, end + 0.5
    return (-0.02 * end if start == 0.0 and trajectory.overturn_time_pt == 0.0 else start), end


def base_scale(trajectory: Trajectory, quantity: Quantity) -> Scale:
    """Return the scale of what the base does, in units of alpha g, alpha g/p or alpha g/p^2."""
    block = trajectory.block
    key = "base" if quantity == "acceleration" else f"base_{quantity}"
    text = palette.LABELS[key]
    negative, positive = trajectory.balances
    if not (block.one_sided or -negative == positive):
        text = text.replace(r"\alpha", r"\alpha_+")
    if not isinstance(block, Block):
        return Scale(1.0, text)
    unit = block.uplift_acceleration
    factor, name = {
        "acceleration": (unit / STANDARD_GRAVITY, "base_g"),
        "velocity": (unit / block.p, "base_velocity_m_s"),
        "displacement": (unit / block.p**2, "base_displacement_m"),
    }[quantity]
    return Scale(factor, palette.LABELS[name], text)


def covered(
    axes: "Axes", corner: Corner, size: tuple[float, float], path: tuple[Floats, Floats]
) -> bool:
    """Return whether a curve passes through a corner of a size in parts of the axes."""
    places = axes.transAxes.inverted().transform(axes.transData.transform(np.column_stack(path)))
    right, upper = CORNERS[corner]
    across = places[:, 0] > 1.0 - size[0] if right else places[:, 0] < size[0]
    up = places[:, 1] > 1.0 - size[1] if upper else places[:, 1] < size[1]
    return bool((across & up).any())
