"""Complete figures of fragility, as the command line saves them."""

from typing import TYPE_CHECKING

from rocksteady.risk.fits.fragility_curve import FragilityCurve
from rocksteady.risk.fragility.fragility import Fragility
from rocksteady.risk.fragility.state_fragility import StateFragility
from rocksteady.show.plots.risk.fragility import plot_fragility
from rocksteady.show.style.page import SCREEN, Page
from rocksteady.show.style.wording import greek

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def fragility_figure(
    fragility: Fragility | StateFragility | FragilityCurve, title: str = "", page: Page = SCREEN
) -> "Figure":
    """Return a figure of counted shares over levels, whose lines are named at their ends.

    Parameters
    ----------
    fragility
        From `rocksteady.compute_fragility`, one of its states, or a fitted curve.
    title
        Above the panel.
    page
        Width of the figure.
    """
    with page.figure(6.6, 4.4, greek(title)) as figure:
        plot_fragility(fragility, figure.add_subplot())
    return figure
