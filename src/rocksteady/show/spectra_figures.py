"""Whole figures of rocking spectra, as the command line saves them."""

import math
from typing import TYPE_CHECKING

from rocksteady.show import palette
from rocksteady.show.plots.spectra import (
    MOST_CURVES,
    plot_overturned_share,
    plot_rocking_spectrum,
    plot_spectrum_map,
    plot_suite_spectrum,
    slenderness_text,
)

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure


def spectrum_figure(found: "xarray.Dataset", title: str = "") -> "Figure":
    """Return a figure of one record's rocking spectrum: angle and velocity, curves or maps.

    Parameters
    ----------
    found
        From `rocksteady.rocking_spectrum`, as for `rocksteady.plot_rocking_spectrum`, but of any
        number of slendernesses: more than six are a map.
    title
        Above the panels.
    """
    from matplotlib.figure import Figure

    curves = found.sizes.get("alpha", 1) <= MOST_CURVES
    with palette.style():
        figure = Figure(figsize=(10.4, 4.2))
        left, right = figure.subplots(1, 2)
        draw = plot_rocking_spectrum if curves else plot_spectrum_map
        draw(found, left)
        draw(found, right, quantity="peak_velocity")
        legend = right.get_legend()
        if legend is not None:
            legend.remove()  # it would say the same twice
        if title:
            figure.suptitle(title, x=0.01, ha="left", fontsize=10)
    return figure


def suite_figure(summary: "xarray.Dataset", title: str = "") -> "Figure":
    """Return a figure of a suite's rocking spectra: a panel a slenderness, falls beneath it.

    Parameters
    ----------
    summary
        From `rocksteady.suite_spectrum`, of one scale and at most six slendernesses.
    title
        Above the panels.
    """
    from matplotlib.figure import Figure

    several = "alpha" in summary.dims
    parts = [summary.isel(alpha=k) for k in range(summary.sizes["alpha"])] if several else [summary]
    across = min(3, len(parts))
    down = math.ceil(len(parts) / across)
    with palette.style():
        figure = Figure(figsize=(max(7.4, 1.2 + 3.2 * across), 0.5 + 4.2 * down))
        grid = figure.add_gridspec(2 * down, across, height_ratios=(2.2, 1.0) * down)
        for number, part in enumerate(parts):
            row, column = divmod(number, across)
            above = figure.add_subplot(grid[2 * row, column])
            below = figure.add_subplot(grid[2 * row + 1, column], sharex=above)
            plot_suite_spectrum(part, above)
            plot_overturned_share(part, below)
            above.set(xlabel="", title=slenderness_text(float(part["alpha"])))
            above.tick_params(labelbottom=False)
            below.set_ylabel("overturned [%]")
            if column:
                above.set_ylabel("")
                below.set_ylabel("")
            if number:
                legend = above.get_legend()
                if legend is not None:
                    legend.remove()
        if title:
            figure.suptitle(title, x=0.01, ha="left", fontsize=10)
    return figure
