"""Search of a horseshoe near the hilltops: which phases, boxes and flights a proof is tried for."""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

SIZES = ("0.15", "0.1", "0.05", "0.02")
"""Half-widths of the boxes of impact phases that are tried [rad]."""
LONGEST = 15
"""Largest number of half periods that is tried for the shortest flight."""


def hilltop_phases(amplitude: float, ratio: float, restitution: float) -> list[float]:
    """Return the impact phases of endless flights, by docs/theory/steady.md; none below A_het."""
    share = (1.0 - restitution) / (1.0 + restitution)
    level = share * (1.0 + ratio * ratio) / (amplitude * math.hypot(1.0, share * ratio))
    if level >= 1.0:
        return []
    lag = math.atan(share * ratio)
    return [math.asin(level) - lag, math.pi - math.asin(level) - lag]


def entropy_of(symbols: int, least: int) -> float:
    """Return the entropy per period of all sequences of flights of `least` half periods and more.

    Sequences whose flights add up to L half periods grow in number as z^-L, with
    ``symbols z^least = 1 - z^2``.
    """
    powers = np.zeros(max(least, 2) + 1)
    powers[[0, 2]] = -1.0, 1.0
    powers[least] += symbols
    roots = np.roots(powers[::-1])
    return -2.0 * math.log(min(x.real for x in roots if abs(x.imag) < 1e-9 and 0.0 < x.real < 1.0))


def horseshoes(amplitude: float, ratio: float, restitution: float) -> Iterator[dict[str, Any]]:
    """Yield what the certificates of horseshoes would hold, those of the largest entropy first."""
    centres = [f"{x:.5f}" for x in hilltop_phases(amplitude, ratio, restitution)]
    kinds = [
        (entropy_of(len(phases), least), phases, least)
        for phases in ((centres, centres[1:], centres[:1]) if centres else ())
        for least in range(1, LONGEST + 1, 2)
    ]
    for entropy, phases, least in sorted(kinds, key=lambda kind: -kind[0]):
        for radius in SIZES:
            yield {
                "phases": phases,
                "radius": radius,
                "least_half_periods": least,
                "claim": {"entropy_per_period": f"{math.floor(entropy * 1e4 - 1e-6) / 1e4:.4f}"},
            }
