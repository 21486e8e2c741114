"""Plots of the scales of records, and of the kicks, that overturn a block."""

import math
from typing import TYPE_CHECKING

import numpy as np

from rocksteady.dynamics.overturning.kicks import SIGNS, FatalKicks
from rocksteady.errors import InputError, Words
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.arguments import checked
from rocksteady.seismic.spectra.overturning_scales import OverturningScales
from rocksteady.show.plots._other_way import draw_other_way
from rocksteady.show.style import palette
from rocksteady.show.style.areas import LEAST_RIMMED, area_style, rim_style, swatch
from rocksteady.show.style.layout import axes_or_new, plain_ticks
from rocksteady.show.style.legends import LegendPlace, draw_legend, place_of, size_of
from rocksteady.show.style.limits import draw_limit
from rocksteady.show.style.tokens import inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

SIDES = (
    (1, "falls to the positive side", "falls"),
    (-1, "falls to the negative side", "falls_negative"),
)
"""Words and pattern of each side, as the legend has them."""
LONGEST_NAME = 18
BAR = 0.7
LEVEL = 1.2
"""Place of what falls above the row and what is not listed."""


@checked
def plot_overturning_scales(
    scales: OverturningScales, ax: "Axes | None" = None, *, legend: LegendPlace | None = None
) -> "Axes":
    """Draw the scales at which a block falls under records, a bar for each record.

    Where the sides of the block differ, a line marks the least scale of the reversed record.

    Parameters
    ----------
    scales
        From `rocksteady.find_overturning_scales`.
    ax
        Axes to draw on; default: axes of a new figure.
    legend
        "inside" the axes, to their "right", "below" them or "none"; below by default.

    Returns
    -------
    matplotlib.axes.Axes
        The axes: the scale, logarithmic, and the records from above.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import Block, Record, find_overturning_scales
    >>> shock = Record(acceleration_m_s2=[0.0, 4.0, -4.0, 0.0], dt_s=0.3, name="shock")
    >>> block = Block.rectangle(width=0.4, height=1.6)
    >>> scales = find_overturning_scales(block, shock, within=(0.5, 2.0))
    >>> axes = plot_overturning_scales(scales, Figure().add_subplot())
    >>> [label.get_text() for label in axes.get_yticklabels()]
    ['shock']
    """
    axes = axes_or_new(ax)
    inks, place = inks_of(axes), place_of(axes, legend, "below")
    low, high = scales.within
    per_factor = size_of(axes)[0] / math.log(high / low)

    handles = []
    for row, top in enumerate(scales.top.tolist()):
        axes.barh(row, top - low, BAR, left=low, facecolor=inks.paper, edgecolor=inks.edge, lw=0.6)
        parts = [(begin, end - begin) for begin, end in scales.unlisted(row)]
        axes.broken_barh(parts, (row - 0.5 * BAR, BAR), **area_style(inks, "undecided"))
    for side, words, pattern in SIDES:
        drawn = False
        for row in range(len(scales.names)):
            parts = [(w.low, w.high - w.low) for w in scales.at(row) if w.side == side]
            if parts:
                drawn = True
                place_of_row = (row - 0.5 * BAR, BAR)
                style = area_style(inks, "falls", pattern)
                axes.broken_barh(parts, place_of_row, **style, zorder=LEVEL)
                for wide in (True, False):
                    rimmed = [
                        (begin, width)
                        for begin, width in parts
                        if (per_factor * math.log1p(width / begin) > LEAST_RIMMED) == wide
                    ]
                    rim = rim_style(inks, LEVEL, wide=wide)
                    axes.broken_barh(rimmed, place_of_row, facecolor="none", **rim)
        if drawn:
            handles.append(swatch(inks, "falls", words, pattern))
    if scales.left_out.any():
        handles.append(swatch(inks, "undecided", "narrower windows, not listed"))
    axes.set_xscale("log")
    axes.set(
        xlabel="scale of the record",
        xlim=(low, high),
        ylim=(len(scales.names) - 0.5, -0.5),
        yticks=range(len(scales.names)),
        yticklabels=[palette.shortened(name, LONGEST_NAME) for name in scales.names],
    )
    across = np.add.outer(np.arange(len(scales.names)), [-0.5 * BAR, 0.5 * BAR, math.nan])
    marks = np.repeat(scales.opposite, 3)
    line_drawn = draw_other_way(axes, scales, marks, across.ravel())
    handles.append(swatch(inks, "paper", "stands" + ", left of the line" * line_drawn))
    if low < 1.0 < high:
        axes.axvline(1.0, color=inks.paper, lw=2.4, zorder=2.9)  # seen on what falls
        draw_limit(axes, 1.0, "as recorded")
    axes.grid(visible=False)
    plain_ticks(axes)
    draw_legend(axes, place, handles=handles, handleheight=1.3)
    return axes


@checked
def plot_fatal_kicks(
    kicks: FatalKicks, ax: "Axes | None" = None, *, legend: LegendPlace | None = None
) -> "Axes":
    """Draw the least kick that makes a block fall, over its time.

    The nearer a curve comes to 0, the nearer the block is to its fall at that moment.

    Parameters
    ----------
    kicks
        From `rocksteady.find_fatal_kicks`, at two moments or more.
    ax
        Axes to draw on; default: axes of a new figure.
    legend
        "inside" the axes, to their "right", "below" them or "none"; below by default.

    Returns
    -------
    matplotlib.axes.Axes
        The axes: time [s] and kick [m/s] of a block with sizes, else p t and alpha g/p.

    Raises
    ------
    InputError
        If there is one moment only.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import DimensionlessBlock, State, find_fatal_kicks
    >>> block, start = DimensionlessBlock(restitution=0.9), State(angle=0.5, velocity=0.0)
    >>> kicks = find_fatal_kicks(block, start=start, times_pt=[0.0, 0.5, 1.0])
    >>> axes = plot_fatal_kicks(kicks, Figure().add_subplot())
    >>> [line.get_label() for line in axes.get_lines()][:2]
    ['positive kick', 'negative kick']
    """
    if len(kicks.time_pt) < 2:
        raise InputError(
            "kicks", Words("has one moment"), "a curve has two or more", "give several times_pt"
        )
    axes = axes_or_new(ax)
    inks, place = inks_of(axes), place_of(axes, legend, "below")
    colours = inks.series("motion", len(SIGNS))
    sized = isinstance(kicks.block, Block)
    unit, rate = (kicks.unit_m_s, kicks.block.p) if isinstance(kicks.block, Block) else (1.0, 1.0)
    order = np.argsort(kicks.time_pt, kind="stable")
    coincide = np.allclose(np.abs(kicks.signed).T[0], np.abs(kicks.signed).T[1], equal_nan=True)
    for place_of_sign, sign in enumerate(SIGNS[:1] if coincide else SIGNS):
        axes.plot(
            kicks.time_pt[order] / rate,
            np.abs(kicks.signed[order, place_of_sign]) * unit,
            color=colours[place_of_sign],
            label="kick of either sign"
            if coincide
            else f"{'positive' if sign > 0 else 'negative'} kick",
        )
    axes.set(
        xlabel=palette.LABELS["seconds" if sized else "pivot_time"],
        ylabel="least fatal kick [m/s]" if sized else r"least fatal kick  [$\alpha g/p$]",
        xlim=(float(kicks.time_pt.min()) / rate, float(kicks.time_pt.max()) / rate),
        ylim=(0.0, None),
    )
    draw_legend(axes, place)
    return axes
