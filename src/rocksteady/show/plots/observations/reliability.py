"""Plots of reliability: how often tests fell, against how often it was predicted."""

from typing import TYPE_CHECKING

import numpy as np

from rocksteady.model.checks.arguments import checked
from rocksteady.risk.calibration.calibration import Calibration
from rocksteady.show.plots.observations._validated import checked_validation
from rocksteady.show.style.layout import axes_or_new, percent_ticks
from rocksteady.show.style.legends import (
    LegendPlace,
    draw_legend,
    line_scale,
    place_of,
    text_size,
)
from rocksteady.show.style.tokens import DASHED, inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

FOOT, TALLEST = -0.24, 0.13
"""Where the bars of counts stand, and the height of the longest one, on the axis of shares."""


@checked
def plot_reliability(
    calibration: Calibration, ax: "Axes | None" = None, *, legend: LegendPlace | None = None
) -> "Axes":
    """Draw the share of tests that fell against the predicted probability, held out.

    Tests are taken together by tenths of the probability; bars at the foot are the numbers of tests
    in each.  Points of a model with correct errors lie on the diagonal.

    Parameters
    ----------
    calibration
        From `rocksteady.calibrate`.
    ax
        Axes to draw on; default: axes of a new figure.
    legend
        "inside" the axes, to their "right", "below" them (default) or "none".

    Returns
    -------
    matplotlib.axes.Axes
        The axes: predicted probability and share that fell.

    Raises
    ------
    InputError
        If no test could be held out.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import Block, Linear, calibrate
    >>> from rocksteady.calibration import make_synthetic_tests
    >>> from rocksteady.motions import make_synthetic_suite
    >>> column = Block.rectangle(width=0.15, height=0.6)
    >>> tests = make_synthetic_tests(column, make_synthetic_suite(4), model=Linear())
    >>> calibration = calibrate(tests, most_runs=200, model=Linear())
    >>> axes = plot_reliability(calibration, Figure().add_subplot())
    >>> axes.get_ylabel()
    'share that fell'
    """
    bins = checked_validation(calibration).reliability
    axes = axes_or_new(ax)
    inks, place, size = inks_of(axes), place_of(axes, legend, "below"), line_scale(axes)
    at, share, low, high, count, first, last = (
        np.array([each[key] for each in bins], dtype=np.float64)
        for key in ("predicted", "observed", "low", "high", "tests", "from", "to")
    )
    middle, top = 0.5 * (first + last), TALLEST * count / count.max()
    bars = axes.bar(
        middle,
        top,
        bottom=FOOT,
        width=0.92 * (last - first),
        color=inks.edge,
        alpha=0.35,
        lw=0.0,
        label="number of tests",
        zorder=1.5,
    )
    for x, height, words in zip(middle, FOOT + top, count.astype(int), strict=True):
        axes.annotate(
            str(words), (x, height), (0.0, 1.5), textcoords="offset points", ha="center",
            va="bottom", fontsize=text_size(axes, 7.5), color=inks.quiet, zorder=3.5,
        )  # fmt: skip
    axes.plot([0.0, 1.0], [0.0, 1.0], color=inks.limit, lw=1.0, ls=DASHED, zorder=2.0)
    axes.vlines(at, low, high, color=inks.observed, lw=1.0 * size, zorder=2.6)
    (points,) = axes.plot(
        at, share, "o", ms=5.5 * size, color=inks.observed, mec=inks.paper, mew=0.6,
        label="share that fell, 90\N{NO-BREAK SPACE}% interval",
        zorder=3.0,
    )  # fmt: skip
    percent_ticks(axes, "x")
    percent_ticks(axes, "y")
    axes.set(
        ylim=(FOOT, 1.04),
        xlabel="predicted probability of falling, held out",
        ylabel="share that fell",
    )
    axes.annotate(
        "as predicted", (1.0, 1.0), (4.0, 0.0), textcoords="offset points", va="center",
        color=inks.limit, fontsize=text_size(axes, 8.0), annotation_clip=False,
    )  # fmt: skip
    draw_legend(axes, place, handles=[points, bars], corner="upper left")
    return axes
