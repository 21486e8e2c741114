"""Cells that a device leaves over: the host computes them, in a thread for each processor.

They are at most 0.4 %.  In a launch of their own on the device they would take as long as the
longest of them.
"""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise
from typing import Any

import numpy as np

from rocksteady.kernels.machine_code.device import cells_in, current_device
from rocksteady.sweep.cases.queue import usable_cores

PARTS = 16
"""Calls for each thread: one long cell holds up few others."""


def run_left_over(kernel: Callable[..., None], *arguments: Any) -> None:
    """Run a host kernel over cells that a device has left over; without a device, as it is.

    Parameters
    ----------
    kernel
        The host kernel.
    arguments
        Its arguments: tuples of arrays of the cells, and what all cells share.
    """
    if current_device() is None:
        kernel(*arguments)
    else:
        in_threads(kernel, arguments, usable_cores())


def in_threads(kernel: Callable[..., None], arguments: tuple[Any, ...], workers: int) -> None:
    """Run a host kernel over cells in threads, each with some of the cells at a time."""
    cells = cells_in(arguments)
    ends = np.linspace(0, cells, min(PARTS * workers, cells) + 1).astype(int).tolist()
    with ThreadPoolExecutor(workers) as threads:
        for done in [
            threads.submit(kernel, *(_cut(each, *part) for each in arguments))
            for part in pairwise(ends)
        ]:
            done.result()


def _cut(argument: Any, begin: int, end: int) -> Any:
    """Return the cells of a tuple of arrays; what all cells share is in none, and whole."""
    if not isinstance(argument, tuple):
        return argument
    return type(argument)(*(array[begin:end] for array in argument))
