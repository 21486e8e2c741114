"""Labelled dataset of arrays over the cells of a grid."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from rocksteady.sweep.cases.axes import Array
from rocksteady.sweep.cases.grid import Grid
from rocksteady.sweep.cases.outputs import Output, words_of

if TYPE_CHECKING:
    import xarray


def labelled(
    grid: Grid,
    outputs: Sequence[Output],
    arrays: Mapping[str, Array],
    attributes: Mapping[str, Any],
) -> "xarray.Dataset":
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
    import xarray

    import rocksteady.sweep.cases.accessor  # noqa: F401 -- registers itself

    return xarray.Dataset(
        {
            output.name: (grid.names, arrays[output.name].reshape(grid.shape), output.attributes)
            for output in outputs
        },
        coords={
            axis.name: (axis.name, axis.points, words_of(axis.long_name, axis.units))
            for axis in grid.axes
        },
        attrs=dict(attributes),
    )
