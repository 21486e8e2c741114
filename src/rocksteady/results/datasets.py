"""Datasets from rows: the numbers of a data frame with dimensions, units and flags."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, kw_only=True)
class ColumnWords:
    """Attributes of a dataset for a column of rows.

    Attributes
    ----------
    long_name, units
        Name and unit of the variable; "1" for a number without a unit, "" where units have no
        meaning.
    flags
        The words that the column may hold, in the order of their codes 0, 1, ...
    missing
        What stands for None among whole numbers; for others nan does.
    """

    long_name: str
    units: str = "1"
    flags: tuple[str, ...] = ()
    missing: int | None = None

    @property
    def attributes(self) -> dict[str, Any]:
        """The attributes of the variable, flags as in the CF conventions."""
        attributes: dict[str, Any] = {"long_name": self.long_name}
        if self.flags:
            codes = np.arange(len(self.flags), dtype=np.int8)
            return attributes | {"flag_values": codes, "flag_meanings": " ".join(self.flags)}
        if self.missing is not None:
            attributes["missing"] = self.missing
        return attributes | ({"units": self.units} if self.units else {})


Variable = tuple[tuple[str, ...], NDArray[Any], dict[str, Any]]
"""Dimensions, values and attributes, as xarray takes them."""


def variables_of(
    rows: Sequence[Mapping[str, Any]], dimension: str, columns: Mapping[str, ColumnWords]
) -> dict[str, Variable]:
    """Return the columns of rows as variables of a dataset along one dimension.

    Parameters
    ----------
    rows
        Each with the same keys.
    dimension
        Its name; a row is a place along it.
    columns
        Name, unit and flags of each column. Columns missing from the rows are left out; without
        rows all are kept.
    """
    names = [name for name in columns if not rows or name in rows[0]]
    return {
        name: (
            (dimension,),
            _column([row[name] for row in rows], columns[name]),
            columns[name].attributes,
        )
        for name in names
    }


def padded(lists: Sequence[Any]) -> NDArray[np.float64]:
    """Return lists of numbers as rows of one array, with nan behind the shorter ones.

    Examples
    --------
    >>> padded([[1.0, 2.0], [3.0]])
    array([[ 1.,  2.],
           [ 3., nan]])
    """
    most = max((len(each) for each in lists), default=0)
    rows = np.full((len(lists), most), math.nan)
    for row, each in zip(rows, lists, strict=True):
        row[: len(each)] = each
    return rows


def _column(values: Sequence[Any], words: ColumnWords) -> NDArray[Any]:
    if words.flags:
        return np.array([words.flags.index(value) for value in values], dtype=np.int8)
    if words.missing is not None:
        filled = [words.missing if value is None else value for value in values]
        return np.array(filled, dtype=np.int32)
    if values and all(isinstance(value, bool | np.bool_) for value in values):
        return np.array(values, dtype=np.bool_)
    return np.array([math.nan if value is None else value for value in values], dtype=np.float64)
