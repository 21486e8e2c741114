"""Inverse circular functions, with the polynomials of Sun's fdlibm (1993)."""

import math

from rocksteady.kernels.elementary.bits import bits_of, float_of, lost_in_product
from rocksteady.kernels.machine_code.compilation import compiled, inlined

TAN_EIGHTH = 0.4142135623730951  # tan(pi/8)
EIGHTH, EIGHTH_LOW = 0.7853981633974483, 3.061616997868383e-17  # pi/4 and its tail
QUARTER, QUARTER_LOW = 1.5707963267948966, 6.123233995736766e-17  # pi/2
HALF, HALF_LOW = 3.141592653589793, 1.2246467991473532e-16  # pi
FLAT = 2.0**-30
LARGE, SHRINK = 2.0**500, 2.0**-600
SMALL, GROW = 2.0**-400, 2.0**600
HIGH_WORD = -(1 << 32)
"""Mask of the first 32 bits."""


@inlined
def _atan_loss(q: float) -> float:
    """Return (q - atan q)/q for |q| <= 7/16."""
    z = q * q
    w = z * z
    return z * (
        3.33333333333329318027e-01
        + w
        * (
            1.42857142725034663711e-01
            + w
            * (
                9.09088713343650656196e-02
                + w
                * (
                    6.66107313738753120669e-02
                    + w * (4.97687799461593236017e-02 + w * 1.62858201153657823623e-02)
                )
            )
        )
    ) + w * (
        -1.99999999998764832476e-01
        + w
        * (
            -1.11111104054623557880e-01
            + w
            * (
                -7.69187620504482999495e-02
                + w * (-5.83357013379057348645e-02 + w * -3.65315727442169155270e-02)
            )
        )
    )


@compiled
def atan2(y: float, x: float) -> float:
    """Return the angle of the point (x, y), in [-pi, pi]."""
    y, x = float(y), float(x)
    if math.isnan(y) or math.isnan(x):
        return math.nan
    less, more = abs(y), abs(x)
    steep = less > more
    if steep:
        less, more = more, less
    if more == math.inf:
        less, more = (1.0 if less == math.inf else 0.0), 1.0
    elif more == 0.0:
        more = 1.0
    high = low = 0.0  # the angle of the octant, to which the arc of the quotient is added
    if less <= FLAT * more:
        quotient = less / more
        rest = 0.0
    else:
        # Neither the products nor what they lose may leave the range of normal numbers.
        scale = SHRINK if more > LARGE else (GROW if more < SMALL else 1.0)
        less *= scale
        more *= scale
        numerator, denominator = less, more
        lost = gone = 0.0
        if less > TAN_EIGHTH * more:
            # atan(a/b) = pi/4 + atan((a - b)/(a + b))
            numerator, denominator = less - more, less + more
            back = numerator - less
            lost = (less - (numerator - back)) - (more + back)
            gone = less - (denominator - more)
            high, low = EIGHTH, EIGHTH_LOW
        quotient = numerator / denominator
        product = quotient * denominator
        left = (numerator - product) - lost_in_product(quotient, denominator, product)
        rest = (left + (lost - quotient * gone)) / denominator
        rest = rest - rest * quotient * quotient - quotient * _atan_loss(quotient)
    if steep:
        high, low, quotient, rest = QUARTER - high, QUARTER_LOW - low, -quotient, -rest
    if math.copysign(1.0, x) < 0.0:
        high, low, quotient, rest = HALF - high, HALF_LOW - low, -quotient, -rest
    total = high + quotient
    back = total - high
    lost = (high - (total - back)) + (quotient - back)
    return math.copysign(total + (lost + (low + rest)), y)


@compiled
def atan(x: float) -> float:
    """Return the angle in [-pi/2, pi/2] whose tangent is x."""
    return atan2(x, 1.0)


@inlined
def _asin_gain(z: float) -> float:
    """Return (asin x - x)/x for z = x^2 <= 1/4."""
    p = z * (
        1.66666666666666657415e-01
        + z
        * (
            -3.25565818622400915405e-01
            + z
            * (
                2.01212532134862925881e-01
                + z
                * (
                    -4.00555345006794114027e-02
                    + z * (7.91534994289814532176e-04 + z * 3.47933107596021167570e-05)
                )
            )
        )
    )
    q = 1.0 + z * (
        -2.40339491173441421878e00
        + z
        * (
            2.02094576023350569471e00
            + z * (-6.88283971605453293030e-01 + z * 7.70381505559019352791e-02)
        )
    )
    return p / q


@compiled
def asin(x: float) -> float:
    """Return the angle in [-pi/2, pi/2] whose sine is x."""
    x = float(x)
    size = abs(x)
    if size <= 0.5:
        return x + x * _asin_gain(x * x) if size > 2.0**-27 else x
    if not size < 1.0:
        return math.copysign(QUARTER, x) if size == 1.0 else math.nan
    z = 0.5 * (1.0 - size)
    root = math.sqrt(z)
    gain = _asin_gain(z)
    head = float_of(bits_of(root) & HIGH_WORD)
    rest = (z - head * head) / (root + head)  # of the root
    low = 2.0 * (root * gain) - (QUARTER_LOW - 2.0 * rest)
    return math.copysign(EIGHTH - (low - (EIGHTH - 2.0 * head)), x)


@compiled
def acos(x: float) -> float:
    """Return the angle in [0, pi] whose cosine is x."""
    x = float(x)
    size = abs(x)
    if size <= 0.5:
        return QUARTER - (x - (QUARTER_LOW - x * _asin_gain(x * x)))
    if not size < 1.0:
        if size == 1.0:
            return 0.0 if x > 0.0 else HALF
        return math.nan
    z = 0.5 * (1.0 - size)
    root = math.sqrt(z)
    rest = _asin_gain(z) * root
    if x < 0.0:
        return 2.0 * (QUARTER - (root + (rest - QUARTER_LOW)))
    head = float_of(bits_of(root) & HIGH_WORD)
    return 2.0 * (head + (rest + (z - head * head) / (root + head)))
