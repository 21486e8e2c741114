"""Exact peaks of damped oscillators under a record, between samples too.

The state of each is the complex number z of `rocksteady.model.motions.oscillator`.
"""

import math
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats
from rocksteady.kernels.elementary.arrays import atan2
from rocksteady.model.motions.oscillator import (
    ONE,
    Parts,
    grown,
    imaginary,
    inverse,
    rate_of,
    states,
    steady_line,
)

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
    rate = rate_of(frequency, damping)
    # Steps of less than half a damped period: each derivative then has one extremum at most in it.
    parts = int(rate.imag * dt / math.pi) + 1
    h = dt / parts
    a = acceleration
    if parts > 1:
        within = np.diff(a)[:, np.newaxis] * (np.arange(parts) / parts)
        a = np.append(a[:-1, np.newaxis] + within, a[-1])
    z = states(a, h, rate)
    # 1/(wd L), 1/wd, L/wd and L^2/wd: what each kind is made with, after what its slope is.
    kinds = (inverse(rate), ONE, rate, rate * rate)
    powers = [kind / rate.imag for kind in kinds]
    slope = np.diff(a) / h
    # Inside a sample z = swing e^(L t) + steady + slope t/L.
    steady = steady_line(a[:-1], slope, rate)
    swing = Parts(z.real[:-1], z.imag[:-1]) - steady
    reach = h * h * frequency * frequency * np.sqrt(np.square(swing.real) + np.square(swing.imag))
    largest = np.empty(3)
    for kind, (before, power) in enumerate(pairwise(powers)):
        course = imaginary(power, z)
        last = power * Parts(float(z.real[-1]), float(z.imag[-1]))
        best = max(float(np.abs(course).max()), _after(last, rate))
        # No faster than at the sample's start by more than `reach`: most samples are passed over.
        speed = h * np.abs(imaginary(power * rate, swing) + before.imag * slope)
        size = math.sqrt(power.real * power.real + power.imag * power.imag)
        of = np.flatnonzero(np.abs(course[:-1]) + speed + size * reach > best)
        constant = imaginary(power, _some(steady, of))
        inside = power * _some(swing, of)
        largest[kind] = _between(inside, constant, before.imag * slope[of], rate, h, best)
    return largest


def _after(z: Parts, rate: Parts) -> float:
    """Return the largest |Im(z e^(L t))| for t >= 0: at once, or at its first extremum."""
    t = (-_phase(rate * z) % math.pi) / rate.imag
    return float(max(abs(z.imag), abs(imaginary(z, grown(rate, t)))))


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
    moving = rate * swing
    turn = np.minimum((-_phase(rate * moving) % math.pi) / rate.imag, h)
    turned = moving * grown(rate, turn)
    ends = (moving.imag, turned.imag, imaginary(moving, grown(rate, h)))
    start, middle, end = (each + slope for each in ends)
    for low, width, at, here, last in (
        (np.zeros(len(turn)), turn, moving, start, middle),
        (turn, h - turn, turned, middle, end),
    ):
        of = np.flatnonzero(here * last < 0.0)
        if len(of) == 0:
            continue
        t, left, rising = low[of], _some(at, of), here[of] > 0.0
        steps = width[of] * HALVES
        for step, real, imag in zip(steps, *grown(rate, steps), strict=True):
            later = left * Parts(real, imag)
            before = (later.imag + slope[of] > 0.0) == rising
            t = np.where(before, t + step, t)
            left = Parts(*(np.where(before, *pair) for pair in zip(later, left, strict=True)))
        values = imaginary(_some(swing, of), grown(rate, t)) + constant[of] + slope[of] * t
        best = max(best, float(np.abs(values).max()))
    return best


def _phase(z: Parts) -> Any:
    return atan2(z.imag, z.real)


def _some(z: Parts, of: NDArray[np.intp]) -> Parts:
    return Parts(z.real[of], z.imag[of])
