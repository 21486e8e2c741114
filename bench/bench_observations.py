"""Fates in tests: the cells that a calibration of 490 tests needs, on all cores."""

import time
from typing import Any

import numpy as np
import pytest

from rocksteady import Block, Execution, Linear, Nonlinear, Record
from rocksteady.calibration import Scatter, ShakingTest, compute_test_fates
from rocksteady.motions import make_synthetic_suite

TESTS, BLOCKS = 49, 1300
GAINS = np.exp([-0.25, 0.25])
WHOLE = 490
"""Tests of the aim, ten times as many."""


def trials(count: int) -> list[ShakingTest]:
    """Return tests of 18 s at 100 Hz with peaks from 1 to 7 m/s^2: of half the blocks too weak."""
    rng = np.random.default_rng(23)
    times = 0.01 * np.arange(1800)
    tests = []
    for place, motion in enumerate(make_synthetic_suite(count)):
        samples = motion.acceleration_m_s2
        values = np.interp(times, motion.dt_s * np.arange(len(samples)), samples)
        values *= rng.uniform(1.0, 7.0) / np.abs(values).max()
        record = Record(acceleration_m_s2=values, dt_s=0.01, name=f"shaking {place}")
        tests.append(ShakingTest(name=f"test {place}", record=record, object="column"))
    return tests


@pytest.mark.benchmark(group="observations", timer=time.perf_counter)
@pytest.mark.parametrize(("model", "aim_s"), [(Linear(), 60), (Nonlinear(), 120)])
@pytest.mark.parametrize("outputs", [("status",), ("status", "peak_angle", "impacts")])
def test_fates(
    benchmark: Any, model: Linear | Nonlinear, aim_s: float, outputs: tuple[str, ...]
) -> None:
    rng = np.random.default_rng(24)
    sizes = zip(rng.uniform(0.1, 0.2, BLOCKS), rng.uniform(2.0, 5.0, BLOCKS), strict=True)
    blocks = [Block.from_p(alpha=alpha, p=p) for alpha, p in sizes]
    options = {
        "gains": GAINS,
        "scatter": Scatter(0.05),
        "outputs": outputs,
        "model": model,
        "run": Execution(workers=2),
    }
    found = benchmark.pedantic(
        compute_test_fates, args=(blocks, trials(TESTS)), kwargs=options, rounds=1
    )
    benchmark.extra_info["what"] = f"{model.name}, {' and '.join(outputs)} of cells of tests"
    benchmark.extra_info["count"] = found.status.size
    benchmark.extra_info["aim"] = f"aim {aim_s * TESTS / WHOLE:g} s"
