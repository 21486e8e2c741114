"""A GPU in memory in place of the machine's, whose launches run the kernels of the host."""

import functools
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rocksteady.kernels.devices import FORMS
from rocksteady.kernels.entries import ENTRIES
from rocksteady.kernels.machine_code import _cuda as driver_module
from rocksteady.kernels.machine_code import programs
from rocksteady.kernels.machine_code.device import Form
from rocksteady.kernels.machine_code.gpu import gpu
from rocksteady.kernels.machine_code.sources import sources_hash
from tests.kernels.machine_code.in_memory.driver import DriverInMemory


def on_host(form: Form, host: Callable[..., None]) -> Callable[..., None]:
    """Return a function of the signature of a queued kernel that does its work by the host's."""
    rooms = len(form.room)

    @functools.wraps(form.queued)
    def launched(queue: Any, *rest: Any) -> None:
        cells = queue[2:]
        assert queue[:2].tolist() == [0, 0]
        assert np.array_equal(np.sort(cells), np.arange(len(cells)))
        queue[0] = len(cells)
        for shape, room in zip(form.room, rest[:rooms], strict=True):
            assert room.shape[1:] == shape
            room[...] = np.nan
        host(*rest[-_arguments(host) :])  # after the room, and what workers share

    return launched


def _arguments(kernel: Any) -> int:
    function = kernel.py_func
    return int(function.__code__.co_argcount)


def host_kernels() -> dict[str, Callable[..., None]]:
    """Return what a launch runs, by the name of the queued kernel."""
    # Several forms of one host kernel, for the linear and the nonlinear model, have longer names.
    hosts = {name: ENTRIES.get(name) or ENTRIES[name.removeprefix("nonlinear_")] for name in FORMS}
    return {form.queued.__name__: on_host(form, hosts[name]) for name, form in FORMS.items()}


def write_program(folder: Path, architecture: tuple[int, int], kernel: str, sources: str) -> Path:
    """Write what a driver in memory takes for the program of a kernel."""
    path = folder / programs.file_name(architecture, kernel)
    entry = f".visible .entry rs_{kernel}(.param .u64 cells)"
    path.write_text(f"// rocksteady kernels {sources}\n{entry}\n", encoding="ascii")
    return path


@contextmanager
def gpu_in_memory(folder: Path, memory: DriverInMemory | None = None) -> Iterator[DriverInMemory]:
    """Have this process see a GPU in memory, with programs of all kernels in a folder."""
    memory = DriverInMemory(host_kernels()) if memory is None else memory
    for name in memory.kernels or host_kernels():
        write_program(folder, (8, 0), name, sources_hash())
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(driver_module, "_bindings", lambda: memory)
        patch.setattr(programs, "brought_folders", lambda: [folder])
        patch.setattr(programs, "libraries_folder", lambda: folder / "none")
        gpu.cache_clear()
        try:
            yield memory
        finally:
            gpu.cache_clear()
