"""Queue of jobs, each a range of cells, and the pool of workers that runs them."""

import os
from collections import deque
from collections.abc import Callable, Generator, Sequence
from dataclasses import dataclass

from rocksteady.sweep.cases.task import Answer, CellRange

JOBS_LEFT = 4
"""Jobs per worker into which the remaining cells are split.  So jobs become smaller towards the
end, and all workers finish together."""
JOBS_SUBMITTED = 2
"""Jobs per worker that are submitted: one runs, one waits, and no worker waits for the caller."""


class Queue:
    """Splits ranges of cells into jobs, in order, and takes back cells that were not computed.

    Parameters
    ----------
    ranges
        Cells to compute.  Each job lies in one of the ranges.
    workers
        Number of jobs that run at the same time.
    batch
        Fewest cells of a job, except for the last job of a range.

    Attributes
    ----------
    left
        Number of cells in the queue.
    many
        Cells with which the calls of the next job may begin, by the last answer.
    """

    def __init__(self, ranges: Sequence[CellRange], *, workers: int, batch: int) -> None:
        self._ranges = deque(ranges)
        self._most_jobs = JOBS_LEFT * workers
        self._batch = batch
        self.many = 1
        self.left = sum(stop - first for first, stop in ranges)

    def next(self, cells: int | None = None) -> CellRange | None:
        """Return the next job; None if the queue is empty.

        Parameters
        ----------
        cells
            Largest number of cells of the job; by default a share of the cells that are left.
        """
        if not self._ranges:
            return None
        first, stop = self._ranges.popleft()
        if cells is None:
            cells = max(self._batch, -(-self.left // self._most_jobs))
        if stop - first > cells:
            self._ranges.appendleft((first + cells, stop))
            stop = first + cells
        self.left -= stop - first
        return first, stop

    def put_back(self, answer: Answer) -> None:
        """Put the cells of a job that were not computed at the front of the queue."""
        self.many = answer.many
        stop = answer.job[1]
        if answer.stop < stop:
            self._ranges.appendleft((answer.stop, stop))
            self.left += stop - answer.stop


@dataclass(frozen=True, kw_only=True)
class Pool:
    """Workers that are ready.

    Attributes
    ----------
    workers
        Number of jobs that run at the same time.
    answers
        Runs all jobs of a queue and yields their answers in any order.  If an error or an
        interruption ends the iteration early, no job goes on.
    """

    workers: int
    answers: Callable[[Queue], Generator[Answer, None, None]]


def usable_cores() -> int:
    """Return the number of cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
