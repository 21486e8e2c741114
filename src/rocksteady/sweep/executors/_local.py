"""Cluster on this machine: scheduler in this process, workers in their own processes.

The workers are started here and not by dask, whose way runs the caller's script again in each of
them, sends them the terminal's interruptions, and takes seconds to end them.
"""

import json
import signal
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from tempfile import TemporaryDirectory
from typing import Self

from rocksteady.errors import UnfinishedError
from rocksteady.sweep.cases.queue import JOBS_SUBMITTED, usable_cores
from rocksteady.sweep.executors._worker import LOOPBACK, START

TRIES = 4
"""How often each worker is started, on average, while none of them joins."""
KILLS = 20
"""The same where a signal ends them: what sends it, a lack of memory too, may not last."""

NO_PAGES = {"dashboard": False, "dashboard_address": f"{LOOPBACK}:0"}
"""Of a scheduler: no web pages about it, and no complaint that another one has their usual port."""


class WorkerProcesses:
    """Processes of workers, kept at their number.

    Parameters
    ----------
    workers
        Number of workers.
    folder
        Folder for temporary files.
    """

    def __init__(self, workers: int, folder: str) -> None:
        self._folder = folder
        self._lost = 0
        self._address = ""
        self.joined: set[int] = set()
        """Process ids of the workers that have joined: the scheduler adds to it."""
        self._processes: list[subprocess.Popen[str]] = []
        try:
            for _ in range(workers):
                self._processes.append(_started(folder))
        except BaseException:
            self.end()
            raise

    def connect(self, address: str) -> None:
        """Send the address of the scheduler to the workers."""
        self._address = address
        for process in self._processes:
            _write(process, address)

    def replace_ended(self, *, progress: bool) -> None:
        """Start a worker for each one that has ended.

        Parameters
        ----------
        progress
            Whether a job has ended since the last call.

        Raises
        ------
        UnfinishedError
            If they end again and again before they have joined.  Those that end later are counted
            by the scheduler, job by job: what ends them has nothing to do with how they start.
        """
        if progress:
            self._lost = 0
        for place, process in enumerate(self._processes):
            if process.poll() is None:
                continue
            if process.pid in self.joined:
                self.joined.discard(process.pid)
                self._lost = 0
            else:
                self._lost += 1
            most = TRIES if process.returncode >= 0 else KILLS
            if self._lost >= most * len(self._processes):
                raise UnfinishedError(
                    "executor",
                    "dask",
                    f"its worker processes end at once, {_how(process.returncode)}",
                    "see their messages above, or what kills them, or compute with threads",
                )
            _closed(process)
            self._processes[place] = _started(self._folder)
            _write(self._processes[place], self._address)

    def end(self) -> None:
        """End the workers, whatever they are doing."""
        for process in self._processes:
            process.kill()
        for process in self._processes:
            process.wait()
            _closed(process)


def _how(status: int) -> str:
    """Return how a process has ended, in words."""
    return f"with status {status}" if status >= 0 else f"by signal {-status}"


def _started(folder: str) -> "subprocess.Popen[str]":
    """Start the process of a worker, which uses a folder and removes it where the caller dies."""
    process = subprocess.Popen(
        [sys.executable, "-c", START],
        stdin=subprocess.PIPE,
        text=True,
        encoding="utf-8",
        # Ctrl-C in a terminal is for all processes of its group; it is the caller's to act on.
        start_new_session=True,
    )
    _write(process, [sys.path, folder])
    return process


def _write(process: "subprocess.Popen[str]", words: object) -> None:
    """Write a line to a process, which may have ended already and is replaced then."""
    assert process.stdin is not None
    with suppress(BrokenPipeError):
        process.stdin.write(json.dumps(words) + "\n")
        process.stdin.flush()


def _closed(process: "subprocess.Popen[str]") -> None:
    """Close the pipe to a process that has ended."""
    assert process.stdin is not None
    with suppress(BrokenPipeError):
        process.stdin.close()


class Local:
    """A scheduler in this process and its workers, while it is entered.

    Parameters
    ----------
    workers
        Number of workers; None for the cores that this process may use.
    """

    name = "dask"

    def __init__(self, workers: int | None) -> None:
        self._number = usable_cores() if workers is None else workers

    def __enter__(self) -> Self:
        """Start scheduler and workers."""
        self._stack = ExitStack()
        try:
            with _interruptions_deferred():
                self._start(self._stack)
        except BaseException:
            self.__exit__()
            raise
        return self

    def _start(self, stack: ExitStack) -> None:
        folder = stack.enter_context(TemporaryDirectory(prefix="rocksteady-"))
        self._workers = WorkerProcesses(self._number, folder)
        stack.callback(self._workers.end)
        import dask
        from distributed import Client, LocalCluster  # while the workers import it, too

        from rocksteady.sweep.executors._dask import JoinedWorkers, quiet

        stack.enter_context(quiet())
        settings = {
            # No job waits at a worker behind another: when a worker dies, its job is known.
            "distributed.scheduler.worker-saturation": 1.0,
            "temporary-directory": folder,
        }
        with dask.config.set(settings):
            scheduler = LocalCluster(
                n_workers=0,
                host=LOOPBACK,
                protocol="tcp://",
                silence_logs=False,
                scheduler_kwargs=NO_PAGES,
            )
        stack.callback(scheduler.close)
        assert scheduler.scheduler is not None
        scheduler.scheduler.add_plugin(JoinedWorkers(self._workers.joined))
        self.client = Client(scheduler, set_as_default=False)
        stack.callback(self.client.close)
        self.address = str(scheduler.scheduler_address)
        self._workers.connect(self.address)
        stack.callback(self._workers.end)  # first: a scheduler would wait for what they are doing

    def __exit__(self, *_: object) -> None:
        """End scheduler and workers."""
        with _interruptions_deferred():
            self._stack.close()

    def most_running(self) -> int:
        """Return the number of jobs that run at the same time."""
        return self._number

    def most_submitted(self) -> int:
        """Return the number of jobs to submit, running and waiting."""
        return JOBS_SUBMITTED * self._number

    def check_workers(self, *, progress: bool) -> None:
        """Start a worker for each one that has ended."""
        self._workers.replace_ended(progress=progress)


@contextmanager
def _interruptions_deferred() -> Iterator[None]:
    """Defer an interruption while scheduler and workers start or end: no half of them may stay."""
    usual = signal.getsignal(signal.SIGINT)
    if usual is None or threading.current_thread() is not threading.main_thread():
        yield  # they do not come here
        return
    came = False

    def note(*_: object) -> None:
        nonlocal came
        came = True

    signal.signal(signal.SIGINT, note)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, usual)
        if came:
            signal.raise_signal(signal.SIGINT)
