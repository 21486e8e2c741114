"""The engine of sweeps: one map in each of the ways to compute and to keep it.

Elapsed time, one after the other in one run, so that the ratios mean something.  The worker
processes are started beforehand: how long that takes is not what a long sweep is about.
"""

import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady import DimensionlessBlock, Execution, State, Store, map_attractors, map_fates
from rocksteady.sweeps import Axis, Grid, Output, evaluate

Floats = NDArray[np.float64]

AXES = {"amplitude": np.linspace(1.2, 6.0, 400), "frequency_ratio": np.linspace(0.5, 8.0, 400)}
WAYS = {
    "one thread": Execution(workers=1),
    "all cores": Execution(),
    "all cores, store": Execution(),
    "dask, store": Execution(),
}


@pytest.fixture(scope="module")
def scheduler() -> Iterator[str]:
    """The address of worker processes, one for each core."""
    from distributed import LocalCluster

    with LocalCluster(threads_per_worker=1, dashboard_address=None, silence_logs=50) as cluster:
        yield cluster.scheduler_address


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.benchmark(group="sweeps", timer=time.perf_counter)
def test_map(benchmark: Any, way: str, scheduler: str, tmp_path: Path) -> None:
    how = WAYS[way]
    if "dask" in way:
        how = replace(how, executor=scheduler)
    if "store" in way:
        how = replace(how, store=Store(tmp_path / "map.zarr", overwrite=True))
    found = benchmark.pedantic(
        map_attractors,
        args=(DimensionlessBlock(restitution=0.8),),
        kwargs={"axes": AXES, "run": how},
        rounds=3,
        warmup_rounds=1,
    )
    benchmark.extra_info["cells"] = found.kind.size


@pytest.mark.parametrize("where", ["memory", "store"])
@pytest.mark.benchmark(group="sweeps", timer=time.perf_counter)
def test_fates(benchmark: Any, where: str, tmp_path: Path) -> None:
    axes = {"amplitude": np.linspace(1.0, 6.0, 400), "frequency_ratio": np.linspace(1.0, 12.0, 400)}
    store = Store(tmp_path / "fates.zarr", overwrite=True) if where == "store" else None
    found = benchmark.pedantic(
        map_fates,
        args=(DimensionlessBlock(restitution=0.8),),
        kwargs={
            "axes": axes,
            "start": State(angle=0.0, velocity=0.3),
            "run": Execution(store=store),
        },
        rounds=3,
        warmup_rounds=1,
    )
    benchmark.extra_info["cells"] = found.fate.size


def cheap(a: Floats, b: Floats) -> dict[str, Any]:
    """Next to no work, so that the engine's own is seen."""
    return {"product": a * b, "above": a > b}


@pytest.mark.parametrize("where", ["memory", "store"])
@pytest.mark.benchmark(group="sweeps", timer=time.perf_counter)
def test_cheap(benchmark: Any, where: str, tmp_path: Path) -> None:
    axes = tuple(Axis(name=name, values=np.linspace(0.0, 1.0, 1000)) for name in "ab")
    outputs = (Output(name="product"), Output(name="above", dtype=np.bool_))
    store = Store(tmp_path / "cheap.zarr", overwrite=True) if where == "store" else None
    found = benchmark.pedantic(
        evaluate,
        args=(cheap, Grid(axes=axes), outputs),
        kwargs={"batch": 2**16, "run": Execution(store=store)},
        rounds=5,
        warmup_rounds=1,
    )
    benchmark.extra_info["cells"] = found["product"].size
