"""Link an object file and the runtime to a library, by the compiler that is in reach."""

import importlib.util
import shutil
import subprocess
import sys
from pathlib import Path

from rocksteady.kernels.entries import ENTRIES
from rocksteady.kernels.machine_code.library import targets
from rocksteady.kernels.machine_code.sources import sources_hash
from tools.aot.targets import WASM, Target

RUNTIME = Path(__file__).with_name("runtime.c")


class NoCompilerError(Exception):
    """No compiler is in reach that links for a target."""


def link(objects: Path, library: Path, target: Target) -> str:
    """Link a library.

    Parameters
    ----------
    objects
        Object file of the kernels.
    library
        File to write.
    target
        What it is for.

    Returns
    -------
    str
        What linked it.

    Raises
    ------
    NoCompilerError
        If there is neither a C compiler for this machine nor zig.
    subprocess.CalledProcessError
        If it fails; the exception holds what it said.
    """
    compiler = compiler_for(target)
    command = [
        *compiler,
        "-O2",
        f'-DROCKSTEADY_SOURCES="{sources_hash()}"',
        "-o",
        str(library),
        str(objects),
        str(RUNTIME),
        *_options(target),
    ]
    subprocess.run(command, check=True, capture_output=True, text=True)
    return "zig" if "ziglang" in compiler else compiler[0]


def compiler_for(target: Target) -> list[str]:
    """Return the command that compiles C for a target."""
    if target.name in targets():
        for name in ("gcc", "clang", "cc"):
            if shutil.which(name):
                return [name]
    if importlib.util.find_spec("ziglang") is not None:
        return [sys.executable, "-m", "ziglang", "cc", "-target", target.linker]
    raise NoCompilerError(f"{target.name} needs a C compiler: gcc, clang, or the package ziglang")


def _options(target: Target) -> list[str]:
    """Return what a target's linker is told beyond the files."""
    if target.name == WASM:
        names = ["rs_sources", "malloc", "free", *(f"rs_{name}" for name in ENTRIES)]
        return [
            "-mexec-model=reactor",
            "-msimd128",
            "-mbulk-memory",
            "-s",
            "-Wl,-z,stack-size=1048576",
            *(f"-Wl,--export={name}" for name in names),
        ]
    options = ["-shared", "-fvisibility=default", "-s", "-lm"]
    if target.name.startswith("linux"):
        options += ["-fPIC", "-Wl,--no-undefined"]
    return options
