"""Plots of attractor and fate maps: filled cells over two axes, a diagram over one."""

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.errors import InputError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.show.plots.map_classes import (
    DARK_DOTS,
    LOOKS,
    CellClass,
    MapCells,
    has_fates,
    map_cells,
    share_text,
    validated_map,
)
from rocksteady.show.style import palette
from rocksteady.show.style.axes import picked, prepare_axis, runs, spacing_of
from rocksteady.show.style.layout import axes_or_new
from rocksteady.show.style.legends import LegendPlace, draw_legend, place_of
from rocksteady.show.style.line_colours import inks_of

if TYPE_CHECKING:
    import xarray
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes

Floats = NDArray[np.float64]

FREQUENCIES = ("frequency_ratio", "frequency_hz")
MOST_DRAWN = 2400
"""Cells along a side that are drawn of evenly spaced ones: more than a picture has pixels."""
MOST_MESHED = 1000
"""The same of unevenly spaced ones, each of which is a shape of its own."""
MOST_HATCHED = 60
"""Cells along a side each of which is wide enough for a pattern."""
MOST_OUTLINED = 200
"""The same for an outline."""
MOST_PATTERNED = 600
"""Cells along a side by which a pattern finds its borders: nearer than the width of a line."""
SWATCHES: dict[str, Any] = {
    "handlelength": 1.5,
    "handleheight": 1.5,
    "handletextpad": 0.6,
    "labelspacing": 0.5,
}
"""Legend entries tall enough for a pattern."""
STRIP = 0.035
"""Height of the strip of a diagram, in parts of the axes."""


@checked
def plot_map(
    found: "xarray.Dataset", ax: "Axes | None" = None, *, legend: LegendPlace | None = None
) -> "Axes":
    """Draw an attractor or fate map: filled cells over two axes, a diagram over one.

    Over two axes each cell has the fill of its class; the frequency is to the right and the other
    axis upwards, whatever their order in the map (else the first upwards, the second to the right;
    angle and velocity as in `plot_basins`).  Each cell reaches half way to its neighbours.
    Patterns stand where there is no answer: undecided, no such start, not computed (kind -128).

    Over one axis there are two dots for each orbit, its highest and its lowest theta/alpha, as in a
    bifurcation diagram by simulation, and a strip along the upper edge with the class of each
    value: where the block overturned or its motion is aperiodic there is no orbit to draw.  Of a
    map of fates the dots are numbers of impacts.

    An axis is logarithmic where its values are spaced by ratio, as `numpy.geomspace` does.  Axes
    with a single value, and values that were selected, stand in the title.  The legend has the
    share of each class among the cells, all of them counted.

    Parameters
    ----------
    found
        From `rocksteady.map_attractors` or `rocksteady.map_fates`; its arrays are read once.
    ax
        Axes to draw on; those of a new figure without.
    legend
        "inside" the axes, to their "right", "below" them or "none"; by default to their
        right, or below narrow ones.

    Returns
    -------
    matplotlib.axes.Axes
        The axes.

    Raises
    ------
    InputError
        If it is no map, or has three axes or more, or none, with several values.

    Notes
    -----
    Of more than 2400 cells along a side (1000 where they are unevenly spaced) as many are drawn,
    evenly picked: each is the class of the cell in its middle.  What is thinner than a picked cell,
    as the islands of a fractal border are, may vanish or look thicker than it is, so that such a
    picture tells no areas; the shares in the legend do.  Select a part of the map to see all of it.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import DimensionlessBlock, map_attractors
    >>> block = DimensionlessBlock(restitution=0.8)
    >>> axes = {"amplitude": [0.5, 1.5, 2.5], "frequency_ratio": [1.0, 2.0, 4.0, 8.0]}
    >>> found = map_attractors(block, axes=axes)
    >>> axes = plot_map(found, Figure().add_subplot())
    >>> for entry in axes.get_legend().get_texts():
    ...     print(entry.get_text())
    at rest  33.3 %
    symmetric  33.3 %
    overturned  33.3 %
    """
    cells = map_cells(found)
    if len(cells.names) > 2:
        raise InputError(
            "found",
            Words(f"has {len(cells.names)} axes: {', '.join(cells.names)}"),
            "one or two axes with several values can be drawn on one pair of axes",
            "select a value with .sel, or draw panels with rocksteady map --plot",
        )
    return draw_map(axes_or_new(ax), cells, found, legend)


def draw_map(
    axes: "Axes", cells: MapCells, found: "xarray.Dataset", legend: LegendPlace | None = None
) -> "Axes":
    """Draw the cells of a map of one or two axes, with title and legend."""
    if len(cells.names) == 1:
        draw_diagram(axes, cells, found)
    else:
        draw_cells(axes, cells)
    if cells.fixed:
        axes.set_title(fixed_text(cells), loc="left")
    place = place_of(axes, legend, "right")
    draw_legend(axes, place, handles=legend_handles(cells), **SWATCHES)
    return axes


def fixed_text(cells: MapCells) -> str:
    """Return what all cells have in common, in words."""
    return ", ".join(palette.axis_value(name, value) for name, value in cells.fixed)


def legend_handles(cells: MapCells) -> "list[Artist]":
    """Return a legend entry for each class that occurs, with its share."""
    from matplotlib.patches import Patch

    return [
        Patch(
            facecolor=LOOKS[one].fill,
            edgecolor=LOOKS[one].ink,
            hatch=LOOKS[one].hatch or None,
            lw=0.6,
            label=f"{LOOKS[one].words}  {share_text(share)}",
        )
        for one, share in cells.shares().items()
    ]


def upright(cells: MapCells) -> MapCells:
    """Return the cells of a map of two axes with that which goes upwards first."""
    up, right = cells.names
    if (up in FREQUENCIES and right not in FREQUENCIES) or (up, right) == ("angle", "velocity"):
        return cells.turned((right, up))
    return cells


def draw_cells(axes: "Axes", given: MapCells) -> None:
    """Fill the cells of a map of two axes."""
    from matplotlib.colors import ListedColormap

    cells = upright(given)
    up, right = (spacing_of(values) for values in cells.values)
    even = up.even and right.even
    # A copy of what is drawn alone, so that the picture does not hold on to the whole map.
    rows, columns = (picked(one.edges, MOST_DRAWN if even else MOST_MESHED) for one in (up, right))
    drawn = cells.classes[np.ix_(rows[0], columns[0])]
    y, x = rows[1], columns[1]
    colours: dict[str, Any] = {
        "cmap": ListedColormap([LOOKS[one].fill for one in CellClass]),
        "vmin": -0.5,
        "vmax": len(CellClass) - 0.5,
    }
    prepare_axis(axes, "x", cells.names[1], cells.values[1], right)
    prepare_axis(axes, "y", cells.names[0], cells.values[0], up)
    if even:  # an image is even in its own coordinates: the logarithms, on a logarithmic axis
        axes.imshow(
            drawn,
            extent=(*right.ends, *up.ends),
            transform=axes.transLimits + axes.transAxes,
            origin="lower",
            aspect="auto",
            interpolation="nearest",
            **colours,
        )
    else:
        axes.pcolormesh(x, y, drawn, rasterized=True, **colours)
    for one in cells.shares():
        if LOOKS[one].hatch:
            _draw_pattern(axes, x, y, drawn == one, one)
    axes.grid(visible=False)


def draw_diagram(axes: "Axes", cells: MapCells, found: "xarray.Dataset") -> None:
    """Draw a map of one axis: what its orbits reach, or how many impacts there were, as dots, and
    the class of each cell above them.
    """  # noqa: D205 -- one sentence
    from matplotlib.patches import Rectangle

    (name,), (values,) = cells.names, cells.values
    fates = has_fates(found)
    which = ("impacts",) if fates else ("highest", "lowest")
    drawn = validated_map(found, which)
    order = np.argsort(drawn[name].values)
    reached = np.array([drawn[one].values[order] for one in which], float)
    reached[:, cells.classes >= CellClass.NO_START] = np.nan  # whatever is stored there
    if fates:  # of a refined map the lowest integer, where a class is that of its neighbours
        reached[reached < 0.0] = np.nan
    spacing, inks = spacing_of(values), inks_of(axes)
    prepare_axis(axes, "x", name, values, spacing)
    size = min(5.0, max(1.8, 1000.0 / len(values)))
    for one in cells.shares():
        chosen = cells.classes == one
        x, y = np.tile(values[chosen], len(which)), reached[:, chosen].ravel()
        if np.isfinite(y).any():
            dot = DARK_DOTS[one] if inks.dark else LOOKS[one].dot
            style: dict[str, Any] = {"color": dot, "ms": size, "mew": 0.0, "ls": "none"}
            axes.plot(x, y, "o", rasterized=len(values) > MOST_DRAWN, **style)
        axes.broken_barh(
            runs(chosen, spacing),
            (1.0 - STRIP, STRIP),
            transform=axes.get_xaxis_transform(),
            fc=LOOKS[one].fill,
            ec=LOOKS[one].ink,
            hatch=LOOKS[one].hatch or None,
            lw=0.0,
            zorder=4.5,
        )
    # Rest is hardly darker than the paper.
    axes.add_patch(
        Rectangle(
            (0.0, 1.0 - STRIP),
            1.0,
            STRIP,
            transform=axes.transAxes,
            fill=False,
            ec=inks.ink,
            lw=0.8,
            zorder=5.0,
        )
    )
    largest = float(np.nanmax(np.abs(reached), initial=0.0)) or 1.0
    axes.set_ylim(-0.05 * largest if fates else -1.05 * largest, 1.12 * largest)
    axes.set_ylabel(palette.LABELS["impacts" if fates else "orbit_extremes"])


def _draw_pattern(
    axes: "Axes",
    right: Floats,
    up: Floats,
    where: NDArray[np.bool_],
    one: CellClass,
) -> None:
    """Draw the pattern of a class over its cells, where there is room for one."""
    from scipy.ndimage import maximum_filter, minimum_filter

    look = LOOKS[one]
    (rows, y), (columns, x) = (picked(edges, MOST_PATTERNED) for edges in (up, right))
    there = where[np.ix_(rows, columns)].astype(np.float32)
    # An opening: what is too narrow to show a pattern, or its outline, gets none.
    widest = MOST_OUTLINED if look.outlined else MOST_HATCHED
    room = [max(1, round(count / widest)) for count in there.shape]
    there = maximum_filter(
        minimum_filter(there, room, mode="nearest"), room, origin=[k % 2 - 1 for k in room]
    )
    if not there.any():
        return
    # Each cell as four corners, so that the pattern ends where the cells do.
    field = np.repeat(np.repeat(there, 2, axis=0), 2, axis=1)
    corners = (np.repeat(edges, 2)[1:-1] for edges in (x, y))
    drawn = axes.contourf(*corners, field, levels=[0.5, 1.5], colors="none", hatches=[look.hatch])
    drawn.set_edgecolor(look.ink)
    drawn.set_linewidth(0.5 if look.outlined else 0.0)
