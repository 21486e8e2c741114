"""Plot of the share of realisations of noise under which a block falls."""

from typing import TYPE_CHECKING

import numpy as np

from rocksteady.dynamics.maps.noise_fates import NoiseFates
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.arguments import checked
from rocksteady.show.style.layout import axes_or_new
from rocksteady.show.style.legends import LegendPlace, checked_place, draw_legend
from rocksteady.show.style.line_ends import LineEnd, name_line_ends
from rocksteady.show.style.tokens import DOUBT, MARKS, inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes


MOST_LINES = 6
FEW = 40
"""Values along the axis up to which each has a mark."""


@checked
def plot_noise_fates(
    fates: NoiseFates, ax: "Axes | None" = None, *, legend: LegendPlace | None = None
) -> "Axes":
    """Draw the share of realisations under which the block falls, with 90 % intervals.

    To the right is the axis with more values: the rms of the noise, in m/s^2 where the block has a
    size, or the scale of the motion.  Each value of the other has a line, named at its end; of more
    than six those at which most fall.

    Parameters
    ----------
    fates
        From `rocksteady.compute_noise_fates`.
    ax
        Axes to draw on; default: axes of a new figure.
    legend
        "inside" the axes, to their "right", "below" them or "none"; default: names at the ends of
        the lines.

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
    colours = inks.series("risk", len(shown))
    for line, index in enumerate(shown.tolist()):
        colour = colours[line]
        axes.fill_between(
            along[order],
            100.0 * low[index, order],
            100.0 * high[index, order],
            color=colour,
            alpha=DOUBT,
            lw=0.0,
        )
        axes.plot(
            along[order],
            100.0 * share[index, order],
            color=colour,
            marker=MARKS[line] if len(along) <= FEW else "none",
            ms=3.5,
            label=f"{scale_axis[index]:.4g}",
        )
    axes.set(xlabel=names[0], ylabel="realisations that fall [%]", ylim=(-3.0, 103.0))
    axes.set_yticks(range(0, 101, 20))
    title = names[1] + (f"\n{left_out} lower ones left out" if left_out else "")
    place = checked_place(legend)
    if len(scale_axis) > 1 and place is not None:
        draw_legend(axes, place, title=title, columns=3 if place == "below" else 1)
    elif len(scale_axis) > 1:
        ends: dict[bytes, LineEnd] = {}  # of lines that coincide the last is seen
        for index, colour in zip(shown.tolist(), colours, strict=True):
            name, values = f"{scale_axis[index]:.4g}", 100.0 * share[index, order]
            key = values.tobytes()
            name = f"{ends[key].name}, {name}" if key in ends else name
            ends[key] = LineEnd(name, values, colour)
        name_line_ends(axes, [*ends.values()], title=title.replace(" [", "\n["))
    return axes
