"""The formulae of pulses as their papers print them, written once more and without the package.

Each takes pivot time since the pulse's start, the largest acceleration a and w = omega/p.
"""

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

Floats = NDArray[np.float64]
Formula = Callable[[Floats, float, float], Floats]

GAMMA, NU = 2.5, 1.0
"""Of the Mavroeidis-Papageorgiou pulse in the tests."""


def type_c_phase(n: int) -> float:
    """Makris and Roussos (2000): the phase that makes the displacement at the end 0."""

    def displacement(phi: float) -> float:
        end = (2 * n + 1) * math.pi - phi
        return math.cos(end) + (end - phi) * math.sin(phi) - math.cos(phi)

    return float(brentq(displacement, 0.0, 0.5, xtol=1e-15))


def _type_c(n: int) -> tuple[float, Formula]:
    phi = type_c_phase(n)
    return n + 0.5 - phi / math.pi, lambda s, a, w: a * np.cos(w * s + phi)


def ricker(s: Floats, a: float, w: float) -> Floats:
    """Vassiliou and Makris (2011), with t from the middle and T = 2 pi/w."""
    x = (math.pi * s * w / (2.0 * math.pi)) ** 2
    return np.asarray(a * (1.0 - 2.0 * x) * np.exp(-0.5 * 2.0 * x))


def ricker_antisymmetric(s: Floats, a: float, w: float) -> Floats:
    """The same, whose beta = 1.38 is exactly 1.3801198..."""
    u = 2.0 * math.pi * s / (math.sqrt(3.0) * 2.0 * math.pi / w)
    crest = math.sqrt(3.0 - math.sqrt(6.0))
    beta = (3.0 - crest**2) * crest * math.exp(-0.5 * crest**2)
    return np.asarray(a / beta * (u**2 - 3.0) * u * np.exp(-0.5 * u**2))


def mavroeidis_papageorgiou(s: Floats, v: float, w: float) -> Floats:
    """Mavroeidis and Papageorgiou (2003), acceleration of a velocity amplitude v, t0 = 0."""
    f = w / (2.0 * math.pi)
    slow, fast = 2.0 * math.pi * f / GAMMA * s, 2.0 * math.pi * f * s + NU
    return np.asarray(
        -v
        * math.pi
        * f
        / GAMMA
        * (np.sin(slow) * np.cos(fast) + GAMMA * np.sin(fast) * (1.0 + np.cos(slow)))
    )


FORMULAE: dict[str, tuple[float, Formula]] = {
    "rectangle": (0.5, lambda s, a, _: np.full_like(s, a)),
    "half-sine": (0.5, lambda s, a, w: a * np.sin(w * s)),
    "versed-sine": (0.5, lambda s, a, w: 0.5 * a * (1.0 - np.cos(2.0 * w * s))),
    "triangle": (0.5, lambda s, a, w: a * (1.0 - np.abs(2.0 * s * w / math.pi - 1.0))),
    "decaying-ramp": (0.5, lambda s, a, w: a * (1.0 - s * w / math.pi)),
    "one-sine": (1.0, lambda s, a, w: a * np.sin(w * s)),
    "one-cosine": (1.0, lambda s, a, w: a * np.cos(w * s)),
    "type-c1": _type_c(1),
    "type-c2": _type_c(2),
    "type-c3": _type_c(3),
    "type-c12": _type_c(12),
}
"""Duration in periods, and acceleration, of what is exact."""


def centred(name: str, s: Floats, a: float, w: float) -> Floats:
    """Acceleration of a wavelet at times from its middle, scaled to a largest one of a."""
    if name == "ricker":
        return ricker(s, a, w)
    if name == "ricker-antisymmetric":
        return ricker_antisymmetric(s, a, w)
    fine = np.linspace(-GAMMA * math.pi, GAMMA * math.pi, 2_000_001)
    unit = mavroeidis_papageorgiou(fine, 1.0, 1.0)
    shown = np.abs(w * s) <= GAMMA * math.pi
    v = a / (w * float(np.abs(unit).max()))
    return np.where(shown, mavroeidis_papageorgiou(s, v, w), 0.0)
