"""Build libraries of the kernels: lower once, then optimise, emit and link for each target."""

import hashlib
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from importlib.metadata import version
from pathlib import Path

from rocksteady.kernels.machine_code.library import checksum_file
from rocksteady.kernels.machine_code.sources import sources_hash, unchanged
from tools.aot.emit import emit
from tools.aot.inputs import tool_files
from tools.aot.link import link
from tools.aot.targets import TARGETS

LOWERED = Path(__file__).parents[2] / "build" / "aot"
"""Folder of the lowered kernels, from which the libraries of all targets are made."""


class ChangedError(Exception):
    """The sources are no longer what they were when the build began."""


def build(names: Sequence[str], folder: Path, *, elsewhere: bool = False) -> list[Path]:
    """Build the libraries of some targets into a folder; return their files.

    Each stands there whole, with its checksum beside it, or not at all. Those that are to run
    `elsewhere` too are linked by zig, and need no newer C library than their targets say.

    Raises
    ------
    ChangedError
        If the sources change in the meantime.
    LinkError
        If no compiler in reach links one.
    """
    folder.mkdir(parents=True, exist_ok=True)
    bitcode = lowered()
    emitted: dict[tuple[str, str, str], bytes] = {}
    made = []
    for name in names:
        target = TARGETS[name]
        start = time.perf_counter()
        with tempfile.TemporaryDirectory(prefix="rocksteady-") as scratch:
            objects, library = Path(scratch, "kernels.o"), Path(scratch, target.file)
            kind = (target.triple, target.cpu, target.features)
            if kind not in emitted:
                emitted[kind] = emit(bitcode, target)
            objects.write_bytes(emitted[kind])
            linker = link(objects, library, target, elsewhere=elsewhere)
            content = library.read_bytes()
            if not unchanged():
                raise ChangedError("the kernels were changed while they were compiled: build again")
            made.append(folder / target.file)
            publish(made[-1], content)
        took = time.perf_counter() - start
        size = f"{len(content) / 1e3:.0f} kB"
        print(f"  {target.file}: {size}, linked by {linker}, {took:.0f} s", flush=True)
    return made


def tools_hash(folder: Path = Path(__file__).parent) -> str:
    """Return a hash of what builds libraries: a folder of tools, and the version of numba."""
    digest = hashlib.sha256(version("numba").encode())
    for source in tool_files(folder):
        digest.update(source.read_bytes())
    return digest.hexdigest()[:16]


def lowered(
    command: Sequence[str] = ("tools.aot", "lower"), kind: str = "bc", tools: str | None = None
) -> bytes:
    """Return lowered kernels; lower them first, in another process, if that is to be done.

    Parameters
    ----------
    command
        Module and arguments that write them, before the name of the file.
    kind
        Ending of the file in which they are kept.
    tools
        Hash of what lowers them; by default `tools_hash()`.
    """
    kept = LOWERED / f"{sources_hash()}-{tools or tools_hash()}.{kind}"
    if not kept.is_file():
        kept.parent.mkdir(parents=True, exist_ok=True)
        for old in kept.parent.glob(f"*.{kind}*"):
            old.unlink(missing_ok=True)
        subprocess.run([sys.executable, "-m", *command, str(kept)], check=True)
    return kept.read_bytes()


def publish(file: Path, content: bytes, tools: str | None = None) -> None:
    """Write a file and its checksum; each is whole as soon as it is there.

    Parameters
    ----------
    file, content
        The file.
    tools
        Hash of what made it, which is written beside the checksum; by default `tools_hash()`.
    """
    checksum = f"{hashlib.sha256(content).hexdigest()} {tools or tools_hash()}\n"
    _write(file, content)
    _write(checksum_file(file), checksum.encode())


def _write(file: Path, content: bytes) -> None:
    scratch = file.with_name(f"{file.name}.{os.getpid()}.tmp")
    try:
        scratch.write_bytes(content)
        scratch.replace(file)
    finally:
        scratch.unlink(missing_ok=True)
