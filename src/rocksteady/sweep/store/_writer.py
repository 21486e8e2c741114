"""Writer of a store: finished chunks survive any interruption.

Files of a chunk are on the disk before its checksums are written, which mark it as finished: so a
process may be killed, and the power may fail, at any moment.  What is marked and all the same
missing, damaged or that of another chunk is found out, and computed again.
"""

import os
import socket
import time
import uuid
import warnings
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rocksteady import durable
from rocksteady.errors import OutputError, UnfinishedError
from rocksteady.small_files import content_of
from rocksteady.sweep.cases.axes import Array
from rocksteady.sweep.cases.task import Answer, CellRange, Task
from rocksteady.sweep.store._checksums import checksum, is_identity
from rocksteady.sweep.store._contents import DONE, GROUP, LOCK, Contents, contents_of
from rocksteady.sweep.store._descriptions import Described
from rocksteady.sweep.store.chunks import Chunks
from rocksteady.sweep.store.ownership import MARKS, Marks, remove
from rocksteady.sweep.store.reading import dataset_of

if TYPE_CHECKING:
    import xarray

SHARE = 0.05
"""Of a run's time that it takes at most to force chunks to the disk, several at once if need be."""
LATEST, MOST_HELD = 10.0, 2**26
"""Seconds and bytes after which finished chunks are forced to the disk, whatever it takes."""


class StoreFiles:
    """The files of a store that this process has locked.

    Parameters
    ----------
    folder
        Folder of the store.
    token
        Begins the names of files that are being written: unique to this run, and named in the lock.
    """

    def __init__(self, folder: Path, token: str) -> None:
        self.folder = folder
        self._token = token
        self._done = folder / DONE

    def put(self, files: Mapping[str, bytes]) -> None:
        """Write files by relative paths: forced to the disk, and each of them whole."""
        staged = {path: self._done / f"{self._token}-{n}.partial" for n, path in enumerate(files)}
        try:
            for path, content in files.items():
                self._make_folders((self.folder / path).parent)
                durable.create(staged[path], content)
            durable.move_all({file: self.folder / path for path, file in staged.items()})
        except OSError:
            for file in staged.values():
                with suppress(OSError):
                    file.unlink(missing_ok=True)
            raise

    def _make_folders(self, folder: Path) -> None:
        if not folder.is_dir():
            self._make_folders(folder.parent)
            folder.mkdir()
            durable.sync_folder(folder.parent)

    def describe(self, described: Described) -> None:
        """Write all descriptions that are missing, damaged or edited."""
        for path in sorted(described.files, key=_order):
            place = self.folder / path
            if not place.is_file() or place.read_bytes() != described.files[path]:
                self.put({path: described.files[path]})

    def begin(self, described: Described, replaced: Marks | None) -> None:
        """Make a store of which the descriptions are still to come.

        Files of one that is replaced are removed.  From the first step on it is the new store; what
        is left to do after it is done when it is resumed.
        """
        self.put({MARKS[0]: described.beginning(replaced)})
        self.put({GROUP: described.files[GROUP]})
        if replaced is not None:
            remove(self.folder, replaced)


def _order(path: str) -> tuple[bool, str]:
    """Return the sorting key of descriptions: the marks, which certify the rest, are last."""
    return path in MARKS, path


@contextmanager
def locked(folder: Path) -> Iterator[StoreFiles]:
    """Lock a store against writing by other processes, and yield its files.

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
        holder = _holder(file)[0]
        raise OutputError(
            "store",
            folder,
            f"another process is writing it{holder and f' ({holder})'}",
            "wait for it to end, or name another store",
        ) from None
    except OSError as error:
        raise OutputError(
            "store",
            folder,
            f"it cannot be locked: {error.strerror or error}",
            "check whether you may write there",
        ) from error
    try:
        before, token = _holder(file)[1], uuid.uuid4().hex
        if is_identity(before):  # of a process that was killed
            with suppress(OSError):
                for leftover in (folder / DONE).glob(f"{before}-*.partial"):
                    leftover.unlink()
        with suppress(OSError):  # of a full disk: the words are a courtesy, the lock holds
            words = f"process {os.getpid()} on {socket.gethostname()}\n{token}"
            file.write_text(words, encoding="utf-8")
            durable.sync(file)
            durable.sync_folder(file.parent)
        yield StoreFiles(folder, token)
    finally:
        with suppress(OSError):
            file.write_text("", encoding="utf-8")
        lock.release()


def _holder(file: Path) -> tuple[str, str]:
    """Return who has a lock, or had it when that process was killed, and its token."""
    with suppress(ValueError):
        words, _, token = content_of(file, "lock", "").decode(errors="replace").partition("\n")
        return words, token
    return "", ""


class StoreWriter:
    """Writes the results of a sweep into a store, chunk by chunk.

    Parameters
    ----------
    files
        Files of the store, locked.
    task
        Task of the sweep.
    described
        Descriptions of the store.

    Raises
    ------
    OutputError
        If it cannot be read.
    """

    def __init__(self, files: StoreFiles, task: Task, described: Described) -> None:
        self._files = files
        self._folder = files.folder
        self._described = described
        contents = contents_of(files.folder, self._unreadable)
        self._chunks: Chunks = contents.chunks
        self._open: dict[int, tuple[dict[str, Array], int]] = {}
        """Arrays of chunks under way, and how many of their cells are still to come."""
        self._dtypes = {output.name: output.dtype for output in task.outputs}
        self._pending: dict[int, dict[str, bytes]] = {}
        """Contents of the files of full chunks that are not on the disk yet."""
        self._due = 0.0
        self._since = 0.0
        try:
            self._finished = self._sound(contents)
        except OSError as error:
            raise self._unreadable(f"it is damaged: {error.strerror or error}") from error

    def _unreadable(self, valid: str) -> OutputError:
        hint = "overwrite it, or name another store"
        return OutputError("store", self._folder, valid, hint)

    def _sound(self, contents: Contents) -> NDArray[np.bool_]:
        """Return which chunks are finished, and remove what is left of others."""
        sums = contents.sums()
        flagged = contents.flagged()
        sound = contents.complete(flagged)
        for chunk in np.flatnonzero(sound).tolist():
            checks = [
                checksum(self._described.marks.sweep, name, chunk, file.read_bytes())
                for name, file in zip(contents.outputs, contents.files(chunk)[1:], strict=True)
            ]
            sound[chunk] = checks == sums[chunk].tolist()
        removed = set()
        for chunk in np.flatnonzero(~sound).tolist():
            for file in contents.files(chunk):
                with suppress(FileNotFoundError):
                    file.unlink()
                    removed.add(file.parent)
        for folder in removed:
            durable.sync_folder(folder)
        damaged = int(flagged.sum() - sound.sum())
        if damaged:
            warnings.warn(
                f"{self._folder}: {damaged} of {flagged.sum()} finished chunks are missing or "
                "damaged, and are computed again",
                stacklevel=2,
            )
        return sound

    def missing(self) -> Sequence[CellRange]:
        """Return the ranges of cells that are to be computed, one for each unfinished chunk."""
        return [self._chunks.cells(k) for k in np.flatnonzero(~self._finished).tolist()]

    def put(self, answer: Answer) -> None:
        """Keep the results of a job, and write the chunk that they complete.

        Raises
        ------
        UnfinishedError
            If it cannot be written.
        """
        first, stop = answer.job[0], answer.stop
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
        now = time.monotonic()
        self._since = self._since if self._pending else now
        self._pending[chunk] = self._described.encoded(chunk, arrays)
        held = sum(len(file) for files in self._pending.values() for file in files.values())
        whole = int(self._finished.sum()) + len(self._pending) == len(self._chunks)
        if whole or held > MOST_HELD or now >= min(self._due, self._since + LATEST):
            self.flush()
            ended = time.monotonic()
            self._due = ended + (ended - now) / SHARE

    def flush(self) -> None:
        """Put the files of full chunks on the disk, then mark these as finished.

        Raises
        ------
        UnfinishedError
            If that cannot be done; those are kept for which there was room.
        """
        try:
            self._write_files(dict(self._pending))
        except OSError as error:
            with suppress(OSError):
                while self._pending:
                    first = next(iter(self._pending))
                    self._write_files({first: self._pending[first]})
            if self._pending:
                raise self._stopped(error) from error

    def _write_files(self, chunks: Mapping[int, Mapping[str, bytes]]) -> None:
        """Put the files of chunks on the disk, and then their checksums."""
        sweep, path = self._described.marks.sweep, self._described.path
        sums = {
            chunk: np.array([checksum(sweep, name, chunk, files[name]) for name in files], "<u8")
            for chunk, files in chunks.items()
        }
        self._files.put(
            {path(n, chunk): files[n] for chunk, files in chunks.items() for n in files}
        )
        self._files.put(
            {f"{DONE}/c/{chunk}": checksums.tobytes() for chunk, checksums in sums.items()}
        )
        for chunk in chunks:
            self._finished[chunk] = True
            del self._pending[chunk]

    def _stopped(self, error: OSError) -> UnfinishedError:
        return UnfinishedError(
            "store",
            self._folder,
            f"{error.strerror or error}; {int(self._finished.sum())} of "
            f"{len(self._chunks)} chunks are finished and kept",
            "make room and resume it",
        )

    def cells(self) -> "xarray.Dataset":
        """Return the result, read from the store where it is used."""
        return dataset_of(contents_of(self._folder, self._unreadable))
