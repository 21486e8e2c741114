"""Decorators that make kernels, and the choice of what runs them.

A decorated function is a `Kernel`.  The library compiled with the package runs it; without a
library it runs as plain Python.  The build compiles kernels by numba: `tools.aot.dispatch`.
"""

import functools
import inspect
import os
import warnings
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from types import FunctionType
from typing import Any, TypeVar

from rocksteady.errors import InputError, MissingKernelsError, Words
from rocksteady.kernels.machine_code.library import library
from rocksteady.kernels.machine_code.sources import libraries_folder

FunctionT = TypeVar("FunctionT", bound=Callable[..., object])

CHOICE = "ROCKSTEADY_KERNELS"
"""Environment variable that chooses what runs kernels; unset: the library, if there is one."""
LIBRARY, PYTHON = "library", "python"
PURE = "pure.txt"
"""File in the folder of libraries that says why the build compiled none."""
SLOWER = "60 to 400"
"""Ratio of the times of plain Python and the library for one run, linear and nonlinear."""
PACKAGE = __name__.removesuffix("machine_code.compilation")
"""The dotted name of the kernels' package, with its last dot."""


@cache
def runner() -> str:
    """Return what runs kernels: ``"library"`` or ``"python"``.

    Raises
    ------
    MissingKernelsError
        If the library cannot be used, or CHOICE asks for one and there is none.
    InputError
        If CHOICE is neither of them.
    """
    choice = os.environ.get(CHOICE, "")
    if choice == PYTHON:
        return PYTHON
    if choice not in {"", LIBRARY}:
        raise InputError(
            CHOICE,
            choice,
            f"it must be {LIBRARY} or {PYTHON}",
            "unset it to use the library where there is one",
        )
    if library() is not None:
        return LIBRARY
    if choice == LIBRARY:
        raise MissingKernelsError(
            "the library of compiled kernels",
            Words("is not in this installation"),
            "installing the package compiles it, and a wheel for this platform brings it",
            f"unset {CHOICE} to run the kernels as plain Python",
        )
    warnings.warn(without_library(), RuntimeWarning, stacklevel=2)
    return PYTHON


def without_library() -> str:
    """Return why kernels run as plain Python here, and how slow they are."""
    reason = "this installation has no compiled ones"
    with suppress(OSError):
        reason = (libraries_folder() / PURE).read_text("utf-8").strip()
    return f"kernels run as plain Python, {SLOWER} times slower: {reason}"


def compiled(function: FunctionT) -> FunctionT:
    """Make a kernel of a module-level function."""
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
    """A function that the library runs, or plain Python where there is none.

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
    py_func, forceinline, allocates
        The parameters.
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
        self.forceinline = forceinline
        self.allocates = allocates
        self._call: Callable[..., Any] = self._first_call

    def __call__(self, *arguments: Any) -> Any:
        """Return what the function returns."""
        return self._call(*arguments)

    def __reduce__(self) -> str:
        return self.py_func.__qualname__

    def _first_call(self, *arguments: Any) -> Any:
        found = None
        if runner() == LIBRARY and self.py_func.__module__.startswith(PACKAGE):
            loaded = library()
            found = loaded.entry(self.py_func) if loaded else None
        # What the library does not hold is called by other kernels: from Python by tests alone.
        self._call = found or _in_python(self.py_func)
        return self._call(*arguments)


class Retyped(Kernel):
    """A kernel under another name, for arguments of other types.

    Attributes
    ----------
    kernel
        The kernel.
    """

    def __init__(self, function: Callable[..., object], kernel: Kernel) -> None:
        super().__init__(function)
        self.kernel = kernel


def retyped(kernel: Any, name: str, **types: Any) -> Any:
    """Return a kernel under another name, some of whose arguments have other types."""
    before: Any = inspect.unwrap(kernel)
    function = FunctionType(before.__code__, before.__globals__, name)
    function.__qualname__, function.__doc__ = name, before.__doc__
    function.__annotations__ = {**before.__annotations__, **types}
    return Retyped(function, kernel)


def _kernel(
    function: FunctionT, *, forceinline: bool = False, allocates: bool = False
) -> FunctionT:
    kernel: Any = Kernel(function, forceinline=forceinline, allocates=allocates)
    made: FunctionT = kernel
    return made


def _in_python(function: Callable[..., object]) -> Callable[..., Any]:
    """Return a function whose numbers are Python's, as those of compiled code are."""

    def call(*arguments: Any) -> Any:
        return _plain(function(*arguments))

    return call


def _plain(value: Any) -> Any:
    """Return a result with Python's numbers in place of NumPy's; arrays as they are."""
    if isinstance(value, tuple):
        items = [_plain(item) for item in value]
        return value._make(items) if hasattr(value, "_make") else tuple(items)
    return value.item() if hasattr(value, "dtype") and not value.shape else value
