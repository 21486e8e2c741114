"""``python -m tools.aot``: build libraries of the kernels.

``host`` builds into the package what this machine needs, unless it is there: the library of
kernels, and the module and the scripts of the explorer's page. ``build`` builds the libraries of
any targets into a folder.
"""

import argparse
import os
import shutil
import signal
import subprocess
import sys
import time
from contextlib import ExitStack
from pathlib import Path

from filelock import FileLock

from rocksteady.errors import MissingKernelsError
from rocksteady.kernels.machine_code import sources
from rocksteady.kernels.machine_code.library import checksum_file, is_whole, targets
from rocksteady.kernels.machine_code.sources import sources_hash
from tools.aot.build import LOWERED, ChangedError, build, lowered, tools_hash
from tools.aot.inputs import LIBRARIES, MADE, inputs_hash, is_made
from tools.aot.link import LinkError
from tools.aot.targets import PAGE, TARGETS
from tools.aot.web.program import write_scripts


def main(arguments: list[str] | None = None) -> int:
    """Run a command; return its exit status."""
    parser = argparse.ArgumentParser(prog="python -m tools.aot", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    commands.add_parser("host", help="build what this machine needs")
    many = commands.add_parser("build", help="build the libraries of targets")
    many.add_argument("--out", type=Path, required=True, help="folder to write them into")
    many.add_argument("--targets", nargs="+", choices=TARGETS, default=list(TARGETS))
    one = commands.add_parser("one", help="build the file of one target for this machine")
    one.add_argument("target", choices=TARGETS)
    lowering = commands.add_parser("lower", help="write the lowered kernels alone")
    lowering.add_argument("file", type=Path)
    given = parser.parse_args(arguments)
    LIBRARIES.mkdir(exist_ok=True)
    try:
        match given.command:
            case "lower":
                _lower(given.file)
            case "build":
                build(given.targets, given.out, elsewhere=True)
                sources_hash()  # kept beside the libraries, for the wheels too
                shutil.copy(LIBRARIES / sources.NAME, given.out)
            case "one":
                build([given.target], LIBRARIES)
            case _:
                LOWERED.mkdir(parents=True, exist_ok=True)
                with FileLock(LOWERED / "lock"):  # the second of two finds what the first built
                    _make_all()
    except (ChangedError, LinkError, MissingKernelsError, OSError) as error:
        print(f"python -m tools.aot: {error}", file=sys.stderr)
        return 1
    except subprocess.CalledProcessError:  # it has said why
        return 1
    except KeyboardInterrupt:
        return 130
    return 0


def _make_all() -> None:
    """Build what is missing, the module of the page in a process of its own."""
    if is_made() and all(map(_is_current, _needed())):
        return
    inputs = inputs_hash()
    if not targets():
        raise LinkError("no library is made for this platform")
    missing = [name for name in _needed() if not _is_current(name)]
    with ExitStack() as others:
        if missing:
            print("Compiling the kernels for this machine (about a minute)", flush=True)
            lowered()  # once, for all
            command = [sys.executable, "-m", "tools.aot", "one"]
            started = [others.enter_context(subprocess.Popen([*command, n])) for n in missing[1:]]
            build(missing[:1], LIBRARIES)
            for process in started:
                if process.wait():
                    raise subprocess.CalledProcessError(process.returncode, process.args)
        write_scripts(LIBRARIES)
    for name in TARGETS.keys() - set(_needed()):  # of another machine that shares this folder
        if not _is_current(name):
            (LIBRARIES / TARGETS[name].file).unlink(missing_ok=True)
    sources_hash()  # kept beside them
    MADE.write_text(inputs, "ascii")


def _needed() -> tuple[str, ...]:
    """Return the targets of this machine: its fastest library, and the page."""
    return (*targets()[:1], PAGE)


def _is_current(name: str) -> bool:
    """Return whether the file of a target is whole, of these sources, and made by these tools."""
    file = LIBRARIES / TARGETS[name].file
    if not is_whole(file):
        return False
    made = checksum_file(file).read_text("ascii").split()[1:]
    return made == [tools_hash()] and sources_hash().encode() in file.read_bytes()


def _lower(file: Path) -> None:
    """Lower the kernels into a file."""
    from rocksteady.kernels.entries import ENTRIES
    from tools.aot.lower import lower, write

    signal.signal(signal.SIGINT, signal.SIG_DFL)  # nothing to tidy, here and in its own children
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


if __name__ == "__main__":
    sys.exit(main())
