"""Connection to a running cluster, by the address of its scheduler or by a client."""

import asyncio
import socket
import time
import warnings
from contextlib import ExitStack, suppress
from ipaddress import ip_address
from threading import Thread
from typing import Self

from distributed import Client
from distributed.comm.registry import get_backend
from distributed.core import rpc
from distributed.security import Security

from rocksteady.errors import InputError
from rocksteady.sweep.cases.queue import JOBS_SUBMITTED
from rocksteady.sweep.executors._dask import quiet

ANSWERED = 10.0
"""Seconds in which a scheduler answers."""
PATIENCE = 30.0
"""Seconds without a worker after which a warning is printed."""
SCHEDULER = "a Scheduler does"
"""Answer of a scheduler."""
LOOKED = 1.0
"""Seconds between two looks at the workers."""


class Remote:
    """The running cluster of a scheduler, while it is entered.

    Parameters
    ----------
    place
        Address of the scheduler, or a client that is connected to it and stays so.
    workers
        The most jobs that run at the same time; None for as many as the workers have threads.
    """

    def __init__(self, place: str | Client, workers: int | None) -> None:
        self._given = None if isinstance(place, str) else place
        self.name = place if isinstance(place, str) else str(place.scheduler_info()["address"])
        self._most = workers
        self._threads = 0
        self._looked = 0.0
        self._seen = 0.0
        self._said = False

    def __enter__(self) -> Self:
        """Connect, and wait for a worker.

        Raises
        ------
        InputError
            If no scheduler answers, or there is no worker.
        """
        with ExitStack() as stack:
            stack.enter_context(quiet())
            self.client = self._given or stack.enter_context(_connected(self.name))
            try:
                self.client.wait_for_workers(1, timeout=PATIENCE)
            except TimeoutError as error:
                raise InputError(
                    "executor",
                    self.name,
                    f"the scheduler has had no worker for {PATIENCE:g} seconds",
                    f"start some with 'dask worker {self.name}'",
                ) from error
            if self._given is None and open_to_others(self.name):
                warnings.warn(
                    f"{self.name} has no TLS: everyone who reaches the scheduler or a worker can "
                    "run programs as you; give a tls:// address, or keep others out of the network",
                    stacklevel=2,
                )
            self._look()
            self._stack = stack.pop_all()
        return self

    def __exit__(self, *_: object) -> None:
        """Disconnect."""
        self._stack.close()

    def most_running(self) -> int:
        """Return the number of jobs that run at the same time: one or more."""
        jobs = max(1, self._threads)  # workers may have left since
        return jobs if self._most is None else min(self._most, jobs)

    def most_submitted(self) -> int:
        """Return the number of jobs to submit, running and waiting: one or more."""
        jobs = max(1, JOBS_SUBMITTED * self._threads)
        return jobs if self._most is None else min(self._most, jobs)

    def check_workers(self, *, progress: bool) -> None:
        """Count the workers, and warn if there are none: others may join."""
        if time.monotonic() - self._looked < LOOKED:
            return
        self._look()
        if self._threads or progress:
            self._said = False
        elif time.monotonic() - self._seen > PATIENCE and not self._said:
            self._said = True
            warnings.warn(
                f"{self.name}: the cluster has had no worker for {PATIENCE:g} seconds; what is "
                "left waits for the next one",
                stacklevel=2,
            )

    def _look(self) -> None:
        self._threads = sum(self.client.nthreads().values())
        self._looked = time.monotonic()
        if self._threads:
            self._seen = self._looked


def _connected(address: str) -> Client:
    """Return a client of the scheduler at an address.

    Raises
    ------
    InputError
        If no scheduler answers there.
    """
    # A client that is refused or gets no answer waits when it is closed: first it is asked who
    # answers, in a thread that neither the caller nor the end of its process waits for.
    reasons = ["nothing does"]
    asking = Thread(target=_ask, args=(address, reasons), daemon=True)
    asking.start()
    asking.join(ANSWERED)
    reason = reasons[-1]
    if reason == SCHEDULER:
        try:
            return Client(address, timeout=ANSWERED, set_as_default=False)
        except (OSError, RuntimeError, ImportError) as error:
            reason = _words(error)
    raise InputError(
        "executor",
        address,
        f"a dask scheduler must answer there within {ANSWERED:g} seconds: {reason}",
        "start one with 'dask scheduler' and give the address that it prints, or give a connected "
        "distributed.Client",
    )


def _ask(address: str, answers: list[str]) -> None:
    """Append what answers at an address: `SCHEDULER`, or why it is none."""
    kind, _, place = address.rpartition("://")
    try:
        with suppress(NotImplementedError):  # of kinds without hosts: names take long to look up
            socket.getaddrinfo(*get_backend(kind or "tcp").get_address_host_port(place))
        answers.append(asyncio.run(asyncio.wait_for(_identity(address), ANSWERED)))
    except TimeoutError:
        return
    except Exception as error:  # noqa: BLE001 -- what answers may be anything
        connection = isinstance(error, OSError | TypeError)  # TypeError: of TLS
        answers.append(_words(error) if connection else "something else does")


async def _identity(address: str) -> str:
    """Return the kind of the server at an address."""
    security = Security().get_connection_args("client")
    async with rpc(address, timeout=ANSWERED, connection_args=security) as server:
        return f"a {(await server.identity())['type']} does"


def _words(error: Exception) -> str:
    return " ".join(f"{type(error).__name__}: {error}".split())


def open_to_others(address: str) -> bool:
    """Return whether a scheduler's address is on a network, and its connections have no TLS.

    Who reaches such a scheduler, or its workers, can have them run any program.
    """
    kind, _, place = address.rpartition("://")
    if kind not in {"", "tcp", "ws", "ucx"}:  # tls and wss; inproc never leaves its process
        return False
    host = place.rpartition(":")[0].strip("[]")
    try:
        return not ip_address(host.partition("%")[0]).is_loopback
    except ValueError:
        return host != "localhost" and not host.endswith(".localhost")
