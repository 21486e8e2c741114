"""Plot of the shares of basins of attraction over a parameter."""

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.dynamics.basins.over.families import BasinFamily
from rocksteady.dynamics.basins.over.shares import BasinShares
from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import in_range
from rocksteady.outcomes import AttractorKind
from rocksteady.show.plots.portraits.basins import areas_of
from rocksteady.show.style.areas import pattern_ink, write_upon
from rocksteady.show.style.layout import axes_or_new, plain_ticks, spaced_by_ratio
from rocksteady.show.style.legends import LegendPlace, draw_legend, place_of, size_of, text_size
from rocksteady.show.style.scales import draw_far_axes, scale_of
from rocksteady.show.style.tokens import inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes


UPWARDS = (
    AttractorKind.REST,
    AttractorKind.SYMMETRIC,
    AttractorKind.UNSYMMETRIC,
    AttractorKind.APERIODIC,
    AttractorKind.UNDECIDED,
    AttractorKind.OVERTURNED,
)
"""Order of the bands; orbits stand in the order of their labels."""
PLACES = 241
"""Abscissas at which a label may stand."""
THIN = 0.5
"""Share of the axis [%] below which a band is only counted."""
LETTER, LINE = 0.62, 1.35
"""Width of a letter and height of a line, in parts of the size of the text."""


@checked
def plot_basin_shares(
    shares: BasinShares,
    ax: "Axes | None" = None,
    *,
    top: float = 1.0,
    legend: LegendPlace | None = None,
) -> "Axes":
    """Draw the shares of basins over a parameter as bands that add up to 100 %.

    Rest is at the bottom, then come orbits, and what falls is at the top; fills are those of
    `plots.basins`.  Between two values a band is drawn straight.  A band has its name where there
    is room for it, else in the legend.  Bands below 0.5 % of the axis everywhere are
    counted there.
    The axis is logarithmic where the values are spaced by ratio.

    Parameters
    ----------
    shares
        From `rocksteady.basins.compute_basin_shares`, of two values or more.
    ax
        Axes to draw on; default: axes of a new figure.
    top
        Upper end of the axis of shares, in (0, 1]; default 1.
    legend
        "inside" the axes, to their "right", "below" them or "none"; by default to their right, or
        below narrow ones.

    Returns
    -------
    matplotlib.axes.Axes
        The axes: the parameter, and the share of the window in per cent.

    Raises
    ------
    InputError
        If there is one value alone, or `top` is outside its range.

    Examples
    --------
    >>> import numpy as np
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import DimensionlessBlock, Harmonic
    >>> from rocksteady.basins import SamplingOptions, compute_basin_shares
    >>> axis = np.linspace(-1.0, 1.0, 20)
    >>> shares = compute_basin_shares(
    ...     DimensionlessBlock(restitution=0.9),
    ...     Harmonic(amplitude=1.0, frequency_ratio=4.0),
    ...     "amplitude",
    ...     [0.5, 0.8, 1.1],
    ...     sampling=SamplingOptions(angles=axis, velocities=axis),
    ... )
    >>> axes = plot_basin_shares(shares, Figure().add_subplot())
    >>> sorted(text.get_text() for text in axes.texts)[:2]
    ['comes to rest', 'falls']
    """
    from matplotlib.patches import Patch

    if len(shares.values) < 2:
        hint = "give more values to compute_basin_shares"
        raise InputError("shares", shares, "a picture needs two values or more", hint)
    upper = in_range("top", top, 0.0, 1.0, "(]", hint="give 1, or 0.3 to enlarge small shares")
    axes = axes_or_new(ax)
    inks = inks_of(axes)
    order = np.argsort(shares.values)
    scale = scale_of(shares.parameter, shares.block, at_start=True)
    values = shares.values[order] * scale.factor
    families = sorted(shares.families, key=_place)
    # The largest basins have steps of their own, those of a kind as long as these last.
    largest = sorted(shares.families, key=lambda family: -float(shares.share[family.label].sum()))
    labels_by_size = [family.label for family in largest]
    typical = [replace(family.typical, name=family.name) for family in largest]
    by_label = dict(zip(labels_by_size, areas_of(typical, inks), strict=True))
    areas = [by_label[family.label] for family in families]
    edges = np.vstack(
        [
            np.zeros(len(values)),
            np.cumsum([100.0 * shares.share[family.label][order] for family in families], axis=0),
        ]
    )
    styles: list[dict[str, Any]] = [
        {"fc": area.fill, "ec": pattern_ink(area.fill), "hatch": area.hatch or None}
        for area in areas
    ]
    for low, high, style in zip(edges[:-1], edges[1:], styles, strict=True):
        axes.fill_between(values, low, high, lw=0.0, zorder=1.0, **style)
    # Lines keep a light band from the paper and two dark ones apart.
    axes.plot(values, edges.T, color=inks.paper, lw=0.5, zorder=1.5)
    logarithmic = spaced_by_ratio(values)
    if logarithmic:
        axes.set_xscale("log")
        plain_ticks(axes)
    axes.set(
        xlabel=scale.label,
        ylabel="share of the window [%]" + (", enlarged" if upper < 1.0 else ""),
        xlim=(float(values[0]), float(values[-1])),
        ylim=(0.0, 100.0 * upper),
    )
    axes.grid(visible=False)
    draw_far_axes(axes, scale)
    along = np.log(values) if logarithmic else values
    handles: list[Patch] = []
    labels: list[str] = []
    thin = 0
    for area, style, low, high in zip(areas, styles, edges[:-1], edges[1:], strict=True):
        if float((np.minimum(high, 100.0 * upper) - low).max()) < THIN * upper:
            thin += bool(float(low.min()) < 100.0 * upper)
        elif not _named(axes, area.word, area.fill, (along, low, high)):
            handles.append(Patch(lw=0.6, **style))
            labels.append(area.word)
    if thin:
        handles.append(Patch(fc="none", ec="none"))
        labels.append(f"and {thin} below {THIN * upper:.2g} %")
    draw_legend(
        axes,
        place_of(axes, legend, "right"),
        handles=handles,
        labels=labels,
        handlelength=1.5,
        handleheight=1.3,
        handletextpad=0.6,
    )
    return axes


def _place(family: BasinFamily) -> tuple[int, int]:
    """Return where the band of a family stands."""
    kind = family.typical.kind
    orbits = UPWARDS.index(AttractorKind.SYMMETRIC)
    return (orbits if family.typical.orbit is not None else UPWARDS.index(kind)), family.label


def _named(axes: "Axes", name: str, fill: str, band: tuple[Floats, Floats, Floats]) -> bool:
    """Write a name into its band where that is widest; return whether there is room for it."""
    along, low, high = band
    wide, tall = size_of(axes)
    size = text_size(axes, 8.0)
    half = 0.5 * LETTER * size * (len(name) + 1) / wide
    if half >= 0.5:
        return False
    reach = (along - along[0]) / (along[-1] - along[0])
    top = axes.get_ylim()[1]
    fine = np.union1d(np.linspace(0.0, 1.0, PLACES), reach)
    floor, ceiling = (np.minimum(np.interp(fine, reach, edge), top) for edge in (low, high))
    rooms = []
    for middle in np.linspace(half, 1.0 - half, PLACES):
        under = (fine >= middle - half) & (fine <= middle + half)
        below, above = float(floor[under].max()), float(ceiling[under].min())
        rooms.append((above - below, float(middle), 0.5 * (below + above)))
    line = LINE * size / tall * top
    best = max(rooms)[0]
    if best < line:
        return False
    # Where there is room enough, near the middle.
    enough = [room for room in rooms if room[0] >= min(best, 2.5 * line)]
    where = min(enough, key=lambda room: abs(room[1] - 0.5))
    write_upon(axes, name, (where[1], where[2] / top), fill, size, zorder=3.0)
    return True
