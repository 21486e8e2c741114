"""Executors in this process: the calling thread, or several threads, which kernels let run."""

from collections.abc import Generator, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from contextlib import contextmanager

from rocksteady.sweep.cases.queue import WAITING, Deal, Team
from rocksteady.sweep.cases.task import Answer, Task

SECONDS = 0.05
"""Of a piece, after which progress is told; an interruption waits for those under way."""


@contextmanager
def serial(task: Task) -> Iterator[Team]:
    """Run the pieces in this thread."""

    def answers(deal: Deal) -> Generator[Answer, None, None]:
        while (piece := deal.next()) is not None:
            answer = task.run(piece, SECONDS)
            deal.rest_of(answer)
            yield answer

    yield Team(workers=1, answers=answers)


@contextmanager
def threads(task: Task, workers: int) -> Iterator[Team]:
    """Run the pieces in a pool of threads."""
    pool = ThreadPoolExecutor(workers, thread_name_prefix="sweep")

    def answers(deal: Deal) -> Generator[Answer, None, None]:
        running: list[Future[Answer]] = []  # in the order in which they were handed out
        while True:
            while len(running) < WAITING * workers and (piece := deal.next()) is not None:
                running.append(pool.submit(task.run, piece, SECONDS))
            if not running:
                return
            ended = wait(running, return_when=FIRST_COMPLETED).done
            finished = [future for future in running if future in ended]
            running = [future for future in running if future not in ended]
            for future in finished:  # of two errors the same one is raised each time
                deal.rest_of(future.result())
            for future in finished:
                yield future.result()

    try:
        yield Team(workers=workers, answers=answers)
    finally:
        pool.shutdown(wait=True, cancel_futures=True)
