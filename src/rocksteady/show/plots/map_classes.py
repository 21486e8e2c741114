"""Classes of the cells of maps and basins, and how each class is drawn."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.dynamics.maps.cell_classes import (
    CellClass,
    Classes,
    classes_of,
    counts_of,
    flags_of_cells,
)
from rocksteady.errors import InputError
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.gravity import in_g
from rocksteady.outcomes import AttractorKind, Status
from rocksteady.show.style import palette
from rocksteady.show.style.areas import swatch
from rocksteady.show.style.scales import Scale, scale_of
from rocksteady.show.style.tokens import HATCHES, Inks

if TYPE_CHECKING:
    import xarray
    from matplotlib.patches import Patch

IN_SI = {"acceleration_m_s2": "amplitude", "frequency_hz": "frequency_ratio"}
"""Axes in units, and the dimensionless ones of the same quantities."""


@dataclass(frozen=True, kw_only=True)
class Look:
    """How a class is drawn.

    Attributes
    ----------
    words
        In a legend, and upon its areas.
    fill
        Role of the fill of its cells, whose pattern they have too.
    line
        Role of its orbits in a diagram.
    pattern
        Name of another pattern; default: that of the fill.
    outlined
        Whether its areas have an outline, because the fill alone is nearly that of another.
    """

    words: str
    fill: str
    line: str = "quiet"
    pattern: str | None = None
    outlined: bool = False

    @property
    def hatch(self) -> str:
        """Pattern over its areas; empty where the fill is plain."""
        return HATCHES.get(self.pattern or self.fill, "")

    def swatch(self, inks: Inks, share: float) -> "Patch":
        """Return its entry of a legend, with the share of all cells."""
        return swatch(inks, self.fill, f"{self.words}  {share_text(share)}", self.pattern)


LOOKS = {
    CellClass.REST: Look(words=AttractorKind.REST.plain, fill="rest"),
    CellClass.SYMMETRIC: Look(words=AttractorKind.SYMMETRIC.label, fill="symmetric", line="motion"),
    CellClass.UNSYMMETRIC: Look(
        words=AttractorKind.UNSYMMETRIC.label, fill="unsymmetric", line="unsymmetric_line"
    ),
    CellClass.SUBHARMONIC: Look(
        words="subharmonic (period ≥ 2)", fill="subharmonic", line="subharmonic_line"
    ),
    CellClass.APERIODIC: Look(
        words=AttractorKind.APERIODIC.label, fill="aperiodic", line="aperiodic_line"
    ),
    CellClass.ROCKING: Look(words=Status.ROCKING.plain, fill="rocks", line="motion"),
    CellClass.OVERTURNED: Look(words=Status.OVERTURNED.plain, fill="falls", line="ink"),
    CellClass.UNDECIDED: Look(words=Status.UNDECIDED.plain, fill="undecided"),
    CellClass.NO_START: Look(
        words="no such start", fill="paper", pattern="no_start", outlined=True
    ),
    CellClass.NOT_COMPUTED: Look(
        words="not computed", fill="paper", pattern="not_computed", outlined=True
    ),
}


@dataclass(frozen=True, kw_only=True, eq=False)
class MapCells:
    """The cells of a map, without the axes that have a single value.

    Attributes
    ----------
    names
        Names of the axes.
    values
        Coordinates along each of them, ascending.
    classes
        A `CellClass` for each cell, shape of the axes.
    fixed
        What all cells have in common: names and values.
    reached
        A quantity of each cell, shape of the axes, nan where there is none; None without one.
    block
        The block of all cells where it has a size, in whose units the axes are drawn, else None.
    """

    names: tuple[str, ...]
    values: tuple[Floats, ...]
    classes: Classes
    fixed: tuple[tuple[str, float], ...]
    reached: Floats | None = None
    block: Block | None = None

    def having(self, reached: Floats) -> "MapCells":
        """Return the same cells with a quantity of each."""
        return replace(self, reached=reached)

    def shares(self) -> dict[CellClass, float]:
        """Return the share of all cells in each class that occurs."""
        counts = counts_of(self.classes)
        return {
            cell_class: count / self.classes.size for cell_class, count in counts.items() if count
        }

    def turned(self, names: Sequence[str]) -> "MapCells":
        """Return the same cells with the axes in another order."""
        order = [self.names.index(name) for name in names]
        return replace(
            self,
            names=tuple(names),
            values=tuple(self.values[axis] for axis in order),
            classes=self.classes.transpose(order),
            reached=None if self.reached is None else self.reached.transpose(order),
        )

    def scale(self, name: str) -> tuple[Scale, Scale]:
        """Return the scale of an axis, and the one whose dimensionless values its far side has."""
        name_without_size = IN_SI.get(name)
        if name_without_size is None:
            scale = scale_of(name, self.block, at_start=True)
            return scale, scale
        near = Scale(1.0, palette.axis_label(name))
        if name == "acceleration_m_s2":
            near = Scale(in_g(1.0), palette.axis_label("accel_g"))
        return near, scale_of(name_without_size, self.block)

    def parts(self, name: str) -> "list[MapCells]":
        """Return the cells at each value of an axis, which they have in common then."""
        turned = self.turned([name, *(each for each in self.names if each != name)])
        return [
            replace(
                self,
                names=turned.names[1:],
                values=turned.values[1:],
                classes=classes,
                fixed=((name, float(value)),),
                reached=None if turned.reached is None else turned.reached[place],
            )
            for place, (value, classes) in enumerate(
                zip(turned.values[0], turned.classes, strict=True)
            )
        ]


def map_cells(dataset: "xarray.Dataset") -> MapCells:
    """Return the cells of a map.

    Parameters
    ----------
    dataset
        From `rocksteady.map_attractors` or `rocksteady.map_fates`; of its variables only ``kind``
        and ``period``, or ``fate``, are read.

    Raises
    ------
    InputError
        If it is something else, or has no axis with two values or more.

    Examples
    --------
    >>> from rocksteady import DimensionlessBlock, map_attractors
    >>> axes = {"amplitude": [0.5, 2.0], "frequency_ratio": [8.0, 1.0, 4.0]}
    >>> result = map_attractors(DimensionlessBlock(restitution=0.8), axes=axes)
    >>> cells = map_cells(result)
    >>> cells.names, cells.classes
    (('amplitude', 'frequency_ratio'), array([[0, 0, 0],
           [6, 1, 1]], dtype=int8))
    """
    read = ("fate",) if has_fates(dataset) else ("kind", "period")
    variables = validated_map(dataset, read)
    kind = variables[read[0]]
    names = tuple(str(name) for name in kind.dims)
    period = variables["period"].transpose(*names).values if len(read) > 1 else None
    classes = classes_of(kind.values, period, flags_of_cells(kind))
    values = []
    for axis, name in enumerate(names):
        points = variables[name].values.astype(np.float64)
        order = np.argsort(points)
        if (order[1:] < order[:-1]).any():
            points, classes = points[order], np.take(classes, order, axis=axis)
        values.append(points)
    return MapCells(
        names=names,
        values=tuple(values),
        classes=classes,
        fixed=fixed_values(variables),
        block=_block_of(dataset),
    )


def _block_of(dataset: "xarray.Dataset") -> Block | None:
    """Return a block of the size that all cells have; None where they have none, or several."""
    sizes: dict[str, Any] = {name: dataset.attrs.get(name) for name in ("alpha", "p", "gravity")}
    unlike = dataset.attrs.get("alpha_ratio", 1.0) != 1.0
    return None if None in sizes.values() or unlike else Block.from_p(**sizes, restitution=1.0)


def has_fates(dataset: object) -> bool:
    """Return whether a map is one of fates; else it is one of attractors, or none."""
    import xarray

    return isinstance(dataset, xarray.Dataset) and "fate" in dataset


def fixed_values(variables: "xarray.Dataset") -> tuple[tuple[str, float], ...]:
    """Return names and values of the coordinates that have one value alone."""
    return tuple(
        (str(name), float(coordinate))
        for name, coordinate in variables.coords.items()
        if coordinate.ndim == 0 and coordinate.dtype.kind in "iuf"
    )


def validated_map(dataset: object, names: Sequence[str]) -> "xarray.Dataset":
    """Return variables of a map over the axes that have two values or more.

    Raises
    ------
    InputError
        If it is no dataset with these variables, or there is no such axis.
    """
    import xarray

    if not isinstance(dataset, xarray.Dataset) or not set(names) <= set(dataset.data_vars):
        raise InputError(
            "dataset",
            sorted(map(str, dataset)) if isinstance(dataset, xarray.Dataset) else dataset,
            f"a map is a dataset with {' and '.join(names)}",
            "give what map_attractors or map_fates returned, whole",
        )
    variables = dataset[list(names)].squeeze()
    if variables[names[0]].ndim == 0 or 0 in variables[names[0]].shape:
        raise InputError(
            "dataset",
            dict(dataset.sizes),
            "a picture needs an axis with two values or more",
            "give more values, or read the numbers of the one cell",
        )
    return variables


def share_text(share: float) -> str:
    """Return a share as in a legend.

    Examples
    --------
    >>> share_text(0.123), share_text(1e-5)
    ('12.3 %', '< 0.1 %')
    """
    return f"{100.0 * share:.1f} %" if share >= 5e-4 else "< 0.1 %"
