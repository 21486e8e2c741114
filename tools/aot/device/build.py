"""Build what a device runs, and the emulation of it."""

import hashlib
import time
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from functools import cache
from pathlib import Path

from rocksteady.gpu._programs import sources_of
from rocksteady.kernels.devices import COLD, FORMS
from rocksteady.kernels.machine_code.library import checksum_file
from rocksteady.kernels.machine_code.sources import sources_hash, unchanged
from rocksteady.sweep.cases.queue import usable_cores
from tools.aot.build import LOWERED, ChangedError, lowered, publish, tools_hash
from tools.aot.device.emit import emit, headed
from tools.aot.device.emulate import NAME, compile_program
from tools.aot.device.program import OLDEST, VERSIONS, program, voting


def build(folder: Path, architectures: Sequence[str] = tuple(VERSIONS)) -> list[Path]:
    """Build the PTX of every kernel that a device runs into a folder; return the files.

    What is current there stays.

    Raises
    ------
    ChangedError
        If the sources change in the meantime.
    ProgramError
        If a kernel needs what a device does not have.
    """
    files = {
        (each, name): file_of(folder, each, name) for each in architectures for name in queued()
    }
    missing = sorted({name for (_, name), file in files.items() if not is_current(file)})
    if missing:
        start = time.perf_counter()
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        _lowered()
        with ProcessPoolExecutor(min(usable_cores(), len(missing))) as processes:
            texts = dict(zip(missing, processes.map(ptx, missing), strict=True))
        if not unchanged():
            raise ChangedError("the kernels were changed while they were compiled: build again")
        for (architecture, name), file in files.items():
            if name in texts:
                publish(file, headed(texts[name], architecture).encode("ascii"), device_tools())
        size = sum(map(len, texts.values())) / 1e6
        took = time.perf_counter() - start
        what = f"{len(texts)} kernels for {' and '.join(architectures)}"
        print(f"  {what}: {size:.1f} MB of PTX each, {took:.0f} s", flush=True)
    return list(files.values())


def file_of(folder: Path, architecture: str, kernel: str) -> Path:
    """Return the file of a kernel for an architecture, as "sm_90"."""
    return folder / f"rocksteady-{architecture}-{kernel}.ptx"


def is_current(file: Path) -> bool:
    """Return whether a file of PTX is whole, and these tools made it, of these sources."""
    try:
        noted = checksum_file(file).read_text("ascii").split()
        whole = hashlib.sha256(file.read_bytes()).hexdigest()
    except (OSError, ValueError):
        return False
    return noted == [whole, device_tools()] and sources_of(file) == sources_hash()


def ptx(kernel: str) -> str:
    """Return the PTX of a kernel for the oldest architecture."""
    return emit(voting(device_program()), kernel, OLDEST)


def emulation() -> Path:
    """Return the library that emulates a device here; build it first if that is to be done.

    Raises
    ------
    LinkError
        If no compiler is in reach.
    """
    file = LOWERED / f"{sources_hash()}-{device_tools()}" / NAME
    if not file.is_file():
        file.parent.mkdir(parents=True, exist_ok=True)
        scratch = file.with_suffix(".tmp")
        compile_program(device_program(), scratch)
        scratch.replace(file)
    return file


@cache
def device_program() -> str:
    """Return the program of these sources of the kernels."""
    return program(_lowered(), COLD)


def _lowered() -> bytes:
    return lowered(("tools.aot.device.lower",), "device", device_tools())


@cache
def device_tools() -> str:
    """Return a hash of what makes programs of devices."""
    return f"{tools_hash()}-{tools_hash(Path(__file__).parent)}"


def queued() -> list[str]:
    """Return the names of the kernels that a device runs."""
    return sorted(form.queued.__name__ for form in FORMS.values())
