"""What dask is given: the task for its workers, once, after which a piece is two numbers."""

import asyncio
import logging
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from importlib.metadata import version

from distributed import Scheduler, SchedulerPlugin, Worker, WorkerPlugin, get_worker
from distributed.protocol.pickle import dumps, loads
from distributed.utils import silence_logging_cmgr

from rocksteady.errors import InputError, UnfinishedError
from rocksteady.sweep.cases.inputs import sources_elsewhere
from rocksteady.sweep.cases.task import Answer, Piece, Task


class Parcel(WorkerPlugin):
    """Brings a task to every worker, those that join later included, and unpacks it there once.

    Parameters
    ----------
    task
        What is to be computed.
    executor
        The address of the cluster, for errors.

    Raises
    ------
    InputError
        If the task cannot be sent.
    """

    def __init__(self, task: Task, executor: str) -> None:
        try:
            self._packed: bytes | None = dumps(task)
        except Exception as error:
            raise InputError(
                name="cases",
                value=task.cases,
                valid=f"other processes must be told what it is: {' '.join(str(error).split())}",
                hint="give a function at module level, and constants that can be pickled",
            ) from error
        self._executor = executor
        self._sources = sources_elsewhere(task)
        self._version = version("rocksteady")
        self._task: Task | None = None
        self._refusal: Exception | None = None

    async def setup(self, worker: Worker) -> None:
        """Unpack the task, in a thread: modules are imported, and the worker goes on answering."""
        try:
            self._task = await asyncio.to_thread(self._unpacked, worker.address)
        except Exception as error:
            # Of a worker that joins late nobody hears this: it is raised again by its first piece.
            self._refusal = error
            raise

    def _unpacked(self, address: str) -> Task:
        packed, self._packed = self._packed, None
        assert packed is not None  # sent as one, and set up once
        try:
            task: Task = loads(packed)
        except Exception as error:  # noqa: BLE001 -- unpickling runs whatever is imported for it
            raise InputError(
                name="executor",
                value=self._executor,
                valid=f"its worker {address} cannot load the case function and its constants: "
                f"{' '.join(f'{type(error).__name__}: {error}'.split())}",
                hint="install what it needs there too",
            ) from None
        here = sources_elsewhere(task)
        for module, wanted in self._sources.items():
            if (there := here.get(module, "nothing")) != wanted:
                raise InputError(
                    name="executor",
                    value=self._executor,
                    valid=f"its worker {address} has other sources of {module}, {there} "
                    f"(rocksteady {version('rocksteady')}), than the caller, {wanted} (rocksteady "
                    f"{self._version})",
                    hint="install the same version there and restart the worker",
                )
        return task

    def run(self, piece: Piece, seconds: float) -> Answer:
        """Compute the cells of a piece, as far as one comes in a time."""
        if self._refusal is not None:
            raise self._refusal
        assert self._task is not None  # no piece comes before the end of setup
        return self._task.run(piece, seconds)


def run_piece(name: str, piece: Piece, seconds: float) -> Answer:
    """Compute the cells of a piece, on a worker that has the parcel of a name."""
    worker = get_worker()
    parcel = worker.plugins.get(name)
    if not isinstance(parcel, Parcel):
        raise UnfinishedError(
            name="executor",
            value=worker.address,
            valid="this worker has not been told what to compute",
            hint="restart it, and run again: a store can be resumed",
        )
    return parcel.run(piece, seconds)


class Roll(SchedulerPlugin):
    """Notes the workers that join a scheduler in this process.

    Parameters
    ----------
    processes
        Their process ids: what is added to.
    """

    def __init__(self, processes: set[int]) -> None:
        self._processes = processes

    def add_worker(self, scheduler: Scheduler, worker: str) -> None:
        """Note one, by its address."""
        self._processes.add(scheduler.workers[worker].pid)


@contextmanager
def quiet() -> Iterator[None]:
    """Keep dask's own messages from the terminal: what matters is raised, or a warning.

    Only handlers that write to a stream are turned down, so that a log file has all.
    """
    with ExitStack() as stack:
        for name in ("distributed", *logging.root.manager.loggerDict):
            if name.partition(".")[0] in {"distributed", "tornado"}:
                stack.enter_context(silence_logging_cmgr(logging.CRITICAL + 1, name))
        yield
