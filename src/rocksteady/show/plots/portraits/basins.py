"""Plots of basins of attraction and of their erosion."""

from collections import Counter
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats
from rocksteady.dynamics.basins.basins import Basins
from rocksteady.dynamics.basins.erosion import Erosion, IntegrityDrop
from rocksteady.dynamics.basins.fate_basins import FateBasins
from rocksteady.dynamics.basins.labels import BasinAttractor
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import index_value
from rocksteady.show.plots.map_classes import FILLS, share_text
from rocksteady.show.style import palette
from rocksteady.show.style.layout import axes_or_new, emptiest_corner, extent, spaced_by_ratio
from rocksteady.show.style.legends import LegendPlace, draw_legend, place_of
from rocksteady.show.style.line_colours import inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes


WORDS = {"integrity_factor": "integrity factor", "global_integrity": "global integrity measure"}


@checked
def plot_basins(
    basins: Basins, ax: "Axes | None" = None, *, legend: LegendPlace | None = None
) -> "Axes":
    """Draw the basins of attraction over the window, and the attractors at that phase.

    Each state of the window has the fill of the attractor to which it goes: dark where the block
    overturns, and one hue per kind of attractor.  Several of one kind differ in lightness and in
    their marks, which stand where the attractor is at the phase of the initial states; one that
    repeats itself after n forcing periods has n of them.  The legend has the shares.

    Parameters
    ----------
    basins
        From `rocksteady.compute_basins`.
    ax
        Axes to draw on; default: axes of a new figure.
    legend
        "inside" the axes, to their "right", "below" them or "none"; by default to their
        right, or below narrow ones.

    Returns
    -------
    matplotlib.axes.Axes
        The axes: u = theta/alpha and d(theta/alpha)/d(pt).

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import DimensionlessBlock, Harmonic, compute_basins
    >>> shaking = Harmonic(amplitude=2.0, frequency_ratio=1.9)
    >>> axes = plot_basins(
    ...     compute_basins(DimensionlessBlock(restitution=0.8), shaking), Figure().add_subplot()
    ... )
    >>> [text.get_text() for text in axes.get_legend().get_texts()]
    ['overturned  92.8 %', 'unsymmetric-1a  3.4 %', 'unsymmetric-1b  3.8 %']
    """
    from matplotlib.lines import Line2D

    axes = axes_or_new(ax)
    fills = fills_of(basins.attractors)
    window = draw_window(axes, basins, basins.label, fills)
    handles, marked = [], 0
    parts = zip(basins.attractors, fills, basins.stroboscopic, basins.fractions(), strict=True)
    for attractor, fill, points, fraction in parts:
        mark = "none"
        if len(points):
            mark = palette.MARKS[marked % len(palette.MARKS)]
            marked += 1
            # A white rim around a dark one is seen on every fill.
            for colour, rim in (("white", 2.4), (palette.INK, 1.0)):
                axes.plot(
                    *points.T, mark, ls="none", ms=5.5, mfc=fill, mec=colour, mew=rim, zorder=4.0
                )
        handles.append(
            (
                Line2D(
                    [], [], ls="none", marker="s", ms=10.0, mfc=fill, mec=palette.FAINT, mew=0.6
                ),
                Line2D([], [], ls="none", marker=mark, ms=4.5, mfc=fill, mec=palette.INK, mew=0.9),
                f"{attractor.name}  {share_text(fraction.share)}",
            )
        )
    axes.set(xlim=window[:2], ylim=window[2:])
    draw_legend(
        axes,
        place_of(axes, legend, "right"),
        handles=[(swatch, mark) for swatch, mark, _ in handles],
        labels=[text for _, _, text in handles],
        handlelength=1.2,
        handletextpad=0.6,
        labelspacing=0.7,
    )
    return axes


@checked
def plot_erosion(
    erosion: Erosion,
    ax: "Axes | None" = None,
    *,
    drops: Sequence[IntegrityDrop] = (),
    legend: LegendPlace | None = None,
) -> "Axes":
    """Draw both integrity measures against amplitude, with the heteroclinic threshold.

    The nonlinear model has no closed form of the threshold, so that its picture has none.  The
    amplitude axis is logarithmic where the amplitudes are spaced by ratio.

    Parameters
    ----------
    erosion
        From `rocksteady.compute_erosion`.
    ax
        Axes to draw on; default: axes of a new figure.
    drops
        From `Erosion.drop`; each is marked on its curve, which goes through the two amplitudes
        between which it lies.
    legend
        "inside" the axes, to their "right", "below" them or "none"; by default inside, or
        below narrow ones.

    Returns
    -------
    matplotlib.axes.Axes
        The axes: A = a_max/(alpha g), and integrity, which is 1 on a still base.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import DimensionlessBlock, Harmonic, compute_erosion
    >>> motion = Harmonic(amplitude=1.0, frequency_ratio=2.0)
    >>> erosion = compute_erosion(DimensionlessBlock(restitution=0.9), motion, [0.0, 0.3, 0.6, 0.9])
    >>> axes = plot_erosion(erosion, Figure().add_subplot(), drops=[erosion.drop(tolerance=0.1)])
    >>> [text.get_text() for text in axes.get_legend().get_texts()][:2]
    ['integrity factor', 'global integrity measure']
    """
    axes = axes_or_new(ax)
    a = erosion.amplitude
    inks, place = inks_of(axes), place_of(axes, legend, "inside", width=225.0)
    spread = spaced_by_ratio(a)
    colours: dict[str, str] = {}
    abscissas, curves = [], []
    for series, (name, label) in enumerate(WORDS.items()):
        known = dict(zip(a.tolist(), erosion.measure(name).tolist(), strict=True))
        for drop in drops:
            if drop.measure == name:  # a search has computed more of the curve
                ends = {drop.low: drop.above, drop.high: drop.below}
                known |= {at: value for at, value in ends.items() if at > 0.0 or not spread}
        x, values = np.array(sorted(known.items())).T
        colours[name] = inks.lines[series]
        abscissas.append(x)
        curves.append(values)
        axes.plot(
            x,
            values,
            color=inks.lines[series],
            ls=palette.DASHES[series],
            marker="os"[series] if len(a) <= 60 else "none",
            ms=3.0,
            label=label,
        )
    where = erosion.heteroclinic
    if where is not None:
        seen = where <= a[-1]
        axes.axvline(
            where,
            color=inks.ink,
            lw=1.0,
            ls=palette.DASHES[4],
            label=f"heteroclinic tangency, A = {where:.4g}" + ("" if seen else " (beyond)"),
        )
    for drop in drops:
        part = (drop.above - drop.level) / (drop.above - drop.below)
        axes.plot(
            drop.low + part * (drop.high - drop.low),
            drop.level,
            "v",
            ms=6.5,
            color=colours[drop.measure],
            mec=inks.paper,
            mew=0.8,
            ls="none",
            zorder=4.0,
            label=f"{WORDS[drop.measure]} falls below {drop.level:g} at A = {drop.high:.4g}",
        )
    if spread:
        axes.set_xscale("log")
    top = max(1.0, float(erosion.global_integrity.max()), float(erosion.integrity_factor.max()))
    axes.set(
        xlabel=palette.LABELS["amplitude"],
        ylabel=palette.LABELS["integrity"],
        xlim=(float(a[0]) if spread else 0.0, float(a[-1])),
        ylim=(0.0, 1.05 * top),
    )
    points = np.concatenate(abscissas), np.concatenate(curves)
    size = extent(axes, width=225.0, height=12.0 * (3 + len(drops)) + 10.0)
    draw_legend(axes, place, corner=emptiest_corner(axes, points, size))
    return axes


@checked
def plot_safe_basin(erosion: Erosion, index: int, ax: "Axes | None" = None) -> "Axes":
    """Draw the safe basin at one amplitude: light where the block stands.

    Parameters
    ----------
    erosion
        From `rocksteady.compute_erosion`.
    index
        Index of the amplitude.
    ax
        Axes to draw on; default: axes of a new figure.

    Returns
    -------
    matplotlib.axes.Axes
        The axes: u = theta/alpha and d(theta/alpha)/d(pt).
    """
    index = index_value(index, len(erosion.amplitude), "amplitude")
    axes = axes_or_new(ax)
    draw_window(axes, erosion, erosion.safe[index], [palette.OVERTURNED, palette.SYMMETRIC])
    axes.set_title(f"A = {erosion.amplitude[index]:.4g}")
    return axes


def draw_window(
    axes: "Axes", states: Basins | Erosion | FateBasins, codes: NDArray[Any], fills: Sequence[str]
) -> tuple[float, float, float, float]:
    """Fill each state of a window of angles and velocities by its code; return the window's ends.

    Parameters
    ----------
    axes
        Axes to draw on, which get their labels.
    states
        Angles and velocities of the window.
    codes
        Number of the fill of each state, shape (velocities, angles).
    fills
        Colours by number.
    """
    from matplotlib.colors import ListedColormap

    window = (*_ends(states.angle), *_ends(states.velocity))
    axes.imshow(
        codes,
        cmap=ListedColormap(fills),
        vmin=-0.5,
        vmax=len(fills) - 0.5,
        extent=window,
        origin="lower",
        aspect="auto",
        interpolation="nearest",
    )
    axes.grid(visible=False)
    axes.set(xlabel=palette.LABELS["angle"], ylabel=palette.LABELS["velocity"])
    return window


def fills_of(attractors: Sequence[BasinAttractor]) -> list[str]:
    """Return a fill for each attractor, no two alike as long as the tints last."""
    used: Counter[str] = Counter()
    fills = []
    for attractor in attractors:
        hue = FILLS[attractor.kind]
        if attractor.orbit is not None and attractor.orbit.period > 1:
            hue = palette.SUBHARMONIC
        fills.append(palette.tinted(hue, palette.TINTS[used[hue] % len(palette.TINTS)]))
        used[hue] += 1
    return fills


def _ends(axis: Floats) -> tuple[float, float]:
    """Return the edges of the outermost cells around the points of an axis."""
    half = 0.5 * float(axis[-1] - axis[0]) / (len(axis) - 1)
    return float(axis[0]) - half, float(axis[-1]) + half
