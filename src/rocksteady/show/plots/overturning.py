"""Plots of overturning spectra and of free rocking."""

import math
from collections import Counter
from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.dynamics.overturning.free_rocking import free_rocking_peaks, free_rocking_period
from rocksteady.dynamics.overturning.thresholds import THRESHOLDS
from rocksteady.dynamics.overturning.window_lists import OverturningWindow
from rocksteady.dynamics.overturning.windows import OverturningWindows, threshold_without_impact
from rocksteady.errors import InputError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.show.plots._other_way import draw_other_way
from rocksteady.show.style import palette
from rocksteady.show.style.areas import LEAST_RIMMED, area_style, rim_style, swatch, write_words
from rocksteady.show.style.layout import axes_or_new, plain_ticks, spaced_by_ratio
from rocksteady.show.style.legends import GAP, LegendPlace, draw_legend, place_of, size_of
from rocksteady.show.style.scales import FAR_ROOM, draw_far_axes, scale_of
from rocksteady.show.style.tokens import DASHED, MARKS, inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.patches import Patch


MODES = (
    ("falls without an impact", "/", 0),
    ("falls after one impact", "////", 1),
    ("falls after two or more", "////////", 2),
)
"""Words, pattern and least number of impacts of each way of falling: the more impacts, the denser
the pattern."""
FALLS = (("falls", "/", 0),)
"""The same on a floor, where impacts vary in a window."""
STANDS = -1
"""Code of the area where the block stands, beside those numbers."""
UNLISTED = -2
"""Code of the stretches in which windows lie that are not listed."""
OTHER = -3
"""Code of the area, without a word, above the first fall of the reversed pulse."""
CLOSED_FORM = {
    "linear": "closed form, without an impact",
    "nonlinear": "closed form of the linear model",
}
"""What the curve of the linear model's closed form is called."""
TALL = 5.0
"""Ratio of the ends of an axis of amplitudes from which on it is logarithmic."""
TOUCHING = 1.0 + 1e-9
"""Factor between the ends of windows that touch."""
LEAN = 1.3
"""Largest factor by which a window moves from one frequency to the next."""
LEVEL = 1.5
"""Place of what falls above what is not listed."""
ROWS = 240
"""Heights at which room for words is looked for."""
LONGEST_PERIOD = 20.0
"""Up to which p T is drawn: towards theta0 = alpha it has no bound."""


@checked
def plot_overturning(
    windows: OverturningWindows,
    ax: "Axes | None" = None,
    *,
    closed_form: bool = True,
    legend: LegendPlace | None = None,
) -> "Axes":
    """Draw the amplitudes at which a block falls under a pulse, over the frequency ratio.

    The more impacts before the fall, the denser the pattern; where the block stands is paper, and
    where narrower windows are left out crosses are. What is not written upon its area is in the
    legend.  Where the sides of the block differ, a line marks the least amplitude of the reversed
    pulse.
    Where the pulse has one, the closed form of falling without an impact is drawn over it, dashed,
    which is that of the linear model.  On a floor impacts vary in a window, and there is none.

    Parameters
    ----------
    windows
        From `rocksteady.find_overturning_windows`, of two frequencies or more.
    ax
        Axes to draw on; default: axes of a new figure.
    closed_form
        Whether to draw `rocksteady.formulas.overturning_amplitude`.
    legend
        "inside" the axes, to their "right", "below" them or "none"; by default to their
        right, or below narrow ones.

    Returns
    -------
    matplotlib.axes.Axes
        The axes: frequency [Hz] and a_max [g] of a block with sizes, else omega/p and
        a_max/(alpha g).

    Raises
    ------
    InputError
        If there is one frequency only.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import DimensionlessBlock, find_overturning_windows
    >>> windows = find_overturning_windows(
    ...     DimensionlessBlock(restitution=0.9), "one-sine", [2, 3, 4]
    ... )
    >>> axes = plot_overturning(windows, Figure().add_subplot())
    >>> [text.get_text() for text in axes.get_legend().get_texts()][:2]
    ['closed form, without an impact']
    """
    from matplotlib.collections import LineCollection, PolyCollection
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    w = windows.frequency_ratio
    if len(w) < 2:
        raise InputError(
            "windows",
            Words(f"has {len(w)} frequency ratio"),
            "a spectrum has two or more",
            "compute find_overturning_windows over an axis",
        )
    axes = axes_or_new(ax)
    inks, place = inks_of(axes), place_of(axes, legend, "right")
    by_ratio = len(w) > 2 and spaced_by_ratio(w)
    low, high = windows.within
    uplift = min(ratio for _, ratio, _ in windows.block.dimensionless().sides)
    low = max(low, uplift) if high > uplift and windows.floor is None else low
    right, up = (scale_of(name, windows.block) for name in ("frequency_ratio", "amplitude"))
    factors = np.array([right.factor, up.factor])
    parts = _parts(windows, by_ratio=by_ratio)
    style = area_style(inks, "falls")
    tall = high > TALL * low > 0.0
    handles: dict[int, Patch] = {}
    lines: list[Line2D] = []
    for words, hatch, least in _ways(windows):
        if not parts[least]:
            continue
        outlines = [part * factors for part in parts[least]]
        drawn = PolyCollection(outlines, **(style | {"hatch": hatch}), zorder=LEVEL)
        axes.add_collection(drawn, autolim=False)
        _draw_rims(axes, outlines, (low * up.factor, high * up.factor), tall=tall)
        handles[least] = Patch(**(style | {"hatch": hatch, "linewidth": 0.6}), label=words)
    handles |= _draw_unlisted(axes, windows, factors, by_ratio=by_ratio)
    # None on a floor, and where a wall holds the block in the first half of a reversed pulse.
    without = windows.floor is not None or (windows.block.one_sided and windows.pulse.reverse)
    if closed_form and windows.pulse.shape in THRESHOLDS and not without:
        spread = np.geomspace if by_ratio else np.linspace
        fine = spread(w[0], w[-1], 400)
        threshold = threshold_without_impact(windows.block, windows.pulse, fine)
        path = np.column_stack([fine, threshold]) * factors
        casing = LineCollection([path], colors=inks.paper, linewidths=3.0, zorder=2.9)
        axes.add_collection(casing, autolim=False)  # seen on what falls
        (line,) = axes.plot(
            *path.T,
            color=inks.limit,
            lw=1.4,
            ls=DASHED,
            zorder=3.0,
            label=CLOSED_FORM[windows.model.name],
        )
        lines.append(line)
    if by_ratio:
        axes.set_xscale("log")
    if tall:
        axes.set_yscale("log")
    axes.set(
        xlabel=right.label,
        ylabel=up.label,
        xlim=(float(w[0]) * right.factor, float(w[-1]) * right.factor),
        ylim=(low * up.factor, high * up.factor),
    )
    axes.grid(visible=False)
    plain_ticks(axes)
    gap = FAR_ROOM + GAP if draw_far_axes(axes, right, up) else GAP
    line_drawn = draw_other_way(axes, windows, w * right.factor, windows.opposite * up.factor)
    handles[STANDS] = swatch(inks, "paper", "stands" + ", below the line" * line_drawn)
    written = _write_words(axes, windows, factors, by_ratio=by_ratio)
    draw_legend(
        axes,
        place,
        handles=[*(handles[code] for code in handles if code not in written), *lines],
        gap=gap,
        handleheight=1.3,
    )
    return axes


def _draw_rims(
    axes: "Axes", outlines: Sequence[Floats], ends: tuple[float, float], *, tall: bool
) -> None:
    """Draw lines along borders, which keep areas apart that touch, on an axis between two ends."""
    from matplotlib.collections import LineCollection

    low, high = ends
    points = size_of(axes)[1] / (math.log(high / low) if tall else high - low)
    heights = [points * _height(outline, tall=tall) for outline in outlines]
    for wide in (True, False):
        borders = [
            half
            for outline, height in zip(outlines, heights, strict=True)
            if (height > LEAST_RIMMED) == wide
            for half in np.split(outline, 2)
        ]
        rims = LineCollection(borders, **rim_style(inks_of(axes), LEVEL, wide=wide))
        axes.add_collection(rims, autolim=False)


def _draw_unlisted(
    axes: "Axes", windows: OverturningWindows, factors: Floats, *, by_ratio: bool
) -> "dict[int, Patch]":
    """Draw the stretches in which windows are left out; return their legend entry, if any."""
    from matplotlib.collections import PolyCollection

    inks, w = inks_of(axes), windows.frequency_ratio
    areas = []
    for k in range(len(w)):
        left, right = (_between(w, place, by_ratio=by_ratio) for place in (k - 1, k))
        for low, high in windows.unlisted(k):
            corners = [[left, low], [right, low], [right, high], [left, high]]
            areas.append(np.array(corners) * factors)
    if not areas:
        return {}
    drawn = PolyCollection(areas, **area_style(inks, "undecided"), zorder=1.4)
    axes.add_collection(drawn, autolim=False)
    return {UNLISTED: swatch(inks, "undecided", "narrower windows, not listed")}


def _write_words(
    axes: "Axes", windows: OverturningWindows, factors: Floats, *, by_ratio: bool
) -> set[int]:
    """Write what the block does upon the large areas; return the codes of what is written."""
    inks, w = inks_of(axes), windows.frequency_ratio
    between = [_between(w, k, by_ratio=by_ratio) for k in range(-1, len(w))]
    spread = np.geomspace if axes.get_yscale() == "log" else np.linspace
    low, high = axes.get_ylim()
    rows = spread(low, high, ROWS + 1)
    middles = 0.5 * (rows[1:] + rows[:-1]) / factors[1]
    codes = np.full((ROWS, len(w)), STANDS)
    codes[middles[:, np.newaxis] > windows.opposite] = OTHER
    for k in range(len(w)):
        for least, most in windows.unlisted(k):
            codes[(middles > least) & (middles < most), k] = UNLISTED
        for window in windows.at(k):
            inside = (middles > window.low) & (middles < window.high)
            codes[inside, k] = _way(windows, window)
    words = {
        least: (text.removeprefix("falls ") if least else text, inks.falls)
        for text, _, least in _ways(windows)
    }
    words[STANDS] = ("stands", inks.paper)
    return write_words(axes, (np.array(between) * factors[0], rows), codes, words)


@checked
def plot_free_rocking(
    restitutions: ArrayLike = (),
    ax: "Axes | None" = None,
    *,
    impacts: int = 12,
    legend: LegendPlace | None = None,
) -> "Axes":
    """Draw the period of free rocking against amplitude, and the decay of blocks along it.

    Parameters
    ----------
    restitutions
        Restitutions of blocks let go at .9 alpha: each has a mark where every half cycle has its
        peak.
    ax
        Axes to draw on; default: axes of a new figure.
    impacts
        Number of impacts up to which the marks go.
    legend
        "inside" the axes, to their "right", "below" them or "none"; inside by default.

    Returns
    -------
    matplotlib.axes.Axes
        The axes: theta0/alpha and p T.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> axes = plot_free_rocking([0.9], Figure().add_subplot())
    >>> axes.get_legend().get_texts()[0].get_text()
    'restitution 0.9'
    """
    axes = axes_or_new(ax)
    # Denser at the ends: the slope is infinite at both.
    amplitude = 0.5 - 0.5 * np.cos(np.linspace(0.0, math.pi, 801))[:-6]
    inks, place = inks_of(axes), place_of(axes, legend, "inside")
    axes.plot(amplitude, free_rocking_period(amplitude), color=inks.motion)
    given = np.atleast_1d(np.asarray(restitutions, dtype=np.float64)).tolist()
    colours = inks.series("motion", max(1, len(given)))
    for series, ratio in enumerate(given):
        peaks = free_rocking_peaks(0.9, ratio, impacts)
        axes.plot(
            peaks,
            free_rocking_period(peaks),
            MARKS[series % len(MARKS)],
            color=colours[series],
            ms=5.0,
            mec=inks.paper,
            mew=0.6,
            ls="none",
            zorder=3.0,
            label=f"restitution {ratio:g}",
        )
    axes.set(
        xlabel=palette.LABELS["free_amplitude"],
        ylabel=palette.LABELS["free_period"],
        xlim=(0.0, 1.0),
        ylim=(0.0, LONGEST_PERIOD),
    )
    draw_legend(axes, place, corner="upper left")
    return axes


def _parts(windows: OverturningWindows, *, by_ratio: bool) -> dict[int, list[Floats]]:
    """Return polygons of the windows, by the least number of impacts of their way.

    Windows of one way that touch are one.  A window goes on at the next frequency where there is
    one window of its way that overlaps it, and no other does, or one alone between the same
    neighbours; between the two its borders are straight lines.  Where it does not go on, it reaches
    half-way to the next frequency, and narrows to a point if nothing overturns there.
    """
    w = windows.frequency_ratio
    parts: dict[int, list[Floats]] = {least: [] for _, _, least in MODES}
    columns = [_merged(windows, k) for k in range(len(w))]
    growing: dict[int, list[tuple[float, float, float]]] = {}  # by their place in this column
    for k, column in enumerate(columns):
        before = _between(w, k - 1, by_ratio=by_ratio)
        after = _between(w, k, by_ratio=by_ratio)
        following = _partners(column, columns[k + 1]) if k + 1 < len(w) else {}
        grown: dict[int, list[tuple[float, float, float]]] = {}
        for place, window in enumerate(column):
            path = growing.get(place, [(before, *_end(window, columns[max(k - 1, 0)]))])
            path.append((float(w[k]), window.low, window.high))
            if place in following:
                grown[following[place]] = path
                continue
            path.append((after, *_end(window, columns[min(k + 1, len(w) - 1)])))
            x, low, high = np.array(path).T
            outline = np.column_stack(
                [np.concatenate([x, x[::-1]]), np.concatenate([low, high[::-1]])]
            )
            parts[window.way].append(outline)
        growing = grown
    return parts


class _Drawn(NamedTuple):
    """Windows of one way that touch."""

    low: float
    high: float
    way: int
    """Least number of impacts, as in `MODES`."""


def _ways(windows: OverturningWindows) -> tuple[tuple[str, str, int], ...]:
    """Return the ways of falling that differ in a picture."""
    return MODES if windows.floor is None else FALLS


def _way(windows: OverturningWindows, window: OverturningWindow) -> int:
    """Return the least number of impacts of the way of a window."""
    return min(window.impacts, len(_ways(windows)) - 1)


def _merged(windows: OverturningWindows, index: int) -> list[_Drawn]:
    """Return the windows of a frequency, those of one way that touch as one."""
    merged: list[_Drawn] = []
    for window in sorted(windows.at(index), key=lambda item: item.low):
        way = _way(windows, window)
        if merged and merged[-1].way == way and window.low <= merged[-1].high * TOUCHING:
            merged[-1] = merged[-1]._replace(high=max(merged[-1].high, window.high))
        else:
            merged.append(_Drawn(window.low, window.high, way))
    return merged


def _height(part: Floats, *, tall: bool) -> float:
    """Return the largest height of a polygon, in the logarithm of the amplitude where `tall`."""
    low, high = np.split(part[:, 1], 2)
    return float((np.log(high[::-1] / low) if tall else high[::-1] - low).max())


def _between(w: Floats, k: int, *, by_ratio: bool) -> float:
    """Return the middle between a frequency and the next one; the first or last at the ends."""
    here, next_w = float(w[max(k, 0)]), float(w[min(k + 1, len(w) - 1)])
    return math.sqrt(here * next_w) if by_ratio else 0.5 * (here + next_w)


def _end(window: _Drawn, beyond: Sequence[_Drawn]) -> tuple[float, float]:
    """Return the borders of a window half-way to a frequency at which it does not go on."""
    if any(rival.low <= window.high and window.low <= rival.high for rival in beyond):
        return window.low, window.high
    middle = _middle(window)
    return middle, middle


def _middle(window: _Drawn) -> float:
    """Return the middle of a window, in the logarithm of the amplitude."""
    return math.sqrt(window.low * window.high) if window.low > 0.0 else 0.5 * window.high


def _partners(here: Sequence[_Drawn], next_windows: Sequence[_Drawn]) -> dict[int, int]:
    """Return which window of one frequency goes on as which of the next."""
    pairs = [
        (i, k)
        for i, window in enumerate(here)
        for k, rival in enumerate(next_windows)
        if window.way == rival.way and max(window.low, rival.low) <= min(window.high, rival.high)
    ]
    first, second = Counter(i for i, _ in pairs), Counter(k for _, k in pairs)
    partners = {i: k for i, k in pairs if first[i] == 1 and second[k] == 1}
    # A narrow window that leans has left its place by the next frequency: its neighbours show it.
    fixed = [(-1, -1), *sorted(partners.items()), (len(here), len(next_windows))]
    for (i, k), (next_i, next_k) in pairwise(fixed):
        between = [range(i + 1, next_i), range(k + 1, next_k)]
        for _, _, way in MODES:
            old, new = (
                [place for place in places if column[place].way == way]
                for places, column in zip(between, (here, next_windows), strict=True)
            )
            if len(old) == len(new) == 1 and not (first[old[0]] or second[new[0]]):
                moved = _middle(next_windows[new[0]]) / max(_middle(here[old[0]]), 1e-300)
                if 1.0 / LEAN < moved < LEAN:
                    partners[old[0]] = new[0]
    return partners
