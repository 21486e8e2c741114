"""Reduction of large angles: their products with 2/pi, worked in whole numbers of 24 bits.

The method is Payne and Hanek's.  Of the digits of 2/pi those are left out that give multiples of
2^24 turns; the fraction of a quarter turn is kept to 192 bits, of which a float can cancel 62.
"""

import math

import numpy as np

from rocksteady.kernels.elementary.bits import bits_of, lost_in_product, power_of_two
from rocksteady.kernels.machine_code.compilation import compiled, inlined

LIMB = 24
MASK = (1 << LIMB) - 1
LIMBS = 52
KEPT = 8
"""Limbs of the fraction that are kept."""
PER_QUARTER_DIGITS = int(
    "a2f9836e4e441529fc2757d1f534ddc0db6295993c439041fe5163abdebbc561b7246e3a424dd2e006492eea09d19"
    "21cfe1deb1cb129a73ee88235f52ebb4484e99c7026b45f7e413991d639835339f49c845f8bbdf9283b1ff897ffde"
    "05980fef2f118b5a0a6d1f6d367ecf27cb09b74f463f669e5fea2d7527bac7ebe5f17b3d0739f78a5292ea6bfb5fb"
    "11f8d5d0856033046fc7b6babf0cfbc20",
    16,
)
"""2/pi times 2^1248."""
PER_QUARTER = np.array(
    [(PER_QUARTER_DIGITS >> LIMB * (LIMBS - 1 - i)) & MASK for i in range(LIMBS)], dtype=np.int64
)
QUARTER = 1.5707963267948966
QUARTER_LOW = 6.123233995736766e-17


@inlined
def _limb(i: int) -> int:
    """Return a limb of 2/pi, of which the first has number 0; those before it are 0."""
    return int(PER_QUARTER[i]) if i >= 0 else 0


@inlined
def _fraction(
    a0: int, a1: int, a2: int, a3: int, place: int, sign: float
) -> tuple[int, float, float]:
    """Return the whole part, the fraction and its tail of 2/pi times a number in four limbs.

    `place` is the place of the lowest limb.  Where `sign` is -1, the fraction is counted from the
    next whole number.
    """
    flip = 0 if sign > 0.0 else MASK
    carry = 0
    high = low = 0.0
    for k in range(KEPT, 0, -1):
        i = place - 1 + k
        carry += a0 * _limb(i) + a1 * _limb(i + 1) + a2 * _limb(i + 2) + a3 * _limb(i + 3)
        term = float((carry & MASK) ^ flip) * power_of_two(-LIMB * k)
        carry >>= LIMB
        total = term + high  # the terms so far are less than one unit of this one
        low += (term - total) + high
        high = total
    i = place - 1
    carry += a0 * _limb(i) + a1 * _limb(i + 1) + a2 * _limb(i + 2) + a3 * _limb(i + 3)
    whole = (carry & MASK) + (0 if sign > 0.0 else 1)
    return whole, sign * high, sign * low


@compiled
def reduced_far(angle: float) -> tuple[float, float, int]:
    """Return x, its tail and n with angle = x + tail + n pi/2, n modulo 4; |angle| >= 2e5."""
    if not abs(angle) < math.inf:
        return math.nan, 0.0, 0
    bits = bits_of(abs(angle))
    exponent = (bits >> 52) - 1075
    mantissa = (bits & ((1 << 52) - 1)) | (1 << 52)
    place = exponent // LIMB
    shift = exponent - LIMB * place
    carry = (mantissa & MASK) << shift
    a0 = carry & MASK
    carry = (carry >> LIMB) + (((mantissa >> LIMB) & MASK) << shift)
    a1 = carry & MASK
    carry = (carry >> LIMB) + ((mantissa >> (2 * LIMB)) << shift)
    a2 = carry & MASK
    a3 = carry >> LIMB
    n, high, low = _fraction(a0, a1, a2, a3, place, 1.0)
    if high >= 0.5:
        n, high, low = _fraction(a0, a1, a2, a3, place, -1.0)
    if angle < 0.0:
        n, high, low = -n, -high, -low
    x = high * QUARTER
    return x, lost_in_product(high, QUARTER, x) + (high * QUARTER_LOW + low * QUARTER), n & 3
