"""Plot of hazard curves: how often a year each level is exceeded."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from rocksteady.errors import InputError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.risk.hazard.hazard_curve import HazardCurve
from rocksteady.show.plots.risk._words import greek
from rocksteady.show.style import palette
from rocksteady.show.style.escaping import literal
from rocksteady.show.style.layout import axes_or_new, plain_ticks
from rocksteady.show.style.limits import name_level_end
from rocksteady.show.style.line_ends import LineEnd, name_line_ends
from rocksteady.show.style.tokens import DASHED, inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

RETURN = 475
"""Return period that is marked [years]: 10 % in 50 years."""


@checked
def plot_hazard_curve(
    curves: HazardCurve | Sequence[HazardCurve], ax: "Axes | None" = None
) -> "Axes":
    """Draw hazard curves: annual rate at which shaking exceeds each level.

    The dashed line is the rate of 10 % in 50 years, once in 475 years.

    Parameters
    ----------
    curves
        One, or several of one measure, as from `rocksteady.read_hazard_curves`.
    ax
        Axes to draw on; default: axes of a new figure.

    Returns
    -------
    matplotlib.axes.Axes
        The axes: level of the measure, and annual rate of exceedance.

    Raises
    ------
    InputError
        If there is no curve, or they have several measures.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady.risk import HazardCurve
    >>> hazard = HazardCurve(measure="pgv_m_s", levels=[0.1, 0.5, 2.0], rates=[1e-2, 1e-4, 1e-6])
    >>> axes = plot_hazard_curve(hazard, Figure().add_subplot())
    >>> axes.get_xlabel(), axes.get_xscale()
    ('PGV [m/s]', 'log')
    """
    each = [curves] if isinstance(curves, HazardCurve) else [*curves]
    measures = {str(curve.intensity) for curve in each}
    if len(measures) != 1:
        raise InputError(
            "curves",
            Words(f"have {len(measures)} measures"),
            "curves of one picture have one measure",
            "draw one picture for each measure",
        )
    axes = axes_or_new(ax)
    inks = inks_of(axes)
    named = len(each) > 1
    ends: list[LineEnd] = []
    for curve, colour in zip(each, inks.series("base", len(each)), strict=True):
        axes.plot(curve.levels, curve.rates, color=colour, marker=".", ms=4.0, lw=1.6)
        if named and curve.name:
            ends.append(LineEnd(literal(palette.shortened(curve.name)), curve.rates, colour))
    axes.set(
        xscale="log",
        yscale="log",
        xlabel=greek(measures.pop()),
        ylabel="annual rate of exceedance",
    )
    if ends:
        name_line_ends(axes, ends)
    low, high = axes.get_ylim()
    if low < 1.0 / RETURN < high:
        axes.axhline(1.0 / RETURN, color=inks.limit, ls=DASHED, lw=1.0, zorder=0.9)
        name_level_end(axes, 1.0 / RETURN, f"once in {RETURN} years")
    plain_ticks(axes)
    return axes
