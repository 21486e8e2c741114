"""Damped oscillators: their states under a record, sample by sample."""

from rocksteady.kernels.machine_code.compilation import compiled
from rocksteady.kernels.machine_code.types import Floats1, Floats2


@compiled
def fill_oscillator(acceleration: Floats1, step: Floats2, out: Floats2) -> None:
    """Fill the states ``z_i = g z_(i-1) + b a_(i-1) + c a_i`` of complex numbers, from rest.

    Parameters
    ----------
    acceleration
        a, shape (samples,).
    step
        Real and imaginary parts of g, b and c, shape (3, 2).
    out
        Real and imaginary parts of z, shape (2, samples).
    """
    real = imaginary = 0.0
    out[0, 0] = out[1, 0] = 0.0
    for i in range(1, acceleration.size):
        before, here = acceleration[i - 1], acceleration[i]
        real, imaginary = (
            (real * step[0, 0] - imaginary * step[0, 1])
            + (before * step[1, 0] + here * step[2, 0]),
            (real * step[0, 1] + imaginary * step[0, 0])
            + (before * step[1, 1] + here * step[2, 1]),
        )
        out[0, i], out[1, i] = real, imaginary
