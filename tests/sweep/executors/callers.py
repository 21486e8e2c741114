"""Scripts that evaluate on a cluster, and how tests start and watch them."""

import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

SCRIPT = """
import sys
import numpy as np
from rocksteady.sweep.cases.axes import Axis
from rocksteady.sweep.evaluate import evaluate
from rocksteady.sweep.cases.grid import Grid
from rocksteady.sweep.cases.outputs import Output
from rocksteady.sweep.run import Execution
from tests.sweep.executors.cases import held, slow, GRID, OUTPUTS

def mine(a, b):
    return slow(a, b)

def told(cells):
    if cells:
        print("begun", flush=True)

executor = sys.argv[1] if len(sys.argv) > 1 else "dask"
"""
ENDLESS = SCRIPT.replace("slow(a, b)", "held(a, b, gate='/no/such/file')")
"""The same of cells that never end, so that it cannot have ended before it is disturbed."""
RUN = (
    "data = evaluate(mine, GRID, OUTPUTS, batch=4,"
    " run=Execution(executor=executor, workers=2, progress=told))\n"
)


def tree(folder: Path) -> dict[str, bytes]:
    """Return all files of a store but for its lock."""
    files = (path for path in folder.rglob("*") if path.is_file() and path.name != "lock")
    return {str(path.relative_to(folder)): path.read_bytes() for path in files}


def started(
    script: str, *arguments: str, temporary: Path | None = None, **options: Any
) -> "subprocess.Popen[str]":
    root = str(Path(__file__).parents[3])
    folder = {} if temporary is None else {"TMPDIR": str(temporary)}
    return subprocess.Popen(
        [sys.executable, "-c", script, *arguments],
        env={**os.environ, "PYTHONPATH": root, **folder},
        text=True,
        **options,
    )


@contextmanager
def within(seconds: int) -> Iterator[None]:
    """Raise where something hangs, even on a machine with much else to do."""

    def late(*_: object) -> None:
        raise TimeoutError(f"not done within {seconds} seconds")

    usual = signal.signal(signal.SIGALRM, late)
    signal.alarm(seconds)
    try:
        yield
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, usual)


def script_in(folder: Path, text: str) -> Path:
    file = folder / "script.py"
    file.write_text(text, encoding="utf-8")
    return file
