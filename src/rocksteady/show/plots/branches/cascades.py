"""Plot of a cascade of period doublings: how the distances between them shrink."""

import math
from typing import TYPE_CHECKING

import numpy as np

from rocksteady.dynamics.continuation.cascade import Cascade
from rocksteady.dynamics.continuation.chains.point_types import PointType
from rocksteady.dynamics.parameters import SYMBOLS
from rocksteady.errors import InputError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.show.plots.branches import curve_labels
from rocksteady.show.plots.branches._branch_lines import MARKS
from rocksteady.show.style.layout import axes_or_new
from rocksteady.show.style.legends import (
    LETTER,
    LegendPlace,
    draw_legend,
    place_of,
    size_of,
    text_size,
)
from rocksteady.show.style.scales import Scale, draw_far_axes, scale_of
from rocksteady.show.style.tokens import DASHED, inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

FEIGENBAUM = 4.669201609102990
"""Limit of the ratios of distances between period doublings."""
RATIO = 7
"""Letters for which a ratio has room."""


@checked
def plot_cascade(
    cascade: Cascade, ax: "Axes | None" = None, *, legend: LegendPlace | None = None
) -> "Axes":
    """Draw the distances between period doublings, with the ratio of each to the next.

    The distances in the parameter stand on a logarithmic axis over the periods that double; a
    dashed line through the last has the slope to which a cascade tends, Feigenbaum's 4.6692.  For a
    block of known size they are in g or Hz, with the dimensionless scale on the far side.

    Parameters
    ----------
    cascade
        From `rocksteady.branches.find_cascade`, or of a diagram; of two doublings or more.
    ax
        Axes to draw on; default: axes of a new figure.
    legend
        Place of the dashed line's name where there is no room along it: "inside" the axes
        (default), to their "right", "below" them or "none".

    Returns
    -------
    matplotlib.axes.Axes
        The axes.

    Raises
    ------
    InputError
        If the cascade has one doubling, and no distance.

    References
    ----------
    M. J. Feigenbaum, Quantitative universality for a class of nonlinear transformations, Journal of
    Statistical Physics 19, 25-52 (1978).

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import DimensionlessBlock, Harmonic, find_orbits
    >>> from rocksteady.branches import find_cascade
    >>> motion = Harmonic(amplitude=2.0, frequency_ratio=2.0)
    >>> origin = find_orbits(DimensionlessBlock(restitution=0.8), motion, max_period=1)[0]
    >>> cascade = find_cascade(origin, "frequency_ratio", (1.7, 2.0), direction=-1, doublings=3)
    >>> axes = plot_cascade(cascade, Figure().add_subplot())
    >>> print(axes.get_yscale(), [text.get_text() for text in axes.texts])
    log ['6.107', 'ratio 4.6692 (Feigenbaum)']
    """
    sizes = np.abs(cascade.distances)
    if not sizes.size:
        raise InputError(
            "cascade",
            Words("has one doubling"),
            "a picture of distances needs two or more",
            "look for more with rs.branches.find_cascade(..., doublings=6)",
        )
    axes = axes_or_new(ax)
    inks, places = inks_of(axes), np.arange(len(sizes))
    symbol = SYMBOLS[cascade.parameter]
    scale = scale_of(cascade.parameter, cascade.block)
    sizes = scale.factor * sizes
    expected = sizes[-1] * FEIGENBAUM ** (places[-1] - places)
    name = "ratio 4.6692 (Feigenbaum)"
    axes.plot(places, expected, ls=DASHED, lw=1.0, color=inks.limit, label=name, zorder=2.0)
    axes.plot(
        places,
        sizes,
        marker=MARKS[PointType.PERIOD_DOUBLING],
        ms=4.5,
        mfc=inks.paper,
        mec=inks.ink,
        mew=0.8,
        lw=1.2,
        color=inks.subharmonic_line,
        zorder=3.0,
    )
    axes.set_yscale("log")
    margin = max(1.2, (float(sizes.max()) / float(sizes.min())) ** 0.05)
    axes.set_xlim(-0.3, len(sizes) - 0.5)
    axes.set_ylim(float(sizes.min()) / margin, float(sizes.max()) * margin)
    size = text_size(axes, 8.0)
    periods = [point.period for point in cascade.points]
    names = [f"{period} → {2 * period}" for period in periods[:-1]]
    each = size_of(axes)[0] / len(sizes)  # room for a name
    ratios = []
    for place in range(0, len(sizes) - 1, math.ceil(RATIO * LETTER * size / each)):
        ratio = np.atleast_1d(cascade.ratios)[place]
        ratios.append((place + 0.5, float(np.sqrt(sizes[place] * sizes[place + 1]))))
        axes.annotate(
            f"{ratio:.3f}",
            ratios[-1],
            (5.0, 4.0),
            textcoords="offset points",
            fontsize=size,
            color=inks.quiet,
        )
    step = math.ceil(LETTER * size * (max(map(len, names)) + 1) / each)
    axes.set_xticks(places[::step], names[::step])
    words = "distance to the next doubling"
    far = f"{words}, |Δ{symbol}|"
    unit = scale.label.partition("[")[2]
    axes.set(
        xlabel="period doubling [forcing periods]",
        ylabel=f"{words} [{unit}" if scale.far else far,
    )
    draw_far_axes(axes, up=Scale(scale.factor, axes.get_ylabel(), far if scale.far else ""))
    lines = [np.column_stack([places, each]) for each in (expected, sizes)]
    labels = curve_labels.Words(axes, lines)
    if ratios:
        labels.taken.append((labels.there(np.array(ratios)) + np.array([17.0, 8.0]), 10.0))
    labels.take(lines[1].tolist(), 4.0)
    if not labels.along([name, ""], [inks.ink, inks.ink], aside=True):
        draw_legend(axes, place_of(axes, legend, "inside"), corner="lower left")
    return axes
