"""Plot of fragility over PGA and PGV: the runs, and lines of equal probability."""

from typing import TYPE_CHECKING, Any

import numpy as np

from rocksteady.errors import InputError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.results.numbers import chance, quantity
from rocksteady.risk.fragility.fit_fragility import PEAKS, peaks_and_shares
from rocksteady.risk.fragility.fragility import Fragility
from rocksteady.show.plots.risk.fragility import EVENTS
from rocksteady.show.style.areas import risk_swatches
from rocksteady.show.style.layout import axes_or_new, plain_ticks
from rocksteady.show.style.legends import draw_legend, text_size
from rocksteady.show.style.tokens import DOTTED, inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

SHARES = (0.1, 0.5, 0.9)
"""Probabilities of the lines."""
FARTHEST = 50.0
"""Of ln PGV of a line, which leaves the picture long before."""
BEYOND = 1.15
"""Factor by which the axes go beyond the runs."""


@checked
def plot_fragility_surface(
    fragility: Fragility,
    ax: "Axes | None" = None,
    *,
    pga_g: float | None = None,
    pgv_m_s: float | None = None,
) -> "Axes":
    """Draw the fragility over PGA and PGV: shares of the runs that lift, and lines of 10 to 90 %.

    A dot is a record at a level.  A dotted line is where half fall by one of the two alone, if the
    curves are over it.

    Parameters
    ----------
    fragility
        From `rocksteady.compute_fragility`, with a surface.
    ax
        Axes to draw on; default: axes of a new figure.
    pga_g, pgv_m_s
        Peaks of a demand [g], [m/s], which is marked with its probability; none by default.

    Returns
    -------
    matplotlib.axes.Axes
        The axes, both logarithmic.

    Raises
    ------
    InputError
        If the surface is not fitted, one peak of a demand is given alone, or it is not above 0.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import Block, compute_fragility
    >>> from rocksteady.motions import make_synthetic_suite
    >>> from rocksteady.risk import FitOptions
    >>> fragility = compute_fragility(
    ...     Block.rectangle(width=0.3, height=1.5),
    ...     make_synthetic_suite(6),
    ...     fitting=FitOptions(states=["overturned"], bands=None),
    ... )
    >>> axes = plot_fragility_surface(fragility, Figure().add_subplot(), pga_g=0.4, pgv_m_s=0.5)
    >>> axes.get_xlabel(), axes.get_ylabel()
    ('PGA [g]', 'PGV [m/s]')
    """
    from scipy.special import ndtri

    surface = fragility.surface
    if surface is None or not fragility.surface_words:
        raise InputError(
            "fragility",
            Words("has no fitted surface"),
            "runs that fall and runs that stand must overlap in PGA and PGV",
            "give more records, of several shapes, with PGA and PGV beside the levels",
        )
    if (pga_g is None) != (pgv_m_s is None):
        name, value = ("pga_g", pga_g) if pgv_m_s is None else ("pgv_m_s", pgv_m_s)
        raise InputError(name, value, "a demand has both peaks", "give both, or neither")
    demand = fragility.by_both_peaks(pga_g, pgv_m_s)
    axes = axes_or_new(ax)
    inks, small = inks_of(axes), text_size(axes, 7.0)
    peaks, shares = peaks_and_shares(fragility)
    order = np.argsort(shares, kind="stable")
    axes.scatter(
        peaks[order, 0],
        peaks[order, 1],
        s=10.0,
        c=[inks.risk_step(share) for share in shares[order]],
        edgecolors=inks.edge,
        linewidths=0.3,
        zorder=2,
    )
    shown = peaks
    if demand is not None:
        shown = np.concatenate([peaks, np.array([[pga_g, pgv_m_s]], dtype=np.float64)])
    low, high = shown.min(axis=0) / BEYOND, shown.max(axis=0) * BEYOND
    axes.set(xscale="log", yscale="log", xlim=(low[0], high[0]), ylim=(low[1], high[1]))
    constant, first, second = surface.coefficients.tolist()
    across = np.geomspace(low[0], high[0], 200)
    for share, quantile in zip(SHARES, ndtri(SHARES).tolist(), strict=True):
        logs = quantile - constant - first * np.log(across)
        up = np.exp(np.clip(logs / second, -FARTHEST, FARTHEST))
        axes.plot(across, up, color=inks.risk, lw=1.6 if share == 0.5 else 0.9, zorder=3)
        inside = np.flatnonzero((up > low[1]) & (up < high[1]))
        if inside.size:
            at = inside[len(inside) // 12]
            axes.text(
                across[at],
                up[at],
                f"{100.0 * share:g} %",
                size=small,
                color=inks.risk,
                ha="center",
                va="center",
                bbox={"facecolor": inks.paper, "edgecolor": "none", "pad": 0.8},
                zorder=4,
            )
    verb = EVENTS.get(fragility.states[-1].state.name, ("", "reach the state"))[1]
    keys = [each.key for each in PEAKS]
    if fragility.measure.key in keys:
        median = float(fragility.states[-1].curve.median)
        name = f"half {verb}, by {fragility.measure.label} alone"
        if low[keys.index(fragility.measure.key)] < median:
            line = axes.axvline if fragility.measure.key == keys[0] else axes.axhline
            line(median, color=inks.ink, ls=DOTTED, lw=1.2, label=name, zorder=3)
    if demand is not None and pga_g is not None and pgv_m_s is not None:
        pair = f"{quantity(pga_g, 'g')} and {quantity(pgv_m_s, 'm/s')}"
        words = f"demand, {pair}: {chance(demand)}"
        axes.plot([pga_g], [pgv_m_s], "D", c=inks.paper, mec=inks.ink, ms=6, label=words, zorder=5)
    axes.set(xlabel=str(PEAKS[0]), ylabel=str(PEAKS[1]))
    plain_ticks(axes)
    handles: list[Any] = axes.get_legend_handles_labels()[0]
    handles += risk_swatches(inks, f"{{}} of runs {verb}")
    draw_legend(axes, "below", handles=handles, columns=3)
    return axes
