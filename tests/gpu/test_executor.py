"""A sweep on a fake GPU: the same results, in few calls, and one line where it cannot run."""

import functools
import os
import signal
import subprocess
import sys
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rocksteady import (
    Block,
    DimensionlessBlock,
    Execution,
    Harmonic,
    Record,
    Store,
    find_overturning_windows,
    map_attractors,
    map_fates,
    open_store,
    run_ensemble,
)
from rocksteady.basins import SamplingOptions, compute_basin_shares
from rocksteady.dynamics.batch.fates import ends_of
from rocksteady.errors import InputError, UnfinishedError
from rocksteady.gpu import executor as gpu_module
from rocksteady.gpu._nvidia import UNIT
from rocksteady.gpu.executor import LONG, SHORT, TRIED, halves, next_size
from rocksteady.motions import FourierSeries
from rocksteady.risk import Levels
from rocksteady.sweep.cases.task import GROWTH
from rocksteady.sweeps import evaluate
from tests.gpu.fake_gpu import (
    FailedError,
    FakeDriver,
    fake_gpu,
    host_kernels,
    nothing_left,
)
from tests.seismic.grounds import ground
from tests.sweep.executors.callers import tree
from tests.sweep.executors.cases import GRID, OUTPUTS, some

BLOCK = DimensionlessBlock(restitution=0.9)
AXES = {"amplitude": np.linspace(0.5, 4.0, 31), "frequency_ratio": np.linspace(1.0, 6.0, 23)}


@pytest.fixture
def driver(tmp_path_factory: pytest.TempPathFactory) -> Iterator[FakeDriver]:
    with fake_gpu(tmp_path_factory.mktemp("programs")) as driver, nothing_left(driver):
        yield driver


def fates(run: Execution, **more: Any) -> Any:
    return map_fates(BLOCK, axes=AXES, cycles=20, run=run, **more)


def attractors(run: Execution, **more: Any) -> Any:
    return map_attractors(BLOCK, axes=AXES, max_cycles=40, run=run, **more)


@pytest.mark.parametrize("maps", [fates, attractors])
def test_maps_are_those_of_one_thread(maps: Any, driver: FakeDriver) -> None:
    serial = maps(Execution(executor="serial"))
    told: list[int] = []
    result = maps(Execution(executor="gpu", progress=told.append))
    assert result.identical(serial)
    assert sum(told) == 31 * 23
    # A few cells to see whether there is work for it, then all of them.
    assert sum(len(queue) - 2 for *_, queue in driver.launches) >= 31 * 23 + TRIED
    assert driver.calls.count("cuDevicePrimaryCtxSetFlags") == 1


def test_a_store_is_the_same_file_by_file(tmp_path: Path, driver: FakeDriver) -> None:
    for executor in ("threads", "gpu"):
        fates(Execution(executor=executor, store=Store(tmp_path / executor, chunk=50)))
    assert tree(tmp_path / "gpu") == tree(tmp_path / "threads")
    # Chunk by chunk it would be 15 launches.
    assert len(driver.launches) < 5


def test_a_store_is_begun_by_threads_and_finished_by_a_gpu(
    tmp_path: Path, driver: FakeDriver
) -> None:
    whole = fates(Execution(executor="serial"))
    store = tmp_path / "map.zarr"
    seen = 0

    def stop(cells: int) -> None:
        nonlocal seen
        seen += cells
        if seen > 100:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        fates(Execution(executor="serial", store=Store(store, chunk=50), progress=stop))
    finished = int(open_store(store, partial=True).computed.sum())
    assert 0 < finished < whole.sizes["amplitude"] * whole.sizes["frequency_ratio"]
    told: list[int] = []
    resumed = fates(
        Execution(executor="gpu", store=Store(store, resume=True), progress=told.append)
    )
    assert told[0] == finished
    assert sum(told) == 31 * 23
    assert resumed.load().identical(whole)
    assert sum(len(queue) - 2 for *_, queue in driver.launches) == 31 * 23 - finished + TRIED


def test_runs_on_records_are_those_of_one_thread(driver: FakeDriver) -> None:
    blocks = [Block.rectangle(width=0.3, height=height) for height in (1.0, 1.5, 2.0)]
    motions = [
        Record(acceleration_m_s2=each.acceleration_m_s2, dt_s=3.0 * each.dt_s)
        for each in (ground(1), ground(2))
    ]
    results = [
        run_ensemble(
            blocks,
            motions,
            levels=Levels("pga_per_uplift", (0.5, 1.0, 2.0)),
            run=Execution(executor=executor),
        )
        for executor in ("serial", "gpu")
    ]
    assert results[1].identical(results[0])
    assert driver.launches
    assert all(name.endswith("record_fates") for name, *_ in driver.launches)


def test_shares_of_basins_are_those_of_one_thread(driver: FakeDriver) -> None:
    results = [
        compute_basin_shares(
            BLOCK,
            Harmonic(amplitude=2.0, frequency_ratio=3.0),
            "amplitude",
            [1.5, 2.0],
            sampling=SamplingOptions(angles=np.linspace(-1.0, 1.0, 9), velocities=[-0.5, 0.0, 0.5]),
            run=Execution(executor=executor),
        ).to_dataset()
        for executor in ("serial", "gpu")
    ]
    assert results[1].identical(results[0])
    assert driver.launches


def test_several_launches_are_in_flight(tmp_path: Path) -> None:
    kernels = host_kernels()
    usual = kernels["queued_lane_fates"]
    together = threading.Barrier(3, timeout=30.0)

    @functools.wraps(usual)
    def waiting(queue: Any, *rest: Any) -> None:
        if len(queue) - 2 == 50:
            together.wait()
        usual(queue, *rest)

    driver = FakeDriver({**kernels, "queued_lane_fates": waiting})
    axes = {"amplitude": np.linspace(0.5, 4.0, 30), "frequency_ratio": np.linspace(1.0, 6.0, 25)}
    with (
        fake_gpu(tmp_path, driver),
        nothing_left(driver),
        pytest.MonkeyPatch.context() as patch,
    ):
        patch.setattr(gpu_module, "next_size", lambda *_, **__: 50)
        patch.setattr("rocksteady.dynamics.batch.fates.BATCH", 50)
        result = map_fates(BLOCK, axes=axes, cycles=20, run=Execution(executor="gpu"))
    assert driver.most_in_flight == 3
    assert result.identical(
        map_fates(BLOCK, axes=axes, cycles=20, run=Execution(executor="serial"))
    )


@pytest.mark.parametrize("workers", [1, 2])
def test_workers_are_launches_in_flight(workers: int, driver: FakeDriver) -> None:
    fates(Execution(executor="gpu", workers=workers))
    assert driver.calls.count("cuStreamCreate") == workers


def test_where_memory_is_short_a_call_is_split(tmp_path: Path) -> None:
    driver = FakeDriver(host_kernels(), memory=3 * UNIT)
    axes = {"amplitude": np.linspace(0.5, 4.0, 300), "frequency_ratio": np.linspace(1.0, 6.0, 200)}
    with fake_gpu(tmp_path, driver), nothing_left(driver):
        result = map_fates(BLOCK, axes=axes, cycles=2, run=Execution(executor="gpu", workers=1))
    assert result.identical(map_fates(BLOCK, axes=axes, cycles=2, run=Execution(executor="serial")))
    sizes = [len(queue) - 2 for *_, queue in driver.launches]
    assert sum(sizes) == 60_000 + TRIED
    assert max(sizes) * 12 * 8 < 3 * UNIT


def test_where_memory_is_short_even_for_few_cells_there_is_one_line(tmp_path: Path) -> None:
    driver = FakeDriver(host_kernels(), memory=UNIT - 1)
    with fake_gpu(tmp_path, driver), nothing_left(driver):
        refused(UnfinishedError, "the memory of NVIDIA Imaginary does not suffice for 16 cells")


@pytest.mark.parametrize("function", ["cuDevicePrimaryCtxRetain", "cuStreamCreate"])
def test_where_memory_is_short_for_streams_there_is_one_line(
    function: str, driver: FakeDriver
) -> None:
    driver.fail[function] = "CUDA_ERROR_OUT_OF_MEMORY"
    refused(UnfinishedError, "the memory of NVIDIA Imaginary does not suffice for 3 streams")


def refused(kind: type[Exception], words: str, run: Execution | None = None) -> None:
    with pytest.raises(kind) as raised:
        fates(Execution(executor="gpu") if run is None else run)
    assert words in str(raised.value)
    assert "\n" not in str(raised.value)


@pytest.mark.parametrize(
    ("code", "words"),
    [
        ("CUDA_ERROR_ILLEGAL_ADDRESS", "start Python again"),
        ("CUDA_ERROR_LAUNCH_TIMEOUT", "the driver ends long launches on a GPU with a display"),
    ],
)
def test_a_launch_that_fails_leaves_a_store_to_be_resumed(
    code: str, words: str, tmp_path: Path
) -> None:
    driver = FakeDriver(host_kernels())
    usual = driver.kernels["queued_lane_fates"]

    @functools.wraps(usual)
    def failing(queue: Any, *rest: Any) -> None:
        if len(driver.launches) > 3:
            raise FailedError(code)
        usual(queue, *rest)

    driver.kernels["queued_lane_fates"] = failing
    store = Store(tmp_path / "map.zarr", chunk=50)
    with fake_gpu(tmp_path, driver), pytest.MonkeyPatch.context() as patch:
        patch.setattr(gpu_module, "next_size", lambda *_, **__: 50)
        patch.setattr("rocksteady.dynamics.batch.fates.BATCH", 50)
        refused(UnfinishedError, words, Execution(executor="gpu", workers=1, store=store))
    kept = int(open_store(store.path, partial=True).computed.sum())
    assert 0 < kept < 31 * 23
    with fake_gpu(tmp_path):
        result = fates(Execution(executor="gpu", store=Store(store.path, resume=True)))
    assert result.load().identical(fates(Execution(executor="serial")))


def test_an_interruption_waits_for_the_launches_in_flight(tmp_path: Path) -> None:
    store = tmp_path / "map.zarr"

    def interrupt(cells: int) -> None:
        if cells:
            raise KeyboardInterrupt

    with fake_gpu(tmp_path) as driver, nothing_left(driver):
        before = threading.active_count()
        with pytest.raises(KeyboardInterrupt):
            fates(Execution(executor="gpu", store=Store(store, chunk=50), progress=interrupt))
        assert threading.active_count() == before
        result = fates(Execution(executor="gpu", store=Store(store, resume=True)))
    assert result.load().identical(fates(Execution(executor="serial")))


def shaken(a: Any, b: Any) -> Any:
    if (b == 13.0).any():
        raise ZeroDivisionError("as it happens")
    ends_of(
        amplitude=a,
        frequency_ratio=b + 1.0,
        sides=np.tile([1.0, 1.0, 0.9], (len(a), 2, 1)),
        angle=0.0 * a,
        velocity=0.0 * a,
        phase=0.0 * a,
        cycles=2,
        harmonics=(),
    )
    return some(a, b)


KILLED = """
import os, signal, sys
from pathlib import Path
from rocksteady import Execution, Store
from rocksteady.dynamics.batch import fates as fates_module
from rocksteady.gpu import executor as _gpu
from tests.gpu.fake_gpu import fake_gpu
from tests.sweep.executors.test_gpu import fates

left = 200

def kill(cells):
    global left
    left -= cells
    if left < 0:
        os.kill(os.getpid(), signal.SIGKILL)

_gpu.next_size = lambda *_, **__: 50
fates_module.BATCH = 50
folder = Path(sys.argv[1])
with fake_gpu(folder):
    fates(Execution(executor="gpu", store=Store(folder / "gpu", chunk=25), progress=kill))
"""


@pytest.mark.slow
def test_a_store_of_a_run_that_was_killed_is_finished_by_another(tmp_path: Path) -> None:
    command = [sys.executable, "-c", KILLED, str(tmp_path)]
    environment = {**os.environ, "PYTHONPATH": str(Path(__file__).parents[3])}
    killed = subprocess.run(command, env=environment, check=False, timeout=120)
    assert killed.returncode == -signal.SIGKILL
    finished = int(open_store(tmp_path / "gpu", partial=True).computed.sum())
    assert 0 < finished < 31 * 23
    with fake_gpu(tmp_path) as driver:
        fates(Execution(executor="gpu", store=Store(tmp_path / "gpu", resume=True)))
    assert sum(len(queue) - 2 for *_, queue in driver.launches) == 31 * 23 - finished + TRIED
    fates(Execution(executor="threads", store=Store(tmp_path / "threads", chunk=25)))
    assert tree(tmp_path / "gpu") == tree(tmp_path / "threads")


@pytest.mark.usefixtures("driver")
def test_an_error_of_the_case_function_names_its_cells() -> None:
    with pytest.raises(ZeroDivisionError) as raised:
        evaluate(shaken, GRID, OUTPUTS, run=Execution(executor="gpu"))
    assert raised.value.__notes__ == ["in cells 0 to 599 of 600: a 0.1 to 3, b 0 to 19"]


@pytest.mark.usefixtures("driver")
def test_an_error_in_cells_of_several_chunks_names_the_first_of_them(tmp_path: Path) -> None:
    store = Store(tmp_path / "a.zarr", chunk=20)
    with pytest.raises(ZeroDivisionError) as raised:
        evaluate(shaken, GRID, OUTPUTS, run=Execution(executor="gpu", store=store))
    (note,) = raised.value.__notes__
    assert note.startswith("in cells 0 to 19 of 600: a 0.1 to 0.1, b 0 to 19; cells 20 to 39 of")
    assert note.endswith(" and more")


# What a GPU does not compute.


def nothing_of_it() -> Any:
    return evaluate(some, GRID, OUTPUTS, run=Execution(executor="gpu"))


def pulses() -> Any:
    return find_overturning_windows(BLOCK, "one-sine", [1.0, 2.0], run=Execution(executor="gpu"))


def series() -> Any:
    motion = FourierSeries(
        amplitude=1.2, frequency_ratio=4.0, harmonics=((1, 1.0, 0.0), (2, 0.5, 0.0))
    )
    return map_fates(BLOCK, motion, axes=AXES, run=Execution(executor="gpu"))


@pytest.mark.parametrize("call", [nothing_of_it, pulses, series])
def test_what_no_gpu_computes_is_refused(call: Any, driver: FakeDriver) -> None:
    with pytest.raises(InputError) as raised:
        call()
    assert "a GPU computes fates and attractors under harmonic shaking" in str(raised.value)
    assert not driver.launches


def test_what_no_gpu_computes_begins_no_store(tmp_path: Path, driver: FakeDriver) -> None:
    with pytest.raises(InputError, match="leave the executor out for threads"):
        evaluate(some, GRID, OUTPUTS, run=Execution(executor="gpu", store=tmp_path / "a.zarr"))
    assert not (tmp_path / "a.zarr").exists()
    assert not driver.launches


# How many cells a call takes.


def test_calls_grow_until_every_thread_has_cells() -> None:
    full = 100_000
    assert next_size(4096, 1.9 * LONG / 2, full=full, most=10**6) == GROWTH * 4096
    assert next_size(50_000, 0.1, full=full, most=10**6) == full
    assert next_size(full, SHORT / 2, full=full, most=10**6) == 2 * full
    assert next_size(full, (SHORT + LONG) / 2, full=full, most=10**6) == full
    assert next_size(full, 2 * LONG, full=full, most=10**6) == full // 2
    assert next_size(full, SHORT / 2, full=full, most=150_000) == 150_000
    assert next_size(1, 2 * LONG, full=full, most=10**6) == 1


def test_halves_of_jobs_hold_the_same_cells() -> None:
    assert halves([(0, 10)]) == ([(0, 5)], [(5, 10)])
    assert halves([(0, 4), (8, 9), (20, 25)]) == ([(0, 4), (8, 9)], [(20, 25)])
    assert halves([(0, 1), (5, 7)]) == ([(0, 1)], [(5, 7)])
    assert halves([(3, 10), (20, 21)]) == ([(3, 7)], [(7, 10), (20, 21)])
