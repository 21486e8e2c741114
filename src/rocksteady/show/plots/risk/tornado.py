"""Plots of what matters: measures of intensity by efficiency, assumptions by their effect."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from rocksteady.errors import InputError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import in_range
from rocksteady.results.numbers import number, plural
from rocksteady.risk.fragility.efficiency import Efficiency
from rocksteady.risk.fragility.fragility import Fragility
from rocksteady.show.export.components import text_value
from rocksteady.show.plots.risk._words import greek
from rocksteady.show.style import palette
from rocksteady.show.style.layout import axes_or_new, fit_rows, name_rows
from rocksteady.show.style.legends import LegendPlace, draw_legend, place_of, size_of, text_size
from rocksteady.show.style.limits import name_above
from rocksteady.show.style.tokens import inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LEAST_SCALE = 0.1
"""Largest probability above which a tornado has an axis from 0 to 1."""


@checked
def plot_measure_efficiency(fragility: Fragility | Efficiency, ax: "Axes | None" = None) -> "Axes":
    """Draw how far each measure of intensity is behind the most efficient, which is on top.

    The shorter the bar, the better; a pair of measures has no beta. On axes too small for the names
    of all rows the pairs are left out, the best of them excepted.

    Parameters
    ----------
    fragility
        From `rocksteady.compute_fragility`, with its ranking; or one measure of a ranking.
    ax
        Axes to draw on; default: axes of a new figure.

    Returns
    -------
    matplotlib.axes.Axes
        The axes: the difference of Akaike's criterion (AIC) to the best, with beta beside it.

    Raises
    ------
    InputError
        If there is no measure with a curve.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import Block, Record, compute_fragility
    >>> from rocksteady.risk import FitOptions
    >>> cabinet = Block.rectangle(width=0.4, height=1.6)
    >>> shakes = [
    ...     Record(acceleration_m_s2=[0.0, a, -a, 0.5, 0.0], dt_s=0.1 * a) for a in (1, 2, 3, 4)
    ... ]
    >>> fragility = compute_fragility(cabinet, shakes, fitting=FitOptions(bands=None))
    >>> axes = plot_measure_efficiency(fragility, Figure().add_subplot())
    >>> len(axes.patches) == len(fragility.ranking)
    True
    """
    ranking = [fragility] if isinstance(fragility, Efficiency) else fragility.ranking
    rows = [each for each in ranking if math.isfinite(each.aic)]
    if not any(each.beta > 0.0 for each in rows):
        raise InputError(
            "fragility",
            Words("has no ranking of measures"),
            "there must be a measure whose curve is fitted",
            "run levels at which some fall and some stand",
        )
    axes = axes_or_new(ax)
    inks, small = inks_of(axes), text_size(axes, 8.0)
    best, count = min(each.aic for each in rows), len(rows)
    if not fit_rows(axes, [_name(each) for each in rows]):
        pairs = [each for each in rows if len(each.measure) > 1]
        rows = [each for each in rows if each not in pairs[1:]]
    behind = [each.aic - best for each in rows]
    place = np.arange(len(rows))
    axes.barh(place, behind, height=0.55, color=inks.edge, lw=0.0)
    for at, (each, more) in enumerate(zip(rows, behind, strict=True)):
        words = f"+{more:.0f}" if more else "best"
        words += f", β {number(each.beta)}" if math.isfinite(each.beta) else ""
        axes.annotate(
            words, (more, at), (4.0, 0.0),
            textcoords="offset points", va="center", fontsize=small, color=inks.ink,
        )  # fmt: skip
    name_rows(axes, [_name(each) for each in rows], bars=True)
    left = f"\n{plural(count - len(rows), 'pair')} left out" if len(rows) < count else ""
    axes.set(
        xlabel=f"AIC above that of the best{left}",
        xlim=(0.0, (1.0 + _share_of_text(axes, 14.0, sides=1)) * (max(behind) or 1.0)),
    )
    return axes


def _name(row: Efficiency) -> str:
    """Return the name of a measure, or of a pair."""
    return greek(" and ".join(part.label for part in row.measure))


@checked
def plot_tornado(
    rows: Sequence[tuple[str, float, float]],
    base: float,
    ax: "Axes | None" = None,
    *,
    label: str = "probability of falling",
    legend: LegendPlace | None = None,
) -> "Axes":
    """Draw the range of a probability under each assumption, the widest on top.

    Parameters
    ----------
    rows
        Assumption, answer at its low end, and answer at its high end.
    base
        Answer as described, of which the line has the number.
    ax
        Axes to draw on; default: axes of a new figure.
    label
        What the answer is, with its unit; default that of a probability of falling.
    legend
        "inside" the axes, to their "right", "below" them, the default, or "none".

    Returns
    -------
    matplotlib.axes.Axes
        The axes: the answer, and a row for each assumption.

    Raises
    ------
    InputError
        If there is no row, or a number is not finite or larger than 1e300.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> rows = [("restitution", 0.31, 0.45), ("width -5 %", 0.47, 0.40)]
    >>> axes = plot_tornado(rows, 0.40, Figure().add_subplot())
    >>> [text.get_text() for text in axes.get_yticklabels()]
    ['restitution', 'width −5 %']
    """
    hint = "give the answer of each run"

    def answer(name: str, value: object) -> float:  # the largest scale that matplotlib draws
        return in_range(name, value, -1e300, 1e300, "[]", hint=hint)

    middle = answer("base", base)
    bars = [
        (text_value("rows", name), answer("rows", low), answer("rows", high))
        for name, low, high in rows
    ]
    if not bars:
        raise InputError("rows", Words("are none"), "there must be one or more", hint)
    label = text_value("label", label)
    bars.sort(key=lambda bar: -max(abs(end - middle) for end in bar[1:]))
    axes = axes_or_new(ax)
    inks, place = inks_of(axes), place_of(axes, legend or "below", "below")
    ends = np.array([bar[1:] for bar in bars], dtype=np.float64) - middle
    rows_at = np.arange(len(bars))
    # Where both ends lie on one side, each has half of the height.
    shared = np.sign(ends).prod(axis=1) > 0.0
    lanes = rows_at[:, np.newaxis] + np.outer(shared, (-0.15, 0.15))
    handles = [
        axes.barh(
            lanes[:, column],
            ends[:, column],
            left=middle,
            height=np.where(shared, 0.28, 0.56),
            color=(inks.paper, inks.edge)[column],
            edgecolor=inks.edge,
            lw=0.8,
            label=f"assumption at its {word} end",
            zorder=2.5,
        )
        for column, word in enumerate(("low", "high"))
    ]
    axes.axvline(middle, color=inks.ink, lw=1.0, zorder=3.0)
    unit, digits = (" %", 2) if "%" in label else ("", 3)
    name_above(axes, middle, f"as described, {greek(number(middle, digits))}{unit}")
    small, longest = text_size(axes, 8.0), 0
    for row, column in np.argwhere(ends).tolist():
        end = float(ends[row, column])
        text = greek(number(middle + end, digits))
        longest = max(longest, len(text))
        axes.annotate(
            text, (middle + end, float(lanes[row, column])), (math.copysign(3.0, end), 0.0),
            textcoords="offset points", ha="left" if end > 0.0 else "right",
            va="center", fontsize=small, color=inks.ink,
        )  # fmt: skip
    span = float(np.ptp([*ends.ravel(), 0.0])) or 0.1 * abs(middle) or 1.0
    names = [greek(palette.shortened(bar[0], 40)) for bar in bars]
    room = span * _share_of_text(axes, float(longest), sides=2)
    limits = (middle + min(0.0, ends.min()) - room, middle + max(0.0, ends.max()) + room)
    whole = 100.0 if unit else 1.0
    if label.startswith("probability") and limits[1] > LEAST_SCALE * whole:
        # The whole scale: a small change is to look small.
        limits = (min(limits[0], -0.04 * whole), max(limits[1], 1.04 * whole))
    name_rows(axes, names, bars=True)
    axes.set(xlabel=greek(label), xlim=limits)
    draw_legend(axes, place, handles=handles)
    return axes


def _share_of_text(axes: "Axes", letters: float, *, sides: int) -> float:
    """Return the width of text on one or both sides of bars over that of all bars together."""
    # A third of the figure is left of the axes, for names that are not laid out yet.
    wide = 0.65 * size_of(axes)[0]
    text = min(0.6 * text_size(axes, 8.0) * letters + 4.0, (0.4, 0.28)[sides - 1] * wide)
    return text / (wide - sides * text)
