"""numba's side of a kernel: its compiler and its type, while libraries are built.

Importing this module teaches numba what a `Kernel` is.
"""

from functools import cache
from types import NoneType
from typing import Any

import numba
from numba.core import types

from rocksteady.kernels.machine_code.compilation import Kernel, Retyped
from rocksteady.kernels.machine_code.types import parts, signature_leaves, signature_of

EXTRA_OPTIONS: dict[str, Any] = {}
"""Options of numba that the build of a library adds."""


@cache
def dispatcher(kernel: Kernel) -> Any:
    """Return numba's compiler of a kernel.

    ``error_model="numpy"`` drops the check for division by zero: kernels never divide by a number
    that can be zero.  Fast-math stays off: the sign of a computed number decides whether a block
    falls, and no product may be fused with a sum where a processor can do so, or its last digits
    would be its own.
    """
    if isinstance(kernel, Retyped):
        return dispatcher(kernel.kernel)
    numbas: Any = numba  # no type checker knows the last option
    return numbas.njit(
        nogil=True,
        error_model="numpy",
        forceinline=kernel.forceinline,
        _nrt=kernel.allocates,
        **EXTRA_OPTIONS,
    )(kernel.py_func)


def compile_kernel(kernel: Kernel) -> Any:
    """Compile a kernel by numba with the types that its annotations say, and return the code.

    Raises
    ------
    TypeError
        If it returns something else than they say.
    """
    signature = signature_of(kernel.py_func)
    arguments = tuple(numba_type(hint) for hint in signature.arguments)
    made = dispatcher(kernel)
    made.compile(arguments)
    code = made.overloads[arguments]
    expected, found = numba_type(signature.result), code.signature.return_type
    if found != expected:
        raise TypeError(
            f"{kernel.py_func.__name__} returns {found}, its annotation says {expected}"
        )
    return code


def numba_type(hint: Any) -> Any:
    """Return numba's type of what an annotation says; None is that of no result."""
    if hint is None or hint is NoneType:
        return types.none
    inner = parts(hint)
    if inner is not None:
        made = [numba_type(part) for _, part in inner]
        return types.BaseTuple.from_types(made, hint if isinstance(hint, type) else None)
    (leaf,) = signature_leaves("", hint)
    scalars = {
        float: types.float64,
        int: types.int64,
        bool: types.boolean,
        complex: types.complex128,
    }
    scalar = scalars[leaf.kind]
    return types.Array(scalar, leaf.dimensions, "C") if leaf.dimensions else scalar


# numba asks a global of a function for its type by this name.
Kernel._numba_type_ = property(lambda kernel: numba.typeof(dispatcher(kernel)))  # type: ignore[attr-defined]
