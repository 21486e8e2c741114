"""Plot of a result that is rows with one value each, the worst on top."""

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

from rocksteady.dynamics.basins.basins import BasinShare
from rocksteady.dynamics.basins.erosion import IntegrityDrop
from rocksteady.dynamics.basins.fate_basins import FateShare
from rocksteady.dynamics.basins.measures.boundary import BoundaryCheck
from rocksteady.dynamics.basins.measures.entropy import BasinEntropy
from rocksteady.errors import InputError, Words
from rocksteady.installation.check import Installation
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import whole_number
from rocksteady.results.numbers import chance, number
from rocksteady.risk.hazard.balanced_rocks import HazardBranchCheck
from rocksteady.risk.screens.screen import Screen
from rocksteady.show.plots.portraits.entropies import FRACTAL, NATS
from rocksteady.show.style import palette
from rocksteady.show.style.escaping import literal
from rocksteady.show.style.layout import axes_or_new, name_rows, percent_ticks
from rocksteady.show.style.legends import line_scale, size_of, text_size
from rocksteady.show.style.limits import draw_limit
from rocksteady.show.style.line_ends import write_beside
from rocksteady.show.style.tokens import inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

OfBasins = BasinEntropy | BasinShare | BoundaryCheck | FateShare | IntegrityDrop
Listed = OfBasins | HazardBranchCheck | Installation | Screen
"""Results that are rows."""
LONGEST = 32
"""Letters of the name of a row."""
HIGHEST, FEW = 0.6, 4
"""Height of a bar, and the number of rows below which it is less."""
SPACED = 1.9
"""Height of a row of a crowded picture over the size of its text; the labels below count too."""
MOST = 200
"""Rows of a picture."""


class Row(NamedTuple):
    """A bar: its name, its value, the words beside it, and the ends of its interval."""

    name: str
    value: float
    words: str
    ends: tuple[float, float] | None = None


class Rows(NamedTuple):
    """Bars with the worst first, the label of their axis, and the place and name of a limit.

    The axis is in per cent for a `share`; the bars have the colours of risk for one of falling.
    """

    bars: list[Row]
    label: str
    limit: tuple[float, str] | None = None
    share: bool = False
    risk: bool = False


@checked
def plot_rows(result: Listed, ax: "Axes | None" = None, *, most: int = 20) -> "Axes":
    """Draw each row of a result as a bar with its value, the worst on top.

    A dashed line is the limit of the rows. A thin line with a dot is an interval: Wilson's of a
    share, one standard error of the entropy of balls, the range of a smooth boundary.

    Parameters
    ----------
    result
        Basin entropy, share of a basin or of a fate, check of a boundary, drop of integrity,
        published formula, test of hazard branches, or check of an installation.
    ax
        Axes to draw on; default: axes of a new figure.
    most
        Number of rows, from 1 to 200; of more, or of more than the axes have room for, the worst
        are drawn.  Default 20.

    Returns
    -------
    matplotlib.axes.Axes
        The axes: the value with its unit, and a row for each name.

    Raises
    ------
    InputError
        If the number is outside its range, or the result has no value to draw.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady.basins import compute_basin_entropy
    >>> entropy = compute_basin_entropy([[0, 0, 0, 1], [0, 0, 1, 1]], box=2)
    >>> axes = plot_rows(entropy, Figure().add_subplot())
    >>> [name.get_text() for name in axes.get_yticklabels()], axes.get_xlabel()
    (['boundary boxes', 'all boxes'], 'entropy [nats]')
    """
    most = whole_number("most", most, at_least=1, at_most=MOST, hint="give a number of rows")
    rows = _READERS[type(result)](result)
    if not rows.bars:
        valid, hint = "a bar is a number", "read summary(more=True)"
        raise InputError("result", Words("has no value to draw"), valid, hint)
    axes = axes_or_new(ax)
    inks, small = inks_of(axes), text_size(axes, 8.0)
    most = min(most, max(FEW, int(size_of(axes)[1] / (SPACED * small)) - 1))
    high = HIGHEST * min(1.0, len(rows.bars) / FEW)
    for place, row in enumerate(rows.bars[:most]):
        colour = inks.risk_step(row.value) if rows.risk else inks.edge
        axes.barh(place, row.value, height=high, color=colour, ec=inks.edge, lw=0.6 * rows.risk)
        if row.ends is not None:
            draw_interval(axes, place, row.value, row.ends)
        write_beside(axes, row.words, place, inks.ink, small, of_row=True)
    left = len(rows.bars) - most
    names = [literal(palette.shortened(row.name, LONGEST)) for row in rows.bars[:most]]
    name_rows(axes, [*names, f"{left:,} more"] if left > 0 else names, bars=True, fontsize=small)
    if left > 0:
        write_beside(axes, "no worse", most, inks.ink, small, of_row=True)
    if rows.limit is not None:
        draw_limit(axes, *rows.limit, zorder=0.9 if rows.risk else 3.0)
    axes.set(xlabel=rows.label)
    if rows.share:
        percent_ticks(axes, "x")
    ends = [end for row in rows.bars for end in (row.value, *(row.ends or ()))]
    ends.append(1.0 if rows.share else rows.limit[0] if rows.limit else 0.0)
    axes.set_xlim(0.0, 1.03 * max(ends) or 1.0)
    return axes


def draw_interval(axes: "Axes", place: float, value: float, ends: tuple[float, float]) -> None:
    """Draw the interval of a value over its bar, with a dot at the value."""
    from matplotlib.patheffects import withStroke

    inks, width = inks_of(axes), line_scale(axes)
    outline = [withStroke(linewidth=3.0 * width, foreground=inks.paper)]
    axes.plot(ends, [place] * 2, color=inks.ink, lw=1.2 * width, path_effects=outline)
    axes.plot(value, place, "o", ms=5.0 * width, color=inks.ink, mec=inks.paper, clip_on=False)


def _entropy(entropy: BasinEntropy) -> Rows:
    """Return both entropies, with that above which a boundary is fractal."""
    pairs = (("boundary boxes", entropy.boundary_entropy), ("all boxes", entropy.entropy))
    bars = [Row(name, value, number(value)) for name, value in pairs if math.isfinite(value)]
    level, words = FRACTAL
    return Rows(bars, NATS, (level, words.replace("\n", " ")))


def _boundary(check: BoundaryCheck) -> Rows:
    """Return the entropy of the balls beside that of a smooth boundary."""
    smooth, error = check.smooth_entropy, check.standard_error
    middle, most = check.boundary_entropy, smooth + error + check.bias
    bars = [
        Row(f"balls: {check.verdict}", middle, number(middle), (middle - error, middle + error)),
        Row("smooth boundary", smooth, f"up to {number(most)}", (smooth - error, most)),
    ]
    return Rows(sorted(bars, key=lambda row: -row.value), NATS)


def _share(share: BasinShare | FateShare) -> Rows:
    """Return the share of a window."""
    name = share.name if isinstance(share, FateShare) else f"basin {share.label}"
    row = Row(name, share.share, chance(share.share, share.states), (share.low, share.high))
    return Rows([row], "share of the window", share=True)


def _drop(drop: IntegrityDrop) -> Rows:
    """Return the integrity at both amplitudes, with the level below which it falls."""
    ends = ((drop.low, drop.above), (drop.high, drop.below))
    bars = [Row(f"A = {number(at, 4)}", value, number(value)) for at, value in ends]
    return Rows(bars, palette.LABELS["integrity"], (drop.level, f"level {number(drop.level)}"))


def _branches(check: HazardBranchCheck) -> Rows:
    """Return the probability that the object would have fallen, on each branch."""
    verdicts = ("not rejected", "rejected")
    bars = [
        Row(row["branch"], at, f"{chance(at)}, {verdicts[row['rejected']]}")
        for row in check.rows()
        for at in (row["confidence"],)
    ]
    bars.sort(key=lambda row: -row.value)
    label = f"{palette.LABELS['falling']} within {number(check.age_years)} years"
    limit = (check.level, f"rejected from {number(100.0 * check.level)} %")
    return Rows(bars, label, limit, share=True, risk=True)


def _kernels(installation: Installation) -> Rows:
    """Return the share of recorded values that each kernel repeats."""
    rows = [
        (each.differing / max(each.values, 1), each.name, f"{each.differing:,} of {each.values:,}")
        for each in installation.checks
    ]
    rows.sort(key=lambda row: (-row[0], row[1]))
    bars = [Row(name, 1.0 - wrong, f"{counts} differ") for wrong, name, counts in rows]
    return Rows(bars, "recorded values that are repeated, bit for bit", share=True)


def _screen(screen: Screen) -> Rows:
    """Return the threshold of a formula."""
    value = screen.value
    known = value is not None and math.isfinite(value)
    bars = [Row(screen.name, value or 0.0, screen.words)] if known else []
    return Rows(bars, f"threshold or capacity{f' [{screen.unit}]' if screen.unit else ''}")


_READERS: dict[type, Callable[[Any], Rows]] = {
    BasinEntropy: _entropy, BasinShare: _share, BoundaryCheck: _boundary, FateShare: _share,
    HazardBranchCheck: _branches, Installation: _kernels, IntegrityDrop: _drop, Screen: _screen,
}  # fmt: skip
"""By class of a result: what its rows are."""
