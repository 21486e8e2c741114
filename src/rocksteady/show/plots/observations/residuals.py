"""Plots of residuals: where more or fewer tests fell than predicted."""

from typing import TYPE_CHECKING

import numpy as np

from rocksteady.errors import InputError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import whole_number
from rocksteady.risk.calibration.calibration import Calibration
from rocksteady.show.plots.observations._rows import name_rows
from rocksteady.show.plots.observations._validated import checked_validation
from rocksteady.show.style.layout import axes_or_new
from rocksteady.show.style.legends import LegendPlace, draw_legend, line_scale, place_of
from rocksteady.show.style.tokens import DOUBT, inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MOST = 30
"""Rows of a picture."""
LABEL = "falls less those predicted"


@checked
def plot_residuals(
    calibration: Calibration,
    ax: "Axes | None" = None,
    *,
    by: str = "record",
    most: int = MOST,
    legend: LegendPlace | None = None,
) -> "Axes":
    """Draw by record or by session how many more tests fell than predicted.

    The largest misfits stand on top.  Bars are the range of 90 % of independent outcomes with the
    predicted probabilities: a residual beyond its bar is one that chance explains badly.

    Parameters
    ----------
    calibration
        From `rocksteady.calibrate`.
    ax
        Axes to draw on; default: axes of a new figure.
    by
        "record" (default) or "session".
    most
        Most rows; default 30.
    legend
        "inside" the axes, to their "right", "below" them (default) or "none".

    Returns
    -------
    matplotlib.axes.Axes
        The axes: falls less those predicted, and a row for each record or session.

    Raises
    ------
    InputError
        If there is no such grouping, or no test in it.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import Block, Linear, calibrate
    >>> from rocksteady.calibration import make_synthetic_tests
    >>> from rocksteady.motions import make_synthetic_suite
    >>> column = Block.rectangle(width=0.15, height=0.6)
    >>> tests = make_synthetic_tests(column, make_synthetic_suite(4), model=Linear())
    >>> calibration = calibrate(tests, most_runs=200, model=Linear())
    >>> axes = plot_residuals(calibration, Figure().add_subplot())
    >>> axes.get_xlabel()
    'falls less those predicted'
    """
    if by not in ("record", "session"):
        raise InputError("by", by, "residuals are by record or by session", "name one of the two")
    count = whole_number("most", most, at_least=1, hint="give a number of rows, as 30")
    rows = list(checked_validation(calibration).residuals[by])
    if not rows:
        raise InputError(
            "calibration", Words(f"names no {by}"), "a picture needs one", "name it in the table"
        )
    rows = sorted(rows, key=lambda each: (-abs(each["z"]), each["name"]))[:count]
    axes = axes_or_new(ax)
    inks, place, size = inks_of(axes), place_of(axes, legend, "below"), line_scale(axes)
    at = np.arange(len(rows))
    residual = np.array([each["fell"] - each["expected"] for each in rows], dtype=np.float64)
    half = 1.645 * np.array([each["deviation"] for each in rows])
    range_ = axes.barh(
        at, 2.0 * half, left=-half, height=0.5, color=inks.edge, alpha=DOUBT, lw=0.0,
        label="90\N{NO-BREAK SPACE}% by chance", zorder=1.6,
    )  # fmt: skip
    beyond = np.abs(residual) > half
    handles = []
    for which, face, words in (
        (~beyond, inks.paper, LABEL),
        (beyond, inks.observed, "beyond that"),
    ):
        if which.any():
            handles += axes.plot(
                residual[which], at[which], "o", ms=5.0 * size, color=face, mec=inks.observed,
                mew=0.9, label=words, zorder=3.0,
            )  # fmt: skip
    axes.axvline(0.0, color=inks.edge, lw=0.8, zorder=2.0)
    reach = 1.1 * max(float(np.abs(residual).max()), float(half.max()), 1e-3)
    axes.set(xlabel=LABEL, xlim=(-reach, reach))
    name_rows(axes, [each["name"] for each in rows], [f" ({each['tests']})" for each in rows])
    draw_legend(axes, place, handles=[handles[0], range_, *handles[1:]])
    return axes
