"""Plots of basins of attraction and of their erosion."""

from collections import Counter
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from rocksteady.dynamics.basins.basins import Basins
from rocksteady.dynamics.basins.erosion import Erosion, IntegrityDrop
from rocksteady.dynamics.basins.labels import BasinAttractor
from rocksteady.dynamics.maps.cell_classes import MEANINGS
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import index_value
from rocksteady.outcomes import AttractorKind
from rocksteady.show.plots.map_classes import LOOKS, share_text
from rocksteady.show.plots.portraits._window import draw_window
from rocksteady.show.style import palette
from rocksteady.show.style.areas import Area, pattern_ink, word_ink
from rocksteady.show.style.layout import axes_or_new, emptiest_corner, extent, spaced_by_ratio
from rocksteady.show.style.legends import LegendPlace, draw_legend, place_of
from rocksteady.show.style.scales import Scale, draw_far_axes, scale_of
from rocksteady.show.style.tokens import DASHED, HATCHES, MARKS, Inks, inks_of, mixed

if TYPE_CHECKING:
    from matplotlib.axes import Axes


STEPS = (0.0, -0.35, 0.6, -0.6, 0.35, 0.8)
"""Of a fill, where several attractors share it: parts of white, or of black below 0.  Each step is
one of lightness, which is seen in grey and by the colour-blind too.  Hatching would drown a fractal
basin, which is a cell wide in places."""
WORDS = {"integrity_factor": "integrity factor", "global_integrity": "global integrity measure"}


@checked
def plot_basins(
    basins: Basins, ax: "Axes | None" = None, *, legend: LegendPlace | None = None
) -> "Axes":
    """Draw the basins of attraction over the window, and the attractors at that phase.

    Each state of the window has the fill of the attractor to which it goes: dark and hatched where
    the block falls, and one hue per kind of attractor.  Several of one kind differ in lightness and
    in their marks, which stand where the attractor is at the phase of the initial states; one that
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
        The axes: tilt [degrees] and its velocity [degrees/s] of a block with sizes, else
        u = theta/alpha and d(theta/alpha)/d(pt).

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import DimensionlessBlock, Harmonic, compute_basins
    >>> shaking = Harmonic(amplitude=2.0, frequency_ratio=1.9)
    >>> axes = plot_basins(
    ...     compute_basins(DimensionlessBlock(restitution=0.8), shaking), Figure().add_subplot()
    ... )
    >>> [text.get_text() for text in axes.get_legend().get_texts()]
    ['falls  89.1 %', 'unsymmetric-1a  5.5 %', 'unsymmetric-1b  5.4 %']
    """
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    axes = axes_or_new(ax)
    inks = inks_of(axes)
    areas = areas_of(basins.attractors, inks)
    window = draw_window(axes, basins, basins.label, areas, basins.stroboscopic)
    handles, marked = [], 0
    parts = zip(areas, basins.stroboscopic, basins.fractions(), strict=True)
    for (fill, hatch, word), points, fraction in parts:
        mark = "none"
        if len(points):
            mark = MARKS[marked % len(MARKS)]
            marked += 1
            # A white rim around a dark one is seen on every fill.
            for colour, rim in ((inks.on_falls, 2.4), (inks.on_rocks, 1.0)):
                axes.plot(
                    *(points * window.factors).T,
                    mark,
                    ls="none",
                    ms=5.5,
                    mfc=fill,
                    mec=colour,
                    mew=rim,
                    zorder=6.0,
                )
        patch = Patch(fc=fill, ec=pattern_ink(fill), hatch=hatch or None, lw=0.6)
        dot = Line2D(
            [], [], ls="none", marker=mark, ms=4.5, mfc=fill, mec=word_ink(fill, inks), mew=0.9
        )
        handles.append(((patch, dot), f"{word}  {share_text(fraction.share)}"))
    axes.set(xlim=window.ends[:2], ylim=window.ends[2:])
    draw_legend(
        axes,
        place_of(axes, legend, "right"),
        handles=[handle for handle, _ in handles],
        labels=[text for _, text in handles],
        gap=window.gap,
        handlelength=1.5,
        handleheight=1.5,
        handletextpad=0.6,
        labelspacing=0.6,
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
        The axes: a_max [g] of a block with sizes, else A = a_max/(alpha g), and integrity, which is
        1 on a still base.

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
    scale = scale_of("amplitude", erosion.block)
    a = erosion.amplitude * scale.factor
    inks, place = inks_of(axes), place_of(axes, legend, "inside", width=225.0)
    spread = spaced_by_ratio(a)
    colours = dict(zip(WORDS, inks.series("motion", len(WORDS)), strict=True))
    abscissas, curves = [], []
    for series, (name, label) in enumerate(WORDS.items()):
        known = dict(zip(erosion.amplitude.tolist(), erosion.measure(name).tolist(), strict=True))
        for drop in drops:
            if drop.measure == name:  # a search has computed more of the curve
                ends = {drop.low: drop.above, drop.high: drop.below}
                known |= {at: value for at, value in ends.items() if at > 0.0 or not spread}
        x, values = np.array(sorted(known.items())).T
        x = x * scale.factor
        abscissas.append(x)
        curves.append(values)
        axes.plot(
            x,
            values,
            color=colours[name],
            marker="os"[series] if len(a) <= 60 else "none",
            ms=3.0,
            clip_on=False,
            label=label,
        )
    where = erosion.heteroclinic
    if where is not None:
        seen = where <= erosion.amplitude[-1]
        axes.axvline(
            where * scale.factor,
            color=inks.limit,
            lw=1.0,
            ls=DASHED,
            label=f"heteroclinic tangency, {_amplitude(where, scale)}"
            + ("" if seen else " (beyond)"),
        )
    for drop in drops:
        part = (drop.above - drop.level) / (drop.above - drop.below)
        axes.plot(
            (drop.low + part * (drop.high - drop.low)) * scale.factor,
            drop.level,
            "v",
            ms=6.5,
            color=colours[drop.measure],
            mec=inks.paper,
            mew=0.8,
            ls="none",
            zorder=4.0,
            label=f"{WORDS[drop.measure]} drops below {drop.level:g} at "
            f"{_amplitude(drop.high, scale)}",
        )
    if spread:
        axes.set_xscale("log")
    top = max(1.0, float(erosion.global_integrity.max()), float(erosion.integrity_factor.max()))
    axes.set(
        xlabel=scale.label,
        ylabel=palette.LABELS["integrity"],
        xlim=(float(a[0]) if spread else 0.0, float(a[-1])),
        ylim=(0.0, 1.05 * top),
    )
    draw_far_axes(axes, scale)
    points = np.concatenate(abscissas), np.concatenate(curves)
    size = extent(axes, width=225.0, height=12.0 * (3 + len(drops)) + 10.0)
    draw_legend(axes, place, corner=emptiest_corner(axes, points, size))
    return axes


@checked
def plot_safe_basin(erosion: Erosion, index: int, ax: "Axes | None" = None) -> "Axes":
    """Draw the safe basin at one amplitude: where the block stands, and where it falls.

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
        The axes: as those of `plot_basins`.
    """
    index = index_value(index, len(erosion.amplitude), "amplitude")
    axes = axes_or_new(ax)
    inks = inks_of(axes)
    areas = Area(inks.falls, HATCHES["falls"], "falls"), Area(inks.paper, word="stands")
    draw_window(axes, erosion, erosion.safe[index], areas)
    scale = scale_of("amplitude", erosion.block)
    axes.set_title(_amplitude(float(erosion.amplitude[index]), scale))
    return axes


def _amplitude(amplitude: float, scale: Scale) -> str:
    """Return an amplitude as in a title: in g where its scale is."""
    return f"{amplitude * scale.factor:.4g} g" if scale.far else f"A = {amplitude:.4g}"


def plain_name(kind: AttractorKind, name: str) -> str:
    """Return what a block does in a legend: a plain word, or the name of an orbit.

    Examples
    --------
    >>> plain_name(AttractorKind.OVERTURNED, "overturned"), plain_name(AttractorKind.REST, "rest")
    ('falls', 'comes to rest')
    >>> plain_name(AttractorKind.SYMMETRIC, "symmetric-1")
    'symmetric-1'
    """
    return kind.plain if kind in (AttractorKind.OVERTURNED, AttractorKind.REST) else name


def areas_of(attractors: Sequence[BasinAttractor], inks: Inks) -> list[Area]:
    """Return how basins are drawn, no two in one fill as long as the steps last."""
    used: Counter[str] = Counter()
    areas = []
    for attractor in attractors:
        role = LOOKS[MEANINGS[attractor.kind.value]].fill
        if attractor.orbit is not None and attractor.orbit.period > 1:
            role = "subharmonic"
        fill = mixed(getattr(inks, role), STEPS[used[role] % len(STEPS)])
        word = plain_name(attractor.kind, attractor.name)
        areas.append(Area(fill, HATCHES.get(role, ""), word))
        used[role] += 1
    return areas
