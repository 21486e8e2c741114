"""``python -m tools.aot``: build libraries of the kernels.

``host`` builds the one that this machine runs and the module of the explorer's page, into the
folder in which the package looks for them, unless they are there; ``build`` builds those of any
targets into a folder.
"""

import argparse
import os
import sys
import time
from collections.abc import Sequence
from pathlib import Path

from rocksteady.errors import MissingKernelsError
from rocksteady.explorer.module import page_module, prune
from rocksteady.kernels.machine_code.library import (
    built_folder,
    checksum_file,
    library,
    make_built_folder,
    targets,
)
from tools.aot.build import ChangedError, build, tools_hash
from tools.aot.link import LinkError, compilers
from tools.aot.targets import PAGE, TARGETS


def main(arguments: list[str] | None = None) -> int:
    """Run a command; return its exit status."""
    parser = argparse.ArgumentParser(prog="python -m tools.aot", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    commands.add_parser("host", help="build the library of this machine and the explorer's module")
    many = commands.add_parser("build", help="build the libraries of targets")
    many.add_argument("--out", type=Path, required=True, help="folder to write them into")
    many.add_argument("--targets", nargs="+", choices=TARGETS, default=list(TARGETS))
    lowering = commands.add_parser("lower", help="write the lowered kernels alone")
    lowering.add_argument("file", type=Path)
    given = parser.parse_args(arguments)
    if given.command == "lower":
        return _lower(given.file)
    if given.command == "build":
        try:
            build(given.targets, given.out, elsewhere=True)
        except (ChangedError, LinkError, OSError) as error:
            print(f"python -m tools.aot: {error}", file=sys.stderr)
            return 1
        return 0
    return _host()


def _host() -> int:
    """Build the library of this machine's processor and the module of the page, where missing.

    Where the library cannot be built, numba compiles kernels when they are first called, and
    without the module there is no page: no failure.
    """
    found = library()
    if found is not None and _is_current(found.path):
        print(f"library of kernels: {found.path}")
    else:
        _make("library of kernels", targets()[:1], "numba compiles on first use")
    try:
        module: Path | None = page_module()
    except MissingKernelsError:
        module = None
    if module is not None and _is_current(module):
        print(f"module of the explorer: {module}")
    else:
        _make("module of the explorer", (PAGE,), "`rocksteady explore` cannot run here")
    return 0


def _make(what: str, names: Sequence[str], without: str) -> None:
    """Build targets into the folder of this machine, or print why not and what it means."""
    reason = _obstacle(names)
    if reason is None:
        print(
            f"Compiling the {what}, once for each version of the kernels' sources (about a\n"
            f"minute)\n  into {built_folder()}",
            flush=True,
        )
        try:
            build(names, built_folder())
            prune()
        except (ChangedError, LinkError, OSError) as error:
            reason = str(error)
    if reason is not None:
        print(f"no {what}: {reason}; {without}", file=sys.stderr)


def _is_current(library: Path) -> bool:
    """Return whether a library was built by these tools, or came with a wheel."""
    if library.parent != built_folder():
        return True
    return checksum_file(library).read_text("ascii").split()[1:] == [tools_hash()]


def _obstacle(names: Sequence[str]) -> str | None:
    """Return why targets cannot be built here; None where they can."""
    if not names:
        return "none is made for this platform"
    if not all(compilers(TARGETS[name]) for name in names):
        needed = "the package ziglang" if PAGE in names else "gcc, clang or the package ziglang"
        return f"it needs a C compiler: {needed}"
    return make_built_folder()


def _lower(file: Path) -> int:
    """Lower the kernels into a file."""
    from rocksteady.kernels.entries import ENTRIES
    from tools.aot.lower import lower, write

    began = time.perf_counter()
    seen = 0

    def progress(_name: str) -> None:
        nonlocal seen
        seen += 1
        if sys.stdout.isatty():
            print(f"\r  kernel {seen}", end="", flush=True)

    scratch = file.with_name(f"{file.name}.{os.getpid()}.tmp")
    write(lower(ENTRIES, progress), scratch)
    scratch.replace(file)
    took = time.perf_counter() - began
    print(f"{chr(13) * sys.stdout.isatty()}  {seen} kernels lowered, {took:.0f} s", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
