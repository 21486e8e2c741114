"""The one way to compile a kernel, and where the machine code is kept.

numba's disk cache compares the time stamp of the file that defines a function, not those of the
functions it calls, so a kernel whose callee changed in another module would run stale code.  The
cache folder is therefore keyed on a hash of all kernel sources.
"""

import hashlib
import os
import tempfile
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any, TypeVar

import numba
import numba.core.config
import platformdirs

FunctionT = TypeVar("FunctionT", bound=Callable[..., object])

config: Any = numba.core.config  # its settings are made at import: no type checker sees them


@cache
def cache_folder() -> Path:
    """Return the folder of this version's machine code, one that can be written to."""
    digest = hashlib.sha256()
    for source in sorted(Path(__file__).parent.rglob("*.py")):
        digest.update(source.relative_to(Path(__file__).parent).as_posix().encode())
        digest.update(source.read_bytes())
    key = digest.hexdigest()[:16]
    preferred = Path(platformdirs.user_cache_dir("rocksteady")) / "kernels" / key
    try:
        preferred.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=preferred):
            return preferred
    except OSError:
        # A read-only home costs some seconds of compilation per machine start, not the run.  The
        # user's number keeps one user's code out of another's hands on a shared machine.
        user = os.getuid() if hasattr(os, "getuid") else 0
        fallback = Path(tempfile.gettempdir()) / f"rocksteady-{user}-{key}"
        fallback.mkdir(mode=0o700, parents=True, exist_ok=True)
        return fallback


def must_compile(kernel: str) -> bool:
    """Return whether no machine code of a kernel is kept yet: its first call compiles.

    `kernel` is its module and its name, as "march.march", which begin the name of numba's file.
    """
    return not config.DISABLE_JIT and not any(cache_folder().rglob(f"{kernel}-*.nbi"))


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
    # The cache folder is a global setting of numba, which other packages share, and is read at
    # decoration: it is ours only for this one call.
    before = config.CACHE_DIR
    config.CACHE_DIR = str(cache_folder())
    try:
        jit: Any = numba.njit(
            cache=True,
            nogil=True,
            error_model="numpy",
            forceinline=forceinline,
            fastmath=fastmath,
        )
        result: FunctionT = jit(function)
    finally:
        config.CACHE_DIR = before
    return result
