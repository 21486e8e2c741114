"""Contents of a store: a zarr group that any zarr reader opens.

It has an array for each axis and each output, and ``done``, the checksums of each finished chunk of
cells, which are on the disk after its files.
"""

import json
from collections.abc import Callable, Iterable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.errors import InputError, RocksteadyError
from rocksteady.small_files import content_of
from rocksteady.sweep.cases.axes import Array
from rocksteady.sweep.cases.inputs import digest_of
from rocksteady.sweep.store._checksums import NAMED, identity_of
from rocksteady.sweep.store.chunks import Chunks

if TYPE_CHECKING:
    import zarr

GROUP = "zarr.json"
"""Description of a group, and of an array."""
DONE = "done"
CHUNK = "chunk"
"""Dimension of the checksums."""
COMPUTED = "computed"
"""Whether cells are finished, in an unfinished result."""
TAKEN = (DONE, CHUNK, COMPUTED)
OUTPUTS = "outputs"
"""Attribute of the checksums: names of the outputs in their order, which a folder does not keep."""
SCHEMA = "schema"
"""Attribute of the checksums: which form of stores this is."""
FORM = "rocksteady/store/1"
"""The only form so far: a later one has another number, and says how it differs."""
LOCK = "lock"
"""A file beside the checksums: zarr would complain of it beside the arrays."""


@dataclass(frozen=True, kw_only=True)
class Contents:
    """The arrays of a store.

    Attributes
    ----------
    folder
        Folder of the store.
    attributes
        Attributes of the result.
    axes, outputs
        Arrays by their names, in the order of the sweep.
    flags
        Checksums of the files of each finished chunk, as many as there are outputs, 0 of others.
        Those of a store of an earlier version are flags, one per chunk.
    chunks
        The cells of each.
    """

    folder: Path
    attributes: dict[str, Any]
    axes: "dict[str, zarr.Array[Any]]"
    outputs: "dict[str, zarr.Array[Any]]"
    flags: "zarr.Array[Any]"
    chunks: Chunks

    @property
    def inputs(self) -> dict[str, Any]:
        """What its results follow from."""
        inputs: dict[str, Any] = json.loads(self.attributes["inputs"])
        return inputs

    def files(self, chunk: int) -> list[Path]:
        """Return the files of a chunk, its checksums first."""
        place = self.chunks.place(chunk)
        return [self._flag(chunk)] + [
            self.folder / name / array.metadata.encode_chunk_key(place)
            for name, array in self.outputs.items()
        ]

    def _flag(self, chunk: int) -> Path:
        return self.folder / DONE / self.flags.metadata.encode_chunk_key((chunk,))

    def sums(self) -> NDArray[np.uint64]:
        """Return the checksums, shape (chunks, outputs); 0 where they cannot be read."""
        dtype, (length,) = self.flags.dtype, self.flags.chunks
        sums = np.zeros((len(self.chunks), length), dtype=np.uint64)
        for chunk, row in enumerate(sums):
            with suppress(InputError):
                content = content_of(self._flag(chunk), "store", NAMED)
                if len(content) == dtype.itemsize * length:
                    row[:] = np.frombuffer(content, dtype)
        return sums

    def checked_files(self) -> dict[str, tuple[str, int, int]]:
        """Return output, chunk and checksum of each file of a finished chunk, by relative path."""
        sums = self.sums()
        return {
            f"{name}/{array.metadata.encode_chunk_key(self.chunks.place(chunk))}": (
                name,
                chunk,
                int(sums[chunk, number]),
            )
            for number, (name, array) in enumerate(self.outputs.items())
            for chunk in sums[:, number].nonzero()[0].tolist()
        }

    def flagged(self) -> NDArray[np.bool_]:
        """Return which chunks are marked as finished."""
        return np.asarray((self.sums() != 0).all(axis=1))

    def complete(self, flagged: NDArray[np.bool_]) -> NDArray[np.bool_]:
        """Return which of the finished chunks have all their files.

        What is in the files is not looked at.  Without this, zarr would take values for nothing
        where a file is missing.
        """
        return np.array(
            [
                flag and all(file.is_file() for file in self.files(chunk))
                for chunk, flag in enumerate(flagged.tolist())
            ]
        )


def attributes_in(folder: Path) -> dict[str, Any] | None:
    """Return the attributes of a store; None where that is none, or they cannot be read."""
    try:
        attributes = json.loads(content_of(folder / GROUP, "store", NAMED))["attributes"]
        json.loads(attributes["inputs"])
    except (ValueError, LookupError, TypeError):
        return None
    return dict(attributes)


def contents_of(folder: Path, refused: Callable[[str], RocksteadyError]) -> Contents:
    """Return what lies in a store.

    Parameters
    ----------
    folder
        Folder of a store.
    refused
        Makes the error to raise where it cannot be read, from a clause with the reason.
    """
    import zarr

    from rocksteady.sweep.store._chunk_files import ChunkFiles

    try:
        files = ChunkFiles(folder, read_only=True)
        group = zarr.open_group(files, mode="r", zarr_format=3, use_consolidated=False)
        flags: Any = group[DONE]
        if (form := flags.attrs.get(SCHEMA, FORM)) != FORM:
            message = f"its form is {form}, and this version of rocksteady reads {FORM}"
            raise ValueError(message)
        names = list(flags.attrs[OUTPUTS])
        first: Any = group[names[0]]
        chunks = Chunks(shape=first.shape, box=first.chunks)
        outputs = {name: zarr.open_array(files, path=name, mode="r") for name in names}
        axes: dict[str, Any] = {name: group[name] for name in first.metadata.dimension_names}
        contents = Contents(
            folder=folder,
            attributes=group.attrs.asdict(),
            axes=axes,
            outputs=outputs,
            flags=flags,
            chunks=chunks,
        )
        for name, array in axes.items():
            if digest_of(points_of(array)) != contents.inputs["axes"][name]["sha256"]:
                message = f"the values of {name} differ from the written ones"
                raise ValueError(message)
        if flags.dtype != np.bool_:
            files.check(contents.checked_files(), identity_of(contents.inputs, chunks.box))
    except Exception as error:
        raise refused(f"it cannot be read: {said(error)}") from error
    return contents


def points_of(array: Any) -> Array:
    """Return the values of an axis, names as NumPy writes them."""
    points = np.asarray(array[:])
    return np.array(points.tolist()) if points.dtype.kind in "OT" else points


def refuse_taken(names: Iterable[str]) -> None:
    """Refuse axes and outputs that have the names of what is in a store beside them.

    Raises
    ------
    InputError
        If one has.
    """
    for name in names:
        if name in TAKEN:
            raise InputError(
                "name",
                name,
                f"a store has {', '.join(TAKEN)} of its own",
                "rename the axis or the output",
            )


def said(error: Exception) -> str:
    """Return the message of an error, in one line."""
    text = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
    return " ".join(text.split()) or type(error).__name__
