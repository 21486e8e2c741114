"""Plots of stable and unstable manifolds of saddles."""

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.dynamics.edges.hilltop import HilltopSaddle
from rocksteady.dynamics.edges.manifold import Manifold, ManifoldBranch
from rocksteady.dynamics.orbits.orbit import Orbit
from rocksteady.errors import ModelError, Words
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.arguments import checked
from rocksteady.show.plots.portraits._window import plane_scales
from rocksteady.show.style import palette
from rocksteady.show.style.layout import axes_or_new
from rocksteady.show.style.legends import LegendPlace, draw_legend, place_of
from rocksteady.show.style.scales import Scale, draw_far_axes, scale_of
from rocksteady.show.style.tokens import DASHED, inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

TURN = 2.0 * math.pi
WIDTH = 0.7
CASING = 1.5
"""Width of the casing in which a line on a picture of basins is seen on every fill."""


@checked
def plot_manifolds(
    manifolds: Manifold | Iterable[Manifold],
    ax: "Axes | None" = None,
    *,
    legend: LegendPlace | None = None,
) -> "Axes":
    """Draw manifolds of saddles: stable ones solid, unstable ones dashed, saddles as crosses.

    On axes of `plots.basins` or `plots.poincare_section` they are drawn over the existing picture,
    in its units and in casings over basins, and nothing else changes.  Over a phase, basins of
    that phase have the stable manifolds as their borders.

    Parameters
    ----------
    manifolds
        From `rocksteady.basins.compute_manifold`; one or several, all over a phase or all over
        impacts.
    ax
        Axes to draw on; default: axes of a new figure.
    legend
        "inside" the axes, to their "right", "below" them or "none"; by default below new axes, and
        none on axes that are drawn on already.

    Returns
    -------
    matplotlib.axes.Axes
        The axes: tilt and its velocity, or phase of the shaking and speed; in degrees and degrees/s
        of a block with sizes, else u = theta/alpha by pt.

    Raises
    ------
    ModelError
        If there is no manifold, they are over a phase and over impacts, or over several phases, or
        the axes are those of a section over which they are not.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import DimensionlessBlock, Harmonic
    >>> from rocksteady.basins import compute_manifold, find_hilltop_saddles
    >>> motion = Harmonic(amplitude=0.2, frequency_ratio=2.0)
    >>> saddles = find_hilltop_saddles(DimensionlessBlock(restitution=0.9), motion)
    >>> manifolds = [compute_manifold(saddle, "stable", length=2.0) for saddle in saddles]
    >>> axes = plot_manifolds(manifolds, Figure().add_subplot())
    >>> [text.get_text() for text in axes.get_legend().get_texts()]
    ['stable manifold', 'saddle']
    """
    from matplotlib.lines import Line2D

    listed = [manifolds] if isinstance(manifolds, Manifold) else list(manifolds)
    _alike(listed)
    given = ax is not None and ax.has_data()
    axes = axes_or_new(ax)
    _fits(axes, listed[0].over)
    scales = _scales(axes, listed[0])
    factors = np.array([scale.factor for scale in scales])
    inks = inks_of(axes)
    limits = axes.get_xlim(), axes.get_ylim()
    styles: dict[str, Any] = {"stable": "-", "unstable": DASHED}
    cased = bool(axes.images)
    seen = {manifold.kind: f"{manifold.kind} manifold" for manifold in listed}
    unnamed = dict(seen)
    for manifold in listed:
        for branch in manifold.branches:
            for piece in _pieces(branch, manifold.over):
                points = np.column_stack(piece) * factors
                if cased:
                    axes.plot(*points.T, color=inks.paper, lw=CASING, zorder=2.9)
                axes.plot(
                    *points.T,
                    color=inks.motion,
                    ls=styles[manifold.kind],
                    lw=WIDTH,
                    solid_joinstyle="round",
                    zorder=3.0 if manifold.kind == "stable" else 3.2,
                    label=unnamed.pop(manifold.kind, "_nolegend_"),
                )
    for manifold in listed:
        points = _saddle_points(manifold) * factors
        if len(points):
            for colour, width in ((inks.paper, 3.2), (inks.ink, 1.4)):
                saddle: dict[str, Any] = {"ms": 6.0, "mew": width, "ls": "none", "zorder": 4.2}
                axes.plot(*points.T, "x", color=colour, clip_on=given, **saddle)
    if given:
        axes.set(xlim=limits[0], ylim=limits[1])
    else:
        _frame(axes, listed, scales)
    chosen = legend if legend is not None or not given else "none"
    place = place_of(axes, chosen, "below")
    handles = [
        Line2D([], [], color=inks.motion, ls=styles[kind], lw=1.4, label=words)
        for kind, words in seen.items()
    ]
    if any(len(_saddle_points(manifold)) for manifold in listed):
        handles.append(
            Line2D([], [], ls="none", marker="x", color=inks.ink, ms=6.0, label="saddle")
        )
    if place != "none":
        before = axes.get_legend()
        draw_legend(axes, place, handles=handles)
        if before is not None and axes.get_legend() is not before:
            axes.add_artist(before)
    return axes


def _scales(axes: "Axes", manifold: Manifold) -> tuple[Scale, Scale]:
    """Return the scales of both coordinates: those of axes that are drawn on, else the block's."""
    if manifold.over == "phase":
        return plane_scales(axes, manifold.block)
    bare = palette.LABELS["speed"]
    speed = Scale(1.0, bare)
    if isinstance(manifold.block, Block) and axes.get_ylabel() != bare:
        factor = scale_of("velocity", manifold.block).factor
        speed = Scale(factor, palette.LABELS["speed_deg_s"], bare)
    return Scale(1.0, palette.LABELS["phase"]), speed


def _frame(axes: "Axes", manifolds: list[Manifold], scales: tuple[Scale, Scale]) -> None:
    """Set limits and labels of new axes."""
    right, up = scales
    window = np.max([manifold.window for manifold in manifolds], axis=0)
    reach = (window * (right.factor, up.factor)).tolist()
    axes.set(xlabel=right.label, ylabel=up.label)
    if manifolds[0].over == "phase":
        low = 0.0 if all(manifold.block.one_sided for manifold in manifolds) else -reach[0]
        axes.set(xlim=(low, reach[0]), ylim=(-reach[1], reach[1]))
        draw_far_axes(axes, right, up)
        return
    axes.set(xlim=(0.0, TURN), ylim=(0.0, reach[1]))
    turns = ("0", r"$\pi/2$", r"$\pi$", r"$3\pi/2$", r"$2\pi$")
    axes.set_xticks([0.25 * TURN * k for k in range(5)], turns)
    draw_far_axes(axes, right, up)


def _alike(manifolds: list[Manifold]) -> None:
    """Refuse manifolds that do not belong into one picture."""
    phases = {round(each.phase, 9) for each in manifolds if each.over == "phase"}
    overs = {each.over for each in manifolds}
    if len(overs) == 1 and len(phases) <= 1:
        return
    problem = "are none" if not manifolds else "are over " + " and ".join(sorted(overs))
    if len(phases) > 1:
        problem = f"are over {len(phases)} phases"
    raise ModelError(
        "manifolds",
        Words(problem),
        "one picture has those over one phase, or those over impacts",
        "give manifolds of one kind of section",
    )


def _fits(axes: "Axes", over: str) -> None:
    """Refuse manifolds over a phase on axes of impacts, and the other way round."""
    tilts = ("angle", "angle_at_start", "angle_deg", "angle_deg_at_start")
    drawn = {palette.LABELS["phase"]: "impacts"} | {palette.LABELS[name]: "phase" for name in tilts}
    quantity = drawn.get(axes.get_xlabel(), over)
    if quantity != over:
        names = {"impacts": "impacts", "phase": "states at a phase"}
        raise ModelError(
            "manifolds",
            Words(f"are over {names[over]} and the axes over {names[quantity]}"),
            "manifolds and axes are over the same section",
            f'compute them with over="{quantity}"',
        )


def _pieces(branch: ManifoldBranch, over: str) -> list[tuple[Floats, Floats]]:
    """Return the parts of a branch without jumps; over impacts cut where the phase begins again."""
    pieces = []
    for part in branch.pieces:
        x, y = branch.first[part], branch.second[part]
        cuts = np.zeros(0, dtype=np.int64)
        if over == "impacts":
            cuts = np.flatnonzero(np.abs(np.diff(x)) > 0.5 * TURN) + 1
        pieces += list(zip(np.split(x, cuts), np.split(y, cuts), strict=True))
    return pieces


def _saddle_points(manifold: Manifold) -> Floats:
    """Return where the saddle is in the plane of a manifold, shape (points, 2)."""
    saddle = manifold.saddle
    if manifold.over == "impacts":
        if isinstance(saddle, HilltopSaddle):
            return np.zeros((0, 2))
        return np.array([(state.phase, state.speed) for state in saddle.states])
    return saddle_at(saddle, manifold.phase)


def saddle_at(saddle: Orbit | HilltopSaddle, phase: float) -> Floats:
    """Return the states of a saddle at a phase of the shaking, shape (periods, 2)."""
    if isinstance(saddle, HilltopSaddle):
        angle, velocity = saddle.at(phase)
        return np.array([[float(angle), float(velocity)]])
    run = saddle.trajectory()
    since = (phase - saddle.states[0].phase) % TURN + TURN * np.arange(saddle.period)
    here = run(np.minimum(since / saddle.motion.frequency_ratio, run.end_time_pt))
    return np.column_stack([here.angle, here.velocity])
