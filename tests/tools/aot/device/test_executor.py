"""`executor="gpu"` over a fake driver, whose launches run the program of a device."""

import ctypes
import functools
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rocksteady import (
    Block,
    DimensionlessBlock,
    Execution,
    Linear,
    Nonlinear,
    Record,
    map_attractors,
    map_fates,
    run_ensemble,
)
from rocksteady.kernels.devices import FORMS
from rocksteady.kernels.machine_code.library import caller
from rocksteady.risk import Levels
from tests.gpu.fake_gpu import FakeDriver, fake_gpu, nothing_left
from tests.seismic.grounds import ground
from tools.aot.device.emulate import Emulated
from tools.aot.device.program import ENTRY

AXES = {"amplitude": np.linspace(0.5, 4.0, 31), "frequency_ratio": np.linspace(1.0, 6.0, 23)}
ALIKE = DimensionlessBlock(restitution=0.9)
BODY = Block.rectangle(width=0.4, height=1.6)
UNLIKE = Block.asymmetric(left=0.25, right=0.4, height=2.4)
BLOCKS = [Block.rectangle(width=0.3, height=height) for height in (1.0, 1.5, 2.0, 2.5)]
RECORDS = [
    Record(acceleration_m_s2=ground(seed).acceleration_m_s2, dt_s=0.06) for seed in (1, 2, 3)
]


@pytest.fixture
def driver(emulated: Emulated, tmp_path: Path) -> Iterator[FakeDriver]:
    library = ctypes.CDLL(str(emulated.library))
    names = [form.queued.__name__ for form in FORMS.values()]
    functions = [form.queued.py_func for form in FORMS.values()]
    pairs = zip(names, functions, strict=True)
    driver = FakeDriver({name: on_threads(function, library) for name, function in pairs})
    with fake_gpu(tmp_path, driver), nothing_left(driver):
        yield driver


def on_threads(function: Callable[..., Any], library: ctypes.CDLL) -> Callable[..., None]:
    """Return a function that runs a kernel of a library as four workers."""
    address = library[f"{ENTRY}{function.__name__}"]
    address.argtypes, address.restype = [ctypes.c_void_p], ctypes.c_int32
    call = caller(function, address)

    @functools.wraps(function)
    def launched(*arguments: Any) -> None:
        with ThreadPoolExecutor(4) as threads:
            for worker in [threads.submit(call, *arguments) for _ in range(4)]:
                worker.result()

    return launched


def fates(block: Any, model: Any) -> Callable[[Execution], Any]:
    return lambda run: map_fates(block, axes=AXES, cycles=20, model=model, run=run)


def attractors(block: Any, model: Any, cycles: int) -> Callable[[Execution], Any]:
    return lambda run: map_attractors(block, axes=AXES, max_cycles=cycles, model=model, run=run)


def ensemble(model: Any) -> Callable[[Execution], Any]:
    levels = Levels("pga_per_uplift", (0.5, 1.0, 2.0, 3.0))
    return lambda run: run_ensemble(BLOCKS, RECORDS, levels=levels, model=model, run=run)


CASES = {
    "queued_lane_fates": fates(ALIKE, None),
    "queued_nonlinear_lane_fates": fates(BODY, Nonlinear()),
    "queued_lane_attractors": attractors(ALIKE, None, 200),
    "queued_settle_cells": attractors(UNLIKE, Linear(), 100),
    "queued_nonlinear_lane_attractors": attractors(BODY, Nonlinear(), 30),
    "queued_nonlinear_settle_cells": attractors(UNLIKE, Nonlinear(), 30),
    "queued_record_fates": ensemble(Linear()),
    "queued_nonlinear_record_fates": ensemble(Nonlinear()),
}


@pytest.mark.slow
@pytest.mark.parametrize("kernel", CASES)
def test_a_sweep_on_a_device_has_the_bits_of_one_on_the_processor(
    kernel: str, driver: FakeDriver
) -> None:
    serial = CASES[kernel](Execution(executor="serial"))
    result = CASES[kernel](Execution(executor="gpu"))
    assert result.identical(serial)
    assert kernel in {name for name, *_ in driver.launches}
