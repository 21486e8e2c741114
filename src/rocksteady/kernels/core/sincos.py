"""Inlined sine and cosine of one angle, otherwise the dominant cost of a march.

The nearest multiple of pi/2 is subtracted in two parts, the first of which has so few digits that
its multiples up to 2^20 are exact; polynomials do the rest, with the coefficients of Sun's fdlibm
(1993).  Up to angles of 10^6 both results are within 1.5e-16 of the truth, less than the rounding
of a phase; beyond, within the rounding of the angle.
"""

import numpy as np

from rocksteady.kernels.machine_code.compilation import inlined

QUARTERS = 0.6366197723675814  # 2 / pi
QUARTER_HIGH = 1.57079632673412561417  # the first 33 bits of pi/2 ...
QUARTER_LOW = 6.07710050650619224932e-11  # ... and the rest


@inlined
def sine_and_cosine(angle: float) -> tuple[float, float]:
    """Return both."""
    # np.floor stays a float; math.floor would go through an integer and back.
    quarter = float(np.floor(angle * QUARTERS + 0.5))
    x = (angle - quarter * QUARTER_HIGH) - quarter * QUARTER_LOW
    # Polynomials in pairs of terms: the pairs do not wait for each other.
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
    turns = int(quarter)
    if turns & 1:
        sine, cosine = cosine, -sine
    if turns & 2:
        sine, cosine = -sine, -cosine
    return sine, cosine
