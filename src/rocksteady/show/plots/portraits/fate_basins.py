"""Plot of fates over a window of initial states, with the peaks of the safe ones."""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rocksteady.dynamics.basins.fate_basins import FateBasins
from rocksteady.model.checks.arguments import checked
from rocksteady.outcomes import Status
from rocksteady.show.plots.map_classes import share_text
from rocksteady.show.plots.portraits._window import draw_window
from rocksteady.show.style.areas import Area, pattern_ink
from rocksteady.show.style.layout import axes_or_new
from rocksteady.show.style.legends import LegendPlace, draw_legend, line_scale, place_of
from rocksteady.show.style.tokens import DASHED, HATCHES, Inks, inks_of

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes

AREAS = {
    (Status.ROCKING, 0): ("rocks", "rocks", None),
    (Status.OVERTURNED, 1): ("falls to the positive side", "falls", None),
    (Status.OVERTURNED, -1): ("falls to the negative side", "falls", "falls_negative"),
    (Status.LOST_CONTACT, 0): ("lost contact", "hair", "no_start"),
    (Status.UNDECIDED, 0): ("undecided", "undecided", None),
}
"""Words, role and pattern of each fate and side; states that rest have steps by their peaks."""
PEAKS = (
    (0.5, "comes to rest, tilt up to α/2", 0),
    (1.0, "comes to rest, tilt up to α", 1),
    (np.inf, "comes to rest, tilt above α", 3),
)
"""Largest |theta|/alpha of the states at rest at the end, in words, and their step of the ramp."""


@checked
def plot_fate_basins(
    fates: FateBasins, ax: "Axes | None" = None, *, legend: LegendPlace | None = None
) -> "Axes":
    """Draw the fate of each state of a window, and how far the safe ones rock.

    Dark where the block falls, with hatches that lean to the side to which it does; where it comes
    to rest the deeper the fill, the larger the tilt on the way.  A dashed line is the border of the
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
        The axes: tilt [degrees] and its velocity [degrees/s] of a block with sizes, else
        u = theta/alpha and d(theta/alpha)/d(pt).

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
    comes to rest, tilt up to α/2  7.1 %
    comes to rest, tilt up to α  12.4 %
    comes to rest, tilt above α  7.1 %
    falls to the positive side  42.2 %
    falls to the negative side  31.1 %
    safe on a still base
    """
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    axes = axes_or_new(ax)
    inks = inks_of(axes)
    codes, words, areas = _areas(fates, inks)
    window = draw_window(axes, fates, codes, areas)
    handles: list[Artist] = [
        Patch(
            fc=area.fill,
            ec=pattern_ink(area.fill) if area.hatch else inks.edge,
            hatch=area.hatch or None,
            lw=0.6,
            label=f"{words[code]}  {share_text(float((codes == code).mean()))}",
        )
        for code, area in enumerate(areas)
        if (codes == code).any()
    ]
    if fates.still_safe.any() and not fates.still_safe.all():
        width = 1.2 * line_scale(axes)
        where = fates.angle * window.factors[0], fates.velocity * window.factors[1]
        safe = fates.still_safe.astype(np.float64)
        for colour, dashes, wide in ((inks.paper, "-", 1.6), (inks.limit, DASHED, 0.0)):
            axes.contour(
                *where,
                safe,
                levels=[0.5],
                colors=[colour],
                linestyles=[dashes],
                linewidths=width + wide,
            )
        handles.append(Line2D([], [], color=inks.limit, ls=DASHED, label="safe on a still base"))
    axes.set(xlim=window.ends[:2], ylim=window.ends[2:])
    place = place_of(axes, legend, "right")
    draw_legend(axes, place, handles=handles, gap=window.gap, handlelength=1.5, handleheight=1.3)
    return axes


def _areas(fates: FateBasins, inks: Inks) -> tuple[NDArray[np.int8], list[str], list[Area]]:
    """Return the class of each state, and the words and the look of each class."""
    codes = np.zeros(fates.fate.shape, dtype=np.int8)
    names, areas = [], []
    below = -np.inf
    for code, (most, words, step) in enumerate(PEAKS):
        rests = (fates.fate == Status.AT_REST) & (fates.peak > below) & (fates.peak <= most)
        codes[rests] = code
        names.append(words)
        areas.append(Area(inks.rocks_ramp[step]))
        below = most
    for code, ((status, side), (words, role, pattern)) in enumerate(AREAS.items(), len(PEAKS)):
        codes[(fates.fate == status) & (fates.side == side)] = code
        names.append(words)
        word = role if role in ("falls", "rocks") else ""
        areas.append(Area(getattr(inks, role), HATCHES.get(pattern or role, ""), word))
    return codes, names, areas
