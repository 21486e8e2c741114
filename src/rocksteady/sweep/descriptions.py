"""What a store says of itself, and its axes: they follow from the inputs, and can be mended."""

import json
from collections.abc import Mapping
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from rocksteady.errors import OutputError
from rocksteady.sweep.axes import Array, Axis
from rocksteady.sweep.chunks import Chunks
from rocksteady.sweep.contents import CHUNK, DONE, GROUP, OUTPUTS, attributes_in
from rocksteady.sweep.inputs import attributes_of, differences
from rocksteady.sweep.outputs import Output, words_of
from rocksteady.sweep.task import Task

SHOWN = 5
"""Differences that a message shows."""


def create(
    folder: Path,
    task: Task,
    chunks: Chunks,
    inputs: Mapping[str, Any],
    attributes: Mapping[str, Any],
) -> None:
    """Make the group, with axes and no results."""
    import zarr
    from zarr.codecs import Crc32cCodec, ZstdCodec

    group = zarr.create_group(folder, zarr_format=3, attributes=attributes_of(inputs, attributes))
    for axis in task.grid.axes:
        group.create_array(
            axis.name,
            data=_storable(axis),
            attributes=words_of(axis.long_name, axis.units),
            dimension_names=[axis.name],
        )
    for output in task.outputs:
        group.create_array(
            output.name,
            shape=chunks.shape,
            chunks=chunks.box,
            # A name, c.1.0, and no path, c/1/0: a folder for each chunk takes as long as its file.
            chunk_key_encoding={"name": "default", "separator": "."},
            dtype=output.dtype,
            fill_value=output.nothing,
            compressors=[ZstdCodec(level=1), Crc32cCodec()],
            attributes=_json(output),
            dimension_names=task.grid.names,
        )
    group.create_array(
        DONE,
        shape=(len(chunks),),
        chunks=(1,),
        dtype=np.bool_,
        fill_value=False,
        compressors=None,
        attributes={
            **words_of("whether a chunk of cells, in C order, is finished", "1"),
            OUTPUTS: [output.name for output in task.outputs],
        },
        dimension_names=[CHUNK],
    )


def _storable(axis: Axis) -> Array:
    """Return the values of an axis in a type that zarr has a specification of."""
    points = axis.points
    return points.astype(np.dtypes.StringDType()) if points.dtype.kind == "U" else points


def _json(output: Output) -> dict[str, Any]:
    """Return the attributes of an output in lists and numbers."""
    found = output.attributes
    if "flag_values" in found:
        found["flag_values"] = found["flag_values"].tolist()
    return found


def refuse_others(folder: Path, inputs: Mapping[str, Any]) -> None:
    """Refuse a store of other inputs.

    Raises
    ------
    OutputError
        If something differs; the message says what.
    """
    there = attributes_in(folder)
    assert there is not None  # it has been looked at
    found = differences(json.loads(there["inputs"]), inputs)
    if not found:
        return
    more = f" and {len(found) - SHOWN} more" if len(found) > SHOWN else ""
    raise OutputError(
        name="store",
        value=folder,
        valid="it holds another sweep: " + ", ".join(found[:SHOWN]) + more,
        hint="give the same inputs, overwrite it, or name another store",
    )


def mend_descriptions(
    folder: Path, task: Task, inputs: Mapping[str, Any], attributes: Mapping[str, Any]
) -> None:
    """Write all but the results again of a store of these inputs, where it is damaged or edited.

    Raises
    ------
    OutputError
        If it cannot be written.
    """
    chunks = Chunks(shape=task.grid.shape, box=_box(folder, task))
    try:
        with TemporaryDirectory(prefix="rocksteady-") as scratch:
            fresh = Path(scratch) / "store"
            create(fresh, task, chunks, inputs, attributes)
            for file in sorted(path for path in fresh.rglob("*") if path.is_file()):
                own = folder / file.relative_to(fresh)
                if not own.is_file() or own.read_bytes() != file.read_bytes():
                    own.parent.mkdir(parents=True, exist_ok=True)
                    partial = own.with_suffix(".partial")
                    partial.write_bytes(file.read_bytes())
                    partial.replace(own)
    except OSError as error:
        raise OutputError(
            name="store",
            value=folder,
            valid=f"it is damaged and cannot be mended: {error.strerror or error}",
            hint="overwrite it, or name another store",
        ) from error


def _box(folder: Path, task: Task) -> tuple[int, ...]:
    """Return the shape of a store's chunks, from the first array that still tells."""
    for output in task.outputs:
        try:
            array = json.loads((folder / output.name / GROUP).read_text(encoding="utf-8"))
            box = tuple(map(int, array["chunk_grid"]["configuration"]["chunk_shape"]))
        except (OSError, ValueError, LookupError, TypeError):
            continue
        if len(box) == len(task.grid.shape) and min(box) >= 1:
            return box
    return Chunks.of(task.grid.shape).box
