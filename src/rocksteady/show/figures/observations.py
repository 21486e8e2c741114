"""Complete figures of observations, as the command line saves them."""

from typing import TYPE_CHECKING

from rocksteady.results.numbers import plural
from rocksteady.risk.back_analysis.back_analysis import BackAnalysis
from rocksteady.risk.calibration.calibration import Calibration
from rocksteady.risk.calibration.held_out.predictions import Predictions
from rocksteady.risk.free_rocking.restitution_fit import RestitutionFit
from rocksteady.show.plots.observations.back_analysis import plot_back_analysis
from rocksteady.show.plots.observations.ladders import plot_test_ladders
from rocksteady.show.plots.observations.posteriors import plot_posterior
from rocksteady.show.plots.observations.predictions import NAMED, plot_predictions
from rocksteady.show.plots.observations.reliability import plot_reliability
from rocksteady.show.plots.observations.restitution import plot_restitution
from rocksteady.show.style.page import SCREEN, Page

if TYPE_CHECKING:
    from matplotlib.figure import Figure

ROWS = 24
"""Records of the figure of a calibration: the records that need the largest gain to fell an
object."""


def calibration_figure(calibration: Calibration, title: str = "", page: Page = SCREEN) -> "Figure":
    """Return a figure of the tests by record, with alpha and the reliability beside or below.

    Parameters
    ----------
    calibration
        From `rocksteady.calibrate`.
    title
        Above the panels; by default the numbers of tests and objects.
    page
        Width of the figure, and place of its legends.
    """
    count = plural(len(calibration.tests.tests), "test")
    words = title or f"{count} of {plural(len(calibration.posteriors), 'object')}"
    with page.figure(10.8, 5.6, words, stacked=2.4) as figure:
        if page.stacks(10.8):
            first, second, third = figure.subplots(3, 1, height_ratios=(1.5, 1.0, 1.0))
        else:
            grid = figure.add_gridspec(2, 2, width_ratios=(1.15, 1.0))
            first = figure.add_subplot(grid[:, 0])
            second, third = figure.add_subplot(grid[0, 1]), figure.add_subplot(grid[1, 1])
        plot_posterior(calibration, second, legend=page.legend)
        if not calibration.validation.rows:
            third.remove()
        else:
            plot_reliability(calibration, third, legend=page.legend)
        plot_test_ladders(calibration, first, most=ROWS, legend=page.legend)
    return figure


def back_analysis_figure(analysis: BackAnalysis, title: str = "", page: Page = SCREEN) -> "Figure":
    """Return a figure of the shakings that agree with a survey.

    Parameters
    ----------
    analysis
        From `rocksteady.back_analyse`.
    title
        Above the panel.
    page
        Width of the figure, and place of its legend.
    """
    return page.panel(6.6, 5.0, title, plot_back_analysis, analysis)


def predictions_figure(predictions: Predictions, title: str = "", page: Page = SCREEN) -> "Figure":
    """Return a figure of predictions, as high as its rows need.

    Parameters
    ----------
    predictions
        From `rocksteady.calibration.Calibration.predict`.
    title
        Above the panel.
    page
        Width of the figure, and place of its legend.
    """
    rows = min(len(predictions), NAMED)
    return page.panel(6.6, max(2.2, 1.3 + 0.2 * rows), title, plot_predictions, predictions)


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
