r"""Damped oscillators on a base that is linear between samples: their exact recurrence.

With ``u'' + 2 zeta w u' + w^2 u = -a``, the eigenvalue ``L = w (-zeta + i sqrt(1 - zeta^2))`` and
``wd = Im L``, the one complex number z of ``z' = L z - a`` holds the state: ``u = Im z/wd``, ``u' =
Im(L z)/wd`` and ``u'' + a = Im(L^2 z)/wd``.  For an acceleration that is linear between samples the
step from one to the next is exact,

    z_1 = e^(L h) z_0 - h ((phi_1 - phi_2) a_0 + phi_2 a_1),  phi_1 = (e^x - 1)/x,
    phi_2 = (e^x - 1 - x)/x^2,  x = L h,

Nigam and Jennings' recurrence with one complex number in place of a matrix.

All is computed with real numbers: a product of complex ones is rounded in one way on one processor
and in another on the next.
"""

import math
from typing import TYPE_CHECKING, Any, NamedTuple

from rocksteady.kernels.elementary.arrays import exp, sincos

if TYPE_CHECKING:
    from rocksteady.arrays import Floats

DEFAULT_DAMPING = 0.05
"""Over the critical one."""

SERIES_BELOW = 0.5
"""|x| below which phi_2 is summed: its closed form cancels."""
SERIES_TERMS = 16
"""0.5^16/18! is below 1e-20."""


class Parts(NamedTuple):
    """Real and imaginary part of a complex number, or of each of an array."""

    real: Any
    imag: Any

    def __add__(self, other: "Parts") -> "Parts":  # type: ignore[override]
        """Return the sum."""
        return Parts(self.real + other.real, self.imag + other.imag)

    def __sub__(self, other: "Parts") -> "Parts":
        """Return the difference."""
        return Parts(self.real - other.real, self.imag - other.imag)

    def __mul__(self, other: "Parts") -> "Parts":  # type: ignore[override]
        """Return the product."""
        return Parts(self.real * other.real - self.imag * other.imag, imaginary(self, other))

    def __truediv__(self, real: float) -> "Parts":
        """Return the quotient by a real number."""
        return Parts(self.real / real, self.imag / real)


ONE = Parts(1.0, 0.0)


def rate_of(frequency: float, damping: float) -> Parts:
    """Return L of a circular frequency and a damping below 1."""
    return Parts(-damping * frequency, math.sqrt(1.0 - damping * damping) * frequency)


def states(a: "Floats", h: float, rate: Parts) -> Parts:
    """Return z at each sample, begun at rest.

    Parameters
    ----------
    a
        Acceleration of the base, shape (samples,).
    h
        Time between two of them.
    rate
        L.
    """
    import numpy as np

    from rocksteady.kernels.linear.oscillator import fill_oscillator

    x, step = rate * Parts(h, 0.0), Parts(-h, 0.0)
    growth = grown(rate, h)
    if x.real * x.real + x.imag * x.imag < SERIES_BELOW * SERIES_BELOW:
        second = Parts(0.0, 0.0)
        for k in reversed(range(SERIES_TERMS)):
            second = x * second + Parts(1.0 / math.factorial(k + 2), 0.0)
        first = x * second + ONE
    else:
        first = (growth - ONE) * inverse(x)
        second = (first - ONE) * inverse(x)
    early, late = step * (first - second), step * second
    z = np.empty((2, len(a)))
    fill_oscillator(np.array(a), np.array([growth, early, late]), z)
    return Parts(*z)


def steady_line(constant: Any, slope: Any, rate: Parts) -> Parts:
    """Return z of the response to ``constant + slope t`` at t = 0 without what decays."""
    turned = inverse(rate)
    return Parts(constant + slope * turned.real, slope * turned.imag) * turned


def grown(rate: Parts, t: Any) -> Parts:
    """Return e^(L t) at a time or at each of an array of times."""
    size, (sine, cosine) = exp(rate.real * t), sincos(rate.imag * t)
    return Parts(size * cosine, size * sine)


def inverse(z: Parts) -> Parts:
    """Return 1/z."""
    square = z.real * z.real + z.imag * z.imag
    return Parts(z.real / square, -z.imag / square)


def imaginary(x: Parts, y: Parts) -> Any:
    """Return the imaginary part of a product."""
    return x.real * y.imag + x.imag * y.real
