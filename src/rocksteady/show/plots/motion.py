"""Plots of time histories: angle, base motion and phase portrait."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from matplotlib.figure import Figure

from rocksteady.arrays import Floats
from rocksteady.dynamics.history import base_motion
from rocksteady.dynamics.history.trajectory import Trajectory
from rocksteady.errors import ModelError
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.checks.arguments import checked
from rocksteady.model.linear_tables import segment_table
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.fourier import PeriodicMotion
from rocksteady.model.motions.record import Record
from rocksteady.model.motions.segments import Motion
from rocksteady.records.core.recording import Recording
from rocksteady.seismic.measures.motion_course import course_at, motion_course
from rocksteady.seismic.measures.time_course import integrate_record
from rocksteady.show.plots.motion_axes import (
    HEADROOM,
    WALL_SHARE,
    Box,
    TimeScale,
    angle_limits,
    base_scale,
    covered,
    draw_wall,
    name_level,
    sided,
    time_limits,
    time_scale,
)
from rocksteady.show.plots.records import Quantity, plot_integrated_record, refuse_unknown
from rocksteady.show.style import palette
from rocksteady.show.style.layout import CORNERS, Corner, axes_or_new, emptiest_corner, extent
from rocksteady.show.style.legends import (
    LegendPlace,
    draw_legend,
    place_of,
    size_of,
    text_size,
)
from rocksteady.show.style.line_ends import LineEnd, name_line_ends
from rocksteady.show.style.scales import Scale, draw_far_axes, fits_far_axes
from rocksteady.show.style.tokens import DASHED, inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

AT_REST = "never lifts:\nno tilt, no velocity"
"""In the phase plane of a block that never moves."""
LINE = 20.0
"""Height of a line of words or of a legend at the top [points]."""
CROWD = 150
"""Number of impacts from which on their marks shrink."""
LEAST_FOR_WORDS = 60.0
"""Height of axes [points] that have room for the words of an end."""


@checked
def plot_trajectory(
    trajectory: Trajectory,
    ax: "Axes | None" = None,
    *,
    span: tuple[float, float] | None = None,
    key: bool = True,
    legend: LegendPlace | None = None,
) -> "Axes":
    """Draw tilt against time with every impact, and the rest or fall that ends it.

    Between the dashed lines, |theta| = alpha, a block left alone rocks back onto its base.  Each
    line is at the alpha of its side.  A wall behind the block is below angle 0.

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
        The axes: seconds and degrees for a `rocksteady.Block`; without a size the angle in units of
        alpha over forcing periods of harmonic shaking, or over pivot time.  Where there is room,
        the dimensionless scales of a `rocksteady.Block` stand on the far sides.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import Block, DimensionlessBlock, Harmonic, simulate
    >>> shaking = Harmonic(amplitude=2.0, frequency_ratio=4.0)
    >>> for block in (DimensionlessBlock(restitution=0.8), Block.rectangle(width=0.4, height=2.0)):
    ...     axes = plot_trajectory(simulate(block, shaking, cycles=10), Figure().add_subplot())
    ...     print(axes.get_xlabel())
    time [forcing periods]
    time [s]
    """
    axes = axes_or_new(ax)
    inks, place = inks_of(axes), place_of(axes, legend, "inside" if key else "none")
    time, angle = time_scale(trajectory), sided(trajectory, "angle")
    motion = trajectory(trajectory.times(span=span))
    start, end = float(motion.pt[0]), float(motion.pt[-1])
    path = motion.pt * time.factor, motion.angle * angle.factor
    ends = _end_of(trajectory, (start, end), time)
    headroom = max(HEADROOM, LINE / size_of(axes)[1]) if place == "inside" else 0.0
    if ends is not None and size_of(axes)[1] >= LEAST_FOR_WORDS:
        headroom = max(headroom, 0.7 * LINE / size_of(axes)[1])
    limits = {
        "ylim": angle_limits(trajectory, path[1], angle.factor, headroom=headroom),
        "xlim": time_limits(trajectory, start * time.factor, end * time.factor),
    }
    for name, (low, high) in limits.items():
        # Another run stays in the picture, and so does the time that a caller has set.
        if axes.has_data() or (name == "xlim" and not axes.get_autoscalex_on()):
            first, last = getattr(axes, f"get_{name}")()
            limits[name] = min(low, first), max(high, last)
    axes.set(xlabel=time.label, ylabel=angle.label, **limits)
    if trajectory.block.one_sided:
        draw_wall(axes, "y")
    axes.plot(*path, color=inks.motion)
    _draw_impacts(axes, trajectory, (start, end), time)
    corner: Corner = "upper left"
    size, taken = extent(axes, width=7.6 * text_size(axes, 9.0), height=LINE), []
    words = None if ends is None else _draw_end(axes, ends[0] * time.factor, ends[1])
    if words is not None:
        taken.append(words)
        if words[0] + words[2] < 1.0 - words[0]:  # there is more room beyond them
            corner = "upper right"
    if place == "inside" and len(trajectory.impacts):
        right, upper = CORNERS[corner]
        taken.append((right * (1.0 - size[0]), upper * (1.0 - size[1]), *size))
    _draw_tipping_angles(axes, trajectory, path, angle.factor, taken)
    draw_legend(axes, place, corner=corner)
    draw_far_axes(axes, time.far, angle)
    return axes


def _draw_impacts(
    axes: "Axes", trajectory: Trajectory, span: tuple[float, float], time: TimeScale
) -> None:
    """Draw a tick at angle 0 for each impact."""
    from matplotlib.patheffects import withStroke

    impacts = trajectory.impacts.pt
    impacts = impacts[(impacts >= span[0]) & (impacts <= span[1])]
    if len(impacts) == 0:
        return
    crowded, inks = len(impacts) > CROWD, inks_of(axes)
    rim = [] if crowded else [withStroke(linewidth=2.5, foreground=inks.paper)]
    axes.plot(
        impacts * time.factor,
        np.zeros(len(impacts)),
        ls="none",
        marker="|",
        ms=4.0 if crowded else 9.0,
        mew=0.6 if crowded else 1.5,
        color=inks.impact,
        path_effects=rim,
        zorder=2.5,
        label="1 impact" if len(impacts) == 1 else f"{len(impacts)} impacts",
    )


def _end_of(
    trajectory: Trajectory, span: tuple[float, float], time: TimeScale
) -> tuple[float, str] | None:
    """Return the pivot time at which the block rests or falls within a span, and words on that."""
    overturn, rest = trajectory.overturn_time_pt, trajectory.rest_time_pt
    if overturn is not None:
        at = overturn
        words = f"falls at {time.words(at)}" if at > 0.0 else "falls from the start"
    elif rest is not None and rest > 0.0:
        at, words = rest, f"at rest from {time.words(rest)}"
    else:
        return None
    return (at, words) if span[0] <= at <= span[1] else None


def _draw_end(axes: "Axes", x: float, words: str) -> Box | None:
    """Mark the rest or the fall of the block, and return where the words on that stand, if any."""
    inks, size = inks_of(axes), text_size(axes, 8.0)
    axes.axvline(x, color=inks.ink, lw=0.8, zorder=1.8)
    if size_of(axes)[1] < LEAST_FOR_WORDS:
        return None
    low, high = axes.get_xlim()
    part = (x - low) / (high - low)
    wide, tall = extent(axes, width=0.58 * size * len(words) + 5.0, height=size + 5.0)
    before = part > wide
    axes.annotate(
        words,
        (x, 1.0),
        (-3.0 if before else 3.0, -3.0),
        xycoords=("data", "axes fraction"),
        textcoords="offset points",
        ha="right" if before else "left",
        va="top",
        fontsize=size,
        color=inks.ink,
        annotation_clip=True,
    )
    return part - wide if before else part, 1.0 - tall, wide, tall


def _draw_tipping_angles(
    axes: "Axes",
    trajectory: Trajectory,
    path: tuple[Floats, Floats],
    factor: float,
    taken: Sequence[Box],
) -> None:
    """Draw the angles at which the block balances, named where they are seen."""
    negative, positive = trajectory.balances
    differ = not trajectory.block.one_sided and -negative != positive
    low, high = axes.get_ylim()
    seen = []
    for level, name in ((positive, r"$\alpha_+$"), (negative, r"$\alpha_-$")):
        if level == 0.0:  # a wall is there
            continue
        axes.axhline(level * factor, color=inks_of(axes).limit, lw=0.9, ls=DASHED, zorder=1.9)
        if low < level * factor < high:
            seen.append((level * factor, f"tipping angle {name}" if differ else "tipping angle"))
    for level, name in seen if differ else seen[:1]:
        name_level(axes, level, name, path, taken)


@checked
def plot_base(
    motion: Trajectory | Motion | Record | Recording | BaseMotion,
    ax: "Axes | None" = None,
    *,
    quantity: Quantity = "acceleration",
    legend: LegendPlace | None = None,
) -> "Axes":
    """Draw a base motion against time, with the acceleration that lifts a block at rest.

    Of an endless motion without a block the first 3 periods are drawn.

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
        The axes: time as in `plots.trajectory`; g, m/s or m under a `rocksteady.Block`, and else
        the acceleration in units of alpha g; dashed where a block at rest lifts off: at -alpha g
        and alpha g in the linear model, of a block whose sides differ at their own alpha, of one
        against a wall at alpha g alone.  Impulses are arrows without a scale.  Of a record without
        a block seconds, and g, m/s or m.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import Block, DimensionlessBlock, Harmonic, simulate
    >>> shaking = Harmonic(amplitude=2.0, frequency_ratio=4.0)
    >>> for block in (DimensionlessBlock(restitution=0.8), Block.rectangle(width=0.4, height=2.0)):
    ...     axes = plot_base(simulate(block, shaking, cycles=10), Figure().add_subplot())
    ...     print(f"{axes.lines[0].get_ydata().max():.3f}")
    2.000
    0.395
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
    inks, place = inks_of(axes), place_of(axes, legend, "inside", width=150.0)
    if isinstance(motion, BaseMotion):
        plot_base(motion.horizontal, axes, quantity=quantity)
        if motion.vertical is not None:
            _draw_component(axes, motion.vertical, quantity, place)
        return axes
    time = time_scale(motion)
    if isinstance(motion, Trajectory):
        table, uplifts, scale = motion.segments, motion.uplifts, base_scale(motion, quantity)
        times = base_motion.base_course(table, motion.times())[0]
        course = course_at(table, times, swings=isinstance(motion.motion, PeriodicMotion))
        limits = time_limits(motion, times[0] * time.factor, times[-1] * time.factor)
    else:
        key = "base" if quantity == "acceleration" else f"base_{quantity}"
        table, uplifts, scale = segment_table(motion), (-1.0, 1.0), Scale(1.0, palette.LABELS[key])
        course = motion_course(motion)
        times = course.pt
        limits = 0.0, times[-1] * time.factor
    path = times * time.factor, getattr(course, quantity) * scale.factor
    axes.plot(*path, color=inks.base, lw=1.0, label="horizontal")
    axes.set(xlabel=time.label, ylabel=scale.label, xlim=limits)
    if quantity == "acceleration":
        levels = [level * scale.factor for level in uplifts if math.isfinite(level)]
        for level in levels:
            axes.axhline(level, color=inks.limit, lw=0.9, ls=DASHED, zorder=1.9)
        highest = float(np.abs([*levels, *path[1]]).max())
        _draw_impulses(axes, table, float(times[-1]), time.factor, 1.5 * highest)
        if (
            isinstance(motion, Trajectory)
            and motion.vertical is not None
            and isinstance(motion.block, Block)
        ):
            upwards = base_motion.lift(table, times) * motion.block.gravity / STANDARD_GRAVITY
            _draw_vertical(axes, path[0], upwards, place)
        axes.set_ylim(axes.get_ylim())
        if fits_far_axes(axes) and scale.far:
            name_level(axes, levels[-1], "lifts off", path)
        else:  # and not on the curve
            name_line_ends(axes, [LineEnd("lifts\noff", levels[-1], inks.limit)])
    draw_far_axes(axes, time.far, scale)
    return axes


def _draw_impulses(axes: "Axes", table: Floats, end: float, factor: float, height: float) -> None:
    """Draw impulses as arrows of one height: they have no scale."""
    inks = inks_of(axes)
    struck, velocities = base_motion.impulses(table)
    words: tuple[float, float] | None = None
    for sign, marker in ((1.0, "^"), (-1.0, "v")):
        at = struck[(sign * velocities > 0.0) & (struck <= end)] * factor
        if len(at) == 0:
            continue
        axes.vlines(at, 0.0, sign * height, color=inks.base, lw=1.4)
        heads = np.full(len(at), sign * height)
        axes.plot(at, heads, marker, ms=6.0, color=inks.base, clip_on=False)
        if words is None or at[-1] > words[0]:
            words = float(at[-1]), 0.35 * sign * height  # between the lines of uplift and 0
    if words is not None:
        axes.annotate(
            "impulse, without a scale",
            words,
            (6.0, 0.0),
            textcoords="offset points",
            va="center",
            fontsize=text_size(axes, 8.0),
            color=inks.base,
        )


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
    x, y = (np.asarray(values, dtype=np.float64) for values in up.get_data())
    ends = [*axes.get_xlim(), *beside.get_xlim()], [*axes.get_ylim(), *beside.get_ylim()]
    axes.set(xlim=(min(ends[0]), max(ends[0])), ylim=(min(ends[1]), max(ends[1])))
    across.set_label("horizontal")
    _draw_vertical(axes, x, y, place)


def _draw_vertical(axes: "Axes", times: Floats, upwards: Floats, place: LegendPlace) -> None:
    """Draw the vertical component over the horizontal one, in the unit of the axes."""
    horizontal, vertical = inks_of(axes).series("base", 2)
    across = max(axes.lines, key=lambda line: np.size(line.get_xdata()))
    across.set(color=horizontal, label="horizontal")
    (drawn,) = axes.plot(times, upwards, color=vertical, lw=0.7, label="vertical")
    low, high = axes.get_ylim()
    if place == "inside":  # above the curves
        tall = max(size_of(axes)[1], 2.0 * LINE)
        high += LINE / (tall - LINE) * (high - low)
    axes.set_ylim(low, high)
    draw_legend(axes, place, handles=[across, drawn], corner="upper right", columns=2)


@checked
def plot_phase_portrait(
    trajectory: Trajectory,
    ax: "Axes | None" = None,
    *,
    mark: Literal["start", "impacts"] = "start",
    legend: LegendPlace | None = None,
) -> "Axes":
    """Draw velocity against tilt; impacts are the steps at angle 0, where a wall ends the plane.

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
        The axes: degrees and degrees a second of a `rocksteady.Block`, with u = theta/alpha and
        du/d(pt) on the far sides where there is room; these alone without a size.

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
    across, up = sided(trajectory, "angle"), sided(trajectory, "velocity")
    angle, velocity = trajectory.phase_path(100 if mark == "start" else 400)
    angle, velocity = angle * across.factor, velocity * up.factor
    inks, place = inks_of(axes), place_of(axes, legend, "inside")
    axes.set(xlabel=across.label, ylabel=up.label)
    hollow: dict[str, Any] = {
        "marker": "o",
        "ms": 5.0,
        "mfc": inks.paper,
        "mec": inks.ink,
        "mew": 1.2,
        "ls": "none",
    }
    if not (np.any(angle) or np.any(velocity)):
        axes.plot(0.0, 0.0, label="start", **hollow)
        axes.set(xlim=(-1.0, 1.0), ylim=(-1.0, 1.0))
        axes.text(0.0, 0.12, AT_REST, ha="center", va="bottom", color=inks.ink)
        return axes
    axes.plot(angle, velocity, color=inks.motion, lw=0.8)
    if trajectory.block.one_sided:
        widest = float(angle.max())
        axes.set_xlim(-WALL_SHARE * widest, 1.05 * widest)
        draw_wall(axes, "x")
    if mark == "start":
        axes.plot(angle[0], velocity[0], label="start", **hollow)
    else:
        after = trajectory.impacts.velocity_after * up.factor
        axes.plot(
            np.zeros(len(after)),
            after,
            "o",
            ms=1.6 if len(after) > CROWD else 3.5,
            color=inks.impact,
            ls="none",
            label="after an impact",
        )
    corner: Corner = "upper left"
    full = True  # a closed curve leaves no corner free
    if mark == "start":
        size = extent(axes, width=56.0, height=LINE)
        corner = emptiest_corner(axes, (angle, velocity), size)
        full = covered(axes, corner, size, (angle, velocity))
    if place == "inside" and full:  # the legend goes above the curve
        low, high = float(velocity.min()), float(velocity.max())
        room = max(HEADROOM, LINE / size_of(axes)[1])
        axes.set_ylim(low - 0.05 * (high - low), high + room * (high - low))
    draw_legend(axes, place, corner=corner)
    draw_far_axes(axes, across, up)
    return axes
