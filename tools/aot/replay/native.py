"""Recorded calls repeated in C, by a program of this machine, or of another under qemu or wine."""

import platform
import shutil
import subprocess
import sys
from pathlib import Path

from rocksteady.kernels.entries import ENTRIES
from rocksteady.kernels.machine_code.sources import sources_hash
from tools.aot.link import RUNTIME
from tools.aot.replay.outcome import MissingProgramError, Repeated, read

SOURCE = Path(__file__).with_name("replay.c")
WINDOWS = "windows"
DIFFERENT = 1
"""Exit status of the program where a value differs."""


def linked(library: Path, program: Path) -> Path:
    """Compile the program for this machine, with a library of kernels that it loads.

    Raises
    ------
    MissingProgramError
        If there is no C compiler.
    """
    compiler = next(filter(None, map(shutil.which, ("gcc", "clang", "cc"))), None)
    if compiler is None:
        raise MissingProgramError("no C compiler: gcc, clang or cc")
    folder = library.resolve().parent
    files = [str(SOURCE), str(library.resolve()), f"-Wl,-rpath,{folder}"]
    return _compiled([compiler], files, program)


def on_windows(library: Path, platform: str, program: Path) -> Path:
    """Compile the program for what zig calls a platform, with a library that lies beside it."""
    zig = [sys.executable, "-m", "ziglang", "cc", "-target", platform]
    return _compiled(zig, [str(SOURCE), str(library)], program)


def standalone(objects: bytes, machine: str, program: Path) -> Path:
    """Compile the program for a Linux machine, with all that it needs inside.

    Parameters
    ----------
    objects
        The kernels, as `tools.aot.emit.emit` returns them.
    machine
        The processor, as "aarch64".
    program
        File to write.
    """
    kernels = program.with_suffix(".o")
    kernels.write_bytes(objects)
    zig = [sys.executable, "-m", "ziglang", "cc", "-target", f"{machine}-linux-musl", "-static"]
    files = [f'-DROCKSTEADY_SOURCES="{sources_hash()}"', str(RUNTIME), str(SOURCE), str(kernels)]
    return _compiled(zig, [*files, "-lm"], program)


def repeat(program: Path, calls: Path, machine: str = platform.machine()) -> list[Repeated]:
    """Repeat the calls of a file that is not compressed.

    Parameters
    ----------
    program
        From `linked`, `on_windows` or `standalone`.
    calls
        The file.
    machine
        The processor that the program is for, or "windows".

    Raises
    ------
    MissingProgramError
        If it is for another processor or system, and qemu or wine is not there.
    """
    command = [str(program), str(calls)]
    if machine != platform.machine():
        found = emulator(machine)
        if found is None:
            missing = "wine" if machine == WINDOWS else f"qemu-{machine}"
            raise MissingProgramError(f"{missing} is not installed")
        command.insert(0, found)
    ran = subprocess.run(command, capture_output=True, text=True, check=False)
    if ran.returncode not in (0, DIFFERENT):
        raise subprocess.CalledProcessError(ran.returncode, command, ran.stdout, ran.stderr)
    return read(ran.stdout)


def emulator(machine: str) -> str | None:
    """Return the program that runs those of another machine; None where it is not installed."""
    if machine == WINDOWS:
        return shutil.which("wine64") or shutil.which("wine")
    return shutil.which(f"qemu-{machine}") or shutil.which(f"qemu-{machine}-static")


def _compiled(compiler: list[str], files: list[str], program: Path) -> Path:
    """Compile the program; the kernels are listed for it."""
    names = " ".join(f"X({name})" for name in ENTRIES)
    # No product and sum are rounded together here either.
    options = ["-O2", "-std=c11", "-Wall", "-Wextra", "-Werror", "-ffp-contract=off"]
    command = [*compiler, *options, f"-DENTRIES={names}", "-o", str(program), *files]
    subprocess.run(command, capture_output=True, text=True, check=True)
    return program
