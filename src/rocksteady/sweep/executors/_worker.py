"""Worker process on this machine, which ends with its caller."""

import asyncio
import json
import logging
import os
import shutil
import sys
from pathlib import Path
from threading import Thread
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import distributed

START = (
    "import json, sys; sys.path[:], folder = json.loads(sys.stdin.readline()); "
    "from rocksteady.sweep.executors._worker import main; main(folder)"
)
"""What Python is given to run: modules are found where the caller finds them."""

LOOPBACK = "127.0.0.1"
"""The only address at which the processes of a local cluster listen."""

REMOVALS = 10
"""Attempts to remove a folder: each finds what was made in it during the one before."""


def main(folder: str) -> None:
    """Work until the caller closes the other end of standard input, or is no more.

    Parameters
    ----------
    folder
        For temporary files: the caller's, who may be killed before it removes it.
    """
    import distributed

    logging.getLogger("distributed").setLevel(logging.CRITICAL + 1)
    # A second line on standard input: the imports above go on while the caller's do.
    line = sys.stdin.readline()
    if not line:  # the caller has ended
        _remove(folder)
        return
    leaving = Thread(target=_leave_with_caller, args=(folder,), daemon=True)
    leaving.start()
    asyncio.run(_work(distributed.Worker, json.loads(line), folder))
    leaving.join(timeout=1.0)  # where it is the caller's end that has ended the work


async def _work(kind: "type[distributed.Worker]", address: str, folder: str) -> None:
    # A job takes little memory; dask's limit, a share of the machine's, would have workers paused
    # and killed for what other programs take.
    worker = kind(
        address,
        # A worker unpickles what it is sent, which can run code: no other machine may connect.
        host=LOOPBACK,
        dashboard=False,
        dashboard_address=f"{LOOPBACK}:0",  # opened all the same, with no pages
        nthreads=1,
        memory_limit=0,
        local_directory=folder,
    )
    async with worker:
        await worker.finished()


def _leave_with_caller(folder: str) -> None:
    sys.stdin.read()  # nothing is written any more: it returns when the other end is closed
    _remove(folder)  # a caller that was killed has not done it
    os._exit(0)  # at once, whatever it is doing: no result is awaited


def _remove(folder: str) -> None:
    """Remove a folder in which workers that are still starting, this one too, may make files."""
    for _ in range(REMOVALS):
        shutil.rmtree(folder, ignore_errors=True)
        if not Path(folder).exists():
            return
