"""Cells of a sweep: arrays over the axes of a grid, which become a dataset only where needed.

Importing xarray takes longer than computing many cells.  Cells need NumPy alone, and are read as a
dataset is.
"""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from rocksteady.sweep.cases.axes import Array
from rocksteady.sweep.cases.grid import Grid
from rocksteady.sweep.cases.outputs import Output, words_of

if TYPE_CHECKING:
    import xarray


@dataclass(frozen=True, eq=False)
class Variable:
    """Values over some axes, read as those of an `xarray.DataArray`."""

    dims: tuple[str, ...]
    values: Array
    attrs: Mapping[str, Any]

    @property
    def size(self) -> int:
        """Number of values."""
        return self.values.size

    def __getitem__(self, rows: int | slice) -> "Variable":
        dims = self.dims[1:] if isinstance(rows, int) else self.dims
        return Variable(dims, np.asarray(self.values[rows]), self.attrs)

    def transpose(self, *axes: Any) -> "Variable":
        """Return the values with axes in this order; `...` stands for all others."""
        rest = [name for name in self.dims if name not in axes]
        dims = tuple(name for axis in axes for name in (rest if axis is ... else [axis]))
        values = self.values.transpose([self.dims.index(name) for name in dims])
        return Variable(dims, values, self.attrs)

    def without(self, axes: Collection[str]) -> "Variable":
        """Return the first values along some axes."""
        first = tuple(0 if name in axes else slice(None) for name in self.dims)
        dims = tuple(name for name in self.dims if name not in axes)
        return Variable(dims, np.asarray(self.values[first]), self.attrs)


@dataclass(frozen=True, eq=False)
class Cells:
    """Variables over axes, read as those of an `xarray.Dataset`."""

    data_vars: dict[str, Variable]
    coords: dict[str, Variable]
    attrs: dict[str, Any]
    encoding: dict[str, Any] = field(default_factory=dict)

    @property
    def sizes(self) -> dict[str, int]:
        """Number of points of each axis."""
        variables = (*self.data_vars.values(), *self.coords.values())
        return {
            k: n for each in variables for k, n in zip(each.dims, each.values.shape, strict=True)
        }

    def __getitem__(self, name: str) -> Variable:
        return self.data_vars[name] if name in self.data_vars else self.coords[name]

    def __contains__(self, name: str) -> bool:
        return name in self.data_vars or name in self.coords

    def without(self, axes: Collection[str]) -> "Cells":
        """Return the first cells along some axes."""
        variables, coords = (
            {name: each.without(axes) for name, each in some.items()}
            for some in (self.data_vars, self.coords)
        )
        return Cells(variables, coords, self.attrs, self.encoding)

    def load(self) -> "Cells":
        """Return the cells, which are in memory."""
        return self


if TYPE_CHECKING:
    Labelled = Cells | xarray.Dataset
    """What a sweep leaves: cells in memory, or a dataset that reads a store where it is used."""


def cells_of(
    grid: Grid,
    outputs: Sequence[Output],
    arrays: Mapping[str, Array],
    attributes: Mapping[str, Any],
) -> Cells:
    """Return arrays of shape (cells,) over the axes of the grid.

    Parameters
    ----------
    grid, outputs
        What the arrays are.
    arrays
        One for each output.
    attributes
        From `rocksteady.sweep.cases.inputs.attributes_of`.
    """
    return Cells(
        {
            output.name: Variable(
                grid.names, arrays[output.name].reshape(grid.shape), output.attributes
            )
            for output in outputs
        },
        {
            axis.name: Variable((axis.name,), axis.points, words_of(axis.long_name, axis.units))
            for axis in grid.axes
        },
        dict(attributes),
    )
