"""A GPU as a device for kernels: its programs, its memory and the launches on its streams."""

import ctypes
import inspect
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from functools import cache
from pathlib import Path
from threading import Lock
from typing import Any, NamedTuple

from rocksteady.errors import UnfinishedError
from rocksteady.gpu._cuda import (
    OUT_OF_MEMORY,
    THREADS,
    Driver,
    DriverError,
    loaded_driver,
    unusable,
)
from rocksteady.gpu._launch import Launch
from rocksteady.gpu._programs import Capability, program, refuse_capability
from rocksteady.kernels.machine_code.device import DeviceMemoryError, Form, cells_in

BLOCK = 64
"""Threads of a block: the registers of a block are free again when its last thread has ended, so
that small blocks leave room to the next launch soonest."""
UNIT = 2**20
"""Bytes of which memory is taken: a few more cells need no new memory."""
HINTS = {
    "CUDA_ERROR_JIT_COMPILER_NOT_FOUND": "install the driver whole: its library "
    f"nvidia-ptxjitcompiler is missing, or {THREADS}",
    "CUDA_ERROR_LAUNCH_TIMEOUT": "the driver ends long launches on a GPU with a display: use one "
    f"without, or {THREADS}",
    "CUDA_ERROR_UNSUPPORTED_PTX_VERSION": f"update the driver of the GPU, or {THREADS}",
}
"""What to do about an error of the driver."""
ELSE = f"start Python again, or {THREADS}"


class Program(NamedTuple):
    """A kernel that the GPU can launch."""

    function: Any
    most_blocks: int
    """Blocks of the kernel that the GPU can hold at the same time."""


class Gpu:
    """The first GPU that the driver shows, which CUDA_VISIBLE_DEVICES chooses.

    Parameters
    ----------
    driver
        The driver, started.

    Attributes
    ----------
    name
        Of the GPU.
    capability
        Its compute capability, as (9, 0).
    threads
        Fewest threads that it holds at the same time: of kernels that need the most registers.

    Raises
    ------
    InputError
        If it cannot run the kernels.
    """

    def __init__(self, driver: Driver) -> None:
        self._driver = driver
        self._device = driver.call("cuDeviceGet", 0)
        self.name = driver.call("cuDeviceGetName", 256, self._device).split(b"\0")[0].decode()
        attribute = driver.CUdevice_attribute
        self.capability: Capability = (
            self._attribute(attribute.CU_DEVICE_ATTRIBUTE_COMPUTE_CAPABILITY_MAJOR),
            self._attribute(attribute.CU_DEVICE_ATTRIBUTE_COMPUTE_CAPABILITY_MINOR),
        )
        refuse_capability(self.name, self.capability)
        self._multiprocessors = self._attribute(attribute.CU_DEVICE_ATTRIBUTE_MULTIPROCESSOR_COUNT)
        registers = attribute.CU_DEVICE_ATTRIBUTE_MAX_REGISTERS_PER_MULTIPROCESSOR
        self.threads = self._multiprocessors * (self._attribute(registers) // 256)
        self._context: Any = None
        self._programs: dict[str, Program] = {}
        self._lock = Lock()

    def _attribute(self, attribute: Any) -> int:
        return int(self._driver.call("cuDeviceGetAttribute", attribute, self._device))

    def __repr__(self) -> str:
        return f"{self.name}, compute capability {'.'.join(map(str, self.capability))}"

    @contextmanager
    def stream(self) -> Iterator["Stream"]:
        """Yield a stream, whose memory is given back at the end.

        Raises
        ------
        UnfinishedError
            If the GPU fails.
        """
        with self.checked():
            self.enter()
            flag = int(self._driver.CUstream_flags.CU_STREAM_NON_BLOCKING)
            stream = Stream(self, self._driver, self._driver.call("cuStreamCreate", flag))
        try:
            yield stream
        finally:
            with suppress(DriverError):  # after a failure every call fails
                self.enter()
                stream.close()

    def enter(self) -> None:
        """Make the context of the GPU that of this thread."""
        with self._lock:
            if self._context is None:
                # A thread that waits for a launch sleeps, and leaves the processor to others.
                flag = int(self._driver.CUctx_flags.CU_CTX_SCHED_BLOCKING_SYNC)
                with suppress(DriverError):  # where another package has a context already
                    self._driver.call("cuDevicePrimaryCtxSetFlags", self._device, flag)
                self._context = self._driver.call("cuDevicePrimaryCtxRetain", self._device)
        self._driver.call("cuCtxSetCurrent", self._context)

    def program(self, kernel: Callable[..., object]) -> Program:
        """Return a kernel that can be launched, loaded by its first call.

        Raises
        ------
        InputError
            If this installation has no program of it.
        """
        name = kernel.__name__
        with self._lock:
            if name not in self._programs:
                self._programs[name] = self._loaded(name, program(name, self.capability))
            return self._programs[name]

    def _loaded(self, name: str, path: Path) -> Program:
        call = self._driver.call
        module = call("cuModuleLoadData", path.read_bytes() + b"\0")
        function = call("cuModuleGetFunction", module, f"rs_{name}".encode())
        blocks = call("cuOccupancyMaxActiveBlocksPerMultiprocessor", function, BLOCK, 0)
        return Program(function, blocks * self._multiprocessors)

    @contextmanager
    def checked(self) -> Iterator[None]:
        """Raise an error of the driver as what a caller can do about it.

        Raises
        ------
        DeviceMemoryError
            If the memory of the GPU does not suffice.
        UnfinishedError
            If anything else has failed.
        """
        try:
            yield
        except DriverError as error:
            if error.code == OUT_OF_MEMORY:
                raise DeviceMemoryError(self.name) from error
            raise UnfinishedError(
                "executor",
                "gpu",
                f"{self.name} has failed: {error}",
                f"{HINTS.get(error.code, ELSE)}; a store can be resumed",
            ) from error


class Stream:
    """A stream of a GPU: a device that does one call after another.

    Each call copies its arguments to the GPU, launches a kernel, and copies the results back.
    Several streams overlap: one copies while another computes.  Memory is kept for the next call.

    Attributes
    ----------
    calls
        Number of calls so far.
    """

    def __init__(self, gpu: Gpu, driver: Driver, stream: Any) -> None:
        self._gpu = gpu
        self._driver = driver
        self._stream = stream
        self._arguments = Memory(driver, "cuMemAlloc", "cuMemFree")
        self._room = Memory(driver, "cuMemAlloc", "cuMemFree")
        # Memory that the system does not move: only its copies overlap with launches.
        self._staging = Memory(driver, "cuMemAllocHost", "cuMemFreeHost")
        self._lock = Lock()  # of the thread that uses the memory
        self._closed = False
        self.calls = 0

    def run(self, form: Form, arguments: tuple[Any, ...]) -> None:
        """Do the work of a host kernel, as `Device.run` says."""
        self.calls += 1
        kernel = inspect.unwrap(form.queued)
        with self._lock, self._gpu.checked():
            if self._closed:
                raise RuntimeError("this stream is closed")
            self._gpu.enter()
            loaded = self._gpu.program(kernel)
            cells = cells_in(arguments)
            if not cells:
                return
            blocks = min(loaded.most_blocks, -(-cells // BLOCK))
            launch = Launch(kernel, form, arguments, workers=blocks * BLOCK)
            self._launch(loaded, launch, blocks)

    def _launch(self, loaded: Program, launch: Launch, blocks: int) -> None:
        call = self._driver.call
        device = self._arguments.of(launch.size)
        room = self._room.of(launch.room_size)
        staging = self._staging.of(launch.size)
        launch.write(staging, device, room)
        call("cuMemcpyHtoDAsync", device, staging, launch.size, self._stream)
        call(
            "cuLaunchKernel",
            loaded.function,
            *(blocks, 1, 1),
            *(BLOCK, 1, 1),
            0,  # bytes of shared memory
            self._stream,
            ((device,), (ctypes.c_void_p,)),
            0,
        )
        first, size = launch.results
        call("cuMemcpyDtoHAsync", staging + first, device + first, size, self._stream)
        call("cuStreamSynchronize", self._stream)
        launch.read(staging)

    def close(self) -> None:
        """Give back the memory and the stream, when the call of another thread has ended.

        An interruption of what waits for the threads comes here while they still compute.
        """
        with self._lock:
            self._closed = True
            self._driver.call("cuStreamSynchronize", self._stream)  # what an interruption has left
            for memory in (self._arguments, self._room, self._staging):
                memory.free()
            self._driver.call("cuStreamDestroy", self._stream)


class Memory:
    """Memory that grows and is used again.

    Parameters
    ----------
    driver
        The driver.
    take, give_back
        Names of its functions.
    """

    def __init__(self, driver: Driver, take: str, give_back: str) -> None:
        self._driver = driver
        self._take = take
        self._give_back = give_back
        self._memory: Any = None
        self._size = 0

    def of(self, size: int) -> int:
        """Return the address of memory of at least a size in bytes."""
        if size > self._size:
            self.free()
            units = -(-size // UNIT) * UNIT
            self._memory = self._driver.call(self._take, units)
            self._size = units
        return int(self._memory or 0)

    def free(self) -> None:
        """Give it back."""
        if self._memory is not None:
            memory, self._memory, self._size = self._memory, None, 0
            self._driver.call(self._give_back, memory)


@cache
def gpu() -> Gpu:
    """Return the GPU of this process, found at the first call.

    Raises
    ------
    InputError
        If there is none that can run the kernels.
    """
    driver = loaded_driver()
    try:
        return Gpu(driver)
    except DriverError as error:
        raise unusable(error) from error
