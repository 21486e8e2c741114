"""Execution in this process: the calling thread, or several threads."""

from collections.abc import Generator, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from contextlib import contextmanager

from rocksteady.sweep.cases.queue import JOBS_SUBMITTED, Pool, Queue, usable_cores
from rocksteady.sweep.cases.task import Answer, Task

SECONDS = 0.2
"""Time of a job: progress is reported after each, and an interruption waits for running jobs."""


@contextmanager
def serial_pool(task: Task, _workers: int | None = None) -> Iterator[Pool]:
    """Run the jobs in this thread, whatever the number of workers."""

    def answers(queue: Queue) -> Generator[Answer, None, None]:
        while (job := queue.next()) is not None:
            answer = task.run(job, SECONDS, queue.many)
            queue.put_back(answer)
            yield answer

    yield Pool(workers=1, answers=answers)


@contextmanager
def thread_pool(task: Task, workers: int | None) -> Iterator[Pool]:
    """Run the jobs in threads, as many as this process may use cores where `workers` is None."""
    count = usable_cores() if workers is None else workers
    threads = ThreadPoolExecutor(count, thread_name_prefix="sweep")

    def answers(queue: Queue) -> Generator[Answer, None, None]:
        submitted: list[Future[Answer]] = []  # in the order of their jobs
        while True:
            while len(submitted) < JOBS_SUBMITTED * count and (job := queue.next()) is not None:
                submitted.append(threads.submit(task.run, job, SECONDS, queue.many))
            if not submitted:
                return
            ended = wait(submitted, return_when=FIRST_COMPLETED).done
            finished = [future for future in submitted if future in ended]
            submitted = [future for future in submitted if future not in ended]
            for future in finished:  # of two errors the same one is raised each time
                queue.put_back(future.result())
            for future in finished:
                yield future.result()

    try:
        yield Pool(workers=count, answers=answers)
    finally:
        threads.shutdown(wait=True, cancel_futures=True)
