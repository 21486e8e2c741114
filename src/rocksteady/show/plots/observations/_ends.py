"""Names at the right end of lines."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from rocksteady.show.style.legends import size_of, text_size

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def name_ends(axes: "Axes", ends: Sequence[tuple[float, str, str]]) -> None:
    """Write names to the right of axes, each at the height of its line and clear of the others.

    Parameters
    ----------
    axes
        With their data, and their final scales.
    ends
        Ordinate, name and colour of each line.
    """
    size, high = text_size(axes, 8.0), size_of(axes)[1]
    across = axes.transAxes.inverted()
    lowest = -1.0
    axes.get_ylim()  # settles what is scaled to the data
    for ordinate, name, colour in sorted(ends):
        wanted = float(across.transform(axes.transData.transform((0.0, ordinate)))[1])
        lowest = max(wanted, lowest + 1.2 * size * (name.count("\n") + 1) / high)
        axes.annotate(
            name, (1.0, lowest), (4.0, 0.0), xycoords="axes fraction", textcoords="offset points",
            va="center", fontsize=size, color=colour, annotation_clip=False,
        )  # fmt: skip
