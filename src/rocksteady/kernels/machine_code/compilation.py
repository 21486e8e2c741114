"""The only decorators that compile kernels, and the folder that caches the machine code.

A kernel is compiled together with the functions that it calls, from whatever module, so that its
machine code is that of all kernel sources: the cache folder is keyed on their content.
"""

import hashlib
import sys
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any, TypeVar

import llvmlite  # type: ignore[import-untyped]
import numba
import numba.core.config
import numpy as np
import platformdirs

from rocksteady.errors import Status
from rocksteady.kernels.machine_code._caching import CheckedCache
from rocksteady.kernels.machine_code._folders import own_folder, prune

FunctionT = TypeVar("FunctionT", bound=Callable[..., object])

config: Any = numba.core.config  # its settings are made at import: no type checker sees them

PACKAGE = __name__.removesuffix("machine_code.compilation")
"""The dotted name of the kernels' package, with its last dot."""


@cache
def cache_folder() -> Path:
    """Return the folder of this version's machine code, one that only this user can write.

    Two copies of the package have the same one if their kernels, Python, numba, llvmlite and NumPy
    are the same.
    """
    _stamps()
    top = Path(platformdirs.user_cache_dir("rocksteady"))
    folder = own_folder(top, "kernels", _version(), _tools())
    if folder.is_relative_to(top):
        prune(folder.parent)
    return folder


def must_compile(kernel: str) -> bool:
    """Return whether no machine code of a kernel is kept yet: its first call compiles.

    `kernel` is its module and its name, as "march.march", which are in the name of its file.
    """
    return not config.DISABLE_JIT and not any(cache_folder().glob(f"*.{kernel}-*.nbi"))


def compiled(function: FunctionT) -> FunctionT:
    """Compile a module-level function; with ``NUMBA_DISABLE_JIT=1`` return it unchanged.

    ``error_model="numpy"`` drops the check for division by zero: kernels never divide by a number
    that can be zero.  ``nogil`` lets threads run kernels side by side.  Fast-math stays off: the
    sign of a computed number decides whether a block falls.
    """
    return _compile(function)


def fused(function: FunctionT) -> FunctionT:
    """Compile a loop over lanes, in which a product and the sum that it enters are rounded once.

    Machines that cannot do so give other last digits; each gives the same ones every time.
    """
    return _compile(function, fastmath={"contract"})


def fused_inlined(function: FunctionT) -> FunctionT:
    """Compile a small function into the loops over lanes that call it."""
    return _compile(function, forceinline=True, fastmath={"contract"})


def inlined(function: FunctionT) -> FunctionT:
    """Compile a small function into each of its callers: what one flight calls many times."""
    return _compile(function, forceinline=True)


def _compile(
    function: FunctionT, *, forceinline: bool = False, fastmath: bool | set[str] = False
) -> FunctionT:
    jit: Any = numba.njit(
        nogil=True,
        error_model="numpy",
        forceinline=forceinline,
        fastmath=fastmath,
    )
    found: Any = jit(function)
    if not config.DISABLE_JIT:
        # As cache=True does with numba's own. A source that cannot be read, as one in an archive,
        # is compiled in each process.
        with suppress(OSError):
            found._cache = CheckedCache(function, _name(function), cache_folder(), _unchanged)
    compiled_function: FunctionT = found
    return compiled_function


def _sources() -> list[Path]:
    """Return the files of all kernels, in one order wherever they are."""
    return sorted(Path(__file__).parents[1].rglob("*.py"))


def _version() -> str:
    """Return a hash of what machine code is made of: the kernels, and the codes they end with."""
    digest = hashlib.sha256(repr([(status.name, status.value) for status in Status]).encode())
    for source in _sources():
        digest.update(source.relative_to(Path(__file__).parents[1]).as_posix().encode())
        digest.update(source.read_bytes())
    return digest.hexdigest()[:16]


def _tools() -> str:
    """Return what turns kernels into machine code, with its versions."""
    parts = (sys.implementation.cache_tag, "numba", numba.__version__)
    return "-".join((*parts, "llvmlite", llvmlite.__version__, "numpy", np.__version__))


def _name(function: Callable[..., object]) -> str:
    """Return the name of a function's module, alike in every copy of the package."""
    if function.__module__.startswith(PACKAGE):
        return function.__module__.removeprefix(PACKAGE)
    # Of another one, as in a test: its path tells it from those of the same name.
    path = hashlib.sha256(function.__code__.co_filename.encode()).hexdigest()
    return f"{function.__module__}-{path[:16]}"


@cache
def _stamps() -> dict[Path, tuple[int, int]]:
    """Return time stamp and size of each source when the folder was chosen."""
    return {source: _stamp(source) for source in _sources()}


def _stamp(source: Path) -> tuple[int, int]:
    found = source.stat()
    return found.st_mtime_ns, found.st_size


def _unchanged() -> bool:
    """Return whether the kernel sources are unchanged since the cache folder was chosen."""
    return all(_stamp(source) == stamp for source, stamp in _stamps().items())
