"""Basis of all export formats: checks of a dataset, and how much is read at once.

Files are written part by part, so that a result that is larger than memory can be exported.  25
million cells of seven outputs (1.2 GB) take 145 MB of memory; `Dataset.to_netcdf` takes 1.4 GB.
"""

import math
from typing import TYPE_CHECKING

import numpy as np

from rocksteady.errors import InputError
from rocksteady.sweep.store.chunks import MOST, Chunks

if TYPE_CHECKING:
    import xarray


def refuse_others(dataset: object) -> None:
    """Refuse what is no dataset, one without values, and values that not every format can hold."""
    import xarray

    if (
        not isinstance(dataset, xarray.Dataset)
        or not dataset.data_vars
        or 0 in dataset.sizes.values()
    ):
        raise InputError(
            "dataset",
            dict(dataset.sizes) if isinstance(dataset, xarray.Dataset) else dataset,
            "it is an xarray.Dataset of one variable or more, in one cell or more",
            "give the result of a sweep",
        )
    for key, array in dataset.variables.items():
        kind, size = array.dtype.kind, array.dtype.itemsize
        texts = kind in "UT" or (kind == "O" and all(isinstance(x, str) for x in array.values.flat))
        if not (texts or kind in "biu" or (kind == "f" and size <= 8)):
            raise InputError(
                str(key),
                str(array.dtype),
                "a file has booleans, integers, floats of up to 64 bits and texts",
                "convert it, or leave it out",
            )


def parts_of(array: "xarray.Variable") -> Chunks:
    """Return what is read of a variable at once: some ten thousand cells, in whole chunks."""
    preferred = array.encoding.get("preferred_chunks", {})
    cells = math.prod(int(np.max(preferred.get(dim, 1))) for dim in array.dims)
    return Chunks.of(array.shape, cells * max(1, MOST // cells))


def beside(dataset: "xarray.Dataset", array: "xarray.Variable") -> list[str]:
    """Return the coordinates of a variable that are not of an axis: conventions list them."""
    return [
        str(key)
        for key, coordinate in dataset.coords.items()
        if key not in dataset.dims and set(coordinate.dims) <= set(array.dims)
    ]
