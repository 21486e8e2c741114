"""Drawing shared by all pictures of the plane: axes, outlined lines, patterns, legends."""

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.formulas import heteroclinic_amplitude
from rocksteady.show.style import palette
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
"""Width of the white on either side of a line."""


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
    """Draw borders of families, with a white casing where they cross dark areas."""
    for line in lines:
        if only and line.name not in only:
            continue
        style = STYLES[line.name]
        _drawn(axes, line.frequency_ratio, line.amplitude, palette.INK, style, cased=cased)


def draw_thresholds(axes: "Axes", plane: Plane) -> None:
    """Draw the uplift of a block at rest, and the heteroclinic curve."""
    ratios = fine_ratios(plane)
    _drawn(axes, ratios, np.ones_like(ratios), palette.LINES[0], UPLIFT)
    values = heteroclinic_amplitude(ratios, plane.restitution)
    _drawn(axes, ratios, values, palette.LINES[1], HETEROCLINIC)


UPLIFT: dict[str, Any] = {"ls": (0, (8, 2, 1.5, 2, 1.5, 2)), "lw": 1.2}
HETEROCLINIC: dict[str, Any] = {"ls": (0, (6, 1.5, 1.5, 1.5)), "lw": 1.4}


def line_handles(names: Iterable[str], *, thresholds: bool = False) -> "list[Artist]":
    """Return what a legend shows of lines."""
    from matplotlib.lines import Line2D

    handles: list[Artist] = [
        Line2D([], [], color=palette.INK, label=WORDS[name], **STYLES[name]) for name in names
    ]
    if thresholds:
        handles += [
            Line2D([], [], color=palette.LINES[0], label="uplift from rest, A = 1", **UPLIFT),
            Line2D([], [], color=palette.LINES[1], label="heteroclinic curve", **HETEROCLINIC),
        ]
    return handles


def patch(label: str, fill: str, hatch: str = "", ink: str = palette.INK) -> "Artist":
    """Return what a legend shows of an area."""
    from matplotlib.patches import Patch

    return Patch(facecolor=fill, edgecolor=ink, hatch=hatch, lw=0.0 if hatch else 0.4, label=label)


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


def draw_pattern(
    axes: "Axes", plane: Plane, where: NDArray[np.bool_], hatch: str, ink: str
) -> None:
    """Draw a pattern over the cells of a class, which it shows in grey too."""
    if not where.any():
        return
    left, right, low, high = plane.window
    rows, columns = where.shape
    # Each cell as four corners, so that the pattern ends where the cells do.
    field = np.repeat(np.repeat(where.astype(float), 2, axis=0), 2, axis=1)
    x, y = (
        np.repeat(np.linspace(start, end, count + 1), 2)[1:-1]
        for start, end, count in ((left, right, columns), (low, high, rows))
    )
    drawn = axes.contourf(x, y, field, levels=[0.5, 1.5], colors="none", hatches=[hatch])
    drawn.set_edgecolor(ink)
    drawn.set_linewidth(0.0)
    drawn.set_zorder(0.8)


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


def shades(low: str, high: str, count: int) -> list[str]:
    """Return colours from one to another, evenly lighter or darker."""
    from matplotlib.colors import LinearSegmentedColormap, to_hex

    ramp = LinearSegmentedColormap.from_list("ramp", [low, high])
    return [to_hex(ramp(share)) for share in np.linspace(0.0, 1.0, count)]


def _drawn(
    axes: "Axes", x: Any, y: Any, colour: str, style: dict[str, Any], *, cased: bool = True
) -> None:
    from matplotlib.patheffects import Normal, Stroke

    effects = [Stroke(linewidth=style["lw"] + CASING, foreground="white"), Normal()]
    axes.plot(x, y, color=colour, **style, zorder=3.0, path_effects=effects if cased else None)
