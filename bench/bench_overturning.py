"""Overturning spectra: all windows of a pulse at 200 frequencies, nonlinear ones at fewer."""

import time
from typing import Any

import numpy as np
import pytest

from rocksteady import Block, DimensionlessBlock, Nonlinear, find_overturning_windows

FEW = 40  # frequencies in the nonlinear model


@pytest.mark.parametrize("shape", ["one-sine", "one-cosine"])
@pytest.mark.benchmark(group="overturning", timer=time.perf_counter)
def test_windows(benchmark: Any, shape: str) -> None:
    block, ratios = DimensionlessBlock(restitution=0.9), np.geomspace(0.5, 10.0, 200)
    found = benchmark.pedantic(
        find_overturning_windows, args=(block, shape, ratios), rounds=3, warmup_rounds=1
    )
    benchmark.extra_info["frequencies"] = len(ratios)
    assert not found.undecided.any()


@pytest.mark.benchmark(group="overturning", timer=time.perf_counter)
def test_windows_nonlinear(benchmark: Any) -> None:
    block, ratios = Block.from_p(alpha=0.2, p=1.0, restitution=0.9), np.geomspace(0.5, 10.0, FEW)
    found = benchmark.pedantic(
        find_overturning_windows,
        args=(block, "ricker", ratios),
        kwargs={"model": Nonlinear()},
        rounds=1,
    )
    benchmark.extra_info["frequencies"] = len(ratios)
    assert not found.undecided.any()
