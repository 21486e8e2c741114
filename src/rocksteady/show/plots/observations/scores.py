"""Plots of held-out scores over the number of groups learnt from."""

from typing import TYPE_CHECKING

import numpy as np

from rocksteady.errors import InputError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.risk.calibration.calibration import Calibration
from rocksteady.show.plots.observations._validated import checked_validation
from rocksteady.show.style.layout import axes_or_new, plain_ticks
from rocksteady.show.style.legends import LegendPlace, draw_legend, line_scale, place_of
from rocksteady.show.style.line_ends import LineEnd, name_line_ends
from rocksteady.show.style.tokens import inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

AXIS = {
    "accuracy": "accuracy, held out",
    "f1": "F1 of falls, held out",
    "brier": "Brier score, held out",
    "log_score": "log score, held out",
    "ece": "calibration error, held out",
}
"""Labels of scores; of the Brier and the log score and of the error small ones are good."""
RULES = {
    "block": "calibrated block",
    "logistic": "logistic on intensity",
    "base rate": "base rate",
}
"""Names of the rules of a learning curve."""


@checked
def plot_learning(
    calibration: Calibration,
    ax: "Axes | None" = None,
    *,
    score: str = "accuracy",
    legend: LegendPlace | None = None,
) -> "Axes":
    """Draw a held-out score over the number of training groups.

    Each point is the mean over random choices of the groups, scored on the tests of the others.

    Parameters
    ----------
    calibration
        From `rocksteady.calibrate`.
    ax
        Axes to draw on; default: axes of a new figure.
    score
        "accuracy" (default), "f1", "brier", "log_score" or "ece".
    legend
        "inside" the axes, to their "right" or "below" them; "none" by default, with the lines named
        at their ends.

    Returns
    -------
    matplotlib.axes.Axes
        The axes: number of groups, and the score of the calibrated block, of a logistic on
        intensity measures and of the base rate.

    Raises
    ------
    InputError
        If there is no such score, or too few groups for a curve.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import Block, Linear, calibrate
    >>> from rocksteady.calibration import make_synthetic_tests
    >>> from rocksteady.motions import make_synthetic_suite
    >>> column = Block.rectangle(width=0.15, height=0.6)
    >>> tests = make_synthetic_tests(column, make_synthetic_suite(4), model=Linear())
    >>> calibration = calibrate(tests, most_runs=200, model=Linear())
    >>> axes = plot_learning(calibration, Figure().add_subplot())
    >>> axes.get_ylabel()
    'accuracy, held out'
    """
    _check_score(score)
    curve = checked_validation(calibration).learning
    if not curve:
        raise InputError(
            "calibration", Words("has no learning curve"), "it takes several groups", "add tests"
        )
    axes = axes_or_new(ax)
    inks, place, size = inks_of(axes), place_of(axes, legend, "none"), line_scale(axes)
    at = np.array([each["groups"] for each in curve], dtype=np.float64)
    ends = []
    for role, mark, (kind, words) in zip(
        ("motion", "quiet", "edge"), "os^", RULES.items(), strict=True
    ):
        values, colour = [each[f"{kind} {score}"] for each in curve], getattr(inks, role)
        axes.plot(
            at, values, marker=mark, ms=4.0 * size, color=colour, lw=1.4 * size, label=words,
            zorder=2.6,
        )  # fmt: skip
        ends.append(LineEnd(words.replace(" ", "\n", 1), values, colour))
    if at.max() > 4.0 * at.min():
        axes.set_xscale("log")
        plain_ticks(axes)
    else:
        axes.locator_params(axis="x", integer=True)
    axes.set(xlabel="groups learnt from", ylabel=AXIS[score])
    if place == "none":
        name_line_ends(axes, ends)
    draw_legend(axes, place)
    return axes


def _check_score(score: str) -> None:
    """Refuse a score that does not exist."""
    if score not in AXIS:
        raise InputError("score", score, "the scores are " + ", ".join(AXIS), "name one of them")
