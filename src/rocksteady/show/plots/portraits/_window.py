"""Windows of initial states: their cells, patterns and words, in the units of their block."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats
from rocksteady.dynamics.basins.basins import Basins
from rocksteady.dynamics.basins.erosion import Erosion
from rocksteady.dynamics.basins.fate_basins import FateBasins
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.show.style import palette
from rocksteady.show.style.areas import Area, draw_pattern, pattern_ink, write_words
from rocksteady.show.style.legends import GAP, size_of
from rocksteady.show.style.scales import FAR_ROOM, Scale, draw_far_axes, scale_of
from rocksteady.show.style.tokens import inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes


OUTLINE = 0.7
"""Width of the line around areas of the colour of paper [points]."""
LEAST_START = 120.0
"""Width of axes [points] from which on their labels say that a state is the one at the start."""


class Window(NamedTuple):
    """Where a window of initial states is drawn."""

    ends: tuple[float, float, float, float]
    """Lowest and highest abscissa, lowest and highest ordinate."""
    factors: Floats
    """Factors of angles and velocities before they are drawn, shape (2,)."""
    gap: float
    """Room between the axes and a legend to their right [points]."""


def draw_window(
    axes: "Axes",
    states: Basins | Erosion | FateBasins,
    codes: NDArray[Any],
    areas: Sequence[Area],
    marks: Sequence[Floats] = (),
) -> Window:
    """Fill each state of a window of angles and velocities by its code; return where it is drawn.

    Parameters
    ----------
    axes
        Axes to draw on, which get their labels.
    states
        Angles and velocities of the window, and their block.
    codes
        Number of the area of each state, shape (velocities, angles).
    areas
        How they are drawn, by number.
    marks
        States that the words leave free, each of shape (states, 2).
    """
    from matplotlib.colors import ListedColormap

    inks = inks_of(axes)
    at_start = size_of(axes)[0] >= LEAST_START
    right, up = (scale_of(name, states.block, at_start=at_start) for name in ("angle", "velocity"))
    factors = np.array([right.factor, up.factor])
    columns, rows = (_even_edges(axis) for axis in (states.angle, states.velocity))
    columns, rows = columns * right.factor, rows * up.factor
    ends = (*columns[[0, -1]].tolist(), *rows[[0, -1]].tolist())
    axes.imshow(
        codes,
        cmap=ListedColormap([area.fill for area in areas]),
        vmin=-0.5,
        vmax=len(areas) - 0.5,
        extent=ends,
        origin="lower",
        aspect="auto",
        interpolation="nearest",
    )
    for code, area in enumerate(areas):
        where, ink = codes == code, pattern_ink(area.fill)
        if area.fill == inks.paper:  # on dark paper hardly lighter than what falls
            draw_pattern(axes, (columns, rows), where, "", inks.edge, outline=OUTLINE)
        draw_pattern(axes, (columns, rows), where, area.hatch, ink)
    axes.grid(visible=False)
    axes.set(xlabel=right.label, ylabel=up.label, xlim=ends[:2], ylim=ends[2:])
    named = {code: (area.word, area.fill) for code, area in enumerate(areas) if area.word}
    clear = np.concatenate([np.zeros((0, 2)), *marks]) * factors
    write_words(axes, (columns, rows), codes, named, clear)
    gap = FAR_ROOM + GAP if draw_far_axes(axes, right, up) else GAP
    return Window(ends, factors, gap)


def plane_scales(axes: "Axes", block: Block | DimensionlessBlock) -> tuple[Scale, Scale]:
    """Return the scales of angle and velocity: those of axes with data, else the block's."""
    bare = {palette.LABELS[name] for name in ("angle", "angle_at_start")}
    units = None if axes.get_xlabel() in bare else block
    return scale_of("angle", units), scale_of("velocity", units)


def _even_edges(axis: Floats) -> Floats:
    """Return the edges of equal cells around the points of an axis."""
    half = 0.5 * float(axis[-1] - axis[0]) / (len(axis) - 1)
    return np.linspace(float(axis[0]) - half, float(axis[-1]) + half, len(axis) + 1)
