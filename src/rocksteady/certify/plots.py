"""Plots of what is proved over two parameters."""

from typing import TYPE_CHECKING

import numpy as np

from rocksteady.certify.proofs.region import WORDS, ProvedRegion
from rocksteady.model.checks.arguments import checked
from rocksteady.show.style.areas import draw_pattern, pattern_ink, swatch
from rocksteady.show.style.layout import axes_or_new
from rocksteady.show.style.legends import LegendPlace, draw_legend, place_of
from rocksteady.show.style.scales import scale_of
from rocksteady.show.style.tokens import HATCHES, inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

CELLS = 500
"""Cells along a side of the picture."""
ROLES = dict(zip(WORDS, ("symmetric", "hair", "quiet", "rest", "undecided"), strict=True))
"""Fill of each verdict: the stable motion has its colour, and what is undecided its pattern."""


@checked
def plot_proved_region(
    region: ProvedRegion, ax: "Axes | None" = None, *, legend: LegendPlace | None = None
) -> "Axes":
    """Draw what is proved over frequency and amplitude, and what is undecided.

    Parameters
    ----------
    region
        From `rocksteady.proofs.certify_region`.
    ax
        Axes to draw on; default: axes of a new figure.
    legend
        "inside" the axes, to their "right", "below" them or "none".

    Returns
    -------
    matplotlib.axes.Axes
        The axes: Omega = omega/p, A = a_max/(alpha g).

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady.proofs import certify_region
    >>> region = certify_region((1.5, 2.5), (1.8, 2.2), 0.8, most_boxes=500)
    >>> axes = plot_proved_region(region, Figure().add_subplot())
    >>> [text.get_text() for text in axes.get_legend().get_texts()]
    ['symmetric, stable', 'unstable', 'undecided']
    """
    from matplotlib.colors import ListedColormap

    axes = axes_or_new(ax)
    inks = inks_of(axes)
    place = place_of(axes, legend, "right")
    cells = region.grid(CELLS, CELLS)
    edges = [np.linspace(*ends, CELLS + 1) for ends in (region.frequency_ratio, region.amplitude)]
    fills = [getattr(inks, ROLES[str(code)]) for code in range(len(ROLES))]
    axes.pcolormesh(
        *edges, cells, cmap=ListedColormap(fills), vmin=-0.5, vmax=len(fills) - 0.5, rasterized=True
    )
    ink = pattern_ink(inks.undecided)
    draw_pattern(axes, (edges[0], edges[1]), cells == 0, HATCHES["undecided"], ink, thin=True)
    across, up = scale_of("frequency_ratio", None), scale_of("amplitude", None)
    axes.set(xlabel=across.label, ylabel=up.label)
    seen = {letter: WORDS[letter] for letter in WORDS if (cells == int(letter)).any()}
    kind = {letter for letter in seen if ROLES[letter] == "symmetric"}  # whose colour names it
    names = {letter: "symmetric, " * (letter in kind) + words for letter, words in seen.items()}
    handles = [swatch(inks, ROLES[letter], name) for letter, name in names.items()]
    draw_legend(axes, place, handles=handles)
    return axes
