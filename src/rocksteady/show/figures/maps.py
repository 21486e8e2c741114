"""Figures of attractor and fate maps, with a third axis as side-by-side panels."""

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from rocksteady.errors import InputError, Words
from rocksteady.show.plots.map_classes import MapCells, has_fates, map_cells
from rocksteady.show.plots.map_quantities import Colouring, Shade
from rocksteady.show.plots.maps import (
    SWATCHES,
    coloured,
    draw_bar,
    draw_cells,
    draw_map,
    fixed_text,
    legend_handles,
    upright,
)
from rocksteady.show.style.legends import draw_legend, text_size
from rocksteady.show.style.page import SCREEN, Page
from rocksteady.show.style.tokens import inks_of

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure

PLANE = ("amplitude", "frequency_ratio", "acceleration_m_s2", "frequency_hz")
"""Axes of a panel in preference to an axis along which panels differ."""
MOST_PANELS = 12
ACROSS = {1: 1, 2: 2, 3: 3, 4: 2, 5: 3, 6: 3, 7: 4, 8: 4, 9: 3, 10: 4, 11: 4, 12: 4}
"""Columns by the number of panels."""
NARROWEST = 1.35
"""Width of a panel, in inches, at least."""


def map_figure(
    dataset: "xarray.Dataset", title: str = "", page: Page = SCREEN, by: Colouring = "class"
) -> "Figure":
    """Return a figure of a map over one, two or three axes with several values.

    Over three there is a panel for each value of the axis that has fewest (of axes that are
    neither amplitude nor frequency, where they are equal), with one legend, whose shares are of
    all panels together.

    Parameters
    ----------
    dataset
        From `rocksteady.map_attractors` or `rocksteady.map_fates`.
    title
        Above the panels.
    page
        Width of the figure, and place of its legend.
    by
        What colours the cells, as for `rocksteady.plots.outcomes`; all panels have the same
        colours.

    Raises
    ------
    InputError
        If it is no map, has four axes or more, or none, with several values, or would have more
        than 12 panels.

    Examples
    --------
    >>> from rocksteady import DimensionlessBlock, map_attractors
    >>> result = map_attractors(
    ...     DimensionlessBlock(restitution=0.8),
    ...     axes={
    ...         "restitution": [0.7, 0.9],
    ...         "amplitude": [0.5, 2.0, 3.0],
    ...         "frequency_ratio": [1.0, 4.0, 8.0],
    ...     },
    ... )
    >>> [axes.get_title(loc="left") for axes in map_figure(result).axes]
    ['restitution = 0.7', 'restitution = 0.9']
    """
    cells, shade = coloured(map_cells(dataset), dataset, by)
    panels = panels_axis(dict(zip(cells.names, cells.classes.shape, strict=True)))
    if panels is not None:
        return _panels(panels, cells, shade, title, page)
    bands = len(cells.names) == 1 and has_fates(dataset)
    with page.figure(8.0, 2.4 if bands else 4.8, title) as figure:
        draw_map(figure.add_subplot(), cells, dataset, shade, page.legend)
    return figure


def panels_axis(counts: Mapping[str, int]) -> str | None:
    """Return the axis of a map that becomes panels; None where one picture shows all.

    Parameters
    ----------
    counts
        Number of values of each axis with several.

    Raises
    ------
    InputError
        If there are four axes or more, or would be more than 12 panels.

    Examples
    --------
    >>> panels_axis({"restitution": 4, "amplitude": 100, "frequency_ratio": 200})
    'restitution'
    """
    if len(counts) > 3:
        raise InputError(
            "dataset",
            Words(f"has {len(counts)} axes: {', '.join(counts)}"),
            "a figure shows at most three axes with several values",
            "select a value of the others, as found.sel(restitution=0.8)",
        )
    if len(counts) < 3:
        return None
    name = min(counts, key=lambda axis: (counts[axis], axis in PLANE))
    if counts[name] > MOST_PANELS:
        raise InputError(
            "dataset",
            Words(f"has {counts[name]} values of {name}"),
            f"the axis with the fewest becomes panels, at most {MOST_PANELS}",
            f"draw some of them, as found.isel({name}=slice(0, {MOST_PANELS}))",
        )
    return name


def _panels(name: str, cells: MapCells, shade: Shade | None, title: str, page: Page) -> "Figure":
    """Draw the parts of a map side by side, as many in a row as are wide enough."""
    parts = cells.parts(name)
    across = ACROSS[len(parts)]
    natural = 1.9 + 2.7 * across
    beside = page.legend == "right" or (
        page.legend is None and page.width(natural) > 0.85 * natural
    )
    room = page.width(natural) - (1.9 if beside else 0.4)
    across = max(1, min(across, int(room / NARROWEST)))
    down = math.ceil(len(parts) / across)
    up, right = upright(parts[0]).names
    above = ", ".join(text for text in (title, fixed_text(cells)) if text)
    high = (0.9 + min(2.3, 0.9 * room / across) * down) / page.width(natural)
    with page.figure(natural, 0.9 + 2.3 * down, above, stacked=high) as figure:
        grid = figure.subplots(down, across, sharex=True, sharey=True, squeeze=False).ravel()
        drawn = []
        for number, axes in enumerate(grid):
            if number >= len(parts):
                axes.remove()
                continue
            drawn.append(draw_cells(axes, parts[number], shade))
            axes.set(xlabel="", ylabel="")
            axes.set_title(fixed_text(parts[number]), loc="left")
            axes.tick_params(labelbottom=number + across >= len(parts))
        bar = draw_bar(grid[: len(parts)].tolist(), drawn[-1], shade)
        size = text_size(grid[0], 8.0)
        figure.supylabel(parts[0].scale(up)[0].label, fontsize=size + 1.0)
        place = page.legend or ("right" if beside and bar is None else "below")
        if place == "below":  # where one label of all panels would meet the legend
            for axes in grid[max(0, len(parts) - across) : len(parts)]:
                axes.set_xlabel(parts[0].scale(right)[0].label)
        else:
            figure.supxlabel(parts[0].scale(right)[0].label, fontsize=size + 1.0)
        handles = legend_handles(cells, inks_of(grid[0]), shade)
        if place == "inside":
            draw_legend(grid[0], place, handles=handles, **SWATCHES)
        elif place != "none":
            outside: Any = "outside right upper" if place == "right" else "outside lower left"
            columns = 1 if place == "right" else max(1, int(page.width(natural) / 1.9))
            figure.legend(handles=handles, loc=outside, ncols=columns, fontsize=size, **SWATCHES)
            if place == "below":
                rows = math.ceil(len(handles) / columns)
                figure.set_figheight(figure.get_figheight() + 0.22 * rows)
    return figure
