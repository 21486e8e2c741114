"""Bits of floats, and what rounding leaves out of a product."""

import numpy as np

from rocksteady.kernels.machine_code.compilation import inlined

ROUND = 1.5 * 2.0**52
"""Added to a number below 2^51, it rounds to a whole number and leaves that in the last bits."""
ROUND_BITS = 0x4338000000000000
"""Bits of `ROUND`."""
EXPONENT_BIAS = 1023
MANTISSA_BITS = 52
SPLIT = 2.0**27 + 1.0


@inlined
def bits_of(x: float) -> int:
    """Return the 64 bits of a float as a signed whole number."""
    return int(np.float64(x).view(np.int64))


@inlined
def float_of(bits: int) -> float:
    """Return the float that has these bits."""
    return float(np.int64(bits).view(np.float64))


@inlined
def nearest_whole(x: float) -> float:
    """Return the whole number nearest to x; |x| below 2^51."""
    return (x + ROUND) - ROUND


@inlined
def power_of_two(exponent: int) -> float:
    """Return 2^exponent; the exponent lies in [-1022, 1023]."""
    return float_of((exponent + EXPONENT_BIAS) << MANTISSA_BITS)


@inlined
def lost_in_product(a: float, b: float, product: float) -> float:
    """Return a b less its rounded product, exactly.

    Dekker's method with Veltkamp's halves of 26 bits.  |a| and |b| are below 2^996, and the product
    is above 2^-969.
    """
    c = SPLIT * a
    a_high = c - (c - a)
    a_low = a - a_high
    c = SPLIT * b
    b_high = c - (c - b)
    b_low = b - b_high
    return ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low
