"""The nonlinear model: B1 with a slenderness, an earthquake, and a general solver on some cells.

Blocks have alpha = 0.2 and the tolerance is the default.  The solver is DOP853 with an event for
each impact, as accurate as the march; it runs cells that do not overturn.
"""

import math
import time
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from bench.bench_march import CYCLES, RESTITUTION, THINNED, Cells, cells, note
from rocksteady import Block, Record, Status
from rocksteady.dynamics.history.nonlinear_tables import nonlinear_segment_table, sides_of
from rocksteady.kernels.batch.harmonic import fates_of_sides
from rocksteady.kernels.core.tables import ROW_COLUMNS, March
from rocksteady.kernels.march.march import march
from rocksteady.model.equations import Nonlinear
from tests.dynamics.full_integrator import impacts_by_integrator
from tests.kernels.fates import NO_LIMIT
from tests.records import synthetic

BLOCK = Block.from_p(alpha=0.2, p=1.0, restitution=RESTITUTION)
SOLVED = 6  # cells that the general solver runs


def run(unit: Cells) -> None:
    count = unit.amplitude.size
    fates_of_sides(
        unit.amplitude,
        unit.frequency_ratio,
        np.broadcast_to(sides_of(BLOCK, Nonlinear()), (count, 2, 5)).copy(),
        unit.zeros,
        unit.velocity,
        unit.zeros,
        CYCLES,
        NO_LIMIT,
        unit.status,
        unit.impacts,
        np.empty((count, 3)),
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


@pytest.mark.benchmark(group="nonlinear", timer=time.process_time)
def test_march_b1(benchmark: Any) -> None:
    unit = cells("B1", THINNED)
    benchmark.pedantic(run, args=(unit,), rounds=5, warmup_rounds=1)
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
@pytest.mark.benchmark(group="nonlinear", timer=time.process_time)
def test_earthquake(benchmark: Any, way: str) -> None:
    """The coloured noise of the linear model's benchmark, on a block that lifts at 2 m/s^2."""
    values = synthetic(np.random.default_rng(1940), 5400, 0.01, 3.4)
    block = Block.from_p(alpha=math.atan(2.0 / 9.80665), p=2.0, restitution=0.9)
    segments = nonlinear_segment_table(Record(acceleration_m_s2=values, dt_s=0.01), block)
    none = np.zeros((0, ROW_COLUMNS))
    start = March(0, 0.0, 0.0, 0, 0, 0.0, 0, 0)
    sides = sides_of(block, Nonlinear())
    arguments = (segments, sides, start, 0, 1e15, 1e-8, 10**9, none)
    peaks = np.zeros(2 if way == "with peaks" else 0)
    _, end = march(*arguments, peaks)
    benchmark.pedantic(march, args=(*arguments, peaks), rounds=20, warmup_rounds=1)
    benchmark.extra_info["samples"] = len(segments)
    benchmark.extra_info["impacts"] = end.impacts
