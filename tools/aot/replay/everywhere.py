"""Targets that run on this machine, and how recorded calls are repeated on each."""

import functools
import platform
import shutil
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

from filelock import FileLock

from rocksteady.installation._recorded import Call, differences, replayed, save
from rocksteady.kernels.entries import ENTRIES
from rocksteady.kernels.machine_code.compilation import Kernel
from rocksteady.kernels.machine_code.library import Library, library, targets
from rocksteady.kernels.machine_code.sources import sources_hash
from tools.aot.build import LOWERED, build, lowered, tools_hash
from tools.aot.emit import emit
from tools.aot.link import compilers
from tools.aot.replay import native, wasm
from tools.aot.replay.outcome import MissingProgramError, Repeated
from tools.aot.targets import PAGE, TARGETS, WASM

ARM = "linux-aarch64"
UNDER_WINE = "windows-x86-64-v3"


def built_here() -> Path:
    """Return the folder of what is built on this machine, the WebAssembly modules included.

    Raises
    ------
    MissingProgramError
        If there is no library, or what links the modules is not installed.
    """
    found = library()
    if found is None:
        raise MissingProgramError("no library of kernels is built here: `make library` builds it")
    if not compilers(TARGETS[WASM]):
        raise MissingProgramError("the package ziglang, which links the modules, is not installed")
    folder = LOWERED / f"{sources_hash()}-{tools_hash()}"
    folder.mkdir(parents=True, exist_ok=True)
    with FileLock(folder / "module.lock"):
        shutil.copyfile(found.path, folder / found.path.name)
        page = found.path.with_name(TARGETS[PAGE].file)
        if page.is_file():
            shutil.copyfile(page, folder / page.name)
        missing = [name for name in (WASM, PAGE) if not (folder / TARGETS[name].file).is_file()]
        build(missing, folder)
    return folder


def by_library(target: str, built: Path, calls: list[Call]) -> list[Repeated]:
    """Repeat calls in this process by the library of one CPU level."""
    if target not in targets():
        raise MissingProgramError(f"this processor runs nothing for {target}")
    library = Library(built / TARGETS[target].file, target)
    found = []
    for call in calls:
        kernel = _entry(library, ENTRIES[call.entry])
        compared, differing, _ = differences(call, replayed(call, kernel))
        found.append(Repeated(call.entry, compared, differing))
    return found


def in_c(built: Path, calls: list[Call]) -> list[Repeated]:
    """Repeat calls by a program in C with the library of this processor."""
    target = next(iter(targets()), None)
    if target is None:
        raise MissingProgramError("no library is built for this processor")
    with tempfile.TemporaryDirectory() as folder:
        program = native.linked(built / TARGETS[target].file, Path(folder, "replay"))
        return native.repeat(program, _written(calls, folder))


def on_arm(built: Path, calls: list[Call]) -> list[Repeated]:
    """Repeat calls on a 64-bit ARM, which qemu makes of another processor."""
    program = built / f"replay-{ARM}"
    if platform.machine() != "aarch64" and not native.emulator("aarch64"):
        raise MissingProgramError("qemu-aarch64 is not installed")
    if not program.is_file():
        native.standalone(emit(lowered(), TARGETS[ARM]), "aarch64", program)
    with tempfile.TemporaryDirectory() as folder:
        return native.repeat(program, _written(calls, folder), "aarch64")


def under_wine(built: Path, calls: list[Call]) -> list[Repeated]:
    """Repeat calls by a program for Windows, with the library of one CPU level."""
    if native.emulator(native.WINDOWS) is None:
        raise MissingProgramError("wine is not installed")
    target = TARGETS[UNDER_WINE]
    program = native.on_windows(built / target.file, target.linker, built / "replay.exe")
    with tempfile.TemporaryDirectory() as folder:
        return native.repeat(program, _written(calls, folder), native.WINDOWS)


def in_wasm(
    repeat: Callable[[Path, Path], list[Repeated]], built: Path, calls: list[Call]
) -> list[Repeated]:
    """Repeat calls by the WebAssembly module, in node or in a browser."""
    with tempfile.TemporaryDirectory() as folder:
        return repeat(built / TARGETS[WASM].file, _written(calls, folder))


def in_wasmtime(built: Path, calls: list[Call]) -> list[Repeated]:
    """Repeat calls by the WebAssembly module in wasmtime."""
    return wasm.in_wasmtime(built / TARGETS[WASM].file, calls)


RUNS: dict[str, Callable[[Path, list[Call]], list[Repeated]]] = {
    **{
        target: functools.partial(by_library, target)
        for target in TARGETS
        if target.startswith("linux-x86")
    },
    "C": in_c,
    ARM: on_arm,
    UNDER_WINE: under_wine,
    "node": functools.partial(in_wasm, wasm.in_node),
    "Chromium": functools.partial(in_wasm, wasm.in_browser),
    "wasmtime": in_wasmtime,
}
"""What repeats calls, given the folder of what `tools.aot` has built; by name."""


def _entry(library: Library, kernel: Any) -> Callable[..., Any]:
    """Return what calls a kernel in a library, with the annotations of the kernel."""
    function = kernel.py_func if isinstance(kernel, Kernel) else kernel
    found = library.entry(function)
    if found is None:
        raise KeyError(f"{library.path} does not hold {function.__name__}")
    return functools.wraps(function)(found)


def _written(calls: list[Call], folder: str) -> Path:
    """Write calls to a file as every replay reads it; return the file."""
    file = Path(folder, "calls")
    save(file, calls, compress=False)
    return file
