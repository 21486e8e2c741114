"""Plots of time histories: angle, base motion and phase portrait."""

import math
from typing import TYPE_CHECKING, Literal

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from rocksteady.dynamics.history import base_motion
from rocksteady.dynamics.history.lowering import segment_table
from rocksteady.dynamics.history.trajectory import Trajectory
from rocksteady.errors import ModelError
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.arguments import checked
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.fourier import PeriodicMotion
from rocksteady.model.motions.record import Record
from rocksteady.model.motions.segments import Motion
from rocksteady.outcomes import Status
from rocksteady.records.core.recording import Recording
from rocksteady.seismic.measures.motion_course import course_at, motion_course
from rocksteady.seismic.measures.time_course import integrate_record
from rocksteady.show.plots.records import Quantity, plot_integrated_record, refuse_unknown
from rocksteady.show.style import palette
from rocksteady.show.style.layout import axes_or_new, emptiest_corner, extent
from rocksteady.show.style.legends import LegendPlace, draw_legend, place_of
from rocksteady.show.style.line_colours import inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

HEADROOM = 0.15
"""Part of the height of a time history that is left free above it for the legend."""
AT_REST = "at rest throughout:\nno angle, no velocity"
"""In the phase plane of a block that never moves."""
WALL_SHARE = 0.08
"""Of the angles above 0: how much of the wall is shown below it."""
CROWD = 150
"""Number of impacts from which on their marks shrink."""


def time_axis(shown: Trajectory | Motion) -> tuple[float, str]:
    """Return by what pivot time is multiplied for the time axis, and the axis's label."""
    motion = shown.motion if isinstance(shown, Trajectory) else shown
    if isinstance(motion, PeriodicMotion):
        return motion.frequency_ratio / (2.0 * math.pi), palette.LABELS["periods"]
    if isinstance(shown, Trajectory) and isinstance(shown.block, Block):
        return 1.0 / shown.block.p, palette.LABELS["seconds"]
    return 1.0, palette.LABELS["pivot_time"]


def label_of(trajectory: Trajectory, name: str) -> str:
    """Return the label of an axis; where the block's sides differ it names whose alpha it is."""
    negative, positive = trajectory.balances
    text = palette.LABELS[name]
    return (
        text
        if trajectory.block.one_sided or -negative == positive
        else text.replace(r"\alpha", r"\alpha_+")
    )


@checked
def plot_trajectory(
    trajectory: Trajectory,
    ax: "Axes | None" = None,
    *,
    span: tuple[float, float] | None = None,
    key: bool = True,
    legend: LegendPlace | None = None,
) -> "Axes":
    """Draw angle against time with every impact, and the rest or overturning that ends it.

    Between the dashed lines, |theta| = alpha, a block left alone falls back onto its base.  Each
    line is at the alpha of its side; the unit is that of the positive one.  A wall behind the block
    is hatched, below angle 0.

    Parameters
    ----------
    trajectory
        From `rocksteady.simulate`.
    ax
        Axes to draw on; default: axes of a new figure.
    span
        Pivot times p t between which to draw; default: the whole run.
    key
        Whether there is a legend by default, and room for it.
    legend
        "inside" the axes, to their "right", "below" them or "none".

    Returns
    -------
    matplotlib.axes.Axes
        The axes: time in forcing periods of harmonic shaking, else in seconds or, without a block,
        pivot time; the angle in units of alpha.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import DimensionlessBlock, Harmonic, simulate
    >>> shaking = Harmonic(amplitude=2.0, frequency_ratio=4.0)
    >>> run = simulate(DimensionlessBlock(restitution=0.8), shaking, cycles=10)
    >>> axes = plot_trajectory(run, Figure().add_subplot())
    >>> axes.get_xlabel()
    'time [forcing periods]'
    """
    axes = axes_or_new(ax)
    inks, place = inks_of(axes), place_of(axes, legend, "inside" if key else "none")
    scale, label = time_axis(trajectory)
    motion = trajectory(trajectory.times(span=span))
    start, end = float(motion.pt[0]), float(motion.pt[-1])
    axes.axhspan(*trajectory.balances, color=palette.SYMMETRIC, alpha=0.12, lw=0)
    for level in trajectory.balances:
        axes.axhline(level, color=inks.faint, lw=0.8, ls=(0, (4, 3)))
    if trajectory.block.one_sided:
        draw_wall(axes, "y")
    axes.plot(motion.pt * scale, motion.angle, color=inks.lines[0])
    impacts = trajectory.impacts.pt
    impacts = impacts[(impacts >= start) & (impacts <= end)]
    if len(impacts) > 0:
        axes.plot(
            impacts * scale,
            np.zeros(len(impacts)),
            ls="none",
            marker="o",
            ms=1.6 if len(impacts) > CROWD else 3.0,
            color=inks.impact,
            label="1 impact" if len(impacts) == 1 else f"{len(impacts)} impacts",
        )
    overturn, rest = trajectory.overturn_time_pt, trajectory.rest_time_pt
    if overturn is not None and start <= overturn <= end:
        axes.plot(
            overturn * scale,
            trajectory(overturn).angle,
            marker="X",
            ms=8,
            mec=inks.paper,
            mew=0.8,
            color=inks.ink,
            ls="none",
            label="overturns",
        )
    elif rest is not None and rest > 0.0 and start <= rest <= end:
        axes.axvline(rest * scale, color=inks.faint, lw=0.8, label="at rest")
    axes.set(
        xlabel=label,
        ylabel=label_of(trajectory, "angle"),
        ylim=angle_limits(
            trajectory, motion.angle, headroom=HEADROOM if place == "inside" else 0.0
        ),
        xlim=time_limits(trajectory, start * scale, end * scale),
    )
    corner = "upper left"
    if trajectory.status is Status.OVERTURNED:
        size = extent(axes, width=160.0, height=22.0)
        corner = emptiest_corner(axes, (motion.pt * scale, motion.angle), size)
    drawn = draw_legend(axes, place, corner=corner, columns=2)
    for entry in drawn.get_lines() if drawn is not None else ():
        if entry.get_marker() == "o":
            entry.set_markersize(3.0)
    return axes


def angle_limits(
    trajectory: Trajectory, angle: NDArray[np.float64], *, headroom: float = HEADROOM
) -> tuple[float, float]:
    """Return the ends of the angle axis: what is there, the band of balance, and headroom."""
    lowest, highest = float(angle.min()), float(angle.max())
    negative, positive = trajectory.balances
    if trajectory.status is Status.OVERTURNED and (lowest < negative or highest > positive):
        high = max(1.15 * positive, 1.1 * highest)
        wall = trajectory.block.one_sided
        return -WALL_SHARE * high if wall else min(1.15 * negative, 1.1 * lowest), high
    # A block that hardly rocks fills the picture; one that does not move has no scale of its own.
    least = 0.0 if 0.0 < trajectory.peak < 0.6 else max(positive, -negative)
    reach = 1.12 * max(-lowest, highest, least)
    if reach == 0.0:  # at rest in this part of the run
        reach = 1.12 * trajectory.peak
    if trajectory.block.one_sided:
        return -WALL_SHARE * reach, reach * (1.0 + headroom)
    return -reach, reach * (1.0 + 2.0 * headroom)


def draw_wall(axes: "Axes", angles: Literal["x", "y"]) -> None:
    """Draw the wall at the negative angles of an axis, its face at 0."""
    inks = inks_of(axes)
    span, line = (axes.axhspan, axes.axhline) if angles == "y" else (axes.axvspan, axes.axvline)
    span(-2.0, 0.0, facecolor=inks.grid, edgecolor=inks.faint, hatch="////", lw=0, alpha=0.6)
    line(0.0, color=inks.ink, lw=1.2)


def time_limits(trajectory: Trajectory, start: float, end: float) -> tuple[float, float]:
    """Return the ends of the time axis; a fall from the start on keeps clear of the left end."""
    if start == end:
        return start - 0.5, end + 0.5
    return (-0.02 * end if start == 0.0 and trajectory.overturn_time_pt == 0.0 else start), end


@checked
def plot_base(
    motion: Trajectory | Motion | Record | Recording | BaseMotion,
    ax: "Axes | None" = None,
    *,
    quantity: Quantity = "acceleration",
    legend: LegendPlace | None = None,
) -> "Axes":
    """Draw a base motion against time, with the acceleration that lifts a block at rest.

    Vertical motion under a block has an axis of its own, in g, to the right; both axes have one
    scale.  Of an endless motion without a block the first 3 periods are drawn.

    Parameters
    ----------
    motion
        From `rocksteady.simulate`, or a base motion without a block.
    ax
        Axes to draw on; default: axes of a new figure.
    quantity
        "acceleration", "velocity" or "displacement".
    legend
        Legend of a base that moves vertically too: "inside" the axes, the default, to their
        "right", "below" them or "none".

    Returns
    -------
    matplotlib.axes.Axes
        The axes: time as in `plots.trajectory`, the acceleration in units of alpha g; dashed where
        a block at rest lifts off: at -1 and 1 in the linear model, of a block whose sides differ at
        their own alpha, of one against a wall at 1 alone.  Impulses are arrows without a scale.
        Of a record without a block seconds, and g, m/s or m.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import DimensionlessBlock, Harmonic, simulate
    >>> shaking = Harmonic(amplitude=2.0, frequency_ratio=4.0)
    >>> run = simulate(DimensionlessBlock(restitution=0.8), shaking, cycles=10)
    >>> axes = plot_base(run, Figure().add_subplot())
    >>> print(f"{axes.lines[0].get_ydata().max():.3f}")
    2.000
    >>> axes = plot_base(shaking, Figure().add_subplot(), quantity="velocity")
    >>> print(f"{axes.lines[0].get_ydata().max():.3f}")
    0.500
    """
    if isinstance(motion, Recording):
        motion = motion.record
    if isinstance(motion, Record):
        return plot_integrated_record(integrate_record(motion), ax, quantity=quantity)
    refuse_unknown(quantity)
    axes = axes_or_new(ax)
    inks, place = inks_of(axes), place_of(axes, legend, "inside")
    if isinstance(motion, BaseMotion):
        plot_base(motion.horizontal, axes, quantity=quantity)
        if motion.vertical is not None:
            _draw_component(axes, motion.vertical, quantity, place)
        return axes
    scale, label = time_axis(motion)
    key = "base" if quantity == "acceleration" else f"base_{quantity}"
    if isinstance(motion, Trajectory):
        table, uplifts, text = motion.segments, motion.uplifts, label_of(motion, key)
        times = base_motion.base_course(table, motion.times())[0]
        course = course_at(table, times, swings=isinstance(motion.motion, PeriodicMotion))
        limits = time_limits(motion, times[0] * scale, times[-1] * scale)
    else:
        table, uplifts, text = segment_table(motion), (-1.0, 1.0), palette.LABELS[key]
        course = motion_course(motion)
        times = course.pt
        limits = 0.0, times[-1] * scale
    values = getattr(course, quantity)
    axes.plot(times * scale, values, color=inks.base, lw=1.0, label="horizontal")
    axes.set(xlabel=label, ylabel=text, xlim=limits)
    if quantity != "acceleration":
        return axes
    struck, velocities = base_motion.impulses(table)
    height = 1.5 * max(1.0, float(np.abs(values).max()))
    for sign, marker in ((1.0, "^"), (-1.0, "v")):
        at = struck[(sign * velocities > 0.0) & (struck <= times[-1])] * scale
        if len(at) > 0:
            axes.vlines(at, 0.0, sign * height, color=inks.base, lw=1.4)
            heads = np.full(len(at), sign * height)
            axes.plot(at, heads, marker, ms=6.0, color=inks.base, clip_on=False)
    for level in filter(math.isfinite, uplifts):
        axes.axhline(level, color=inks.faint, lw=0.8, ls=(0, (4, 3)))
    if (
        isinstance(motion, Trajectory)
        and motion.vertical is not None
        and isinstance(motion.block, Block)
    ):
        upwards = base_motion.lift(table, times)
        _draw_vertical(axes, times * scale, upwards, motion.block.alpha, place)
    return axes


def _draw_component(
    axes: "Axes", vertical: Motion | Record, quantity: Quantity, place: LegendPlace
) -> None:
    """Draw the vertical component of a motion without a block in the axes of the horizontal one."""
    beside = plot_base(vertical, Figure().add_subplot(), quantity=quantity)
    if beside.get_ylabel() != axes.get_ylabel():
        raise ModelError(
            "motion",
            vertical,
            "its components have no unit in common",
            "plot each of them, or the run of a block under both",
        )
    across, up = (
        max(each.lines, key=lambda line: np.size(line.get_xdata())) for each in (axes, beside)
    )
    (drawn,) = axes.plot(*up.get_data(), color=inks_of(axes).impact, lw=0.6, label="vertical")
    ends = [*axes.get_xlim(), *beside.get_xlim()], [*axes.get_ylim(), *beside.get_ylim()]
    axes.set(xlim=(min(ends[0]), max(ends[0])), ylim=(min(ends[1]), 1.3 * max(ends[1])))
    across.set_label("horizontal")
    draw_legend(axes, place, handles=[across, drawn], corner="upper right", columns=2)


def _draw_vertical(
    axes: "Axes",
    times: NDArray[np.float64],
    upwards: NDArray[np.float64],
    alpha: float,
    place: LegendPlace,
) -> None:
    """Draw the vertical acceleration of the base on an axis in g."""
    inks = inks_of(axes)
    low, high = axes.get_ylim()
    reach = 1.08 * float(np.abs(upwards).max(initial=0.0)) / alpha
    low, high = min(low, -reach), max(high, reach)
    if place == "inside":  # above the curves
        high += 0.25 * (high - low)
    beside = axes.twinx()
    (drawn,) = beside.plot(times, upwards, color=inks.impact, lw=0.6, label="vertical")
    # One scale: where both curves are equally high both accelerations are.
    axes.set_ylim(low, high)
    beside.set(ylim=(low * alpha, high * alpha), ylabel="vertical [g]")
    beside.grid(visible=False)
    beside.spines["right"].set_visible(True)
    beside.tick_params(colors=inks.impact)
    beside.yaxis.label.set_color(inks.impact)
    draw_legend(axes, place, handles=[axes.lines[0], drawn], corner="upper right", columns=2,
                gap=44.0)  # fmt: skip


@checked
def plot_phase_portrait(
    trajectory: Trajectory,
    ax: "Axes | None" = None,
    *,
    mark: Literal["start", "impacts"] = "start",
    legend: LegendPlace | None = None,
) -> "Axes":
    """Draw velocity against angle; impacts are the steps at angle 0, where a wall is hatched.

    For a block that never moves there is a text instead of a curve.

    Parameters
    ----------
    trajectory
        From `rocksteady.simulate`.
    ax
        Axes to draw on; default: axes of a new figure.
    mark
        What is marked: the start, or the states just after the impacts, as for a closed orbit,
        which has no start.
    legend
        "inside" the axes, to their "right", "below" them or "none"; inside by default.

    Returns
    -------
    matplotlib.axes.Axes
        The axes: u = theta/alpha, and du/ds over pivot time s = p t.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import DimensionlessBlock, State, Still, simulate
    >>> start = State(angle=0.5, velocity=0.0)
    >>> run = simulate(DimensionlessBlock(restitution=0.8), Still(), start=start)
    >>> axes = plot_phase_portrait(run, Figure().add_subplot())
    >>> [entry.get_text() for entry in axes.get_legend().get_texts()]
    ['start']
    """
    axes = axes_or_new(ax)
    angle, velocity = trajectory.phase_path(100 if mark == "start" else 400)
    inks, place = inks_of(axes), place_of(axes, legend, "inside")
    axes.set(xlabel=label_of(trajectory, "angle"), ylabel=label_of(trajectory, "velocity"))
    if not (np.any(angle) or np.any(velocity)):
        axes.plot(0.0, 0.0, "o", ms=4, color=inks.ink, ls="none", label="start")
        axes.set(xlim=(-1.0, 1.0), ylim=(-1.0, 1.0))
        axes.text(0.0, 0.12, AT_REST, ha="center", va="bottom", color=inks.ink)
        return axes
    axes.plot(angle, velocity, color=inks.lines[0], lw=0.8, alpha=0.8)
    if trajectory.block.one_sided:
        widest = float(angle.max())
        draw_wall(axes, "x")
        axes.set_xlim(-WALL_SHARE * widest, 1.05 * widest)
    if mark == "start":
        axes.plot(angle[0], velocity[0], "o", ms=4, color=inks.ink, ls="none", label="start")
    else:
        after = trajectory.impacts.velocity_after
        axes.plot(
            np.zeros(len(after)),
            after,
            "o",
            ms=1.6 if len(after) > CROWD else 3.5,
            color=inks.impact,
            ls="none",
            label="after an impact",
        )
    corner = "upper left"
    if mark == "start":
        size = extent(axes, width=52.0, height=22.0)
        corner = emptiest_corner(axes, (angle, velocity), size)
    elif place == "inside":
        # A closed curve leaves no corner free: the legend goes above it.
        low, high = float(velocity.min()), float(velocity.max())
        axes.set_ylim(low - 0.05 * (high - low), high + HEADROOM * (high - low))
    draw_legend(axes, place, corner=corner)
    return axes
