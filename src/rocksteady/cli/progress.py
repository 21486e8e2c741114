"""How far a long command is: a bar on a terminal, a line now and then elsewhere."""

import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Protocol

LINE_EVERY = 0.1
"""Part of the work after which a line is due where there is no terminal."""
LINE_AFTER = 30.0
"""Seconds after which one is due in any case."""


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
        How many steps it has.
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
        TextColumn("{task.fields[step]}", style="dim"),
    )
    with Progress(*columns, console=Console(stderr=True)) as bar:
        row = bar.add_task(task, total=steps, step="")

        def done(step: str = "", count: int = 1) -> None:
            bar.update(row, advance=count, step=step)

        yield done
        bar.update(row, step="")


def _lines(task: str, steps: int) -> Done:
    passed, said, since = 0, 0, time.monotonic()

    def done(step: str = "", count: int = 1) -> None:
        nonlocal passed, said, since
        passed += count
        late = time.monotonic() - since >= LINE_AFTER
        if passed - said >= LINE_EVERY * steps or late or passed == steps:
            name = f", {step}" if step else ""
            percent = 100 * passed // steps
            print(f"{task}: {passed} of {steps} ({percent} %){name}", file=sys.stderr)
            said, since = passed, time.monotonic()

    return done
