"""What launches kernels and times them: the GPU, or its emulation on this processor."""

import ctypes
import inspect
import os
import shutil
import subprocess
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Protocol

from rocksteady.gpu._cuda import Driver, DriverError, loaded_driver
from rocksteady.gpu._launch import Launch
from rocksteady.gpu._nvidia import BLOCK, Gpu, Memory
from rocksteady.gpu._programs import program
from rocksteady.kernels.devices import Form
from rocksteady.kernels.machine_code.device import cells_in

ASKED = "name,driver_version,clocks.sm,clocks.max.sm,clocks.mem,temperature.gpu,power.draw"
"""What `nvidia-smi` is asked where it is."""


@dataclass(frozen=True, kw_only=True)
class Timing:
    """Seconds of one call: on the device alone, by its own clock, and with all that belongs to it.

    The latter holds the order of the cells, the copies in and out, and the wait.
    """

    kernel: float
    whole: float


@dataclass(frozen=True, kw_only=True)
class Loaded:
    """A program as the driver has compiled it.

    Attributes
    ----------
    seconds
        What the driver took to compile it for the GPU.
    registers, stack
        Of one thread: registers, and bytes of local memory.
    resident
        Threads that the whole GPU holds at the same time.
    function
        What is launched.
    """

    seconds: float
    registers: int
    stack: int
    resident: int
    function: Any = None


class Bench(Protocol):
    """A device that times its calls."""

    emulated: bool

    def facts(self) -> dict[str, Any]:
        """Return what the figures depend on."""
        ...

    def load(
        self, kernel: Callable[..., object], *, block: int = BLOCK, registers: int = 0
    ) -> Loaded:
        """Compile a queued kernel, with at most so many registers a thread if they are given."""
        ...

    def launch(
        self, form: Form, arguments: tuple[Any, ...], *, block: int = BLOCK, registers: int = 0
    ) -> Timing:
        """Do the work of a host kernel once."""
        ...


class OnGpu:
    """The first GPU that the driver shows.

    The driver keeps no compiled program from an earlier process, so that what compiling takes is
    seen, unless CUDA_CACHE_DISABLE is set to 0.

    Raises
    ------
    InputError
        If there is none that can run the kernels.
    """

    emulated = False

    def __init__(self) -> None:
        os.environ.setdefault("CUDA_CACHE_DISABLE", "1")
        self._driver: Driver = loaded_driver()
        self._gpu = Gpu(self._driver)
        self._gpu.enter()
        self._device = self._driver.call("cuDeviceGet", 0)
        flag = int(self._driver.CUstream_flags.CU_STREAM_NON_BLOCKING)
        self._stream = self._driver.call("cuStreamCreate", flag)
        self._begin, self._end = (self._driver.call("cuEventCreate", 0) for _ in range(2))
        self._memory = Memory(self._driver, "cuMemAlloc", "cuMemFree")
        self._room = Memory(self._driver, "cuMemAlloc", "cuMemFree")
        self._staging = Memory(self._driver, "cuMemAllocHost", "cuMemFreeHost")
        self._compiled: dict[tuple[str, int], tuple[float, Any]] = {}

    def _attribute(self, name: str) -> int:
        attribute = getattr(self._driver.CUdevice_attribute, f"CU_DEVICE_ATTRIBUTE_{name}")
        return int(self._driver.call("cuDeviceGetAttribute", attribute, self._device))

    def facts(self) -> dict[str, Any]:
        """Return the GPU's name, its driver, clocks and sizes, and what `nvidia-smi` says."""
        facts: dict[str, Any] = {
            "name": self._gpu.name,
            "capability": ".".join(map(str, self._gpu.capability)),
            "driver": int(self._driver.call("cuDriverGetVersion")),
            "multiprocessors": self._attribute("MULTIPROCESSOR_COUNT"),
            "clock_mhz": self._attribute("CLOCK_RATE") / 1e3,
            "memory_clock_mhz": self._attribute("MEMORY_CLOCK_RATE") / 1e3,
        }
        if shutil.which("nvidia-smi"):
            command = ["nvidia-smi", f"--query-gpu={ASKED}", "--format=csv,noheader", "-i", "0"]
            done = subprocess.run(command, capture_output=True, text=True, check=False)
            values = [value.strip() for value in done.stdout.split(",")]
            facts["nvidia_smi"] = dict(zip(ASKED.split(","), values, strict=False))
        return facts

    def load(
        self, kernel: Callable[..., object], *, block: int = BLOCK, registers: int = 0
    ) -> Loaded:
        """Compile a queued kernel once; block and registers as in `launch`."""
        name = inspect.unwrap(kernel).__name__
        key = name, registers
        if key not in self._compiled:
            self._compiled[key] = self._compile(name, registers)
        seconds, function = self._compiled[key]
        call, kind = self._driver.call, self._driver.CUfunction_attribute
        blocks = call("cuOccupancyMaxActiveBlocksPerMultiprocessor", function, block, 0)
        return Loaded(
            seconds=seconds,
            registers=int(call("cuFuncGetAttribute", kind.CU_FUNC_ATTRIBUTE_NUM_REGS, function)),
            stack=int(
                call("cuFuncGetAttribute", kind.CU_FUNC_ATTRIBUTE_LOCAL_SIZE_BYTES, function)
            ),
            resident=blocks * block * self._attribute("MULTIPROCESSOR_COUNT"),
            function=function,
        )

    def _compile(self, name: str, registers: int) -> tuple[float, Any]:
        """Return the seconds that the driver took to compile a program, and what is launched."""
        call, options, values = self._driver.call, list[Any](), list[Any]()
        if registers:
            options.append(self._driver.CUjit_option.CU_JIT_MAX_REGISTERS)
            values.append(registers)
        text = program(name, self._gpu.capability).read_bytes() + b"\0"
        began = time.perf_counter()
        module = call("cuModuleLoadDataEx", text, len(options), options, values)
        function = call("cuModuleGetFunction", module, f"rs_{name}".encode())
        return time.perf_counter() - began, function

    def launch(
        self, form: Form, arguments: tuple[Any, ...], *, block: int = BLOCK, registers: int = 0
    ) -> Timing:
        """Do the work of a host kernel once, in blocks of so many threads.

        Raises
        ------
        DriverError
            If the driver refuses a call, as one with too many threads for the registers.
        """
        call = self._driver.call
        loaded = self.load(form.queued, block=block, registers=registers)
        if not loaded.resident:
            raise DriverError("CUDA_ERROR_LAUNCH_OUT_OF_RESOURCES", f"{block} threads a block")
        began = time.perf_counter()
        cells = cells_in(arguments)
        blocks = min(loaded.resident // block, -(-cells // block))
        kernel = inspect.unwrap(form.queued)
        launch = Launch(kernel, form, arguments, workers=blocks * block)
        device, room = self._memory.of(launch.size), self._room.of(launch.room_size)
        staging = self._staging.of(launch.size)
        launch.write(staging, device, room)
        call("cuMemcpyHtoDAsync", device, staging, launch.size, self._stream)
        call("cuEventRecord", self._begin, self._stream)
        call(
            "cuLaunchKernel",
            loaded.function,
            *(blocks, 1, 1),
            *(block, 1, 1),
            0,
            self._stream,
            ((device,), (ctypes.c_void_p,)),
            0,
        )
        call("cuEventRecord", self._end, self._stream)
        first, size = launch.results
        call("cuMemcpyDtoHAsync", staging + first, device + first, size, self._stream)
        call("cuStreamSynchronize", self._stream)
        launch.read(staging)
        whole = time.perf_counter() - began
        kernel_ms = call("cuEventElapsedTime", self._begin, self._end)
        return Timing(kernel=float(kernel_ms) / 1e3, whole=whole)


class OnProcessor:
    """The emulation of a device: the same programs, compiled for this processor."""

    emulated = True

    def __init__(self) -> None:
        from tools.aot.device.build import emulation
        from tools.aot.device.emulate import Emulated

        self.device: Any = Emulated(emulation(), workers=2)

    def facts(self) -> dict[str, Any]:
        """Return that it is no GPU."""
        return {"name": "emulated on this processor", "capability": "", "multiprocessors": 0}

    def load(
        self, kernel: Callable[..., object], *, block: int = BLOCK, registers: int = 0
    ) -> Loaded:
        """Return what stands for a program: nothing is compiled."""
        assert callable(kernel), block
        return Loaded(seconds=0.0, registers=registers, stack=0, resident=2)

    def launch(
        self, form: Form, arguments: tuple[Any, ...], *, block: int = BLOCK, registers: int = 0
    ) -> Timing:
        """Do the work of a host kernel once; threads of a block and registers change nothing."""
        assert min(block, registers + 1) > 0
        began = time.perf_counter()
        self.device.run(form, arguments)
        seconds = time.perf_counter() - began
        return Timing(kernel=seconds, whole=seconds)
