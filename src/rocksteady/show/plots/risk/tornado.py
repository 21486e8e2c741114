"""Picture of what matters: assumptions by their effect on an answer."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from rocksteady.errors import InputError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import in_range
from rocksteady.results.numbers import chance, number
from rocksteady.show.export.components import text_value
from rocksteady.show.plots.risk._words import FALLING, greek
from rocksteady.show.style import palette
from rocksteady.show.style.layout import axes_or_new, name_rows
from rocksteady.show.style.legends import draw_legend, size_of, text_size
from rocksteady.show.style.limits import name_above
from rocksteady.show.style.tokens import inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LEAST_SCALE = 0.1
"""Largest share above which a tornado has an axis from 0 to 100 %."""


@checked
def plot_tornado(
    rows: Sequence[tuple[str, float, float]],
    base: float,
    ax: "Axes | None" = None,
    *,
    label: str | None = None,
) -> "Axes":
    """Draw the range of an answer under each assumption, the widest on top.

    Parameters
    ----------
    rows
        Assumption, answer at its low end, and answer at its high end.
    base
        Answer as described, of which the line has the number.
    ax
        Axes to draw on; default: axes of a new figure.
    label
        What the answer is, with its unit; None (default) of a share of runs that fall, which is
        written in per cent.

    Returns
    -------
    matplotlib.axes.Axes
        The axes: the answer, and a row for each assumption.

    Raises
    ------
    InputError
        If there is no row, or a number is not finite, no share or larger than 1e300.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> rows = [("restitution", 0.31, 0.45), ("width -5 %", 0.47, 0.40)]
    >>> axes = plot_tornado(rows, 0.40, Figure().add_subplot())
    >>> [text.get_text() for text in axes.get_yticklabels()]
    ['restitution', 'width −5 %']
    """
    from matplotlib.ticker import FuncFormatter, MaxNLocator

    hint = "give the answer of each run"
    # The largest scale that Matplotlib draws.
    least, most = (-1e300, 1e300) if label is not None else (0.0, 1.0)

    def answer(name: str, value: object) -> float:
        return in_range(name, value, least, most, "[]", hint=hint)

    middle = answer("base", base)
    bars = [
        (text_value("rows", name), answer("rows", low), answer("rows", high))
        for name, low, high in rows
    ]
    if not bars:
        raise InputError("rows", Words("are none"), "there must be one or more", hint)
    words = greek(text_value("label", label)) if label is not None else FALLING
    bars.sort(key=lambda bar: -max(abs(end - middle) for end in bar[1:]))
    axes = axes_or_new(ax)
    inks = inks_of(axes)
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
    name_above(axes, middle, f"as described, {_figure(middle, label)}")
    small, longest = text_size(axes, 8.0), 0
    for row, column in np.argwhere(ends).tolist():
        end = float(ends[row, column])
        text = _figure(middle + end, label)
        longest = max(longest, len(text))
        axes.annotate(
            text, (middle + end, float(lanes[row, column])), (math.copysign(3.0, end), 0.0),
            textcoords="offset points", ha="left" if end > 0.0 else "right",
            va="center", fontsize=small, color=inks.ink,
        )  # fmt: skip
    # Of shares the whole scale is drawn: a small change is to look small.
    whole = label is None and middle + max(0.0, ends.max()) > LEAST_SCALE
    span = 1.0 if whole else float(np.ptp([*ends.ravel(), 0.0])) or 0.1 * abs(middle) or 1.0
    names = [greek(palette.shortened(bar[0], 40)) for bar in bars]
    room = span * _share_of_text(axes, longest)
    low, high = middle + min(0.0, ends.min()) - room, middle + max(0.0, ends.max()) + room
    name_rows(axes, names, bars=True)
    if whole:
        low, high = min(low, -0.04), max(high, 1.04)
    if label is None:
        axes.xaxis.set_major_locator(MaxNLocator(5, steps=[1, 2, 2.5, 5, 10]))
        axes.xaxis.set_major_formatter(FuncFormatter(lambda at, _: f"{100.0 * at:g} %"))
    axes.set(xlabel=words, xlim=(low, high))
    draw_legend(axes, "below", handles=handles)
    return axes


def _figure(value: float, label: str | None) -> str:
    """Return an answer in words: a share in per cent."""
    if label is not None:
        return greek(number(value))
    return chance(value) if value else "none"


def _share_of_text(axes: "Axes", letters: int) -> float:
    """Return the width of text on one side of bars over that of all bars together."""
    # A third of the figure is left of the axes, for names that are not laid out yet.
    wide = 0.65 * size_of(axes)[0]
    text = min(0.6 * text_size(axes, 8.0) * letters + 4.0, 0.28 * wide)
    return text / (wide - 2.0 * text)
