"""Gridded results as CSV, one row per cell."""

import math
from collections.abc import Hashable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.errors import InputError
from rocksteady.model.units import COORDINATES, with_unit
from rocksteady.show.export._slices import beside, parts_of, refuse_others
from rocksteady.show.export.files import save_csv
from rocksteady.sweep.store.chunks import Chunks

if TYPE_CHECKING:
    import xarray

Array = NDArray[Any]

ROWS = 8192
"""Made at once: as objects of Python they take some ten times the room of an array."""


def save_cells(name: str, file: Path, dataset: "xarray.Dataset") -> None:
    """Save a dataset as CSV; errors are as for `write_dataset`, and call the file `name`."""
    refuse_others(dataset)
    outputs = {str(key): array.variable for key, array in dataset.data_vars.items()}
    first = next(iter(outputs.values()))
    for key, array in outputs.items():
        if array.dims != first.dims:
            raise InputError(
                key,
                array.dims,
                f"in a table all outputs are over the same axes, here {first.dims}",
                "save those of the same axes, as dataset[['kind']], or all as NetCDF",
            )
    coordinates: dict[str, Array] = {}
    for key in (*map(str, first.dims), *beside(dataset, first)):
        if key in COORDINATES:
            in_unit, factor = COORDINATES[key]
            values = dataset[key] * factor
            coordinates[in_unit] = _texts(dataset.assign_coords({in_unit: values}), in_unit, first)
        coordinates[key] = _texts(dataset, key, first)
    rows = _rows(coordinates, outputs, parts_of(first))
    save_csv(name, file, [_header(dataset, key) for key in (*coordinates, *outputs)], rows)


def _header(dataset: "xarray.Dataset", key: str) -> str:
    """Return the name of a column, with its unit."""
    return with_unit(key, str(dataset[key].attrs.get("units", ""))) if key in dataset else key


def _texts(dataset: "xarray.Dataset", key: Hashable, cells: "xarray.Variable") -> Array:
    """Return a coordinate as it is written, in a shape that fits the cells: once for all rows."""
    coordinate = dataset[key].variable
    texts = np.empty(coordinate.size, dtype=object)
    texts[:] = [str(value) for value in coordinate.values.ravel().tolist()]
    order = [dim for dim in cells.dims if dim in coordinate.dims]
    lying = coordinate.copy(data=texts.reshape(coordinate.shape)).transpose(*order)
    missing = [axis for axis, dim in enumerate(cells.dims) if dim not in order]
    return np.expand_dims(lying.values, missing)


def _rows(
    coordinates: Mapping[str, Array], outputs: Mapping[str, "xarray.Variable"], parts: Chunks
) -> Iterator[tuple[object, ...]]:
    """Yield the cells in C order."""
    words = {key: _words(array.attrs) for key, array in outputs.items()}
    for part in range(len(parts)):
        region = parts.region(part)
        shape = tuple(side.stop - side.start for side in region)
        columns = [_within(texts, region, shape) for texts in coordinates.values()]
        columns += [array[region].values.ravel() for array in outputs.values()]
        row = [None] * len(coordinates) + list(words.values())
        for begin in range(0, math.prod(shape), ROWS):
            yield from zip(
                *(
                    _spoken(column[begin : begin + ROWS], meanings)
                    for column, meanings in zip(columns, row, strict=True)
                ),
                strict=True,
            )


def _within(texts: Array, region: Sequence[slice], shape: tuple[int, ...]) -> Array:
    """Return the coordinate of each cell of a region."""
    here = tuple(
        slice(None) if length == 1 else side
        for length, side in zip(texts.shape, region, strict=True)
    )
    return np.broadcast_to(texts[here], shape).ravel()


def _words(attributes: Mapping[Any, Any]) -> dict[int, str | None] | None:
    """Return what the flags of a variable mean; None where it has none, or not one for each.

    A count that is infinite has an empty cell.
    """
    if "infinitely_many" in attributes:
        return {int(attributes["infinitely_many"]): None}
    values = np.atleast_1d(attributes.get("flag_values", [])).tolist()
    meanings = str(attributes.get("flag_meanings", "")).split()
    return dict(zip(values, meanings, strict=True)) if 0 < len(values) == len(meanings) else None


def _spoken(column: Array, words: Mapping[int, str | None] | None) -> list[object]:
    """Return numbers as they are, and classes as words, as far as there is one for each."""
    values: list[object] = column.tolist()
    return values if words is None else [words.get(value, value) for value in values]  # type: ignore[call-overload]
