"""Exact peaks of damped oscillators under a record, between samples too."""

import math

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.kernels.linear.oscillator import fill_largest
from rocksteady.model.motions.oscillator import rate_of, states


def peaks(acceleration: Floats, dt: float, frequency: float, damping: float) -> Floats:
    """Return the largest absolute displacement, velocity and total acceleration of an oscillator.

    They are those of `rocksteady.kernels.linear.oscillator.fill_largest`.

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
    a = np.array(acceleration)
    if parts > 1:
        within = np.diff(a)[:, np.newaxis] * (np.arange(parts) / parts)
        a = np.append(a[:-1, np.newaxis] + within, a[-1])
    largest, h = np.empty(3), dt / parts
    fill_largest(a, np.array(states(a, h, rate)), h, tuple(rate), largest)
    return largest
