"""What tests of stores under attack share: a small sweep, scripts that run it, folders compared."""

import os
import subprocess
import sys
import textwrap
from pathlib import Path
from typing import Any

from rocksteady.sweep.evaluate import BATCH, evaluate
from rocksteady.sweep.run import Execution
from rocksteady.sweep.store.store import Store
from tests.sweep.executors.cases import GRID, OUTPUTS, some

ROOT = str(Path(__file__).parents[3])
CHUNK = 100
CHUNKS = 6

PREAMBLE = """
import errno, os, resource, shutil, signal, sys, threading, time
from functools import partial
from pathlib import Path
import xarray, zarr
from rocksteady import durable
from rocksteady.errors import RocksteadyError
from rocksteady.sweep.evaluate import evaluate
from rocksteady.sweep.run import Execution
from rocksteady.sweep.store import _writer
from rocksteady.sweep.store.store import Store
from tests.sweep.executors.cases import GRID, OUTPUTS, slow, some

_writer.SHARE = float("inf")  # each chunk is marked as finished at once

def run(path, cases=some, **options):
    store = Store(path, chunk=100, **options)
    return evaluate(cases, GRID, OUTPUTS, run=Execution(executor="serial", store=store))
"""
MOMENTS = """
class Moments:
    '''Ends this process at one of the moments at which something changes on the disk.'''
    def __init__(self, last):
        self.left = last
    def here(self):
        self.left -= 1
        if self.left < 0:
            os.kill(os.getpid(), signal.SIGKILL)

def watched(moments, name, function):
    def wrapped(*arguments, **options):
        moments.here()
        return function(*arguments, **options)
    return wrapped

def kill_at(last):
    moments = Moments(last)
    def create(path, content):
        half = len(content) // 2
        with path.open("xb") as file:
            moments.here()
            file.write(content[:half])
            file.flush()
            moments.here()
            file.write(content[half:])
        moments.here()
    durable.create = create
    os.fsync = watched(moments, "fsync", os.fsync)
    os.mkdir = watched(moments, "mkdir", os.mkdir)
    Path.replace = watched(moments, "replace", Path.replace)
    Path.unlink = watched(moments, "unlink", Path.unlink)
    Path.write_text = watched(moments, "write_text", Path.write_text)
    shutil.rmtree = watched(moments, "rmtree", shutil.rmtree)
    os.unlink = watched(moments, "os.unlink", os.unlink)
    os.rmdir = watched(moments, "os.rmdir", os.rmdir)
    return moments

def every_moment(folder, begin, go, step=1, first=0):
    '''Fork a process for each moment; it begins anew and is killed there.'''
    moment = first
    while True:
        place = folder / f"{moment}"
        place.mkdir()
        child = os.fork()
        if child == 0:
            os.chdir(place)
            begin(Path("a.zarr"))
            kill_at(moment)
            go(Path("a.zarr"))
            os._exit(0)
        status = os.waitpid(child, 0)[1]
        if os.WIFEXITED(status):
            assert os.WEXITSTATUS(status) == 0, status
            return moment
        moment += step
"""


def script(text: str, *arguments: object, **options: Any) -> "subprocess.CompletedProcess[str]":
    """Run a script to its end."""
    return subprocess.run(
        [sys.executable, "-c", PREAMBLE + textwrap.dedent(text), *map(str, arguments)],
        env={**os.environ, "PYTHONPATH": ROOT},
        capture_output=True,
        text=True,
        timeout=200,
        check=False,
        **options,
    )


def tree(folder: Path) -> dict[str, bytes]:
    """Return all files of a store but for its lock."""
    files = (path for path in folder.rglob("*") if path.is_file() and path.name != "lock")
    return {str(path.relative_to(folder)): path.read_bytes() for path in files}


def run(path: Path, **options: Any) -> tuple[Any, int]:
    """Return the result, and how many cells were there already."""
    told: list[int] = []
    how = {name: options.pop(name) for name in ("executor", "workers") if name in options}
    batch = options.pop("batch", BATCH)
    store = Store(path, chunk=CHUNK, **options)
    data = evaluate(
        some, GRID, OUTPUTS, run=Execution(store=store, progress=told.append, **how), batch=batch
    )
    assert sum(told) == GRID.size
    return data, told[0]


def whole(path: Path, undisturbed: Path) -> bool:
    """Return whether a store is that of a run that nothing has disturbed, with nothing beside."""
    return tree(path) == tree(undisturbed) and [p.name for p in path.parent.iterdir()] == [
        path.name
    ]
