"""The only decorators that compile kernels, and the folder that caches the machine code.

numba's disk cache compares the time stamp of the file that defines a function, not those of the
functions it calls, so a kernel whose callee changed in another module would run stale code.  The
cache folder is therefore keyed on a hash of all kernel sources.
"""

import hashlib
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any, TypeVar

import numba
import numba.core.config
import platformdirs

from rocksteady.kernels.core._caching import CheckedCache, own_folder

FunctionT = TypeVar("FunctionT", bound=Callable[..., object])

config: Any = numba.core.config  # its settings are made at import: no type checker sees them


@cache
def cache_folder() -> Path:
    """Return the folder of this version's machine code, one that only this user can write."""
    digest = hashlib.sha256()
    for source in sorted(Path(__file__).parents[1].rglob("*.py")):
        digest.update(source.relative_to(Path(__file__).parents[1]).as_posix().encode())
        digest.update(source.read_bytes())
    top = Path(platformdirs.user_cache_dir("rocksteady"))
    return own_folder(top, "kernels", digest.hexdigest()[:16])


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
            nogil=True,
            error_model="numpy",
            forceinline=forceinline,
            fastmath=fastmath,
        )
        found: Any = jit(function)
        if not config.DISABLE_JIT:
            found._cache = CheckedCache(function)  # as cache=True does with numba's own
    finally:
        config.CACHE_DIR = before
    compiled_function: FunctionT = found
    return compiled_function
