"""Complete figures of rocking spectra, as the command line saves them."""

import math
from typing import TYPE_CHECKING

from rocksteady.show.plots.spectra import (
    MOST_CURVES,
    plot_rocking_spectrum,
    plot_share_that_falls,
    plot_spectrum_map,
    plot_suite_spectrum,
    slenderness_text,
)
from rocksteady.show.style.legends import LegendPlace
from rocksteady.show.style.page import SCREEN, Page

NARROWEST = 1.9
"""Width of a panel, in inches, at least."""

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure


def spectrum_figure(dataset: "xarray.Dataset", title: str = "", page: Page = SCREEN) -> "Figure":
    """Return a figure of one record's rocking spectrum: angle and velocity, curves or maps.

    Parameters
    ----------
    dataset
        From `rocksteady.compute_rocking_spectrum`, as for `rocksteady.plots.rocking_spectrum`, but
        of any number of slendernesses: more than six are a map.
    title
        Above the panels.
    page
        Width of the figure, and place of its legends.
    """
    curves = dataset.sizes.get("alpha", 1) <= MOST_CURVES
    with page.figure(10.4, 4.2, title, stacked=1.4) as figure:
        stacked = page.stacks(10.4)
        first, second = figure.subplots(2, 1) if stacked else figure.subplots(1, 2)
        draw = plot_rocking_spectrum if curves else plot_spectrum_map
        # One legend, on that side of the figure on which it goes: two would repeat the same.
        last = page.legend == "right" and not stacked
        draw(dataset, first, legend="none" if last else page.legend)
        # Curves without a legend have names at their ends, in both panels.
        others: LegendPlace | None = None if curves and page.legend is None else "none"
        draw(dataset, second, quantity="peak_velocity", legend="right" if last else others)
    return figure


def suite_figure(summary: "xarray.Dataset", title: str = "", page: Page = SCREEN) -> "Figure":
    """Return a figure of a suite's rocking spectra: a panel a slenderness, falls beneath it.

    Parameters
    ----------
    summary
        From `rocksteady.measures.compute_suite_spectrum`, of one scale and at most six
        slendernesses.
    title
        Above the panels.
    page
        Width of the figure, and place of its legends.
    """
    several = "alpha" in summary.dims
    parts = [summary.isel(alpha=k) for k in range(summary.sizes["alpha"])] if several else [summary]
    across = min(3, len(parts))
    natural = max(7.4, 1.2 + 3.2 * across)
    across = max(1, min(across, int(page.width(natural) / NARROWEST)))
    down = math.ceil(len(parts) / across)
    high = (0.5 + min(4.2, 0.85 * page.width(natural) / across) * down) / page.width(natural)
    with page.figure(natural, 0.5 + 4.2 * down, title, stacked=high) as figure:
        grid = figure.add_gridspec(2 * down, across, height_ratios=(2.2, 1.0) * down)
        for number, part in enumerate(parts):
            row, column = divmod(number, across)
            above = figure.add_subplot(grid[2 * row, column])
            below = figure.add_subplot(grid[2 * row + 1, column], sharex=above)
            named = number == (len(parts) - 1 if page.legend == "right" else 0)
            place = page.legend or ("inside" if len(parts) > 1 else None)
            plot_suite_spectrum(part, above, legend=place if named else "none")
            plot_share_that_falls(part, below)
            above.set(xlabel="", title=slenderness_text(float(part["alpha"])))
            above.tick_params(labelbottom=False)
            below.set_ylabel("fall [%]")
            if column:
                above.set_ylabel("")
                below.set_ylabel("")
    return figure
