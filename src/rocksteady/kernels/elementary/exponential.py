"""Exponential function, and the same less one.

``exp`` uses Tang's method: ``t = k ln 2/64 + r``, with 64 powers of 2^(1/64) in a table and a
polynomial of degree 5 in r.  ``expm1`` has no table: its polynomial of degree 12 serves
``t = k ln 2 + r``.
"""

import math

import numpy as np

from rocksteady.kernels.elementary.bits import (
    ROUND,
    ROUND_BITS,
    bits_of,
    float_of,
    power_of_two,
)
from rocksteady.kernels.machine_code.compilation import compiled, inlined

PARTS = 64
PER_STEP = 92.33248261689366  # 64 / ln 2
STEP_HIGH = 0.010830424667801708  # ln 2 / 64 to 28 bits: times a whole number below 2^25, exact
STEP_LOW = 2.8447437476627285e-11  # the rest
PER_LN2 = 1.4426950408889634
LN2_HIGH = 6.93147180369123816490e-01  # to 33 bits: times a whole number below 2^20, exact
LN2_LOW = 1.90821492927058770002e-10
NORMAL = 700.0  # e^-700, and what its last digits are made of, are normal numbers
HIGHEST = 711.0  # e^711 / 2 overflows
LOWEST = -746.0  # e^-746 rounds to 0
POSITIVE = (1 << 63) - 1  # bits but the sign: what is not in range, NaN too, stays a float
HALF_LN2 = 0.34657  # below ln 2 / 2


def _powers() -> list[float]:
    """Return 2^(j/64), rounded, and what is left of it over it, for each j in turn."""
    digits = 160
    root = 1 << (PARTS * digits + 1)
    for _ in range(6):  # of order 64
        root = math.isqrt(root)
    found = []
    power = 1 << digits
    for _ in range(PARTS):
        head = power / (1 << digits)  # whole numbers divide with one rounding
        rest = power - (int(head * 2.0**52) << (digits - 52))
        found += [head, rest / power]
        power = (power * root) >> digits
    return found


POWERS = np.array(_powers())


@inlined
def exp_near(t: float) -> float:
    """Return e^t for |t| <= 700, which is not checked."""
    shifted = t * PER_STEP + ROUND
    k = shifted - ROUND
    r = (t - k * STEP_HIGH) - k * STEP_LOW
    steps = bits_of(shifted) - ROUND_BITS
    j = 2 * (steps & (PARTS - 1))
    head = float_of((bits_of(POWERS[j]) + ((steps >> 6) << 52)) & POSITIVE)
    return head + head * _series(r, float(POWERS[j + 1]))


@inlined
def exp_clamped(t: float) -> float:
    """Return e^t for |t| <= 700, and e^700 or e^-700 beyond."""
    return exp_near(max(min(t, NORMAL), -NORMAL))


@inlined
def _series(r: float, rest: float) -> float:
    """Return e^r - 1 + rest for |r| <= ln 2 / 128; 4.4e-18 of it are left out."""
    z = r * r
    return (rest + r) + z * (
        (0.4999999999998501 + r * 0.16666666666664526)
        + z * (0.041666707476689775 + r * 0.00833333916333604)
    )


@compiled
def exp(t: float) -> float:
    """Return e^t."""
    t = float(t)
    if abs(t) <= NORMAL:
        return exp_near(t)
    return scaled_exp(t, 0.0)


@compiled
def scaled_exp(t: float, exponent: float) -> float:
    """Return 2^exponent e^t, also where that is infinite or subnormal; exponent is 0 or -1."""
    if math.isnan(t):
        return t
    t = min(max(t, LOWEST), HIGHEST)
    shifted = t * PER_STEP + ROUND
    k = shifted - ROUND
    r = (t - k * STEP_HIGH) - k * STEP_LOW
    steps = bits_of(shifted) - ROUND_BITS
    j = 2 * (steps & (PARTS - 1))
    head = float(POWERS[j])
    value = head + head * _series(r, float(POWERS[j + 1]))
    # Two factors: each is a normal number, and only the second product rounds.
    whole = (steps >> 6) + int(exponent)
    half = whole >> 1
    return (value * power_of_two(half)) * power_of_two(whole - half)


@inlined
def expm1_near(t: float) -> float:
    """Return e^t - 1 for |t| <= ln 2 / 2, which is not checked; it gives +0 for -0."""
    return t + _rest(t)


@inlined
def expm1_short(t: float) -> float:
    """Return e^t - 1 for t >= 0, within 2.2 ulp."""
    if t < HALF_LN2:
        return expm1_near(t)
    return exp_near(t) - 1.0 if t <= NORMAL else exp(t)


@inlined
def _rest(r: float) -> float:
    """Return e^r - 1 - r for |r| <= ln 2 / 2; 2.9e-19 are left out."""
    z = r * r
    z2 = z * z
    return z * (
        ((0.5 + r * 0.1666666666666667) + z * (0.04166666666666667 + r * 0.008333333333326136))
        + z2
        * (
            (0.0013888888888883748 + r * 0.00019841269874820627)
            + z * (2.4801587325547743e-05 + r * 2.7557255400206422e-06)
        )
        + (z2 * z2)
        * ((2.75572736431103e-07 + r * 2.5105217004720745e-08) + z * 2.0914686968086876e-09)
    )


@compiled
def expm1(t: float) -> float:
    """Return e^t - 1."""
    t = float(t)
    if abs(t) < HALF_LN2:
        return expm1_near(t) if t != 0.0 else t
    if math.isnan(t):
        return t
    x = min(max(t, -50.0), 710.0)
    shifted = x * PER_LN2 + ROUND
    k = shifted - ROUND
    high = x - k * LN2_HIGH
    low = k * LN2_LOW
    r = high - low
    lost = (high - r) - low
    # At half the scale, so that 2^1024 does not occur.
    scale = power_of_two(bits_of(shifted) - ROUND_BITS - 1)
    a = scale - 0.5
    b = scale * r
    s = a + b
    half = s + (((a - s) + b) + scale * (lost + lost * r + _rest(r)))
    return half + half
