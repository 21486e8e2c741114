r"""Damped oscillators under a record: the exact recurrence, and exact peaks between samples.

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
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats
from rocksteady.kernels.elementary.arrays import atan2, exp, sincos
from rocksteady.kernels.linear.oscillator import fill_oscillator


class Parts(NamedTuple):
    """Real and imaginary part of a complex number, or of each of an array."""

    real: Any
    imag: Any


SERIES_BELOW = 0.5
"""|x| below which phi_2 is summed: its closed form cancels."""
SERIES_TERMS = 16
"""0.5^16/18! is below 1e-20."""
HALVES: Floats = np.ldexp(1.0, -np.arange(1, 31))[:, np.newaxis]
"""Parts of the bracket of a peak's time; a peak is flat: half the digits of a double suffice."""


def peaks(acceleration: Floats, dt: float, frequency: float, damping: float) -> Floats:
    """Return the largest absolute displacement, velocity and total acceleration of an oscillator.

    They are exact for an acceleration that is linear between its samples and 0 after the last: at a
    sample, inside one, or while the oscillator swings on afterwards.

    Parameters
    ----------
    acceleration
        Acceleration of the ground, shape (samples,).
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
    rate = Parts(-damping * frequency, math.sqrt(1.0 - damping * damping) * frequency)
    # Steps of less than half a damped period: each derivative then has one extremum at most in it.
    parts = int(rate.imag * dt / math.pi) + 1
    h = dt / parts
    a = acceleration
    if parts > 1:
        within = np.diff(a)[:, np.newaxis] * (np.arange(parts) / parts)
        a = np.append(a[:-1, np.newaxis] + within, a[-1])
    z = _states(a, h, rate)
    # 1/(wd L), 1/wd, L/wd and L^2/wd: what each kind is made with, after what its slope is.
    inverse = _inverse(rate)
    kinds = (inverse, Parts(1.0, 0.0), rate, _times(rate, rate))
    powers = [Parts(kind.real / rate.imag, kind.imag / rate.imag) for kind in kinds]
    slope = np.diff(a) / h
    # Inside a sample z = swing e^(L t) + steady + slope t/L.
    steady = _times(Parts(a[:-1] + slope * inverse.real, slope * inverse.imag), inverse)
    swing = Parts(z.real[:-1] - steady.real, z.imag[:-1] - steady.imag)
    reach = h * h * frequency * frequency * np.sqrt(np.square(swing.real) + np.square(swing.imag))
    largest = np.empty(3)
    for kind, (before, power) in enumerate(pairwise(powers)):
        course = _imaginary(power, z)
        last = _times(power, Parts(float(z.real[-1]), float(z.imag[-1])))
        best = max(float(np.abs(course).max()), _after(last, rate))
        # No faster than at the sample's start by more than `reach`: most samples are passed over.
        speed = h * np.abs(_imaginary(_times(power, rate), swing) + before.imag * slope)
        size = math.sqrt(power.real * power.real + power.imag * power.imag)
        of = np.flatnonzero(np.abs(course[:-1]) + speed + size * reach > best)
        constant = _imaginary(power, _some(steady, of))
        inside = _times(power, _some(swing, of))
        largest[kind] = _between(inside, constant, before.imag * slope[of], rate, h, best)
    return largest


def _states(a: Floats, h: float, rate: Parts) -> Parts:
    """Return z at each sample, begun at rest."""
    x = Parts(rate.real * h, rate.imag * h)
    growth = _grown(rate, h)
    if x.real * x.real + x.imag * x.imag < SERIES_BELOW * SERIES_BELOW:
        second = Parts(0.0, 0.0)
        for k in reversed(range(SERIES_TERMS)):
            second = _less(_times(x, second), -1.0 / math.factorial(k + 2))
        first = _less(_times(x, second), -1.0)
    else:
        first = _times(_less(growth, 1.0), _inverse(x))
        second = _times(_less(first, 1.0), _inverse(x))
    early = Parts(-h * (first.real - second.real), -h * (first.imag - second.imag))
    late = Parts(-h * second.real, -h * second.imag)
    z = np.empty((2, len(a)))
    fill_oscillator(np.array(a), np.array([growth, early, late]), z)
    return Parts(*z)


def _after(z: Parts, rate: Parts) -> float:
    """Return the largest |Im(z e^(L t))| for t >= 0: at once, or at its first extremum."""
    t = (-_phase(_times(rate, z)) % math.pi) / rate.imag
    return float(max(abs(z.imag), abs(_imaginary(z, _grown(rate, t)))))


def _between(
    swing: Parts, constant: Floats, slope: Floats, rate: Parts, h: float, best: float
) -> float:
    """Return the largest |Im(swing e^(L t)) + constant + slope t| of some samples, 0 < t < h.

    Parameters
    ----------
    swing, constant, slope
        Coefficients of each sample.
    rate, h
        L, and the length of a sample, below half a damped period.
    best
        The largest value that is known; it is returned where none is larger.
    """
    # The derivative turns once at most inside a sample, at a phase that is known.
    moving = _times(rate, swing)
    turn = np.minimum((-_phase(_times(rate, moving)) % math.pi) / rate.imag, h)
    turned = _times(moving, _grown(rate, turn))
    ends = (moving.imag, turned.imag, _imaginary(moving, _grown(rate, h)))
    start, middle, end = (imaginary + slope for imaginary in ends)
    for low, width, at, here, last in (
        (np.zeros(len(turn)), turn, moving, start, middle),
        (turn, h - turn, turned, middle, end),
    ):
        of = np.flatnonzero(here * last < 0.0)
        if len(of) == 0:
            continue
        t, left, rising = low[of], _some(at, of), here[of] > 0.0
        steps = width[of] * HALVES
        for step, real, imaginary in zip(steps, *_grown(rate, steps), strict=True):
            later = _times(left, Parts(real, imaginary))
            before = (later.imag + slope[of] > 0.0) == rising
            t = np.where(before, t + step, t)
            left = Parts(*(np.where(before, *pair) for pair in zip(later, left, strict=True)))
        values = _imaginary(_some(swing, of), _grown(rate, t)) + constant[of] + slope[of] * t
        best = max(best, float(np.abs(values).max()))
    return best


def _grown(rate: Parts, t: Any) -> Parts:
    """Return e^(L t) at a time or at each of an array of times."""
    size, (sine, cosine) = exp(rate.real * t), sincos(rate.imag * t)
    return Parts(size * cosine, size * sine)


def _phase(z: Parts) -> Any:
    return atan2(z.imag, z.real)


def _inverse(z: Parts) -> Parts:
    square = z.real * z.real + z.imag * z.imag
    return Parts(z.real / square, -z.imag / square)


def _some(z: Parts, of: NDArray[np.intp]) -> Parts:
    return Parts(z.real[of], z.imag[of])


def _less(z: Parts, real: float) -> Parts:
    return Parts(z.real - real, z.imag)


def _times(x: Parts, y: Parts) -> Parts:
    return Parts(x.real * y.real - x.imag * y.imag, _imaginary(x, y))


def _imaginary(x: Parts, y: Parts) -> Any:
    """Return the imaginary part of a product."""
    return x.real * y.imag + x.imag * y.real
