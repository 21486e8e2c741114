"""The march: work units B1 and B2, with the package's kernel and with a plain sampling march.

Each unit is 100 x 100 cells (Omega from 1 to 12, A from 1 to 6) of 200 forcing periods, restitution
0.8, angle 0 and phase 0 at the start: B1 with velocity d(theta/alpha)/d(pt) = 0.3, B2 from rest.
Both marches run on one core and are timed in CPU time, which a busy machine disturbs least.
"""

import time
from typing import Any, NamedTuple

import numpy as np
import pytest
from numpy.typing import NDArray

from bench.sampling_march import SAMPLES, sampled_fates
from rocksteady.errors import Status
from rocksteady.kernels.cells import harmonic_fates

UNITS = {"B1": 0.3, "B2": 0.0}
SIDE = 100  # cells along either axis
THINNED = 4  # the sampling march runs every so many-th cell along either axis
CYCLES = 200
RESTITUTION = 0.8


class Cells(NamedTuple):
    amplitude: NDArray[np.float64]
    frequency_ratio: NDArray[np.float64]
    restitution: NDArray[np.float64]
    zeros: NDArray[np.float64]
    velocity: NDArray[np.float64]
    status: NDArray[np.int64]
    impacts: NDArray[np.int64]


def cells(unit: str, thinned: int = 1) -> Cells:
    frequency_ratio, amplitude = np.meshgrid(
        np.linspace(1.0, 12.0, SIDE)[::thinned], np.linspace(1.0, 6.0, SIDE)[::thinned]
    )
    count = amplitude.size
    return Cells(
        amplitude.ravel(),
        frequency_ratio.ravel(),
        np.full(count, RESTITUTION),
        np.zeros(count),
        np.full(count, UNITS[unit]),
        np.zeros(count, np.int64),
        np.zeros(count, np.int64),
    )


def run_kernel(unit: Cells) -> None:
    harmonic_fates(
        unit.amplitude,
        unit.frequency_ratio,
        unit.restitution,
        unit.zeros,
        unit.velocity,
        unit.zeros,
        CYCLES,
        unit.status,
        unit.impacts,
        np.empty((unit.amplitude.size, 3)),
    )


def run_sampling(unit: Cells) -> None:
    sampled_fates(
        unit.amplitude,
        unit.frequency_ratio,
        unit.restitution,
        unit.velocity,
        CYCLES,
        SAMPLES,
        unit.status,
        unit.impacts,
    )


def note(benchmark: Any, unit: Cells) -> None:
    """Keep with the benchmark what it worked on, and its time per trajectory and per impact."""
    impacts = int(unit.impacts.sum())
    benchmark.extra_info["trajectories"] = unit.amplitude.size
    benchmark.extra_info["impacts"] = impacts
    benchmark.extra_info["overturned"] = int((unit.status == Status.OVERTURNED).sum())
    if benchmark.stats is not None:  # it is None under --benchmark-disable
        median = benchmark.stats.stats.median
        benchmark.extra_info["us_per_trajectory"] = 1e6 * median / unit.amplitude.size
        benchmark.extra_info["ns_per_impact"] = 1e9 * median / impacts


@pytest.mark.parametrize("name", UNITS)
@pytest.mark.benchmark(group="march", timer=time.process_time)
def test_march(benchmark: Any, name: str) -> None:
    unit = cells(name)
    benchmark.pedantic(run_kernel, args=(unit,), rounds=7, warmup_rounds=1)
    note(benchmark, unit)


@pytest.mark.parametrize("name", UNITS)
@pytest.mark.benchmark(group="march", timer=time.process_time)
def test_march_thinned(benchmark: Any, name: str) -> None:
    """The package's kernel on the cells of the sampling march, for the ratio of the two."""
    unit = cells(name, THINNED)
    benchmark.pedantic(run_kernel, args=(unit,), rounds=15, warmup_rounds=1)
    note(benchmark, unit)


@pytest.mark.parametrize("name", UNITS)
@pytest.mark.benchmark(group="march", timer=time.process_time)
def test_sampling_march(benchmark: Any, name: str) -> None:
    unit, exact = cells(name, THINNED), cells(name, THINNED)
    run_kernel(exact)
    benchmark.pedantic(run_sampling, args=(unit,), rounds=5, warmup_rounds=1)
    note(benchmark, unit)
    # Overturned or not; whether a bounce still counts as rocking is a matter of the rest rule.
    fell, falls = unit.status == Status.OVERTURNED, exact.status == Status.OVERTURNED
    benchmark.extra_info["samples_per_period"] = SAMPLES
    benchmark.extra_info["same_fate"] = float(np.mean(fell == falls))
    benchmark.extra_info["same_impacts"] = float(np.mean(unit.impacts == exact.impacts))
