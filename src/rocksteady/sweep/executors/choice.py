"""Choice of an executor: by its name, the address of a scheduler, or a client of dask."""

import sys
from collections.abc import Callable
from contextlib import AbstractContextManager, suppress
from importlib.util import find_spec
from typing import TYPE_CHECKING, TypeGuard

from rocksteady.errors import InputError
from rocksteady.leaves import NO_GPU, import_if_present
from rocksteady.model.checks.bounds import Whole
from rocksteady.sweep.cases.queue import Pool
from rocksteady.sweep.cases.task import Task
from rocksteady.sweep.executors._threads import serial_pool, thread_pool

if TYPE_CHECKING:
    from distributed import Client

WORKERS = Whole(1, 1024, "give a number, or leave it out")
MOST_PORTS = 65535


def pool_for(
    task: Task, executor: "str | Client", workers: int | None
) -> AbstractContextManager[Pool]:
    """Return the pool of workers of an executor, to be entered.

    Parameters
    ----------
    task
        Task of the sweep.
    executor
        From `validated_executor`.
    workers
        Number of workers; None for the cores that this process may use, all of a cluster, or three
        on a GPU.
    """
    if isinstance(executor, str) and executor in EXECUTORS:
        return EXECUTORS[executor](task, workers)
    # Once more: a client may have been closed since.
    return _dask_pool(task, workers, validated_executor("executor", executor))


def _dask_pool(
    task: Task, workers: int | None, place: "str | Client | None" = None
) -> AbstractContextManager[Pool]:
    """Return the workers of a running cluster, or of one that is started on this machine."""
    from rocksteady.sweep.executors._cluster import cluster_pool

    return cluster_pool(task, place, workers)


def _gpu_pool(task: Task, workers: int | None) -> AbstractContextManager[Pool]:
    """Return the workers that share the GPU of this machine."""
    leaf = import_if_present("gpu.executor")
    if leaf is None:
        raise InputError("executor", "gpu", NO_GPU, "leave it out for threads")
    pool: AbstractContextManager[Pool] = leaf.gpu_pool(task, workers)
    return pool


EXECUTORS: dict[str, Callable[[Task, int | None], AbstractContextManager[Pool]]] = {
    "threads": thread_pool,
    "gpu": _gpu_pool,
    "dask": _dask_pool,
    "serial": serial_pool,
}
"""Pools by name.  The address of a scheduler, as tcp://host:8786, stands for a running cluster."""


def validated_executor(name: str, value: object) -> "str | Client":
    """Return the name of an executor, the address of a scheduler, or a client.

    Raises
    ------
    InputError
        If there is none of that name, no scheduler can have that address, or the client is not
        connected or asynchronous.
    """
    if _is_client(value):
        if value.status != "running" or value.asynchronous:
            raise InputError(
                name,
                value,
                "a client must be connected, and not asynchronous",
                "connect it, and close it after the sweep",
            )
        return value
    if isinstance(value, str) and "://" in value:
        return _validated_address(value)
    if not isinstance(value, str) or value not in EXECUTORS:
        raise InputError(
            name,
            value,
            f"it must be one of {', '.join(EXECUTORS)}, the address of a dask scheduler, or a "
            "distributed.Client",
            "leave it out for threads, or give an address as tcp://127.0.0.1:8786",
        )
    return value


def _is_client(value: object) -> "TypeGuard[Client]":
    """Return whether a value is a client of dask, which has been imported then."""
    distributed = sys.modules.get("distributed")
    return distributed is not None and isinstance(value, distributed.Client)


def _validated_address(address: str) -> str:
    """Return an address that a scheduler may have.

    Raises
    ------
    InputError
        If dask has no such kind of address, or it has no host or no port.
    """
    if find_spec("distributed") is None:
        return address  # connecting to it shows that
    from distributed.comm.registry import backends, get_backend

    kind, _, place = address.rpartition("://")  # as dask does
    try:
        backend = get_backend(kind)
    except (ValueError, ImportError) as error:
        known = ", ".join(sorted(backends))
        raise _refused_address(address, f"dask accepts addresses of the kinds {known}") from error
    with suppress(NotImplementedError):  # of kinds without hosts and ports
        try:
            host, port = backend.get_address_host_port(place)
        except ValueError:
            host, port = "", 0
        if not host or not 0 < port <= MOST_PORTS:
            raise _refused_address(
                address, f"it must have a host and a port, a number from 1 to {MOST_PORTS}"
            )
    return address


def _refused_address(address: str, valid: str) -> InputError:
    return InputError("executor", address, valid, "give it as tcp://127.0.0.1:8786")
