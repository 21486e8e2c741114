"""Plots of attractor and fate maps: filled cells over two axes, a diagram over one."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats
from rocksteady.dynamics.maps.cell_classes import CellClass
from rocksteady.errors import InputError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.model.units import CONVERSIONS
from rocksteady.show.plots.map_classes import (
    LOOKS,
    MapCells,
    has_fates,
    map_cells,
    validated_map,
)
from rocksteady.show.plots.map_quantities import (
    LINE_WIDTH,
    LINE_WORDS,
    Colouring,
    Shade,
    checked_colouring,
    shade_of,
    values_of,
    with_values,
)
from rocksteady.show.style import palette
from rocksteady.show.style.areas import (
    MOST_PATTERNED,
    area_style,
    draw_pattern,
    pattern_ink,
    write_words,
)
from rocksteady.show.style.axes import picked, prepare_axis, runs, spacing_of
from rocksteady.show.style.layout import axes_or_new
from rocksteady.show.style.legends import (
    GAP,
    LegendPlace,
    draw_legend,
    figure_of,
    place_of,
    text_size,
)
from rocksteady.show.style.limits import name_level_end
from rocksteady.show.style.scales import FAR_ROOM, Scale, draw_far_axes, scale_of
from rocksteady.show.style.tokens import DASHED, Inks, inks_of

if TYPE_CHECKING:
    import xarray
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.cm import ScalarMappable
    from matplotlib.colorbar import Colorbar


EXTREMES = ("highest", "lowest")
FREQUENCIES = ("frequency_ratio", "frequency_hz")
MOST_DRAWN = 2400
"""Cells along a side that are drawn of evenly spaced ones: more than a picture has pixels."""
MOST_MESHED = 1000
"""The same of unevenly spaced ones, each of which is a shape of its own."""
SWATCHES: dict[str, Any] = {
    "handlelength": 1.5,
    "handleheight": 1.5,
    "handletextpad": 0.6,
    "labelspacing": 0.5,
}
"""Legend entries tall enough for a pattern."""
BAR_ROOM = 66.0
"""Between axes and a legend to the right of their colour bar [points]."""
OUTLINE = 0.5
"""Width of the line around areas whose fill alone is nearly that of others [points]."""
STRIP = 0.035
"""Height of the strip of a diagram, in parts of the axes."""


@checked
def plot_outcomes(
    dataset: "xarray.Dataset",
    ax: "Axes | None" = None,
    *,
    by: Colouring = "class",
    legend: LegendPlace | None = None,
) -> "Axes":
    """Draw an attractor or fate map: filled cells over two axes, a diagram over one.

    Over two axes each cell has the fill of its class, or of a quantity with a colour bar; the
    frequency is to the right and the other axis upwards, whatever their order in the map (else the
    first upwards, the second to the right; angle and velocity as in `plots.basins`).  Each cell
    reaches half way to its neighbours.
    Large areas have their word.  A block whose size is the same in all cells has its axes in g, Hz,
    degrees and degrees per second, and the dimensionless ones on the far side where there is room.

    Over one axis there are two dots for each orbit, its highest and its lowest theta/alpha, as in a
    bifurcation diagram by simulation, and a strip along the upper edge with the class of each
    value: where the block overturned or its motion is aperiodic there is no orbit to draw.  Fates
    have no orbits: their classes fill the axes.

    An axis is logarithmic where its values are spaced by ratio, as `numpy.geomspace` does.  Axes
    with a single value, and values that were selected, stand in the title.  The legend has the
    share of each class among all cells, as in `describe`.

    Parameters
    ----------
    dataset
        From `rocksteady.map_attractors` or `rocksteady.map_fates`; its arrays are read once.
    ax
        Axes to draw on; default: axes of a new figure.
    by
        Quantity of attractors: "class" (default), "period" of the orbit, the longest in one colour,
        "lyapunov" exponent per forcing period about 0, or "peak" tilt with a line at alpha; of
        fates "class" alone.  Cells without a value keep the fill of their class.
    legend
        "inside" the axes, to their "right", "below" them or "none"; by default to their
        right, or below narrow ones, and below beside a colour bar.

    Returns
    -------
    matplotlib.axes.Axes
        The axes.

    Raises
    ------
    InputError
        If there is no such quantity, it is no map, or has three axes or more, or none, with several
        values.

    Notes
    -----
    Of more than 2400 cells along a side (1000 where they are unevenly spaced) as many are drawn,
    evenly picked: each is the class of the cell in its middle.  What is thinner than a picked cell,
    as the islands of a fractal border are, may vanish or look thicker than it is, so that such a
    picture shows no areas; the shares are in the legend.  Select a part of the map to see all of
    it. The colours of Lyapunov exponents reach 98 in 100 of their sizes; what lies beyond has the
    colour of the end.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import DimensionlessBlock, map_attractors
    >>> block = DimensionlessBlock(restitution=0.8)
    >>> axes = {"amplitude": [0.5, 1.5, 2.5], "frequency_ratio": [1.0, 2.0, 4.0, 8.0]}
    >>> result = map_attractors(block, axes=axes)
    >>> axes = plot_outcomes(result, Figure().add_subplot())
    >>> for entry in axes.get_legend().get_texts():
    ...     print(entry.get_text())
    comes to rest  33.3 %
    symmetric  33.3 %
    falls  33.3 %
    """
    cells = map_cells(dataset)
    if len(cells.names) > 2:
        raise InputError(
            "dataset",
            Words(f"has {len(cells.names)} axes: {', '.join(cells.names)}"),
            "one or two axes with several values can be drawn on one pair of axes",
            "select a value with .sel, or draw panels with rocksteady map --plot",
        )
    cells, shade = coloured(cells, dataset, by)
    return draw_map(axes_or_new(ax), cells, dataset, shade, legend)


def coloured(
    cells: MapCells, dataset: "xarray.Dataset", by: Colouring
) -> tuple[MapCells, Shade | None]:
    """Return cells with the quantity that colours them, and its colours; None of classes.

    Raises
    ------
    InputError
        If the map does not have it.
    """
    checked_colouring(by, fates=has_fates(dataset))
    if by == "class":
        return cells, None
    valued = with_values(cells, dataset, by)
    return valued, shade_of(valued, by)


def draw_map(
    axes: "Axes",
    cells: MapCells,
    dataset: "xarray.Dataset",
    shade: Shade | None = None,
    legend: LegendPlace | None = None,
) -> "Axes":
    """Draw the cells of a map of one or two axes, with title, colour bar and legend."""
    bar, far = None, False
    if len(cells.names) == 1:
        far = draw_diagram(axes, cells, dataset, shade)
    else:
        drawn = draw_cells(axes, cells, shade)
        up, right = (cells.scale(name)[1] for name in upright(cells).names)
        with_bar = shade is not None and bool(shade.label)
        far = draw_far_axes(axes, right, None if with_bar else up)
        bar = draw_bar([axes], drawn, shade)
    if cells.fixed:
        axes.set_title(fixed_text(cells), loc="left")
    place = place_of(axes, legend, "right" if bar is None else "below")
    handles = legend_handles(cells, inks_of(axes), shade if len(cells.names) > 1 else None)
    beside = bar is not None and figure_of(axes).get_layout_engine() is None
    gap = BAR_ROOM if beside else GAP  # a layout puts the bar beyond the legend
    within = bar is not None
    gap += FAR_ROOM if far else 0.0
    draw_legend(axes, place, handles=handles, gap=gap, within=within, **SWATCHES)
    return axes


def draw_bar(
    panels: "Sequence[Axes]", drawn: "ScalarMappable", shade: Shade | None
) -> "Colorbar | None":
    """Draw the colour bar of a quantity to the right of panels; none of classes and periods."""
    if shade is None or not shade.label:
        return None
    inks = inks_of(panels[0])
    figure = figure_of(panels[0])
    size = text_size(panels[0], 8.0)
    bar = figure.colorbar(
        drawn, ax=list(panels), extend=shade.extend, pad=0.02, fraction=0.06, aspect=24
    )
    bar.set_label(shade.label, size=size, color=inks.ink)
    bar.ax.tick_params(labelsize=size - 0.5, colors=inks.ink)
    bar.ax.grid(visible=False)
    bar.outline.set_edgecolor(inks.ink)
    low, high = shade.ends
    if shade.line is not None and low < shade.line < high:
        bar.ax.axhline(shade.line, color=inks.limit, ls=DASHED, lw=LINE_WIDTH)
    return bar


def fixed_text(cells: MapCells) -> str:
    """Return what all cells have in common, in words."""
    words = []
    for name, value in cells.fixed:
        sized = cells.block is not None and name in CONVERSIONS
        unit_name = CONVERSIONS[name][0] if sized else name
        words.append(palette.axis_value(unit_name, value * cells.scale(name)[0].factor))
    return ", ".join(words)


def legend_handles(cells: MapCells, inks: Inks, shade: Shade | None = None) -> "list[Artist]":
    """Return a legend entry for each class that occurs, with its share.

    Where a quantity colours cells, the classes are those of cells without a value.
    """
    if shade is not None:
        return shade.legend(cells, inks)
    return [LOOKS[cell_class].swatch(inks, share) for cell_class, share in cells.shares().items()]


def upright(cells: MapCells) -> MapCells:
    """Return the cells of a map of two axes with that which goes upwards first."""
    up, right = cells.names
    if (up in FREQUENCIES and right not in FREQUENCIES) or (up, right) == ("angle", "velocity"):
        return cells.turned((right, up))
    return cells


def draw_cells(axes: "Axes", given: MapCells, shade: Shade | None = None) -> "ScalarMappable":
    """Fill the cells of a map of two axes, and return what their colours show."""
    from matplotlib.colors import ListedColormap

    cells = upright(given)
    inks = inks_of(axes)
    scales = [cells.scale(name)[0] for name in cells.names]
    points = [values * scale.factor for values, scale in zip(cells.values, scales, strict=True)]
    up, right = (spacing_of(values) for values in points)
    even = up.even and right.even
    # A copy of what is drawn alone, so that the picture does not hold on to the whole map.
    rows, columns = (
        picked(spacing.edges, MOST_DRAWN if even else MOST_MESHED) for spacing in (up, right)
    )
    drawn = cells.classes[np.ix_(rows[0], columns[0])]
    y, x = rows[1], columns[1]
    looks = [
        LOOKS[cell_class] if shade is None else shade.look(cell_class) for cell_class in CellClass
    ]
    colours: dict[str, Any] = {
        "cmap": ListedColormap([getattr(inks, look.fill) for look in looks]),
        "vmin": -0.5,
        "vmax": len(CellClass) - 0.5,
    }
    prepare_axis(axes, "x", cells.names[1], points[1], right, scales[1].label)
    prepare_axis(axes, "y", cells.names[0], points[0], up, scales[0].label)

    def filled(cells: NDArray[Any], **colours: Any) -> "ScalarMappable":
        if not even:
            return axes.pcolormesh(x, y, cells, rasterized=True, **colours)
        return axes.imshow(  # even in its own coordinates: the logarithms, on a logarithmic axis
            cells,
            extent=(*right.ends, *up.ends),
            transform=axes.transLimits + axes.transAxes,
            origin="lower",
            aspect="auto",
            interpolation="nearest",
            **colours,
        )

    mappable = filled(drawn, **colours)
    mask = np.ones(drawn.shape, dtype=np.bool_)
    codes, words = drawn, _words(inks)
    if shade is not None:
        values = shade.factor * values_of(cells)[np.ix_(rows[0], columns[0])]
        mask = np.isnan(values)
        if shade.extend != "neither":  # of what is infinite an image shows nothing
            low, high = shade.ends
            values = np.clip(values, low - 1.0, high + 1.0)
        masked = np.ma.masked_array(values, mask)
        mappable = filled(masked, cmap=shade.colours(inks), norm=shade.norm)
        if shade.line is not None:
            _draw_line(axes, x, y, values, shade.line)
        codes = np.where(mask, drawn, -1 - shade.grouped(values))
        words |= {-1 - value: pair for value, pair in shade.words(inks).items()}
    for cell_class, look in zip(CellClass, looks, strict=True):
        where = mask & (drawn == cell_class)
        ink = inks.edge if look.outlined else pattern_ink(getattr(inks, look.fill))
        outline = OUTLINE if look.outlined else 0.0
        draw_pattern(axes, (x, y), where, look.hatch, ink, outline=outline)
    write_words(axes, (x, y), codes, words)
    axes.grid(visible=False)
    return mappable


def _words(inks: Inks) -> dict[int, tuple[str, str]]:
    """Return word and fill of each class, for its areas."""
    return {
        int(cell): (look.words.partition(" (")[0], getattr(inks, look.fill))
        for cell, look in LOOKS.items()
    }


def draw_diagram(
    axes: "Axes", cells: MapCells, dataset: "xarray.Dataset", shade: Shade | None = None
) -> bool:
    """Draw a map of one axis: a quantity as dots, and the class of each cell above them.

    Without a quantity the dots are what its orbits reach.  Fates have no dots: their classes fill
    the axes.  Returns whether the right side has an axis.
    """
    (name,), (given,) = cells.names, cells.values
    along, far = cells.scale(name)
    values = given * along.factor
    spacing = spacing_of(values)
    prepare_axis(axes, "x", name, values, spacing, along.label)
    fates = has_fates(dataset)
    _draw_classes(axes, cells, spacing.edges, 1.0 if fates else STRIP)
    if fates:
        draw_far_axes(axes, far)
        axes.set_yticks([])
        band = cells.classes[np.newaxis]
        write_words(axes, (spacing.edges, np.array(axes.get_ylim())), band, _words(inks_of(axes)))
        return False
    by: Colouring = "class" if shade is None else shade.by
    scale = _diagram_scale(by, cells)
    reached = scale.factor * _reached(by, cells, dataset)
    inks = inks_of(axes)
    style: dict[str, Any] = {"ms": min(5.0, max(1.8, 1000.0 / len(values))), "mew": 0.0}
    for cell_class in cells.shares():
        chosen = cells.classes == cell_class
        x, y = np.tile(values[chosen], len(reached)), reached[:, chosen].ravel()
        if np.isfinite(y).any():
            style["color"] = getattr(inks, LOOKS[cell_class].line)
            axes.plot(x, y, "o", ls="none", rasterized=len(values) > MOST_DRAWN, **style)
    finite = reached[np.isfinite(reached)]
    largest = float(np.max(np.abs(finite), initial=0.0)) or 1.0
    axes.set_ylim(-1.05 * largest if by == "class" else -0.05 * largest, 1.12 * largest)
    if by == "lyapunov":
        low, high = (float(end) for end in (finite.min(initial=0.0), finite.max(initial=0.0)))
        room = 0.05 * (high - low or 1.0)
        axes.set_ylim(low - room, high + 3.0 * room)
        axes.axhline(0.0, color=inks.edge, lw=LINE_WIDTH, zorder=1.5)
    elif by == "peak" and scale.factor < axes.get_ylim()[1]:
        axes.axhline(scale.factor, color=inks.limit, ls=DASHED, lw=LINE_WIDTH, zorder=1.5)
        _name_line(axes, scale.factor, values, reached[0])
    elif by == "period":
        from matplotlib.ticker import MaxNLocator

        axes.yaxis.set_major_locator(MaxNLocator(integer=True))
    axes.set_ylabel(scale.label)
    return draw_far_axes(axes, far, scale)


def _diagram_scale(by: Colouring, cells: MapCells) -> Scale:
    """Return the scale of what a diagram shows."""
    if by != "class":
        return scale_of("orbit_period" if by == "period" else by, cells.block)
    tilt = scale_of("angle", cells.block)
    unit = "_deg" if tilt.far else ""
    label, far = palette.LABELS[f"orbit_extremes{unit}"], palette.LABELS["orbit_extremes"]
    return Scale(tilt.factor, label, far if tilt.far else "")


def _reached(by: Colouring, cells: MapCells, dataset: "xarray.Dataset") -> Floats:
    """Return what a diagram shows of each cell, in one row or two, nan where nothing."""
    if by != "class":
        return values_of(with_values(cells, dataset, by))[np.newaxis]
    drawn = validated_map(dataset, EXTREMES)
    order = np.argsort(drawn[cells.names[0]].values)
    reached = np.array([drawn[extreme].values[order] for extreme in EXTREMES], float)
    reached[:, cells.classes >= CellClass.NO_START] = np.nan  # whatever is stored there
    return reached


def _name_line(axes: "Axes", level: float, x: Floats, y: Floats) -> None:
    """Name the line of the tipping angle at that end at which fewer dots are near it."""
    low, high = axes.get_xlim()
    near = x[np.abs(y - level) < 0.1 * axes.get_ylim()[1]]
    left = bool((near < 0.5 * (low + high)).sum() <= 0.5 * len(near))
    name_level_end(axes, level, LINE_WORDS, left=left)


def _draw_classes(axes: "Axes", cells: MapCells, edges: Floats, height: float) -> None:
    """Draw the classes of a map of one axis: a strip from the upper edge, in parts of the axes."""
    from matplotlib.patches import Rectangle

    inks = inks_of(axes)
    for cell_class in cells.shares():
        look = LOOKS[cell_class]
        axes.broken_barh(
            runs(cells.classes == cell_class, edges),
            (1.0 - height, height),
            transform=axes.get_xaxis_transform(),
            zorder=4.5,
            **area_style(inks, look.fill, look.pattern),
        )
    # Rest is hardly darker than the paper.
    axes.add_patch(
        Rectangle(
            (0.0, 1.0 - height),
            1.0,
            height,
            transform=axes.transAxes,
            fill=False,
            ec=inks.edge,
            lw=0.8,
            zorder=5.0,
        )
    )


def _draw_line(axes: "Axes", right: Floats, up: Floats, values: Floats, level: float) -> None:
    """Draw the line where a quantity passes a value."""
    (rows, y), (columns, x) = (picked(edges, MOST_PATTERNED) for edges in (up, right))
    shown = values[np.ix_(rows, columns)]
    if min(shown.shape) < 2 or not np.nanmin(shown, initial=level) < level:
        return
    if not np.nanmax(shown, initial=level) > level:
        return
    middles = (0.5 * (edges[1:] + edges[:-1]) for edges in (x, y))
    masked = np.ma.masked_invalid(shown)
    axes.contour(
        *middles,
        masked,
        levels=[level],
        colors=inks_of(axes).limit,
        linestyles=[DASHED],
        linewidths=LINE_WIDTH,
    )
