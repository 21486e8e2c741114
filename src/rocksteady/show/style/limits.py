"""Limits: dashed ink across the axes, with the name on the line."""

from typing import TYPE_CHECKING

from rocksteady.show.style.legends import line_scale, text_size
from rocksteady.show.style.tokens import DASHED, inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LETTERS = 8.0
"""Size of a name [points]."""


def draw_limit(axes: "Axes", at: float, name: str, *, zorder: float = 3.0) -> None:
    """Draw a vertical limit with its name above the axes.

    Parameters
    ----------
    axes
        Axes to draw on.
    at
        Its abscissa.
    name
        Its name.
    zorder
        Drawing order of the line.
    """
    width = line_scale(axes)
    axes.axvline(at, color=inks_of(axes).limit, lw=width, ls=DASHED, zorder=zorder)
    name_above(axes, at, name)


def name_above(axes: "Axes", at: float, name: str) -> None:
    """Write the name of a vertical line above the axes, as long as the line is in them."""
    axes.annotate(
        name,
        (at, 1.0),
        (0.0, 2.0),
        xycoords=axes.get_xaxis_transform(),
        textcoords="offset points",
        ha="center",
        va="bottom",
        fontsize=text_size(axes, LETTERS),
        color=inks_of(axes).limit,
        annotation_clip=True,
    )


def name_level_end(
    axes: "Axes", level: float, name: str, *, left: bool = False, below: bool = False
) -> None:
    """Write the name of a horizontal line at its end, inside the axes.

    Parameters
    ----------
    axes
        Axes with the line.
    level
        Its ordinate.
    name
        Its name.
    left, below
        Whether the name stands at the left end, and below the line; default: right and above.
    """
    axes.annotate(
        name,
        (0.0 if left else 1.0, level),
        (3.0 if left else -3.0, -2.0 if below else 2.0),
        xycoords=axes.get_yaxis_transform(),
        textcoords="offset points",
        ha="left" if left else "right",
        va="top" if below else "bottom",
        fontsize=text_size(axes, LETTERS),
        color=inks_of(axes).limit,
        annotation_clip=True,
    )


def name_point(axes: "Axes", x: float, y: float, name: str) -> None:
    """Write the name of a line to the right of the last of its points that is in the axes."""
    axes.annotate(
        name,
        (x, y),
        (5.0, 4.0),
        textcoords="offset points",
        fontsize=text_size(axes, LETTERS),
        color=inks_of(axes).limit,
    )
