"""What a motion settles to by brute force: its angles compared with those of earlier periods."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rocksteady import DimensionlessBlock, Harmonic, Rest, State, Status, Steady, simulate

Floats = NDArray[np.float64]

LONGEST = 12
SAMPLES = 96
SAME = 1e-7
SETTLED = 1e-10


@dataclass(frozen=True)
class Seen:
    """What a long run looks like at its end."""

    kind: str  # "symmetric", "unsymmetric", "rest", "overturned" or "unsettled"
    period: int = 0
    highest: float = math.nan  # of the samples
    lowest: float = math.nan


def seen(block: DimensionlessBlock, shaking: Harmonic, start: Rest | State | Steady) -> Seen:
    """Return what a motion has settled to clearly, followed for as long as that takes."""
    for cycles in (200, 800, 3200):
        found = seen_after(block, shaking, start, cycles)
        if found.kind != "unsettled":
            return found
    return Seen("unsettled")


def seen_after(
    block: DimensionlessBlock, shaking: Harmonic, start: Rest | State | Steady, cycles: int
) -> Seen:
    run = simulate(block, shaking, start=start, cycles=cycles)
    if run.status is Status.OVERTURNED:
        return Seen("overturned")
    unit = 2.0 * math.pi / shaking.frequency_ratio
    back = np.arange(2 * LONGEST * SAMPLES, -1, -1)
    angle: Floats = run(np.maximum(run.end_time_pt - back * (unit / SAMPLES), 0.0)).angle
    size = float(np.abs(angle).max())
    if size == 0.0:
        return Seen("rest")
    last = angle[LONGEST * SAMPLES :]
    # The shortest period after which it is nearly the same counts once it is the same.
    for period in range(1, LONGEST + 1):
        change = float(np.abs(last - earlier(angle, period * SAMPLES)).max())
        if change < SAME * size:
            break
    else:
        return Seen("unsettled")
    if change > SETTLED * size:
        return Seen("unsettled")
    symmetric = bool(np.abs(last + earlier(angle, period * SAMPLES // 2)).max() < SAME * size)
    return Seen(
        "symmetric" if symmetric else "unsymmetric", period, float(last.max()), float(last.min())
    )


def earlier(angle: Floats, samples: int) -> Floats:
    first = LONGEST * SAMPLES - samples
    return angle[first : len(angle) - samples]
