"""Risk: an ensemble and a table of objects, on all cores."""

import functools
import time
from typing import Any

import numpy as np
import pytest

from rocksteady import Block, assess_objects, run_ensemble
from rocksteady.motions import make_synthetic_suite
from rocksteady.risk import DescribedObject, Levels, Peaks, RestitutionBand

RECORDS = 56
risk_benchmark = pytest.mark.benchmark(group="risk", timer=time.perf_counter)


@functools.cache
def ensemble() -> Any:
    """Return 56 motions at 20 levels with 10 restitutions, both signs."""
    return run_ensemble(
        Block.rectangle(width=0.32, height=1.8),
        make_synthetic_suite(RECORDS),
        levels=Levels("p_pgv_per_uplift", np.geomspace(0.15, 3.0, 20), beside=()),
        restitution=RestitutionBand(draws=10),
    )


@risk_benchmark
def test_ensemble(benchmark: Any) -> None:
    found = benchmark.pedantic(ensemble.__wrapped__, rounds=3, warmup_rounds=1)
    benchmark.extra_info["what"] = f"ensemble of {found.status.size:,} runs, both signs"
    benchmark.extra_info["count"] = found.status.size
    benchmark.extra_info["aim"] = "aim 30 s"


@risk_benchmark
def test_table(benchmark: Any) -> None:
    rng = np.random.default_rng(22)
    heights = rng.uniform(0.4, 2.4, 1000)
    sizes = zip((heights * rng.uniform(0.1, 0.4, 1000)).tolist(), heights.tolist(), strict=True)
    objects = [
        DescribedObject(values={"name": f"{k}", "geometry": {"width_m": width, "height_m": height}})
        for k, (width, height) in enumerate(sizes)
    ]
    suite = make_synthetic_suite(RECORDS)
    options = {"demand": Peaks(pga_g=0.35, pgv_m_s=0.4)}
    benchmark.pedantic(assess_objects, args=(objects, suite), kwargs=options, rounds=1)
    benchmark.extra_info["what"] = f"1,000 objects on {RECORDS} motions at one level"
    benchmark.extra_info["count"] = len(objects)
    benchmark.extra_info["aim"] = "aim 45 s"
