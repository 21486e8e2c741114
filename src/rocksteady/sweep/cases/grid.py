"""Grid of cells spanned by axes, numbered in C order."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated

import numpy as np
from numpy.typing import NDArray

from rocksteady.errors import InputError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import INSIDE
from rocksteady.model.checks.validation import whole_number, within_memory
from rocksteady.sweep.cases.axes import Array, Axis, indices_of

MOST_CELLS = 10**12
"""Of a grid: the number of a cell is exact in every arithmetic that it meets."""


@checked
@dataclass(frozen=True, kw_only=True, eq=False)
class Grid:
    """The cells that axes span, numbered in C order: the last axis runs fastest.

    Parameters
    ----------
    axes
        One or more, in the order of the result's dimensions; no two of one name.

    Raises
    ------
    InputError
        If there is none, a name comes twice, or there are more than 1e12 cells.

    Examples
    --------
    >>> from rocksteady.sweeps import Axis, Grid
    >>> grid = Grid(
    ...     axes=(Axis(name="amplitude", values=[1.0, 2.0]), Axis(name="phase", values=[0, 1, 2]))
    ... )
    >>> grid.shape, grid.size
    ((2, 3), 6)
    >>> grid.cells(2, 5)["amplitude"]
    array([1., 2., 2.])
    """

    axes: Annotated[Sequence[Axis], INSIDE]

    def __post_init__(self) -> None:
        """Validate."""
        given: object = self.axes
        if (
            not isinstance(given, tuple | list)
            or not given
            or not all(isinstance(axis, Axis) for axis in given)
        ):
            raise InputError(
                "axes", given, "a grid has one axis or more", "give axes=(rs.sweeps.Axis(...),)"
            )
        object.__setattr__(self, "axes", tuple(given))
        each_once("axes", [axis.name for axis in self.axes])
        within("1e12", self, MOST_CELLS, hint="take fewer points along its axes")

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the axes."""
        return tuple(axis.name for axis in self.axes)

    @property
    def shape(self) -> tuple[int, ...]:
        """Points of each axis."""
        return tuple(len(axis) for axis in self.axes)

    @property
    def size(self) -> int:
        """Number of cells."""
        return math.prod(self.shape)

    def cells(self, first: int, stop: int) -> dict[str, Array]:
        """Return the coordinates of the cells of a range, shape (stop - first,) for each axis."""
        hint = "give the number of a cell"
        low = whole_number("first", first, at_least=0, at_most=self.size, hint=hint)
        high = whole_number("stop", stop, at_least=0, at_most=self.size, hint=hint)
        within_memory("stop", stop, high - low, hint="take fewer cells at a time")
        return self.at(np.arange(low, high, dtype=np.int64))

    def at(self, numbers: NDArray[np.int64]) -> dict[str, Array]:
        """Return the coordinates of cells by their numbers, shape (cells,) for each axis."""
        cells = indices_of("numbers", numbers, self.size) % self.size
        places = np.unravel_index(cells, self.shape)
        return {axis.name: axis.at(index) for axis, index in zip(self.axes, places, strict=True)}


def within(most: str, grid: Grid, cells: int, *, hint: str) -> None:
    """Refuse a grid of more cells than a largest number, written as `most`."""
    if grid.size > cells:
        raise InputError(
            grid.axes[0].name,
            Words("spans " + " x ".join(f"{len(axis)}" for axis in grid.axes) + " cells"),
            f"a grid has at most {most} cells here",
            hint,
        )


def each_once(what: str, names: Sequence[str]) -> None:
    """Refuse a name that comes twice."""
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise InputError(
            what, twice[0], "no two of them may have one name", "rename one, or leave it out"
        )
