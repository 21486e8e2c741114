"""Layout of plots: choice of axes, positions of legends and labels, logarithmic scales."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.dynamics.steady.regions import RegionMap
from rocksteady.show.style import palette
from rocksteady.show.style.legends import (
    LETTER,
    SMALL,
    LegendPlace,
    figure_of,
    place_of,
    size_of,
    text_size,
)
from rocksteady.show.style.tokens import inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Corner = Literal["upper left", "upper right", "lower left", "lower right"]
CORNERS: dict[Corner, tuple[int, int]] = {
    "upper left": (0, 1),
    "upper right": (1, 1),
    "lower left": (0, 0),
    "lower right": (1, 0),
}
"""Places of a legend, in the order of preference, with the corner in fractions of the axes."""


LABEL_PLACES = [
    (radius * math.cos(turn), radius * math.sin(turn))
    for radius in (8.5, 12.0, 16.0, 21.0)
    for turn in (math.radians(angle) for angle in (45, 135, 90, 0, 180, 315, 225, 270))
]
"""Where a label may stand [points], seen from its point, in the order of preference."""


FEWEST_TICKS = 3
"""Ticks of a logarithmic axis below which those of a linear one are taken."""
PLAIN = 8e-5
"""End of an axis below which its ticks are powers of ten."""
LONGEST_NAME = 0.45
"""Of a row of bars beside it, in parts of the width of axes without their labels."""
HEIGHT_OF_ROW = 19.0
"""Of a bar and the name over it, at least [points]."""
LEAST_ROOM = 1.0 / 32.0
"""Room for the number of a region to all sides, in parts of the height, at least."""
TICK_ROOM = 62.0
"""Length of a decade [points] below which it has one tick."""


def axes_or_new(ax: "Axes | None") -> "Axes":
    """Return the given axes, or those of a new pyplot figure in the house style.

    The new figure has the user's own settings where there are any: its size, a dark theme.
    """
    if ax is not None:
        return ax
    import matplotlib.pyplot as plt

    # Outside of the style: the first figure loads the backend, which brings settings of its own.
    figure = plt.figure(layout="constrained")
    with palette.style_beneath():
        return figure.add_subplot()


def emptiest_corner(axes: "Axes", points: Sequence[ArrayLike], size: tuple[float, float]) -> Corner:
    """Return the corner in which a legend hides fewest points, the upper left one if several do.

    Parameters
    ----------
    axes
        With their final limits and scales.
    points
        Abscissas and ordinates, two arrays of one shape.
    size
        Width and height of the legend in fractions of the axes.
    """
    x, y = (np.asarray(values, dtype=np.float64).ravel() for values in points)
    places = axes.transAxes.inverted().transform(axes.transData.transform(np.column_stack([x, y])))

    def hidden(corner: tuple[int, int]) -> int:
        near = [
            (places[:, k] > 1.0 - size[k] if corner[k] else places[:, k] < size[k])
            & (places[:, k] >= 0.0)
            & (places[:, k] <= 1.0)
            for k in (0, 1)
        ]
        return int((near[0] & near[1]).sum())

    return min(CORNERS, key=lambda name: hidden(CORNERS[name]))


def clear_place(axes: "Axes", legend: object, labels: Sequence[str]) -> tuple[LegendPlace, Corner]:
    """Return where a legend hides no line and no mark: in a corner of the axes, or below them.

    Parameters
    ----------
    axes
        With their data, and their final limits and scales.
    legend
        A place, or None for the default.
    labels
        Its entries, one below the other.
    """
    from matplotlib.transforms import Bbox

    axes.apply_aspect()
    axes.get_xlim(), axes.get_ylim()  # which settles limits that are not yet known
    size, box = text_size(axes, 8.0), axes.bbox
    letters = max(map(len, labels), default=0)
    per_point = figure_of(axes).dpi / 72.0
    wide = per_point * (LETTER * size * letters + 4.5 * size)
    high = per_point * (1.6 * size * len(labels) + 8.0)
    lines = [line for line in axes.lines if line.get_linestyle() != "None"]
    rings = [patch for patch in axes.patches if not patch.get_fill()]
    drawn: Any = [*lines, *rings]
    paths = [each.get_transform().transform_path(each.get_path()) for each in drawn]
    bars = [each for each in axes.collections if hasattr(each, "get_segments")]
    paths += [each.get_transform().transform_path(p) for each in bars for p in each.get_paths()]
    places = [line.get_transform().transform(line.get_xydata()) for line in axes.lines]

    def free(right: int, upper: int) -> bool:
        x, y = box.x0 + right * (box.width - wide), box.y0 + upper * (box.height - high)
        corner = Bbox.from_bounds(x, y, wide, high)
        within = any(corner.count_contains(each) for each in places if len(each))
        return not within and not any(path.intersects_bbox(corner, filled=False) for path in paths)

    corners = [name for name, place in CORNERS.items() if free(*place)]
    return place_of(axes, legend, "inside" if corners else "below"), [*corners, "upper right"][0]


def put_beside(
    axes: "Axes", labels: Sequence[tuple[str, float, float]], marks: Sequence[ArrayLike]
) -> None:
    """Write short labels beside their points, clear of one another and of the marks.

    Parameters
    ----------
    axes
        With their final limits and scales.
    labels
        Text, abscissa and ordinate of each; an empty text is none.
    marks
        Abscissas and ordinates of what is drawn there, two arrays of one shape.
    """
    figure = figure_of(axes)
    per_point = figure.dpi / 72.0
    xy = np.column_stack([np.asarray(values, dtype=np.float64).ravel() for values in marks])
    taken = [(x, y, 4.0, 4.0) for x, y in (axes.transData.transform(xy) / per_point).tolist()]
    box = (np.array(axes.get_window_extent().extents) / per_point).tolist()
    for text, x, y in labels:
        if not text:
            continue
        here = axes.transData.transform((x, y)) / per_point
        half = (2.4 * len(text) + 0.6, 4.0)

        def crowd(
            offset: tuple[float, float], here: ArrayLike = here, half: tuple[float, float] = half
        ) -> float:
            """Return how much of the label would lie on something."""
            at = (np.asarray(here) + offset).tolist()
            outside: float = max(
                box[0] - at[0], at[0] - box[2], box[1] - at[1], at[1] - box[3], -5.0
            )
            over: float = 100.0 * (outside + 5.0)
            for px, py, wide, high in taken:
                across = wide + half[0] - abs(px - at[0])
                up = high + half[1] - abs(py - at[1])
                over += max(across, 0.0) * max(up, 0.0)
            return over

        offset = min(LABEL_PLACES, key=crowd)
        taken.append((*(here + offset).tolist(), *half))
        axes.annotate(
            text,
            (x, y),
            offset,
            textcoords="offset points",
            ha="center",
            va="center_baseline",
            fontsize=7.0,
            color=inks_of(axes).ink,
            zorder=5.0,
            annotation_clip=False,
        )


def name_rows(axes: "Axes", names: Sequence[str], *, bars: bool = False, **text: Any) -> None:
    """Name the rows 0, 1, 2, ... of axes, the first on top; `text` sets how they are written.

    Names of `bars` that are too long to stand beside them stand over them.
    """
    inks, size = inks_of(axes), text_size(axes, 8.0)
    share, high = _rows_room(axes, names)
    over = bars and share > LONGEST_NAME and high
    axes.set_yticks(range(len(names)), [""] * len(names) if over else names, **text)
    axes.set_ylim(len(names) - 0.4, -0.9 if over else -0.6)
    axes.tick_params(axis="y", length=0.0)
    axes.grid(visible=False, axis="y")
    style: dict[str, Any] = {"fontsize": size, "color": inks.ink, "va": "bottom", "zorder": 3.5}
    style |= {"xycoords": axes.get_yaxis_transform(), "textcoords": "offset points"}
    for place, name in enumerate(names if over else ()):
        box = {"fc": inks.paper, "ec": "none", "pad": 0.0}
        axes.annotate(name, (0.0, place - 0.3), (2.0, 0.0), bbox=box, **style)


def _rows_room(axes: "Axes", names: Sequence[str]) -> tuple[float, bool]:
    """Return the width of names over that of axes, and whether rows are as high as both."""
    wide, high = size_of(axes)
    share = LETTER * text_size(axes, 8.0) * max(map(len, names)) / wide
    return share, high > HEIGHT_OF_ROW * len(names)


def extent(axes: "Axes", *, width: float, height: float) -> tuple[float, float]:
    """Return a size in points as fractions of the axes, at most the whole of them."""
    wide, high = size_of(axes)
    return min(1.0, width / wide), min(1.0, height / high)


def spaced_by_ratio(values: ArrayLike) -> bool:
    """Return whether positive numbers are spread like powers, and belong on a logarithmic axis."""
    array = np.asarray(values, dtype=np.float64)
    low, high = float(array.min()), float(array.max())
    return low > 0.0 and float(np.median(array)) < low + 0.25 * (high - low)


def plain_ticks(axes: "Axes") -> None:
    """Write the ticks of logarithmic axes as numbers."""
    from matplotlib.ticker import (
        FixedLocator,
        FuncFormatter,
        Locator,
        LogFormatterMathtext,
        LogLocator,
        MaxNLocator,
        NullFormatter,
    )

    for axis, scale in ((axes.xaxis, axes.get_xscale()), (axes.yaxis, axes.get_yscale())):
        if scale == "log":
            low, high = axis.get_view_interval()
            room = size_of(axes)[0 if axis is axes.xaxis else 1]
            sparse = room < TICK_ROOM * math.log10(high / low)
            locator: Locator = LogLocator(subs=(1.0,) if sparse else (1.0, 2.0, 5.0))
            within = [at for at in locator.tick_values(low, high) if low <= at <= high]
            if len(within) < FEWEST_TICKS and high < 10.0 * low:
                even = MaxNLocator(4, steps=[1, 2, 2.5, 5, 10]).tick_values(low, high)
                locator = FixedLocator([at for at in even if low <= at <= high])
            axis.set_major_locator(locator)
            plain = FuncFormatter(lambda value, _: f"{value:.12f}".rstrip("0").rstrip("."))
            axis.set_major_formatter(plain if low > PLAIN else LogFormatterMathtext())
            axis.set_minor_formatter(NullFormatter())


def percent_ticks(axes: "Axes", which: Literal["x", "y"]) -> None:
    """Write the ticks of a probability in per cent, and show all from 0 to 100 %.

    Across a narrow figure stand 0, 50 and 100 % alone.
    """
    axis = axes.xaxis if which == "x" else axes.yaxis
    narrow = which == "x" and 72.0 * figure_of(axes).get_figwidth() < SMALL
    ticks = np.linspace(0.0, 1.0, 3 if narrow else 5)
    axis.set_ticks(ticks, [f"{100.0 * tick:.0f}\N{NO-BREAK SPACE}%" for tick in ticks])
    axes.set(**{f"{which}lim": (-0.03, 1.03)})


def region_centres(
    curves: RegionMap,
    ceiling: float,
    floor: float,
    *,
    point: tuple[float, float] | None = None,
    taken: tuple[float, ...] = (0.0, 0.0, 0.0, 0.0),
    least: float = LEAST_ROOM,
) -> dict[int, tuple[float, float]]:
    """Return where each region has most room for its number; too narrow ones are left out.

    Parameters
    ----------
    curves
        The map, its frequencies in ascending order.
    ceiling, floor
        Ends of the amplitude axis; it is logarithmic where the floor is above 0.
    point
        A marked (frequency_ratio, amplitude), from which the numbers keep away.
    taken
        Ends of a legend's box in parts of the axes: x, y, x, y.
    least
        Room for a number to all sides, in parts of the height; default 1/32.
    """
    from scipy.ndimage import distance_transform_edt

    rows = 160
    spread = np.geomspace if floor > 0.0 else np.linspace
    height = spread(floor, ceiling, rows)[:, np.newaxis]
    above_kind, above_sign = height > curves.kind, height > curves.sign
    region = np.where(above_kind, np.where(above_sign, 2, 1), np.where(above_sign, 5, 3))
    region = np.where(height < curves.existence, 4, region)
    w = curves.frequency_ratio
    spread = np.geomspace if spaced_by_ratio(w) else np.linspace
    across_at = spread(w[0], w[-1], rows)
    columns = np.searchsorted(w, across_at[:-1])
    columns = np.append(columns, len(w) - 1)
    left, low, right, high = (round(rows * each) for each in taken)
    free = np.ones((rows, rows), dtype=bool)
    free[low:high, left:right] = False
    clear = free.copy()
    for curve in (curves.symmetry_breaking, curves.heteroclinic):
        above = np.pad(height > curve[columns], ((1, 0), (1, 0)), mode="edge")
        clear &= (above[1:, 1:] == above[:-1, 1:]) & (above[1:, 1:] == above[1:, :-1])
    if point is not None:
        column = min(int(np.searchsorted(w[columns], point[0])), rows - 1)
        clear[min(int(np.searchsorted(height[:, 0], point[1])), rows - 1), column] = False
    centres: dict[int, tuple[float, float]] = {}
    for number in range(1, 6):
        room = np.zeros((rows, rows))
        # Clear of the other curves and the point where that is possible.
        for allowed in (clear, free):
            inside = np.pad((region[:, columns] == number) & allowed, 1)
            room = distance_transform_edt(inside)[1:-1, 1:-1]
            if room.max() > least * rows:
                break
        if room.max() > least * rows:
            # Of the roomiest places that furthest right: the curves crowd together on the left.
            row, column = max(np.argwhere(room > 0.95 * room.max()), key=lambda place: place[1])
            place = float(across_at[min(column, rows - 12)])
            centres[number] = (place, float(height[row, 0]))
    return centres
