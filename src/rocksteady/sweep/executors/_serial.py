"""One piece after the other, in the thread that asks."""

from collections.abc import Generator, Iterator
from contextlib import contextmanager

from rocksteady.sweep.cases.queue import Deal
from rocksteady.sweep.cases.task import Answer, Task
from rocksteady.sweep.executors._pool import Team

SECONDS = 0.05
"""Of a piece, after which progress is told."""


@contextmanager
def serial(task: Task) -> Iterator[Team]:
    """Run the pieces in this thread."""

    def answers(deal: Deal) -> Generator[Answer, None, None]:
        while (piece := deal.next()) is not None:
            answer = task.run(piece, SECONDS)
            deal.rest_of(answer)
            yield answer

    yield Team(workers=1, answers=answers)
