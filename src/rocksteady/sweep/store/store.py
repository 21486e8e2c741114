"""Store of a sweep's results on disk, where finished chunks survive any interruption.

`Store` holds the place and the options; `rocksteady.sweep.store._writer` writes what lies there.
"""

import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import KW_ONLY, dataclass
from pathlib import Path
from typing import Annotated, Any

from rocksteady import durable
from rocksteady.errors import OutputError, check_installed
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import Whole
from rocksteady.sweep.cases.inputs import inputs_of, named_function
from rocksteady.sweep.cases.task import Task
from rocksteady.sweep.store._contents import DONE, LOCK, attributes_in, refuse_taken
from rocksteady.sweep.store._descriptions import Described, refuse_others
from rocksteady.sweep.store._writer import StoreFiles, StoreWriter, locked
from rocksteady.sweep.store.chunks import Chunks
from rocksteady.sweep.store.ownership import is_begun, others, owner_of, remove, replaced_in

LARGEST_CHUNK = 2**24


@checked
@dataclass(frozen=True)
class Store:
    """Folder on disk for the results of a sweep.

    Parameters
    ----------
    path
        Path of a folder, as "map.zarr"; the folder that it is in exists.
    resume
        Whether an existing store, of the same inputs, is continued.
    overwrite
        Whether an existing store is replaced.
    chunk
        The most cells that are written at once: what is lost when a run is ended, at most, for each
        of its workers.  By default a 64th of the grid, but from 4096 to 65,536 cells, or from as
        many as one call takes where these are fewer.  A store that is continued keeps its own.

    Raises
    ------
    InputError
        If the chunk is not a whole number from 1 to 2^24.
    OutputError
        If it is to be continued and replaced.

    Examples
    --------
    >>> Store("map.zarr", resume=True).resume
    True
    """

    path: Path | str
    _: KW_ONLY
    resume: bool = False
    overwrite: bool = False
    chunk: Annotated[
        int | None, Whole(1, LARGEST_CHUNK, "give a number of cells, as 10000, or leave it out")
    ] = None

    def __post_init__(self) -> None:
        """Validate."""
        object.__setattr__(self, "path", Path(self.path))
        if self.resume and self.overwrite:
            raise self._refused("it cannot be both continued and replaced", "choose one")

    @property
    def folder(self) -> Path:
        """Where it is: of a link the folder that it leads to."""
        path = Path(self.path)
        return path.resolve() if path.is_symlink() else path

    def foreign_files(self) -> list[str]:
        """Return what lies in the folder and no sweep wrote: relative paths, in order."""
        return others(self.folder) if self.folder.is_dir() else []

    def check(self) -> None:
        """Refuse, before anything is computed, a place where nothing could be written.

        Raises
        ------
        OutputError
            If zarr is not installed, it is a file or another folder, its own folder is missing or
            not writable, or there is a store that is neither to be continued nor to be replaced.
        """
        check_installed(self._refused, "stores", "zarr")
        parent = self.folder.absolute().parent
        if not parent.is_dir():
            raise self._refused("the folder it would be in does not exist", "create that folder")
        if os.path.lexists(self.folder):
            self._check_there()
        elif not os.access(parent, os.W_OK):
            raise self._refused("its folder is not writable", "choose another folder")

    def _check_there(self) -> None:
        """Refuse what is there, unless it is a store that may be written, or could be begun."""
        if not self.folder.is_dir():
            raise self._refused("it is a file", "name a folder, as map.zarr")
        try:
            marks = owner_of(self.folder)
            foreign = others(self.folder)
        except OSError as error:
            raise self._refused(error.strerror or str(error), "name another one") from error
        if marks is None:
            about_to_begin = self.resume or (self.folder / DONE).is_dir()
            if foreign or not about_to_begin:
                raise self._refused(
                    "it is a folder and no store of a sweep of this version", "name another one"
                )
            return
        if not self.overwrite and is_begun(self.folder) and attributes_in(self.folder) is None:
            raise self._refused(
                "its zarr.json is damaged, and no longer describes it",
                "overwrite it, or name another one",
            )
        if not (self.resume or self.overwrite):
            raise self._refused("it exists", "resume it, overwrite it, or name another one")
        if self.overwrite and foreign:
            more = f" and {len(foreign) - 1} more" if foreign[1:] else ""
            raise self._refused(
                f"no sweep wrote {foreign[0]}{more} in it", "move that, or name another one"
            )

    def _refused(self, valid: str, hint: str) -> OutputError:
        return OutputError("store", self.path, valid, hint)

    @contextmanager
    def opened(self, task: Task, attributes: Mapping[str, Any]) -> Iterator[StoreWriter]:
        """Yield the writer of the results of a task, while no other process may write the store.

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
        self.check()
        inputs = inputs_of(task)
        made = self._make_folder()
        with locked(self.folder) as files:
            if not made or owner_of(self.folder) is not None:
                self.check()  # another process may have been here
            try:
                writer = self._writer(files, task, inputs, attributes)
            finally:
                if made and owner_of(self.folder) is None:
                    self._remove_empty()
            try:
                yield writer
            finally:
                writer.flush()

    def _make_folder(self) -> bool:
        """Make the folder, as far as it is missing, and return whether it was."""
        made = not self.folder.is_dir()
        try:
            (self.folder / DONE).mkdir(parents=True, exist_ok=True)
            durable.sync_folder(self.folder)
            durable.sync_folder(self.folder.absolute().parent)
        except OSError as error:
            raise self._refused(error.strerror or str(error), "check the folder") from error
        return made

    def _remove_empty(self) -> None:
        """Remove a folder in which no store has been begun."""
        with suppress(OSError):
            (self.folder / DONE / LOCK).unlink(missing_ok=True)
            (self.folder / DONE).rmdir()
            self.folder.rmdir()

    def _writer(
        self,
        files: StoreFiles,
        task: Task,
        inputs: Mapping[str, Any],
        attributes: Mapping[str, Any],
    ) -> StoreWriter:
        """Return the writer of the store, which is begun, or continued where it stopped."""
        marks = owner_of(self.folder)
        if marks is not None and not self.overwrite:
            refuse_others(self.folder, marks, inputs)
            chunks = Chunks(shape=task.grid.shape, box=marks.box)
        else:
            chunks = Chunks.of(task.grid.shape, self.chunk, batch=task.batch)
        described = Described(task, chunks, inputs, attributes)
        try:
            before = replaced_in(self.folder)
            if before is not None:
                remove(self.folder, before)
            if marks is None or self.overwrite:
                files.begin(described, marks)
            files.describe(described)
        except OSError as error:
            raise self._refused(
                f"it cannot be described: {error.strerror or error}", "check the folder"
            ) from error
        return StoreWriter(files, task, described)
