"""Plots of risk: hazard, fragility and where the risk comes from."""

from typing import TYPE_CHECKING, Any

import numpy as np

from rocksteady.model.checks.arguments import checked
from rocksteady.risk.hazard.failure_risk import Risk
from rocksteady.show.plots.risk._words import greek
from rocksteady.show.style.layout import axes_or_new, percent_ticks, plain_ticks
from rocksteady.show.style.legends import LegendPlace, draw_legend, place_of
from rocksteady.show.style.tokens import DOUBT, inks_of
from rocksteady.words.hazard import years_words

if TYPE_CHECKING:
    from matplotlib.axes import Axes

BARS, POINTS = 24, 16
"""Bars of the risk, and points of each."""
HIGHEST_FILL = 0.9
"""Height of the largest bar, on the axis of probabilities."""


@checked
def plot_risk(risk: Risk, ax: "Axes | None" = None, *, legend: LegendPlace | None = None) -> "Axes":
    """Draw a hazard curve, a fragility, and the share of intensities in the risk.

    The hazard has the left axis, the probability of falling the right one.  Bars are the rate of
    falling per unit of ln(intensity), scaled to a height of their own; darker are the intensities
    between which the middle 90 % of the risk lie.

    Parameters
    ----------
    risk
        From `rocksteady.compute_risk`.
    ax
        Axes to draw on; default: axes of a new figure.
    legend
        "inside" the axes, to their "right", "below" them, the default, or "none".

    Returns
    -------
    matplotlib.axes.Axes
        The axes: the hazard's measure, and its annual rate.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import compute_risk
    >>> from rocksteady.risk import HazardCurve
    >>> hazard = HazardCurve(measure="pgv_m_s", levels=[0.02, 0.5, 2.0], rates=[0.1, 1e-4, 1e-6])
    >>> axes = plot_risk(compute_risk((0.4653, 0.592), hazard), Figure().add_subplot())
    >>> axes.get_xlabel(), axes.get_ylabel()
    ('PGV [m/s]', 'annual rate of exceedance')
    """
    from matplotlib.patches import Patch

    axes = axes_or_new(ax)
    inks, place = inks_of(axes), place_of(axes, legend, "below")
    hazard = risk.hazard
    low, high = float(hazard.levels[0]), float(hazard.levels[-1])
    at = np.clip(np.geomspace(low, high, BARS * POINTS), low, high)
    axes.set(xscale="log", yscale="log")
    (curve,) = axes.plot(
        hazard.levels,
        hazard.rates,
        color=inks.base,
        marker=".",
        ms=5.0,
        label="hazard",
        clip_on=False,
    )
    beside = axes.twinx()
    (fragility,) = beside.plot(
        at,
        risk.fragile.at(at),
        color=inks.risk,
        lw=2.0,
        label="probability of falling",
    )
    edges = np.clip(np.geomspace(low, high, BARS + 1), low, high)
    shares = risk.fragile.at(at).reshape(BARS, POINTS).mean(axis=1)
    bars = -np.diff(hazard.rate(edges)) * shares
    fill = np.repeat(bars * (HIGHEST_FILL / max(float(bars.max()), 1e-300)), POINTS)
    style: dict[str, Any] = {"color": inks.risk, "lw": 0.0, "alpha": DOUBT}
    everywhere = beside.fill_between(
        at, fill, label="rate of falling by intensity, not to scale", **style
    )
    first, _, last = risk.contributing
    inside = (at >= first) & (at <= last)
    beside.fill_between(at, fill, where=inside.tolist(), **style)
    # Lines above the bars: the axes of the hazard stand in front, on the paper of the others.
    beside.set_facecolor(axes.get_facecolor())
    beside.patch.set_visible(True)
    axes.set_zorder(beside.get_zorder() + 1.0)
    axes.patch.set_visible(False)
    twice = 1.0 - (1.0 - DOUBT) ** 2
    shade = Patch(facecolor=inks.risk, alpha=twice, lw=0.0, label="middle 90 % of the risk")
    axes.set(
        xlim=(low, high),
        xlabel=greek(str(hazard.intensity)),
        ylabel="annual rate of exceedance",
        title=f"falls once in {years_words(risk.annual_rate)} years",
    )
    percent_ticks(beside, "y")
    beside.set(ylim=(0.0, 1.03), ylabel=str(fragility.get_label()))
    axes.grid(visible=False)  # those of the probabilities are beneath the area
    beside.spines["right"].set_visible(True)
    for each, ink in ((axes, inks.base), (beside, inks.risk)):
        each.tick_params(axis="y", which="both", colors=ink)
        each.yaxis.label.set_color(ink)
    plain_ticks(axes)
    draw_legend(axes, place, handles=[curve, fragility, everywhere, shade], gap=44.0)
    return axes
