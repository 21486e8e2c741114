"""Gridded results as NetCDF-4."""

import math
from collections.abc import Mapping
from functools import partial
from io import FileIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from rocksteady.errors import InputError, OutputError, check_installed
from rocksteady.show.export._slices import beside, parts_of, refuse_others
from rocksteady.show.export.files import save_whole
from rocksteady.sweep.store.chunks import MOST, Chunks

if TYPE_CHECKING:
    import xarray


def check_writer(name: str, file: Path) -> None:
    """Refuse, before anything is computed, NetCDF without the packages that write it."""
    check_installed(partial(OutputError, name, file), "stores", "h5netcdf", "h5py")


def save_netcdf(name: str, file: Path, dataset: "xarray.Dataset") -> None:
    """Save a dataset as NetCDF-4; errors are as for `write_dataset`, and call the file `name`."""
    check_writer(name, file)
    import h5netcdf

    refuse_others(dataset)
    attributes = {key: _written(array.attrs) for key, array in dataset.variables.items()}
    overall = _written(dataset.attrs)

    def write(target: Path) -> None:
        with _Quiet(target, "w+") as place, h5netcdf.File(place, "w") as stream:
            stream.dimensions = {str(dim): size for dim, size in dataset.sizes.items()}
            for key, array in dataset.variables.items():
                variable = _filled(stream, str(key), array, place)
                variable.attrs.update(attributes[key])
                named = [] if key in dataset.coords else beside(dataset, array)
                if named:
                    variable.attrs["coordinates"] = " ".join(named)
            stream.attrs.update(overall)
        place.check()

    save_whole(name, file, write)


def _stored_type(array: "xarray.Variable") -> Any:
    """Return the type that a variable has in NetCDF, which has no booleans and no short floats."""
    import h5py

    match array.dtype.kind:
        case "b":
            return np.dtype(np.int8)
        case "i" | "u":
            return array.dtype
        case "f":
            return np.result_type(array.dtype, np.float32)
        case _:
            return h5py.string_dtype()


def _written(attributes: Mapping[Any, Any]) -> dict[str, Any]:
    """Return attributes in numbers, texts and arrays of them: a boolean is 0 or 1."""
    encoding: dict[str, Any] = {}
    for key, value in attributes.items():
        array = np.asarray(value)
        if array.dtype.kind not in "biufU" or array.ndim > 1 or array.size == 0:
            raise InputError(
                str(key),
                value,
                "an attribute of NetCDF is a number, a text or several of them",
                "convert it, or leave it out",
            )
        boolean = array.dtype.kind == "b"
        encoding[str(key)] = array.astype(np.int8)[()] if boolean else value
    return encoding


def _filled(stream: Any, key: str, array: "xarray.Variable", place: "_Quiet") -> Any:
    """Return a new variable of a file, with its values written part by part."""
    parts = parts_of(array)
    box = Chunks.of(array.shape, min(MOST, math.prod(parts.box))).box
    dtype = _stored_type(array)
    # Scalars are neither in chunks nor compressed; texts are kept elsewhere and gain nothing.
    packed = array.ndim > 0 and array.dtype.kind in "biuf"
    options = {"chunks": box, "compression": "gzip", "compression_opts": 1, "shuffle": True}
    dims = [str(dim) for dim in array.dims]
    variable = stream.create_variable(key, dims, dtype, **(options if packed else {}))
    if array.dtype.kind == "b":
        variable.attrs["dtype"] = "bool"  # by which xarray recognises it
    for part in range(len(parts)):
        region = parts.region(part)
        values = array[region].values
        variable[region] = values.astype(dtype if array.dtype.kind in "biuf" else object)
        place.check()
    return variable


class _Quiet(FileIO):
    """A file that holds back the first error of writing until `check` raises it.

    HDF5 does not survive one: on a full disk it prints thousands of lines and crashes in the end.
    """

    _error: OSError | None = None

    def write(self, data: Any, /) -> int:
        """Write all, or nothing more after an error."""
        left = memoryview(data)
        size = len(left)
        try:
            while left and self._error is None:
                left = left[super().write(left) :]
        except OSError as error:
            self._error = error
        return size

    def truncate(self, size: int | None = None, /) -> int:
        """Bring the file to a size, or do nothing more after an error."""
        try:
            if self._error is None:
                return super().truncate(size)
        except OSError as error:
            self._error = error
        return size or 0

    def check(self) -> None:
        """Raise the error that a write has had."""
        if self._error is not None:
            raise self._error
