"""Branches of orbits that come to rest, drawn as lines."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.dynamics.continuation.resting.resting_branch import RestingBranch
from rocksteady.show.plots.branches.views import View
from rocksteady.show.style.insets import Box, room_for_inset
from rocksteady.show.style.legends import line_scale
from rocksteady.show.style.tokens import inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LABEL = "rocks and rests"
RESTING: dict[str, Any] = {"ls": "-", "lw": 1.6, "zorder": 3.2}
END = 2.6
"""Size of the dot at an end: of a line as short as a dot nothing else shows."""
LOW = 0.12
"""Part of the axis of angles below which lines of rest hug the axis of the parameter."""


def draw_resting(axes: "Axes", branches: Sequence[RestingBranch], view: View) -> list[Floats]:
    """Draw branches of orbits with rest and return the places of each line.

    Of an unsymmetric orbit whose sides are drawn there is the mirror image too, where it is a
    motion.
    """
    colour, look = inks_of(axes).quiet, {**RESTING, "lw": RESTING["lw"] * line_scale(axes)}
    dot: dict[str, Any] = {"color": colour, "zorder": RESTING["zorder"]}
    lines = []
    for branch in branches:
        mirrored = not view.sizes and branch.block.symmetric and not branch.symmetric
        for values, legs in branch.pieces():
            shown = legs[:1] if view.sizes and branch.symmetric else legs
            for peaks in shown:
                for drawn in (peaks, -peaks) if mirrored else (peaks,):
                    y = view.y(drawn)
                    axes.plot(view.x(values), y, color=colour, **look)
                    lines += [np.column_stack([view.x(values), each]) for each in y.T]
        for place in (0, -1):
            extremes = branch.peaks[place]
            ends = {float(np.nanmax(extremes)), float(np.nanmin(extremes))}
            if view.sizes:
                ends = {max(abs(end) for end in ends)}
            elif mirrored:
                ends |= {-end for end in ends}
            x = [float(view.x(branch.values[place]))] * len(ends)
            axes.plot(x, view.y(sorted(ends)), "o", ms=END * line_scale(axes), mew=0.0, **dot)
    return lines


def low_rest(axes: "Axes", branches: Sequence[RestingBranch], view: View) -> Box | None:
    """Return the ends of orbits with rest that hug the axis: x, y, x, y in the units of the axes.

    Parameters
    ----------
    axes
        With their final limits and scales.
    branches
        The branches.
    view
        As for `draw_resting`.

    Returns
    -------
    tuple or None
        None where there are no such orbits, they are high enough to be seen, or the axes have no
        room for an inset.
    """
    if not branches or not room_for_inset(axes):
        return None
    values = view.x(np.concatenate([branch.values for branch in branches]))
    highest = max(float(np.nanmax(np.abs(view.y(branch.peaks)))) for branch in branches)
    if highest > LOW * axes.get_ylim()[1]:
        return None
    return float(values.min()), 0.0 if view.sizes else -highest, float(values.max()), highest
