"""The CUDA driver in memory: its functions, as cuda-python has them, over a GPU of NumPy arrays.

What is submitted to a stream is done when the stream is synchronized, not before, and fresh memory
holds no zeros.  A launch runs a kernel on the host, or a function of the test, over the arrays to
which its cells point.
"""

import ctypes
import itertools
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from enum import IntEnum
from types import SimpleNamespace
from typing import Any

import numpy as np

from rocksteady.installation._recorded import arguments_of
from rocksteady.kernels.machine_code._cuda import Driver
from rocksteady.kernels.machine_code.library import DTYPES, cells_of
from rocksteady.kernels.machine_code.types import signature_of

GARBAGE = 0xAB


class CUresult(IntEnum):
    CUDA_SUCCESS = 0
    CUDA_ERROR_INVALID_VALUE = 1
    CUDA_ERROR_OUT_OF_MEMORY = 2
    CUDA_ERROR_NOT_INITIALIZED = 3
    CUDA_ERROR_STUB_LIBRARY = 34
    CUDA_ERROR_NO_DEVICE = 100
    CUDA_ERROR_INVALID_CONTEXT = 201
    CUDA_ERROR_JIT_COMPILER_NOT_FOUND = 221
    CUDA_ERROR_UNSUPPORTED_PTX_VERSION = 222
    CUDA_ERROR_NOT_FOUND = 500
    CUDA_ERROR_ILLEGAL_ADDRESS = 700
    CUDA_ERROR_LAUNCH_TIMEOUT = 702
    CUDA_ERROR_SYSTEM_DRIVER_MISMATCH = 803


OK = CUresult.CUDA_SUCCESS
ATTRIBUTES = SimpleNamespace(
    CU_DEVICE_ATTRIBUTE_MULTIPROCESSOR_COUNT=16,
    CU_DEVICE_ATTRIBUTE_COMPUTE_CAPABILITY_MAJOR=75,
    CU_DEVICE_ATTRIBUTE_COMPUTE_CAPABILITY_MINOR=76,
    CU_DEVICE_ATTRIBUTE_MAX_REGISTERS_PER_MULTIPROCESSOR=82,
)
HOST = "host memory"
DEVICE = "memory of the GPU"


class DriverInMemory:
    """The functions of `cuda.bindings.driver` that the package calls, in their order of arguments.

    Parameters
    ----------
    kernels
        What a launch runs, by the name of the queued kernel: a Python function of its signature.
    name, capability, gpus
        Of the GPU, and how many there are.
    multiprocessors, memory
        Of it, and bytes of its memory.

    Attributes
    ----------
    fail
        Error that a function returns, by its name.
    calls
        Names of the functions called, in order.
    launches
        Name, workers and queue (as it was submitted) of each launch.
    """

    CUdevice_attribute = ATTRIBUTES
    CUstream_flags = SimpleNamespace(CU_STREAM_NON_BLOCKING=1)
    CUctx_flags = SimpleNamespace(CU_CTX_SCHED_BLOCKING_SYNC=4)

    def __init__(
        self,
        kernels: dict[str, Callable[..., None]] | None = None,
        *,
        name: str = "NVIDIA Imaginary",
        capability: tuple[int, int] = (9, 0),
        gpus: int = 1,
        multiprocessors: int = 2,
        memory: int = 2**40,
    ) -> None:
        self.kernels = kernels or {}
        self.name = name
        self.capability = capability
        self.gpus = gpus
        self.multiprocessors = multiprocessors
        self.memory = memory
        self.fail: dict[str, CUresult] = {}
        self.calls: list[str] = []
        self.launches: list[tuple[str, int, list[int]]] = []
        self.flags: list[int] = []
        self.most_in_flight = 0
        self._lock = threading.Lock()
        self._handles = itertools.count(1)
        self._signatures: dict[str, Callable[..., None]] = {}
        self._functions: dict[int, str] = {}
        self._blocks: dict[int, tuple[str, Any, int]] = {}
        self._streams: dict[int, list[Callable[[], CUresult]]] = {}
        self._contexts: dict[int, int] = {}
        self._broken = OK
        self._in_flight = 0

    def __getattribute__(self, name: str) -> Any:
        attribute = object.__getattribute__(self, name)
        if not name.startswith("cu") or name == "cuGetErrorString":
            return attribute

        def checked(*arguments: Any) -> Any:
            with self._lock:
                self.calls.append(name)
            if self._broken:
                return (self._broken,)
            if name in self.fail:
                return (self.fail[name],)
            needs = name not in BEFORE_CONTEXTS
            if needs and threading.get_ident() not in self._contexts:
                return (CUresult.CUDA_ERROR_INVALID_CONTEXT,)
            return attribute(*arguments)

        return checked

    # What is left: nothing may be, when all streams are closed.

    @property
    def taken(self) -> dict[str, int]:
        """Bytes of each kind that are taken."""
        sums = {HOST: 0, DEVICE: 0}
        for kind, _, size in self._blocks.values():
            sums[kind] += size
        return sums

    @property
    def streams(self) -> int:
        return len(self._streams)

    # The functions.

    def cuGetErrorString(self, error: CUresult) -> Any:
        return OK, error.name.lower().removeprefix("cuda_error_").replace("_", " ").encode()

    def cuInit(self, Flags: int) -> Any:
        assert Flags == 0
        return (OK,)

    def cuDeviceGetCount(self) -> Any:
        return OK, self.gpus

    def cuDeviceGet(self, ordinal: int) -> Any:
        return OK, ordinal

    def cuDeviceGetName(self, length: int, dev: int) -> Any:
        assert dev == 0
        return OK, self.name.encode().ljust(length, b"\0")

    def cuDeviceGetAttribute(self, attrib: int, dev: int) -> Any:
        assert dev == 0
        return OK, {16: self.multiprocessors, 75: self.capability[0], 76: self.capability[1]}.get(
            attrib, 65_536
        )

    def cuDevicePrimaryCtxSetFlags(self, dev: int, flags: int) -> Any:
        assert dev == 0
        self.flags.append(flags)
        return (OK,)

    def cuDevicePrimaryCtxRetain(self, dev: int) -> Any:
        assert dev == 0
        return OK, 77

    def cuCtxSetCurrent(self, ctx: int) -> Any:
        assert ctx == 77
        self._contexts[threading.get_ident()] = ctx
        return (OK,)

    def cuModuleLoadData(self, image: bytes) -> Any:
        assert image.startswith(b"// rocksteady kernels ")
        assert image.endswith(b"\0")
        return OK, image

    def cuModuleGetFunction(self, hmod: bytes, name: bytes) -> Any:
        if b".visible .entry " + name + b"(" not in hmod:
            return (CUresult.CUDA_ERROR_NOT_FOUND,)
        handle = next(self._handles)
        self._functions[handle] = name.decode().removeprefix("rs_")
        return OK, handle

    def cuOccupancyMaxActiveBlocksPerMultiprocessor(
        self, func: int, blockSize: int, dynamicSMemSize: int
    ) -> Any:
        assert func in self._functions
        assert blockSize % 32 == dynamicSMemSize == 0
        return OK, 2

    def cuStreamCreate(self, Flags: int) -> Any:
        assert Flags == 1
        handle = next(self._handles)
        self._streams[handle] = []
        return OK, handle

    def cuStreamDestroy(self, hStream: int) -> Any:
        del self._streams[hStream]
        return (OK,)

    def cuMemAlloc(self, bytesize: int) -> Any:
        return self._take(DEVICE, bytesize, self.memory)

    def cuMemFree(self, dptr: int) -> Any:
        return self._give_back(DEVICE, dptr)

    def cuMemAllocHost(self, bytesize: int) -> Any:
        return self._take(HOST, bytesize, 2**40)

    def cuMemFreeHost(self, p: int) -> Any:
        return self._give_back(HOST, p)

    def cuMemcpyHtoDAsync(self, dstDevice: int, srcHost: int, ByteCount: int, hStream: int) -> Any:
        return self._submit(hStream, self._copied(DEVICE, dstDevice, HOST, srcHost, ByteCount))

    def cuMemcpyDtoHAsync(self, dstHost: int, srcDevice: int, ByteCount: int, hStream: int) -> Any:
        return self._submit(hStream, self._copied(HOST, dstHost, DEVICE, srcDevice, ByteCount))

    def cuLaunchKernel(
        self,
        f: int,
        gridDimX: int,
        gridDimY: int,
        gridDimZ: int,
        blockDimX: int,
        blockDimY: int,
        blockDimZ: int,
        sharedMemBytes: int,
        hStream: int,
        kernelParams: Any,
        extra: int,
    ) -> Any:
        assert (gridDimY, gridDimZ, blockDimY, blockDimZ, sharedMemBytes, extra) == (
            1,
            1,
            1,
            1,
            0,
            0,
        )
        assert 0 < gridDimX <= 2 * self.multiprocessors
        ((address,), (kind,)) = kernelParams
        assert kind is ctypes.c_void_p
        name, workers = self._functions[f], gridDimX * blockDimX
        return self._submit(hStream, lambda: self._launched(name, workers, address))

    def cuStreamSynchronize(self, hStream: int) -> Any:
        with self._lock:
            self._in_flight += 1
            self.most_in_flight = max(self.most_in_flight, self._in_flight)
        try:
            for work in self._streams[hStream]:
                code = work()
                if code:
                    self._broken = code  # as after an error of a launch every call fails
                    return (code,)
        finally:
            self._streams[hStream].clear()
            with self._lock:
                self._in_flight -= 1
        return (OK,)

    # How it is done.

    def _take(self, kind: str, size: int, most: int) -> Any:
        with self._lock:
            if self.taken[kind] + size > most:
                return (CUresult.CUDA_ERROR_OUT_OF_MEMORY,)
            block = (ctypes.c_uint8 * size)()
            ctypes.memset(block, GARBAGE, size)
            self._blocks[ctypes.addressof(block)] = kind, block, size
            return OK, ctypes.addressof(block)

    def _give_back(self, kind: str, address: int) -> Any:
        with self._lock:
            assert self._blocks.pop(address)[0] == kind
        return (OK,)

    def _check(self, kind: str, address: int, size: int) -> None:
        with self._lock:
            blocks = dict(self._blocks)
        assert any(
            mine == kind and first <= address and address + size <= first + whole
            for first, (mine, _, whole) in blocks.items()
        ), f"{size} bytes at {address:#x} are not {kind}"

    def _submit(self, stream: int, work: Callable[[], CUresult]) -> Any:
        self._streams[stream].append(work)
        return (OK,)

    def _copied(
        self, kind: str, to: int, other: str, source: int, size: int
    ) -> Callable[[], CUresult]:
        self._check(kind, to, size)
        self._check(other, source, size)

        def copy() -> CUresult:
            ctypes.memmove(to, source, size)
            return OK

        return copy

    def _launched(self, name: str, workers: int, address: int) -> CUresult:
        kernel = self.kernels[name]
        signature = signature_of(kernel)
        cells = cells_of(signature.leaves)
        self._check(DEVICE, address, cells.size)
        values = iter(cells.unpack((ctypes.c_char * cells.size).from_address(address)))
        arguments: list[Any] = []
        for leaf in signature.leaves:
            first = next(values)
            if not leaf.dimensions:
                arguments.append(first)
                continue
            shape = tuple(next(values) for _ in range(leaf.dimensions))
            dtype = DTYPES[leaf.kind]
            size = int(np.prod(shape)) * dtype.itemsize
            self._check(DEVICE, first, size)
            assert first % dtype.itemsize == 0
            memory: Any = (ctypes.c_char * size).from_address(first)
            arguments.append(np.ndarray(shape, dtype, memory))
        with self._lock:
            self.launches.append((name, workers, arguments[0].tolist()))
        try:
            kernel(*arguments_of(kernel, arguments))
        except LaunchFailedError as failure:
            return failure.code
        return OK


class LaunchFailedError(Exception):
    """What a kernel of a test raises for the launch to fail."""

    def __init__(self, code: CUresult) -> None:
        super().__init__(code)
        self.code = code


BEFORE_CONTEXTS = {
    "cuInit",
    "cuDeviceGetCount",
    "cuDeviceGet",
    "cuDeviceGetName",
    "cuDeviceGetAttribute",
    "cuDevicePrimaryCtxSetFlags",
    "cuDevicePrimaryCtxRetain",
    "cuCtxSetCurrent",
}
FUNCTIONS = sorted(name for name in vars(DriverInMemory) if name.startswith("cu"))


def driver_of(memory: DriverInMemory) -> Driver:
    return Driver(memory)


@contextmanager
def nothing_left(memory: DriverInMemory) -> Iterator[None]:
    """Check that all memory and streams are given back."""
    yield
    assert memory.taken == {HOST: 0, DEVICE: 0}
    assert memory.streams == 0
