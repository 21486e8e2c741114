"""Branches of orbits that come to rest, drawn as lines."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from rocksteady.dynamics.continuation.resting.resting_branch import RestingBranch
from rocksteady.show.style.insets import Box, room_for_inset
from rocksteady.show.style.legends import line_scale
from rocksteady.show.style.line_colours import inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.lines import Line2D

LABEL = "stable, comes to rest"
RESTING: dict[str, Any] = {"ls": "-", "lw": 1.6, "zorder": 3.2}
END = 2.6
"""Size of the dot at an end: of a line as short as a dot nothing else shows."""
LOW = 0.12
"""Part of the axis of angles below which lines of rest hug the axis of the parameter."""
NUMBER = 3
"""Of the colour among those of lines; the first and the fifth are those of other motions, and the
third is like one of a subharmonic."""


def draw_resting(axes: "Axes", branches: Sequence[RestingBranch], *, sizes: bool) -> list["Line2D"]:
    """Draw branches of orbits with rest and return the entry of the legend.

    Parameters
    ----------
    axes
        Axes to draw on.
    branches
        The branches.
    sizes
        Whether the sizes of the angles are drawn, without their sides; else of an unsymmetric
        orbit the mirror image too, where it is a motion.
    """
    from matplotlib.lines import Line2D

    colour, look = inks_of(axes).lines[NUMBER], {**RESTING, "lw": RESTING["lw"] * line_scale(axes)}
    dot: dict[str, Any] = {"color": colour, "zorder": RESTING["zorder"]}
    for branch in branches:
        mirrored = not sizes and branch.block.symmetric and not branch.symmetric
        for values, legs in branch.pieces():
            shown = legs[:1] if sizes and branch.symmetric else legs
            for peaks in shown:
                lines = np.abs(peaks) if sizes else peaks
                axes.plot(values, lines, color=colour, **look)
                if mirrored:
                    axes.plot(values, -peaks, color=colour, **look)
        for place in (0, -1):
            extremes = branch.peaks[place]
            ends = {float(np.nanmax(extremes)), float(np.nanmin(extremes))}
            if sizes:
                ends = {max(abs(end) for end in ends)}
            elif mirrored:
                ends |= {-end for end in ends}
            x = [float(branch.values[place])] * len(ends)
            axes.plot(x, sorted(ends), "o", ms=END * line_scale(axes), mew=0.0, **dot)
    return [Line2D([], [], color=colour, label=LABEL, **RESTING)] if branches else []


def low_rest(axes: "Axes", branches: Sequence[RestingBranch], *, sizes: bool) -> Box | None:
    """Return the ends of orbits with rest that hug the axis: x, y, x, y in the units of the axes.

    Parameters
    ----------
    axes
        With their final limits and scales.
    branches
        The branches.
    sizes
        As for `draw_resting`.

    Returns
    -------
    tuple or None
        None where there are no such orbits, they are high enough to be seen, or the axes have no
        room for an inset.
    """
    if not branches or not room_for_inset(axes):
        return None
    values = np.concatenate([branch.values for branch in branches])
    highest = max(float(np.nanmax(np.abs(branch.peaks))) for branch in branches)
    if highest > LOW * axes.get_ylim()[1]:
        return None
    return float(values.min()), 0.0 if sizes else -highest, float(values.max()), highest
