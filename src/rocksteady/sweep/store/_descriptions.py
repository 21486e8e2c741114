"""Metadata of a store's groups, arrays and axes, derived from the inputs and repairable."""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from rocksteady.errors import OutputError
from rocksteady.sweep.cases.axes import Array, Axis
from rocksteady.sweep.cases.inputs import attributes_of, differences
from rocksteady.sweep.cases.outputs import Output, words_of
from rocksteady.sweep.cases.task import Task
from rocksteady.sweep.store._checksums import identity_of
from rocksteady.sweep.store._contents import (
    CHUNK,
    DONE,
    FORM,
    GROUP,
    OUTPUTS,
    SCHEMA,
    attributes_in,
)
from rocksteady.sweep.store.chunks import Chunks
from rocksteady.sweep.store.ownership import MARKS, REPLACES, Marks, is_begun

SHOWN = 5
"""Differences that a message shows."""


class Described:
    """The descriptions of a store, its axes, and its arrays of chunks, as zarr writes them.

    Nothing is written to a disk: the caller puts each file in its place.

    Parameters
    ----------
    task, chunks
        What is computed, and in which chunks.
    inputs, attributes
        Inputs and attributes of the result.

    Attributes
    ----------
    marks
        Marks by which the store is recognised.
    files
        Contents by relative paths.
    """

    def __init__(
        self,
        task: Task,
        chunks: Chunks,
        inputs: Mapping[str, Any],
        attributes: Mapping[str, Any],
    ) -> None:
        import zarr
        from zarr.codecs import Crc32cCodec, ZstdCodec
        from zarr.storage import MemoryStore

        self._chunks = chunks
        self._kept: dict[str, Any] = {}
        self.marks = Marks(
            axes=task.grid.names,
            outputs=tuple(output.name for output in task.outputs),
            sweep=identity_of(inputs, chunks.box),
            box=chunks.box,
        )
        group = zarr.create_group(
            MemoryStore(self._kept),
            zarr_format=3,
            attributes=attributes_of(inputs, attributes),
        )
        for axis in task.grid.axes:
            group.create_array(
                axis.name,
                data=_storable(axis),
                attributes=words_of(axis.long_name, axis.units),
                dimension_names=[axis.name],
            )
        self._arrays: dict[str, Any] = {
            output.name: group.create_array(
                output.name,
                shape=chunks.shape,
                chunks=chunks.box,
                # A name, c.1.0, and no path, c/1/0: a folder for each takes as long as its file.
                chunk_key_encoding={"name": "default", "separator": "."},
                dtype=output.dtype,
                fill_value=output.nothing,
                compressors=[ZstdCodec(level=1), Crc32cCodec()],
                attributes=_json(output),
                dimension_names=task.grid.names,
                # Else a chunk of nothing but fill values would be no file, and count as missing.
                config={"write_empty_chunks": True},
            )
            for output in task.outputs
        }
        group.create_array(
            DONE,
            shape=(len(chunks) * len(task.outputs),),
            chunks=(len(task.outputs),),
            dtype=np.uint64,
            fill_value=0,
            compressors=None,
            attributes={
                **words_of("checksums of the outputs of each finished chunk, else 0", "1"),
                SCHEMA: FORM,
                OUTPUTS: list(self.marks.outputs),
            },
            dimension_names=[CHUNK],
        )
        self.files = {path: content.to_bytes() for path, content in self._kept.items()}
        self.files[GROUP] = self._consolidated()
        self.files |= dict.fromkeys(MARKS, _text(vars(self.marks)))

    def _consolidated(self) -> bytes:
        """Return the description of the group with those of axes and outputs.

        So xarray opens the store at once, and shows no array of checksums.
        """
        names = [*self.marks.axes, *self.marks.outputs]
        metadata = {name: json.loads(self.files[f"{name}/{GROUP}"]) for name in names}
        consolidated = {"kind": "inline", "must_understand": False, "metadata": metadata}
        return _text(json.loads(self.files[GROUP]) | {"consolidated_metadata": consolidated})

    def beginning(self, replaced: Marks | None) -> bytes:
        """Return the marks of the store while files of the one before it may be there."""
        before = None if replaced is None else vars(replaced)
        return _text(vars(self.marks) | {REPLACES: before})

    def encoded(self, chunk: int, arrays: Mapping[str, Array]) -> dict[str, bytes]:
        """Return the contents of the files of a chunk by the names of its outputs."""
        region = self._chunks.region(chunk)
        shape = tuple(part.stop - part.start for part in region)
        files = {}
        for name, array in arrays.items():
            self._arrays[name][region] = array.reshape(shape)
            files[name] = self._kept.pop(self.path(name, chunk)).to_bytes()
        return files

    def path(self, output: str, chunk: int) -> str:
        """Return the relative path of a file of a chunk."""
        place = self._chunks.place(chunk)
        return f"{output}/{self._arrays[output].metadata.encode_chunk_key(place)}"


def _text(description: Mapping[str, Any]) -> bytes:
    return json.dumps(description, indent=2).encode()


def _storable(axis: Axis) -> Array:
    """Return the values of an axis in a type that zarr has a specification of."""
    points = axis.points
    return points.astype(np.dtypes.StringDType()) if points.dtype.kind == "U" else points


def _json(output: Output) -> dict[str, Any]:
    """Return the attributes of an output in lists and numbers."""
    attributes = output.attributes
    if "flag_values" in attributes:
        attributes["flag_values"] = attributes["flag_values"].tolist()
    return attributes


def refuse_others(folder: Path, marks: Marks, inputs: Mapping[str, Any]) -> None:
    """Refuse a store of other inputs.

    Raises
    ------
    OutputError
        If something differs; the message names it.
    """
    attributes = attributes_in(folder)
    changes = [] if attributes is None else differences(json.loads(attributes["inputs"]), inputs)
    ours = marks.sweep == identity_of(inputs, marks.box)
    if ours and not (changes and is_begun(folder)):  # else the words may be those of the one before
        return
    more = f" and {len(changes) - SHOWN} more" if len(changes) > SHOWN else ""
    raise OutputError(
        "store",
        folder,
        "it holds another sweep: " + (", ".join(changes[:SHOWN]) + more or "its marks differ"),
        "give the same inputs, overwrite it, or name another store",
    )
