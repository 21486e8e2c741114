"""Hyperbolic functions, in the steps of Sun's fdlibm (1993)."""

import math

from rocksteady.kernels.elementary.exponential import expm1, scaled_exp
from rocksteady.kernels.elementary.logarithm import LN2, log, log1p
from rocksteady.kernels.machine_code.compilation import compiled

TINY = 2.0**-28
LARGE = 22.0
"""From here on e^-x is nothing beside e^x."""
HALF_LN3 = 0.5493061443340549
HALF_LN_5_3 = 0.25541281188299536  # half the logarithm of 5/3


@compiled
def sinh(x: float) -> float:
    """Return the hyperbolic sine."""
    x = float(x)
    size = abs(x)
    if size < TINY or math.isnan(x):
        return x
    if size >= LARGE:
        return math.copysign(scaled_exp(size, -1.0), x)
    t = expm1(size)
    part = t / (t + 1.0)
    return math.copysign(t - 0.5 * (t * part) if size < 1.0 else 0.5 * (t + part), x)


@compiled
def cosh(x: float) -> float:
    """Return the hyperbolic cosine."""
    half = scaled_exp(abs(float(x)), -1.0)
    return half + 0.25 / half


@compiled
def tanh(x: float) -> float:
    """Return the hyperbolic tangent."""
    x = float(x)
    size = abs(x)
    if size < TINY or math.isnan(x):
        return x
    if size >= LARGE:
        value = 1.0
    elif size > HALF_LN3:
        value = 1.0 - 2.0 / (expm1(2.0 * size) + 2.0)
    elif size > HALF_LN_5_3:
        t = expm1(2.0 * size)
        value = t / (t + 2.0)
    else:
        t = expm1(-2.0 * size)
        value = -t / (t + 2.0)
    return math.copysign(value, x)


@compiled
def asinh(x: float) -> float:
    """Return the inverse of the hyperbolic sine."""
    x = float(x)
    size = abs(x)
    if size < TINY or not size < math.inf:
        return x
    if size > 2.0**28:
        value = log(size) + LN2
    elif size > 2.0:
        value = log(2.0 * size + 1.0 / (math.sqrt(size * size + 1.0) + size))
    else:
        square = size * size
        value = log1p(size + square / (1.0 + math.sqrt(1.0 + square)))
    return math.copysign(value, x)
