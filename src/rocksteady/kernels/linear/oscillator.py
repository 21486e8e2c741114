"""Damped oscillators: their states under a record, sample by sample, and their largest motion.

The complex numbers are those of `rocksteady.model.motions.oscillator`, in real and imaginary parts.
SciPy's filters are compiled with fused products on some processors, and have other last digits.
"""

import math

from rocksteady.kernels.elementary.circular import sincos
from rocksteady.kernels.elementary.exponential import exp
from rocksteady.kernels.elementary.inverse import atan2
from rocksteady.kernels.machine_code.compilation import compiled, inlined
from rocksteady.kernels.machine_code.types import Floats1, Floats2

Complex = tuple[float, float]
HALVINGS = 30
"""Of the bracket of a peak's time; a peak is flat: half the digits of a double suffice."""


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


@compiled
def fill_largest(
    acceleration: Floats1, states: Floats2, h: float, rate: Complex, largest: Floats1
) -> None:
    """Fill the largest |u|, |u'| and |u'' + a| of an oscillator: Im(L^k z)/wd for k = 0, 1, 2.

    They are exact for an acceleration that is linear between its samples and 0 after the last: at a
    sample, inside one, or while the oscillator swings on afterwards.

    Parameters
    ----------
    acceleration
        a of the base, shape (samples,).
    states
        Real and imaginary parts of z at the samples, shape (2, samples).
    h
        Time between two of them, below half a damped period.
    rate
        L.
    largest
        Shape (3,).
    """
    last, square = acceleration.size - 1, rate[0] * rate[0] + rate[1] * rate[1]
    inverse = (rate[0] / square, -rate[1] / square)
    before = (inverse[0] / rate[1], inverse[1] / rate[1])
    for kind in range(3):
        power = product(before, rate)
        best = 0.0
        for i in range(last + 1):
            best = max(best, abs(imaginary(power, (states[0, i], states[1, i]))))
        here = product(power, (states[0, last], states[1, last]))
        best = max(best, abs(imaginary(here, grown(rate, first_turn(rate, here)))))
        size = math.sqrt(power[0] * power[0] + power[1] * power[1])
        for i in range(last):
            # Inside a sample z = swing e^(L t) + steady + slope t/L.
            z, slope = (states[0, i], states[1, i]), (acceleration[i + 1] - acceleration[i]) / h
            steady = product((acceleration[i] + slope * inverse[0], slope * inverse[1]), inverse)
            swing = (z[0] - steady[0], z[1] - steady[1])
            drift = before[1] * slope
            # No faster than at the sample's start by more than this: most samples are passed over.
            reach = h * h * square * math.sqrt(swing[0] * swing[0] + swing[1] * swing[1])
            speed = h * abs(imaginary(product(power, rate), swing) + drift)
            if abs(imaginary(power, z)) + speed + size * reach > best:
                inside, constant = product(power, swing), imaginary(power, steady)
                best = max(best, largest_inside(inside, constant, drift, rate, h))
        largest[kind] = best
        before = power


@compiled
def largest_inside(swing: Complex, constant: float, slope: float, rate: Complex, h: float) -> float:
    """Return the largest |Im(swing e^(L t)) + constant + slope t| at an extremum, 0 < t < h."""
    moving = product(rate, swing)
    # The derivative turns once at most inside a sample, at a phase that is known.
    turn = min(first_turn(rate, moving), h)
    best = 0.0
    for part in range(2):
        low, high = (0.0, turn) if part == 0 else (turn, h)
        rising = imaginary(moving, grown(rate, low)) + slope > 0.0
        if rising == (imaginary(moving, grown(rate, high)) + slope > 0.0):
            continue
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            if (imaginary(moving, grown(rate, middle)) + slope > 0.0) == rising:
                low = middle
            else:
                high = middle
        best = max(best, abs(imaginary(swing, grown(rate, low)) + constant + slope * low))
    return best


@compiled
def first_turn(rate: Complex, z: Complex) -> float:
    """Return the first time from 0 on at which the derivative of Im(z e^(L t)) is 0."""
    moving = product(rate, z)
    turned = -atan2(moving[1], moving[0])
    return (turned + math.pi if turned < 0.0 else turned) / rate[1]


@inlined
def grown(rate: Complex, t: float) -> Complex:
    """Return e^(L t)."""
    size = exp(rate[0] * t)
    sine, cosine = sincos(rate[1] * t)
    return size * cosine, size * sine


@inlined
def product(x: Complex, y: Complex) -> Complex:
    """Return x y."""
    return x[0] * y[0] - x[1] * y[1], imaginary(x, y)


@inlined
def imaginary(x: Complex, y: Complex) -> float:
    """Return the imaginary part of x y."""
    return x[0] * y[1] + x[1] * y[0]
