"""Writes a store: what is finished survives whatever ends the run.

Zarr writes a file beside its place and moves it there, and a chunk's flag is written after its
arrays: so a process may be killed at any moment.  Arrays carry checksums, and every chunk is a
file: what is flagged and all the same missing or damaged is found out, and computed again.
"""

import os
import socket
import warnings
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rocksteady.errors import OutputError, UnfinishedError
from rocksteady.sweep.axes import Array
from rocksteady.sweep.contents import DONE, GROUP, contents_of
from rocksteady.sweep.reading import dataset_of
from rocksteady.sweep.task import Answer, Piece, Task

if TYPE_CHECKING:
    import xarray

LOCK = "lock"
"""A file beside the flags: zarr lists the members of a group, and would complain of it there."""


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Keep other processes from writing a store.

    The operating system gives the lock back when its holder ends, however it ends.

    Raises
    ------
    OutputError
        If another process has it.
    """
    from filelock import FileLock, Timeout

    file = folder / DONE / LOCK
    lock = FileLock(file, timeout=0)
    try:
        lock.acquire()
    except Timeout:
        holder = ""
        with suppress(OSError):
            holder = file.read_text(encoding="utf-8")
        raise OutputError(
            name="store",
            value=folder,
            valid=f"another process is writing it{holder and f' ({holder})'}",
            hint="wait for it to end, or name another store",
        ) from None
    except OSError as error:
        raise OutputError(
            name="store",
            value=folder,
            valid=f"it cannot be locked: {error.strerror or error}",
            hint="check whether you may write there",
        ) from error
    try:
        with suppress(OSError):  # of a full disk: the words are a courtesy, the lock holds
            file.write_text(f"process {os.getpid()} on {socket.gethostname()}", encoding="utf-8")
        yield
    finally:
        with suppress(OSError):
            file.write_text("", encoding="utf-8")
        lock.release()


class Shelf:
    """Puts answers into a store, and tells which cells are still missing.

    Parameters
    ----------
    folder
        Of a store, locked.
    task
        What is computed.

    Raises
    ------
    OutputError
        If it cannot be read.
    """

    def __init__(self, folder: Path, task: Task) -> None:
        self._folder = folder
        self._contents = contents_of(folder, "r+", self._unreadable)
        self._chunks = self._contents.chunks
        # Else a chunk of nothing but fill values would be no file, and be taken for a missing one.
        self._stored = {
            name: array.with_config({"write_empty_chunks": True})
            for name, array in self._contents.outputs.items()
        }
        self._open: dict[int, tuple[dict[str, Array], int]] = {}
        """Arrays of chunks under way, and how many of their cells are still to come."""
        self._dtypes = {output.name: output.dtype for output in task.outputs}
        self._finished = self._sound()

    def _unreadable(self, valid: str) -> OutputError:
        hint = "overwrite it, or name another store"
        return OutputError(name="store", value=self._folder, valid=valid, hint=hint)

    def _sound(self) -> NDArray[np.bool_]:
        """Return which chunks are finished, and remove what is left of others."""
        places = [self._folder / name for name in (DONE, *self._stored)]
        if all(file.name in {GROUP, LOCK} for place in places for file in place.iterdir()):
            return np.zeros(len(self._chunks), dtype=np.bool_)  # it has just been begun
        for leftover in self._folder.rglob("*.partial"):  # of a process that was killed
            leftover.unlink(missing_ok=True)
        flagged = self._contents.flagged()
        sound = self._contents.complete(flagged)
        for chunk in np.flatnonzero(sound).tolist():
            sound[chunk] = self._contents.readable(chunk)
        for chunk in np.flatnonzero(~sound).tolist():
            for file in self._contents.files(chunk):
                file.unlink(missing_ok=True)
        damaged = int(flagged.sum() - sound.sum())
        if damaged:
            warnings.warn(
                f"{self._folder}: {damaged} of {flagged.sum()} finished chunks are missing or "
                "damaged, and are computed again",
                stacklevel=2,
            )
        return sound

    def missing(self) -> Sequence[Piece]:
        """Return the ranges of cells that are not there yet, a chunk each."""
        return [self._chunks.cells(k) for k in np.flatnonzero(~self._finished).tolist()]

    def put(self, answer: Answer) -> None:
        """Keep what was found, and write the chunk that is full now.

        Raises
        ------
        UnfinishedError
            If it cannot be written.
        """
        first, stop = answer.piece[0], answer.stop
        chunk = self._chunks.containing(first)
        begin, end = self._chunks.cells(chunk)
        arrays, left = self._open.pop(chunk, (None, end - begin))
        if arrays is None:
            arrays = {name: np.empty(end - begin, dtype) for name, dtype in self._dtypes.items()}
        for name, array in answer.arrays.items():
            arrays[name][first - begin : stop - begin] = array
        left -= stop - first
        if left:
            self._open[chunk] = arrays, left
        else:
            self._write(chunk, arrays)

    def _write(self, chunk: int, arrays: Mapping[str, Array]) -> None:
        region = self._chunks.region(chunk)
        shape = tuple(part.stop - part.start for part in region)
        try:
            for name, array in arrays.items():
                self._stored[name][region] = array.reshape(shape)
            self._contents.flags[chunk] = True
        except OSError as error:
            raise UnfinishedError(
                name="store",
                value=self._folder,
                valid=f"{error.strerror or error}; {int(self._finished.sum())} of "
                f"{len(self._chunks)} chunks are finished and kept",
                hint="make room and resume it",
            ) from error
        self._finished[chunk] = True

    def dataset(self) -> "xarray.Dataset":
        """Return the result, read from the store where it is used."""
        return dataset_of(self._contents)
