"""Natural logarithm of a number, and of a number added to one.

``x = 2^k m`` with m in [sqrt(1/2), sqrt(2)), and log m by the series of Sun's fdlibm (1993).
"""

import math

from rocksteady.kernels.elementary.bits import ROUND, ROUND_BITS, bits_of, float_of
from rocksteady.kernels.elementary.exponential import LN2_HIGH, LN2_LOW
from rocksteady.kernels.machine_code.compilation import compiled, inlined

ROOT_HALF_BITS = 0x3FE6A09E667F3BCD
"""Bits of sqrt(1/2)."""
LEAST_NORMAL = 2.0**-1022
TINY = 2.0**-54
LN2 = 0.6931471805599453
LOG2_DOUBT = 0.0861
"""What `low_log2` may be too small by."""


@inlined
def _parts(x: float) -> tuple[float, float]:
    """Return k and m of a normal number x = 2^k m."""
    bits = bits_of(x)
    k = (bits - ROOT_HALF_BITS) >> 52
    return float_of(k + ROUND_BITS) - ROUND, float_of(bits - (k << 52))


@inlined
def _sum(k: float, f: float, low: float) -> float:
    """Return k ln 2 + log(1 + f) + low, with 1 + f in [sqrt(1/2), sqrt(2))."""
    square = 0.5 * f * f
    s = f / (2.0 + f)
    z = s * s
    w = z * z
    series = w * (
        3.999999999940941908e-01 + w * (2.222219843214978396e-01 + w * 1.531383769920937332e-01)
    ) + z * (
        6.666666666666735130e-01
        + w
        * (2.857142874366239149e-01 + w * (1.818357216161805012e-01 + w * 1.479819860510658591e-01))
    )
    return k * LN2_HIGH - ((square - (s * (square + series) + (k * LN2_LOW + low))) - f)


@compiled
def log(x: float) -> float:
    """Return the natural logarithm."""
    x = float(x)
    if LEAST_NORMAL <= x < math.inf:
        k, m = _parts(x)
        return _sum(k, m - 1.0, 0.0)
    if x == 0.0:
        return -math.inf
    if x < 0.0:
        return math.nan
    if x < LEAST_NORMAL:
        k, m = _parts(x * 2.0**54)
        return _sum(k - 54.0, m - 1.0, 0.0)
    return x  # infinity or NaN


@inlined
def low_log2(x: float) -> float:
    """Return the logarithm to base 2 of x > 0 less `LOG2_DOUBT` at most; -1023 of 0.

    Between powers of two it is linear: the bits of a float are just that.
    """
    return bits_of(x) * 2.0**-52 - 1023.0


@compiled
def log1p(x: float) -> float:
    """Return log(1 + x)."""
    x = float(x)
    if abs(x) < TINY:
        return x
    if x <= -1.0:
        return -math.inf if x == -1.0 else math.nan
    if not x < math.inf:
        return x
    whole = 1.0 + x
    k, m = _parts(whole)
    if k == 0.0:
        return _sum(0.0, x, 0.0)
    lost = x - (whole - 1.0) if x < 2.0 else 1.0 - (whole - x)
    return _sum(k, m - 1.0, lost / whole)
