"""Progress of a long command: a bar on a terminal, occasional lines elsewhere."""

import sys
import time
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Protocol

from rocksteady.cli.console import terminal
from rocksteady.cli.console._styles import styled

LINE_EVERY = 0.1
"""Part of the work after which a line is due where there is no terminal."""
LINE_AFTER = 30.0
"""Seconds after which one is due in any case."""
QUIET = 2.0
"""Seconds before a sweep prints its first line: a shorter one prints none."""
LONG = 60.0
"""Seconds that are left from which on a sweep says how it would be faster."""
LATELY = 30
"""Seconds over which the rate of a sweep is taken: cells are faster here and slower there."""


class Done(Protocol):
    """What is called when a step is done, or when several are."""

    def __call__(self, step: str = "", count: int = 1) -> None:
        """Say so; `step` is the name of the last one."""


@contextmanager
def progress(task: str, steps: int, *, lines: bool = True) -> Iterator[Done]:
    """Yield a function to call with the name of each step when it is done.

    Parameters
    ----------
    task
        What is being done.
    steps
        Number of steps.
    lines
        Whether lines take the place of the bar where there is no terminal; not for what takes some
        seconds only.
    """
    if sys.stderr.isatty():
        with _bar(task, steps) as done:
            yield done
    elif lines:
        yield _lines(task, steps)
    else:
        yield lambda step="", count=1: None  # noqa: ARG005 -- called by these names


@contextmanager
def _bar(task: str, steps: int) -> Iterator[Done]:
    from rich.console import Console
    from rich.progress import (
        BarColumn,
        MofNCompleteColumn,
        Progress,
        TextColumn,
        TimeElapsedColumn,
        TimeRemainingColumn,
    )

    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        TextColumn("left"),
        TimeRemainingColumn(),
        TextColumn("{task.fields[step]}", style="note"),
    )
    with Progress(*columns, console=Console(stderr=True, **styled())) as bar:
        row = bar.add_task(task, total=steps, step="")

        def done(step: str = "", count: int = 1) -> None:
            bar.update(row, advance=count, step=step)

        yield done
        bar.update(row, step="")


def _lines(task: str, steps: int) -> Done:
    passed = 0
    due = Due(steps)

    def done(step: str = "", count: int = 1) -> None:
        nonlocal passed
        passed += count
        if due(passed):
            name = f", {step}" if step else ""
            percent = 100 * passed // steps
            print(f"{task}: {passed} of {steps} ({percent} %){name}", file=sys.stderr)

    return done


class Due:
    """Decides when a line is due.

    Parameters
    ----------
    steps
        Number of steps.
    shown
        Steps at which the last line was, or would have been.
    """

    def __init__(self, steps: int, shown: int = 0) -> None:
        self._steps, self._shown, self._since = steps, shown, time.monotonic()

    def __call__(self, passed: int) -> bool:
        """Return whether a line is due after a number of steps, and count from there if so."""
        late = time.monotonic() - self._since >= LINE_AFTER
        due = passed - self._shown >= LINE_EVERY * self._steps or late or passed == self._steps
        if due:
            self._shown, self._since = passed, time.monotonic()
        return due


class Meter:
    """Counts the cells of a sweep and the time that they take.

    It is what `rocksteady.Execution` takes as `progress`: called first with the number of
    cells that are done already, then with the number of newly finished ones.

    Parameters
    ----------
    cells
        Number of cells.
    show
        Called with the meter whenever it has moved.

    Attributes
    ----------
    cells, passed
        Number of cells, of all runs of a sweep that is run again, and of finished cells.
    there
        Number of cells that were done before.
    """

    def __init__(self, cells: int, show: "Callable[[Meter], None]") -> None:
        self.cells, self.passed, self.there = cells, 0, 0
        self._sweep, self._show = cells, show
        self._marks: deque[tuple[float, int]] = deque(maxlen=LATELY)
        self._began = self._last = 0.0

    def __call__(self, cells: int) -> None:
        """Count cells that are done."""
        terminal.say_notes()  # nothing is refused any more
        self._last = time.monotonic()
        self.passed += cells
        if self.passed > self.cells:  # the same sweep once more, over wider limits
            self.cells += self._sweep
        if not self._marks:
            self._began, self.there = self._last, cells
        if not self._marks or self._last - self._marks[-1][0] >= 1.0:
            self._marks.append((self._last, self.passed))
        if self.seconds >= QUIET and self.rate and self.left > LONG:
            terminal.say_suggestion()
        self._show(self)

    def end(self) -> None:
        """Take the cells that are done for all: there were fewer than there might have been."""
        if self.cells != self.passed:
            self.cells = self.passed
            self._show(self)

    @property
    def computed(self) -> int:
        """Cells that were not there before."""
        return self.passed - self.there

    @property
    def seconds(self) -> float:
        """From the first cell to the last one that is kept."""
        return self._last - self._began

    @property
    def rate(self) -> float:
        """Cells per second, lately; 0 where it is not known."""
        if not self._marks:
            return 0.0
        since, before = self._marks[0]
        passed = self._last - since
        return (self.passed - before) / passed if passed > 0.0 else 0.0

    @property
    def text(self) -> str:
        """How fast it goes, and how long it still takes."""
        if not self.rate:
            return ""
        left = "" if self.passed == self.cells else f", {clock_text(self.left)} left"
        return f"{self.rate:,.0f} cells/s{left}"

    @property
    def left(self) -> float:
        """Seconds that are left at this rate."""
        return (self.cells - self.passed) / self.rate


def clock_text(seconds: float) -> str:
    """Return a time as people read it off a clock: 0:07, 12:30, 3:05:00."""
    whole = round(seconds)
    hours, minutes = whole // 3600, whole // 60 % 60
    return f"{hours}:{minutes:02}:{whole % 60:02}" if hours else f"{minutes}:{whole % 60:02}"


@contextmanager
def sweeping(task: str, cells: int) -> Iterator[Meter]:
    """Yield the meter of a sweep, and show it: as `progress` does, with cells per second.

    Parameters
    ----------
    task
        What is being done.
    cells
        Number of cells.
    """
    if sys.stderr.isatty():
        with _cells_bar(task, cells) as show:
            yield Meter(cells, show)
    else:
        yield Meter(cells, _cells_lines(task))


@contextmanager
def _cells_bar(task: str, cells: int) -> Iterator[Callable[[Meter], None]]:
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn

    columns = (
        TextColumn("{task.description}"),
        BarColumn(bar_width=None),
        TextColumn("{task.completed:,} of {task.total:,}"),
        TextColumn("{task.fields[rate]}", style="note"),
    )
    with Progress(*columns, console=Console(stderr=True, **styled())) as bar:
        row = bar.add_task(task, total=cells, rate="")
        yield lambda meter: bar.update(
            row, total=meter.cells, completed=meter.passed, rate=meter.text
        )


def _cells_lines(task: str) -> Callable[[Meter], None]:
    due: Due | None = None

    def show(meter: Meter) -> None:
        nonlocal due
        if due is None:
            due = Due(meter.cells, meter.there)
        if meter.seconds < QUIET or not (due(meter.passed) or meter.passed == meter.cells):
            return
        percent = 100 * meter.passed // meter.cells
        speed = f", {meter.text}" if meter.text else ""
        done = f"{meter.passed:,} of {meter.cells:,} cells ({percent} %)"
        print(f"{task}: {done}{speed}", file=sys.stderr)

    return show
