"""Files that belong to a store, the only ones ever overwritten or removed.

A store is begun and replaced in its place: its marks are the first file written and, in their final
form, the last.  So no folder is left beside it that a later run would have to recognise.
"""

import json
import os
import re
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rocksteady import durable
from rocksteady.small_files import content_of
from rocksteady.sweep.store._checksums import HEX, NAMED, is_identity
from rocksteady.sweep.store._contents import DONE, GROUP, LOCK, attributes_in

MARKS = (f"{DONE}/store.json", f"{DONE}/store-copy.json")
"""Files that make a folder a store: no copy of the results that another program writes has them.
They are alike, so that one may be damaged."""
REPLACES = "replaces"
"""In the first of them while a store is begun: the marks of the one whose files may be there."""


@dataclass(frozen=True, kw_only=True)
class Marks:
    """What a store has on it that only a sweep writes.

    Attributes
    ----------
    axes, outputs
        Names of its arrays.
    sweep
        Its identity.
    box
        Shape of its chunks.
    """

    axes: tuple[str, ...]
    outputs: tuple[str, ...]
    sweep: str
    box: tuple[int, ...]


def owner_of(folder: Path) -> Marks | None:
    """Return the marks of the store in a folder; None where it is certainly no whole one."""
    marks = _marks(folder)
    return None if marks is None else _marks_of(marks)


def replaced_in(folder: Path) -> Marks | None:
    """Return the marks of the store whose files an unfinished beginning has to remove."""
    before = (_marks(folder) or {}).get(REPLACES)
    return None if before is None else _marks_of(before)


def is_begun(folder: Path) -> bool:
    """Return whether the beginning of the store in a folder is finished."""
    return REPLACES not in (_marks(folder) or {})


def is_store(folder: Path) -> bool:
    """Return whether a folder holds a store that has been begun, and can be read."""
    return owner_of(folder) is not None and is_begun(folder) and attributes_in(folder) is not None


def _marks(folder: Path) -> dict[str, Any] | None:
    """Return what stands in the first file of marks that can be read."""
    for name in MARKS:
        with suppress(ValueError, LookupError, TypeError):
            values = json.loads(content_of(folder / name, "store", NAMED))
            for marks in (values, values.get(REPLACES)):
                if marks is not None:
                    _marks_of(marks)
            return dict(values)
    return None


def _marks_of(marks: Any) -> Marks:
    axes, outputs, box = (tuple(marks[name]) for name in ("axes", "outputs", "box"))
    if not (
        is_identity(marks["sweep"])
        and all(isinstance(name, str) and name.isidentifier() for name in axes + outputs)
        and all(isinstance(length, int) and length >= 1 for length in box)
        and len(axes) == len(box) > 0 < len(outputs)
    ):
        message = "these are not the marks of a store"
        raise ValueError(message)
    return Marks(axes=axes, outputs=outputs, sweep=marks["sweep"], box=box)


def others(folder: Path) -> list[str]:
    """Return what lies in a folder and no sweep wrote: relative paths, in order.

    In a folder without marks that is all but what is there before them.
    """
    known = [marks for marks in (owner_of(folder), replaced_in(folder)) if marks is not None]
    return [path for path, kind in _all(folder) if not _own(path, kind, known)]


def remove(folder: Path, marks: Marks) -> None:
    """Remove a store's own files, except its marks and its lock."""
    entries = [(path, kind) for path, kind in _all(folder) if _own(path, kind, [marks])]
    for path, kind in entries:
        if kind == "file" and path not in {*MARKS, f"{DONE}/{LOCK}"}:
            (folder / path).unlink()
    for path, kind in reversed(entries):  # what is in a folder comes after it
        if kind == "folder":
            durable.sync_folder(folder / path)
            if not any((folder / path).iterdir()):
                (folder / path).rmdir()
    durable.sync_folder(folder)


def _own(path: str, kind: str, known: Sequence[Marks]) -> bool:
    """Return whether a path is one that a sweep makes, in stores of known marks."""
    partial = rf"{DONE}/[0-9a-f]{{{HEX}}}-\d+\.partial"
    folders, files = [DONE], [f"{DONE}/{LOCK}", partial]
    for marks in known:
        axes, outputs, group = "|".join(marks.axes), "|".join(marks.outputs), re.escape(GROUP)
        folders += [axes, outputs, f"({axes}|{DONE})/c"]
        files += [*map(re.escape, MARKS), group, f"({axes}|{outputs}|{DONE})/{group}"]
        files += [rf"({axes}|{DONE})/c/\d+", rf"({outputs})/c(\.\d+)+"]
    pattern = "|".join({"folder": folders, "file": files}.get(kind, []))
    return bool(pattern) and re.fullmatch(pattern, path) is not None


def _all(folder: Path, before: str = "") -> Iterator[tuple[str, str]]:
    """Yield the relative path and the kind of all that lies in a folder, a folder first.

    Links are not followed; they and whatever is neither file nor folder are "other".
    """
    for entry in sorted(os.scandir(folder), key=lambda entry: entry.name):
        path = f"{before}{entry.name}"
        if entry.is_dir(follow_symlinks=False):
            yield path, "folder"
            yield from _all(folder / entry.name, f"{path}/")
        else:
            yield path, "file" if entry.is_file(follow_symlinks=False) else "other"
