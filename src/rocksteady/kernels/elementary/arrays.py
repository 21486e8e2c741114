"""Elementary functions for callers in Python: of a number, or of an array.

A number gives a Python float, and an array, of any shape and real type, an array of float64.  Both
are the same bits that kernels get.

Nothing is imported before the first call: the nouns of the package, which have sizes and angles,
are there at once.
"""

import struct
from collections.abc import Callable
from functools import cache
from importlib import import_module
from types import FunctionType
from typing import TYPE_CHECKING, Any, overload

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]
    Numbers = NDArray[np.floating[Any] | np.integer[Any] | np.bool_]
    Real = float | np.floating[Any] | np.integer[Any]

PACKAGE = __name__.rpartition(".")[0]


def _of_one(module: str, name: str, x: Any) -> "float | Floats":
    """Return a function of a number or of each element of an array."""
    if isinstance(x, float | int):
        return float(_of_numbers(module, name)(float(x)))
    import numpy as np

    if not isinstance(x, np.ndarray):
        return float(_of_numbers(module, name)(float(x)))
    given = np.array(x, dtype=np.float64, order="C").reshape(-1)  # writable: one signature
    out = np.empty(x.shape)
    _loop(name)(given, out.reshape(-1))
    return out


def _of_two(module: str, name: str, x: Any, y: Any) -> "float | Floats":
    """Return a function of two numbers, or of each pair of what broadcasting makes of them."""
    if isinstance(x, float | int) and isinstance(y, float | int):
        return float(_of_numbers(module, name)(float(x), float(y)))
    import numpy as np

    if not (isinstance(x, np.ndarray) or isinstance(y, np.ndarray)):
        return float(_of_numbers(module, name)(float(x), float(y)))
    pair = np.broadcast_arrays(x, y)
    first, second = (np.array(each, dtype=np.float64, order="C") for each in pair)
    out = np.empty(pair[0].shape)
    _loop(name)(first.reshape(-1), second.reshape(-1), out.reshape(-1))
    return out


@cache
def _loop(name: str) -> Any:
    """Return the kernel of a function over arrays."""
    return getattr(import_module(f"{PACKAGE}.loops"), f"fill_{name}")


@cache
def _of_numbers(module: str, name: str) -> Any:
    """Return a function in plain Python: a single number is not worth compiling for."""
    return _in_python(getattr(import_module(f"{PACKAGE}.{module}"), name))


@cache
def _in_python(kernel: Any) -> Any:
    """Return a kernel as a function of plain Python, which calls no compiled one."""
    if kernel.__name__ in QUICK:
        return QUICK[kernel.__name__]
    function = getattr(kernel, "py_func", kernel)
    scope = dict(function.__globals__)
    for name in function.__code__.co_names:
        used = scope.get(name)
        if getattr(used, "__module__", "").startswith(PACKAGE) and callable(used):
            scope[name] = _in_python(used)
    return FunctionType(function.__code__, scope, function.__name__)


def _bits_of(x: float) -> int:
    return int(struct.unpack("<q", struct.pack("<d", x))[0])


def _float_of(bits: int) -> float:
    return float(struct.unpack("<d", struct.pack("<q", bits))[0])


QUICK: dict[str, Callable[..., Any]] = {"bits_of": _bits_of, "float_of": _float_of}
"""What plain Python does faster by other means than NumPy's."""


@overload
def exp(x: "Real") -> float: ...
@overload
def exp(x: "Numbers") -> "Floats": ...
def exp(x: "Real | Numbers") -> "float | Floats":
    """Return e^x."""
    return _of_one("exponential", "exp", x)


@overload
def expm1(x: "Real") -> float: ...
@overload
def expm1(x: "Numbers") -> "Floats": ...
def expm1(x: "Real | Numbers") -> "float | Floats":
    """Return e^x - 1."""
    return _of_one("exponential", "expm1", x)


@overload
def log(x: "Real") -> float: ...
@overload
def log(x: "Numbers") -> "Floats": ...
def log(x: "Real | Numbers") -> "float | Floats":
    """Return the natural logarithm."""
    return _of_one("logarithm", "log", x)


@overload
def log1p(x: "Real") -> float: ...
@overload
def log1p(x: "Numbers") -> "Floats": ...
def log1p(x: "Real | Numbers") -> "float | Floats":
    """Return log(1 + x)."""
    return _of_one("logarithm", "log1p", x)


@overload
def sin(x: "Real") -> float: ...
@overload
def sin(x: "Numbers") -> "Floats": ...
def sin(x: "Real | Numbers") -> "float | Floats":
    """Return the sine."""
    return _of_one("circular", "sin", x)


@overload
def cos(x: "Real") -> float: ...
@overload
def cos(x: "Numbers") -> "Floats": ...
def cos(x: "Real | Numbers") -> "float | Floats":
    """Return the cosine."""
    return _of_one("circular", "cos", x)


@overload
def sincos(x: "Real") -> tuple[float, float]: ...
@overload
def sincos(x: "Numbers") -> tuple["Floats", "Floats"]: ...
def sincos(x: "Real | Numbers") -> tuple["float | Floats", "float | Floats"]:
    """Return sine and cosine."""
    return sin(x), cos(x)


@overload
def tan(x: "Real") -> float: ...
@overload
def tan(x: "Numbers") -> "Floats": ...
def tan(x: "Real | Numbers") -> "float | Floats":
    """Return the tangent."""
    return _of_one("circular", "tan", x)


@overload
def asin(x: "Real") -> float: ...
@overload
def asin(x: "Numbers") -> "Floats": ...
def asin(x: "Real | Numbers") -> "float | Floats":
    """Return the inverse sine."""
    return _of_one("inverse", "asin", x)


@overload
def acos(x: "Real") -> float: ...
@overload
def acos(x: "Numbers") -> "Floats": ...
def acos(x: "Real | Numbers") -> "float | Floats":
    """Return the inverse cosine."""
    return _of_one("inverse", "acos", x)


@overload
def atan(x: "Real") -> float: ...
@overload
def atan(x: "Numbers") -> "Floats": ...
def atan(x: "Real | Numbers") -> "float | Floats":
    """Return the inverse tangent."""
    return _of_one("inverse", "atan", x)


@overload
def sinh(x: "Real") -> float: ...
@overload
def sinh(x: "Numbers") -> "Floats": ...
def sinh(x: "Real | Numbers") -> "float | Floats":
    """Return the hyperbolic sine."""
    return _of_one("hyperbolic", "sinh", x)


@overload
def cosh(x: "Real") -> float: ...
@overload
def cosh(x: "Numbers") -> "Floats": ...
def cosh(x: "Real | Numbers") -> "float | Floats":
    """Return the hyperbolic cosine."""
    return _of_one("hyperbolic", "cosh", x)


@overload
def tanh(x: "Real") -> float: ...
@overload
def tanh(x: "Numbers") -> "Floats": ...
def tanh(x: "Real | Numbers") -> "float | Floats":
    """Return the hyperbolic tangent."""
    return _of_one("hyperbolic", "tanh", x)


@overload
def asinh(x: "Real") -> float: ...
@overload
def asinh(x: "Numbers") -> "Floats": ...
def asinh(x: "Real | Numbers") -> "float | Floats":
    """Return the inverse hyperbolic sine."""
    return _of_one("hyperbolic", "asinh", x)


@overload
def next_up(x: "Real") -> float: ...
@overload
def next_up(x: "Numbers") -> "Floats": ...
def next_up(x: "Real | Numbers") -> "float | Floats":
    """Return the next number above."""
    return _of_one("lengths", "next_up", x)


@overload
def atan2(y: "Real", x: "Real") -> float: ...
@overload
def atan2(y: "Numbers", x: "Real | Numbers") -> "Floats": ...
@overload
def atan2(y: "Real", x: "Numbers") -> "Floats": ...
def atan2(y: "Real | Numbers", x: "Real | Numbers") -> "float | Floats":
    """Return the angle of (x, y)."""
    return _of_two("inverse", "atan2", y, x)


@overload
def hypot(x: "Real", y: "Real") -> float: ...
@overload
def hypot(x: "Numbers", y: "Real | Numbers") -> "Floats": ...
@overload
def hypot(x: "Real", y: "Numbers") -> "Floats": ...
def hypot(x: "Real | Numbers", y: "Real | Numbers") -> "float | Floats":
    """Return the length of (x, y)."""
    return _of_two("lengths", "hypot", x, y)
