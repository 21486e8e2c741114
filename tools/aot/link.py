"""Link an object file and the runtime to a library, by the compiler that is in reach."""

import importlib.util
import shutil
import subprocess
import sys
from pathlib import Path

from rocksteady.kernels.machine_code.library import targets
from rocksteady.kernels.machine_code.sources import sources_hash
from tools.aot.targets import Target

RUNTIME = Path(__file__).with_name("runtime.c")


class LinkError(Exception):
    """No compiler is in reach that links for a target."""


def link(objects: Path, library: Path, target: Target, *, elsewhere: bool = False) -> str:
    """Link a library.

    Parameters
    ----------
    objects
        Object file of the kernels.
    library
        File to write.
    target
        What it is for.
    elsewhere
        Whether it is for other machines too, so that it must not need what this one has.

    Returns
    -------
    str
        What linked it.

    Raises
    ------
    LinkError
        If there is neither a C compiler for the target nor zig, or if none of them does it.
    """
    files = [f'-DROCKSTEADY_SOURCES="{sources_hash()}"', str(objects), str(RUNTIME)]
    said = ""
    for name, compiler in compilers(target, elsewhere=elsewhere).items():
        command = [*compiler, "-O2", "-o", str(library), *files, *_options(target)]
        done = subprocess.run(command, check=False, capture_output=True, text=True)
        if done.returncode == 0:
            return name
        said += f"; {name} says: {(done.stderr.strip().splitlines() or ['nothing'])[-1]}"
    needed = "a C compiler that links for it: gcc, clang or the package ziglang"
    raise LinkError(f"{target.name} needs {needed}{said}")


def compilers(target: Target, *, elsewhere: bool = False) -> dict[str, list[str]]:
    """Return what can compile and link C for a target, by name, the first choice first.

    zig alone links for the oldest C library that will do, and not for the one of this machine.
    """
    found = {}
    if target.name in targets() and not elsewhere:
        found = {name: [name] for name in ("gcc", "clang", "cc") if shutil.which(name)}
    if importlib.util.find_spec("ziglang") is not None:
        found["zig"] = [sys.executable, "-m", "ziglang", "cc", "-target", target.linker]
    elif zig := shutil.which("zig"):
        found["zig"] = [zig, "cc", "-target", target.linker]
    return found


def _options(target: Target) -> list[str]:
    """Return what a target's linker is told beyond the files."""
    if target.static:
        names = ["rs_sources", "malloc", "free", *(f"rs_{name}" for name in target.entries)]
        return [
            "-nostdlib",
            "-fno-builtin",
            "-msimd128",
            "-mbulk-memory",
            "-s",
            "-Wl,--no-entry",
            "-Wl,-z,stack-size=1048576",
            *(f"-Wl,--export={name}" for name in names),
        ]
    options = ["-shared", "-fvisibility=default", "-s"]
    if target.name.startswith("linux"):
        options += ["-fPIC", "-Wl,--no-undefined"]
    if target.name.startswith("windows"):
        options += ["-nostdlib", "-lkernel32"]
    if target.name.startswith("macos"):  # without a name it holds the folder it was linked in
        options += [f"-Wl,-install_name,@rpath/{target.file}"]
    return options
