"""Axes, the grid that they span, and what is computed in each of its cells."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rocksteady.errors import InputError

Floats = NDArray[np.float64]

MOST_CELLS = 50_000_000
"""Of a grid: its results have to fit into memory."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Axis:
    """One coordinate of a grid.

    Parameters
    ----------
    name
        An identifier: the name of the dimension, and of the argument of the case function.
    values
        Finite real numbers, shape (points,), one or more, no two of them equal.
    units
        As in the attributes of a dataset; "1" for a number without a unit.
    long_name
        What it is, in words.

    Raises
    ------
    InputError
        If the name is no identifier, or the values are anything else.

    Examples
    --------
    >>> Axis(name="amplitude", values=[0.5, 1.0, 2.0]).values
    array([0.5, 1. , 2. ])
    """

    name: str
    values: ArrayLike
    units: str = "1"
    long_name: str = ""

    def __post_init__(self) -> None:
        """Validate, and keep the values as an array that nobody changes."""
        _identifier(self.name)
        array = np.asarray(self.values)
        if array.dtype.kind not in "iuf" or array.ndim != 1 or array.size == 0:
            raise InputError(
                name=self.name,
                value=self.values,
                valid="an axis is a sequence of one or more real numbers",
                hint="give a list or an array of one dimension",
            )
        points = array.astype(np.float64)
        if not np.isfinite(points).all():
            raise InputError(
                name=self.name,
                value=points[~np.isfinite(points)][0].item(),
                valid="the values of an axis are finite",
                hint="leave nan and infinity out",
            )
        ordered = np.sort(points)
        again = ordered[1:][ordered[1:] == ordered[:-1]]
        if again.size:
            raise InputError(
                name=self.name,
                value=again[0].item(),
                valid="an axis has each value once",
                hint="leave the repetition out",
            )
        points.flags.writeable = False
        object.__setattr__(self, "values", points)

    def __len__(self) -> int:
        return len(self.points)

    @property
    def points(self) -> Floats:
        """The values, read-only, shape (points,)."""
        points: Floats = np.asarray(self.values)
        return points


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
        If there is none, a name comes twice, or there are more than fifty million cells.

    Examples
    --------
    >>> grid = Grid(
    ...     axes=(Axis(name="amplitude", values=[1.0, 2.0]), Axis(name="phase", values=[0, 1, 2]))
    ... )
    >>> grid.shape, grid.size
    ((2, 3), 6)
    >>> grid.cells(2, 5)["amplitude"]
    array([1., 2., 2.])
    """

    axes: Sequence[Axis]

    def __post_init__(self) -> None:
        """Validate."""
        given: object = self.axes
        if (
            not isinstance(given, tuple | list)
            or not given
            or not all(isinstance(axis, Axis) for axis in given)
        ):
            raise InputError(
                name="axes",
                value=given,
                valid="a grid has one axis or more",
                hint="give axes=(Axis(...), Axis(...))",
            )
        object.__setattr__(self, "axes", tuple(given))
        _each_once("axes", [axis.name for axis in self.axes])
        if self.size > MOST_CELLS:
            raise InputError(
                name=self.axes[0].name,
                value=" x ".join(f"{len(axis)}" for axis in self.axes) + " cells",
                valid=f"a grid has at most {MOST_CELLS} cells",
                hint="take fewer points along its axes",
            )

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

    def cells(self, first: int, stop: int) -> dict[str, Floats]:
        """Return the coordinates of the cells of a range, shape (stop - first,) for each axis."""
        indices = np.unravel_index(np.arange(first, stop), self.shape)
        return {
            axis.name: axis.points[index] for axis, index in zip(self.axes, indices, strict=True)
        }


@dataclass(frozen=True, kw_only=True, eq=False)
class Output:
    """What is computed in each cell.

    Parameters
    ----------
    name
        An identifier: the variable of the result.
    dtype
        Of its array.
    long_name, units
        As for `Axis`.
    flags
        Of an integer that stands for a class: what each value means.

    Raises
    ------
    InputError
        If the name is no identifier, or flags are given to what is no integer.

    Examples
    --------
    >>> kind = Output(name="kind", dtype=np.int8, flags={0: "rest", 1: "overturned"})
    >>> kind.attributes["flag_meanings"]
    'rest overturned'
    """

    name: str
    dtype: Any = np.float64
    long_name: str = ""
    units: str = "1"
    flags: Mapping[int, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Validate."""
        _identifier(self.name)
        object.__setattr__(self, "dtype", np.dtype(self.dtype))
        if self.flags and self.dtype.kind not in "iu":
            raise InputError(
                name="flags",
                value=self.name,
                valid=f"only integers have flags, and this output is {self.dtype}",
                hint="give it an integer dtype",
            )

    @property
    def attributes(self) -> dict[str, Any]:
        """What a dataset says of it, flags as in the CF conventions."""
        found = attributes_of(self.long_name, self.units)
        if self.flags:
            found["flag_values"] = np.array(list(self.flags), dtype=self.dtype)
            found["flag_meanings"] = " ".join(
                meaning.replace(" ", "_") for meaning in self.flags.values()
            )
        return found


def attributes_of(long_name: str, units: str) -> dict[str, Any]:
    """Return the attributes of a variable that has these."""
    return {"long_name": long_name, "units": units} if long_name else {"units": units}


def _identifier(name: object) -> None:
    if not isinstance(name, str) or not name.isidentifier():
        raise InputError(
            name="name",
            value=name,
            valid="it is the name of an argument and of a variable",
            hint="give an identifier, as 'amplitude'",
        )


def _each_once(what: str, names: Sequence[str]) -> None:
    """Refuse a name that comes twice."""
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise InputError(
            name=what,
            value=twice[0],
            valid="no two of them may have one name",
            hint="rename one, or leave it out",
        )


def outputs_of(outputs: Sequence[Output], grid: Grid) -> tuple[Output, ...]:
    """Return the outputs, one or more, whose names are theirs alone.

    Raises
    ------
    InputError
        If there is none, or a name is that of another or of an axis.
    """
    found = tuple(outputs)
    if not found or not all(isinstance(output, Output) for output in found):
        raise InputError(
            name="outputs",
            value=outputs,
            valid="there is one or more",
            hint="give outputs=(Output(...), Output(...))",
        )
    _each_once("outputs", [*grid.names, *(output.name for output in found)])
    return found
