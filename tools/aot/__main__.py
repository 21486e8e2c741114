"""``python -m tools.aot``: build libraries of the kernels.

``host`` builds the one that this machine runs, into the folder in which the package looks for it,
unless it is there; ``build`` builds those of any targets into a folder.
"""

import argparse
import os
import sys
import time
from pathlib import Path

from rocksteady.kernels.machine_code.library import (
    built_folder,
    checksum_file,
    library,
    make_built_folder,
    targets,
)
from tools.aot.build import ChangedError, build, tools_hash
from tools.aot.link import LinkError, compilers
from tools.aot.targets import TARGETS


def main(arguments: list[str] | None = None) -> int:
    """Run a command; return its exit status."""
    parser = argparse.ArgumentParser(prog="python -m tools.aot", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    commands.add_parser("host", help="build the library that this machine runs")
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
    """Build the library of this machine's processor where there is none yet.

    Where that cannot be done, numba compiles kernels when they are first called: no failure.
    """
    found = library()
    if found is not None and _is_current(found.path):
        print(f"library of kernels: {found.path}")
        return 0
    reason = _obstacle()
    if reason is None:
        print(
            "Compiling the kernels into a library, once for each version of their sources, so\n"
            f"that nothing is compiled later (about a minute)\n  into {built_folder()}",
            flush=True,
        )
        try:
            build(targets()[:1], built_folder())
        except (ChangedError, LinkError, OSError) as error:
            reason = str(error)
    if reason is not None:
        print(f"no library of kernels: {reason}; numba compiles on first use", file=sys.stderr)
    return 0


def _is_current(library: Path) -> bool:
    """Return whether a library was built by these tools, or came with a wheel."""
    if library.parent != built_folder():
        return True
    return checksum_file(library).read_text("ascii").split()[1:] == [tools_hash()]


def _obstacle() -> str | None:
    """Return why no library can be built here; None where one can."""
    if not targets():
        return "none is made for this platform"
    if not compilers(TARGETS[targets()[0]]):
        return "it needs a C compiler: gcc, clang or the package ziglang"
    return make_built_folder()


def _lower(file: Path) -> int:
    """Lower the kernels into a file."""
    from tools.aot.lower import lower, write

    began = time.perf_counter()
    seen = 0

    def progress(_name: str) -> None:
        nonlocal seen
        seen += 1
        if sys.stdout.isatty():
            print(f"\r  kernel {seen}", end="", flush=True)

    scratch = file.with_name(f"{file.name}.{os.getpid()}.tmp")
    write(lower(progress), scratch)
    scratch.replace(file)
    took = time.perf_counter() - began
    print(f"{chr(13) * sys.stdout.isatty()}  {seen} kernels lowered, {took:.0f} s", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
