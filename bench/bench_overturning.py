"""Overturning spectra: all windows of a pulse at 200 frequencies."""

import time
from typing import Any

import numpy as np
import pytest

from rocksteady import DimensionlessBlock, find_overturning_windows


@pytest.mark.parametrize("shape", ["one-sine", "one-cosine"])
@pytest.mark.benchmark(group="overturning", timer=time.perf_counter)
def test_windows(benchmark: Any, shape: str) -> None:
    block, ratios = DimensionlessBlock(restitution=0.9), np.geomspace(0.5, 10.0, 200)
    found = benchmark.pedantic(
        find_overturning_windows, args=(block, shape, ratios), rounds=3, warmup_rounds=1
    )
    benchmark.extra_info["frequencies"] = len(ratios)
    assert not found.undecided.any()
