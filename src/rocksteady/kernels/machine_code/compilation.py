"""Decorators that make kernels, and the choice of what runs them.

A decorated function is a `Kernel`.  The library compiled ahead of time runs it where it holds it;
elsewhere numba compiles it at its first call.  No other module imports numba, except the cache
beside this one.
"""

import functools
import importlib.util
import inspect
import os
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from importlib.metadata import version
from pathlib import Path
from types import FunctionType, NoneType
from typing import Any, TypeVar

from rocksteady.errors import InputError, MissingKernelsError, Words
from rocksteady.kernels.machine_code._folders import own_folder, prune, version_folder
from rocksteady.kernels.machine_code.library import library
from rocksteady.kernels.machine_code.sources import sources_hash, unchanged
from rocksteady.kernels.machine_code.types import parts, signature_leaves, signature_of

FunctionT = TypeVar("FunctionT", bound=Callable[..., object])

CHOICE = "ROCKSTEADY_KERNELS"
"""Environment variable that says what runs kernels; unset, the first of these that is there."""
LIBRARY, JIT, PYTHON = "library", "jit", "python"
PACKAGE = __name__.removesuffix("machine_code.compilation")
"""The dotted name of the kernels' package, with its last dot."""


@cache
def runner() -> str:
    """Return what runs kernels: ``"library"``, ``"jit"`` (numba) or ``"python"``.

    Raises
    ------
    MissingKernelsError
        If there is neither a library for this processor nor numba, or not what CHOICE asks for.
    InputError
        If CHOICE is none of them.
    """
    choice = os.environ.get(CHOICE, "")
    if choice == PYTHON:
        return PYTHON
    if choice not in {"", LIBRARY, JIT}:
        raise InputError(
            CHOICE,
            choice,
            f"it must be {LIBRARY}, {JIT} or {PYTHON}",
            "unset it to use the library where there is one, and else numba",
        )
    if choice != JIT and library() is not None:
        return LIBRARY
    if choice != LIBRARY and importlib.util.find_spec("numba") is not None:
        return JIT
    raise MissingKernelsError(
        "compiled code",
        (
            Words(
                {
                    LIBRARY: "is not in this installation",
                    JIT: "needs numba, which is not installed",
                }.get(choice, "is not in this installation, nor is numba")
            )
        ),
        "a wheel for this platform brings it, and numba compiles it",
        "install such a wheel, or 'rocksteady[jit]'",
    )


@cache
def cache_folder() -> Path:
    """Return the folder of what numba compiles, one that only this user can write.

    Two copies of the package have the same one if their kernels, Python, numba, llvmlite and NumPy
    are the same.
    """
    preferred = version_folder(sources_hash())
    top = preferred.parents[1]
    folder = own_folder(top, *preferred.relative_to(top).parts, _tools())
    if folder.is_relative_to(top):
        prune(preferred)
    return folder


def must_compile(kernel: str) -> bool:
    """Return whether the first call of a kernel compiles it.

    `kernel` is its module and its name, as "march.march", which are in the name of its file.
    """
    return runner() == JIT and not any(cache_folder().glob(f"*.{kernel}-*.nbi"))


def compiled(function: FunctionT) -> FunctionT:
    """Make a kernel of a module-level function.

    ``error_model="numpy"`` drops the check for division by zero: kernels never divide by a number
    that can be zero.  ``nogil`` lets threads run kernels side by side.  Fast-math stays off: the
    sign of a computed number decides whether a block falls, and no product may be fused with a sum
    where a processor can do so, or its last digits would be its own.
    """
    return _kernel(function)


def allocating(function: FunctionT) -> FunctionT:
    """Make a kernel of a function that makes arrays, which need to be counted and freed.

    Others count no references to theirs: counting costs as much as the arithmetic of a short step.
    """
    return _kernel(function, allocates=True)


def inlined(function: FunctionT) -> FunctionT:
    """Make a kernel that is compiled into each of its callers: what one flight calls many times."""
    return _kernel(function, forceinline=True)


def inlined_allocating(function: FunctionT) -> FunctionT:
    """Make a kernel of a function that makes arrays, compiled into each of its callers."""
    return _kernel(function, forceinline=True, allocates=True)


class Kernel:
    """A function that is compiled: the library's, or numba's from its first call on.

    Parameters
    ----------
    function
        What it computes, in Python.
    forceinline
        Whether it is compiled into its callers.
    allocates
        Whether it makes arrays.

    Attributes
    ----------
    py_func
        The function.
    """

    def __init__(
        self,
        function: Callable[..., object],
        *,
        forceinline: bool = False,
        allocates: bool = False,
    ) -> None:
        functools.update_wrapper(self, function)
        self.py_func = function
        self._forceinline = forceinline
        self._allocates = allocates
        self._call: Callable[..., Any] = self._first_call

    def __call__(self, *arguments: Any) -> Any:
        """Return what the function returns."""
        return self._call(*arguments)

    def __reduce__(self) -> str:
        return self.py_func.__qualname__

    def _first_call(self, *arguments: Any) -> Any:
        self._call = self._resolved()
        return self._call(*arguments)

    def _resolved(self) -> Callable[..., Any]:
        """Return what runs the function."""
        if runner() == LIBRARY and self.py_func.__module__.startswith(PACKAGE):
            loaded = library()
            found = loaded.entry(self.py_func) if loaded else None
            # What the library does not hold is called by other kernels: from Python by tests alone.
            return found or self.py_func
        dispatcher: Callable[..., Any] = self.dispatcher
        return dispatcher

    @functools.cached_property
    def dispatcher(self) -> Any:
        """Return numba's compiler of the function."""
        import numba
        import numba.core.config

        settings: Any = numba.core.config  # made at import: no type checker sees them
        numbas: Any = numba  # no type checker knows the last option
        found = numbas.njit(
            nogil=True,
            error_model="numpy",
            forceinline=self._forceinline,
            _nrt=self._allocates,
            **EXTRA_OPTIONS,
        )(self.py_func)
        if not EXTRA_OPTIONS and not settings.DISABLE_JIT:
            from rocksteady.kernels.machine_code._caching import CheckedCache

            # As cache=True does with numba's own. A source that cannot be read, as one in an
            # archive, is compiled in each process.
            with suppress(OSError):
                found._cache = CheckedCache(
                    self.py_func, _name(self.py_func), cache_folder(), unchanged
                )
        return found

    @property
    def _numba_type_(self) -> Any:
        """Return the type by which numba knows it in another kernel."""
        import numba

        return numba.typeof(self.dispatcher)

    def compile(self) -> Any:
        """Compile it by numba with the types that its annotations say, and return the code.

        Raises
        ------
        TypeError
            If it returns something else than they say.
        """
        signature = signature_of(self.py_func)
        types = tuple(numba_type(hint) for hint in signature.arguments)
        self.dispatcher.compile(types)
        code = self.dispatcher.overloads[types]
        expected = numba_type(signature.result)
        if code.signature.return_type != expected:
            found = code.signature.return_type
            raise TypeError(
                f"{self.py_func.__name__} returns {found}, its annotation says {expected}"
            )
        return code


class _Retyped(Kernel):
    """A kernel under another name, for arguments of other types, which numba tells apart."""

    def __init__(self, function: Callable[..., object], kernel: Kernel) -> None:
        super().__init__(function)
        self._kernel = kernel

    @functools.cached_property
    def dispatcher(self) -> Any:
        """Return numba's compiler of the kernel that it is made of."""
        return self._kernel.dispatcher


def retyped(kernel: Any, name: str, **types: Any) -> Any:
    """Return a kernel under another name, some of whose arguments have other types."""
    before: Any = inspect.unwrap(kernel)
    function = FunctionType(before.__code__, before.__globals__, name)
    function.__qualname__, function.__doc__ = name, before.__doc__
    function.__annotations__ = {**before.__annotations__, **types}
    return _Retyped(function, kernel) if isinstance(kernel, Kernel) else function


EXTRA_OPTIONS: dict[str, Any] = {}
"""Options of numba that the build of a library adds; machine code is not kept on disk then."""


def numba_type(hint: Any) -> Any:
    """Return numba's type of what an annotation says; None is that of no result."""
    from numba.core import types

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


def _kernel(
    function: FunctionT, *, forceinline: bool = False, allocates: bool = False
) -> FunctionT:
    if os.environ.get(CHOICE) == PYTHON:
        return _in_python(function)
    kernel: Any = Kernel(function, forceinline=forceinline, allocates=allocates)
    made: FunctionT = kernel
    return made


def _in_python(function: FunctionT) -> FunctionT:
    """Return a function whose numbers are Python's, as those of compiled code are."""

    def call(*arguments: Any) -> Any:
        return _plain(function(*arguments))

    made: Any = functools.update_wrapper(call, function)
    made.py_func = function
    return made  # type: ignore[no-any-return]


def _plain(value: Any) -> Any:
    """Return a result with Python's numbers in place of NumPy's; arrays as they are."""
    if isinstance(value, tuple):
        items = [_plain(item) for item in value]
        return value._make(items) if hasattr(value, "_make") else tuple(items)
    return value.item() if hasattr(value, "dtype") and not value.shape else value


def _tools() -> str:
    """Return what turns kernels into machine code, with its versions."""
    import sys

    tools = ("numba", "llvmlite", "numpy")
    return "-".join((sys.implementation.cache_tag or "", *(f"{t}-{version(t)}" for t in tools)))


def _name(function: Callable[..., object]) -> str:
    """Return the name of a function's module, alike in every copy of the package."""
    if function.__module__.startswith(PACKAGE):
        return function.__module__.removeprefix(PACKAGE)
    # Of another one, as in a test: its path tells it from those of the same name.
    import hashlib

    path = hashlib.sha256(function.__code__.co_filename.encode()).hexdigest()
    return f"{function.__module__}-{path[:16]}"
