"""Plot of a back-analysis: the shakings that agree with a survey, in two measures."""

from typing import TYPE_CHECKING

import numpy as np

from rocksteady.model.checks.arguments import checked
from rocksteady.results.numbers import number
from rocksteady.risk.back_analysis.back_analysis import BackAnalysis
from rocksteady.show.style.escaping import literal
from rocksteady.show.style.layout import axes_or_new, plain_ticks
from rocksteady.show.style.legends import LegendPlace, draw_legend, place_of
from rocksteady.show.style.tokens import DOUBT, inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

INNER = 0.5
"""Opacity of the darker part of the region."""
PLAIN = 1e-3
"""Weight of a record below which its line is faint alone."""


@checked
def plot_back_analysis(
    analysis: BackAnalysis, ax: "Axes | None" = None, *, legend: LegendPlace | None = None
) -> "Axes":
    """Draw the shakings that agree with a survey, over its first two measures.

    The fill is the region, its darker part the smallest one with half of the posterior
    probability.  Each record is a faint line, as its ratio of the two measures is fixed; dots on it
    are the scales that agree, larger where they agree better.

    Parameters
    ----------
    analysis
        From `rocksteady.back_analyse`.
    ax
        Axes to draw on; default: axes of a new figure.
    legend
        "inside" the axes, to their "right", "below" them, the default, or "none".

    Returns
    -------
    matplotlib.axes.Axes
        The axes: the two measures, both logarithmic.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import back_analyse
    >>> from rocksteady.calibration import ObjectPrior, ScanOptions, Survey
    >>> from rocksteady.motions import make_synthetic_suite
    >>> blocks = [
    ...     ObjectPrior(name=f"block {k}", width_m=0.1 + 0.1 * k, height_m=0.8) for k in range(3)
    ... ]
    >>> survey = Survey(objects=blocks, fell=[True, False, False])
    >>> analysis = back_analyse(
    ...     survey, make_synthetic_suite(4), scan=ScanOptions(levels=6, draws=2)
    ... )
    >>> axes = plot_back_analysis(analysis, Figure().add_subplot())
    >>> axes.get_xlabel(), axes.get_ylabel()
    ('PGA [g]', 'PGV [m/s]')
    """
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    axes = axes_or_new(ax)
    inks, place = inks_of(axes), place_of(axes, legend, "below")
    first = analysis.first_values
    across = np.broadcast_to(first[:, np.newaxis], analysis.density.shape)
    up = first[:, np.newaxis] * analysis.ratios
    axes.set(xscale="log", yscale="log")
    lines = first[:, np.newaxis] * (analysis.values_at_one[:, 1] / analysis.values_at_one[:, 0])
    axes.plot(first, lines, color=inks.edge, lw=0.5, alpha=0.55, zorder=1.0)
    top = float(analysis.density.max())
    inner = analysis.inner_threshold
    edges = sorted({min(analysis.threshold, 0.999 * top), min(inner, 0.9995 * top)})
    filled = axes.contourf(
        across,
        up,
        analysis.density,
        levels=[*edges, 1.001 * top],
        colors=[(inks.base, DOUBT), (inks.base, INNER)][-len(edges) :],
        zorder=0.9,
    )
    axes.contour(across, up, analysis.density, levels=edges[:1], colors=[inks.base], linewidths=1.2)
    filled.set_linewidth(0.0)
    # Dots at the middles of the scales: all of one record weigh as much as the record.
    step = max(1, len(first) // 40)
    parts = analysis.weights[:, ::step]
    shown = parts > PLAIN * parts.max()
    rows, columns = np.nonzero(shown)
    axes.scatter(
        first[::step][columns],
        lines[::step][columns, rows],
        s=14.0 * parts[shown] / parts.max(),
        color=inks.quiet,
        lw=0.0,
        zorder=2.5,
    )
    certain = analysis.bound == "interval"
    (middle,) = axes.plot(
        analysis.medians[:1],
        analysis.medians[1:2],
        ls="none",
        marker="D",
        ms=6.5,
        mfc=inks.paper,
        mec=inks.ink,
        mew=1.8,
        zorder=3.0,
        label="medians",
    )
    corner = analysis.region.nonzero()
    margin = 1.6
    axes.set(
        xlim=(
            max(float(first[0]), float(across[corner].min()) / margin),
            min(float(first[-1]), float(across[corner].max()) * margin),
        ),
        ylim=(float(up[corner].min()) / margin, float(up[corner].max()) * margin),
        xlabel=literal(str(analysis.measures[0])),
        ylabel=literal(str(analysis.measures[1])),
        title=f"{sum(analysis.survey.fell)} of {len(analysis.survey)} fell",
    )
    plain_ticks(axes)
    percent = number(100.0 * analysis.confidence)
    handles = [
        Patch(
            facecolor=(inks.base, DOUBT),
            lw=0.0,
            label=f"region of {percent} %" if certain else "chance above 0.1",
        ),
        Patch(
            facecolor=(inks.base, INNER),
            lw=0.0,
            label="half of the weight" if certain else "chance above 0.5",
        ),
        *([middle] if certain else []),
        Line2D([], [], color=inks.edge, lw=0.8, label="a record at all scales"),
        Line2D([], [], ls="none", marker="o", ms=4.0, color=inks.quiet, label="scales that agree"),
    ]
    draw_legend(axes, place, handles=handles, gap=44.0)
    return axes
