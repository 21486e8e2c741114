"""Quantities by which the cells of a map are coloured instead of their classes."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.dynamics.maps.cell_classes import CellClass, Classes, counts_of
from rocksteady.errors import InputError
from rocksteady.show.plots.map_classes import (
    LOOKS,
    Look,
    MapCells,
    swatch,
    validated_map,
)
from rocksteady.show.style import palette

if TYPE_CHECKING:
    import xarray
    from matplotlib.artist import Artist
    from matplotlib.colors import Colormap, Normalize

Colouring = Literal["class", "period", "lyapunov", "peak"]

OF_ATTRACTORS: tuple[Colouring, ...] = ("class", "period", "lyapunov", "peak")
OF_FATES: tuple[Colouring, ...] = ("class",)

MOST_PERIODS = len(palette.PERIODS) - 1
"""Longest orbit with a colour of its own; the last colour is that of all longer ones."""
USUAL = 0.98
"""Quantile of the sizes of Lyapunov exponents that the colours reach: a few tend to -infinity."""
REST_HATCHED = Look(
    words="at rest", fill=palette.GROUND, dot=palette.FAINT, hatch="\\\\\\\\", outlined=True
)
"""Look of rest beside a palette whose middle is nearly white."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Shade:
    """How a quantity of cells is coloured; the same in all panels of a figure.

    Attributes
    ----------
    by
        Name of the quantity.
    colours, norm
        Colours and scale of values.
    label
        Label of the colour bar, with its unit; empty where a legend names each value.
    extend
        At which ends of the colour bar values lie beyond it.
    line
        Value at which a line is drawn; None for none.
    """

    by: Colouring
    colours: "Colormap"
    norm: "Normalize"
    label: str
    extend: Literal["neither", "min", "max", "both"] = "neither"
    line: float | None = None

    @property
    def ends(self) -> tuple[float, float]:
        """Lowest and highest value that has a colour of its own."""
        low, high = self.norm.vmin, self.norm.vmax
        assert low is not None
        assert high is not None
        return low, high

    def look(self, one: CellClass) -> Look:
        """Return how cells of a class are drawn that have no value."""
        if one is CellClass.REST and self.by == "lyapunov":
            return REST_HATCHED
        return LOOKS[one]

    def legend(self, cells: MapCells) -> "list[Artist]":
        """Return entries for the periods, and for each class of cells without a value.

        Shares are of all cells.
        """
        values = values_of(cells)
        handles: list[Artist] = []
        if self.by == "period":
            colours = palette.PERIODS
            grouped = np.minimum(np.nan_to_num(values, nan=0.0), len(colours)).astype(np.int64)
            counts = np.bincount(grouped.ravel(), minlength=len(colours) + 1)
            for period, count in enumerate(counts[1:].tolist(), start=1):
                if count:
                    words = f"period {period}" if period <= MOST_PERIODS else f"period ≥ {period}"
                    handles.append(swatch(words, colours[period - 1], count / values.size))
        for cell_class, count in counts_of(without_value(cells)).items():
            if count:
                handles.append(self.look(cell_class).swatch(count / values.size))
        return handles


def checked_colouring(by: object, *, fates: bool) -> Colouring:
    """Return what colours the cells of a map.

    Raises
    ------
    InputError
        If there is no such quantity, or it belongs to the other kind of map.
    """
    valid = OF_FATES if fates else OF_ATTRACTORS
    for name in valid:
        if by == name:
            return name
    kind = "fates" if fates else "attractors"
    raise InputError(
        "by", by, f"a map of {kind} is coloured by {', '.join(valid)}", "choose one of them"
    )


def with_values(cells: MapCells, dataset: "xarray.Dataset", by: Colouring) -> MapCells:
    """Return the cells of a map with the quantity of each: nan where there is none."""
    names = {"peak": ("highest", "lowest")}.get(by, (by,))
    variables = validated_map(dataset, names)
    read = [variables[name].transpose(*cells.names).values.astype(np.float64) for name in names]
    values = np.max(np.abs(read), axis=0) if by == "peak" else read[0]
    if by == "period":
        values = np.where(values > 0.0, values, np.nan)
    for axis, name in enumerate(cells.names):
        points = variables[name].values.astype(np.float64)
        values = np.take(values, np.argsort(points), axis=axis)
    values[cells.classes >= CellClass.NO_START] = np.nan  # whatever is stored there
    return cells.having(values)


def values_of(cells: MapCells) -> Floats:
    """Return the quantities of cells that `with_values` gave them."""
    assert cells.reached is not None
    return cells.reached


def without_value(cells: MapCells) -> Classes:
    """Return the classes of the cells that have no value, shape (cells,)."""
    chosen: Classes = cells.classes[np.isnan(values_of(cells))]
    return chosen


def shade_of(cells: MapCells, by: Colouring) -> Shade:
    """Return the colours of a quantity, for all cells of a figure.

    Parameters
    ----------
    cells
        From `with_values`.
    by
        The quantity.
    """
    from matplotlib.colors import LinearSegmentedColormap, ListedColormap, Normalize

    values = values_of(cells)
    finite = values[np.isfinite(values)]
    if by == "period":
        colours: Any = ListedColormap(palette.PERIODS)
        norm = Normalize(0.5, len(palette.PERIODS) + 0.5, clip=True)
        return Shade(by=by, colours=colours, norm=norm, label="")
    label = palette.LABELS[by]
    if by == "lyapunov":
        colours = LinearSegmentedColormap.from_list("lyapunov", palette.DIVERGING)
        reach = float(np.quantile(np.abs(finite), USUAL)) if finite.size else 0.0
        reach = reach or 1.0
        below, above = bool((values < -reach).any()), bool((values > reach).any())
        ends: Any = ("neither", "min", "max", "both")[below + 2 * above]
        return Shade(
            by=by, colours=colours, norm=Normalize(-reach, reach), label=label, extend=ends
        )
    colours = LinearSegmentedColormap.from_list("sequential", palette.SEQUENTIAL)
    highest = float(finite.max(initial=0.0)) or 1.0
    return Shade(by=by, colours=colours, norm=Normalize(0.0, highest), label=label, line=1.0)
