"""Plots of time histories and steady states.

Each function takes a result and, optionally, axes; draws; and returns the axes.  The figures of
`rocksteady.show.figures` put several together.
"""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from rocksteady.dynamics.regions import RegionMap
from rocksteady.dynamics.response import ResponseCurve
from rocksteady.dynamics.steady import SteadyOrbit
from rocksteady.dynamics.trajectory import Trajectory
from rocksteady.errors import Status
from rocksteady.model.motions import Harmonic
from rocksteady.show import palette

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def axes_or_new(ax: "Axes | None") -> "Axes":
    """Return the given axes, or those of a new figure in the house style."""
    if ax is not None:
        return ax
    import matplotlib.pyplot as plt

    with palette.style():
        return plt.subplots()[1]


def time_axis(trajectory: Trajectory) -> tuple[float, str]:
    """Return by what pivot time is multiplied for the time axis, and the axis's label."""
    if isinstance(trajectory.motion, Harmonic):
        return trajectory.motion.frequency_ratio / (2.0 * math.pi), palette.LABELS["periods"]
    if trajectory.block is not None:
        return 1.0 / trajectory.block.p, palette.LABELS["seconds"]
    return 1.0, palette.LABELS["pivot_time"]


def plot_trajectory(trajectory: Trajectory, ax: "Axes | None" = None) -> "Axes":
    """Draw angle against time with every impact, and where the block comes to rest or overturns."""
    axes = axes_or_new(ax)
    scale, label = time_axis(trajectory)
    motion = trajectory(trajectory.times())
    axes.axhspan(-1.0, 1.0, color=palette.SYMMETRIC, alpha=0.12, lw=0)
    for level in (-1.0, 1.0):
        axes.axhline(level, color=palette.FAINT, lw=0.8, ls=(0, (4, 3)))
    axes.plot(motion.s * scale, motion.angle, color=palette.LINES[0])
    impacts = trajectory.impacts
    crowded = len(impacts) > 150
    axes.plot(
        impacts.s * scale,
        np.zeros(len(impacts)),
        ls="none",
        marker="o",
        ms=1.6 if crowded else 3.0,
        color=palette.IMPACT,
        label=f"{len(impacts)} impacts",
    )
    limit = max(1.15, 1.1 * float(np.abs(motion.angle).max()))
    if trajectory.peak < 0.6 and trajectory.status is not Status.OVERTURNED:
        limit = 1.25 * max(trajectory.peak, 1e-3)
    if trajectory.overturn_s is not None:
        fall = trajectory(trajectory.overturn_s)
        axes.plot(
            trajectory.overturn_s * scale,
            fall.angle,
            marker="X",
            ms=8,
            color=palette.OVERTURNED,
            ls="none",
            label="overturns",
        )
    elif trajectory.rest_s is not None and trajectory.rest_s > 0.0:
        axes.axvline(trajectory.rest_s * scale, color=palette.FAINT, lw=0.8, label="at rest")
    axes.set(
        xlabel=label,
        ylabel=palette.LABELS["angle"],
        ylim=(-limit, limit),
        xlim=(0.0, float(motion.s[-1]) * scale),
    )
    axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2, borderaxespad=0.2)
    return axes


def plot_base(trajectory: Trajectory, ax: "Axes | None" = None) -> "Axes":
    """Draw the base acceleration against time, with the acceleration that lifts a block at rest."""
    axes = axes_or_new(ax)
    scale, label = time_axis(trajectory)
    times = trajectory.times()
    axes.plot(times * scale, trajectory.base_acceleration(times), color=palette.BASE, lw=1.0)
    for level in (-1.0, 1.0):
        axes.axhline(level, color=palette.FAINT, lw=0.8, ls=(0, (4, 3)))
    axes.set(xlabel=label, ylabel=palette.LABELS["base"], xlim=(0.0, float(times[-1]) * scale))
    return axes


def plot_phase_portrait(trajectory: Trajectory, ax: "Axes | None" = None) -> "Axes":
    """Draw velocity against angle; impacts are the steps at angle 0."""
    axes = axes_or_new(ax)
    angle, velocity = trajectory.phase_path()
    axes.plot(angle, velocity, color=palette.LINES[0], lw=0.8, alpha=0.8)
    axes.plot(angle[0], velocity[0], "o", ms=4, color=palette.INK, label="start")
    axes.set(xlabel=palette.LABELS["angle"], ylabel=palette.LABELS["velocity"])
    axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), borderaxespad=0.2)
    return axes


def plot_orbit(
    orbit: SteadyOrbit, ax: "Axes | None" = None, *, label: str = "", series: int = 0
) -> "Axes":
    """Draw one period of a symmetric steady state."""
    axes = axes_or_new(ax)
    axes.plot(
        orbit.tau / (2.0 * math.pi),
        orbit.angle,
        color=palette.LINES[series],
        ls=palette.DASHES[series],
        label=label,
    )
    axes.set(
        xlabel=palette.LABELS["half_cycle"],
        ylabel=palette.LABELS["angle"],
        xlim=(0.0, float(orbit.tau[-1]) / (2.0 * math.pi)),
    )
    return axes


def plot_regions(
    curves: RegionMap,
    ax: "Axes | None" = None,
    *,
    point: tuple[float, float] | None = None,
    top: float | None = None,
) -> "Axes":
    """Draw the regions of symmetric steady states with their boundaries (Figs 3 and 4).

    Parameters
    ----------
    curves
        From `rocksteady.region_map`.
    ax
        Axes to draw on.
    point
        A (frequency_ratio, amplitude) to mark.
    top
        Upper end of the amplitude axis.
    """
    axes = axes_or_new(ax)
    w = curves.frequency_ratio
    ceiling = top if top is not None else 6.0
    sky = np.full(w.shape, ceiling)
    low, high = np.minimum(curves.kind, curves.sign), np.maximum(curves.kind, curves.sign)
    fills = palette.REGION_FILLS
    axes.fill_between(w, 0.0, curves.existence, color=fills[4], lw=0)
    axes.fill_between(w, curves.existence, low, color=fills[3], lw=0)
    axes.fill_between(w, low, high, where=curves.sign >= curves.kind, color=fills[1], lw=0)
    axes.fill_between(w, low, high, where=curves.sign < curves.kind, color=fills[5], lw=0)
    axes.fill_between(w, high, np.maximum(sky, high), color=fills[2], lw=0)
    lines = (
        (curves.existence, "existence (23)", "-", palette.INK),
        (curves.kind, "kind (25)", (0, (6, 2)), palette.INK),
        (curves.sign, "sign (24)", (0, (1, 1.2)), palette.INK),
        (curves.symmetry_breaking, "symmetry breaking", "-", palette.LINES[1]),
        (curves.heteroclinic, "heteroclinic", (0, (4, 1.5, 1, 1.5)), palette.LINES[3]),
    )
    for values, label, dash, colour in lines:
        axes.plot(w, values, color=colour, ls=dash, lw=1.2, label=label)
    for region, where in region_centres(curves, ceiling).items():
        axes.annotate(
            str(region), where, ha="center", va="center", fontsize=11, color=palette.FAINT
        )
    if point is not None:
        axes.plot(*point, "o", ms=7, color=palette.LINES[0], mec="white", mew=1.2, zorder=5)
    axes.set(
        xlabel=palette.LABELS["frequency_ratio"],
        ylabel=palette.LABELS["amplitude"],
        xlim=(float(w[0]), float(w[-1])),
        ylim=(0.0, ceiling),
    )
    axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2, borderaxespad=0.2)
    return axes


def region_centres(curves: RegionMap, ceiling: float) -> dict[int, tuple[float, float]]:
    """Return where each region has most room for its number; too narrow ones are left out."""
    from scipy.ndimage import distance_transform_edt

    rows = 160
    height = np.linspace(0.0, ceiling, rows)[:, np.newaxis]
    above_kind, above_sign = height > curves.kind, height > curves.sign
    region = np.where(above_kind, np.where(above_sign, 2, 1), np.where(above_sign, 5, 3))
    region = np.where(height < curves.existence, 4, region)
    columns = np.linspace(0, len(curves.frequency_ratio) - 1, rows).astype(int)
    centres: dict[int, tuple[float, float]] = {}
    for number in range(1, 6):
        inside = np.pad(region[:, columns] == number, 1)
        room = distance_transform_edt(inside)[1:-1, 1:-1]
        if room.max() > 5.0:
            # Of the roomiest places that furthest right: the curves crowd together on the left.
            row, column = max(np.argwhere(room > 0.95 * room.max()), key=lambda place: place[1])
            w = float(curves.frequency_ratio[columns[min(column, rows - 12)]])
            centres[number] = (w, float(height[row, 0]))
    return centres


def plot_response(
    curves: Sequence[ResponseCurve],
    ax: "Axes | None" = None,
    *,
    hertz: bool = False,
) -> "Axes":
    """Draw peaks against frequency, stable parts solid and unstable ones dashed (Figs 5 to 7).

    With `hertz` the abscissa is in Hz, for curves of a block.
    """
    axes = axes_or_new(ax)
    mixed = len({(curve.branch, int(curve.states.order.flat[0])) for curve in curves}) > 1
    for number, curve in enumerate(curves):
        x = (
            curve.frequency_hz
            if hertz and curve.frequency_hz is not None
            else curve.frequency_ratio
        )
        colour = palette.LINES[number % len(palette.LINES)]
        label = f"A = {float(curve.states.amplitude.flat[0]):g}"
        if mixed:
            order = int(curve.states.order.flat[0])
            label += f", n = {order}, branch {curve.branch}"
        solid = np.where(curve.stable, curve.peak, math.nan)
        dashed = np.where(curve.stable, math.nan, curve.peak)
        axes.plot(x, solid, color=colour, label=label)
        axes.plot(x, dashed, color=colour, ls=(0, (3, 2)), lw=1.0)
    axes.set(
        xlabel=palette.LABELS["frequency_hz" if hertz else "frequency_ratio"],
        ylabel=palette.LABELS["peak"],
    )
    axes.set_ylim(bottom=0.0)
    axes.legend(loc="best", title="solid: stable, dashed: unstable", title_fontsize=8.0)
    return axes
