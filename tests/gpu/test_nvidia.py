"""A fake GPU as a device: launches, memory that is used again, and failures."""

import functools
import threading
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest

from rocksteady.errors import InputError, UnfinishedError
from rocksteady.gpu._nvidia import BLOCK, UNIT, Stream, gpu
from rocksteady.kernels.machine_code.device import DeviceMemoryError
from rocksteady.kernels.machine_code.types import Floats1, Floats2, Integers1
from tests.gpu.fake_gpu import FakeDriver, fake_gpu, nothing_left


class Squares(NamedTuple):
    status: Integers1
    squares: Floats2


def queued_squares(queue: Integers1, room: Floats2, values: Floats1, found: Squares) -> None:
    """Square values, through a row of the room."""
    for cell in queue[2:]:
        room[cell % len(room), :] = values[cell]
        found.squares[cell] = room[cell % len(room), 0] * values[cell]
        found.status[cell] = len(room)


@dataclass(frozen=True)
class Form:
    queued: Any = queued_squares
    room: tuple[tuple[int, ...], ...] = ((5,),)
    shared: Any = None
    length: Any = None


FORM = Form()


def squares(stream: Stream, cells: int) -> tuple[Any, Any]:
    values, status = np.linspace(0.0, 3.0, cells), np.zeros(cells, dtype=np.int64)
    result = np.full((cells, 2), 9.0)
    stream.run(FORM, (values, Squares(status, result)))
    assert np.array_equal(result, np.stack([values * values] * 2, axis=1))
    return status, result


@pytest.fixture
def driver(tmp_path: Path) -> Iterator[FakeDriver]:
    driver = FakeDriver({"queued_squares": queued_squares})
    with fake_gpu(tmp_path, driver), nothing_left(driver):
        yield driver


@pytest.mark.parametrize(
    ("cells", "workers"), [(1, BLOCK), (BLOCK, BLOCK), (BLOCK + 1, 2 * BLOCK), (1000, 4 * BLOCK)]
)
def test_a_launch_has_as_many_workers_as_there_are_cells_or_the_gpu_holds(
    cells: int, workers: int, driver: FakeDriver
) -> None:
    with gpu().stream() as stream:
        status, _ = squares(stream, cells)
    assert (status == workers).all()
    assert driver.launches == [("queued_squares", workers, [0, 0, *range(cells)])]


def test_without_cells_the_program_is_loaded_and_nothing_is_launched(
    driver: FakeDriver,
) -> None:
    with gpu().stream() as stream:
        squares(stream, 0)
        assert stream.calls == 1
    assert driver.calls.count("cuModuleLoadData") == 1
    assert not driver.launches


def test_programs_and_memory_are_kept_for_the_next_call(driver: FakeDriver) -> None:
    with gpu().stream() as first, gpu().stream() as second:
        for stream in (first, second):
            for cells in (1000, 3, 1500):
                squares(stream, cells)
    assert driver.calls.count("cuModuleLoadData") == 1
    assert driver.calls.count("cuMemAlloc") == 4
    assert driver.calls.count("cuMemAllocHost") == 2
    assert driver.calls.count("cuDevicePrimaryCtxRetain") == 1


def test_memory_grows_by_whole_units(driver: FakeDriver) -> None:
    with gpu().stream() as stream:
        squares(stream, 10)
        taken = driver.taken
        squares(stream, 100_000)
        more = driver.taken
    assert set(taken.values()) == {UNIT, 2 * UNIT}
    assert all(size % UNIT == 0 for size in more.values())
    assert more["host memory"] == 4 * UNIT  # queue, values, status and squares: 40 bytes a cell


def test_memory_that_does_not_suffice_can_be_tried_with_fewer_cells(tmp_path: Path) -> None:
    driver = FakeDriver({"queued_squares": queued_squares}, memory=3 * UNIT)
    with fake_gpu(tmp_path, driver), nothing_left(driver), gpu().stream() as stream:
        squares(stream, 1000)
        with pytest.raises(DeviceMemoryError, match="the memory of NVIDIA Imaginary does not"):
            squares(stream, 100_000)
        squares(stream, 50_000)


LINES = {
    "CUDA_ERROR_ILLEGAL_ADDRESS": (
        "executor = 'gpu' is not finished: NVIDIA Imaginary has failed: "
        "CUDA_ERROR_ILLEGAL_ADDRESS (illegal address); start Python again, or leave the executor "
        "out for threads; a store can be resumed"
    ),
    "CUDA_ERROR_LAUNCH_TIMEOUT": (
        "executor = 'gpu' is not finished: NVIDIA Imaginary has failed: "
        "CUDA_ERROR_LAUNCH_TIMEOUT (launch timeout); the driver ends long launches on a GPU with a "
        "display: use one without, or leave the executor out for threads; a store can be resumed"
    ),
    "CUDA_ERROR_JIT_COMPILER_NOT_FOUND": (
        "executor = 'gpu' is not finished: NVIDIA Imaginary has failed: "
        "CUDA_ERROR_JIT_COMPILER_NOT_FOUND (jit compiler not found); install the driver whole: its "
        "library nvidia-ptxjitcompiler is missing, or leave the executor out for threads; a store "
        "can be resumed"
    ),
    "CUDA_ERROR_UNSUPPORTED_PTX_VERSION": (
        "executor = 'gpu' is not finished: NVIDIA Imaginary has failed: "
        "CUDA_ERROR_UNSUPPORTED_PTX_VERSION (unsupported ptx version); update the driver of the "
        "GPU, or leave the executor out for threads; a store can be resumed"
    ),
}


@pytest.mark.parametrize("code", LINES)
@pytest.mark.parametrize(
    "function",
    ["cuModuleLoadData", "cuMemcpyHtoDAsync", "cuLaunchKernel", "cuStreamSynchronize"],
)
def test_a_failure_is_one_line(code: str, function: str, driver: FakeDriver) -> None:
    with gpu().stream() as stream:
        driver.fail[function] = code
        with pytest.raises(UnfinishedError) as raised:
            squares(stream, 5)
        del driver.fail[function]
    assert str(raised.value) == LINES[code]


@pytest.mark.parametrize("function", ["cuDevicePrimaryCtxRetain", "cuStreamCreate"])
def test_a_gpu_that_fails_at_once_is_one_line(function: str, driver: FakeDriver) -> None:
    driver.fail[function] = "CUDA_ERROR_NOT_INITIALIZED"
    with pytest.raises(UnfinishedError, match="CUDA_ERROR_NOT_INITIALIZED"), gpu().stream():
        raise AssertionError


def test_another_package_may_have_chosen_how_to_wait(driver: FakeDriver) -> None:
    driver.fail["cuDevicePrimaryCtxSetFlags"] = "CUDA_ERROR_INVALID_VALUE"
    with gpu().stream() as stream:
        squares(stream, 5)


def test_after_a_failure_a_stream_is_closed_without_another_error(tmp_path: Path) -> None:
    driver = FakeDriver({"queued_squares": queued_squares})
    with fake_gpu(tmp_path, driver), gpu().stream() as stream:
        for function in ("cuLaunchKernel", "cuMemFree", "cuCtxSetCurrent"):
            driver.fail[function] = "CUDA_ERROR_ILLEGAL_ADDRESS"
        with pytest.raises(UnfinishedError):
            squares(stream, 5)


@pytest.mark.usefixtures("driver")
def test_a_gpu_has_a_name_and_a_capability() -> None:
    assert repr(gpu()) == "NVIDIA Imaginary, compute capability 9.0"
    assert gpu().threads == 2 * 256
    assert gpu() is gpu()


def test_a_gpu_that_is_too_old_is_refused(tmp_path: Path) -> None:
    driver = FakeDriver(name="Tesla T4", capability=(7, 5))
    with (
        fake_gpu(tmp_path, driver),
        pytest.raises(InputError, match=r"Tesla T4 has compute capability 7\.5"),
    ):
        gpu()


@pytest.mark.usefixtures("driver")
def test_a_kernel_without_a_program_is_named() -> None:
    def queued_cubes(queue: Integers1, found: Squares) -> None:
        raise NotImplementedError

    with (
        gpu().stream() as stream,
        pytest.raises(InputError, match="the GPU program of queued_cubes is not in this"),
    ):
        stream.run(Form(queued_cubes, ()), (np.zeros((1, 3), dtype=np.int64),))


def test_a_stream_is_closed_when_the_call_of_another_thread_has_ended(tmp_path: Path) -> None:
    began, to_end, ended = threading.Event(), threading.Event(), threading.Event()

    @functools.wraps(queued_squares)
    def slow(*arguments: Any) -> None:
        began.set()
        to_end.wait(30.0)
        queued_squares(*arguments)
        ended.set()

    driver = FakeDriver({"queued_squares": slow})
    with (
        fake_gpu(tmp_path, driver),
        nothing_left(driver),
        ThreadPoolExecutor(1) as threads,
    ):
        with gpu().stream() as stream:
            call = threads.submit(squares, stream, 5)
            began.wait(30.0)
            threading.Timer(0.2, to_end.set).start()
        assert ended.is_set()
        call.result()
        with pytest.raises(RuntimeError, match="closed"):
            squares(stream, 5)
