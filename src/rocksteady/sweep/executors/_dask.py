"""Dask plugins: each worker receives the task once, so that a job is two numbers.

Unlike an argument or scattered data, a plugin reaches workers that join later, and does not go with
a worker that dies.
"""

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
from rocksteady.sweep.cases.task import Answer, CellRange, Task


class TaskPlugin(WorkerPlugin):
    """Sends a task once to every worker, also to workers that join later.

    Parameters
    ----------
    task
        Task of the sweep.
    executor
        Name or address of the cluster, for errors.

    Raises
    ------
    InputError
        If the task cannot be sent.
    """

    def __init__(self, task: Task, executor: str) -> None:
        try:
            self._pickled: bytes | None = dumps(task)
        except Exception as error:
            raise InputError(
                "cases",
                task.cases,
                f"other processes need a description of it: {' '.join(str(error).split())}",
                "give a function at module level, and constants that can be pickled",
            ) from error
        self._executor = executor
        self._sources = sources_elsewhere(task)
        self._version = version("rocksteady")
        self._task: Task | None = None
        self._refusal: Exception | None = None

    async def setup(self, worker: Worker) -> None:
        """Unpickle the task in a thread: it imports modules while the worker goes on answering."""
        try:
            self._task = await asyncio.to_thread(self._unpickled, worker.address)
        except Exception as error:
            # Raised by a worker that joins late this is lost: its first job raises it again.
            self._refusal = error
            raise

    def _unpickled(self, address: str) -> Task:
        pickled, self._pickled = self._pickled, None
        assert pickled is not None  # sent as one, and set up once
        try:
            task: Task = loads(pickled)
        except Exception as error:  # noqa: BLE001 -- unpickling runs whatever is imported for it
            raise InputError(
                "executor",
                self._executor,
                f"its worker {address} cannot load the case function and its constants: "
                f"{' '.join(f'{type(error).__name__}: {error}'.split())}",
                "install what it needs there too",
            ) from None
        here = sources_elsewhere(task)
        for module, wanted in self._sources.items():
            if (version_there := here.get(module, "nothing")) != wanted:
                raise InputError(
                    "executor",
                    self._executor,
                    f"its worker {address} has other sources of {module}, {version_there} "
                    f"(rocksteady {version('rocksteady')}), than the caller, {wanted} (rocksteady "
                    f"{self._version})",
                    "install the same version there and restart the worker",
                )
        return task

    def run(self, job: CellRange, seconds: float) -> Answer:
        """Compute the cells of a job until its time is over."""
        if self._refusal is not None:
            raise self._refusal
        assert self._task is not None  # no job comes before the end of setup
        return self._task.run(job, seconds)


def run_job(name: str, job: CellRange, seconds: float) -> Answer:
    """Compute the cells of a job, on a worker that has the plugin of a name."""
    worker = get_worker()
    plugin = worker.plugins.get(name)
    if not isinstance(plugin, TaskPlugin):
        raise UnfinishedError(
            "executor",
            worker.address,
            "this worker has received no task",
            "restart it, and run again: a store can be resumed",
        )
    return plugin.run(job, seconds)


class JoinedWorkers(SchedulerPlugin):
    """Records which workers have joined a scheduler in this process.

    Parameters
    ----------
    processes
        Process ids of the workers, to which this adds.
    """

    def __init__(self, processes: set[int]) -> None:
        self._processes = processes

    def add_worker(self, scheduler: Scheduler, worker: str) -> None:
        """Add the process id of a worker."""
        self._processes.add(scheduler.workers[worker].pid)


@contextmanager
def quiet() -> Iterator[None]:
    """Keep dask's own messages from the terminal: what matters is an error or a warning.

    Only handlers that write to a stream are turned down, so that a log file has all.
    """
    with ExitStack() as stack:
        for name in ("distributed", *logging.root.manager.loggerDict):
            if name.partition(".")[0] in {"distributed", "tornado"}:
                stack.enter_context(silence_logging_cmgr(logging.CRITICAL + 1, name))
        yield
