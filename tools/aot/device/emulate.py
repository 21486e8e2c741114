"""The emulation of a device: its program, compiled for this processor and run by threads.

What a launch does on a device happens here as there: workers call the same entry, take cells from
the same queue by an atomic addition, and make their arrays on their stacks.
"""

import ctypes
import tempfile
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np

from rocksteady.gpu._launch import queue_of
from rocksteady.kernels.devices import Form
from rocksteady.kernels.machine_code.library import caller, targets
from tools.aot.device.emit import optimised
from tools.aot.device.program import ENTRY, parsed
from tools.aot.emit import hide
from tools.aot.link import link
from tools.aot.lower import externals
from tools.aot.targets import TARGETS

NAME = "rocksteady-emulated.so"
"""File of the emulation."""
_OF_C = {"memcpy", "memset"}


def compile_program(program: str, file: Path) -> None:
    """Compile a program for this processor into a library, whose entries are those of a device.

    Raises
    ------
    LinkError
        If no compiler is in reach.
    """
    from llvmlite import binding

    target = TARGETS[targets()[0]]
    binding.initialize_native_target()
    binding.initialize_native_asmprinter()
    machine: Any = binding.Target.from_triple(target.triple).create_target_machine(
        cpu=target.cpu, features=target.features, opt=3, reloc="pic", codemodel="default"
    )
    module = parsed(program, machine)
    hide(module)
    optimised(module, machine)
    missing = set(externals(module)) - _OF_C
    if missing:
        raise ValueError(f"the program calls {', '.join(sorted(missing))}")
    with tempfile.TemporaryDirectory(prefix="rocksteady-") as scratch:
        objects = Path(scratch, "program.o")
        objects.write_bytes(machine.emit_object(module))
        link(objects, file, target)


class Emulated:
    """A device of some threads of this processor.

    Parameters
    ----------
    library
        File that `compile_program` wrote.
    workers
        Number of its threads.
    """

    def __init__(self, library: Path, workers: int = 4) -> None:
        self.library = library
        self._loaded = ctypes.CDLL(str(library))
        self._workers = workers
        self._callers: dict[str, Callable[..., object]] = {}

    def run(self, form: Form, arguments: Sequence[Any]) -> None:
        """Launch a kernel over the cells of its arguments, and wait for it."""
        queue = queue_of(form, tuple(arguments))
        room = [np.empty((self._workers, *shape)) for shape in form.room]
        shared = () if form.shared is None else form.shared(*arguments)
        call = self._caller(form)
        with ThreadPoolExecutor(self._workers) as threads:
            calls = [
                threads.submit(call, queue, *room, *shared, *arguments)
                for _ in range(self._workers)
            ]
            for each in calls:
                each.result()

    def _caller(self, form: Form) -> Callable[..., object]:
        function = form.queued.py_func
        name = function.__name__
        if name not in self._callers:
            address = self._loaded[f"{ENTRY}{name}"]
            address.argtypes = [ctypes.c_void_p]
            address.restype = ctypes.c_int32
            self._callers[name] = caller(function, address)
        return self._callers[name]
