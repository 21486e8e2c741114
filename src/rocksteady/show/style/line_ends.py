"""Names of lines and rows at their ends, beside the axes, instead of a legend."""

from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.show.style.legends import size_of, text_size

if TYPE_CHECKING:
    from matplotlib.axes import Axes

APART = 1.25
"""Distance of names, in parts of their size."""
ASIDE = 4.0
"""Distance of names from the axes [points]."""


class LineEnd(NamedTuple):
    """A line with a name."""

    name: str
    values: ArrayLike
    """Its ordinates; the last finite one is its end."""
    colour: str


def name_line_ends(
    axes: "Axes", lines: Sequence[LineEnd], *, title: str = "", most: float = 1.0
) -> None:
    """Write the names of lines to the right of axes, as near to their ends as they fit.

    Parameters
    ----------
    axes
        With their data, and their final scales.
    lines
        Lines with a name.
    title
        Above the names: what they are values of.
    most
        Greatest height of a name, in parts of the axes; default 1.
    """
    size = text_size(axes, 8.0)
    step = APART * size / size_of(axes)[1]
    places = np.array([_height(axes, line.values) for line in lines])
    order = np.argsort(places, kind="stable")
    rows = [1 + lines[index].name.count("\n") for index in order]
    steps = [0.5 * step * (low + high) for low, high in pairwise(rows)]
    heights = spread_heights(places[order], steps, lowest=0.0, highest=most)
    entries = [
        (lines[index].name, height, lines[index].colour)
        for index, height in zip(order.tolist(), heights.tolist(), strict=True)
    ]
    if title:
        above = max(heights.tolist()) + step * (1.3 + 0.5 * title.count("\n"))
        entries.append((title, above, axes.yaxis.label.get_color()))
    for text, height, colour in entries:
        write_beside(axes, text, height, colour, size)


def write_beside(
    axes: "Axes",
    words: str,
    height: float,
    colour: str,
    size: float,
    *,
    aside: float = ASIDE,
    of_row: bool = False,
) -> None:
    """Write words to the right of axes.

    Parameters
    ----------
    axes
        Axes to write beside.
    words
        What is written.
    height
        Height of its middle, in parts of the axes.
    colour, size
        Its colour, and its size [points].
    aside
        Distance from the axes [points].
    of_row
        Whether the height is an ordinate: that of a row of bars.
    """
    axes.annotate(
        words,
        (1.0, height),
        (aside, 0.0),
        xycoords=("axes fraction", "data") if of_row else "axes fraction",
        textcoords="offset points",
        va="center",
        fontsize=size,
        color=colour,
        annotation_clip=False,
    )


def spread_heights(
    heights: Floats, steps: Sequence[float], *, lowest: float, highest: float
) -> Floats:
    """Return ascending heights, moved as little as possible until they are far enough apart.

    Parameters
    ----------
    heights
        Where names are wanted.
    steps
        Least distances of neighbours, one fewer than heights.
    lowest, highest
        Ends between which they stay; what has no room there goes on above the lowest.

    Examples
    --------
    >>> spread_heights(np.array([2.0, 3.0, 9.0]), [4.0, 4.0], lowest=0.0, highest=20.0)
    array([0.5, 4.5, 9. ])
    >>> spread_heights(np.array([2.0, 3.0, 9.0]), [4.0, 4.0], lowest=2.0, highest=20.0)
    array([ 2.,  6., 10.])
    """
    offsets = np.concatenate([np.zeros(1), np.cumsum(steps)])[: len(heights)]
    groups: list[list[float]] = []
    for height in heights - offsets:
        groups.append([float(height)])
        while len(groups) > 1 and np.mean(groups[-2]) > np.mean(groups[-1]):
            groups[-2:] = [groups[-2] + groups[-1]]
    means = np.concatenate([np.zeros(0), *(np.full(len(k), np.mean(k)) for k in groups)])
    top = highest - offsets[-1] if len(offsets) else highest
    spread: Floats = offsets + np.maximum(np.minimum(means, top), lowest)
    return spread


def _height(axes: "Axes", values: ArrayLike) -> float:
    """Return the height of the end of a line, in parts of the axes."""
    ordinates = np.ravel(np.asarray(values, dtype=np.float64))
    finite = ordinates[np.isfinite(ordinates)]
    end = float(finite[-1]) if len(finite) else axes.get_ylim()[0]
    axes.get_ylim()  # which settles what is scaled to the data
    (_, height) = axes.transAxes.inverted().transform(axes.transData.transform((1.0, end)))
    return min(1.0, max(0.0, float(height)))
