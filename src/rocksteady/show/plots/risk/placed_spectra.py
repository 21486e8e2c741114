"""Plot of a design spectrum with the spectra of the motions that are placed on it."""

import math
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from rocksteady.errors import InputError, Words
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.arguments import checked
from rocksteady.results.numbers import number
from rocksteady.risk.counted.placing import GRID_S
from rocksteady.risk.counted.suite import Shaking
from rocksteady.risk.spectra.code_spectra import SPECTRUM_DAMPING
from rocksteady.seismic.measures.free_sides import free_sides
from rocksteady.show.style import palette
from rocksteady.show.style.layout import axes_or_new, clear_place, plain_ticks
from rocksteady.show.style.legends import draw_legend, line_scale
from rocksteady.show.style.limits import name_above
from rocksteady.show.style.tokens import DASHED, DOUBT, inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

FIRST_S: Final = 0.05
"""Shortest period that is shown [s]."""
STEPS: Final = 160
"""Number of periods of the design spectrum and of the mean."""
DECIDING: Final = (0.3, 1.1)
"""Periods that decide whether a block falls, over 2 pi/p."""
FAINT: Final = 0.4
"""Opacity of the spectra of single motions, of which there are many."""


def deciding_s(block: Block) -> tuple[float, float]:
    """Return the range of periods that decides whether a block falls to either side [s].

    Examples
    --------
    >>> low, high = deciding_s(Block.rectangle(width=0.32, height=1.8))
    >>> print(f"{low:.2f} {high:.2f}")
    0.66 2.44
    """
    sizes = [2.0 * math.pi / side.p for side in free_sides(block)]
    return DECIDING[0] * min(sizes), DECIDING[1] * max(sizes)


@checked
def plot_placed_spectra(
    shaking: Shaking, ax: "Axes | None" = None, *, block: Block | None = None
) -> "Axes":
    """Draw a design spectrum, and the spectra of the motions that are placed on it.

    Parameters
    ----------
    shaking
        From `rocksteady.motions.place_on_spectrum`.
    ax
        Axes to draw on; default: axes of a new figure.
    block
        Object whose deciding periods are shown, 0.3 to 1.1 times 2 pi/p; none by default.

    Returns
    -------
    matplotlib.axes.Axes
        The axes: period, and pseudo-acceleration at 5 % damping.

    Raises
    ------
    InputError
        If the motions are placed on no spectrum.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady.motions import make_synthetic_suite, place_on_spectrum
    >>> placed = place_on_spectrum(make_synthetic_suite(3), "en1998-1:2004:type1:C:ag=0.25")
    >>> axes = plot_placed_spectra(placed, Figure().add_subplot())
    >>> axes.get_xlabel(), [text.get_text() for text in axes.get_legend().get_texts()]
    ('period  $T$ [s]', ['design spectrum', 'mean spectrum of 3', "each motion's spectrum"])
    """
    placing = shaking.placing
    if placing is None:
        raise InputError(
            "shaking",
            Words("is placed on no spectrum"),
            "the picture is that of motions on a design spectrum",
            "place them with rs.motions.place_on_spectrum(motions, spectrum)",
        )
    axes = axes_or_new(ax)
    inks, width, end = inks_of(axes), line_scale(axes), placing.spectrum.range_s[1]
    periods = np.geomspace(FIRST_S, end, STEPS)
    spectra, design = placing.spectra_g(periods), placing.spectrum.accelerations_g(periods)
    thin: dict[str, Any] = {"color": inks.base, "lw": 0.6 * width, "alpha": FAINT}
    motions = placing.spectrum.peak_g * np.exp(placing.shapes)
    each, *_ = axes.plot(np.outer(GRID_S, placing.stretches), motions.T, **thin)
    each.set_label("each motion's spectrum")
    mean = f"mean spectrum of {len(motions):,}"
    axes.plot(periods, placing.mean_g(periods), color=inks.base, lw=2.4 * width, label=mean)
    strong: dict[str, Any] = {"color": inks.limit, "ls": DASHED, "lw": 1.8 * width}
    axes.plot(periods, design, label="design spectrum", **strong)
    axes.set(
        xscale="log",
        yscale="log",
        xlim=(FIRST_S, end),
        ylim=(0.8 * min(spectra.min(), design.min()), 1.1 * max(spectra.max(), design.max())),
        xlabel=palette.LABELS["period"],
        ylabel=palette.LABELS["pseudo_acceleration"],
    )
    plain_ticks(axes)
    if block is not None:
        low, high = deciding_s(block)
        axes.axvspan(low, high, color=inks.edge, alpha=DOUBT, lw=0.0, zorder=0.5)
        middle = math.sqrt(max(low, FIRST_S) * min(high, end))
        name_above(axes, middle, f"periods that decide:\n{number(low, 2)} to {number(high, 2)} s")
    damping = f"{100.0 * SPECTRUM_DAMPING:g} % damping"
    handles = [axes.lines[-1], axes.lines[-2], each]
    place, corner = clear_place(axes, None, [*(str(h.get_label()) for h in handles), damping])
    draw_legend(axes, place, handles=handles, corner=corner, title=damping)
    return axes
