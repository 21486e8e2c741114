"""Quantities by which the cells of a map are coloured instead of their classes."""

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.dynamics.maps.cell_classes import CellClass, Classes, counts_of
from rocksteady.errors import InputError
from rocksteady.show.plots.map_classes import (
    LOOKS,
    Look,
    MapCells,
    share_text,
    validated_map,
)
from rocksteady.show.style.scales import scale_of
from rocksteady.show.style.tokens import DASHED, Inks, mixed

if TYPE_CHECKING:
    import xarray
    from matplotlib.artist import Artist
    from matplotlib.colors import Colormap, Normalize

Colouring = Literal["class", "period", "lyapunov", "peak"]

OF_ATTRACTORS: tuple[Colouring, ...] = ("class", "period", "lyapunov", "peak")
OF_FATES: tuple[Colouring, ...] = ("class",)

PERIOD_STEPS = (0.6, 0.35, 0.1, -0.15, -0.4, -0.6)
"""Parts of white, or of black below 0, in the fills of periods 2, 3, ...; the last: longer."""
MOST_PERIODS = len(PERIOD_STEPS)
"""Longest orbit with a fill of its own; the next fill is that of all longer ones."""
LINE_WORDS, LINE_WIDTH = "tipping angle", 0.9
"""Name of the line at a peak of 1."""
USUAL = 0.98
"""Quantile of the sizes of Lyapunov exponents that the colours reach: a few tend to -infinity."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Shade:
    """How a quantity of cells is coloured; the same in all panels of a figure.

    Attributes
    ----------
    by
        Name of the quantity.
    norm
        Scale of values.
    label
        Label of the colour bar, with its unit; empty where a legend names each value.
    extend
        At which ends of the colour bar values lie beyond it.
    line
        Value at which a line is drawn; None for none.
    factor
        Factor of values before they are drawn.
    """

    by: Colouring
    norm: "Normalize"
    label: str
    extend: Literal["neither", "min", "max", "both"] = "neither"
    line: float | None = None
    factor: float = 1.0

    @property
    def ends(self) -> tuple[float, float]:
        """Lowest and highest value that has a colour of its own."""
        low, high = self.norm.vmin, self.norm.vmax
        assert low is not None
        assert high is not None
        return low, high

    def colours(self, inks: Inks) -> "Colormap":
        """Return the colours of values: of periods steps, about 0 two hues, else a ramp."""
        from matplotlib.colors import LinearSegmentedColormap, ListedColormap

        if self.by == "period":
            return ListedColormap(period_fills(inks))
        ramp = inks.rocks_ramp
        if self.by == "lyapunov":
            ramp = (inks.motion, inks.paper, inks.aperiodic)
        return LinearSegmentedColormap.from_list(self.by, ramp)

    def look(self, one: CellClass) -> Look:
        """Return how cells of a class are drawn that have no value."""
        if one is CellClass.REST:  # nearly the colour of a value of 0
            return replace(LOOKS[one], outlined=True)
        return LOOKS[one]

    def words(self, inks: Inks) -> dict[int, tuple[str, str]]:
        """Return word and fill of each value that has a word of its own, for areas."""
        if self.by != "period":
            return {}
        names = [str(k) for k in range(1, MOST_PERIODS + 1)] + [f"≥ {MOST_PERIODS + 1}"]
        return dict(enumerate(zip(names, period_fills(inks), strict=True), 1))

    def grouped(self, values: Floats) -> Classes:
        """Return the number of the word of each value, as in `words`; 0 where there is none."""
        groups: Classes = np.minimum(np.nan_to_num(values, nan=0.0), MOST_PERIODS + 1)
        return groups.astype(np.int8)

    def legend(self, cells: MapCells, inks: Inks) -> "list[Artist]":
        """Return entries for the periods or the line, and for each class of cells without a value.

        Shares are of all cells.
        """
        from matplotlib.lines import Line2D
        from matplotlib.patches import Patch

        values = values_of(cells)
        handles: list[Artist] = []
        if self.by == "period":
            counts = np.bincount(self.grouped(values).ravel(), minlength=MOST_PERIODS + 2)
            for period, (name, fill) in self.words(inks).items():
                share = counts[period] / values.size
                if share:
                    words = f"period {name}  {share_text(share)}"
                    handles.append(Patch(fc=fill, ec=inks.edge, lw=0.6, label=words))
        for cell_class, count in counts_of(without_value(cells)).items():
            if count:
                handles.append(self.look(cell_class).swatch(inks, count / values.size))
        if self.line is not None and np.nanmin(values, initial=1.0) < 1.0 < np.nanmax(
            values, initial=1.0
        ):
            handles.append(
                Line2D([], [], color=inks.limit, ls=DASHED, lw=LINE_WIDTH, label=LINE_WORDS)
            )
        return handles


def period_fills(inks: Inks) -> list[str]:
    """Return the fills of periods 1, 2, ..., the last of which is that of all longer ones."""
    return [inks.symmetric, *(mixed(inks.subharmonic, part) for part in PERIOD_STEPS)]


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
    from matplotlib.colors import Normalize

    if by == "period":
        return Shade(by=by, norm=Normalize(0.5, MOST_PERIODS + 1.5, clip=True), label="")
    scale = scale_of(by, cells.block)
    values = scale.factor * values_of(cells)
    finite = values[np.isfinite(values)]
    if by == "lyapunov":
        reach = float(np.quantile(np.abs(finite), USUAL)) if finite.size else 0.0
        reach = reach or 1.0
        below, above = bool((values < -reach).any()), bool((values > reach).any())
        ends: Any = ("neither", "min", "max", "both")[below + 2 * above]
        return Shade(by=by, norm=Normalize(-reach, reach), label=scale.label, extend=ends)
    norm = Normalize(0.0, float(finite.max(initial=0.0)) or 1.0)
    return Shade(by=by, norm=norm, label=scale.label, line=scale.factor, factor=scale.factor)
