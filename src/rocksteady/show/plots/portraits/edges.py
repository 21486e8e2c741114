"""Plots of edge states and of the motions tracked to them."""

from typing import TYPE_CHECKING, Any

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.dynamics.edges.edge_state import EdgeState
from rocksteady.dynamics.edges.hilltop import HilltopSaddle
from rocksteady.dynamics.orbits.orbit import Orbit
from rocksteady.model.checks.arguments import checked
from rocksteady.show.plots.portraits._window import plane_scales
from rocksteady.show.plots.portraits.manifolds import saddle_at
from rocksteady.show.style.insets import LARGEST, draw_inset, room_for_inset
from rocksteady.show.style.layout import axes_or_new
from rocksteady.show.style.legends import LegendPlace, draw_legend, place_of
from rocksteady.show.style.scales import draw_far_axes
from rocksteady.show.style.tokens import DASHED, inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@checked
def plot_edge_state(
    edge: EdgeState | HilltopSaddle,
    ax: "Axes | None" = None,
    *,
    legend: LegendPlace | None = None,
) -> "Axes":
    """Draw an edge state over angle and velocity, with the motion tracked to it.

    The dashed line is the course of the saddle over its period, the cross where it is at the phase
    of the shaking.  Dots are the tracked motion at that phase, joined in their order;
    filled marks are the states between which the border was sought.

    Parameters
    ----------
    edge
        From `rocksteady.find_edge_state` or `rocksteady.basins.find_hilltop_saddles`.
    ax
        Axes to draw on; default: axes of a new figure.
    legend
        "inside" the axes, to their "right", "below" them or "none"; by default below.

    Returns
    -------
    matplotlib.axes.Axes
        The axes: tilt [degrees] and its velocity [degrees/s] of a block with sizes, else
        u = theta/alpha and d(theta/alpha)/d(pt).

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import DimensionlessBlock, Harmonic, find_edge_state
    >>> motion = Harmonic(amplitude=0.2, frequency_ratio=2.0)
    >>> edge = find_edge_state(DimensionlessBlock(restitution=0.9), motion)
    >>> axes = plot_edge_state(edge, Figure().add_subplot())
    >>> [text.get_text() for text in axes.get_legend().get_texts()][:2]
    ['hilltop saddle', 'saddle at this phase']
    """
    given = ax is not None and ax.has_data()
    axes = axes_or_new(ax)
    right, up = plane_scales(axes, edge.block)
    factors = np.array([right.factor, up.factor])
    limits = axes.get_xlim(), axes.get_ylim()
    saddle = edge if isinstance(edge, HilltopSaddle) else edge.saddle
    _draw(axes, edge, saddle, factors)
    if given:
        axes.set(xlim=limits[0], ylim=limits[1])
    else:
        axes.set(xlabel=right.label, ylabel=up.label)
        axes.margins(0.08)
        if isinstance(edge, EdgeState) and len(np.unique(edge.angle)) == 1:
            axes.set(xlim=(edge.angle[0] + np.array([-1.0, 1.0])) * right.factor)
        draw_far_axes(axes, right, up)
        if saddle is not None:
            _magnify(axes, edge, saddle, factors)
    place = place_of(axes, legend, "below")
    if place != "none":
        draw_legend(axes, place)
    return axes


def _draw(
    axes: "Axes",
    edge: EdgeState | HilltopSaddle,
    saddle: Orbit | HilltopSaddle | None,
    factors: Floats,
) -> None:
    """Draw the course of the saddle, and what is tracked to it."""
    inks = inks_of(axes)
    right, up = factors.tolist()
    if saddle is not None:
        words = "hilltop saddle"
        if not isinstance(saddle, HilltopSaddle):
            words = f"unstable orbit, period {saddle.period}"
        course = np.column_stack(saddle.trajectory().phase_path()) * factors
        axes.plot(*course.T, color=inks.motion, ls=DASHED, lw=1.6, label=words)
        points = saddle_at(saddle, edge.motion.phase) * factors
        cross: dict[str, Any] = {"ms": 6.5, "ls": "none", "zorder": 4.0}
        axes.plot(*points.T, "x", mew=3.4, color=inks.paper, **cross)
        axes.plot(*points.T, "x", mew=1.5, color=inks.ink, label="saddle at this phase", **cross)
    if isinstance(edge, EdgeState):
        axes.plot(
            edge.angle * right,
            edge.velocity * up,
            "o-",
            ms=3.2,
            lw=0.6,
            color=inks.edge,
            mfc=inks.quiet,
            mec=inks.quiet,
            zorder=3.0,
            label="tracked, period by period",
        )
        ends = zip((edge.start, edge.other), edge.outcomes, "os", strict=True)
        for state, outcome, mark in ends:
            axes.plot(
                state.angle * right,
                state.velocity * up,
                mark,
                ms=5.5,
                mfc=inks.ink,
                mec=inks.paper,
                ls="none",
                zorder=3.5,
                label="from here: "
                + (
                    "comes to rest" if outcome == "rest" else outcome.replace("overturned", "falls")
                ),
            )


def _magnify(
    axes: "Axes", edge: EdgeState | HilltopSaddle, saddle: Orbit | HilltopSaddle, factors: Floats
) -> None:
    """Draw the course of the saddle again in an inset, where it is small and there is room."""
    course = np.column_stack(saddle.trajectory().phase_path()) * factors
    low, high = course.min(axis=0), course.max(axis=0)
    if (
        room_for_inset(axes)
        and ((high - low) < LARGEST * np.ptp([axes.get_xlim(), axes.get_ylim()], axis=1)).all()
    ):
        drawn = [np.asarray(line.get_xydata(), dtype=np.float64) for line in axes.lines]
        spots = [(float(x), float(y)) for line in drawn[1:] for x, y in line]
        inset = draw_inset(axes, (*low.tolist(), *high.tolist()), drawn, spots)
        if inset is not None:
            limits = inset.get_xlim(), inset.get_ylim()
            _draw(inset, edge, saddle, factors)
            inset.set(xlim=limits[0], ylim=limits[1])
