"""Plots of predictions: the probability that each test falls, with its band."""

from typing import TYPE_CHECKING

import numpy as np

from rocksteady.model.checks.arguments import checked
from rocksteady.risk.calibration.held_out.predictions import Predictions
from rocksteady.show.plots.observations._rows import draw_outcomes, name_rows
from rocksteady.show.style import palette
from rocksteady.show.style.layout import axes_or_new, percent_ticks
from rocksteady.show.style.legends import LegendPlace, draw_legend, line_scale, place_of
from rocksteady.show.style.limits import draw_limit
from rocksteady.show.style.tokens import DOUBT, inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

NAMED = 40
"""Tests up to which each has its name."""


@checked
def plot_predictions(
    predictions: Predictions, ax: "Axes | None" = None, *, legend: LegendPlace | None = None
) -> "Axes":
    """Draw the probability that each test falls, with its interval of 90 %.

    Parameters
    ----------
    predictions
        From `rocksteady.calibration.Calibration.predict`, or the held-out ones of a validation.
    ax
        Axes to draw on; default: axes of a new figure.
    legend
        "inside" the axes, to their "right", "below" them (default) or "none".

    Returns
    -------
    matplotlib.axes.Axes
        The axes: probability of falling, and a row for each test, with names up to 40 tests.

    Raises
    ------
    InputError
        If the legend has no such place.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import Block, Linear, calibrate
    >>> from rocksteady.calibration import make_synthetic_tests
    >>> from rocksteady.motions import make_synthetic_suite
    >>> column = Block.rectangle(width=0.15, height=0.6)
    >>> tests = make_synthetic_tests(column, make_synthetic_suite(4), model=Linear())
    >>> calibration = calibrate(tests, most_runs=200, model=Linear())
    >>> axes = plot_predictions(calibration.validation.predictions, Figure().add_subplot())
    >>> axes.get_xlabel()
    'probability of falling'
    """
    axes = axes_or_new(ax)
    inks, place, size = inks_of(axes), place_of(axes, legend, "below"), line_scale(axes)
    p, low, high = (np.asarray(getattr(predictions, key)) for key in ("p", "low", "high"))
    order = np.argsort(p, kind="stable")
    few = len(order) <= NAMED
    at = np.arange(len(order))
    band = axes.hlines(
        at, low[order], high[order], color=inks.risk, lw=(5.0 if few else 1.6) * size,
        alpha=DOUBT, label="90\N{NO-BREAK SPACE}% of the draws", zorder=2.0,
    )  # fmt: skip
    outcomes = [predictions.fell[place_] for place_ in order.tolist()]
    mark, predicted = (5.0 if few else 3.0) * size, ("D", inks.risk, "predicted")
    handles = draw_outcomes(axes, (p[order], at), outcomes, mark, predicted)
    draw_limit(axes, 0.5, "even chance", zorder=1.5)
    axes.set(ylim=(len(order) - 0.4, -0.6), xlabel=palette.LABELS["falling"])
    percent_ticks(axes, "x")
    if few:
        name_rows(axes, [predictions.test[each] for each in order.tolist()])
    else:
        axes.set_ylabel("tests in the order of their probability")
    draw_legend(axes, place, handles=[*handles, *([band] if (high > low).any() else [])])
    return axes
