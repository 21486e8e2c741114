"""Recorded calls of kernels: reading, writing, and replaying them bit for bit.

A file of calls is a row of 8-byte cells, little-endian, that C and JavaScript read as easily as
Python.  Shipped ones are compressed by gzip::

    file    magic "RSCALLS1", number of calls, calls
    call    bytes of the entry's name, the name padded with zeros to whole cells,
            number of arguments, arguments, number of results, results
    number  kind (0 integer or truth value, 1 float64), value
    array   kind (2 float64, 3 int64, 4 truth values of one byte), number of dimensions, lengths,
            content before the call, whether the call changes it (0 or 1), content after it if so

Arguments and results are flat: a tuple is the row of its members.  A result is a number.
"""

import gzip
import math
import struct
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any, NamedTuple, get_args, get_origin, get_type_hints

import numpy as np
from numpy.typing import NDArray

MAGIC = b"RSCALLS1"
WHOLE, REAL = 0, 1
DTYPES = {2: np.dtype("<f8"), 3: np.dtype("<i8"), 4: np.dtype("?")}
KINDS = {np.dtype(np.float64): 2, np.dtype(np.int64): 3, np.dtype(np.bool_): 4}
CELL = 8
"""Bytes of a cell."""

Number = int | float
Leaf = Number | NDArray[Any]
"""A number or an array."""
Kernel = Callable[..., Any]


class Call(NamedTuple):
    """A recorded call of a kernel; arguments and results are flat."""

    entry: str
    before: tuple[Leaf, ...]
    after: tuple[Leaf, ...]
    """The arguments after the call: arrays that it has filled, all else as it was."""
    results: tuple[Number, ...]


class Difference(NamedTuple):
    """A value that is not the recorded one."""

    leaf: int
    """Its place among the flat arguments and results, the results last."""
    place: tuple[int, ...]
    """Its place in an array; empty otherwise."""
    recorded: Number
    computed: Number


# ------------------------------------------------------------------------------- values


def flat(value: Any) -> Iterator[Leaf]:
    """Yield the numbers and arrays of an argument or a result, tuples unpacked."""
    if isinstance(value, tuple):
        for member in value:
            yield from flat(member)
    elif isinstance(value, np.ndarray):
        yield value
    elif isinstance(value, complex):
        yield value.real
        yield value.imag
    elif isinstance(value, bool | int | np.bool_ | np.integer):
        yield int(value)
    elif value is not None:
        yield float(value)


def arguments_of(kernel: Kernel, leaves: Iterable[Leaf]) -> list[Any]:
    """Return the arguments that a kernel takes, from flat ones, by its annotations."""
    given = iter(leaves)
    hints = get_type_hints(kernel)
    return [_built(hint, given) for name, hint in hints.items() if name != "return"]


def _built(hint: Any, leaves: Iterator[Leaf]) -> Any:
    """Return one argument of the annotated type, made of the next numbers and arrays."""
    if get_origin(hint) is tuple:
        return tuple(_built(member, leaves) for member in get_args(hint))
    if hint is type(None):
        return None
    if hasattr(hint, "_fields"):
        return hint(*(_built(member, leaves) for member in get_type_hints(hint).values()))
    leaf = next(leaves)
    return leaf if isinstance(leaf, np.ndarray) else hint(leaf)


# ------------------------------------------------------------------------------- files


def dumped(calls: Iterable[Call]) -> bytes:
    """Return the content of a file of calls, not compressed."""
    parts, count = [], 0
    for call in calls:
        name = call.entry.encode()
        parts += [_whole(len(name)), _padded(name), _whole(len(call.before))]
        for before, after in zip(call.before, call.after, strict=True):
            parts.append(_argument(before, after))
        parts.append(_whole(len(call.results)))
        parts += map(_number, call.results)
        count += 1
    return b"".join([MAGIC, _whole(count), *parts])


def loaded(content: bytes) -> list[Call]:
    """Return the calls of a file, compressed or not.

    Raises
    ------
    ValueError
        If it is no file of calls.
    """
    if content[:2] == b"\x1f\x8b":
        content = gzip.decompress(content)
    if content[: len(MAGIC)] != MAGIC:
        message = "this is no file of recorded calls"
        raise ValueError(message)
    reader = _Reader(content, len(MAGIC))
    return [reader.call() for _ in range(reader.whole())]


def save(file: Path, calls: Iterable[Call], *, compress: bool) -> None:
    """Write a file of calls; the same calls give the same bytes."""
    content = dumped(calls)
    file.write_bytes(gzip.compress(content, 9, mtime=0) if compress else content)


def _whole(value: int) -> bytes:
    return struct.pack("<q", value)


def _padded(data: bytes) -> bytes:
    return data + bytes(-len(data) % CELL)


def _number(value: Number) -> bytes:
    if isinstance(value, float):
        return struct.pack("<qd", REAL, value)
    return struct.pack("<qq", WHOLE, value)


def _argument(before: Leaf, after: Leaf) -> bytes:
    if not isinstance(before, np.ndarray):
        return _number(before)
    kind = KINDS[before.dtype]
    first, last = (_padded(_stored(array, kind).tobytes()) for array in (before, after))
    head = struct.pack(f"<{2 + before.ndim}q", kind, before.ndim, *before.shape)
    return head + first + (_whole(0) if first == last else _whole(1) + last)


def _stored(array: Any, kind: int) -> NDArray[Any]:
    return np.ascontiguousarray(array, dtype=DTYPES[kind])


class _Reader:
    """Reads cells one after another."""

    def __init__(self, content: bytes, place: int) -> None:
        self._content, self._place = content, place

    def whole(self) -> int:
        return int(self._cell("<q"))

    def call(self) -> Call:
        length = self.whole()
        name = self._bytes(length).decode()
        pairs = [self._argument() for _ in range(self.whole())]
        results = tuple(self._number(self.whole()) for _ in range(self.whole()))
        before, after = (tuple(pair[k] for pair in pairs) for k in (0, 1))
        return Call(name, before, after, results)

    def _argument(self) -> tuple[Leaf, Leaf]:
        kind = self.whole()
        if kind not in DTYPES:
            number = self._number(kind)
            return number, number
        shape = tuple(self.whole() for _ in range(self.whole()))
        first = self._array(kind, shape)
        return first, self._array(kind, shape) if self.whole() else first

    def _number(self, kind: int) -> Number:
        return float(self._cell("<d")) if kind == REAL else self.whole()

    def _array(self, kind: int, shape: tuple[int, ...]) -> NDArray[Any]:
        data = self._bytes(math.prod(shape) * DTYPES[kind].itemsize)
        return np.frombuffer(data, dtype=DTYPES[kind]).reshape(shape).astype(DTYPES[kind].type)

    def _cell(self, form: str) -> Any:
        (value,) = struct.unpack(form, self._bytes(CELL))
        return value

    def _bytes(self, length: int) -> bytes:
        data = self._content[self._place : self._place + length]
        if len(data) < length:
            message = "the file of recorded calls is cut short"
            raise ValueError(message)
        self._place += length + -length % CELL
        return data


# ------------------------------------------------------------------------------ replaying


def recorded(entry: str, kernel: Kernel, arguments: Iterable[Any]) -> tuple[Call, Any]:
    """Call a kernel, and return the record of that with what the kernel returned."""
    passed = arguments_of(kernel, flat(tuple(arguments)))
    given = tuple(flat(tuple(passed)))
    before = tuple(leaf.copy() if isinstance(leaf, np.ndarray) else leaf for leaf in given)
    result = kernel(*passed)
    after = tuple(leaf.copy() if isinstance(leaf, np.ndarray) else leaf for leaf in given)
    return Call(entry, before, after, tuple(flat(result))), result  # type: ignore[arg-type]


def replayed(call: Call, kernel: Kernel) -> Call:
    """Return the record of a call made again."""
    given = [leaf.copy() if isinstance(leaf, np.ndarray) else leaf for leaf in call.before]
    return recorded(call.entry, kernel, given)[0]


def differences(call: Call, again: Call) -> tuple[int, int, Difference | None]:
    """Compare a call with its replay, bit for bit.

    A NaN equals any NaN: their bits depend on the processor.  0.0 and -0.0 differ.

    Returns
    -------
    tuple
        Number of values compared, of those that differ, and the first of these.
    """
    compared = differing = 0
    first = None
    pairs = zip((*call.after, *call.results), (*again.after, *again.results), strict=True)
    for leaf, (one, other) in enumerate(pairs):
        a, b = np.asarray(one), np.asarray(other)
        compared += a.size
        unlike = _unlike(a, b)
        count = int(np.count_nonzero(unlike))
        if count and first is None:
            place = tuple(int(places[0]) for places in np.nonzero(unlike)) if a.ndim else ()
            first = Difference(leaf, place, a[place].item(), b[place].item())
        differing += count
    return compared, differing, first


def _unlike(a: NDArray[Any], b: NDArray[Any]) -> NDArray[np.bool_]:
    """Return which values differ in their bits, both being NaN excepted."""
    if a.dtype.kind != "f":
        return np.asarray(a != b)
    apart = np.atleast_1d(a).view(np.int64) != np.atleast_1d(b).view(np.int64)
    found: NDArray[np.bool_] = apart.reshape(a.shape) & ~(np.isnan(a) & np.isnan(b))
    return found
