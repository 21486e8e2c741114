"""Lazy arrays over the cells of a store, for xarray: only requested cells are read.

Imported only where a store is read, because it needs xarray.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from xarray.backends import BackendArray
from xarray.core.indexing import (
    ExplicitIndexer,
    IndexingSupport,
    VectorizedIndexer,
    explicit_indexing_adapter,
)

from rocksteady.errors import InputError
from rocksteady.sweep.cases.axes import Array
from rocksteady.sweep.store._contents import said
from rocksteady.sweep.store.chunks import Chunks

Index = tuple[Any, ...]
"""A number, a slice or an array of numbers for each axis."""


class OverCells(BackendArray, ABC):
    """An array that is read at an index: of all cells that its parts span, or point by point."""

    shape: tuple[int, ...]
    dtype: "np.dtype[Any]"

    def __getitem__(self, key: ExplicitIndexer) -> Array:
        read = self.points if isinstance(key, VectorizedIndexer) else self.outer
        support = IndexingSupport.VECTORIZED  # for both: slices then have positive steps
        values: Array = explicit_indexing_adapter(key, self.shape, support, read)
        return values

    @abstractmethod
    def outer(self, index: Index) -> Array:
        """Return the cells that the parts of an index span; a number drops its axis."""

    @abstractmethod
    def points(self, index: Index) -> Array:
        """Return the cells at points, whose coordinates are arrays of one shape."""


class Computed(OverCells):
    """Whether cells have been computed, from what is known of their chunks.

    Parameters
    ----------
    chunks
        Chunks of the grid.
    complete
        Whether they have been, shape (chunks,).
    """

    def __init__(self, chunks: Chunks, complete: NDArray[np.bool_]) -> None:
        self._chunks = chunks
        self._complete = complete.reshape(chunks.counts)
        self.shape = chunks.shape
        self.dtype = np.dtype(np.bool_)

    def outer(self, index: Index) -> Array:
        """Return them where the parts of an index meet."""
        values: Array = self._complete
        kept = 0  # axes that come before, as far as they have not been dropped
        for part, length, box in zip(index, self.shape, self._chunks.box, strict=True):
            places = np.arange(length)[part] // box
            values = values.take(places, axis=kept)
            kept += np.ndim(places)
        return values

    def points(self, index: Index) -> Array:
        """Return them at points."""
        places = (
            np.asarray(part) // box for part, box in zip(index, self._chunks.box, strict=True)
        )
        values: Array = self._complete[tuple(places)]
        return values


class Stored(OverCells):
    """An output of a store.

    Parameters
    ----------
    folder, name
        Folder of the store and name of the output, for the error.
    array
        Array of zarr.
    computed
        Which cells are read; the others are what zarr fills in.  None for all.
    """

    def __init__(self, folder: Path, name: str, array: Any, computed: Computed | None) -> None:
        self._folder = folder
        self._name = name
        self._array = array
        self._computed = computed
        self.shape = array.shape
        self.dtype = array.dtype

    def outer(self, index: Index) -> Array:
        """Return the values where the parts of an index meet.

        Raises
        ------
        InputError
            If a file cannot be read, or is not what was written.
        """
        return self._known(lambda: self._array.oindex[index], "outer", index)

    def points(self, index: Index) -> Array:
        """Return the values at points; errors as for `outer`."""
        return self._known(lambda: self._array.vindex[index], "points", index)

    def _known(self, read: Callable[[], Any], how: str, index: Index) -> Array:
        try:
            values = np.asarray(read())
        except (OSError, ValueError, RuntimeError) as error:
            raise InputError(
                "store",
                self._folder,
                f"{self._name} cannot be read: {said(error)}",
                "resume its sweep: chunks that are damaged are computed again",
            ) from error
        if self._computed is None:
            return values
        known = getattr(self._computed, how)(index)
        return np.where(known, values, self.dtype.type(self._array.fill_value))
