"""Complete figures of facades, as the command line saves them."""

from typing import TYPE_CHECKING

from rocksteady.facades.checks.facade_check import FacadeCheck
from rocksteady.facades.checks.facade_runs import FacadeRuns
from rocksteady.facades.plots.capacity import plot_facade_capacity
from rocksteady.facades.plots.headline import title_of
from rocksteady.facades.plots.languages import language_of
from rocksteady.facades.plots.run_displacements import plot_facade_runs
from rocksteady.facades.plots.section import plot_facade_section
from rocksteady.show.style.page import SCREEN, Page

if TYPE_CHECKING:
    from matplotlib.figure import Figure

WIDE = 10.8
"""Width of the panels side by side [inches]."""
ROW, LEAST, MOST = 0.3, 4.6, 9.0
"""Height of a record's row, and lowest and highest figure [inches]."""


def facade_figure(check: FacadeCheck, *, language: str = "en", page: Page = SCREEN) -> "Figure":
    """Return a figure of the section, the capacity curve and the runs of a facade.

    Parameters
    ----------
    check
        From `rocksteady.check_facade`.
    language
        "en" or "it".
    page
        Width of the figure, and place of its legends.

    Raises
    ------
    InputError
        If there is no such language.
    """
    title = title_of(check, language_of(language))
    runs = check.runs if isinstance(check.runs, FacadeRuns) else None
    rows = 0 if runs is None else len(runs.records)
    stacked = page.stacks(WIDE)
    below = 1.2 + ROW * rows if rows else 0.0
    high = min(MOST, LEAST + below)
    tall = 2.0 + (0.5 + 0.08 * min(rows, 20) if rows else 0.0)
    with page.figure(WIDE, high, title, stacked=tall) as figure:
        panels = 3 if rows else 2
        if stacked:
            ratios = [1.0, 0.85, *([0.35 + 0.07 * min(rows, 20)] if rows else [])]
            grid = figure.add_gridspec(panels, 1, height_ratios=ratios)
            places = [grid[k, 0] for k in range(panels)]
        else:
            ratios = [LEAST, below] if rows else [1.0]
            grid = figure.add_gridspec(
                len(ratios), 2, height_ratios=ratios, width_ratios=[0.7, 1.0]
            )
            places = [grid[0, 0], grid[0, 1], *([grid[1, :]] if rows else [])]
        plot_facade_section(check.facade, figure.add_subplot(places[0]), language=language)
        legend = page.legend
        plot_facade_capacity(check, figure.add_subplot(places[1]), language=language, legend=legend)
        if runs is not None:
            axes = figure.add_subplot(places[2])
            plot_facade_runs(runs, axes, language=language, legend=legend)
    return figure
