r"""Damped oscillators under a record: the exact recurrence, and exact peaks between samples.

With ``u'' + 2 zeta w u' + w^2 u = -a``, the eigenvalue ``L = w (-zeta + i sqrt(1 - zeta^2))`` and
``wd = Im L``, the one complex number z of ``z' = L z - a`` holds the state: ``u = Im z/wd``, ``u' =
Im(L z)/wd`` and ``u'' + a = Im(L^2 z)/wd``.  For an acceleration that is linear between samples the
step from one to the next is exact,

    z_1 = e^(L h) z_0 - h ((phi_1 - phi_2) a_0 + phi_2 a_1),  phi_1 = (e^x - 1)/x,
    phi_2 = (e^x - 1 - x)/x^2,  x = L h,

Nigam and Jennings' recurrence with one complex number in place of a matrix: a filter of the first
order, which `scipy.signal.lfilter` runs.
"""

import cmath
import math

import numpy as np
from numpy.typing import NDArray

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
    rate = complex(-damping, math.sqrt(1.0 - damping * damping)) * frequency
    # Steps of less than half a damped period: each derivative then has one extremum at most in it.
    parts = int(rate.imag * dt / math.pi) + 1
    h = dt / parts
    a = acceleration
    if parts > 1:
        a = np.interp(np.arange((len(a) - 1) * parts + 1) / parts, np.arange(len(a)), a)
    z = _states(a, h, rate)
    powers = np.array([1.0, rate, rate * rate]) / rate.imag
    sampled = np.abs((powers[:, np.newaxis] * z).imag).max(axis=1)
    after = [_after(complex(power * z[-1]), rate) for power in powers]
    found: Floats = np.maximum(sampled, after)
    slope = np.diff(a) / h
    # Inside a sample z = swing e^(L t) + steady + slope t/L.
    steady = (a[:-1] + slope / rate) / rate
    swing = z[:-1] - steady
    reach = h * h * abs(rate * rate) * np.abs(swing)
    for kind, power in enumerate(powers):
        # No faster than at the sample's start by more than `reach`: most samples are passed over.
        start = (power * z[:-1]).imag
        speed = h * np.abs((power * rate * swing).imag + (power / rate).imag * slope)
        of = np.flatnonzero(np.abs(start) + speed + abs(power) * reach > found[kind])
        found[kind] = _between(
            power * swing[of],
            power * steady[of],
            (power / rate).imag * slope[of],
            rate,
            h,
            float(found[kind]),
        )
    return found


def _states(a: Floats, h: float, rate: complex) -> Complexes:
    """Return z at each sample, begun at rest."""
    from scipy.signal import lfilter

    x = rate * h
    growth = np.exp(x)
    if abs(x) < SERIES_BELOW:
        second = sum(x**k / math.factorial(k + 2) for k in range(SERIES_TERMS))
        first = 1.0 + x * second
    else:
        first = (growth - 1.0) / x
        second = (first - 1.0) / x
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
    t = (-cmath.phase(rate * z) % math.pi) / rate.imag
    return max(abs(z.imag), abs((z * cmath.exp(rate * t)).imag))


def _between(
    swing: Complexes, constant: Complexes, slope: Floats, rate: complex, h: float, best: float
) -> float:
    """Return the largest |Im(swing e^(L t) + constant) + slope t| of some samples, 0 < t < h.

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
    turn = np.minimum((-np.angle(rate * rate * swing) % math.pi) / rate.imag, h)

    def speed(t: Floats | float, of: NDArray[np.intp] | slice = slice(None)) -> Floats:
        moved: Floats = (rate * swing[of] * np.exp(rate * t)).imag + slope[of]
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
        values = (swing[of] * np.exp(rate * t) + constant[of]).imag + slope[of] * t
        best = max(best, float(np.abs(values).max()))
    return best
