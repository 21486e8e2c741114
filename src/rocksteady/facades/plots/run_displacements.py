"""Plot of the largest displacements of a facade under records, of both signs."""

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from rocksteady.facades.checks.facade_runs import FacadeRuns
from rocksteady.facades.checks.mechanism import SHARE_SLC, SHARE_SLV
from rocksteady.facades.plots.languages import decimal_marks, language_of, symbol
from rocksteady.model.checks.arguments import checked
from rocksteady.show.style import palette
from rocksteady.show.style.escaping import literal
from rocksteady.show.style.layout import axes_or_new, name_rows
from rocksteady.show.style.legends import LegendPlace, draw_legend, place_of
from rocksteady.show.style.limits import draw_limit
from rocksteady.show.style.tokens import HATCHES, inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LIMITS = (("d_SLV", SHARE_SLV), ("d_SLC", SHARE_SLC), ("d_0", 1.0))
"""Limits of the circular over d0."""
EDGE = 1.16
"""End of the bar of a run beyond d0."""


@checked
def plot_facade_runs(
    runs: FacadeRuns,
    ax: "Axes | None" = None,
    *,
    language: str = "en",
    legend: LegendPlace | None = None,
) -> "Axes":
    """Draw the largest displacement of each record and sign over d0, with mean and limits.

    Parameters
    ----------
    runs
        From `rocksteady.codes.run_facade`.
    ax
        Axes to draw on; default: axes of a new figure.
    language
        "en", the default, or "it".
    legend
        "inside" the axes, to their "right", "below" them, the default, or "none".

    Returns
    -------
    matplotlib.axes.Axes
        The axes: d/d0, and a row for each record. The bar of a run beyond d0 ends in an arrow.

    Raises
    ------
    InputError
        If there is no such language.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady.codes import Facade, run_facade
    >>> from rocksteady.motions import make_synthetic_suite
    >>> wall = Facade(name="front", kind="wall", thickness_m=0.3, height_m=3.0)
    >>> runs = run_facade(wall, make_synthetic_suite(7))
    >>> len(plot_facade_runs(runs, Figure().add_subplot()).get_yticks())
    7
    """
    from matplotlib.patches import Patch

    words = language_of(language)
    axes = axes_or_new(ax)
    inks, place = inks_of(axes), place_of(axes, legend, "below")
    names, shares, over = runs.records, runs.share, runs.beyond_d0
    count = len(runs.directions)
    thick = 0.74 / count
    handles: list[Any] = []
    edge: dict[str, Any] = {"edgecolor": inks.edge, "lw": 0.4}
    falls: dict[str, Any] = {"facecolor": inks.falls, "hatch": HATCHES["falls"]}
    for k, sign in enumerate(runs.directions):
        colour = inks.rocks_ramp[(3, 1)[k]]
        at = np.arange(len(names)) + (k - 0.5 * (count - 1)) * thick
        lengths = np.where(over[:, k], EDGE, shares[:, k])
        bars = axes.barh(at, lengths, height=0.9 * thick, color=colour, **edge)
        handles.append(Patch(facecolor=colour, label=words[f"sign_{sign}"], **edge))
        for bar, fallen in zip(bars, over[:, k], strict=True):
            if fallen:
                bar.set(**falls)
        beyond = at[over[:, k]]
        axes.plot(
            np.full(len(beyond), EDGE), beyond, ">", color=inks.falls, mec=inks.edge, ms=6.0,
            ls="none", clip_on=False,
        )  # fmt: skip
    if over.any():
        handles.append(Patch(label=words["beyond_all"], **edge, **falls))
    for name, share in LIMITS:
        draw_limit(axes, share, symbol(name))
    mean = math.inf if runs.mean_m is None else runs.mean_m / runs.facade.mechanism.d0_m
    if math.isfinite(mean):
        label = words("mean_largest", share=words.number(mean))
        handles.append(axes.axvline(mean, color=inks.motion, lw=1.8, zorder=3.2, label=label))
    name_rows(axes, [literal(palette.shortened(name, 24)) for name in names])
    axes.set(xlabel=words["axis_share"], xlim=(0.0, EDGE + 0.02), ylim=(len(names) - 0.45, -0.55))
    decimal_marks(axes, words, vertical=False)
    draw_legend(axes, place, handles=handles)
    return axes
