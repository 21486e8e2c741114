"""Tso and Wong's formulae as they are printed, and a half cycle drawn by sampling: the oracles."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Printed:
    """A solution as eqs 19, 21 and 22 print it; velocity is du/d(omega t) after impact."""

    sine: float
    cosine: float
    velocity: float

    @property
    def phase(self) -> float:
        return math.atan2(self.sine, self.cosine)


def numbers(a: float, w: float, r: float, n: int) -> tuple[float, float, float, float]:
    """h, beta, P and Q as defined between eqs 19 and 22."""
    d, h = (1.0 - r) / (1.0 + r), math.tanh(n * math.pi / (2.0 * w))
    beta = a / (1.0 + w * w)
    return h, beta, d * h * w, d * h * h / beta


def printed_boundaries(w: float, r: float, n: int) -> tuple[float, float, float]:
    """Eqs 23, 24 and 25: existence, sign and kind."""
    h, _, p, _ = numbers(1.0, w, r, n)
    d, square = (1.0 - r) / (1.0 + r), 1.0 + w * w
    return square * d * h * h / math.sqrt(1.0 + p * p), h * square / w, d * h * h * square


def printed_region(a: float, w: float, r: float, n: int) -> int:
    _, _, p, q = numbers(a, w, r, n)
    if q > math.sqrt(1.0 + p * p):
        return 4
    return {(True, True): 1, (True, False): 2, (False, True): 3, (False, False): 5}[q < 1, p < q]


def printed(a: float, w: float, r: float, n: int, branch: int) -> Printed:
    h, beta, p, q = numbers(a, w, r, n)
    root = math.sqrt(1.0 + p * p - q * q) * (1.0 if branch == 1 else -1.0)
    sine, cosine = (q + p * root) / (1.0 + p * p), (q * p - root) / (1.0 + p * p)
    return Printed(sine, cosine, -(beta * sine / h - h) / w - beta * cosine)


def printed_trace(a: float, w: float, r: float, n: int, sine: float, velocity: float) -> float:
    """TW5."""
    length = n * math.pi / w
    bracket = (1.0 + r) - (1.0 - r) * a * sine
    return -2.0 * r * math.cosh(length) + r * math.sinh(length) / (w * velocity) * bracket


def half_cycle(
    a: float, w: float, n: int, phase: float, velocity: float, samples: int
) -> tuple[Floats, Floats]:
    """Pivot time and angle over a half cycle that leaves the floor with a du/d(omega t) (eq 7)."""
    s = np.linspace(0.0, n * math.pi / w, samples)
    beta = a / (1.0 + w * w)
    sinh_part, cosh_part = (
        w * (velocity + beta * math.cos(phase)),
        beta * math.sin(phase) - 1.0,
    )
    return s, sinh_part * np.sinh(s) + cosh_part * np.cosh(s) + 1.0 - beta * np.sin(w * s + phase)
