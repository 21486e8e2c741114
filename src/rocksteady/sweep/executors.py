"""Who runs the pieces of a grid.

An executor is a function that takes a task and the pieces, calls the task once for each piece and
yields (piece, answer) in whatever order they are done.  Pieces do not depend on each other, so that
no executor changes an answer.  A new one is a new entry of `EXECUTORS`.
"""

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from typing import TypeVar

from rocksteady.errors import InputError
from rocksteady.model.validation import whole_number

AnswerT = TypeVar("AnswerT")
Piece = tuple[int, int]
"""First cell, and the one after the last."""
Task = Callable[[Piece], AnswerT]

MOST_WORKERS = 1024


def serial(
    task: Task[AnswerT],
    pieces: Sequence[Piece],
    workers: int,  # noqa: ARG001 -- an executor has it
) -> Iterator[tuple[Piece, AnswerT]]:
    """Run the pieces in this thread, one after the other."""
    for piece in pieces:
        yield piece, task(piece)


def threads(
    task: Task[AnswerT], pieces: Sequence[Piece], workers: int
) -> Iterator[tuple[Piece, AnswerT]]:
    """Run the pieces in threads: compiled kernels let each other run.

    Whatever ends the iteration early, an error or an interruption, cancels the pieces that have not
    begun; those that have are waited for, which takes as long as a piece takes.
    """
    pool = ThreadPoolExecutor(workers, thread_name_prefix="sweep")
    try:
        futures = {pool.submit(task, piece): piece for piece in pieces}
        for future in as_completed(futures):
            yield futures.pop(future), future.result()
    finally:
        pool.shutdown(wait=True, cancel_futures=True)


EXECUTORS: Mapping[str, Callable[..., Iterator[tuple[Piece, object]]]] = {
    "threads": threads,
    "serial": serial,
}
"""By their names."""


def validated_executor(executor: object) -> str:
    """Return the name of an executor.

    Raises
    ------
    InputError
        If there is none of that name.
    """
    if not isinstance(executor, str) or executor not in EXECUTORS:
        raise InputError(
            name="executor",
            value=executor,
            valid=f"it must be one of {', '.join(EXECUTORS)}",
            hint="leave it out for threads",
        )
    return executor


def validated_workers(workers: object) -> int:
    """Return a number of workers; for None as many as this process may use cores.

    Raises
    ------
    InputError
        If it is not a whole number from 1 to 1024.
    """
    if workers is None:
        return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else cores()
    return whole_number(
        "workers", workers, at_least=1, at_most=MOST_WORKERS, hint="give a number of threads"
    )


def cores() -> int:
    """Return how many cores there are."""
    return os.cpu_count() or 1
