"""The march: work units B1 and B2, by the package's kernels and by a plain sampling march.

Each unit is 100 x 100 cells (Omega from 1 to 12, A from 1 to 6) of 200 forcing periods, restitution
0.8, angle 0 and phase 0 at the start: B1 with velocity d(theta/alpha)/d(pt) = 0.3, B2 from rest.
Both marches run on one core and are timed in CPU time, which a busy machine disturbs least.

Sampled motions are marched as runs of samples, the same with peaks kept, and one segment at a time,
as any other motion.
"""

import math
import time
from typing import Any, NamedTuple

import numpy as np
import pytest
from numpy.typing import NDArray

from bench.sampling_march import SAMPLES, sampled_fates
from rocksteady.kernels.batch.records import record_fates
from rocksteady.kernels.core.tables import ALIKE, ROW_COLUMNS, March
from rocksteady.kernels.core.tuples import (
    Blocks,
    Fates,
    Kept,
    PeakFates,
    Tables,
    Until,
)
from rocksteady.kernels.march.march import march
from rocksteady.model.linear_tables import record_table
from rocksteady.model.motions.record import Record
from rocksteady.model.nonlinear_tables import lifted_table
from rocksteady.outcomes import Status
from tests.kernels.fates import fates_in_lanes, harmonic_fates
from tests.records import synthetic

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


def run_lanes(unit: Cells, leaping: bool) -> None:
    amplitude, frequency, restitution, zeros, velocity, status, impacts = unit
    columns = np.array([amplitude, frequency, restitution, zeros, velocity, zeros])
    fates_in_lanes(columns, CYCLES, leaping, Fates(status, impacts, np.empty((len(zeros), 3))))


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


@pytest.mark.parametrize("leaping", [False, True], ids=["in_full", "leaping"])
@pytest.mark.parametrize("name", UNITS)
@pytest.mark.benchmark(group="march", timer=time.process_time)
def test_lanes(benchmark: Any, name: str, leaping: bool) -> None:
    unit, plain = cells(name), cells(name)
    run_kernel(plain)
    benchmark.pedantic(run_lanes, args=(unit, leaping), rounds=7, warmup_rounds=1)
    note(benchmark, unit)
    benchmark.extra_info["same_fate"] = float(np.mean(unit.status == plain.status))


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


class Shaken(NamedTuple):
    """A record in the units of a block, the block's sides, and where it begins."""

    segments: NDArray[np.float64]
    sides: NDArray[np.float64]
    start: March


def shaken(name: str) -> Shaken:
    """Return a case that is nothing but flight, rest or chatter, or an earthquake."""
    rng = np.random.default_rng(1940)
    if name in {"flight", "rest"}:
        # In flight the block is so slow that the record is over before it comes down.
        noise = Record(acceleration_m_s2=rng.normal(0.0, 0.01, 100_000), dt_s=0.001)
        flying = name == "flight"
        side = (0.9, 1.0, 0.005 if flying else 1.0)
        start = March(int(flying), 0.5 * flying, 0.0, 0, 0, 0.0, 0, 0)
        return Shaken(record_table(noise), np.array([side, side]), start)
    quake = Record(acceleration_m_s2=synthetic(rng, 5400, 0.01, 3.4), dt_s=0.01)
    # Chatter: a block that is hardly lifted, and bounces on for long.
    uplift, rate, restitution = (3.0, 8.0, 0.97) if name == "chatter" else (2.0, 2.0, 0.9)
    sides = np.array([(restitution, 1.0, 1.0)] * 2)
    table = record_table(quake, rate=rate, acceleration=uplift)
    return Shaken(table, sides, March(0, 0.0, 0.0, 0, 0, 0.0, 0, 0))


@pytest.mark.parametrize("way", ["runs", "runs with peaks", "segments"])
@pytest.mark.parametrize("name", ["flight", "rest", "chatter", "earthquake"])
@pytest.mark.benchmark(group="samples", timer=time.process_time)
def test_samples(benchmark: Any, name: str, way: str) -> None:
    case = shaken(name)
    if way == "segments":
        case.segments[:, ALIKE] = 0.0
    peaks = np.zeros(2 if "peaks" in way else 0)
    stop = 0.0 if name in {"flight", "rest"} else math.inf
    none = np.zeros((0, ROW_COLUMNS))
    segments, sides, start = case
    until = Until(0, stop, 1e-8, 10**9)
    arguments = (Tables(segments, sides), start, until, Kept(none, peaks))
    _, end = march(*arguments)
    benchmark.pedantic(march, args=arguments, rounds=50, iterations=4, warmup_rounds=1)
    benchmark.extra_info["samples"] = len(case.segments)
    benchmark.extra_info["impacts"] = end.impacts


@pytest.mark.parametrize("way", ["runs with peaks", "segments"])
@pytest.mark.benchmark(group="samples", timer=time.process_time)
def test_samples_400_blocks(benchmark: Any, way: str) -> None:
    """Blocks of 20 sizes and 20 slendernesses on one earthquake, the work of a spectrum."""
    values = synthetic(np.random.default_rng(1940), 5400, 0.01, 3.4)
    segments = record_table(Record(acceleration_m_s2=values, dt_s=0.01))
    if way == "segments":
        segments[:, ALIKE] = 0.0
    uplift, rate = (
        grid.ravel() for grid in np.meshgrid(np.linspace(0.5, 3.3, 20), np.linspace(1.0, 8.0, 20))
    )
    count = len(uplift)
    impacts = np.zeros(count, np.int64)
    side = np.column_stack([np.full(count, 0.9), uplift, rate])
    sides = np.repeat(side[:, np.newaxis], 2, axis=1)
    fates = PeakFates(np.zeros(count, np.int64), impacts, np.zeros((count, 2)))
    arguments = (segments, Blocks(sides, np.full(count, 1e15)), 10**7, fates)
    benchmark.pedantic(record_fates, args=arguments, rounds=7, warmup_rounds=1)
    benchmark.extra_info["samples"] = count * len(segments)
    benchmark.extra_info["impacts"] = int(impacts.sum())


@pytest.mark.parametrize("model", ["linear", "nonlinear"])
@pytest.mark.benchmark(group="samples", timer=time.process_time)
def test_samples_1000_blocks(benchmark: Any, model: str) -> None:
    """Free rectangles of 1,000 sizes on one earthquake, with peaks."""
    values = synthetic(np.random.default_rng(1940), 5400, 0.01, 3.4)
    segments = record_table(Record(acceleration_m_s2=values, dt_s=0.01))
    rng, count = np.random.default_rng(5), 1000
    alpha, p = rng.uniform(0.08, 0.3, count), rng.uniform(1.0, 6.0, count)
    restitution = (1.0 - 1.5 * np.sin(alpha) ** 2) * rng.uniform(0.85, 1.0, count)
    columns = [restitution, 9.81 * alpha, p]
    if model == "nonlinear":
        segments = lifted_table(segments)
        columns += [alpha, np.full(count, 1e-15)]
    sides = np.repeat(np.column_stack(columns)[:, np.newaxis], 2, axis=1)
    impacts = np.zeros(count, np.int64)
    fates = PeakFates(np.zeros(count, np.int64), impacts, np.zeros((count, 2)))
    arguments = (segments, Blocks(sides, np.full(count, 1e15)), 10**7, fates)
    benchmark.pedantic(record_fates, args=arguments, rounds=7, warmup_rounds=1)
    benchmark.extra_info["samples"] = count * len(segments)
    benchmark.extra_info["impacts"] = int(impacts.sum())
