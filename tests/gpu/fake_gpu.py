"""A GPU that is none: the functions of the driver over memory of this process, in one object.

Work on a stream is done when the stream is synchronized, and fresh memory holds no zeros.  A launch
runs a Python function of the queued kernel's signature over the arrays to which its cells point.
"""

import ctypes
import functools
import itertools
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from rocksteady.gpu import _cuda as driver_module
from rocksteady.gpu import _programs as programs
from rocksteady.gpu._nvidia import gpu
from rocksteady.installation._recorded import arguments_of
from rocksteady.kernels.devices import FORMS
from rocksteady.kernels.entries import ENTRIES
from rocksteady.kernels.machine_code.device import Form
from rocksteady.kernels.machine_code.library import DTYPES, cells_of
from rocksteady.kernels.machine_code.sources import sources_hash
from rocksteady.kernels.machine_code.types import signature_of

HOST, DEVICE = "host memory", "memory of the GPU"
ANY_THREAD = ("cuInit", "cuDevice", "cuCtx")
"""Beginnings of functions that need no context."""


class Code:
    """What the driver returns first: the name of an error, none for success."""

    def __init__(self, name: str = "") -> None:
        self.name = name

    def __int__(self) -> int:
        return int(bool(self.name))


class FailedError(Exception):
    """A call or a launch fails, by the name of an error."""


class FakeDriver:
    """The functions of `cuda.bindings.driver` that the package calls.

    Parameters
    ----------
    kernels
        What a launch runs, by the name of the queued kernel.
    name, capability, gpus, memory
        Of the GPU; how many there are; bytes of its memory.

    Attributes
    ----------
    fail
        Name of the error that a function returns, by its name.
    calls
        Names of the functions called, in order.
    launches
        Name, workers and queue (as it was submitted) of each launch.
    blocks
        Kind and memory of what is taken, by address.
    """

    CUstream_flags = SimpleNamespace(CU_STREAM_NON_BLOCKING=1)
    CUctx_flags = SimpleNamespace(CU_CTX_SCHED_BLOCKING_SYNC=4)

    def __init__(
        self,
        kernels: dict[str, Callable[..., None]] | None = None,
        *,
        name: str = "NVIDIA Imaginary",
        capability: tuple[int, int] = (9, 0),
        gpus: int = 1,
        memory: int = 2**40,
    ) -> None:
        self.kernels = kernels or {}
        self.memory = memory
        self.fail: dict[str, str] = {}
        self.calls: list[str] = []
        self.launches: list[tuple[str, int, list[int]]] = []
        self.blocks: dict[int, tuple[str, Any]] = {}
        self.streams: dict[int, list[Callable[[], object]]] = {}
        self.most_in_flight = 0
        self.answers: dict[str, Any] = {
            "cuInit": None,
            "cuDeviceGetCount": gpus,
            "cuDeviceGet": 0,
            "cuDeviceGetName": name.encode() + b"\0\0",
            "cuDevicePrimaryCtxRetain": 77,
            "cuOccupancyMaxActiveBlocksPerMultiprocessor": 2,
        }
        self.CUdevice_attribute = SimpleNamespace(  # an attribute is its own value
            CU_DEVICE_ATTRIBUTE_MULTIPROCESSOR_COUNT=2,
            CU_DEVICE_ATTRIBUTE_COMPUTE_CAPABILITY_MAJOR=capability[0],
            CU_DEVICE_ATTRIBUTE_COMPUTE_CAPABILITY_MINOR=capability[1],
            CU_DEVICE_ATTRIBUTE_MAX_REGISTERS_PER_MULTIPROCESSOR=65_536,
        )
        self._broken = ""
        self._threads: set[int] = set()
        self._numbers = itertools.count(1)
        self._in_flight = 0

    def __getattr__(self, name: str) -> Any:
        if not name.startswith("cu"):
            raise AttributeError(name)
        return functools.partial(self._call, name)

    def _call(self, name: str, *arguments: Any) -> Any:
        self.calls.append(name)
        code = self._broken or self.fail.get(name, "")
        if not name.startswith(ANY_THREAD) and threading.get_ident() not in self._threads:
            code = code or "CUDA_ERROR_INVALID_CONTEXT"
        if code:
            return (Code(code),)
        try:
            if name in self.answers:
                return Code(), self.answers[name]
            return Code(), getattr(self, f"_{name}")(*arguments)
        except FailedError as error:
            return (Code(str(error)),)

    def cuGetErrorString(self, code: Code) -> Any:
        return Code(), code.name.lower().removeprefix("cuda_error_").replace("_", " ").encode()

    def _cuDeviceGetAttribute(self, attribute: int, device: int) -> int:
        assert device == 0
        return attribute

    def _cuDevicePrimaryCtxSetFlags(self, device: int, flags: int) -> None:
        assert (device, flags) == (0, 4)  # a thread that waits for a launch sleeps

    def _cuCtxSetCurrent(self, context: int) -> None:
        assert context == 77
        self._threads.add(threading.get_ident())

    def _cuModuleLoadData(self, image: bytes) -> bytes:
        assert image.endswith(b"\0")
        return image

    def _cuModuleGetFunction(self, module: bytes, name: bytes) -> str:
        assert b".visible .entry " + name + b"(" in module
        return name.decode().removeprefix("rs_")

    def _cuStreamCreate(self, flag: int) -> int:
        assert flag == 1
        stream = next(self._numbers)
        self.streams[stream] = []
        return stream

    def _cuStreamDestroy(self, stream: int) -> None:
        del self.streams[stream]

    def _cuMemAlloc(self, size: int) -> int:
        if self.taken[DEVICE] + size > self.memory:
            raise FailedError("CUDA_ERROR_OUT_OF_MEMORY")
        return self._take(DEVICE, size)

    def _cuMemAllocHost(self, size: int) -> int:
        return self._take(HOST, size)

    def _take(self, kind: str, size: int) -> int:
        block = (ctypes.c_uint8 * size)()
        ctypes.memset(block, 0xAB, size)
        self.blocks[ctypes.addressof(block)] = kind, block
        return ctypes.addressof(block)

    def _cuMemFree(self, address: int) -> None:
        assert self.blocks.pop(address)[0] == DEVICE

    def _cuMemFreeHost(self, address: int) -> None:
        assert self.blocks.pop(address)[0] == HOST

    @property
    def taken(self) -> dict[str, int]:
        """Bytes of each kind that are taken."""
        blocks = list(self.blocks.values())
        return {kind: sum(len(b) for own, b in blocks if own == kind) for kind in (HOST, DEVICE)}

    def _cuMemcpyHtoDAsync(self, to: int, source: int, size: int, stream: int) -> None:
        self._copy((DEVICE, to), (HOST, source), size, stream)

    def _cuMemcpyDtoHAsync(self, to: int, source: int, size: int, stream: int) -> None:
        self._copy((HOST, to), (DEVICE, source), size, stream)

    def _copy(self, to: tuple[str, int], source: tuple[str, int], size: int, stream: int) -> None:
        for kind, address in (to, source):
            self._check(kind, address, size)
        self.streams[stream].append(lambda: ctypes.memmove(to[1], source[1], size))

    def _check(self, kind: str, address: int, size: int) -> None:
        """Fail where memory does not lie in one piece of its kind."""
        blocks = list(self.blocks.items())
        assert any(
            own == kind and first <= address and address + size <= first + len(block)
            for first, (own, block) in blocks
        ), f"{size} bytes at {address:#x} are not {kind}"

    def _cuLaunchKernel(
        self, name: str, blocks: int, y: int, z: int, threads: int, *rest: Any
    ) -> None:
        *shape, shared, stream, parameters, extra = rest
        assert (y, z, *shape, shared, extra) == (1, 1, 1, 1, 0, 0)
        assert 0 < blocks <= 4
        ((address,), (kind,)) = parameters
        assert kind is ctypes.c_void_p
        self.streams[stream].append(lambda: self._launch(name, blocks * threads, address))

    def _launch(self, name: str, workers: int, address: int) -> None:
        kernel = self.kernels[name]
        signature = signature_of(kernel)
        cells = cells_of(signature.leaves)
        self._check(DEVICE, address, cells.size)
        values = iter(cells.unpack((ctypes.c_char * cells.size).from_address(address)))
        arguments: list[Any] = []
        for leaf in signature.leaves:
            value = next(values)
            if leaf.dimensions:
                shape = tuple(next(values) for _ in range(leaf.dimensions))
                size = int(np.prod(shape)) * DTYPES[leaf.kind].itemsize
                self._check(DEVICE, value, size)
                memory: Any = (ctypes.c_char * size).from_address(value)
                value = np.ndarray(shape, DTYPES[leaf.kind], memory)
            arguments.append(value)
        self.launches.append((name, workers, arguments[0].tolist()))
        kernel(*arguments_of(kernel, arguments))

    def _cuStreamSynchronize(self, stream: int) -> None:
        self._in_flight += 1
        self.most_in_flight = max(self.most_in_flight, self._in_flight)
        try:
            for work in self.streams[stream]:
                work()
        except FailedError as error:
            self._broken = str(error)  # as after an error of a launch every call fails
            raise
        finally:
            self.streams[stream].clear()
            self._in_flight -= 1


@contextmanager
def nothing_left(driver: FakeDriver) -> Iterator[None]:
    """Check that all memory and streams are given back."""
    yield
    assert not driver.blocks
    assert not driver.streams


def on_host(form: Form, host: Any) -> Callable[..., None]:
    """Return a function of the signature of a queued kernel that does its work by the host's."""
    count = host.py_func.__code__.co_argcount

    @functools.wraps(form.queued)
    def launched(queue: Any, *rest: Any) -> None:
        cells = queue[2:]
        assert queue[:2].tolist() == [0, 0]
        assert np.array_equal(np.sort(cells), np.arange(len(cells)))
        queue[0] = len(cells)
        for shape, room in zip(form.room, rest, strict=False):
            assert room.shape[1:] == shape
            room[...] = np.nan
        host(*rest[-count:])  # after the room, and what workers share

    return launched


def host_kernels() -> dict[str, Callable[..., None]]:
    """Return what a launch runs, by the name of the queued kernel."""
    # Several forms of one host kernel, for the linear and the nonlinear model, have longer names.
    hosts = {name: ENTRIES.get(name) or ENTRIES[name.removeprefix("nonlinear_")] for name in FORMS}
    return {form.queued.__name__: on_host(form, hosts[name]) for name, form in FORMS.items()}


def write_program(folder: Path, architecture: tuple[int, int], kernel: str, sources: str) -> Path:
    """Write what a fake driver takes for the program of a kernel."""
    path = folder / programs.file_name(architecture, kernel)
    entry = f".visible .entry rs_{kernel}(.param .u64 cells)"
    path.write_text(f"// rocksteady kernels {sources}\n{entry}\n", encoding="ascii")
    return path


@contextmanager
def fake_gpu(folder: Path, driver: FakeDriver | None = None) -> Iterator[FakeDriver]:
    """Have this process see a fake GPU, with programs of all its kernels in a folder."""
    driver = FakeDriver(host_kernels()) if driver is None else driver
    for name in driver.kernels or host_kernels():
        write_program(folder, (8, 0), name, sources_hash())
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(driver_module, "_bindings", lambda: driver)
        patch.setattr(programs, "brought_folders", lambda: [folder])
        patch.setattr(programs, "libraries_folder", lambda: folder / "none")
        gpu.cache_clear()
        try:
            yield driver
        finally:
            gpu.cache_clear()
