"""Symmetric steady states on a grid of 1000 x 1000 points of (Omega, A), n = 1, on one core."""

import time
from typing import Any

import numpy as np
import pytest

from rocksteady.kernels.orbits.closed_form import Points, Steady, fill_steady

SIDE = 1000
RESTITUTION = 0.8


@pytest.mark.parametrize("shapes", [False, True], ids=["phase and velocity", "with shapes"])
@pytest.mark.benchmark(group="steady", timer=time.process_time)
def test_steady(benchmark: Any, shapes: bool) -> None:
    # The axes of Tso and Wong's Fig. 3.
    frequency_ratio, amplitude = np.meshgrid(
        np.linspace(0.0, 14.0, SIDE + 1)[1:], np.linspace(0.0, 6.0, SIDE + 1)[1:]
    )
    count = amplitude.size
    region = np.zeros(count, np.int64)
    admissible = np.zeros((2, count), np.bool_)
    ratios, orders = np.full(count, RESTITUTION), np.ones(count, np.int64)
    filled = [np.empty((2, count)) for _ in range(4)]
    extrema = np.zeros((2, count), np.int64)
    arguments = (
        Points(amplitude.ravel(), frequency_ratio.ravel(), ratios, orders),
        shapes,
        Steady(region, np.empty((3, count)), *filled, extrema, admissible),
    )
    benchmark.pedantic(fill_steady, args=arguments, rounds=3 if shapes else 7, warmup_rounds=1)
    benchmark.extra_info["points"] = count
    benchmark.extra_info["points_with_orbits"] = int((region != 4).sum())
    if shapes:
        benchmark.extra_info["admissible"] = [int(branch.sum()) for branch in admissible]
