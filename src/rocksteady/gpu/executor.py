"""Execution on a GPU: threads that call the case function, each with a stream of its own."""

import math
import time
from collections.abc import Generator, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from contextlib import ExitStack, contextmanager
from queue import SimpleQueue
from typing import NamedTuple

from rocksteady.errors import InputError, UnfinishedError
from rocksteady.gpu._nvidia import Gpu, Stream, gpu
from rocksteady.gpu._programs import check_programs
from rocksteady.kernels.devices import FORMS
from rocksteady.kernels.machine_code.device import DeviceMemoryError, on_device
from rocksteady.results.numbers import plural
from rocksteady.sweep.cases.queue import JOBS_SUBMITTED, Pool, Queue
from rocksteady.sweep.cases.task import GROWTH, Answer, CellRange, Task

LAUNCHES = 3
"""Default number of launches in flight: one computes, while another's cells are prepared and the
results of a third are copied and kept."""
FULL = 4
"""Cells for each thread of the GPU in a call: threads whose cells are short take the next ones."""
SHORT, LONG = 0.5, 2.0
"""Seconds of a call below which the next one takes more cells, and above which it takes fewer.  An
interruption waits for the calls in flight."""
MOST = 2**20
"""The most cells of a call."""
TRIED, GOLDEN = 16, (math.sqrt(5.0) - 1.0) / 2.0
"""Cells that a case function computes first, and their distance as a share of all: they lie all
over the grid, for some, as those without a start, may have no work for a GPU."""
FEWEST = 32
"""The fewest cells of a call for which memory that does not suffice is tried with fewer."""


class Launched(NamedTuple):
    """Answers of one call of the case function, and how it went."""

    answers: list[Answer]
    seconds: float
    enough: int
    """The most cells for which the memory of the GPU suffices, as far as it is known."""


def find_gpu() -> Gpu:
    """Return the GPU of this machine, with the programs that it runs.

    Raises
    ------
    InputError
        If there is no GPU that can run the kernels, or a program is missing.
    """
    device = gpu()
    check_programs(FORMS.values(), device.capability)
    return device


@contextmanager
def gpu_pool(task: Task, workers: int | None) -> Iterator[Pool]:
    """Run the jobs in threads that share a GPU, `LAUNCHES` where `workers` is None.

    A call takes several jobs, as many cells as keep the GPU busy, whatever the task's batch is.
    The few cells that need more memory than a thread of the GPU has are computed by the processor.

    Raises
    ------
    InputError
        If there is no GPU that can run the kernels, or the case function calls none of them.
    UnfinishedError
        If the GPU fails, or has no memory even for a few cells.
    """
    device = find_gpu()
    count = LAUNCHES if workers is None else workers
    with ExitStack() as stack:
        streams: SimpleQueue[Stream] = SimpleQueue()
        try:
            for _ in range(count):
                streams.put(stack.enter_context(device.stream()))
        except DeviceMemoryError as error:
            raise _memory_error(device, plural(count, "stream")) from error
        threads = ThreadPoolExecutor(count, thread_name_prefix="sweep")
        stack.callback(threads.shutdown, wait=True, cancel_futures=True)
        _check_cases(task, streams, device)

        def launched(jobs: list[CellRange]) -> Launched:
            stream = streams.get()
            try:
                began = time.monotonic()
                answers, enough = _computed(task, jobs, stream, device)
                return Launched(answers, time.monotonic() - began, enough)
            finally:
                streams.put(stream)

        def answers(queue: Queue) -> Generator[Answer, None, None]:
            size, most = task.batch, MOST
            submitted: list[Future[Launched]] = []  # in the order of their jobs
            while True:
                while len(submitted) < JOBS_SUBMITTED * count and (jobs := _next(queue, size)):
                    submitted.append(threads.submit(launched, jobs))
                if not submitted:
                    return
                ended = wait(submitted, return_when=FIRST_COMPLETED).done
                finished = [future for future in submitted if future in ended]
                submitted = [future for future in submitted if future not in ended]
                results = [future.result() for future in finished]
                for result in results:
                    most = min(most, result.enough)
                    cells = sum(answer.stop - answer.job[0] for answer in result.answers)
                    size = next_size(cells, result.seconds, full=FULL * device.threads, most=most)
                for result in results:
                    yield from result.answers

        yield Pool(workers=count, answers=answers)


def next_size(cells: int, seconds: float, *, full: int, most: int) -> int:
    """Return how many cells the next call takes, after a call of `cells` that took `seconds`.

    Up to `full` cells each has a thread that would be idle otherwise, and more of them hardly take
    longer.
    """
    if seconds > LONG:
        size = cells // 2
    elif cells < full:
        size = min(GROWTH * cells, full)
    else:
        size = cells * (2 if seconds < SHORT else 1)
    return max(1, min(size, most))


def _next(queue: Queue, size: int) -> list[CellRange]:
    """Return the next jobs of a queue, `size` cells together; none if it is empty."""
    jobs: list[CellRange] = []
    while size > 0 and (job := queue.next(size)) is not None:
        jobs.append(job)
        size -= job[1] - job[0]
    return jobs


def _check_cases(task: Task, streams: "SimpleQueue[Stream]", device: Gpu) -> None:
    """Refuse a case function that calls no kernel with a program for GPUs, by a few cells.

    Raises
    ------
    InputError
        If it calls none.
    """
    size = task.grid.size
    cells = sorted({int(size * (GOLDEN * number % 1.0)) for number in range(TRIED)})
    stream = streams.get()
    calls = stream.calls
    _computed(task, [(cell, cell + 1) for cell in cells], stream, device)
    streams.put(stream)
    if stream.calls == calls:
        raise InputError(
            "executor",
            "gpu",
            "a GPU computes fates and attractors under harmonic shaking, and runs of blocks on "
            "records, and this calls for none of them",
            "leave the executor out for threads",
        )


def _computed(
    task: Task, jobs: list[CellRange], stream: Stream, device: Gpu
) -> tuple[list[Answer], int]:
    """Return the answers of some jobs, in parts where the memory of the GPU does not suffice."""
    cells = sum(stop - first for first, stop in jobs)
    try:
        with on_device(stream):
            return task.together(jobs), MOST
    except DeviceMemoryError as error:
        if cells < FEWEST:
            raise _memory_error(device, f"{cells} cells at a time") from error
    first, second = halves(jobs)
    answers, enough = _computed(task, first, stream, device)
    more, enough_too = _computed(task, second, stream, device)
    return answers + more, min(enough, enough_too, math.ceil(cells / 2))


def _memory_error(device: Gpu, what: str) -> UnfinishedError:
    return UnfinishedError(
        "executor",
        "gpu",
        f"the memory of {device.name} does not suffice for {what}",
        "end what else uses it, or give fewer workers; a store can be resumed",
    )


def halves(jobs: list[CellRange]) -> tuple[list[CellRange], list[CellRange]]:
    """Return the first half of the cells of some jobs, and the second."""
    left = sum(stop - first for first, stop in jobs) // 2
    before: list[CellRange] = []
    after: list[CellRange] = []
    for first, stop in jobs:
        middle = min(first + left, stop)
        left -= middle - first
        if first < middle:
            before.append((first, middle))
        if middle < stop:
            after.append((middle, stop))
    return before, after
