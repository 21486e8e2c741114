"""What lies in a store: a zarr group that any reader of zarr opens.

It has an array for each axis and each output, and ``done``, a flag for each chunk of cells: what is
flagged was written before its flag.
"""

import json
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from rocksteady.errors import InputError, RocksteadyError
from rocksteady.sweep.chunks import Chunks

if TYPE_CHECKING:
    import zarr

GROUP = "zarr.json"
"""Description of a group, and of an array."""
DONE = "done"
CHUNK = "chunk"
"""Dimension of the flags."""
COMPUTED = "computed"
"""What the flags say of cells, in an unfinished result."""
TAKEN = (DONE, CHUNK, COMPUTED)
OUTPUTS = "outputs"
"""Attribute of the flags: names of the outputs in their order, which a folder does not keep."""


@dataclass(frozen=True, kw_only=True)
class Contents:
    """The arrays of a store.

    Attributes
    ----------
    folder
        Of the store.
    attributes
        Of the result.
    axes, outputs
        Arrays by their names, in the order of the sweep.
    flags
        Whether each chunk is finished.
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
        found: dict[str, Any] = json.loads(self.attributes["inputs"])
        return found

    def files(self, chunk: int) -> list[Path]:
        """Return the files of a chunk, its flag first."""
        flag = self.folder / DONE / self.flags.metadata.encode_chunk_key((chunk,))
        place = self.chunks.place(chunk)
        return [flag] + [
            self.folder / name / array.metadata.encode_chunk_key(place)
            for name, array in self.outputs.items()
        ]

    def flagged(self) -> NDArray[np.bool_]:
        """Return which chunks are flagged as finished; one whose flag cannot be read is not."""
        try:
            return _true(self.flags[:])
        except Exception:  # noqa: BLE001 -- each codec has errors of its own for what it cannot read
            return np.array([self._flag(chunk) for chunk in range(len(self.chunks))])

    def _flag(self, chunk: int) -> bool:
        try:
            return bool(_true(self.flags[chunk : chunk + 1])[0])
        except Exception:  # noqa: BLE001 -- as above
            return False

    def complete(self, flagged: NDArray[np.bool_]) -> NDArray[np.bool_]:
        """Return which of the flagged chunks have all their files.

        What is in the files is not looked at.  Without this, zarr would take values for nothing
        where a file is missing.
        """
        return np.array(
            [
                flag and all(file.is_file() for file in self.files(chunk))
                for chunk, flag in enumerate(flagged.tolist())
            ]
        )

    def readable(self, chunk: int) -> bool:
        """Return whether every array of a chunk is what was written: they carry checksums."""
        region = self.chunks.region(chunk)
        try:
            for array in self.outputs.values():
                array[region]
        except Exception:  # noqa: BLE001 -- as above
            return False
        return True


def _true(flags: Any) -> NDArray[np.bool_]:
    """Return which bytes are 1, as they were written: any other than 0 would pass for true."""
    return np.asarray(np.asarray(flags).view(np.uint8) == 1)


def attributes_in(folder: Path) -> dict[str, Any] | None:
    """Return the attributes of a store; None where that is none, or they cannot be read."""
    try:
        found = json.loads((folder / GROUP).read_text(encoding="utf-8"))["attributes"]
        json.loads(found["inputs"])
    except (OSError, ValueError, LookupError, TypeError):
        return None
    return dict(found)


def is_store(folder: Path) -> bool:
    """Return whether a folder holds a group of a sweep."""
    return attributes_in(folder) is not None


def was_store(folder: Path) -> bool:
    """Return whether a folder that is no store any more has the flags of one."""
    return (folder / DONE / GROUP).is_file()


def contents_of(
    folder: Path, mode: Literal["r", "r+"], refused: Callable[[str], RocksteadyError]
) -> Contents:
    """Return what lies in a store.

    Parameters
    ----------
    folder
        Of a store.
    mode
        To read, or to write as well.
    refused
        Makes the error to raise where it cannot be read, from a clause that says why.
    """
    import zarr

    try:
        group = zarr.open_group(folder, mode=mode, zarr_format=3, use_consolidated=False)
        flags: Any = group[DONE]
        outputs: dict[str, Any] = {name: group[name] for name in flags.attrs[OUTPUTS]}
        first = next(iter(outputs.values()))
        axes: dict[str, Any] = {name: group[name] for name in first.metadata.dimension_names}
        return Contents(
            folder=folder,
            attributes=group.attrs.asdict(),
            axes=axes,
            outputs=outputs,
            flags=flags,
            chunks=Chunks(shape=first.shape, box=first.chunks),
        )
    except Exception as error:
        raise refused(f"it cannot be read: {said(error)}") from error


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
                name="name",
                value=name,
                valid=f"a store has {', '.join(TAKEN)} of its own",
                hint="rename the axis or the output",
            )


def said(error: Exception) -> str:
    """Return what an error says, in one line."""
    text = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
    return " ".join(text.split()) or type(error).__name__
