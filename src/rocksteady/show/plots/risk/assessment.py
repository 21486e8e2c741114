"""Plot of an assessment: how likely the object falls at each intensity, and the demand."""

import math
from typing import TYPE_CHECKING

from rocksteady.errors import InputError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.risk.assess.assessment import Assessment
from rocksteady.risk.assess.demand_in_units import demand_in_measure
from rocksteady.risk.fragility.damage_states import OVERTURNED
from rocksteady.show.plots.risk.fragility import NOT_RUN, plot_fragility
from rocksteady.show.style.layout import axes_or_new
from rocksteady.show.style.limits import draw_limit
from rocksteady.show.style.tokens import inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

ROOM = 1.25
"""Factor by which a picture goes beyond a demand outside of it."""


@checked
def plot_assessment(assessment: Assessment, ax: "Axes | None" = None) -> "Axes":
    """Draw the fragility of an assessed object with its demand, a dashed line.

    Parameters
    ----------
    assessment
        From `rocksteady.assess_object`.
    ax
        Axes to draw on; default: axes of a new figure.

    Returns
    -------
    matplotlib.axes.Axes
        The axes: intensity, and probability of falling.

    Raises
    ------
    InputError
        If there is no curve: the object slides.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import assess_object
    >>> from rocksteady.motions import make_synthetic_suite
    >>> from rocksteady.risk import DescribedObject
    >>> vase = DescribedObject(
    ...     values={
    ...         "name": "vase",
    ...         "geometry": {"width_m": 0.14, "height_m": 0.5},
    ...         "demand": {"pga_g": 0.4, "pgv_m_s": 0.4},
    ...         "assessment": {"draws": 1, "levels": 4, "replicates": 0},
    ...     }
    ... )
    >>> axes = plot_assessment(assess_object(vase, make_synthetic_suite(3)), Figure().add_subplot())
    >>> axes.get_ylabel()
    'probability of falling'
    """
    if assessment.fragility is None:
        raise InputError(
            "assessment",
            Words("has no curve"),
            "the object slides, and rocking is no answer",
            "read summary()",
        )
    axes = axes_or_new(ax)
    plot_fragility(assessment.fragility, axes, state=OVERTURNED)
    demand = demand_in_measure(assessment)
    if math.isfinite(demand):
        _draw_demand(axes, demand)
    return axes


def _draw_demand(axes: "Axes", demand: float) -> None:
    """Draw the demand; the picture grows where it lies outside."""
    inks, limits = inks_of(axes), axes.get_xlim()
    shown = (min(limits[0], demand / ROOM), max(limits[1], demand * ROOM))
    for begin, end in zip(shown, limits, strict=True):
        if begin != end:  # not run either
            axes.axvspan(begin, end, color=inks.edge, alpha=NOT_RUN, lw=0.0, zorder=0.5)
    axes.set_xlim(shown)
    draw_limit(axes, demand, "demand", zorder=2.5)
