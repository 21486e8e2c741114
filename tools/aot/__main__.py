"""``python -m tools.aot``: build libraries of the kernels.

``host`` builds the one that this machine runs, into the folder in which the package looks for it,
unless it is there; ``build`` builds those of any targets into a folder.
"""

import argparse
import sys
import time
from pathlib import Path

from rocksteady.kernels.machine_code.library import built_folder, file_name, library, targets
from tools.aot.build import build
from tools.aot.link import NoCompilerError, compiler_for
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
        build(given.targets, given.out)
        return 0
    return _host()


def _host() -> int:
    """Build the library of this machine's processor where there is none yet."""
    found = library()
    if found is not None:
        print(f"library of kernels: {found.path}")
        return 0
    known = [name for name in targets() if name in TARGETS]
    if not known:
        print("no library of kernels is built for this platform: numba compiles them on first use")
        return 0
    try:
        compiler_for(TARGETS[known[0]])
    except NoCompilerError as error:
        print(f"no library of kernels: {error}; numba compiles them on first use")
        return 0
    print(
        "Compiling the kernels into a library, once for each version of their sources\n"
        f"  (half a minute or more; into {built_folder()})",
        flush=True,
    )
    build(known[:1], built_folder())
    if not (built_folder() / file_name(known[0])).is_file():
        return 1
    return 0


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

    scratch = file.with_name(f"{file.name}.tmp")
    write(lower(progress), scratch)
    scratch.replace(file)
    took = time.perf_counter() - began
    print(f"{chr(13) * sys.stdout.isatty()}  {seen} kernels lowered, {took:.0f} s", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
