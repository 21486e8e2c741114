"""Kernels: seeded calls of every entry, by hashes of what they fill and return."""

import copy
import hashlib
import math
from collections import defaultdict
from collections.abc import Iterator
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.installation._recorded import Call, Leaf, arguments_of, flat, loaded
from rocksteady.installation.check import RECORDED
from rocksteady.kernels.entries import ENTRIES
from rocksteady.kernels.orbits.settle import MEMORY
from tools.aot.calls.__main__ import large_calls
from tools.aot.calls.histories import LIMIT
from tools.freeze.values import of_array

CALLS = 5000
"""Calls of an entry."""
PIECES = 10
"""Hashes of an entry, so that a difference shows in how many of them it is."""
FEWER = {
    "batch.": 250,
    "lanes.": 250,
    "nonlinear_lanes.": 250,
    "orbits.periodic.series_": 300,
    "orbits.periodic": 500,
    "orbits.return_map.series_": 300,
    "orbits.settle.series_": 300,
    "orbits.settle": 500,
}
"""Calls of an entry, by how the dotted name of one that takes longer begins, the first that fits;
one of a batch has some 20 cells."""
ROOM = {"march": LIMIT, "series_settle": MEMORY, "settle": MEMORY}
"""Rows that the empty tables of a call have at least: another motion may need more of them."""
AS_RECORDED = {"fill_landings", "last_crossing", "peaks_until_overturning", "run_facts"}
"""Entries whose arguments are results of others, and only as such consistent."""


@cache
def shipped() -> dict[str, list[Call]]:
    """Return the recorded calls of the package, by entry."""
    found = defaultdict(list)
    for call in loaded(RECORDED.read_bytes()):
        found[call.entry].append(call)
    return dict(found)


def roomy(leaf: Leaf, rows: int) -> Leaf:
    """Return an empty table with some rows at least; any other argument as it is."""
    if not isinstance(leaf, np.ndarray) or leaf.ndim != 2 or len(leaf) >= rows or leaf.any():
        return leaf
    return np.zeros((rows, leaf.shape[1]), leaf.dtype)


class Varied:
    """Makes real numbers a little larger or smaller; equal ones stay equal, and 1 stays 1."""

    def __init__(self, rng: np.random.Generator) -> None:
        self._rng = rng
        self._size = math.exp(rng.uniform(math.log(1e-9), math.log(1e-2)))
        self._factors = {0.0: 1.0, 1.0: 1.0, -1.0: 1.0, math.inf: 1.0, -math.inf: 1.0}

    def __call__(self, value: Any) -> Any:
        """Return a number, an array or a row of them, varied."""
        if isinstance(value, tuple):
            members = [self(member) for member in value]
            return type(value)(*members) if hasattr(value, "_fields") else tuple(members)
        if isinstance(value, float):
            return value * self._factor(value)
        if not isinstance(value, np.ndarray) or value.dtype.kind != "f":
            return value.copy() if isinstance(value, np.ndarray) else value
        values, places = np.unique(value, return_inverse=True)
        scaled = values * np.array([self._factor(number) for number in values.tolist()])
        return np.ascontiguousarray(scaled[places].reshape(value.shape))

    def _factor(self, number: float) -> float:
        if number not in self._factors:
            self._factors[number] = 1.0 + self._size * self._rng.uniform(-1.0, 1.0)
        return self._factors[number]


def calls_of(entry: str) -> int:
    """Return how many calls of an entry are made."""
    name = f"{ENTRIES[entry].__module__}.{entry}".removeprefix("rocksteady.kernels.")
    fewer = (count for begin, count in FEWER.items() if name.startswith(begin))
    return len(shipped()[entry]) if entry in AS_RECORDED else next(fewer, CALLS)


def freeze_entry(entry: str) -> Iterator[tuple[str, str]]:
    """Yield hashes of calls whose arguments are those of recorded calls, varied by a seed."""
    kernel, count = ENTRIES[entry], calls_of(entry)
    recorded = [
        arguments_of(kernel, [roomy(leaf, ROOM.get(entry, 0)) for leaf in call.before])
        for call in shipped()[entry]
    ]
    rng = np.random.default_rng([1989, *entry.encode()])
    pieces, numbers = [], 0
    for piece in np.array_split(np.arange(count), PIECES):
        found = hashlib.sha256()
        for k in piece:
            given = tuple(recorded[k % len(recorded)])
            arguments = copy.deepcopy(given) if entry in AS_RECORDED else Varied(rng)(given)
            result = kernel(*arguments)
            for leaf in flat((*arguments, result)):
                content = of_bits(leaf)
                numbers += len(content) // 8
                found.update(content)
        pieces.append(found.hexdigest()[:8])
    yield entry, f"{count} calls, {numbers} values: {' '.join(pieces)}"


def of_bits(leaf: Leaf) -> bytes:
    """Return the bytes of a number or an array, in which every NaN is the same."""
    array: NDArray[Any] = np.asarray(leaf)
    if array.dtype.kind == "f":
        array = np.where(np.isnan(array), np.nan, array)
    return np.ascontiguousarray(array).tobytes()


def freeze_cells(_: str) -> Iterator[tuple[str, str]]:
    """Yield what calls of many cells fill, an item per call and a line per array."""
    for number, call in enumerate(large_calls(ENTRIES)):
        lines = [
            of_array(after)
            for before, after in zip(call.before, call.after, strict=True)
            if isinstance(after, np.ndarray) and of_bits(before) != of_bits(after)
        ]
        yield f"{number:02d} {call.entry}", "\n".join([*lines, f"returns {call.results}"])
