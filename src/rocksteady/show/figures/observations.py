"""Complete figures of observations, as the command line saves them."""

from typing import TYPE_CHECKING

from rocksteady.risk.free_rocking.restitution_fit import RestitutionFit
from rocksteady.show.plots.observations.restitution import plot_restitution
from rocksteady.show.style.page import SCREEN, Page

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def restitution_figure(fit: RestitutionFit, title: str = "", page: Page = SCREEN) -> "Figure":
    """Return a figure of measured free rocking: decay of the peaks, and each impact.

    Parameters
    ----------
    fit
        From `rocksteady.fit_restitution`.
    title
        Above the panels.
    page
        Width of the figure, and place of its legends.
    """
    with page.figure(9.6, 4.2, title, stacked=1.6) as figure:
        stacked = page.stacks(9.6)
        first, second = figure.subplots(2, 1) if stacked else figure.subplots(1, 2)
        plot_restitution(fit, first, legend=page.legend)
        plot_restitution(fit, second, panel="impacts", legend=page.legend)
    return figure
