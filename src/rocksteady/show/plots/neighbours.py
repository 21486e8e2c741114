"""Plot of the neighbours of a run: how a case and cases a few per cent beside it end."""

from typing import TYPE_CHECKING, Any

import numpy as np

from rocksteady.dynamics.history.neighbours import SCALES, Neighbour, Neighbours
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.arguments import checked
from rocksteady.outcomes import Status
from rocksteady.results.numbers import angle, number
from rocksteady.show.style.layout import axes_or_new
from rocksteady.show.style.legends import LegendPlace, draw_legend, place_of, text_size
from rocksteady.show.style.tokens import HATCHES, inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

AREAS = {
    Status.OVERTURNED: ("falls", "on_falls", HATCHES["falls"]),
    Status.ROCKING: ("rocks", "on_rocks", ""),
    Status.AT_REST: ("rest", "ink", ""),
    Status.LOST_CONTACT: ("undecided", "ink", HATCHES["undecided"]),
    Status.UNDECIDED: ("undecided", "ink", HATCHES["undecided"]),
}
"""Role of the area, role of the number on it, and pattern, by how a run ends."""
GAP = 0.35
"""Between blocks of one slenderness and those of the next, in squares."""
ORDER = (1, 0, 2)
"""Places of what is as given, of less of it, and of more, in the order of the neighbours."""


def _across(place: int, group: int) -> float:
    """Return the left side of a square: of a place in a group of one slenderness."""
    return (3.0 + GAP) * group + place


PLACES = [
    (_across(ratio, group), scale)
    for group in ORDER
    for ratio in ORDER
    for scale in range(len(SCALES))
]
"""Left and lower side of the squares of the neighbours, with that of the case itself."""


@checked
def plot_neighbours(
    neighbours: Neighbours, ax: "Axes | None" = None, *, legend: LegendPlace | None = None
) -> "Axes":
    """Draw how a case and its neighbours end: a square each, with the largest tilt of what stands.

    Motion grows upwards, restitution to the right within each of three groups of slenderness. The
    given case is outlined; a reversed motion stands on the right.

    Parameters
    ----------
    neighbours
        From `rocksteady.check_neighbours`.
    ax
        Axes to draw on; default: axes of a new figure.
    legend
        "inside" the axes, to their "right", "below" them, the default, or "none".

    Returns
    -------
    matplotlib.axes.Axes
        The axes: restitution and slenderness, and scale of the motion.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import Block, Pulse, check_neighbours, simulate
    >>> block = Block.rectangle(width=0.5, height=2.0)
    >>> pulse = Pulse.from_si(block, shape="one-sine", acceleration_m_s2=3.0, frequency_hz=1.0)
    >>> axes = plot_neighbours(check_neighbours(simulate(block, pulse)), Figure().add_subplot())
    >>> len(axes.patches)
    28
    """
    from matplotlib.patches import Patch, Rectangle

    axes = axes_or_new(ax)
    inks, small, usual = inks_of(axes), text_size(axes, 7.0), text_size(axes, 8.0)
    given, reversed_ = _own(neighbours), neighbours.cases[len(PLACES) - 1 :]
    cases = [neighbours.cases[0], given, *neighbours.cases[1 : len(PLACES) - 1]]
    squares = [(*place, each) for place, each in zip(PLACES, cases, strict=True)]
    squares += [(_across(0, 3), 1, each) for each in reversed_]
    met: dict[Status, Any] = {}
    for left, bottom, each in squares:
        role, number_role, pattern = AREAS[each.status]
        style: dict[str, Any] = {
            "facecolor": getattr(inks, role),
            "edgecolor": inks.edge,
            "hatch": pattern,
            "lw": 0.6,
        }
        axes.add_patch(Rectangle((left + 0.04, bottom + 0.04), 0.92, 0.92, **style))
        met.setdefault(each.status, Patch(label=each.status.plain, **style))
        if each.status is not Status.OVERTURNED and np.isfinite(each.peak):
            axes.text(
                left + 0.5, bottom + 0.5, number(each.peak, 2), ha="center", va="center",
                fontsize=small, color=getattr(inks, number_role),
            )  # fmt: skip
    middle = _across(1, 1)
    axes.add_patch(Rectangle((middle, 1.0), 1.0, 1.0, fill=False, ec=inks.ink, lw=2.0, zorder=5.0))
    width = squares[-1][0] + 1.0 if reversed_ else _across(2, 2) + 1.0
    heads = [
        (left + 0.5, rf"$\alpha$ = {angle(each.alpha)}")
        for left, bottom, each in squares
        if bottom == 0 and left in (_across(1, group) for group in range(3))
    ]
    heads += [(width - 0.5, "reversed")] if reversed_ else []
    for centre, words in heads:
        axes.annotate(
            words, (centre, 3.0), (0.0, 3.0), textcoords="offset points", ha="center",
            fontsize=usual, color=inks.ink, annotation_clip=False,
        )  # fmt: skip
    bottoms = [(left, each) for left, bottom, each in squares if bottom == 0]
    axes.set_xticks(
        [left + 0.5 for left, _ in bottoms],
        [f"{each.restitution:.2f}" for _, each in bottoms],
        fontsize=small,
    )
    axes.set_yticks([0.5, 1.5, 2.5], [f"{scale:g} x" for scale in SCALES])
    axes.grid(visible=False)
    for side in axes.spines.values():
        side.set_visible(False)
    axes.tick_params(length=0.0)
    axes.set(
        xlim=(-0.1, width + 0.1),
        ylim=(-0.1, 3.1),
        xlabel="restitution",
        ylabel="scale of the motion",
    )
    handles = [
        *(met[status] for status in AREAS if status in met),
        Patch(facecolor="none", edgecolor=inks.ink, lw=1.6, label="the given case"),
    ]
    if any(status is not Status.OVERTURNED for status in met):
        handles.append(
            Patch(facecolor="none", edgecolor="none", label=r"numbers: largest $|\theta|/\alpha$")
        )
    draw_legend(axes, place_of(axes, legend, "below"), handles=handles)
    return axes


def _own(neighbours: Neighbours) -> Neighbour:
    """Return the case itself as one of its neighbours."""
    case = neighbours.case
    assert isinstance(case.block, Block)
    return Neighbour(
        scale=1.0,
        restitution=case.block.restitution,
        alpha=case.block.alpha,
        sign=1,
        status=case.status,
        peak=case.peak,
    )
