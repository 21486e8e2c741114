"""Axes: the coordinates of a grid, as numbers or names."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rocksteady.arrays import Floats
from rocksteady.errors import InputError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.arrays import UnfitError, numeric_array
from rocksteady.model.checks.bounds import INSIDE
from rocksteady.model.checks.validation import positive, whole_number
from rocksteady.sweep.cases.spacing import in_equal_ratios

LARGEST_COUNT = 2**24
"""Values of an axis that is made by a rule."""
Array = NDArray[Any]

LONGEST_NAME: Final = 200
"""Characters of a name: a store keeps a folder for each."""


@checked
@dataclass(frozen=True, kw_only=True, eq=False)
class Axis:
    """One coordinate of a grid.

    Parameters
    ----------
    name
        An identifier: the name of the dimension, and of the argument of the case function.
    values
        Finite real numbers, or names, shape (points,), one or more, no two of them equal.
    units
        As in the attributes of a dataset; "1" for a number without a unit.
    long_name
        What it is, in words.
    items
        What the names stand for, as the records of a suite, one each: the case function receives
        them in place of the names.  They can be pickled, and are made of dataclasses, numbers,
        texts and arrays, so that a store can compare them.

    Raises
    ------
    InputError
        If the name is no identifier, the values are anything else, or there is not one item for
        each name.

    Examples
    --------
    >>> from rocksteady import Harmonic
    >>> from rocksteady.sweeps import Axis
    >>> Axis(name="amplitude", values=[0.5, 1.0, 2.0]).values
    array([0.5, 1. , 2. ])
    >>> motions = {f"{A:g}": Harmonic(amplitude=A, frequency_ratio=2.0) for A in (1.0, 2.0)}
    >>> axis = Axis(name="motion", values=list(motions), items=tuple(motions.values()))
    >>> axis.at([1])[0].amplitude
    2.0
    """

    name: str
    values: Annotated[ArrayLike | Sequence[str], INSIDE]
    units: str = "1"
    long_name: str = ""
    items: Sequence[object] | None = None

    def __post_init__(self) -> None:
        """Validate, and keep the values as a read-only array."""
        identifier(self.name)
        described(self.long_name, self.units)
        try:
            array = np.asarray(numeric_array(self.name, self.values, None))
        except UnfitError as unfit:
            valid, hint = unfit.args
            raise InputError(self.name, self.values, valid, hint) from None
        except ValueError:  # rows of unequal lengths
            array = np.empty((0, 0))
        if array.dtype.kind not in "iufU" or array.ndim != 1 or array.size == 0:
            raise InputError(
                self.name,
                self.values,
                "an axis is a sequence of one or more real numbers, or of names",
                "give a list or an array of one dimension",
            )
        points = array.copy() if array.dtype.kind == "U" else self._finite(array)
        ordered = np.sort(points)
        again = ordered[1:][ordered[1:] == ordered[:-1]]
        if again.size:
            raise InputError(
                self.name,
                again[0].item(),
                "an axis has each value once",
                "leave the repetition out",
            )
        points.flags.writeable = False
        object.__setattr__(self, "values", points)
        if self.items is not None:
            given: object = self.items
            items = tuple(given) if isinstance(given, list | tuple) else (given,)
            object.__setattr__(self, "items", self._one_each(items, points))

    @classmethod
    def logarithmic(cls, name: str, start: float, stop: float, count: int) -> "Axis":
        """Return an axis of values in equal ratios, both ends included.

        Examples
        --------
        >>> Axis.logarithmic("amplitude", 1.0, 8.0, 4).values
        array([1., 2., 4., 8.])
        """
        first = positive("start", start, hint="give a number above 0")
        last = positive("stop", stop, hint="give a number above 0")
        hint = "give a number of values"
        points = whole_number("count", count, at_least=2, at_most=LARGEST_COUNT, hint=hint)
        return cls(name=name, values=in_equal_ratios(first, last, points))

    def _finite(self, array: Array) -> Floats:
        points = array.astype(np.float64)
        if not np.isfinite(points).all():
            raise InputError(
                self.name,
                points[~np.isfinite(points)][0].item(),
                "the values of an axis are finite",
                "leave nan and infinity out",
            )
        return points

    def _one_each(self, items: tuple[object, ...], points: Array) -> tuple[object, ...]:
        if points.dtype.kind != "U" or len(items) != len(points):
            raise InputError(
                "items",
                Words(f"are {len(items)} for {len(points)} values"),
                "an axis of things has names for its values, and one thing for each",
                "give a name with each",
            )
        return items

    def __len__(self) -> int:
        return len(self.points)

    @property
    def points(self) -> Array:
        """The values, read-only, shape (points,)."""
        return np.asarray(self.values)

    def at(self, indices: ArrayLike) -> Array:
        """Return what the case function receives at some points, shape of the indices."""
        where = indices_of("indices", indices, len(self))
        if self.items is None:
            picked: Array = self.points[where]
            return picked
        values = np.empty(where.shape, dtype=object)
        values.ravel()[:] = [self.items[index] for index in where.ravel().tolist()]
        return values


def indices_of(name: str, given: ArrayLike, count: int) -> Array:
    """Return whole numbers from -count to count - 1."""
    try:
        where = np.asarray(numeric_array(name, given, "iuf"))
    except UnfitError:
        where = np.zeros(1)  # no whole number
    whole = where.dtype.kind in "iu" or where.size == 0
    if not whole or ((where < -count) | (where >= count)).any():
        raise InputError(
            name,
            given,
            f"they must be whole numbers from {-count} to {count - 1}",
            "give an array of integers",
        )
    return where.astype(np.int64)


def described(long_name: object, units: object) -> None:
    """Refuse a description or units that are no text."""
    for name, text in (("long_name", long_name), ("units", units)):
        if not isinstance(text, str):
            raise InputError(name, text, "it must be a text", "give a str")


def identifier(name: object) -> None:
    """Refuse what is not the name of an argument and of a variable, or is too long for one."""
    if not isinstance(name, str) or not name.isidentifier() or len(name) > LONGEST_NAME:
        raise InputError(
            "name",
            name,
            f"it is the name of an argument and variable, up to {LONGEST_NAME} characters",
            "give an identifier, as 'amplitude'",
        )
