"""Execution in dask worker processes, on this machine or others."""

import asyncio
import itertools
import uuid
from collections.abc import Callable, Generator, Iterator
from concurrent.futures import CancelledError
from contextlib import ExitStack, contextmanager, suppress
from functools import partial
from queue import Empty, SimpleQueue
from typing import TYPE_CHECKING, Protocol

from rocksteady.errors import InputError, RocksteadyError, UnfinishedError, check_installed
from rocksteady.sweep.cases.queue import Pool, Queue
from rocksteady.sweep.cases.task import Answer, CellRange, Task

if TYPE_CHECKING:
    from distributed import Client, Future

    from rocksteady.sweep.executors._dask import TaskPlugin

    Ended = SimpleQueue[tuple[Future[Answer], Answer | BaseException]]

SECONDS = 0.5
"""Time of a job: long compared with the milliseconds that it takes to send one."""
LOOK = 0.1
"""Seconds without an answer after which the workers are checked, which costs nothing."""
SENDINGS = 10
"""Attempts to send a task: a worker that dies meanwhile is a connection lost, too."""
LOST = (OSError, CancelledError, asyncio.CancelledError)
"""What dask raises when a connection is lost, and for the jobs that were running then."""


class Cluster(Protocol):
    """A cluster of worker processes, while it is entered."""

    name: str
    """Name or address, for errors."""
    client: "Client"

    def most_running(self) -> int:
        """Return the number of jobs that run at the same time: one or more."""
        ...

    def most_submitted(self) -> int:
        """Return the number of jobs to submit, running and waiting: one or more."""
        ...

    def check_workers(self, *, progress: bool) -> None:
        """Check whether workers have ended.

        Parameters
        ----------
        progress
            Whether a job has ended since the last call.

        Raises
        ------
        UnfinishedError
            If workers end again and again.
        """
        ...


@contextmanager
def cluster_pool(task: Task, place: "str | Client | None", workers: int | None) -> Iterator[Pool]:
    """Run the jobs in the worker processes of a cluster.

    Parameters
    ----------
    task
        Task of the sweep, which is sent to each worker once.
    place
        Address of a scheduler, or a client of one; None for a cluster on this machine, which is
        started and stopped.
    workers
        Number of workers; for a running cluster, the most jobs that run at the same time.  None for
        the cores that this process may use, or all workers of the cluster.

    Raises
    ------
    InputError
        If dask is not installed, no scheduler answers, or a worker has other sources.
    UnfinishedError
        If the cluster is lost, or some cells end every worker that tries them.
    """
    check_installed(partial(InputError, "executor", place or "dask"), "cluster", "distributed")
    with ExitStack() as stack:
        cluster: Cluster
        if place is None:
            from rocksteady.sweep.executors._local import Local

            cluster = stack.enter_context(Local(workers))
        else:
            from rocksteady.sweep.executors._remote import Remote

            cluster = stack.enter_context(Remote(place, workers))
        plugin = stack.enter_context(_sent(task, cluster))
        yield Pool(
            workers=cluster.most_running(),
            answers=lambda queue: _answers(queue, task, cluster, plugin),
        )


@contextmanager
def _sent(task: Task, cluster: Cluster) -> Iterator[str]:
    """Send a task to all present and future workers; yield the name of its plugin."""
    from rocksteady.sweep.executors._dask import TaskPlugin

    name = f"rocksteady-{uuid.uuid4().hex}"
    plugin = TaskPlugin(task, cluster.name)
    try:
        with _connected(cluster):
            _register(cluster.client, plugin, name)
    except RocksteadyError:
        raise
    except Exception as error:
        raise InputError(
            "executor",
            cluster.name,
            (
                "its workers must be able to load rocksteady, and one says: "
                + " ".join(f"{type(error).__name__}: {error}".split())
            ),
            "install it there, in the version that is here",
        ) from error
    del plugin  # it is large, and the workers have it now
    try:
        yield name
    finally:
        _tidy(cluster.client, cluster.client.unregister_worker_plugin, name)


def _register(client: "Client", plugin: "TaskPlugin", name: str) -> None:
    """Send a plugin to all workers, and again if a worker dies meanwhile."""
    for tries_left in reversed(range(SENDINGS)):
        try:
            client.register_plugin(plugin, name=name)
        except OSError:
            if not tries_left or client.status != "running":
                raise
        else:
            return


def _answers(
    queue: Queue, task: Task, cluster: Cluster, plugin: str
) -> Generator[Answer, None, None]:
    """Run all jobs of a queue and yield their answers."""
    from rocksteady.sweep.executors._dask import run_job

    client, numbers = cluster.client, itertools.count()
    submitted: dict[Future[Answer], CellRange] = {}
    ended: Ended = SimpleQueue()
    assert client.loop is not None
    start = client.loop.add_callback

    def submit() -> None:
        while len(submitted) < cluster.most_submitted() and (job := queue.next()) is not None:
            key = (plugin, next(numbers))
            future = client.submit(run_job, plugin, job, SECONDS, key=key, pure=False)
            submitted[future] = job
            start(_gather, client, future, ended)

    def finished() -> tuple[list[Answer], list[tuple[BaseException, CellRange]]]:
        done = _next(ended)
        cluster.check_workers(progress=bool(done))
        answers, failed = [], []
        for future, outcome in done:
            job = submitted.pop(future)  # the workers drop an answer without references
            if isinstance(outcome, Answer):
                answers.append(outcome)
            elif future.status == "error":
                failed.append((_error(future), job))
            else:
                raise outcome
        return answers, failed

    try:
        while True:
            with _connected(cluster):
                submit()
                if not submitted:
                    return
                answers, failed = finished()
            for answer in answers:
                queue.put_back(answer)
            yield from answers
            for error, job in failed:
                raise _reason(error, job, task, cluster)
    finally:
        if submitted:
            _tidy(client, client.cancel, list(submitted))


async def _gather(client: "Client", future: "Future[Answer]", ended: "Ended") -> None:
    """Fetch the answer of a job when it has ended, and put it, or its error, into `ended`.

    An answer that is lost with its worker is computed again by another worker, which may have to be
    started first.  So this waits in dask's thread, and not in the thread that starts workers.
    """
    outcome: Answer | BaseException
    try:
        (outcome,) = await client.gather([future], direct=False, asynchronous=True)
    except BaseException as error:  # noqa: BLE001 -- of a job, whatever it is
        outcome = error
    ended.put((future, outcome))


def _tidy(client: "Client", forget: Callable[..., object], *what: object) -> None:
    """Have a scheduler forget something, unless the scheduler is lost."""
    if client.status == "running":  # else dask would try for a while to connect again
        with suppress(*LOST):
            forget(*what)


def _next(ended: "Ended") -> "list[tuple[Future[Answer], Answer | BaseException]]":
    """Return the jobs that have ended since the last call; none if no job ends within `LOOK`."""
    try:
        done = [ended.get(timeout=LOOK)]
    except Empty:
        return []
    with suppress(Empty):
        while True:
            done.append(ended.get_nowait())
    return done


def _error(future: "Future[Answer]") -> BaseException:
    """Return the error of a job, with its traceback on the worker."""
    error: BaseException = future.exception()
    return error.with_traceback(future.traceback())


def _reason(error: BaseException, job: CellRange, task: Task, cluster: Cluster) -> BaseException:
    """Return the error to raise for the error of a job."""
    from distributed import KilledWorker

    if not isinstance(error, KilledWorker):
        return error
    return UnfinishedError(
        "executor",
        cluster.name,
        f"{error.allowed_failures + 1} worker processes ended without an answer when they "
        f"computed {task.words_for(job)}",
        "look for what these cells do to a process, as taking all of its memory, or for what "
        "else ends processes; a store can be resumed",
    )


@contextmanager
def _connected(cluster: Cluster) -> Iterator[None]:
    """Turn the error of a lost connection into one line."""
    try:
        yield
    except LOST as error:
        raise UnfinishedError(
            "executor",
            cluster.name,
            (
                "the connection to the scheduler is lost: "
                + " ".join(f"{type(error).__name__}: {error}".split())
            ),
            "check the cluster and run again: a store can be resumed",
        ) from error
