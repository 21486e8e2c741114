"""Exponentials and small turns without branches, for vectorised loops over lanes."""

from rocksteady.kernels.elementary.bits import EXPONENT_BIAS, ROUND, bits_of, float_of
from rocksteady.kernels.elementary.exponential import LN2_HIGH, LN2_LOW, PER_LN2
from rocksteady.kernels.machine_code.compilation import inlined

BIASED = ROUND + EXPONENT_BIAS
"""Leaves the bits of a power of two in the place of an exponent, once they are shifted."""
MASK = (1 << 11) - 1


@inlined
def growth_and_decay(t: float) -> tuple[float, float]:
    """Return e^t - 1 and 1 - e^-t, both without cancellation.

    With ``t = k ln 2 + x`` and the even ``R = x coth(x/2)``, whose coefficients are those of Sun's
    fdlibm, ``e^x = (R + x)/(R - x)``: one division serves both signs.
    """
    shifted = t * PER_LN2 + BIASED
    k = shifted - BIASED
    x = (t - k * LN2_HIGH) - k * LN2_LOW
    z = x * x
    z2 = z * z
    R = (2.0 + z * 1.66666666666666019037e-01) + z2 * (
        (-2.77777777770155933842e-03 + z * 6.61375632143793436117e-05)
        + z2 * (-1.65339022054652515390e-06 + z * 4.13813679705723846039e-08)
    )
    common = (x + x) / (R * R - z)
    up = float_of((bits_of(shifted) & MASK) << 52)
    down = float_of((bits_of(BIASED - k) & MASK) << 52)
    return up * (common * (R + x)) + (up - 1.0), down * (common * (R - x)) + (1.0 - down)


@inlined
def turned_by(sine: float, cosine: float, turn: float) -> tuple[float, float]:
    """Turn a sine and cosine by an angle of at most 0.03."""
    square = turn * turn
    small = turn - turn * square * (
        (1.0 / 6.0) - square * ((1.0 / 120.0) - square * (1.0 / 5040.0))
    )
    loss = square * (0.5 - square * ((1.0 / 24.0) - square * (1.0 / 720.0)))
    return sine + (cosine * small - sine * loss), cosine - (sine * small + cosine * loss)
