"""Plots of held-out scores: over the temper, and over the number of groups learnt from."""

from typing import TYPE_CHECKING

import numpy as np

from rocksteady.errors import InputError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.risk.calibration.calibration import Calibration
from rocksteady.show.plots.observations._validated import checked_validation
from rocksteady.show.style.layout import axes_or_new, plain_ticks
from rocksteady.show.style.legends import LegendPlace, draw_legend, line_scale, place_of
from rocksteady.show.style.line_ends import LineEnd, name_line_ends
from rocksteady.show.style.tokens import DOUBT, inks_of

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
    "calibrated": "calibrated block",
    "logistic": "logistic on intensity",
    "base rate": "base rate",
}
"""Names of the rules of a learning curve."""


@checked
def plot_temper(
    calibration: Calibration,
    ax: "Axes | None" = None,
    *,
    score: str = "log_score",
    legend: LegendPlace | None = None,
) -> "Axes":
    """Draw a held-out score over the temper, with the chosen one and the untempered.

    Parameters
    ----------
    calibration
        From `rocksteady.calibrate`.
    ax
        Axes to draw on; default: axes of a new figure.
    score
        "accuracy", "f1", "brier", "log_score" (default) or "ece".
    legend
        "inside" the axes, to their "right", "below" them (default) or "none".

    Returns
    -------
    matplotlib.axes.Axes
        The axes: the exponent of the likelihood, and the score with intervals of 90 %.

    Raises
    ------
    InputError
        If there is no such score, or no test could be held out.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import Block, Linear, calibrate
    >>> from rocksteady.calibration import DrawOptions, make_synthetic_tests
    >>> from rocksteady.motions import make_synthetic_suite
    >>> column = Block.rectangle(width=0.15, height=0.6)
    >>> tests = make_synthetic_tests(column, make_synthetic_suite(4), model=Linear())
    >>> few = DrawOptions(draws=60, gains=2, rounds=1)
    >>> calibration = calibrate(tests, sampling=few, model=Linear())
    >>> axes = plot_temper(calibration, Figure().add_subplot())
    >>> axes.get_ylabel()
    'log score, held out'
    """
    _check_score(score)
    tried = checked_validation(calibration).temper_scores
    axes = axes_or_new(ax)
    inks, place, size = inks_of(axes), place_of(axes, legend, "below"), line_scale(axes)
    at = np.array(sorted(tried))
    value, low, high = np.array([getattr(tried[each], score) for each in at.tolist()]).T
    axes.fill_between(at, low, high, color=inks.motion, alpha=DOUBT, lw=0.0, zorder=1.6)
    (line,) = axes.plot(
        at, value, "o-", ms=3.5 * size, color=inks.motion, lw=1.2 * size, zorder=2.4,
        label="score, 90\N{NO-BREAK SPACE}% band",
    )  # fmt: skip
    handles = [line]
    for temper, face, words in (
        (1.0, inks.paper, "untempered"),
        (calibration.temper, inks.ink, f"chosen, T = {calibration.temper:g}"),
    ):
        where = np.flatnonzero(np.isclose(at, temper))
        if len(where):
            handles += axes.plot(
                at[where], value[where], "D", ms=7.0 * size, color=face, mec=inks.ink,
                mew=1.2 * size, label=words, ls="none", zorder=3.0,
            )  # fmt: skip
    axes.set_xscale("log")
    axes.set(xlim=(0.85 * at[0], at[-1] / 0.85), xlabel="temper T, the exponent of the likelihood")
    axes.set_ylabel(AXIS[score])
    plain_ticks(axes)
    draw_legend(axes, place, handles=handles)
    return axes


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
    >>> from rocksteady.calibration import DrawOptions, make_synthetic_tests
    >>> from rocksteady.motions import make_synthetic_suite
    >>> column = Block.rectangle(width=0.15, height=0.6)
    >>> tests = make_synthetic_tests(column, make_synthetic_suite(4), model=Linear())
    >>> few = DrawOptions(draws=60, gains=2, rounds=1)
    >>> calibration = calibrate(tests, sampling=few, model=Linear())
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
        values, colour = [getattr(each[kind], score)[0] for each in curve], getattr(inks, role)
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
