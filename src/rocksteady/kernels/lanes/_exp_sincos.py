"""Branch-free exponentials, sines and cosines, for vectorised loops over lanes."""

import numpy as np

from rocksteady.kernels.core.sincos import QUARTER_HIGH, QUARTER_LOW, QUARTERS
from rocksteady.kernels.machine_code.compilation import fused_inlined

# Adding 1.5 2^52 rounds to a whole number and leaves it in the last bits.
ROUND = 6755399441055744.0
BIASED = ROUND + 1023.0
PER_LN2 = 1.4426950408889634
LN2_HIGH = 6.93147180369123816490e-01
LN2_LOW = 1.90821492927058770002e-10


@fused_inlined
def nearest_whole(x: float) -> float:
    """Return the whole number nearest to x; |x| below 2^51."""
    return (x + ROUND) - ROUND


@fused_inlined
def growth_and_decay(t: float) -> tuple[float, float]:
    """Return e^t - 1 and 1 - e^-t, both without cancellation.

    With ``t = k ln 2 + x`` and the even ``R = x coth(x/2)``, whose coefficients are those of Sun's
    fdlibm, ``e^x = (R + x)/(R - x)``: one division serves both signs.
    """
    shifted = np.float64(t * PER_LN2 + BIASED)
    k = shifted - BIASED
    x = (t - k * LN2_HIGH) - k * LN2_LOW
    z = x * x
    z2 = z * z
    R = (2.0 + z * 1.66666666666666019037e-01) + z2 * (
        (-2.77777777770155933842e-03 + z * 6.61375632143793436117e-05)
        + z2 * (-1.65339022054652515390e-06 + z * 4.13813679705723846039e-08)
    )
    common = (x + x) / (R * R - z)
    up = np.int64(shifted.view(np.int64) << 52).view(np.float64)
    mirrored = np.float64((BIASED + 0.0) - k)
    down = np.int64(mirrored.view(np.int64) << 52).view(np.float64)
    return up * (common * (R + x)) + (up - 1.0), down * (common * (R - x)) + (1.0 - down)


@fused_inlined
def sine_cosine(angle: float) -> tuple[float, float]:
    """Return both, as `rocksteady.kernels.core.sincos.sine_and_cosine` but with selects alone."""
    shifted = np.float64(angle * QUARTERS + ROUND)
    quarter = shifted - ROUND
    x = (angle - quarter * QUARTER_HIGH) - quarter * QUARTER_LOW
    z = x * x
    z2 = z * z
    z4 = z2 * z2
    sine = x + x * z * (
        (-1.66666666666666324348e-01 + z * 8.33333333332248946124e-03)
        + z2 * (-1.98412698298579493134e-04 + z * 2.75573137070700676789e-06)
        + z4 * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)
    )
    cosine = 1.0 - (
        0.5 * z
        - z2
        * (
            (4.16666666666666019037e-02 + z * -1.38888888888741095749e-03)
            + z2 * (2.48015872894767294178e-05 + z * -2.75573143513906633035e-07)
            + z4 * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11)
        )
    )
    turns = shifted.view(np.int64)
    odd = (turns & 1) != 0
    one = cosine if odd else sine
    other = sine if odd else cosine
    return (
        -one if (turns & 2) != 0 else one,
        -other if ((turns + 1) & 2) != 0 else other,
    )


@fused_inlined
def turned_by(sine: float, cosine: float, turn: float) -> tuple[float, float]:
    """Turn a sine and cosine by an angle of at most 0.03."""
    square = turn * turn
    small = turn - turn * square * (
        (1.0 / 6.0) - square * ((1.0 / 120.0) - square * (1.0 / 5040.0))
    )
    loss = square * (0.5 - square * ((1.0 / 24.0) - square * (1.0 / 720.0)))
    return sine + (cosine * small - sine * loss), cosine - (sine * small + cosine * loss)
