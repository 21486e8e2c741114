"""Plot of fates over a window of initial states, with the peaks of the safe ones."""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rocksteady.dynamics.basins.fate_basins import ORDER, FateBasins
from rocksteady.model.checks.arguments import checked
from rocksteady.outcomes import Status
from rocksteady.show.plots.map_classes import swatch
from rocksteady.show.plots.portraits.basins import draw_window
from rocksteady.show.style import palette
from rocksteady.show.style.layout import axes_or_new
from rocksteady.show.style.legends import LegendPlace, draw_legend, line_scale, place_of

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes

FILLS = {
    (Status.ROCKING, 0): palette.ROCKING,
    (Status.OVERTURNED, 1): palette.OVERTURNED,
    (Status.OVERTURNED, -1): palette.tinted(palette.OVERTURNED, 0.45),
    (Status.LOST_CONTACT, 0): palette.SUBHARMONIC,
    (Status.UNDECIDED, 0): palette.UNDECIDED,
}
"""Fill of each fate and side; states at rest have fills by their peaks."""
PEAKS = (
    (0.5, "peak up to 0.5", palette.tinted(palette.SYMMETRIC, 0.85)),
    (1.0, "peak up to 1", palette.tinted(palette.SYMMETRIC, 0.5)),
    (np.inf, "peak above 1", palette.SYMMETRIC),
)
"""Largest |theta|/alpha of the states at rest at the end, in words, and their fill."""


@checked
def plot_fate_basins(
    fates: FateBasins, ax: "Axes | None" = None, *, legend: LegendPlace | None = None
) -> "Axes":
    """Draw the fate of each state of a window, and how far the safe ones rock.

    Dark where the block overturns, darker to the positive side; where it comes to rest the deeper
    the fill, the larger the peak of |theta|/alpha on the way.  A dashed line is the border of the
    states that are safe on a still base.  The legend has the shares.

    Parameters
    ----------
    fates
        From `rocksteady.compute_fate_basins`.
    ax
        Axes to draw on; default: axes of a new figure.
    legend
        "inside" the axes, to their "right", "below" them or "none"; by default to their
        right, or below narrow ones.

    Returns
    -------
    matplotlib.axes.Axes
        The axes: u = theta/alpha and d(theta/alpha)/d(pt).

    Examples
    --------
    >>> import numpy as np
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import DimensionlessBlock, Pulse, compute_fate_basins
    >>> window = np.linspace(-1.4, 1.4, 15)
    >>> block = DimensionlessBlock(restitution=0.9)
    >>> pulse = Pulse(shape="one-sine", amplitude=2.0, frequency_ratio=4.0)
    >>> basins = compute_fate_basins(block, pulse, angles=window, velocities=window)
    >>> axes = plot_fate_basins(basins, Figure().add_subplot())
    >>> for text in axes.get_legend().get_texts():
    ...     print(text.get_text())
    at rest, peak up to 0.5  7.1 %
    at rest, peak up to 1  12.4 %
    at rest, peak above 1  7.1 %
    overturned, positive side  42.2 %
    overturned, negative side  31.1 %
    safe on a still base
    """
    from matplotlib.lines import Line2D

    axes = axes_or_new(ax)
    classes, kinds = _classes(fates)
    window = draw_window(axes, fates, classes, [fill for _, fill, _ in kinds])
    if fates.still_safe.any() and not fates.still_safe.all():
        axes.contour(
            fates.angle,
            fates.velocity,
            fates.still_safe.astype(np.float64),
            levels=[0.5],
            colors=[palette.UNSYMMETRIC],
            linestyles=[palette.DASHES[1]],
            linewidths=1.2 * line_scale(axes),
        )
    axes.set(xlim=window[:2], ylim=window[2:])
    handles: list[Artist] = [
        swatch(words, fill, count / fates.fate.size) for words, fill, count in kinds if count
    ]
    if fates.still_safe.any() and not fates.still_safe.all():
        handles.append(
            Line2D(
                [],
                [],
                color=palette.UNSYMMETRIC,
                ls=palette.DASHES[1],
                label="safe on a still base",
            )
        )
    draw_legend(axes, place_of(axes, legend, "right"), handles=handles, handlelength=1.5)
    return axes


def _classes(fates: FateBasins) -> tuple[NDArray[np.int8], list[tuple[str, str, int]]]:
    """Return the class of each state, and the words, the fill and the number of each class."""
    rest = fates.fate == Status.AT_REST
    masks, classes = [], []
    below = -np.inf
    for most, words, fill in PEAKS:
        masks.append(rest & (fates.peak > below) & (fates.peak <= most))
        classes.append((f"at rest, {words}", fill))
        below = most
    for status, side, name in ORDER:
        if (status, side) in FILLS:
            masks.append((fates.fate == status) & (fates.side == side))
            classes.append((name, FILLS[status, side]))
    codes = np.zeros(fates.fate.shape, dtype=np.int8)
    for index, mask in enumerate(masks):
        codes[mask] = index
    counts = (int(np.count_nonzero(mask)) for mask in masks)
    return codes, [(*entry, count) for entry, count in zip(classes, counts, strict=True)]
