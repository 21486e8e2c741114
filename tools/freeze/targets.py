"""Calls of many cells on every target that runs here: WebAssembly, and a GPU in emulation."""

import contextlib
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.installation._recorded import arguments_of
from rocksteady.kernels.core.queue import LEFT_OVER
from rocksteady.kernels.devices import form_of
from rocksteady.kernels.entries import ENTRIES
from tools.aot.calls.__main__ import large_calls
from tools.aot.device.build import emulation
from tools.aot.device.emulate import Emulated
from tools.aot.link import LinkError
from tools.aot.replay.everywhere import RUNS, built_here
from tools.aot.replay.outcome import MissingProgramError
from tools.freeze.kernels import of_bits
from tools.freeze.records import ROOT

EMULATED = "emulated GPU"
TARGETS = ("node", "wasmtime", EMULATED)
"""Targets whose results are compared with those of this processor's library."""


def freeze_target(target: str) -> Iterator[tuple[str, str]]:
    """Yield how many values of each call are those of this processor's library."""
    with contextlib.chdir(ROOT):  # where the tools are found that build what is missing
        yield from _emulated() if target == EMULATED else _repeated(target)


def _repeated(target: str) -> Iterator[tuple[str, str]]:
    """Yield how many values of each call differ in WebAssembly."""
    built = built_here()
    for number, call in enumerate(large_calls(ENTRIES)):
        (found,) = RUNS[target](built, [call])
        text = f"{found.values} values, {found.differing} differ"
        yield f"{target}: {number:02d} {call.entry}", text


def _emulated() -> Iterator[tuple[str, str]]:
    """Yield how many cells of each call that a device takes are the library's; some it leaves over.

    Raises
    ------
    MissingProgramError
        If no compiler of C is in reach.
    """
    try:
        device = Emulated(emulation(), workers=2)
    except LinkError as error:
        raise MissingProgramError(str(error)) from error
    for number, call in enumerate(large_calls(ENTRIES)):
        kernel = ENTRIES[call.entry]
        given = [leaf.copy() if isinstance(leaf, np.ndarray) else leaf for leaf in call.before]
        arguments = arguments_of(kernel, given)
        form = form_of(kernel, tuple(arguments))
        if form is None:
            continue
        device.run(form, arguments)
        computed = arguments[-1]
        known = [np.asarray(leaf) for leaf in call.after[-len(computed) :]]
        cells = len(known[0])
        left_over = computed[0].reshape(cells, -1)[:, 0] == LEFT_OVER
        unlike = [
            _rows(mine) != _rows(theirs) for mine, theirs in zip(computed, known, strict=True)
        ]
        differ = np.any([each.any(axis=1) for each in unlike], axis=0) & ~left_over
        text = f"{cells} cells, {left_over.sum()} left over, {differ.sum()} differ"
        yield f"{EMULATED}: {number:02d} {call.entry}", text


def _rows(array: NDArray[Any]) -> NDArray[np.int64]:
    """Return the bits of an array, a row per cell, in which every NaN is the same."""
    found = np.frombuffer(of_bits(array), np.int64)
    return found.reshape(len(array), -1)
