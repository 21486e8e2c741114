"""Cells along an axis: their edges, the axis drawn for them, and bars where some are chosen."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rocksteady.arrays import Floats, Integers
from rocksteady.show.style import palette
from rocksteady.show.style.layout import spaced_by_ratio
from rocksteady.show.style.legends import size_of, text_size

if TYPE_CHECKING:
    from matplotlib.axes import Axes


SIGNED = ("angle", "velocity", "phase", "kick")
"""Axes whose values may be below 0; the cells of all others are cut off there."""
MOST_TICKS = 8
"""Values of an axis up to which each has its own tick."""
LANE = 8.0
"""Height of a row of bars along the upper edge [points]."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Spacing:
    """The cells along an axis, each around its value.

    Attributes
    ----------
    edges
        Between them and at both ends, ascending, one more than there are cells.
    logarithmic
        Whether the values are spread like powers: the edges are midway in the logarithm then.
    even
        Whether the cells are equally wide as drawn.
    """

    edges: Floats
    logarithmic: bool
    even: bool

    @property
    def ends(self) -> tuple[float, float]:
        """The outermost edges in the scale of the axis: their logarithms on a logarithmic one."""
        ends = self.edges[[0, -1]]
        low, high = np.log10(ends).tolist() if self.logarithmic else ends.tolist()
        return low, high


def spacing_of(values: ArrayLike) -> Spacing:
    """Return the cells around two ascending values or more.

    Examples
    --------
    >>> spacing_of([1.0, 2.0, 3.0]).edges
    array([0.5, 1.5, 2.5, 3.5])
    >>> spacing_of([1.0, 4.0, 16.0]).edges
    array([ 0.5,  2. ,  8. , 32. ])
    """
    array = np.asarray(values, dtype=np.float64)
    logarithmic = spaced_by_ratio(array)
    at = np.log2(array) if logarithmic else array
    step = (at[-1] - at[0]) / (len(at) - 1)
    even = bool(np.abs(at - np.linspace(at[0], at[-1], len(at))).max() < 1e-3 * step)
    if even:
        edges = np.linspace(at[0] - 0.5 * step, at[-1] + 0.5 * step, len(at) + 1)
    else:  # the outermost cells are as wide as their inner halves suggest
        middles = 0.5 * (at[1:] + at[:-1])
        edges = np.concatenate([[2.0 * at[0] - middles[0]], middles, [2.0 * at[-1] - middles[-1]]])
    return Spacing(
        edges=np.exp2(edges) if logarithmic else edges, logarithmic=logarithmic, even=even
    )


def picked(edges: Floats, most: int) -> tuple[Integers, Floats]:
    """Return which cells are drawn where they are too many, and the edges of what each stands for.

    A majority or a mean would show what no cell has found.

    Examples
    --------
    >>> picked(np.arange(8.0), 3)
    (array([1, 3, 5]), array([0., 2., 4., 7.]))
    """
    count = len(edges) - 1
    drawn = min(count, most)
    borders = np.arange(drawn + 1) * count // drawn
    return (borders[1:] + borders[:-1]) // 2, edges[borders]


def runs(chosen: NDArray[np.bool_], edges: Floats) -> list[tuple[float, float]]:
    """Return begin and width of each run of cells.

    Examples
    --------
    >>> runs(np.array([True, True, False, True]), np.array([0.5, 1.5, 2.5, 3.5, 4.5]))
    [(0.5, 2.0), (3.5, 1.0)]
    """
    change = np.flatnonzero(np.diff(np.concatenate([[False], chosen, [False]]).astype(np.int8)))
    ends = edges[change].reshape(-1, 2)
    return [(first, last - first) for first, last in ends.tolist()]


def lane_of(axes: "Axes") -> float:
    """Return the height of a row of bars, in parts of the axes."""
    return min(0.12, LANE / size_of(axes)[1])


def name_lane(
    axes: "Axes", name: str, bars: Sequence[tuple[float, float]], height: float, colour: str
) -> None:
    """Write the name of a row of bars beside the last of them, at a height in parts of the axes."""
    axes.annotate(
        name,
        (min(max(left + width for left, width in bars), max(axes.get_xlim())), height),
        (3.0, 0.0),
        xycoords=axes.get_xaxis_transform(),
        textcoords="offset points",
        va="center",
        fontsize=text_size(axes, 7.0),
        color=colour,
        annotation_clip=False,
    )


def prepare_axis(
    axes: "Axes", which: str, name: str, values: Floats, spacing: Spacing, label: str = ""
) -> None:
    """Give an axis its scale, its limits, its label (by default that of its name) and its ticks."""
    from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter

    if spacing.logarithmic:
        axes.set(**{f"{which}scale": "log"})
    low, high = float(spacing.edges[0]), float(spacing.edges[-1])
    if name not in SIGNED and values[0] >= 0.0:
        low = max(low, 0.0)
    axes.set(**{f"{which}lim": (low, high), f"{which}label": label or palette.axis_label(name)})
    axis = axes.xaxis if which == "x" else axes.yaxis
    labels = [f"{value:.4g}" for value in values[: MOST_TICKS + 1].tolist()]
    if len(labels) <= MOST_TICKS and max(map(len, labels)) <= 4:
        axis.set_ticks(values.tolist(), labels)
        axis.set_ticks([], minor=True)
    elif spacing.logarithmic and high < 1e4 * low:
        axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if high < 300.0 * low else (1.0,)))
        axis.set_major_formatter(StrMethodFormatter("{x:g}"))
        axis.set_minor_formatter(NullFormatter())
