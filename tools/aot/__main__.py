"""``python -m tools.aot``: build libraries of the kernels.

``host`` builds the one that this machine runs, and with ``--page`` the module of the explorer's
page in a second process, into the folder in which the package looks for them, unless they are
there; ``build`` builds those of any targets into a folder.
"""

import argparse
import os
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from filelock import FileLock

from rocksteady.errors import MissingKernelsError
from rocksteady.explorer.module import page_module, prune
from rocksteady.kernels.machine_code.library import (
    built_folder,
    checksum_file,
    library,
    make_built_folder,
    targets,
)
from tools.aot.build import LOWERED, ChangedError, build, lowered, tools_hash
from tools.aot.link import LinkError, compilers
from tools.aot.targets import PAGE, TARGETS


def main(arguments: list[str] | None = None) -> int:
    """Run a command; return its exit status."""
    parser = argparse.ArgumentParser(prog="python -m tools.aot", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    host = commands.add_parser("host", help="build the library of this machine")
    host.add_argument("--page", action="store_true", help="and the module of the explorer's page")
    commands.add_parser("page", help="build the module of the explorer's page")
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
    if given.command == "page":
        return _ready([MODULE])
    LOWERED.mkdir(parents=True, exist_ok=True)
    with FileLock(LOWERED / "lock"):  # who comes second finds what the first has built
        return _ready([LIBRARY, MODULE] if given.page else [LIBRARY])


def _ready(kinds: Sequence["Kind"]) -> int:
    """Build what is not there; two of them in two processes."""
    missing = [kind for kind in kinds if not kind.is_there()]
    if len(missing) == 2 and _obstacle(MODULE.targets()) is None:
        lowered()  # once, for both
        with subprocess.Popen([sys.executable, "-m", "tools.aot", "page"]) as other:
            _make(LIBRARY)
            return other.wait()
    for kind in missing:
        _make(kind)
    return 0


@dataclass(frozen=True)
class Kind:
    """What is built for this machine.

    Attributes
    ----------
    what
        Its name.
    find
        Returns its file.
    targets
        Returns the names of its targets.
    without
        What happens where it cannot be built: no failure.
    """

    what: str
    find: Callable[[], Path | None]
    targets: Callable[[], Sequence[str]]
    without: str

    def is_there(self) -> bool:
        """Return whether it is there, made by these tools or brought by a wheel; print where."""
        try:
            file = self.find()
        except MissingKernelsError:
            file = None
        if file is None or not _is_current(file):
            return False
        print(f"{self.what}: {file}")
        return True


LIBRARY = Kind(
    "library of kernels",
    lambda: getattr(library(), "path", None),
    lambda: targets()[:1],
    "numba compiles on first use",
)
MODULE = Kind(
    "module of the explorer", page_module, lambda: (PAGE,), "`rocksteady explore` cannot run here"
)


def _make(kind: Kind) -> None:
    """Build one into the folder of this machine, or print why not and what it means."""
    reason = _obstacle(kind.targets())
    if reason is None:
        print(
            f"Compiling the {kind.what}, once for each version of the kernels' sources (about a\n"
            f"minute)\n  into {built_folder()}",
            flush=True,
        )
        try:
            build(kind.targets(), built_folder())
            prune()
        except (ChangedError, LinkError, OSError) as error:
            reason = str(error)
    if reason is not None:
        print(f"no {kind.what}: {reason}; {kind.without}", file=sys.stderr)


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
    print(
        f"{chr(13) * sys.stdout.isatty()}  {len(ENTRIES)} kernels lowered, {took:.0f} s", flush=True
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
