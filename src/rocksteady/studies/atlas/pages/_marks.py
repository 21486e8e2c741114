"""Drawing shared by all pictures of the plane: axes, outlined lines, patterns, legends."""

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.formulas import heteroclinic_amplitude
from rocksteady.show.style import palette
from rocksteady.show.style.areas import area_style, draw_pattern
from rocksteady.show.style.tokens import Inks, inks_of
from rocksteady.studies.atlas.analysis.lines import Line, fine_ratios
from rocksteady.studies.atlas.analysis.plane import Plane

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

STYLES: dict[str, dict[str, Any]] = {
    "existence": {"ls": "-", "lw": 1.3},
    "fold": {"ls": "-", "lw": 1.3},
    "symmetry-breaking": {"ls": (0, (6, 2)), "lw": 1.1},
    "first-doubling": {"ls": (0, (2.5, 1.2)), "lw": 0.8},
    "second-doubling": {"ls": (0, (1, 1)), "lw": 1.0},
    "cascade-limit": {"ls": "-", "lw": 0.6},
    "graze": {"ls": (0, (1, 1.2)), "lw": 1.4},
}
"""Folds solid, flips dashed, the shorter the later, grazes dotted."""
WORDS = {
    "existence": "existence (eq 23)",
    "fold": "fold",
    "symmetry-breaking": "symmetry breaking",
    "first-doubling": "first doubling",
    "second-doubling": "second doubling",
    "cascade-limit": "end of the cascade",
    "graze": "graze",
}
CASING = 1.6
"""Width of the casing on either side of a line."""


def prepare(axes: "Axes", plane: Plane, *, title: str = "", bottom: bool = True) -> None:
    """Give axes the limits and labels of the plane."""
    left, right, low, high = plane.window
    axes.set(xlim=(left, right), ylim=(low, high), ylabel=palette.LABELS["amplitude"])
    axes.grid(visible=False)
    if bottom:
        axes.set_xlabel(palette.LABELS["frequency_ratio"])
    else:
        axes.tick_params(labelbottom=False)
    axes.set_title(title)


def draw_lines(
    axes: "Axes", lines: Iterable[Line], *, only: Sequence[str] = (), cased: bool = True
) -> None:
    """Draw borders of families, with a casing where they cross dark areas."""
    for line in lines:
        if only and line.name not in only:
            continue
        _drawn(axes, line.frequency_ratio, line.amplitude, STYLES[line.name], cased=cased)


def draw_thresholds(axes: "Axes", plane: Plane) -> None:
    """Draw the uplift of a block at rest, and the heteroclinic curve."""
    ratios = fine_ratios(plane)
    _drawn(axes, ratios, np.ones_like(ratios), UPLIFT)
    values = heteroclinic_amplitude(ratios, plane.restitution)
    _drawn(axes, ratios, values, HETEROCLINIC)


UPLIFT: dict[str, Any] = {"ls": (0, (8, 2, 1.5, 2, 1.5, 2)), "lw": 1.2}
HETEROCLINIC: dict[str, Any] = {"ls": (0, (6, 1.5, 1.5, 1.5)), "lw": 1.4}


def line_handles(inks: Inks, names: Iterable[str], *, thresholds: bool = False) -> "list[Artist]":
    """Return what a legend shows of lines."""
    from matplotlib.lines import Line2D

    styles = [(WORDS[name], STYLES[name]) for name in names]
    if thresholds:
        styles += [("uplift from rest, A = 1", UPLIFT), ("heteroclinic curve", HETEROCLINIC)]
    return [Line2D([], [], color=inks.limit, label=words, **style) for words, style in styles]


def draw_cells(
    axes: "Axes", plane: Plane, values: NDArray[Any], colours: Sequence[str], *, above: float = 0.5
) -> None:
    """Fill the cells of the plane with the colours of their classes."""
    from matplotlib.colors import BoundaryNorm, ListedColormap

    left, right, low, high = plane.window
    axes.imshow(
        values,
        origin="lower",
        extent=(left, right, low, high),
        aspect="auto",
        interpolation="nearest",
        cmap=ListedColormap(list(colours)),
        norm=BoundaryNorm(np.arange(len(colours) + 1) - 0.5, len(colours)),
        zorder=above,
    )


def draw_area(
    axes: "Axes", plane: Plane, where: NDArray[np.bool_], role: str, pattern: str | None = None
) -> None:
    """Draw the pattern of an area over its cells, narrow ones too; none where its fill is plain."""
    style = area_style(inks_of(axes), role, pattern)
    left, right, low, high = plane.window
    rows, columns = where.shape
    edges = np.linspace(left, right, columns + 1), np.linspace(low, high, rows + 1)
    draw_pattern(axes, edges, where, style["hatch"] or "", style["edgecolor"], thin=True)


def draw_edge(axes: "Axes", plane: Plane, where: NDArray[np.bool_], **style: Any) -> None:
    """Draw the upper edge of an area that begins at the lower end of the plane, as steps."""
    left, right, low, high = plane.window
    rows, columns = where.shape
    # The cells of a column up to the first that does not belong.
    count = np.where(where.all(axis=0), rows, np.argmin(where, axis=0))
    edge = low + count * (high - low) / rows
    axes.stairs(edge, np.linspace(left, right, columns + 1), baseline=None, zorder=2.0, **style)


def legend_below(figure: "Figure", handles: "Sequence[Artist]", columns: int) -> None:
    """Put one legend beneath all axes of a figure."""
    figure.legend(
        handles=list(handles),
        loc="outside lower center",
        ncols=columns,
        handlelength=2.6,
        columnspacing=1.6,
    )


def shades(ramp: Sequence[str], count: int) -> list[str]:
    """Return colours from one end of a ramp to the other."""
    from matplotlib.colors import LinearSegmentedColormap, to_hex

    colours = LinearSegmentedColormap.from_list("ramp", list(ramp))
    return [to_hex(colours(share)) for share in np.linspace(0.0, 1.0, count)]


def _drawn(axes: "Axes", x: Any, y: Any, style: dict[str, Any], *, cased: bool = True) -> None:
    """Draw a border, upon a line in the colour of the paper where it crosses dark areas."""
    inks = inks_of(axes)
    if cased:
        axes.plot(x, y, color=inks.paper, lw=style["lw"] + CASING, zorder=2.9)
    axes.plot(x, y, color=inks.limit, **style, zorder=3.0)
