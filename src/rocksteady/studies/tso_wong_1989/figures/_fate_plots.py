"""Plots of fates: the motion after settling, and fates by distance from an orbit."""

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from rocksteady.show.style import palette
from rocksteady.show.style.areas import area_style, swatch
from rocksteady.show.style.axes import runs
from rocksteady.show.style.tokens import inks_of
from rocksteady.studies.tso_wong_1989.figures.cases import KICK, KICKS, SIDES
from rocksteady.studies.tso_wong_1989.figures.fates import Fate, Kind

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LOOKS = {
    Kind.REST: ("comes to rest", "rest"),
    Kind.SYMMETRIC: ("symmetric", "symmetric"),
    Kind.UNSYMMETRIC: ("unsymmetric", "unsymmetric"),
    Kind.SUBHARMONIC: ("subharmonic", "subharmonic"),
    Kind.OVERTURNED: ("falls", "falls"),
    Kind.UNSETTLED: ("undecided", "undecided"),
}
"""Words and role of the fill of each fate."""
NO_RUN = "not_computed"
"""Pattern of the gap in a strip of fates: distances at which no run was started."""


def plot_settled(fate: Fate, axes: "Axes") -> None:
    """Draw the last period of the motion that a run has settled to, with its extrema."""
    axes.tick_params(labelleft=False)
    if fate.kind is Kind.OVERTURNED:
        axes.axis("off")
        words = f"fell after\n{fate.overturned_after:.2f} periods"
        axes.text(0.5, 0.5, words, transform=axes.transAxes, ha="center", va="center")
        return
    length = max(fate.period, 1)
    inks = inks_of(axes)
    axes.axhline(0.0, color=inks.edge, lw=0.6)
    if fate.orbit is not None:
        run = fate.orbit.trajectory()
        times = run.times(200)
        periods = times * (fate.orbit.motion.frequency_ratio / (2.0 * math.pi))
        axes.plot(periods, run(times).angle, color=inks.motion)
    else:
        axes.plot([0.0, length], [0.0, 0.0], color=inks.motion)
    axes.set(
        xlabel=palette.LABELS["periods_short"],
        xlim=(0.0, length),
        title="settled" if fate.period else LOOKS[fate.kind][0],
    )
    if fate.period:
        words = f"max {fate.highest:.4f}\nmin {fate.lowest:.4f}".replace("-", "−")
        axes.text(0.97, 0.98, words, transform=axes.transAxes, ha="right", va="top", fontsize=7.0)


def plot_fates(fates: Mapping[int, Sequence[Fate]], axes: "Axes") -> None:
    """Draw a strip of fates over the distance from the orbit, logarithmic on either side of it.

    Parameters
    ----------
    fates
        Those over `KICKS`, for each side.
    axes
        To draw on.
    """
    inks = inks_of(axes)
    decades = math.log10(KICKS[-1] / KICKS[0])
    gap = 0.5
    half = 0.5 * decades / (len(KICKS) - 1)
    for side in SIDES:
        cells = [LOOKS[fate.kind][1] for fate in fates[side]][::side]
        low, high = sorted((side * (gap - half), side * (gap + decades + half)))
        edges = np.linspace(low, high, len(cells) + 1)
        for role in dict.fromkeys(cells):
            chosen = np.array([cell == role for cell in cells])
            axes.broken_barh(runs(chosen, edges), (0.0, 1.0), **area_style(inks, role))
        place = side * (gap + math.log10(KICK / KICKS[0]))
        axes.plot(place, 1.0, "v", ms=6, color=inks.ink, mec=inks.paper, mew=0.6, clip_on=False)
    # Rest is hardly darker than the paper: what is no answer has a pattern.
    axes.axvspan(half - gap, gap - half, **area_style(inks, "paper", NO_RUN))
    powers = range(round(math.log10(KICKS[0])), round(math.log10(KICKS[-1])) + 1)
    places = [gap + power - powers[0] for power in powers]
    axes.set(
        xlim=(-gap - decades - half, gap + decades + half),
        ylim=(0.0, 1.0),
        yticks=[],
        xlabel=palette.LABELS["kick"],
    )
    signed = [
        (side * place, power) for place, power in zip(places, powers, strict=True) for side in SIDES
    ]
    axes.set_xticks(
        [place for place, _ in signed],
        [f"${'-' if place < 0.0 else ''}10^{{{power}}}$" for place, power in signed],
    )
    for spine in axes.spines.values():
        spine.set_visible(True)
    axes.grid(visible=False)
    axes.set_title("fates by distance (triangles: drawn above)", fontsize=8.0)


def plot_key(fates: Mapping[int, Sequence[Fate]], axes: "Axes") -> None:
    """Draw the legend of a strip of fates on axes of its own."""
    axes.axis("off")
    inks = inks_of(axes)
    kinds = dict.fromkeys(fate.kind for side in SIDES for fate in fates[side])
    looks = [LOOKS[kind] for kind in kinds]
    patches = [swatch(inks, role, words) for words, role in looks]
    patches.append(swatch(inks, "paper", "not computed", NO_RUN))
    axes.legend(
        handles=patches,
        loc="center left",
        bbox_to_anchor=(-0.15, 0.5),
        handlelength=1.2,
        handleheight=1.2,
    )
