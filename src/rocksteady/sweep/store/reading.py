"""Reader of a store: its results as a dataset, and the progress of an unfinished sweep."""

import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.errors import InputError, UnfinishedError, check_installed
from rocksteady.model.checks.arguments import checked
from rocksteady.sweep.cases.outputs import words_of
from rocksteady.sweep.store._checksums import NAMED
from rocksteady.sweep.store._contents import (
    COMPUTED,
    Contents,
    attributes_in,
    contents_of,
    points_of,
)

if TYPE_CHECKING:
    import xarray

RESUME = "resume its sweep, or read its finished part with partial=True"


@checked
def open_store(path: Path | str, *, partial: bool = False) -> "xarray.Dataset":
    """Return the results of a store as a dataset.

    Parameters
    ----------
    path
        Path of the store's folder.
    partial
        Whether an unfinished one is read as well, also while a sweep goes on: what it has at this
        moment.  The result then has one more variable, ``computed``, and in the cells that are not
        computed floats are nan, integers the lowest that their type has, and booleans False.

    Returns
    -------
    xarray.Dataset
        As from `evaluate`; it reads its values where they are used.  An error in one line comes out
        there, if a file has been damaged.

    Raises
    ------
    InputError
        If it is no store of a sweep or cannot be read, or zarr is not installed.
    UnfinishedError
        If it is unfinished, or files of finished chunks are missing, and `partial` is off.

    Warns
    -----
    UserWarning
        If files of finished chunks are missing: their cells count as not computed.

    Examples
    --------
    >>> from rocksteady import open_store
    >>> open_store("maps/nothing.zarr")
    Traceback (most recent call last):
    ...
    rocksteady.errors.InputError: path = 'maps/nothing.zarr' is not valid: there is no such \
folder; name the folder that a sweep wrote, as map.zarr
    """
    folder = Path(path)
    if attributes_in(folder) is None:
        what = "it is no store of a sweep" if folder.exists() else "there is no such folder"
        raise _refused(path, what, NAMED)
    check_installed(lambda valid, hint: _refused(path, valid, hint), "stores", "zarr")
    hint = "take a copy of it, or compute it again"
    contents = contents_of(folder, lambda valid: _refused(path, valid, hint))
    flagged = contents.flagged()
    complete = contents.complete(flagged)
    lost = int(flagged.sum() - complete.sum())
    files = f"files of {lost} of {flagged.sum()} finished chunks are missing"
    if partial:
        if lost:
            warnings.warn(f"{folder}: {files}: they count as not computed", stacklevel=2)
        return dataset_of(contents, complete)
    if not complete.all():
        valid = files if lost else _progress(contents, complete)
        raise UnfinishedError("path", path, valid, RESUME)
    return dataset_of(contents)


def _refused(path: Path | str, valid: str, hint: str) -> InputError:
    return InputError("path", path, valid, hint)


def finished_cells(folder: Path) -> tuple[int, int]:
    """Return how many cells of a store are finished, and how many it has.

    Raises
    ------
    InputError
        If it cannot be read.
    """
    contents = contents_of(folder, lambda valid: _refused(folder, valid, "compute it again"))
    return _cells(contents, contents.complete(contents.flagged())), contents.chunks.size


def _cells(contents: Contents, chunks: NDArray[np.bool_]) -> int:
    """Return how many cells some chunks have."""
    ranges = [contents.chunks.cells(chunk) for chunk in np.flatnonzero(chunks).tolist()]
    return sum(stop - first for first, stop in ranges)


def _progress(contents: Contents, complete: NDArray[np.bool_]) -> str:
    """Return how far a sweep has come."""
    chunks, cells = contents.chunks, _cells(contents, complete)
    return f"{complete.sum()} of {len(chunks)} chunks, {cells} of {chunks.size} cells, are finished"


def dataset_of(contents: Contents, complete: NDArray[np.bool_] | None = None) -> "xarray.Dataset":
    """Return the results of a store as a dataset that reads them where they are used.

    Parameters
    ----------
    contents
        Contents of the store.
    complete
        Which chunks to read, of an unfinished one; the others are not looked at, and the dataset
        marks their cells in ``computed``.
    """
    import xarray
    from xarray.core.indexing import LazilyIndexedArray

    import rocksteady.sweep.cases.accessor  # noqa: F401 -- registers itself
    from rocksteady.sweep.store._lazy import Computed, Stored

    dims = tuple(contents.axes)
    # What is read at once is best a chunk or several.
    encoding = {"preferred_chunks": dict(zip(dims, contents.chunks.box, strict=True))}
    computed = None if complete is None else Computed(contents.chunks, complete)
    variables: dict[str, Any] = {
        name: (
            dims,
            LazilyIndexedArray(Stored(contents.folder, name, array, computed)),
            _typed(array.attrs.asdict(), array.dtype),
            encoding,
        )
        for name, array in contents.outputs.items()
    }
    if computed is not None:
        words = words_of("whether the cell has been computed", "1")
        variables[COMPUTED] = (dims, LazilyIndexedArray(computed), words, encoding)
    axes = {
        name: (name, points_of(array), array.attrs.asdict())
        for name, array in contents.axes.items()
    }
    dataset = xarray.Dataset(variables, coords=axes, attrs=contents.attributes)
    dataset.encoding["source"] = str(contents.folder)  # as in files that xarray opens
    return dataset


def _typed(attributes: dict[str, Any], dtype: "np.dtype[Any]") -> dict[str, Any]:
    """Return the attributes of an output with its flags in its own type, as conventions ask."""
    flags = attributes.get("flag_values")
    typed = {} if flags is None else {"flag_values": np.array(flags, dtype=dtype)}
    return attributes | typed
