"""How far a long command is: a bar on a terminal, a line now and then elsewhere."""

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

LINE_EVERY = 0.1
"""Part of the work after which a line is due where there is no terminal."""
LINE_AFTER = 30.0
"""Seconds after which one is due in any case."""


@contextmanager
def progress(task: str, steps: int, *, lines: bool = True) -> Iterator[Callable[[str], None]]:
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
        yield lambda _: None


@contextmanager
def _bar(task: str, steps: int) -> Iterator[Callable[[str], None]]:
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

        def done(step: str) -> None:
            bar.update(row, advance=1, step=step)

        yield done
        bar.update(row, step="")


def _lines(task: str, steps: int) -> Callable[[str], None]:
    count, said, since = 0, 0, time.monotonic()

    def done(step: str) -> None:
        nonlocal count, said, since
        count += 1
        late = time.monotonic() - since >= LINE_AFTER
        if count - said >= LINE_EVERY * steps or late or count == steps:
            print(f"{task}: {count} of {steps} ({100 * count // steps} %), {step}", file=sys.stderr)
            said, since = count, time.monotonic()

    return done
