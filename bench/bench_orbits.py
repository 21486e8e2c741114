"""What motions settle to over a grid, and all orbits at a point, on one core."""

import time
from collections import Counter
from typing import Any

import numpy as np
import pytest

from rocksteady import DimensionlessBlock, Harmonic, find_attractor, find_orbits

BLOCK = DimensionlessBlock(restitution=0.8)
SIDE = 50


@pytest.mark.benchmark(group="orbits", timer=time.process_time)
def test_attractors(benchmark: Any) -> None:
    points = [
        Harmonic(amplitude=float(a), frequency_ratio=float(w))
        for a in np.linspace(0.5, 6.0, SIDE)
        for w in np.linspace(0.5, 10.0, SIDE)
    ]

    def run() -> Counter[str]:
        return Counter(find_attractor(BLOCK, shaking).kind.value for shaking in points)

    kinds = benchmark.pedantic(run, rounds=5, warmup_rounds=1)
    benchmark.extra_info["points"] = len(points)
    benchmark.extra_info["kinds"] = dict(kinds)


@pytest.mark.benchmark(group="orbits", timer=time.process_time)
def test_orbits_at_a_point(benchmark: Any) -> None:
    shaking = Harmonic(amplitude=1.0, frequency_ratio=2.0)
    found = benchmark.pedantic(find_orbits, args=(BLOCK, shaking), rounds=5, warmup_rounds=1)
    benchmark.extra_info["points"] = 1
    benchmark.extra_info["orbits"] = len(found)
