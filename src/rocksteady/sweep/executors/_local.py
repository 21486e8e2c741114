"""A cluster on this machine: a scheduler in this process, and workers in processes of their own.

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
from rocksteady.sweep.cases.queue import WAITING, usable_cores
from rocksteady.sweep.executors._worker import LOOPBACK, START

TRIES = 4
"""How often each worker is started, on average, while none of them comes to work."""
KILLS = 20
"""The same where a signal ends them: what sends it, a lack of memory too, may not last."""

NO_PAGES = {"dashboard": False, "dashboard_address": f"{LOOPBACK}:0"}
"""Of a scheduler: no web pages about it, and no complaint that another one has their usual port."""


class Crew:
    """Processes of workers, kept at their number.

    Parameters
    ----------
    workers
        How many.
    folder
        For temporary files.
    """

    def __init__(self, workers: int, folder: str) -> None:
        self._folder = folder
        self._lost = 0
        self._address = ""
        self.at_work: set[int] = set()
        """The process ids of workers that have come to work: added to by the scheduler."""
        self._processes: list[subprocess.Popen[str]] = []
        try:
            for _ in range(workers):
                self._processes.append(_started(folder))
        except BaseException:
            self.end()
            raise

    def serve(self, address: str) -> None:
        """Tell the workers where their scheduler is."""
        self._address = address
        for process in self._processes:
            self._tell(process)

    def _tell(self, process: "subprocess.Popen[str]") -> None:
        _write(process, self._address)

    def mend(self, *, progress: bool) -> None:
        """Start workers in the place of those that have ended.

        Parameters
        ----------
        progress
            Whether anything has been computed since the last call.

        Raises
        ------
        UnfinishedError
            If they end again and again before they have come to work.  Those that end at work are
            the scheduler's to count, piece by piece: whatever kills them has nothing to do with how
            they start.
        """
        if progress:
            self._lost = 0
        for place, process in enumerate(self._processes):
            if process.poll() is None:
                continue
            if process.pid in self.at_work:
                self.at_work.discard(process.pid)
                self._lost = 0
            else:
                self._lost += 1
            most = TRIES if process.returncode >= 0 else KILLS
            if self._lost >= most * len(self._processes):
                raise UnfinishedError(
                    name="executor",
                    value="dask",
                    valid=f"its worker processes end at once, {_how(process.returncode)}",
                    hint="see what they say above, or what kills them, or compute with threads",
                )
            _closed(process)
            self._processes[place] = _started(self._folder)
            self._tell(self._processes[place])

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
    """A scheduler in this process and its workers, for as long as it is entered.

    Parameters
    ----------
    workers
        How many; None for as many as this process may use cores.
    """

    name = "dask"

    def __init__(self, workers: int | None) -> None:
        self._workers = usable_cores() if workers is None else workers

    def __enter__(self) -> Self:
        """Start them."""
        self._stack = ExitStack()
        try:
            with _held_back():
                self._start(self._stack)
        except BaseException:
            self.__exit__()
            raise
        return self

    def _start(self, stack: ExitStack) -> None:
        folder = stack.enter_context(TemporaryDirectory(prefix="rocksteady-"))
        self._crew = Crew(self._workers, folder)
        stack.callback(self._crew.end)
        import dask
        from distributed import Client, LocalCluster  # while the workers import it, too

        from rocksteady.sweep.executors._dask import Roll, quiet

        stack.enter_context(quiet())
        settings = {
            # No piece waits at a worker behind another: when one dies, it is known of which piece.
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
        scheduler.scheduler.add_plugin(Roll(self._crew.at_work))
        self.client = Client(scheduler, set_as_default=False)
        stack.callback(self.client.close)
        self.address = str(scheduler.scheduler_address)
        self._crew.serve(self.address)
        stack.callback(self._crew.end)  # first: a scheduler would wait for what they are doing

    def __exit__(self, *_: object) -> None:
        """End them."""
        with _held_back():
            self._stack.close()

    def at_once(self) -> int:
        """Return how many pieces it works on at the same time."""
        return self._workers

    def in_flight(self) -> int:
        """Return how many pieces it is to have, those included that wait."""
        return WAITING * self._workers

    def mend(self, *, progress: bool) -> None:
        """Start workers in the place of those that have ended."""
        self._crew.mend(progress=progress)


@contextmanager
def _held_back() -> Iterator[None]:
    """Hold an interruption back until something short is done: half done, it would stay behind."""
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
