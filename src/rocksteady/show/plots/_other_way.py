"""Line from which on a block falls under the reversed motion."""

from typing import TYPE_CHECKING

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.dynamics.overturning.window_lists import WindowLists
from rocksteady.show.style.areas import write_upon
from rocksteady.show.style.legends import text_size
from rocksteady.show.style.tokens import inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LETTERS = 8.5
"""Size of the name [points]."""
BELOW = 0.05
"""Part of the axes by which the name stands below a line."""
ROOM = 0.2
"""Part of the axes that the name needs on either side."""


def draw_other_way(axes: "Axes", windows: WindowLists, x: Floats, y: Floats) -> bool:
    """Draw the least amplitude of the reversed motion, where it differs; return whether it does.

    Parameters
    ----------
    axes
        Axes to draw on, with limits.
    windows
        What was searched.
    x, y
        Points of the line; nan where there is none.
    """
    if np.array_equal(windows.first, windows.opposite, equal_nan=True):
        return False
    inks = inks_of(axes)
    for colour, width in ((inks.paper, 3.2), (inks.limit, 1.4)):  # seen on what falls
        axes.plot(x, y, color=colour, lw=width, zorder=3.1, solid_capstyle="butt")
    to_axes = axes.transData + axes.transAxes.inverted()
    places = to_axes.transform(np.column_stack([x, y]))
    seen = places[((places >= 0.0) & (places <= 1.0)).all(axis=1)].tolist()
    if seen:
        upright = np.ptp(x[np.isfinite(x)]) == 0.0
        across, up = np.mean(seen, axis=0).tolist() if upright else seen[len(seen) // 2]
        place = min(max(across, ROOM), 1.0 - ROOM), up if upright else up - BELOW
        size = text_size(axes, LETTERS)
        name = "falls the other way →" if upright else "↑ falls the other way"
        write_upon(axes, name, place, inks.paper, size, zorder=5.6)
    return True
