"""Executors by their names."""

from contextlib import AbstractContextManager

from rocksteady.errors import InputError
from rocksteady.model.checks.validation import whole_number
from rocksteady.sweep.cases.task import Task
from rocksteady.sweep.executors._pool import Team, usable_cores
from rocksteady.sweep.executors._serial import serial
from rocksteady.sweep.executors._threads import threads

EXECUTORS = ("threads", "dask", "serial")
"""By their names; the address of a scheduler, as tcp://host:8786, names a cluster that is there."""
MOST_WORKERS = 1024


def team_for(task: Task, executor: str, workers: int | None) -> AbstractContextManager[Team]:
    """Return the executor of a valid name, ready to be entered.

    Parameters
    ----------
    task
        What is to be computed.
    executor
        From `validated_executor`.
    workers
        How many; None for as many as this process may use cores, or as a cluster has.
    """
    if executor == "serial":
        return serial(task)
    if executor == "threads":
        return threads(task, usable_cores() if workers is None else workers)
    from rocksteady.sweep.executors._cluster import cluster

    return cluster(task, None if executor == "dask" else executor, workers)


def validated_executor(executor: object) -> str:
    """Return the name of an executor, or the address of a scheduler.

    Raises
    ------
    InputError
        If there is none of that name, or no scheduler can have that address.
    """
    if isinstance(executor, str) and "://" in executor:
        from rocksteady.sweep.executors._address import validated_address

        return validated_address(executor)
    if not isinstance(executor, str) or executor not in EXECUTORS:
        raise InputError(
            name="executor",
            value=executor,
            valid=f"it must be one of {', '.join(EXECUTORS)}, or the address of a dask scheduler",
            hint="leave it out for threads, or give an address as tcp://127.0.0.1:8786",
        )
    return executor


def validated_workers(workers: object) -> int | None:
    """Return a number of workers, or None.

    Raises
    ------
    InputError
        If it is not a whole number from 1 to 1024.
    """
    if workers is None:
        return None
    return whole_number(
        "workers", workers, at_least=1, at_most=MOST_WORKERS, hint="give a number, or leave it out"
    )
