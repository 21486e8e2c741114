"""The nonlinear model: B1 with a slenderness, records, and a general solver on some cells.

Blocks have alpha = 0.2, but for one with unlike sides, and the tolerance is the default.  The
solver is DOP853 with an event for each impact, as accurate as the march; it runs cells that do not
overturn.
"""

import math
import time
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from bench.bench_march import CYCLES, RESTITUTION, THINNED, UNITS, Cells, cells, note
from rocksteady import Block, Execution, Record, State, Status, map_fates
from rocksteady.kernels.batch.harmonic import fates_of_sides
from rocksteady.kernels.core import tuples
from rocksteady.kernels.core.tables import ROW_COLUMNS, March
from rocksteady.kernels.core.tuples import Fates, Kept, Starts, Tables, Until
from rocksteady.kernels.march.march import march
from rocksteady.kernels.nonlinear_lanes.loop import nonlinear_lane_fates
from rocksteady.model.equations import Nonlinear
from tests.dynamics.full_integrator import impacts_by_integrator
from tests.kernels.fates import NO_LIMIT
from tests.records import synthetic

BLOCK = Block.from_p(alpha=0.2, p=1.0, restitution=RESTITUTION)
UNLIKE = Block.asymmetric(left=0.15, right=0.25, height=1.2, restitution=RESTITUTION)
SOLVED = 6  # cells that the general solver runs
blocks = pytest.mark.parametrize("block", [BLOCK, UNLIKE], ids=["symmetric", "unlike sides"])


def run(unit: Cells, block: Block = BLOCK) -> None:
    count = unit.amplitude.size
    fates_of_sides(
        tuples.Cells(
            unit.amplitude,
            unit.frequency_ratio,
            np.broadcast_to(Nonlinear().sides(block), (count, 2, 5)).copy(),
        ),
        Starts(unit.zeros, unit.velocity, unit.zeros),
        CYCLES,
        NO_LIMIT,
        Fates(unit.status, unit.impacts, np.empty((count, 3))),
    )


def run_lanes(unit: Cells, block: Block) -> None:
    count = unit.amplitude.size
    nonlinear_lane_fates(
        tuples.Cells(
            unit.amplitude,
            unit.frequency_ratio,
            np.broadcast_to(Nonlinear().sides(block), (count, 2, 5)).copy(),
        ),
        Starts(unit.zeros, unit.velocity, unit.zeros),
        CYCLES,
        True,
        NO_LIMIT,
        Fates(unit.status, unit.impacts, np.empty((count, 3))),
    )


def some_that_stand() -> Cells:
    """Return a few of the cells in which the block rocks to the end."""
    unit = cells("B1", THINNED)
    run(unit)
    rocking = np.flatnonzero(unit.status == Status.ROCKING)
    chosen = rocking[np.linspace(0, len(rocking) - 1, SOLVED).astype(int)]
    return Cells(*(part[chosen] for part in unit))


def run_solver(unit: Cells) -> NDArray[np.int64]:
    """Return the numbers of impacts of the cells, by the general solver."""
    found = []
    for amplitude, ratio, velocity in zip(
        unit.amplitude.tolist(), unit.frequency_ratio.tolist(), unit.velocity.tolist(), strict=True
    ):

        def shaking(t: float, a: float = amplitude, w: float = ratio) -> float:
            return BLOCK.alpha * a * math.sin(w * t)

        times = impacts_by_integrator(
            shaking,
            block=BLOCK,
            angle=0.0,
            velocity=BLOCK.alpha * velocity,
            breaks=[0.0, 2.0 * math.pi * CYCLES / ratio],
            longest_step=math.inf,
            count=10**9,
        )
        found.append(len(times))
    return np.array(found)


@blocks
@pytest.mark.benchmark(group="nonlinear", timer=time.process_time)
def test_march_b1(benchmark: Any, block: Block) -> None:
    unit = cells("B1", THINNED)
    benchmark.pedantic(run, args=(unit, block), rounds=5, warmup_rounds=1)
    note(benchmark, unit)


@pytest.mark.benchmark(group="nonlinear", timer=time.process_time)
def test_map_fates_b1(benchmark: Any) -> None:
    """The same cells as a user maps them, in one thread."""
    unit = cells("B1", THINNED)
    found = benchmark.pedantic(
        map_fates,
        args=(BLOCK,),
        kwargs={
            "axes": {
                "amplitude": np.unique(unit.amplitude),
                "frequency_ratio": np.unique(unit.frequency_ratio),
            },
            "start": State(angle=0.0, velocity=UNITS["B1"]),
            "cycles": CYCLES,
            "model": Nonlinear(),
            "run": Execution(executor="serial"),
        },
        rounds=5,
        warmup_rounds=1,
    )
    run_lanes(unit, BLOCK)  # for the number of impacts
    np.testing.assert_array_equal(unit.status, found.fate.to_numpy().ravel())
    note(benchmark, unit)


@blocks
@pytest.mark.benchmark(group="nonlinear", timer=time.process_time)
def test_lanes_b1(benchmark: Any, block: Block) -> None:
    """The same, side by side and with leaps over periods: what `map_fates` does."""
    unit = cells("B1", THINNED)
    benchmark.pedantic(run_lanes, args=(unit, block), rounds=5, warmup_rounds=1)
    note(benchmark, unit)


@pytest.mark.benchmark(group="nonlinear", timer=time.process_time)
def test_march_some(benchmark: Any) -> None:
    """The march on the cells of the solver, for the ratio of the two."""
    unit = some_that_stand()
    benchmark.pedantic(run, args=(unit,), rounds=5, warmup_rounds=1)
    note(benchmark, unit)


@pytest.mark.benchmark(group="nonlinear", timer=time.process_time)
def test_solver_some(benchmark: Any) -> None:
    unit = some_that_stand()
    found = benchmark.pedantic(run_solver, args=(unit,), rounds=1)
    note(benchmark, unit)
    benchmark.extra_info["same_impacts"] = float(np.mean(found == unit.impacts))


@pytest.mark.parametrize("way", ["plain", "with peaks"])
@pytest.mark.parametrize("name", ["flight", "earthquake"])
@pytest.mark.benchmark(group="nonlinear", timer=time.process_time)
def test_record(benchmark: Any, name: str, way: str) -> None:
    """The noise of the linear model's benchmarks, in flight and on a block of 2 m/s^2."""
    rng = np.random.default_rng(1940)
    if name == "flight":
        # The block is so slow that the record is over before it comes down.
        record = Record(acceleration_m_s2=rng.normal(0.0, 0.01, 100_000), dt_s=0.001)
        block = Block.from_p(alpha=0.2, p=0.005, restitution=0.9)
        start, stop = March(1, 0.5, 0.0, 0, 0, 0.0, 0, 0), 0.0
    else:
        record = Record(acceleration_m_s2=synthetic(rng, 5400, 0.01, 3.4), dt_s=0.01)
        block = Block.from_p(alpha=math.atan(2.0 / 9.80665), p=2.0, restitution=0.9)
        start, stop = March(0, 0.0, 0.0, 0, 0, 0.0, 0, 0), 1e15
    segments = Nonlinear().lower(block, record).segments
    none = np.zeros((0, ROW_COLUMNS))
    sides = Nonlinear().sides(block)
    peaks = np.zeros(2 if way == "with peaks" else 0)
    until = Until(0, stop, 1e-8, 10**9)
    arguments = (Tables(segments, sides), start, until, Kept(none, peaks))
    _, end = march(*arguments)
    benchmark.pedantic(march, args=arguments, rounds=20, warmup_rounds=1)
    benchmark.extra_info["samples"] = len(segments)
    benchmark.extra_info["impacts"] = end.impacts
