"""Flags for sweeps: executor, number of workers, and storage of results."""

import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

import typer

from rocksteady.cli.console.outputs import announce_file
from rocksteady.cli.console.progress import Meter, sweeping
from rocksteady.cli.console.refusals import both, refuse
from rocksteady.cli.console.shell import command_of
from rocksteady.cli.flags import options
from rocksteady.cli.flags.groups import OutputFlags, check_ending
from rocksteady.errors import OutputError, UnfinishedError
from rocksteady.results.rendering import printable
from rocksteady.show.export.files import check_apart, check_writable, impossible_name

if TYPE_CHECKING:
    import xarray

    from rocksteady.sweep.run import Execution
    from rocksteady.sweep.store.store import Store

sweep_flag = options.Panel("Sweep")

executor_flag = partial(
    sweep_flag,
    "--executor NAME",
    "threads (default), gpu for an NVIDIA GPU, dask for a cluster of processes on this "
    "machine, the address of a dask scheduler as tcp://host:8786, or serial. All give the same "
    "bytes.",
    default="threads",
)
workers_flag = partial(
    sweep_flag,
    "--workers N",
    "Threads or processes; by default as many as there are cores, or as a cluster has. "
    "With gpu: launches in flight, 3 by default.",
)


@dataclass(frozen=True, kw_only=True)
class SweepFlags:
    """Who computes the cells, and where they are kept."""

    STORE: ClassVar[str] = "--out"

    out: Path | None = sweep_flag(
        "--out STORE",
        "Keep the cells on disk, chunk by chunk, as map.zarr: what is finished survives an "
        "interruption. Without it they are kept in memory.",
    )
    resume: bool = sweep_flag(
        "--resume",
        "Continue the store of --out where it stopped; begin it if it is not there.",
        default=False,
    )
    executor: str = executor_flag()
    workers: int | None = workers_flag()
    chunk: int | None = sweep_flag(
        "--chunk CELLS",
        "Cells that are written at once; by default a 64th of all, from 4096 to "
        "65536, and of slow cells fewer.",
    )
    netcdf: Path | None = options.output_flag(
        "--netcdf FILE", "Save the data as NetCDF, .nc, with units and the meaning of classes."
    )

    def check(
        self, output: OutputFlags, read: Sequence[Path] = (), *, out: Path | None = None
    ) -> None:
        """Refuse, before anything is computed, a file that could not be written afterwards.

        With --resume existing files are written again: the command is given again as it was.

        Parameters
        ----------
        output
            What else is written.
        read
            Files that the command reads.
        out
            Folder that it fills, beside a store.

        Raises
        ------
        OutputError
            As for `OutputFlags.check`; if two flags name one file, or --netcdf names no .nc file,
            one that could not be written, or what writes it is not installed.
        """
        replace(output, force=output.force or self.resume).check(read)
        files = {**output.files, "--netcdf": self.netcdf}
        check_apart(files, {"--out": out, self.STORE: self.out}, read)
        if self.netcdf is None:
            return
        from rocksteady.show.export.netcdf import check_writer

        check_ending("--netcdf", self.netcdf, ".nc")
        check_writer("--netcdf", self.netcdf)
        check_writable("--netcdf", self.netcdf, force=output.force or self.resume)

    def run(self, *, force: bool) -> "Execution":
        """Return how the sweep is run, its store checked.

        Raises
        ------
        InputError, OutputError
            As for `rocksteady.Execution`, and as for `rocksteady.Store` and its `check`.
        InputError
            If an option of a store is given without a store.
        """
        from rocksteady.sweep.run import Execution

        return Execution(
            executor=self.executor, workers=self.workers, store=self._store(force=force)
        )

    def _store(self, *, force: bool) -> "Store | None":
        """Return where the cells are kept, checked; None for memory."""
        from rocksteady.sweep.store.ownership import is_store
        from rocksteady.sweep.store.store import Store

        if self.out is None:
            refuse(
                {"--resume": self.resume, "--chunk": self.chunk},
                f"without {self.STORE} there is no store",
                f"add {self.STORE} map.zarr, or leave it out",
            )
            return None
        impossible = impossible_name(self.out)
        if impossible is not None:
            raise OutputError(self.STORE, self.out, impossible, "name another folder")
        if self.resume and force:
            raise both("--resume", "--force", valid="a store is continued or begun again")
        if is_store(self.out) and not (self.resume or force):
            raise OutputError(
                self.STORE,
                self.out,
                "it exists",
                "add --resume to continue it, or --force to begin again",
            )
        store = Store(self.out, resume=self.resume, overwrite=force, chunk=self.chunk)
        try:
            store.check()
        except OutputError as error:
            raise OutputError(self.STORE, self.out, error.valid, error.hint) from None
        return store

    def write_netcdf(self, dataset: "Callable[[], xarray.Dataset]") -> None:
        """Save the dataset of --netcdf, made where the flag is given."""
        if self.netcdf is None:
            return
        from rocksteady.show.export.netcdf import save_netcdf

        save_netcdf("--netcdf", self.netcdf, dataset())
        announce_file(self.netcdf)

    @contextmanager
    def running(
        self, context: typer.Context, run: "Execution", task: str, cells: int
    ) -> "Iterator[tuple[Execution, Meter]]":
        """Yield a run that shows its progress, and the meter of that; resumable as below.

        Parameters
        ----------
        context
            Context of the command.
        run
            From `run`.
        task, cells
            What is done, and to how many cells.
        """
        with self.resumable(context.find_root().obj), sweeping(task, cells) as meter:
            yield replace(run, progress=meter), meter

    @contextmanager
    def resumable(self, arguments: list[str]) -> Iterator[None]:
        """Say, where the sweep inside is ended, what is kept of it and how it goes on.

        Parameters
        ----------
        arguments
            Arguments of the program.
        """
        from rocksteady.sweep.store.ownership import is_store
        from rocksteady.sweep.store.reading import finished_cells

        try:
            yield
        except (KeyboardInterrupt, UnfinishedError):
            if self.out is not None and is_store(self.out):
                finished, cells = finished_cells(self.out)
                where = printable(self.out)
                kept = f"{finished:,} of {cells:,} cells are kept in {where}; to go on:"
                if finished == cells:
                    kept = f"all {cells:,} cells are kept in {where}; to see the answer:"
                print(f"{kept}\n  {resuming(arguments)}", file=sys.stderr)
            raise


class _KeptRuns(SweepFlags):
    """Flags of a sweep whose store is that of --runs."""

    STORE: ClassVar[str] = "--runs"


@dataclass(frozen=True, kw_only=True)
class RunsFlags:
    """Who computes the runs of an ensemble, and where they are kept, beside a folder of --out."""

    runs: Path | None = sweep_flag(
        "--runs STORE",
        "Keep the runs of the ensemble on disk, as runs.zarr: what is finished survives an "
        "interruption. Without it they are kept in memory.",
    )
    resume: bool = sweep_flag(
        "--resume",
        "Continue the store of --runs where it stopped; begin it if it is not there.",
        default=False,
    )
    executor: str = executor_flag()
    workers: int | None = workers_flag()

    @property
    def sweep(self) -> SweepFlags:
        """The same as flags of a sweep."""
        return _KeptRuns(
            out=self.runs, resume=self.resume, executor=self.executor, workers=self.workers
        )


def resuming(arguments: list[str]) -> str:
    """Return the command that continues a sweep which was begun with some arguments."""
    kept = [argument for argument in arguments if argument not in ("--resume", "--force")]
    return command_of(["rocksteady", *kept, "--resume"])
