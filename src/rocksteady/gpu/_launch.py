"""A launch of a queued kernel: what its cells hold, and in which order workers take the cells."""

import ctypes
import math
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.kernels.machine_code.device import Form, cells_in
from rocksteady.kernels.machine_code.library import DTYPES, cells_of, refuse_array
from rocksteady.kernels.machine_code.types import Leaf, parts, signature_of

ALIGNED = 256
"""Bytes of which the place of every array is a multiple."""
BEGUN = 2
"""Numbers in a queue before those of the cells: cells taken, and workers that have begun."""
STEPS = 65_535
"""Number of classes by which cells are sorted: a short integer holds one."""


class Launch:
    """Arguments of a queued kernel, laid out in one piece of memory, and room for its workers.

    The results lie together at the end of the piece, so that they are one copy.

    Parameters
    ----------
    kernel
        The queued kernel, as a Python function.
    form
        How it does the work of the host kernel.
    arguments
        Those of the host kernel, of one cell at least.
    workers
        Number of workers.

    Attributes
    ----------
    size, room_size
        Bytes of the piece, and of the room.
    results
        Place of the results in the piece, and their bytes.

    Raises
    ------
    TypeError
        If an argument is not what the kernel takes.
    """

    def __init__(
        self,
        kernel: Callable[..., object],
        form: Form,
        arguments: tuple[Any, ...],
        *,
        workers: int,
    ) -> None:
        signature = signature_of(kernel)
        shared = () if form.shared is None else form.shared(*arguments)
        rooms = [(workers, *shape) for shape in form.room]  # shapes in place of arrays
        taken = (queue_of(form, arguments), *rooms, *shared, *arguments)
        self._leaves = signature.leaves
        self._values = [
            value
            for hint, given in zip(signature.arguments, taken, strict=True)
            for value in _leaf_values(hint, given)
        ]
        self._cells = cells_of(self._leaves)
        self._rooms = range(1, 1 + len(rooms))
        self._results = range(len(self._leaves) - len(arguments[-1]), len(self._leaves))
        self._places: list[int] = []
        self.size, self.room_size = _aligned(self._cells.size), 0
        for number, (leaf, value) in enumerate(zip(self._leaves, self._values, strict=True)):
            if number in self._rooms:
                self._places.append(self.room_size)
                self.room_size += _aligned(math.prod(value) * DTYPES[leaf.kind].itemsize)
                continue
            self._places.append(self.size)
            if leaf.dimensions:
                _check(leaf, value)
                self.size += _aligned(value.nbytes)
        first = self._places[self._results.start]
        self.results = first, self.size - first

    def write(self, staging: int, device: int, room: int) -> None:
        """Write the cells and the arrays into memory of this machine.

        Parameters
        ----------
        staging
            Its address.
        device, room
            Addresses to which the device sees the piece and the room.
        """
        cells: list[Any] = []
        for number, leaf, value, place in self._numbered():
            if number in self._rooms:
                cells += [room + place, *value]
            elif leaf.dimensions:
                cells += [device + place, *value.shape]
                _view(staging + place, value)[...] = value
            elif leaf.kind is complex:
                cells += [value.real, value.imag]
            else:
                cells.append(value)
        self._cells.pack_into((ctypes.c_char * self._cells.size).from_address(staging), 0, *cells)

    def read(self, staging: int) -> None:
        """Read the results from memory of this machine into their arguments."""
        for number, _, value, place in self._numbered():
            if number in self._results:
                value[...] = _view(staging + place, value)

    def _numbered(self) -> Iterator[tuple[int, Leaf, Any, int]]:
        columns = zip(self._leaves, self._values, self._places, strict=True)
        return ((number, *column) for number, column in enumerate(columns))


def queue_of(form: Form, arguments: tuple[Any, ...]) -> NDArray[np.int64]:
    """Return the queue of a call: of which no cell is taken, those expected to be longest first.

    The order changes no result, only how long workers without cells wait for the last one.
    """
    cells = cells_in(arguments)
    queue = np.zeros(BEGUN + cells, dtype=np.int64)
    if form.length is None:
        queue[BEGUN:] = np.arange(cells)
    else:
        queue[BEGUN:] = longest_first(np.asarray(form.length(*arguments), dtype=np.float64))
    return queue


def longest_first(lengths: NDArray[np.float64]) -> NDArray[np.int64]:
    """Return the numbers of cells, those of the largest lengths first, in `STEPS` classes.

    A length that is no number counts as the largest.  Of short integers NumPy's stable sort is one
    by digits, which takes some milliseconds for a million.
    """
    finite = lengths[np.isfinite(lengths)]
    low, high = (finite.min(), finite.max()) if finite.size else (0.0, 0.0)
    span = high - low if high > low else 1.0
    share = np.clip((np.nan_to_num(lengths, nan=high, posinf=high, neginf=low) - low) / span, 0, 1)
    steps = (STEPS * (1.0 - share)).astype(np.uint16)
    return np.argsort(steps, kind="stable")


def _leaf_values(hint: Any, given: Any) -> Iterator[Any]:
    """Yield the numbers and arrays of an argument, in the order of its leaves."""
    inner = parts(hint)
    if inner is None:
        if given is not None:
            yield given
        return
    for (_, part), value in zip(inner, given, strict=True):
        yield from _leaf_values(part, value)


def _check(leaf: Leaf, value: Any) -> None:
    """Refuse what is not the array that a kernel takes."""
    dtype = DTYPES[leaf.kind]
    sound = isinstance(value, np.ndarray) and value.dtype == dtype and value.flags.carray
    if not sound or value.ndim != leaf.dimensions:
        refuse_array(value, dtype, leaf.dimensions, leaf.name)


def _view(address: int, like: NDArray[Any]) -> NDArray[Any]:
    """Return memory of this machine as an array of the shape and type of another."""
    if not like.nbytes:
        return np.empty_like(like)
    memory: Any = (ctypes.c_char * like.nbytes).from_address(address)
    return np.ndarray(like.shape, like.dtype, memory)


def _aligned(size: int) -> int:
    return -(-size // ALIGNED) * ALIGNED
