"""Plots of observed outcomes: objects of a survey by shape and size, tests by their shaking."""

from typing import TYPE_CHECKING

import numpy as np

from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.checks.arguments import checked
from rocksteady.risk.back_analysis.survey import Survey
from rocksteady.risk.observations.observations import Observations
from rocksteady.show.plots.observations._rows import draw_outcomes, name_rows
from rocksteady.show.style import palette
from rocksteady.show.style.layout import axes_or_new
from rocksteady.show.style.legends import LegendPlace, draw_legend, line_scale, place_of
from rocksteady.show.style.tokens import inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LANES = (0.16, 0.0, -0.16)
"""Height of tests over the row of their object: fell, unknown, stood."""


@checked
def plot_survey(
    survey: Survey | Observations,
    ax: "Axes | None" = None,
    *,
    legend: LegendPlace | None = None,
) -> "Axes":
    """Draw which objects fell: those of a survey by slenderness and size, tests by their PGA.

    Sizes are the middle of what is known of an object, by its outline.

    Parameters
    ----------
    survey
        Objects of one place after one shaking, or shaking tests.
    ax
        Axes to draw on; default: axes of a new figure.
    legend
        "inside" the axes, to their "right", "below" them (default) or "none".

    Returns
    -------
    matplotlib.axes.Axes
        The axes of a survey: slenderness alpha [rad] and half-diagonal R [m].  Of tests: PGA of the
        base [g], with the gain, and a row for each object.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady.calibration import ObjectPrior, Survey
    >>> graves = [
    ...     ObjectPrior(name=f"grave {k}", width_m=0.2, height_m=0.8 + 0.2 * k) for k in range(3)
    ... ]
    >>> axes = plot_survey(Survey(objects=graves, fell=[False, True, True]), Figure().add_subplot())
    >>> [text.get_text() for text in axes.get_legend().get_texts()]
    ['fell', 'stood']
    """
    axes = axes_or_new(ax)
    place, mark = place_of(axes, legend, "below"), 5.5 * line_scale(axes)
    if isinstance(survey, Survey):
        across = np.array([each.outline_alpha_rad for each in survey.objects])
        up = np.array([each.outline_radius_m for each in survey.objects])
        handles = draw_outcomes(axes, (across, up), survey.fell, mark)
        axes.set(
            xlabel=palette.LABELS["alpha"],
            ylabel=palette.LABELS["radius"],
            xlim=(0.0, 1.08 * across.max()),
            ylim=(0.0, 1.08 * up.max()),
        )
    else:
        names, outcomes = list(survey.objects), [test.fell for test in survey.tests]
        lanes = dict(zip((True, None, False), LANES, strict=True))
        across = np.array([test.motion.peak_acceleration_m_s2 for test in survey.tests])
        across = across / STANDARD_GRAVITY
        up = np.array([names.index(test.object) - lanes[test.fell] for test in survey.tests])
        unknown = ("D", inks_of(axes).quiet, "unknown")
        handles = draw_outcomes(axes, (across, up), outcomes, mark, unknown)
        axes.set(xlabel="PGA of the base [g]", xlim=(0.0, 1.08 * across.max()))
        name_rows(axes, names)
    draw_legend(axes, place, handles=handles)
    return axes
