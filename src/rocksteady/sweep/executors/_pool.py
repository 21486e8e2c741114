"""What every executor gives: a number of workers, and a way to have a deal done."""

import os
from collections.abc import Callable, Generator
from dataclasses import dataclass

from rocksteady.sweep.cases.queue import Deal
from rocksteady.sweep.cases.task import Answer

WAITING = 2
"""Pieces for each worker, one of which waits: no worker waits for the calling thread."""


@dataclass(frozen=True, kw_only=True)
class Team:
    """Workers that are ready.

    Attributes
    ----------
    workers
        How many pieces they work on at the same time.
    answers
        Has every piece of a deal done and yields what was found, in whatever order it comes.
        Whatever ends the iteration early, an error or an interruption, leaves nothing running.
    """

    workers: int
    answers: Callable[[Deal], Generator[Answer, None, None]]


def usable_cores() -> int:
    """Return how many cores this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
