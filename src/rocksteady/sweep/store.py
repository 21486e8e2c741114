"""A sweep's results on disk, a chunk at a time: what is finished survives whatever ends the run.

`Store` says where and how; `rocksteady.sweep.shelf` writes what lies there.
"""

import glob
import os
import shutil
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, nullcontext, suppress
from dataclasses import KW_ONLY, dataclass
from pathlib import Path
from typing import Any

from rocksteady.errors import OutputError
from rocksteady.model.validation import whole_number
from rocksteady.sweep.chunks import Chunks
from rocksteady.sweep.contents import is_store, refuse_taken, was_store
from rocksteady.sweep.descriptions import create, mend_descriptions, refuse_others
from rocksteady.sweep.inputs import inputs_of, named_function
from rocksteady.sweep.shelf import Shelf, locked
from rocksteady.sweep.task import Task

LARGEST_CHUNK = 2**24
TRIES = 10
"""To remove a folder."""
ABANDONED = 3600.0
"""Seconds after which nobody is making a new store any more: it takes less than one."""


@dataclass(frozen=True)
class Store:
    """Where a sweep keeps its results on disk.

    Parameters
    ----------
    path
        Of a folder, as "map.zarr"; the folder that it is in exists.
    resume
        Whether a store that is there, of the same inputs, is continued.
    overwrite
        Whether a store that is there is replaced.
    chunk
        The most cells that are written at once: what is lost when a run is ended, at most, for each
        of its workers.  By default a 64th of the grid, but from 4096 to 65,536 cells.  A store that
        is continued keeps its own.

    Raises
    ------
    InputError
        If the chunk is not a whole number from 1 to 2^24.
    OutputError
        If it is to be continued and replaced.
    """

    path: Path | str
    _: KW_ONLY
    resume: bool = False
    overwrite: bool = False
    chunk: int | None = None

    def __post_init__(self) -> None:
        """Validate."""
        object.__setattr__(self, "path", Path(self.path))
        if self.chunk is not None:
            hint = "give a number of cells, as 10000, or leave it out"
            whole_number("chunk", self.chunk, at_least=1, at_most=LARGEST_CHUNK, hint=hint)
        if self.resume and self.overwrite:
            raise self._refused("it cannot be both continued and replaced", "choose one")

    @property
    def folder(self) -> Path:
        """Where it is: of a link the folder that it leads to."""
        path = Path(self.path)
        return path.resolve() if path.is_symlink() else path

    def check(self) -> None:
        """Refuse, before anything is computed, a place where nothing could be written.

        Raises
        ------
        OutputError
            If it is a file or another folder, its own folder is missing or not writable, or a
            store is there that is neither to be continued nor to be replaced.
        """
        parent = self.folder.absolute().parent
        if not parent.is_dir():
            raise self._refused("the folder it would be in does not exist", "create that folder")
        if os.path.lexists(self.folder):
            if not self.folder.is_dir():
                raise self._refused("it is a file", "name a folder, as map.zarr")
            if not is_store(self.folder) and not was_store(self.folder):
                raise self._refused("it is a folder and no store of a sweep", "name another one")
            if not is_store(self.folder) and not self.overwrite:
                raise self._refused(
                    "its zarr.json is damaged, and says no more what it holds",
                    "overwrite it, or name another one",
                )
            if not (self.resume or self.overwrite):
                raise self._refused("it exists", "resume it, overwrite it, or name another one")
        elif not os.access(parent, os.W_OK):
            raise self._refused("its folder is not writable", "choose another folder")

    def _refused(self, valid: str, hint: str) -> OutputError:
        return OutputError(name="store", value=self.path, valid=valid, hint=hint)

    @contextmanager
    def opened(self, task: Task, attributes: Mapping[str, Any]) -> Iterator[Shelf]:
        """Yield what keeps the answers to a task, while no other process may write the store.

        Raises
        ------
        InputError
            If other processes could not find the case function, a constant cannot be written down,
            or a name is one of the store's own.
        OutputError
            As for `check`; if another process writes the store, or it holds results of other
            inputs; `UnfinishedError` later, where a chunk cannot be written.
        """
        named_function(task)
        refuse_taken([*task.grid.names, *(output.name for output in task.outputs)])
        self._mend()
        self.check()
        inputs = inputs_of(task)
        chunks = Chunks.of(task.grid.shape, self.chunk)
        there = self.folder.is_dir()
        if not there or self.overwrite:
            with locked(self.folder) if there else nullcontext():
                self._begin(lambda folder: create(folder, task, chunks, inputs, attributes), there)
        with locked(self.folder):
            if there and not self.overwrite:
                refuse_others(self.folder, inputs)
                mend_descriptions(self.folder, task, inputs, attributes)
            yield Shelf(self.folder, task)

    def _beside(self, word: str) -> Path:
        """Return a hidden name beside the store, one for each process."""
        return self.folder.with_name(f".{self.folder.name}.{word}-{os.getpid()}")

    def _begin(self, fill: Callable[[Path], None], replace: bool) -> None:
        """Put an empty store in place, whole or not at all; what it replaces goes last."""
        new, old = self._beside("new"), self._beside("old")
        try:
            fill(new)
            if replace:
                self.folder.replace(old)
            new.replace(self.folder)  # not onto one that another process has put there just now
        except OSError as error:
            raise self._refused(error.strerror or str(error), "check the folder") from error
        finally:
            if old.is_dir() and not self.folder.is_dir():
                old.replace(self.folder)
            for leftover in (new, old):
                _remove(leftover)

    def _mend(self) -> None:
        """Finish what a process was doing that was killed as it replaced the store."""
        parent, name = self.folder.absolute().parent, glob.escape(self.folder.name)
        for old in parent.glob(f".{name}.old-*"):
            if os.path.lexists(self.folder):
                shutil.rmtree(old, ignore_errors=True)
            else:  # between the two moves
                with suppress(OSError):
                    old.replace(self.folder)
        for new in parent.glob(f".{name}.new-*"):
            with suppress(OSError):  # gone meanwhile
                if time.time() - new.stat().st_mtime > ABANDONED:
                    shutil.rmtree(new, ignore_errors=True)


def _remove(folder: Path) -> None:
    """Remove a folder, in which zarr's threads may still be writing after an error."""
    for _ in range(TRIES):
        shutil.rmtree(folder, ignore_errors=True)
        if not folder.exists():
            return
        time.sleep(0.05)
