"""Names of lines at their ends, beside the axes, instead of a legend."""

from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

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
    values: Floats
    """Its ordinates; the last finite one is its end."""
    colour: str


def name_line_ends(
    axes: "Axes", lines: Sequence[LineEnd], *, title: str = "", most: float = 1.0
) -> None:
    """Write the names of lines to the right of axes, as near to their ends as they fit.

    Parameters
    ----------
    axes
        With their final limits and scales.
    lines
        Those with a name.
    title
        Above the names: what they are values of.
    most
        Greatest height of a name, in parts of the axes; default 1.
    """
    size = text_size(axes, 8.0)
    step = APART * size / size_of(axes)[1]
    places = [_height(axes, line.values) for line in lines]
    order = np.argsort(places, kind="stable")
    heights = np.array(places)[order]
    rows = [1 + lines[index].name.count("\n") for index in order]
    steps = [0.5 * step * (low + high) for low, high in pairwise(rows)]
    for k, apart in enumerate(steps, 1):  # none over the one beneath it
        heights[k] = max(heights[k], heights[k - 1] + apart)
    heights -= max(0.0, heights[-1] - most) if len(heights) else 0.0
    for k, apart in reversed(list(enumerate(steps))):
        heights[k] = min(heights[k], heights[k + 1] - apart)
    entries = [
        (lines[index].name, height, lines[index].colour)
        for index, height in zip(order.tolist(), heights.tolist(), strict=True)
    ]
    if title:
        above = max(most, heights[-1]) + step * (1.3 + 0.5 * title.count("\n"))
        entries.append((title, above, axes.yaxis.label.get_color()))
    for text, height, colour in entries:
        axes.annotate(
            text,
            (1.0, height),
            (ASIDE, 0.0),
            xycoords="axes fraction",
            textcoords="offset points",
            va="center",
            fontsize=size,
            color=colour,
            annotation_clip=False,
        )


def _height(axes: "Axes", values: Floats) -> float:
    """Return the height of the end of a line, in parts of the axes."""
    finite = values[np.isfinite(values)]
    end = float(finite[-1]) if len(finite) else axes.get_ylim()[0]
    (_, height) = axes.transAxes.inverted().transform(axes.transData.transform((1.0, end)))
    return min(1.0, max(0.0, float(height)))
