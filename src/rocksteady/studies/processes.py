"""Calls side by side, each in one of several processes.

Those of the standard library run the caller's script again, and outlive a caller that is killed.
"""

import pickle
import subprocess
import sys
from collections.abc import Callable, Generator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from queue import SimpleQueue
from typing import Any, TypeVar

from rocksteady.errors import UnfinishedError

T = TypeVar("T")


def in_processes(calls: Sequence[Callable[[], T]], processes: int) -> Generator[T, None, None]:
    """Yield what calls return, in their order.

    Parameters
    ----------
    calls
        What can be pickled, unless this process runs it.
    processes
        How many run them; 1 is this process.

    Raises
    ------
    UnfinishedError
        If a process is ended.
    """
    number = min(processes, len(calls))
    if number < 2:
        yield from (call() for call in calls)
        return
    start = f"import sys; sys.path[:] = {sys.path!r}; from {__name__} import serve; serve()"
    # Ctrl-C in a terminal is for all processes of its group; it is the caller's to act on.
    started = [
        subprocess.Popen(
            [sys.executable, "-c", start],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            start_new_session=True,
        )
        for _ in range(number)
    ]
    idle: SimpleQueue[Any] = SimpleQueue()
    for process in started:
        idle.put(process)

    def run(call: Callable[[], T]) -> T:
        process = idle.get()
        try:
            pickle.dump(call, process.stdin)
            process.stdin.flush()
            answer: T = pickle.load(process.stdout)
        except (EOFError, BrokenPipeError) as ended:
            raise UnfinishedError(
                "processes",
                number,
                f"one of them ended, with status {process.wait()}",
                "see its message above, or what kills it",
            ) from ended
        finally:
            idle.put(process)
        return answer

    threads = ThreadPoolExecutor(number)
    try:
        yield from threads.map(run, calls)
    finally:
        for process in started:
            process.kill()
        threads.shutdown(cancel_futures=True)
        for process in started:
            process.communicate()


def serve() -> None:
    """Run each call that comes on standard input, until the caller closes it or is no more."""
    answers, sys.stdout = sys.stdout.buffer, sys.stderr  # what a call prints is no answer
    with suppress(EOFError, BrokenPipeError):
        while True:
            pickle.dump(pickle.load(sys.stdin.buffer)(), answers)
            answers.flush()
