"""Rocking spectra: 100 sizes and 5 slendernesses on a record of 54 s, elapsed time on all cores."""

import time
from typing import Any

import numpy as np
import pytest

from rocksteady import BaseMotion, Record, Status, compute_rocking_spectrum
from rocksteady.model.equations import Linear, Nonlinear
from tests.records import synthetic

GUIDES = {Linear(): 0.5, Nonlinear(): 3.0}


@pytest.mark.parametrize("vertical", [False, True], ids=["", "vertical"])
@pytest.mark.parametrize("model", GUIDES, ids=[model.name for model in GUIDES])
@pytest.mark.benchmark(group="spectra", timer=time.perf_counter)
def test_spectrum(benchmark: Any, model: Any, vertical: bool) -> None:
    if isinstance(model, Linear) and vertical:
        pytest.skip("its equations have no term for it")
    rng = np.random.default_rng(1940)
    record, up = (
        Record(acceleration_m_s2=synthetic(rng, 5400, 0.01, peak), dt_s=0.01) for peak in (3.4, 2.0)
    )
    found = benchmark.pedantic(
        compute_rocking_spectrum,
        args=(BaseMotion(record, up if vertical else None),),
        kwargs={
            "alpha": np.linspace(0.1, 0.3, 5),
            "periods_s": np.linspace(0.5, 8.0, 100),
            "model": model,
        },
        rounds=5,
        warmup_rounds=1,
    )
    benchmark.extra_info["blocks"] = found.status.size
    benchmark.extra_info["overturned"] = int((found.status == Status.OVERTURNED).sum())
    benchmark.extra_info["guide"] = GUIDES[model]
