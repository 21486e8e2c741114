"""Areas: the fill of a role with its pattern, its legend entry, and the word upon it."""

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rocksteady.arrays import Bools, Floats
from rocksteady.show.style.axes import picked
from rocksteady.show.style.legends import size_of, text_size
from rocksteady.show.style.tokens import (
    DARKEST_PAPER,
    HATCHES,
    Inks,
    contrast,
    inks_of,
    luminance,
    mixed,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.patches import Patch

MOST_HATCHED = 60
"""Most cells along a side that are wide enough for a pattern each."""
MOST_OUTLINED = 200
"""The same for an outline."""
MOST_PATTERNED = 600
"""Most cells along a side at which a pattern follows its border."""
ON_DARK, ON_LIGHT = 0.3, -0.4
"""Parts of white or black that turn a fill into the colour of its pattern."""
LETTER, LINE = 0.82, 1.9
"""Room of a letter and of a line, in parts of the size of a word on an area."""
WIDE_ENOUGH = 0.9
"""Fraction of the largest room that is enough for a word, which stands amid such places."""
MARK = 6.0
"""Radius around marks of which words keep clear [points]."""
RIM, NARROW_RIM = 0.8, 0.3
"""Widths of the rims of what falls, seen of them [points]."""
LEAST_RIMMED = 4.0
"""Width of what falls below which a rim over it would hide it [points]."""
SAMPLES = 220
"""Points along a side at which room for words is looked for."""


class Area(NamedTuple):
    """How one class of cells is drawn."""

    fill: str
    """Its colour."""
    hatch: str = ""
    """Its pattern; empty for none."""
    word: str = ""
    """Word written on it where it is large; empty for none."""


def pattern_ink(fill: str) -> str:
    """Return the colour of a pattern over a fill.

    Examples
    --------
    >>> from rocksteady.show.style.tokens import LIGHT, contrast
    >>> round(contrast(pattern_ink(LIGHT.falls), LIGHT.falls), 1)
    2.7
    """
    return mixed(fill, ON_DARK if luminance(fill) < DARKEST_PAPER else ON_LIGHT)


def word_ink(fill: str, inks: Inks) -> str:
    """Return the colour of a word on a fill.

    Examples
    --------
    >>> from rocksteady.show.style.tokens import LIGHT
    >>> word_ink(LIGHT.falls, LIGHT) == LIGHT.on_falls
    True
    >>> word_ink(LIGHT.rocks, LIGHT) == LIGHT.on_rocks
    True
    """
    return max((inks.on_falls, inks.on_rocks), key=lambda ink: contrast(ink, fill))


def area_style(inks: Inks, role: str, pattern: str | None = None) -> dict[str, Any]:
    """Return the settings of a patch: the fill of a role, its pattern, and no outline.

    Parameters
    ----------
    inks
        Colours of the paper.
    role
        Name of a fill, such as "falls".
    pattern
        Name of a pattern; default: that of the role, if it has one.

    Examples
    --------
    >>> from rocksteady.show.style.tokens import LIGHT
    >>> area_style(LIGHT, "falls")["hatch"], area_style(LIGHT, "rocks")["hatch"]
    ('////', None)
    """
    fill = getattr(inks, role)
    hatch = HATCHES.get(role if pattern is None else pattern)
    ink = pattern_ink(fill) if hatch else fill
    return {"facecolor": fill, "edgecolor": ink, "hatch": hatch, "linewidth": 0.0}


def rim_style(inks: Inks, zorder: float, *, wide: bool) -> dict[str, Any]:
    """Return the settings of lines along the borders of what falls, which keep areas apart.

    Those of a narrow area lie beneath all that falls, so that many close to each other stay as
    dark as they are.

    Parameters
    ----------
    inks
        Colours of the paper.
    zorder
        That of the areas.
    wide
        Whether the area is wider than `LEAST_RIMMED`.

    Examples
    --------
    >>> from rocksteady.show.style.tokens import DARK
    >>> style = rim_style(DARK, 1.5, wide=False)
    >>> style["edgecolor"] == DARK.edge, style["zorder"] < 1.5
    (True, True)
    """
    if wide:
        return {"edgecolor": inks.edge, "linewidth": RIM, "zorder": zorder + 0.1}
    # Black is not seen on dark paper.  The inner half of a rim is covered.
    ink = inks.edge if inks.dark else inks.falls
    return {"edgecolor": ink, "linewidth": 2.0 * NARROW_RIM, "zorder": zorder - 0.05}


def swatch(inks: Inks, role: str, words: str, pattern: str | None = None) -> "Patch":
    """Return the legend entry of an area, with an outline that parts it from the paper."""
    from matplotlib.patches import Patch

    style = area_style(inks, role, pattern)
    outline = {"linewidth": 0.6} if style["hatch"] else {"linewidth": 0.6, "edgecolor": inks.edge}
    return Patch(label=words, **(style | outline))


def risk_swatches(inks: Inks, first: str = "{}", width: float = 0.6) -> "list[Patch]":
    """Return legend entries of the steps of probability, the first in words around its range."""
    from matplotlib.patches import Patch

    steps = len(inks.risk_ramp)
    ranges = (f"{100 * k // steps} to {100 * (k + 1) // steps} %" for k in range(steps))
    return [
        Patch(fc=colour, ec=inks.edge, lw=width, label=words if place else first.format(words))
        for place, (colour, words) in enumerate(zip(inks.risk_ramp, ranges, strict=True))
    ]


def draw_pattern(
    axes: "Axes",
    edges: tuple[Floats, Floats],
    where: Bools,
    hatch: str,
    ink: str,
    *,
    outline: float = 0.0,
    thin: bool = False,
) -> None:
    """Draw a pattern over cells, as one area that ends where they do.

    What is too narrow to show a pattern, or an outline, gets none unless `thin`.

    Parameters
    ----------
    axes
        Axes with the cells.
    edges
        Edges of the columns and of the rows.
    where
        Which cells it covers, shape (rows, columns).
    hatch
        The pattern; empty for an outline alone.
    ink
        Its colour.
    outline
        Width of a line around the area [points].
    thin
        Whether narrow parts have the pattern too.
    """
    from scipy.ndimage import maximum_filter, minimum_filter

    if not where.any() or not (hatch or outline):
        return
    (columns, x), (rows, y) = (picked(each, MOST_PATTERNED) for each in edges)
    mask = where[np.ix_(rows, columns)].astype(np.float32)
    widest = MOST_PATTERNED if thin else MOST_OUTLINED if outline else MOST_HATCHED
    room = [max(1, round(count / widest)) for count in mask.shape]
    mask = maximum_filter(
        minimum_filter(mask, room, mode="nearest"), room, origin=[k % 2 - 1 for k in room]
    )
    if not mask.any():
        return
    # Each cell as four corners, so that the pattern ends where the cells do.
    field = np.repeat(np.repeat(mask, 2, axis=0), 2, axis=1)
    corners = (np.repeat(each, 2)[1:-1] for each in (x, y))
    drawn = axes.contourf(
        *corners, field, levels=[0.5, 1.5], colors="none", hatches=[hatch or None]
    )
    drawn.set_edgecolor(ink)
    drawn.set_linewidth(outline)
    drawn.set_zorder(1.2)


def write_words(
    axes: "Axes",
    edges: tuple[Floats, Floats],
    codes: NDArray[Any],
    words: Mapping[int, tuple[str, str]],
    marks: ArrayLike = (),
) -> set[int]:
    """Write words upon the areas of classes, each where it has most room, or not at all.

    The classes that have their word are returned: they need no entry of a legend.

    Parameters
    ----------
    axes
        Axes with the cells, their limits and scales final.
    edges
        Edges of the columns and of the rows.
    codes
        Class of each cell, shape (rows, columns).
    words
        Word and fill of each class that has one.
    marks
        Points of which words keep clear, in the units of the axes, shape (points, 2).
    """
    size = text_size(axes, 8.5)
    fractions = (np.arange(SAMPLES) + 0.5) / SAMPLES
    places = axes.transAxes.transform(np.column_stack([fractions, fractions]))
    x, y = axes.transData.inverted().transform(places).T
    columns, rows = (
        np.searchsorted(each, at, side="right") - 1 for each, at in zip(edges, (x, y), strict=True)
    )
    inside = ((rows >= 0) & (rows < codes.shape[0]))[:, np.newaxis]
    inside = inside & (columns >= 0) & (columns < codes.shape[1])
    shown = codes[np.ix_(rows.clip(0, codes.shape[0] - 1), columns.clip(0, codes.shape[1] - 1))]
    point = np.array(size_of(axes))[::-1] / SAMPLES  # of a sample: height and width
    to_axes = axes.transData + axes.transAxes.inverted()
    written = set()
    for across, high in to_axes.transform(np.reshape(marks, (-1, 2))).tolist():
        above, beside = ((fractions - at) * SAMPLES for at in (high, across))
        inside &= np.hypot(point[0] * above[:, np.newaxis], point[1] * beside) > MARK
    for code, (word, fill) in words.items():
        box = size * np.array([LINE, LETTER * (len(word) + 1.5)])
        middle = _roomiest(
            inside & (shown == code), [math.ceil(each) for each in box / point], point
        )
        if middle is None:
            continue
        written.add(code)
        row, column = middle
        place = (fractions[column], fractions[row])
        write_upon(axes, word, place, fill, size, zorder=5.5)
    return written


def write_upon(
    axes: "Axes", word: str, place: tuple[float, float], fill: str, size: float, *, zorder: float
) -> None:
    """Write a word of a size [points] upon an area, its middle at a place in parts of the axes."""
    from matplotlib.patheffects import Normal, Stroke

    axes.text(
        *place,
        word,
        transform=axes.transAxes,
        ha="center",
        va="center",
        fontsize=size,
        fontweight="bold",
        color=word_ink(fill, inks_of(axes)),
        path_effects=[Stroke(linewidth=2.5, foreground=fill), Normal()],
        zorder=zorder,
    )


def _roomiest(where: Bools, box: Sequence[int], point: Floats) -> tuple[int, int] | None:
    """Return the middle of the roomiest place of a box among samples; None if it does not fit."""
    from scipy.ndimage import distance_transform_edt, minimum_filter

    fits = minimum_filter(where, tuple(box), mode="constant", cval=False)
    if not fits.any():
        return None
    room = distance_transform_edt(np.pad(where, 1), sampling=point.tolist())[1:-1, 1:-1]
    most = np.argwhere(fits & (room >= WIDE_ENOUGH * room[fits].max()))
    row, column = most[((most - most.mean(axis=0)) ** 2).sum(axis=1).argmin()].tolist()
    return row, column
