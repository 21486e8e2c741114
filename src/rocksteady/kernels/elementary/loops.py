"""The elementary functions over arrays: flat ones of float64, `out` as long as the others."""

from rocksteady.kernels.elementary.circular import cos, sin, tan
from rocksteady.kernels.elementary.exponential import exp, expm1
from rocksteady.kernels.elementary.hyperbolic import asinh, cosh, sinh, tanh
from rocksteady.kernels.elementary.inverse import acos, asin, atan, atan2
from rocksteady.kernels.elementary.lengths import hypot, next_up
from rocksteady.kernels.elementary.logarithm import log, log1p
from rocksteady.kernels.machine_code.compilation import compiled
from rocksteady.kernels.machine_code.types import Floats1


@compiled
def fill_exp(x: Floats1, out: Floats1) -> None:
    """Fill `out` with e^x of each x."""
    for i in range(x.size):
        out[i] = exp(x[i])


@compiled
def fill_expm1(x: Floats1, out: Floats1) -> None:
    """Fill `out` with e^x - 1 of each x."""
    for i in range(x.size):
        out[i] = expm1(x[i])


@compiled
def fill_log(x: Floats1, out: Floats1) -> None:
    """Fill `out` with the natural logarithm of each x."""
    for i in range(x.size):
        out[i] = log(x[i])


@compiled
def fill_log1p(x: Floats1, out: Floats1) -> None:
    """Fill `out` with log(1 + x) of each x."""
    for i in range(x.size):
        out[i] = log1p(x[i])


@compiled
def fill_sin(x: Floats1, out: Floats1) -> None:
    """Fill `out` with the sine of each x."""
    for i in range(x.size):
        out[i] = sin(x[i])


@compiled
def fill_cos(x: Floats1, out: Floats1) -> None:
    """Fill `out` with the cosine of each x."""
    for i in range(x.size):
        out[i] = cos(x[i])


@compiled
def fill_tan(x: Floats1, out: Floats1) -> None:
    """Fill `out` with the tangent of each x."""
    for i in range(x.size):
        out[i] = tan(x[i])


@compiled
def fill_asin(x: Floats1, out: Floats1) -> None:
    """Fill `out` with the inverse sine of each x."""
    for i in range(x.size):
        out[i] = asin(x[i])


@compiled
def fill_acos(x: Floats1, out: Floats1) -> None:
    """Fill `out` with the inverse cosine of each x."""
    for i in range(x.size):
        out[i] = acos(x[i])


@compiled
def fill_atan(x: Floats1, out: Floats1) -> None:
    """Fill `out` with the inverse tangent of each x."""
    for i in range(x.size):
        out[i] = atan(x[i])


@compiled
def fill_sinh(x: Floats1, out: Floats1) -> None:
    """Fill `out` with the hyperbolic sine of each x."""
    for i in range(x.size):
        out[i] = sinh(x[i])


@compiled
def fill_cosh(x: Floats1, out: Floats1) -> None:
    """Fill `out` with the hyperbolic cosine of each x."""
    for i in range(x.size):
        out[i] = cosh(x[i])


@compiled
def fill_tanh(x: Floats1, out: Floats1) -> None:
    """Fill `out` with the hyperbolic tangent of each x."""
    for i in range(x.size):
        out[i] = tanh(x[i])


@compiled
def fill_asinh(x: Floats1, out: Floats1) -> None:
    """Fill `out` with the inverse hyperbolic sine of each x."""
    for i in range(x.size):
        out[i] = asinh(x[i])


@compiled
def fill_next_up(x: Floats1, out: Floats1) -> None:
    """Fill `out` with the next number above of each x."""
    for i in range(x.size):
        out[i] = next_up(x[i])


@compiled
def fill_atan2(y: Floats1, x: Floats1, out: Floats1) -> None:
    """Fill `out` with the angle of (x, y) of each pair."""
    for i in range(y.size):
        out[i] = atan2(y[i], x[i])


@compiled
def fill_hypot(x: Floats1, y: Floats1, out: Floats1) -> None:
    """Fill `out` with the length of (x, y) of each pair."""
    for i in range(x.size):
        out[i] = hypot(x[i], y[i])
