"""Finding the library of kernels compiled ahead of time, and calling its functions.

Each of them is ``int32_t rs_<name>(int64_t *cells)`` in C.  The caller writes the arguments into
cells of 8 bytes, an array as its address and its lengths.  The result is in the cells that follow.
One signature serves ctypes, C, WebAssembly and tests, and ctypes converts one argument: a call with
46 cells takes 4.3 microseconds.  An extension module would save one, and need a build for each
version of Python.
"""

import ctypes
import hashlib
import itertools
import platform
import sys
from collections.abc import Callable
from functools import cache, cached_property
from pathlib import Path
from struct import Struct
from types import NoneType
from typing import Any

import numpy as np

from rocksteady.errors import MissingKernelsError, Words
from rocksteady.kernels.machine_code._cpu import x86_64_level
from rocksteady.kernels.machine_code.sources import libraries_folder, sources_hash
from rocksteady.kernels.machine_code.types import Leaf, Signature, parts, signature_of

SUFFIXES = {"linux": ".so", "macos": ".dylib", "windows": ".dll"}
"""Of a library's file, by system."""
_FORMATS = {float: "d", int: "q", bool: "?7x", complex: "dd"}
"""How `struct` packs a leaf into cells."""
DTYPES = {float: np.dtype(np.float64), int: np.dtype(np.int64), bool: np.dtype(np.bool_)}


class Library:
    """A shared library of kernels, loaded.

    Parameters
    ----------
    path
        Of its file.
    target
        What it was compiled for, as ``"linux-x86-64-v3"``.

    Raises
    ------
    OSError
        If it cannot be loaded.
    """

    def __init__(self, path: Path, target: str) -> None:
        self.path = path
        self.target = target
        self._loaded = ctypes.CDLL(str(path))

    @property
    def sources(self) -> str:
        """Return the hash of the sources it was compiled from."""
        found = (ctypes.c_char * len(sources_hash())).in_dll(self._loaded, "rs_sources")
        return found.raw.decode("ascii", "replace")

    def entry(self, function: Callable[..., object]) -> Callable[..., Any] | None:
        """Return a Python function that calls a kernel; None if the library has no such kernel."""
        try:
            address = self._loaded[f"rs_{function.__name__}"]
        except AttributeError:
            return None
        address.argtypes = [ctypes.c_void_p]
        address.restype = ctypes.c_int32
        return caller(function, address)


@cache
def library() -> Library | None:
    """Return the library of this processor; None in an installation without compiled kernels.

    Raises
    ------
    MissingKernelsError
        If there are libraries but none for this processor, or its file is damaged, or the kernels
        have changed since it was compiled.
    """
    folder = libraries_folder()
    for target in targets():
        path = folder / file_name(target)
        if path.is_file():
            return _load(path, target)
    others = [path.stem for path in folder.glob("rocksteady-*") if path.suffix in SUFFIXES.values()]
    if not others:
        return None
    raise _unusable(f"is for another processor ({', '.join(sorted(others))})")


def _load(path: Path, target: str) -> Library:
    if not is_whole(path):
        raise _unusable(f"is damaged ({path})")
    try:
        found = Library(path, target)
        sources = found.sources
    except (OSError, ValueError) as error:
        raise _unusable(f"cannot be loaded ({error})") from error
    if sources != sources_hash():
        raise _unusable("is of other kernels: their code has changed since it was compiled")
    return found


def _unusable(fault: str) -> MissingKernelsError:
    return MissingKernelsError(
        "the library of compiled kernels",
        Words(fault),
        "it must be whole, for this processor, and made from these sources",
        "run `make library` in a checkout; elsewhere `pip install .` once more, or the wheel with "
        "--force-reinstall",
    )


def targets() -> tuple[str, ...]:
    """Return what this processor can run, the fastest first; empty where nothing is built for it.

    Examples
    --------
    >>> from rocksteady.kernels.machine_code.library import targets
    >>> all("-" in target for target in targets())
    True
    """
    system = {"linux": "linux", "darwin": "macos", "win32": "windows"}.get(sys.platform)
    machine = platform.machine().lower()
    if system in {"linux", "windows"} and machine in {"x86_64", "amd64"}:
        return tuple(f"{system}-x86-64-v{level}" for level in range(x86_64_level(), 1, -1))
    if system == "linux" and machine == "aarch64":
        return ("linux-aarch64",)
    if system == "macos" and machine == "arm64":
        return ("macos-arm64",)
    return ()


def file_name(target: str) -> str:
    """Return the file name of a target's library."""
    return f"rocksteady-{target}{SUFFIXES[target.partition('-')[0]]}"


def checksum_file(path: Path) -> Path:
    """Return the file beside a compiled file that begins with its checksum."""
    return path.with_name(path.name + ".sha256")


def is_whole(path: Path) -> bool:
    """Return whether a compiled file is what was written: half a library would end the process."""
    try:
        expected = checksum_file(path).read_text("ascii").split()[:1]
        return [hashlib.sha256(path.read_bytes()).hexdigest()] == expected
    except (OSError, ValueError):
        return False


def caller(function: Callable[..., object], address: Callable[..., int]) -> Callable[..., Any]:
    """Return a Python function that calls an entry of the library.

    Its code is written for the signature: a loop over the leaves would take longer than most
    kernels do.
    """
    name = function.__name__
    script = _Script(signature_of(function))
    space: dict[str, Any] = {**script.space, "entry": address, "name": name}
    arguments = ", ".join(script.arguments)
    body = "\n    ".join(script.lines)
    exec(compile(f"def {name}({arguments}):\n    {body}\n", f"<call of {name}>", "exec"), space)
    found: Callable[..., Any] = space[name]
    found.__doc__ = function.__doc__
    return found


class _Script:
    """Lines of Python that call an entry, and the names that they use."""

    def __init__(self, signature: Signature) -> None:
        taken, returned = signature.leaves, signature.returned
        first = sum(leaf.cells for leaf in taken)
        cells = first + sum(leaf.cells for leaf in returned)
        self._names = (f"v{count}" for count in itertools.count())
        self._leaves = iter(taken)
        self.space: dict[str, Any] = {
            "Room": ctypes.c_int64 * cells,
            "pack": cells_of(taken).pack_into,
            "unpack": cells_of(returned).unpack_from,
            "new": tuple.__new__,
            "ndarray": np.ndarray,
            "addressof": ctypes.addressof,
            "first_byte": ctypes.c_char.from_buffer,
            "refuse": refuse_array,
            "fail": _fail,
        }
        self.arguments = [next(self._names) for _ in signature.arguments]
        self.lines: list[str] = []
        values = [
            cell
            for value, hint in zip(self.arguments, signature.arguments, strict=True)
            for cell in self._taken(value, hint)
        ]
        self.lines += [
            "room = Room()",
            f"pack(room, 0, {', '.join(values)})",
            "status = entry(room)",
            "if status: fail(name, status)",
        ]
        if signature.result is not None:
            made = self._made(signature.result)
            names = "".join(f"{value}, " for value in self._unpacked)
            self.lines += [f"{names}= unpack(room, {8 * first})", f"return {made}"]

    def _taken(self, value: str, hint: Any) -> list[str]:
        """Return the expressions of an argument's cells, after lines that take tuples apart."""
        inner = parts(hint)
        if inner is not None:
            names = [next(self._names) for _ in inner]
            self.lines.append(f"{''.join(f'{name}, ' for name in names)}= {value}")
            pairs = zip(names, inner, strict=True)
            return [cell for name, (_, part) in pairs for cell in self._taken(name, part)]
        if hint is NoneType:
            return []
        leaf = next(self._leaves)
        if not leaf.dimensions:
            return [value]
        where, dtype = next(self._names), f"{leaf.kind.__name__}s"
        self.space[dtype] = DTYPES[leaf.kind]
        sound = (
            f"{value}.__class__ is ndarray and {value}.dtype == {dtype} and {value}.flags.carray"
        )
        self.lines += [
            f"if not ({sound} and {value}.ndim == {leaf.dimensions}):",
            f"    refuse({value}, {dtype}, {leaf.dimensions}, {leaf.name!r})",
            f"try: {where} = addressof(first_byte({value}))",
            f"except ValueError: {where} = {value}.ctypes.data  # empty",
        ]
        return [where, f"*{value}.shape"]

    @cached_property
    def _unpacked(self) -> list[str]:
        """Return the names of what the result's cells hold, in order."""
        return []

    def _made(self, hint: Any) -> str:
        """Return the expression that builds a result of its cells."""
        inner = parts(hint)
        if hint is NoneType:
            return "None"
        if inner is None:
            self._unpacked.append(next(self._names))
            if hint is not complex:
                return self._unpacked[-1]
            self._unpacked.append(next(self._names))
            return f"complex({', '.join(self._unpacked[-2:])})"
        made = "".join(f"{self._made(part)}, " for _, part in inner)
        if not isinstance(hint, type):
            return f"({made})"
        self.space[hint.__name__] = hint
        return f"new({hint.__name__}, ({made}))"  # sooner than by the name of the class


def cells_of(leaves: tuple[Leaf, ...]) -> Struct:
    """Return how `struct` packs leaves into cells: of an array its address and its lengths."""
    formats = ("q" * leaf.cells if leaf.dimensions else _FORMATS[leaf.kind] for leaf in leaves)
    return Struct("=" + "".join(formats))


def refuse_array(given: object, dtype: np.dtype[Any], dimensions: int, name: str) -> None:
    """Raise the error of an argument that is not the array that a kernel takes."""
    kind = f"{type(given).__name__} of {given.dtype}" if isinstance(given, np.ndarray) else given
    raise TypeError(
        f"{name} is {kind}: it must be a writable, C-contiguous array of {dtype} with "
        f"{dimensions} dimension{'s' * (dimensions > 1)}"
    )


def _fail(name: str, status: int) -> None:
    raise MemoryError(f"kernel {name}: no memory (status {status})")
