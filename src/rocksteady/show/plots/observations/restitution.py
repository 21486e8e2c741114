"""Plots of measured free rocking: the decay of the peaks, and the restitution of each impact."""

from typing import TYPE_CHECKING

import numpy as np

from rocksteady.model.checks.arguments import checked
from rocksteady.results.numbers import number
from rocksteady.risk.free_rocking.restitution_fit import RestitutionFit
from rocksteady.show.style import palette
from rocksteady.show.style.escaping import literal
from rocksteady.show.style.layout import axes_or_new, clear_place, plain_ticks
from rocksteady.show.style.legends import LegendPlace, draw_legend
from rocksteady.show.style.limits import name_point
from rocksteady.show.style.line_ends import LineEnd, name_line_ends
from rocksteady.show.style.tokens import DASHED, DOUBT, MARKS, Inks, inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MOST_NAMED = 6
"""Releases with a mark and a name of their own."""


@checked
def plot_restitution(
    fit: RestitutionFit,
    ax: "Axes | None" = None,
    *,
    panel: str = "peaks",
    legend: LegendPlace | None = None,
) -> "Axes":
    """Draw the decay of measured peaks with the fit, or the restitution of each impact.

    Parameters
    ----------
    fit
        From `rocksteady.fit_restitution`.
    ax
        Axes to draw on; default: axes of a new figure.
    panel
        "peaks" (default): peaks over the number of impacts, with the fit and its band of 90 % from
        the first peak of the first release, and Housner's decay.  "impacts": the restitution of
        each impact over the peak before it, with bars of one standard deviation of the measuring
        error, the fit, and a band of one standard deviation of the scatter.
    legend
        "inside" the axes, to their "right", "below" them or "none"; by default in a free corner, or
        below.

    Returns
    -------
    matplotlib.axes.Axes
        The axes.

    Raises
    ------
    InputError
        If there is no such panel.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import Block, fit_restitution
    >>> block = Block.rectangle(width=0.1, height=0.6)
    >>> fit = fit_restitution([0.08, 0.0679, 0.0584, 0.0505], block)
    >>> plot_restitution(fit, Figure().add_subplot()).get_xlabel()
    'impacts'
    """
    from rocksteady.errors import InputError

    if panel not in ("peaks", "impacts"):
        raise InputError("panel", panel, "there are two panels", 'give "peaks" or "impacts"')
    axes = axes_or_new(ax)
    inks = inks_of(axes)
    if panel == "peaks":
        _draw_peaks(fit, axes, inks)
    else:
        _draw_impacts(fit, axes, inks)
    place, corner = clear_place(axes, legend, axes.get_legend_handles_labels()[1])
    draw_legend(axes, place, corner=corner)
    return axes


def _draw_peaks(fit: RestitutionFit, axes: "Axes", inks: Inks) -> None:
    """Draw peaks over the number of impacts."""
    alpha = max(fit.block.positive.alpha, fit.block.negative.alpha)
    for series, release in enumerate(fit.releases):
        count = _impact_numbers(release.sides)
        axes.plot(
            count,
            np.asarray(release.peaks_rad) / alpha,
            MARKS[series % len(MARKS)],
            color=inks.observed,
            ms=5.0,
            mec=inks.paper,
            mew=0.6,
            ls="none",
            clip_on=False,
            zorder=3.0,
            label=literal(release.name) if series < MOST_NAMED else None,
        )
    first = fit.releases[0]
    count = _impact_numbers(first.sides)
    fitted = fit.peaks_of(first) / alpha
    axes.plot(count, fitted, color=inks.motion)
    named = [LineEnd("fit", fitted, inks.motion)]
    ends = [fit.peaks_of(first, tuple(min(e, 1.0) for e in pair)) for pair in (fit.low, fit.high)]
    axes.fill_between(
        count,
        ends[0] / alpha,
        ends[1] / alpha,
        color=inks.motion,
        alpha=DOUBT,
        lw=0.0,
        label="90 % band",
    )
    low = min(float(np.min(np.asarray(each.peaks_rad))) for each in fit.releases) / alpha
    axes.set(xlabel="impacts", ylabel=r"peak $\theta/\alpha$", yscale="log", ylim=(0.7 * low, None))
    if fit.housner is not None:
        predicted = fit.peaks_of(first, fit.housner) / alpha
        axes.plot(count, predicted, color=inks.limit, lw=1.0, ls=DASHED)
        seen = int((predicted >= 0.7 * low).sum()) - 1
        if seen == len(predicted) - 1:
            named.append(LineEnd("Housner", predicted, inks.limit))
        else:  # where it leaves the picture
            name_point(axes, count[seen], predicted[seen], "Housner")
    axes.set_xlim(left=-0.02 * max(count[-1], 1))
    axes.locator_params(axis="x", integer=True)
    plain_ticks(axes)
    axes.set_xlim(right=count[-1] if len(fit.releases) == 1 else None)
    name_line_ends(axes, named)


def _draw_impacts(fit: RestitutionFit, axes: "Axes", inks: Inks) -> None:
    """Draw the restitution of each impact over the peak before it."""
    alpha = max(fit.block.positive.alpha, fit.block.negative.alpha)
    names = [release.name for release in fit.releases]
    for series, name in enumerate(dict.fromkeys(names)):
        mine = [each for each in fit.impacts if each.release == name]
        axes.errorbar(
            [each.peak_rad / alpha for each in mine],
            [each.restitution for each in mine],
            [each.measuring_error for each in mine],
            fmt=MARKS[series % len(MARKS)],
            color=inks.observed,
            ecolor=inks.observed,
            elinewidth=0.8,
            ms=5.0,
            mec=inks.paper,
            mew=0.6,
            zorder=3.0,
            label=literal(name) if series < MOST_NAMED else None,
        )
    named: list[LineEnd] = []
    same = fit.restitution[0] == fit.restitution[1]
    for k in (0,) if same else (0, 1):
        e = fit.restitution[k]
        side = "" if same else (", from +", ", from \N{MINUS SIGN}")[k]
        axes.axhline(e, color=inks.motion)
        named.append(LineEnd(f"fit {number(e)}{side}", e, inks.motion))
        axes.axhspan(
            e - fit.scatter, e + fit.scatter, color=inks.motion, alpha=DOUBT, lw=0.0,
            label=None if k else "scatter",
        )  # fmt: skip
        if fit.housner is not None:
            axes.axhline(fit.housner[k], color=inks.limit, lw=1.0, ls=DASHED)
            words = f"Housner {number(fit.housner[k])}{side}"
            named.append(LineEnd(words, fit.housner[k], inks.limit))
    axes.set(xlabel=r"peak before, $\theta/\alpha$", ylabel=palette.LABELS["restitution"])
    axes.set_xlim(left=0.0)
    name_line_ends(axes, named)


def _impact_numbers(sides: object) -> "np.ndarray[tuple[int], np.dtype[np.int64]]":
    """Return the number of impacts before each peak: two between peaks of one side."""
    at = np.asarray(sides)
    return np.concatenate([[0], np.cumsum(np.where(at[:-1] == at[1:], 2, 1))])
