"""Elementary functions for callers in Python: of a number, or of an array.

A number gives a Python float, and an array, of any shape and real type, an array of float64.  Both
are the same bits that kernels get.
"""

from collections.abc import Callable
from typing import Any, overload

import numpy as np
from numpy.typing import NDArray

from rocksteady.kernels.elementary import (
    circular,
    exponential,
    hyperbolic,
    inverse,
    lengths,
    logarithm,
    loops,
)

Floats = NDArray[np.float64]
Numbers = NDArray[np.floating[Any] | np.integer[Any] | np.bool_]
Real = float | np.floating[Any] | np.integer[Any]


def _of_one(kernel: Callable[[float], float], fill: Callable[..., None], x: Any) -> Any:
    """Return a function of a number or of each element of an array."""
    if isinstance(x, np.ndarray):
        given = np.ascontiguousarray(x, dtype=np.float64).reshape(-1)
        out = np.empty(x.shape)
        fill(given, out.reshape(-1))
        return out
    return float(_plain(kernel)(float(x)))


def _of_two(
    kernel: Callable[[float, float], float], fill: Callable[..., None], x: Any, y: Any
) -> Any:
    """Return a function of two numbers, or of each pair of what broadcasting makes of them."""
    if isinstance(x, np.ndarray) or isinstance(y, np.ndarray):
        pair = np.broadcast_arrays(x, y)
        first, second = (np.ascontiguousarray(each, dtype=np.float64) for each in pair)
        out = np.empty(pair[0].shape)
        fill(first.reshape(-1), second.reshape(-1), out.reshape(-1))
        return out
    return float(_plain(kernel)(float(x), float(y)))


def _plain(kernel: Any) -> Any:
    """Return the function as Python runs it: a single number is not worth compiling for."""
    return getattr(kernel, "py_func", kernel)


@overload
def exp(x: Real) -> float: ...
@overload
def exp(x: Numbers) -> Floats: ...
def exp(x: Real | Numbers) -> float | Floats:
    """Return e^x."""
    return _of_one(exponential.exp, loops.fill_exp, x)  # type: ignore[no-any-return]


@overload
def expm1(x: Real) -> float: ...
@overload
def expm1(x: Numbers) -> Floats: ...
def expm1(x: Real | Numbers) -> float | Floats:
    """Return e^x - 1."""
    return _of_one(exponential.expm1, loops.fill_expm1, x)  # type: ignore[no-any-return]


@overload
def log(x: Real) -> float: ...
@overload
def log(x: Numbers) -> Floats: ...
def log(x: Real | Numbers) -> float | Floats:
    """Return the natural logarithm."""
    return _of_one(logarithm.log, loops.fill_log, x)  # type: ignore[no-any-return]


@overload
def log1p(x: Real) -> float: ...
@overload
def log1p(x: Numbers) -> Floats: ...
def log1p(x: Real | Numbers) -> float | Floats:
    """Return log(1 + x)."""
    return _of_one(logarithm.log1p, loops.fill_log1p, x)  # type: ignore[no-any-return]


@overload
def sin(x: Real) -> float: ...
@overload
def sin(x: Numbers) -> Floats: ...
def sin(x: Real | Numbers) -> float | Floats:
    """Return the sine."""
    return _of_one(circular.sin, loops.fill_sin, x)  # type: ignore[no-any-return]


@overload
def cos(x: Real) -> float: ...
@overload
def cos(x: Numbers) -> Floats: ...
def cos(x: Real | Numbers) -> float | Floats:
    """Return the cosine."""
    return _of_one(circular.cos, loops.fill_cos, x)  # type: ignore[no-any-return]


@overload
def tan(x: Real) -> float: ...
@overload
def tan(x: Numbers) -> Floats: ...
def tan(x: Real | Numbers) -> float | Floats:
    """Return the tangent."""
    return _of_one(circular.tan, loops.fill_tan, x)  # type: ignore[no-any-return]


@overload
def asin(x: Real) -> float: ...
@overload
def asin(x: Numbers) -> Floats: ...
def asin(x: Real | Numbers) -> float | Floats:
    """Return the inverse sine."""
    return _of_one(inverse.asin, loops.fill_asin, x)  # type: ignore[no-any-return]


@overload
def acos(x: Real) -> float: ...
@overload
def acos(x: Numbers) -> Floats: ...
def acos(x: Real | Numbers) -> float | Floats:
    """Return the inverse cosine."""
    return _of_one(inverse.acos, loops.fill_acos, x)  # type: ignore[no-any-return]


@overload
def atan(x: Real) -> float: ...
@overload
def atan(x: Numbers) -> Floats: ...
def atan(x: Real | Numbers) -> float | Floats:
    """Return the inverse tangent."""
    return _of_one(inverse.atan, loops.fill_atan, x)  # type: ignore[no-any-return]


@overload
def sinh(x: Real) -> float: ...
@overload
def sinh(x: Numbers) -> Floats: ...
def sinh(x: Real | Numbers) -> float | Floats:
    """Return the hyperbolic sine."""
    return _of_one(hyperbolic.sinh, loops.fill_sinh, x)  # type: ignore[no-any-return]


@overload
def cosh(x: Real) -> float: ...
@overload
def cosh(x: Numbers) -> Floats: ...
def cosh(x: Real | Numbers) -> float | Floats:
    """Return the hyperbolic cosine."""
    return _of_one(hyperbolic.cosh, loops.fill_cosh, x)  # type: ignore[no-any-return]


@overload
def tanh(x: Real) -> float: ...
@overload
def tanh(x: Numbers) -> Floats: ...
def tanh(x: Real | Numbers) -> float | Floats:
    """Return the hyperbolic tangent."""
    return _of_one(hyperbolic.tanh, loops.fill_tanh, x)  # type: ignore[no-any-return]


@overload
def asinh(x: Real) -> float: ...
@overload
def asinh(x: Numbers) -> Floats: ...
def asinh(x: Real | Numbers) -> float | Floats:
    """Return the inverse hyperbolic sine."""
    return _of_one(hyperbolic.asinh, loops.fill_asinh, x)  # type: ignore[no-any-return]


@overload
def next_up(x: Real) -> float: ...
@overload
def next_up(x: Numbers) -> Floats: ...
def next_up(x: Real | Numbers) -> float | Floats:
    """Return the next number above."""
    return _of_one(lengths.next_up, loops.fill_next_up, x)  # type: ignore[no-any-return]


@overload
def atan2(y: Real, x: Real) -> float: ...
@overload
def atan2(y: Numbers, x: Real | Numbers) -> Floats: ...
@overload
def atan2(y: Real, x: Numbers) -> Floats: ...
def atan2(y: Real | Numbers, x: Real | Numbers) -> float | Floats:
    """Return the angle of (x, y)."""
    return _of_two(inverse.atan2, loops.fill_atan2, y, x)  # type: ignore[no-any-return]


@overload
def hypot(x: Real, y: Real) -> float: ...
@overload
def hypot(x: Numbers, y: Real | Numbers) -> Floats: ...
@overload
def hypot(x: Real, y: Numbers) -> Floats: ...
def hypot(x: Real | Numbers, y: Real | Numbers) -> float | Floats:
    """Return the length of (x, y)."""
    return _of_two(lengths.hypot, loops.fill_hypot, x, y)  # type: ignore[no-any-return]
