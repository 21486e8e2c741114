"""Complete figures of fragility, as the command line saves them."""

from typing import TYPE_CHECKING

from rocksteady.risk.fits.fragility_curve import FragilityCurve
from rocksteady.risk.fits.two_stages import TwoStageCurve
from rocksteady.risk.fragility.fragility import Fragility
from rocksteady.show.plots.risk.fragility import plot_fragility, plot_fragility_states
from rocksteady.show.style.page import SCREEN, Page
from rocksteady.show.style.wording import greek

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def fragility_figure(
    fragility: Fragility | FragilityCurve | TwoStageCurve,
    state: str | None = None,
    title: str = "",
    page: Page = SCREEN,
) -> "Figure":
    """Return a figure of one damage state, beside or above one of all of them where there are more.

    Parameters
    ----------
    fragility
        From `rocksteady.compute_fragility`, or a curve.
    state
        Damage state of the first panel; the last by default.
    title
        Above the panels.
    page
        Width of the figure, and place of its legends.
    """
    title = greek(title)
    if not isinstance(fragility, Fragility) or len(fragility.states) == 1:
        return page.panel(6.6, 4.4, title, plot_fragility, fragility, state=state)
    with page.figure(10.8, 4.6, title, stacked=1.6) as figure:
        stacked = page.stacks(10.8)
        first, second = figure.subplots(2, 1) if stacked else figure.subplots(1, 2)
        plot_fragility(fragility, first, state=state, legend=page.legend)
        plot_fragility_states(fragility, second, legend=page.legend or "below")
    return figure
