"""The deal: which cells are still to be handed out, and how many of them at once."""

import os
from collections import deque
from collections.abc import Callable, Generator, Sequence
from dataclasses import dataclass

from rocksteady.sweep.cases.task import Answer, Piece

ROUNDS = 4
"""In how many more pieces a worker's share of what is left is handed out.  Pieces become smaller
towards the end, so that all workers finish together."""
WAITING = 2
"""Pieces for each worker, one of which waits: no worker waits for the calling thread."""


class Deal:
    """Hands out pieces of ranges of cells in their order, and takes back what was not done.

    Parameters
    ----------
    ranges
        The cells: a piece lies in one of them.
    workers
        Among how many it is dealt.
    batch
        A piece has no fewer cells, but for the last of a range.

    Attributes
    ----------
    left
        Cells that have not been handed out.
    """

    def __init__(self, ranges: Sequence[Piece], *, workers: int, batch: int) -> None:
        self._ranges = deque(ranges)
        self._shares = ROUNDS * workers
        self._batch = batch
        self.left = sum(stop - first for first, stop in ranges)

    def next(self) -> Piece | None:
        """Return the next piece; None where nothing is left."""
        if not self._ranges:
            return None
        first, stop = self._ranges.popleft()
        cells = max(self._batch, -(-self.left // self._shares))
        if stop - first > cells:
            self._ranges.appendleft((first + cells, stop))
            stop = first + cells
        self.left -= stop - first
        return first, stop

    def rest_of(self, answer: Answer) -> None:
        """Take back the cells of a piece that were not done: they come first."""
        stop = answer.piece[1]
        if answer.stop < stop:
            self._ranges.appendleft((answer.stop, stop))
            self.left += stop - answer.stop


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
