r"""Damped oscillators under a record: the exact recurrence, and exact peaks between samples.

With ``u'' + 2 zeta w u' + w^2 u = -a``, the eigenvalue ``L = w (-zeta + i sqrt(1 - zeta^2))`` and
``wd = Im L``, the one complex number z of ``z' = L z - a`` holds the state: ``u = Im z/wd``, ``u' =
Im(L z)/wd`` and ``u'' + a = Im(L^2 z)/wd``.  For an acceleration that is linear between samples the
step from one to the next is exact,

    z_1 = e^(L h) z_0 - h ((phi_1 - phi_2) a_0 + phi_2 a_1),  phi_1 = (e^x - 1)/x,
    phi_2 = (e^x - 1 - x)/x^2,  x = L h,

Nigam and Jennings' recurrence with one complex number in place of a matrix: a filter of the first
order, which `scipy.signal.lfilter` runs.

All but the filter is computed with real numbers: a product of complex ones is rounded in one way on
one processor and in another on the next.
"""

import math
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.kernels.elementary.arrays import atan2, exp, sincos

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]

SERIES_BELOW = 0.5
"""|x| below which phi_2 is summed: its closed form cancels."""
SERIES_TERMS = 16
"""0.5^16/18! is below 1e-20."""
HALVINGS = 30
"""Of the bracket of a peak's time; a peak is flat, so that half the digits of a double suffice."""


def peaks(acceleration: Floats, dt: float, frequency: float, damping: float) -> Floats:
    """Return the largest absolute displacement, velocity and total acceleration of an oscillator.

    They are exact for an acceleration that is linear between its samples and 0 after the last: at a
    sample, inside one, or while the oscillator swings on afterwards.

    Parameters
    ----------
    acceleration
        Of the ground, shape (samples,).
    dt
        Time between two of them.
    frequency
        w, circular, undamped; in the inverse of the unit of `dt`.
    damping
        zeta, in [0, 1).

    Returns
    -------
    ndarray, shape (3,)
        Of u and u' relative to the ground, and of u'' + a.
    """
    rate = complex(-damping * frequency, math.sqrt(1.0 - damping * damping) * frequency)
    # Steps of less than half a damped period: each derivative then has one extremum at most in it.
    parts = int(rate.imag * dt / math.pi) + 1
    h = dt / parts
    a = acceleration
    if parts > 1:
        a = np.interp(np.arange((len(a) - 1) * parts + 1) / parts, np.arange(len(a)), a)
    z = _states(a, h, rate)
    # 1/(wd L), 1/wd, L/wd and L^2/wd: what each kind is made with, after what its slope is.
    inverse = _inverse(rate)
    powers = [part / rate.imag for part in (inverse, complex(1.0), rate, _times(rate, rate))]
    slope = np.diff(a) / h
    # Inside a sample z = swing e^(L t) + steady + slope t/L.
    steady = _times(_complex(a[:-1] + slope * inverse.real, slope * inverse.imag), inverse)
    swing = z[:-1] - steady
    reach = h * h * frequency * frequency * np.sqrt(np.square(swing.real) + np.square(swing.imag))
    found = np.empty(3)
    for kind, (before, power) in enumerate(pairwise(powers)):
        course = _times(power, z)
        best = max(float(np.abs(course.imag).max()), _after(complex(course[-1]), rate))
        # No faster than at the sample's start by more than `reach`: most samples are passed over.
        moving = _times(power, swing)
        speed = h * np.abs(_times(rate, moving).imag + before.imag * slope)
        size = math.sqrt(power.real * power.real + power.imag * power.imag)
        of = np.flatnonzero(np.abs(course.imag[:-1]) + speed + size * reach > best)
        constant = _times(power, steady[of]).imag
        found[kind] = _between(moving[of], constant, before.imag * slope[of], rate, h, best)
    return found


def _states(a: Floats, h: float, rate: complex) -> Complexes:
    """Return z at each sample, begun at rest."""
    from scipy.signal import lfilter

    x = rate * h
    growth = _grown(rate, h)
    inverse = _inverse(x)
    if x.real * x.real + x.imag * x.imag < SERIES_BELOW * SERIES_BELOW:
        second = 0j
        for k in reversed(range(SERIES_TERMS)):
            second = _times(x, second) + 1.0 / math.factorial(k + 2)
        first = 1.0 + _times(x, second)
    else:
        first = _times(growth - 1.0, inverse)
        second = _times(first - 1.0, inverse)
    # The filter's own start would feel the first sample as if one of 0 had come before it.
    driven = lfilter(
        [-h * second, -h * (first - second)],
        [1.0, -growth],
        a.astype(np.complex128),
        zi=np.array([h * second * a[0]]),
    )[0]
    return np.asarray(driven, dtype=np.complex128)


def _after(z: complex, rate: complex) -> float:
    """Return the largest |Im(z e^(L t))| for t >= 0: at once, or at its first extremum."""
    t = (-_phase(_times(rate, z)) % math.pi) / rate.imag
    later: complex = _times(z, _grown(rate, t))
    return max(abs(z.imag), abs(later.imag))


def _between(
    swing: Complexes, constant: Floats, slope: Floats, rate: complex, h: float, best: float
) -> float:
    """Return the largest |Im(swing e^(L t)) + constant + slope t| of some samples, 0 < t < h.

    Parameters
    ----------
    swing, constant, slope
        Of each sample.
    rate, h
        L, and the length of a sample, below half a damped period.
    best
        The largest value that is known; it is returned where none is larger.
    """
    # The derivative turns once at most inside a sample, at a phase that is known.
    moving = _times(rate, swing)
    turn = np.minimum((-_phase(_times(rate, moving)) % math.pi) / rate.imag, h)

    def speed(t: Floats | float, of: NDArray[np.intp] | slice = slice(None)) -> Floats:
        moved: Floats = _times(moving[of], _grown(rate, t)).imag + slope[of]
        return moved

    ends = [speed(0.0), speed(turn), speed(h)]
    for low, high, here, there in (
        (np.zeros(len(turn)), turn, ends[0], ends[1]),
        (turn, np.full(len(turn), h), ends[1], ends[2]),
    ):
        of = np.flatnonzero(here * there < 0.0)
        if len(of) == 0:
            continue
        left, right, sign = low[of], high[of], np.sign(here[of])
        for _ in range(HALVINGS):
            t = 0.5 * (left + right)
            before = np.sign(speed(t, of)) == sign
            left, right = np.where(before, t, left), np.where(before, right, t)
        t = 0.5 * (left + right)
        values = _times(swing[of], _grown(rate, t)).imag + constant[of] + slope[of] * t
        best = max(best, float(np.abs(values).max()))
    return best


def _grown(rate: complex, t: Any) -> Any:
    """Return e^(L t) at a time or at each of an array of times."""
    size, (sine, cosine) = exp(rate.real * t), sincos(rate.imag * t)
    return _complex(size * cosine, size * sine)


def _phase(z: Any) -> Any:
    """Return the angle of a complex number or of each of an array."""
    return atan2(z.imag, z.real)


def _inverse(z: complex) -> complex:
    square = z.real * z.real + z.imag * z.imag
    return complex(z.real / square, -z.imag / square)


def _times(x: Any, y: Any) -> Any:
    """Return a product of complex numbers, or of arrays of them."""
    return _complex(x.real * y.real - x.imag * y.imag, x.real * y.imag + x.imag * y.real)


def _complex(real: Any, imaginary: Any) -> Any:
    """Return complex numbers with these parts, or an array of them."""
    if isinstance(real, float):
        return complex(real, imaginary)
    z = np.empty(real.shape, dtype=np.complex128)
    z.real, z.imag = real, imaginary
    return z
