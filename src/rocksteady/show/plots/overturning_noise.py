"""Plot of the share of realisations of noise under which a block overturns."""

from typing import TYPE_CHECKING

import numpy as np

from rocksteady.dynamics.maps.noise_fates import NoiseFates
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.arguments import checked
from rocksteady.show.style import palette
from rocksteady.show.style.layout import axes_or_new
from rocksteady.show.style.legends import LegendPlace, draw_legend, place_of
from rocksteady.show.style.line_colours import inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes


MOST_LINES = len(palette.LINES)
FEW = 40
"""Values along the axis up to which each has a mark."""


@checked
def plot_noise_fates(
    fates: NoiseFates, ax: "Axes | None" = None, *, legend: LegendPlace | None = None
) -> "Axes":
    """Draw the share of realisations that overturn, with 90 % intervals.

    To the right is the axis with more values: the rms of the noise, in m/s^2 where the block has a
    size, or the scale of the motion.  Each value of the other has a line; of more than
    six those at which most realisations overturn.

    Parameters
    ----------
    fates
        From `rocksteady.compute_noise_fates`.
    ax
        Axes to draw on; default: axes of a new figure.
    legend
        "inside" the axes, to their "right", "below" them or "none"; by default to their
        right, or below narrow ones.

    Returns
    -------
    matplotlib.axes.Axes
        The axes: rms of the noise or scale of the motion, and share [%].
    """
    axes = axes_or_new(ax)
    inks = inks_of(axes)
    rms, unit = fates.rms, r"$\alpha g$"
    if isinstance(fates.block, Block):
        rms, unit = rms * fates.block.uplift_acceleration, r"m/s$^2$"
    low, high = fates.interval()
    share = fates.share
    names = (f"rms of the noise [{unit}]", "scale of the motion")
    along, scale_axis = rms, fates.scale
    if len(fates.scale) > len(rms):
        along, scale_axis = fates.scale, rms
        share, low, high = share.T, low.T, high.T
        names = names[1], names[0]
    worst = np.argsort(-share.sum(axis=1), kind="stable")
    shown, left_out = np.sort(worst[:MOST_LINES]), len(worst[MOST_LINES:])
    order = np.argsort(along)
    for line, index in enumerate(shown.tolist()):
        colour = inks.lines[line]
        axes.fill_between(
            along[order],
            100.0 * low[index, order],
            100.0 * high[index, order],
            color=colour,
            alpha=0.18,
            lw=0.0,
        )
        axes.plot(
            along[order],
            100.0 * share[index, order],
            color=colour,
            ls=palette.DASHES[line],
            marker=palette.MARKS[line] if len(along) <= FEW else "none",
            ms=3.5,
            label=f"{scale_axis[index]:.4g}",
        )
    axes.set(xlabel=names[0], ylabel="realisations that overturn [%]", ylim=(-2.0, 102.0))
    if len(scale_axis) > 1:
        place = place_of(axes, legend, "right")
        title = names[1] + (f"\n{left_out} lower ones left out" if left_out else "")
        draw_legend(axes, place, title=title, columns=3 if place == "below" else 1)
    return axes
