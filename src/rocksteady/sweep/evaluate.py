"""The one loop over cases: deals a grid out, puts the answers together and labels them."""

from collections.abc import Callable, Mapping, Sequence
from importlib.metadata import version
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.errors import InputError
from rocksteady.model.validation import whole_number
from rocksteady.sweep.axes import Grid, Output, attributes_of, outputs_of
from rocksteady.sweep.executors import EXECUTORS, Piece, validated_executor, validated_workers

if TYPE_CHECKING:
    import xarray

Array = NDArray[Any]
Cases = Callable[..., Mapping[str, Array]]
Done = Callable[[int], object]
"""Called in the calling thread with the number of cells that have just been finished."""

CHUNK = 64
"""Cells that one call of the case function takes, where nobody says.  An interruption waits for the
pieces under way, so that they are short; and a slow corner of the grid is many of them, which
leaves no core idle."""
LARGEST_CHUNK = 2**20


def evaluate(
    cases: Cases,
    grid: Grid,
    outputs: Sequence[Output],
    *,
    executor: str = "threads",
    workers: int | None = None,
    chunk: int = CHUNK,
    numbered: str | None = None,
    done: Done | None = None,
    attributes: Mapping[str, Any] | None = None,
) -> "xarray.Dataset":
    """Evaluate a function of every cell of a grid.

    The result is the same to the last bit for every executor, number of workers and chunk, as long
    as the case function treats its cells one by one.

    Parameters
    ----------
    cases
        Takes the coordinates of some cells, an array of shape (cells,) for each axis under the name
        of the axis, and returns a mapping with an array of shape (cells,) for each output.  A
        function at module level or a `functools.partial` of one, so that other processes can be
        told which; it is called from several threads at once.
    grid
        The cells.
    outputs
        What it returns.
    executor
        "threads" (default) or "serial".
    workers
        How many threads; by default as many as there are cores for this process.
    chunk
        Cells that one call takes.
    numbered
        Name of one more argument of the case function: the numbers of its cells in the grid, in C
        order, int64.  A random number that is keyed on it does not depend on the chunks.
    done
        Called in this thread with the number of cells that have just been finished.
    attributes
        Of the result: what it was computed from.

    Returns
    -------
    xarray.Dataset
        The outputs over the axes, which are its coordinates, with units and long names; integer
        classes with ``flag_values`` and ``flag_meanings``.  Its attributes are those given, and
        the package's version.

    Raises
    ------
    InputError
        If an argument is not valid, or the case function does not return what it should.  An
        exception of its own comes out as it is, with a note that says in which cells.

    Examples
    --------
    >>> from rocksteady.sweep.axes import Axis
    >>> def area(width, height):
    ...     return {"area": width * height}
    >>> grid = Grid(
    ...     axes=(Axis(name="width", values=[1, 2], units="m"), Axis(name="height", values=[3, 4]))
    ... )
    >>> found = evaluate(area, grid, [Output(name="area", units="m2")])
    >>> found.area.values
    array([[3., 4.],
           [6., 8.]])
    """
    wanted = outputs_of(outputs, grid)
    run = EXECUTORS[validated_executor(executor)]
    many = validated_workers(workers)
    size = whole_number(
        "chunk", chunk, at_least=1, at_most=LARGEST_CHUNK, hint="give a number of cells, as 64"
    )
    arrays = {output.name: np.empty(grid.size, dtype=output.dtype) for output in wanted}

    def answer(piece: Piece) -> dict[str, Array]:
        return _answer(cases, grid, wanted, numbered, piece)

    pieces = [(first, min(first + size, grid.size)) for first in range(0, grid.size, size)]
    for (first, stop), found in run(answer, pieces, many):
        assert isinstance(found, dict)
        for name, array in found.items():
            arrays[name][first:stop] = array
        if done is not None:
            done(stop - first)
    return _labelled(grid, wanted, arrays, attributes or {})


def _answer(
    cases: Cases, grid: Grid, outputs: Sequence[Output], numbered: str | None, piece: Piece
) -> dict[str, Array]:
    """Return what the case function finds in the cells of a piece."""
    cells: dict[str, Array] = dict(grid.cells(*piece))
    if numbered is not None:
        cells[numbered] = np.arange(*piece, dtype=np.int64)
    try:
        found = cases(**cells)
        return {output.name: _checked(output, found, piece) for output in outputs}
    except Exception as error:
        where = ", ".join(
            f"{name} {cells[name][0]:.15g} to {cells[name][-1]:.15g}" for name in grid.names
        )
        error.add_note(f"in cells {piece[0]} to {piece[1] - 1} of {grid.size}: {where}")
        raise


def _checked(output: Output, found: object, piece: Piece) -> Array:
    """Return one output of the case function as what it is declared to be."""
    if not isinstance(found, Mapping) or output.name not in found:
        raise InputError(
            name="cases",
            value=sorted(found) if isinstance(found, Mapping) else found,
            valid=f"it must return a mapping with the output {output.name!r}",
            hint="return an array for each output, or leave the output out",
        )
    array = np.asarray(found[output.name])
    shape = (piece[1] - piece[0],)
    if array.shape != shape:
        raise InputError(
            name=output.name,
            value=array.shape,
            valid=f"an output has the shape of the cells, here {shape}",
            hint="return one value for each cell",
        )
    if not np.can_cast(array.dtype, output.dtype, casting="same_kind"):
        raise InputError(
            name=output.name,
            value=str(array.dtype),
            valid=f"it must fit {output.dtype}, as which it is declared",
            hint="change the dtype of the output, or convert the array",
        )
    return array


def _labelled(
    grid: Grid,
    outputs: Sequence[Output],
    arrays: Mapping[str, Array],
    attributes: Mapping[str, Any],
) -> "xarray.Dataset":
    """Return arrays over all cells as a dataset."""
    import xarray

    return xarray.Dataset(
        {
            output.name: (grid.names, arrays[output.name].reshape(grid.shape), output.attributes)
            for output in outputs
        },
        coords={
            axis.name: (axis.name, axis.points, attributes_of(axis.long_name, axis.units))
            for axis in grid.axes
        },
        attrs={**attributes, "rocksteady_version": version("rocksteady")},
    )
