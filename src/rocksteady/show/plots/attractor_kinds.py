"""Plot of the attractors of many motions: how many there are of each kind."""

from collections import Counter
from typing import TYPE_CHECKING, Any

from rocksteady.dynamics.batch.attractors import Attractors
from rocksteady.errors import InputError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.outcomes import AttractorKind
from rocksteady.show.style.layout import axes_or_new, name_rows
from rocksteady.show.style.legends import text_size
from rocksteady.show.style.line_ends import write_beside
from rocksteady.show.style.tokens import HATCHES, inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

AREAS = {
    AttractorKind.OVERTURNED.value: ("falls", "falls"),
    AttractorKind.REST.value: ("rest", AttractorKind.REST.plain),
    AttractorKind.UNDECIDED.value: ("undecided", "undecided"),
}
"""Role of the area, and plain word, of kinds that are no steady motion."""


@checked
def plot_attractor_kinds(attractors: Attractors, ax: "Axes | None" = None) -> "Axes":
    """Draw how many motions settle to each kind of attractor, the most frequent on top.

    Parameters
    ----------
    attractors
        From `rocksteady.orbits.find_attractors`.
    ax
        Axes to draw on; default: axes of a new figure.

    Returns
    -------
    matplotlib.axes.Axes
        The axes: number of motions, and a row for each kind.

    Raises
    ------
    InputError
        If there is no motion.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady.orbits import find_attractors
    >>> found = find_attractors([0.5, 2.0, 6.0], 4.0, 0.8)
    >>> axes = plot_attractor_kinds(found, Figure().add_subplot())
    >>> [name.get_text() for name in axes.get_yticklabels()]
    ['comes to rest', 'symmetric', 'falls']
    """
    counts = Counter(attractors.labels.tolist()).most_common()
    if not counts:
        raise InputError(
            "attractors", Words("are none"), "there must be a motion", "give an amplitude"
        )
    axes = axes_or_new(ax)
    inks, small, total = inks_of(axes), text_size(axes, 8.0), len(attractors.kind)
    for place, (kind, count) in enumerate(counts):
        role, _ = AREAS.get(kind, (kind, kind))
        style: dict[str, Any] = {"color": getattr(inks, role), "hatch": HATCHES.get(role)}
        axes.barh(place, count, height=0.62, ec=inks.edge, lw=0.6, **style)
        words = f"{count:,} of {total:,}"
        write_beside(axes, words, place, inks.ink, small, of_row=True)
    name_rows(axes, [AREAS.get(kind, ("", kind))[1] for kind, _ in counts])
    axes.locator_params(axis="x", integer=True, min_n_ticks=1)
    axes.set(xlabel="motions", xlim=(0.0, 1.03 * counts[0][1]))
    return axes
