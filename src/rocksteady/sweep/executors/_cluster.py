"""Worker processes, on this machine or on others, with dask."""

import asyncio
import itertools
import uuid
from collections.abc import Callable, Generator, Iterator
from concurrent.futures import CancelledError
from contextlib import ExitStack, contextmanager, suppress
from importlib.util import find_spec
from queue import Empty, SimpleQueue
from typing import TYPE_CHECKING, Protocol

from rocksteady.errors import InputError, RocksteadyError, UnfinishedError
from rocksteady.sweep.cases.queue import Deal, Team
from rocksteady.sweep.cases.task import Answer, Piece, Task

if TYPE_CHECKING:
    from distributed import Client, Future

    from rocksteady.sweep.executors._dask import Parcel

    Ended = SimpleQueue[tuple[Future[Answer], Answer | BaseException]]

SECONDS = 0.5
"""Of a piece: long beside the milliseconds that it takes to send one."""
LOOK = 0.1
"""Seconds after which one looks after the workers, where no answer comes: it costs nothing."""
SENDINGS = 10
"""Attempts to send a task: a worker that dies meanwhile is a connection lost, too."""
LOST = (OSError, CancelledError, asyncio.CancelledError)
"""What dask raises where a connection is lost, and of pieces that were under way then."""


class Members(Protocol):
    """A cluster, while it is entered."""

    name: str
    """For errors."""
    client: "Client"

    def at_once(self) -> int:
        """Return how many pieces it works on at the same time."""
        ...

    def in_flight(self) -> int:
        """Return how many pieces it is to have, those included that wait there: one or more."""
        ...

    def mend(self, *, progress: bool) -> None:
        """Look after the workers; be told whether anything has been computed since the last time.

        Raises
        ------
        UnfinishedError
            If there is no hope.
        """
        ...


@contextmanager
def cluster(task: Task, address: str | None, workers: int | None) -> Iterator[Team]:
    """Run the pieces in the worker processes of a cluster.

    Parameters
    ----------
    task
        What is to be computed: it is sent to each worker once.
    address
        Of a scheduler; None for a cluster on this machine that lasts as long as this.
    workers
        How many; of a cluster that is there, on how many pieces it works at the same time.  By
        default as many as this process may use cores, or as the cluster has.

    Raises
    ------
    InputError
        If dask is not installed, nobody answers, or a worker has other sources.
    UnfinishedError
        If the cluster is lost, or some cells end every worker that tries them.
    """
    if find_spec("distributed") is None:
        raise InputError(
            name="executor",
            value=address or "dask",
            valid="dask is not installed",
            hint="install rocksteady[cluster], or leave the executor out for threads",
        )
    with ExitStack() as stack:
        members: Members
        if address is None:
            from rocksteady.sweep.executors._local import Local

            members = stack.enter_context(Local(workers))
        else:
            from rocksteady.sweep.executors._remote import Given

            members = stack.enter_context(Given(address, workers))
        parcel = stack.enter_context(_sent(task, members))
        yield Team(
            workers=members.at_once(),
            answers=lambda deal: _answers(deal, task, members, parcel),
        )


@contextmanager
def _sent(task: Task, members: Members) -> Iterator[str]:
    """Send a task to all workers, those that join later included; yield its name there."""
    from rocksteady.sweep.executors._dask import Parcel

    name = f"rocksteady-{uuid.uuid4().hex}"
    parcel = Parcel(task, members.name)
    try:
        with _connected(members):
            _register(members.client, parcel, name)
    except RocksteadyError:
        raise
    except Exception as error:
        raise InputError(
            name="executor",
            value=members.name,
            valid="its workers must be able to load rocksteady, and one says: "
            + " ".join(f"{type(error).__name__}: {error}".split()),
            hint="install it there, in the version that is here",
        ) from error
    del parcel  # what it holds is large, and elsewhere now
    try:
        yield name
    finally:
        _tidy(members.client, members.client.unregister_worker_plugin, name)


def _register(client: "Client", parcel: "Parcel", name: str) -> None:
    """Send a parcel to all workers, again where one of them dies while it gets it."""
    for tries_left in reversed(range(SENDINGS)):
        try:
            client.register_plugin(parcel, name=name)
        except OSError:
            if not tries_left or client.status != "running":
                raise
        else:
            return


def _answers(
    deal: Deal, task: Task, members: Members, parcel: str
) -> Generator[Answer, None, None]:
    """Have every piece of a deal done."""
    from rocksteady.sweep.executors._dask import run_piece

    client, numbers = members.client, itertools.count()
    running: dict[Future[Answer], Piece] = {}
    ended: Ended = SimpleQueue()
    assert client.loop is not None
    bring = client.loop.add_callback

    def fill() -> None:
        while len(running) < members.in_flight() and (piece := deal.next()) is not None:
            key = (parcel, next(numbers))
            future = client.submit(run_piece, parcel, piece, SECONDS, key=key, pure=False)
            running[future] = piece
            bring(_brought, client, future, ended)

    def finished() -> tuple[list[Answer], list[tuple[BaseException, Piece]]]:
        done = _next(ended)
        members.mend(progress=bool(done))
        found, failed = [], []
        for future, outcome in done:
            piece = running.pop(future)  # the workers forget an answer that nobody refers to
            if isinstance(outcome, Answer):
                found.append(outcome)
            elif future.status == "error":
                failed.append((_error(future), piece))
            else:
                raise outcome
        return found, failed

    try:
        while True:
            with _connected(members):
                fill()
                if not running:
                    return
                found, failed = finished()
            for answer in found:
                deal.rest_of(answer)
            yield from found
            for error, piece in failed:
                raise _reason(error, piece, task, members)
    finally:
        if running:
            _tidy(client, client.cancel, list(running))


async def _brought(client: "Client", future: "Future[Answer]", ended: "Ended") -> None:
    """Bring an answer here when it is there, and say so, or why it does not come.

    What is lost on the way with its worker is computed again by another one, which may have to be
    started first: this waits for it, in dask's thread, and the thread that starts workers does not.
    """
    outcome: Answer | BaseException
    try:
        (outcome,) = await client.gather([future], direct=False, asynchronous=True)
    except BaseException as error:  # noqa: BLE001 -- of a piece, whatever it is
        outcome = error
    ended.put((future, outcome))


def _tidy(client: "Client", forget: Callable[..., object], *what: object) -> None:
    """Have a scheduler forget something, unless it is lost and all that is there with it."""
    if client.status == "running":  # else dask would try for a while to connect again
        with suppress(*LOST):
            forget(*what)


def _next(ended: "Ended") -> "list[tuple[Future[Answer], Answer | BaseException]]":
    """Return what has ended since the last time; nothing where that takes a while."""
    try:
        done = [ended.get(timeout=LOOK)]
    except Empty:
        return []
    with suppress(Empty):
        while True:
            done.append(ended.get_nowait())
    return done


def _error(future: "Future[Answer]") -> BaseException:
    """Return what a piece raised, with where it did so on its worker."""
    error: BaseException = future.exception()
    return error.with_traceback(future.traceback())


def _reason(error: BaseException, piece: Piece, task: Task, members: Members) -> BaseException:
    """Return what to raise for the error of a piece."""
    from distributed import KilledWorker

    if not isinstance(error, KilledWorker):
        return error
    return UnfinishedError(
        name="executor",
        value=members.name,
        valid=f"{error.allowed_failures + 1} worker processes ended without an answer when they "
        f"computed {task.words_for(piece)}",
        hint="look for what these cells do to a process, as taking all of its memory, or for what "
        "else ends processes; a store can be resumed",
    )


@contextmanager
def _connected(members: Members) -> Iterator[None]:
    """Say in one line that the connection is lost, where it is."""
    try:
        yield
    except LOST as error:
        raise UnfinishedError(
            name="executor",
            value=members.name,
            valid="the connection to the scheduler is lost: "
            + " ".join(f"{type(error).__name__}: {error}".split()),
            hint="check the cluster and run again: a store can be resumed",
        ) from error
