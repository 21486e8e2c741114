"""A device that executes the very PTX, translated to C, in the lanes of one warp."""

from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from rocksteady.installation._recorded import flat
from rocksteady.kernels.devices import Form
from rocksteady.kernels.machine_code._launch import queue_of
from rocksteady.kernels.machine_code.library import caller
from rocksteady.kernels.machine_code.types import signature_of
from tools.aot.device.program import ENTRY
from tools.aot.device.ptx_to_c import Program, loaded

LANES = 32
"""Of a warp."""


class Executed:
    """A device of one warp.

    Parameters
    ----------
    files
        PTX files of kernels.
    folder
        Where they are written in C and compiled.
    how
        For `tools.aot.device.ptx_to_c.loaded`: ``checked``, ``counted``, ``nan``, ``fill``.
    """

    def __init__(self, files: Iterable[Path], folder: Path, **how: Any) -> None:
        self.programs: dict[str, Program] = loaded(files, folder, **how)
        self._checked = bool(how.get("checked"))

    def run(self, form: Form, arguments: Sequence[Any]) -> None:
        """Launch a kernel over the cells of its arguments, and wait for it."""
        queue = queue_of(form, tuple(arguments))
        room = [np.full((LANES, *shape), np.nan) for shape in form.room]
        shared = () if form.shared is None else form.shared(*arguments)
        given = [queue, *room, *shared, *arguments]
        function = form.queued.py_func
        program = self.programs[f"{ENTRY}{function.__name__}"]
        if self._checked:
            signature = signature_of(function)
            leaves = (*signature.leaves, *signature.returned)
            arrays = [each for each in flat(tuple(given)) if isinstance(each, np.ndarray)]
            program.watch(arrays, sum(leaf.cells for leaf in leaves))
        call: Callable[..., object] = caller(function, program.warp(LANES))
        call(*given)
