"""The very PTX that a device is given, executed on this processor.

Each instruction becomes one statement in C with the meaning that NVIDIA's reference gives it, and a
C compiler makes a library of that.  So the text is checked bit for bit without a device: what its
assembler could fuse or round otherwise, or what this translator does not know, is an error that
names the line.
"""

import argparse
import ctypes
import hashlib
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from rocksteady.kernels.machine_code.library import targets
from tools.aot.device.ptx.functions import Body, c_name, declaration
from tools.aot.device.ptx.text import Module, PtxError, parsed
from tools.aot.link import LinkError, compilers
from tools.aot.targets import TARGETS

PRELUDE = Path(__file__).parent / "ptx" / "prelude.h"
HAZARDS = {
    1: "an address that is no multiple of the size",
    2: "memory of no array",
    3: "stack memory that was not written",
    4: "a load for constants from memory that is not constant, or a store to a constant",
    5: "memory of another space",
    6: "a division by zero",
    7: "a conversion of what is no such integer",
    8: "a vote of part of a warp",
}
"""What the checks of `Program.hazards` look for, by number."""
_OPTIONS = ["-ffp-contract=off", "-fno-math-errno", "-fwrapv", "-fno-sanitize=all", "-w"]


@dataclass(frozen=True)
class Translation:
    """A PTX file in C.

    Attributes
    ----------
    source
        In C; it needs no other file.
    entries
        Names of its entries.
    blocks
        How often each instruction stands in each block: what is executed together.
    """

    source: str
    entries: tuple[str, ...]
    blocks: tuple[Counter[str], ...]


@dataclass(frozen=True)
class Hazard:
    """What a device would trap on, or PTX leaves open.

    Attributes
    ----------
    kind
        One of `HAZARDS`.
    line
        Of the PTX.
    """

    kind: str
    line: int


class Votes(NamedTuple):
    """Votes of warps.

    Attributes
    ----------
    taken
        How many there were.
    parted
        At how many of them lanes voted at different places of the program: a device would wait for
        ever, or mix them up.
    partial
        At how many of them some lanes had ended.
    """

    taken: int
    parted: int
    partial: int


class Program:
    """The PTX of a kernel, loaded.

    Parameters
    ----------
    library
        What it was compiled to.
    name
        Of its entry, as ``"rs_queued_lane_fates"``.
    blocks
        Instructions of its blocks.
    """

    def __init__(self, library: Path, name: str, blocks: tuple[Counter[str], ...]) -> None:
        self._loaded = ctypes.CDLL(str(library))
        self._blocks = blocks
        self.entry: Callable[..., int] = self._loaded[name]
        """``int32_t entry(int64_t *cells)``, as `machine_code.library.caller` takes it."""
        self.entry.argtypes = [ctypes.c_void_p]
        self.entry.restype = ctypes.c_int32

    def watch(self, arrays: Iterable[npt.NDArray[np.generic]], cells: int) -> None:
        """Say which memory a kernel may use beside its stack, and forget the hazards met before.

        Only for a program that was loaded with ``checked``.

        Parameters
        ----------
        arrays
            Those that the kernel is given.
        cells
            Number of the cells in which it is told where they are.
        """
        ctypes.c_uint64.in_dll(self._loaded, "ptx_cells").value = 8 * cells
        ranges = [cell for each in arrays for cell in (each.ctypes.data, each.nbytes)]
        room = (ctypes.c_uint64 * len(ranges)).in_dll(self._loaded, "ptx_ranges")
        for place, cell in enumerate(ranges):
            room[place] = cell
        ctypes.c_int64.in_dll(self._loaded, "ptx_range_count").value = len(ranges) // 2
        ctypes.c_int64.in_dll(self._loaded, "ptx_hazard_count").value = 0

    def hazards(self) -> list[Hazard]:
        """Return what calls have met since the program was loaded, each line once per kind."""
        count = ctypes.c_int64.in_dll(self._loaded, "ptx_hazard_count").value
        room = (ctypes.c_int64 * (4 * 1024)).in_dll(self._loaded, "ptx_hazards")
        return [Hazard(HAZARDS[room[4 * n]], room[4 * n + 1]) for n in range(min(count, 1024))]

    def warp(self, lanes: int = 32) -> Callable[..., int]:
        """Return what calls the entry from lanes that run in step, as `entry` calls it from one.

        Each lane runs until it votes, or adds to a number of all; when all that have not ended wait
        for a vote, it takes place.
        """
        launch = self._loaded["ptx_warp"]
        launch.argtypes = [ctypes.c_void_p, ctypes.c_void_p, ctypes.c_int32]
        launch.restype = ctypes.c_int32
        address = ctypes.cast(self.entry, ctypes.c_void_p)  # type: ignore[arg-type]

        def call(cells: Any) -> int:
            status: int = launch(address, ctypes.cast(cells, ctypes.c_void_p), lanes)
            return status

        return call

    def votes(self) -> Votes:
        """Return how the votes of warps have gone since the program was loaded."""
        names = ("ptx_votes", "ptx_parted", "ptx_partial")
        return Votes(*(ctypes.c_int64.in_dll(self._loaded, name).value for name in names))

    def executed(self) -> Counter[str]:
        """Return how often lanes of warps executed each instruction since the last such question.

        Only for a program that was loaded with ``counted`` and called by `warp` on one thread.
        """
        return self._counts("ptx_executed")

    def issued(self) -> Counter[str]:
        """Return the same of warps.

        Between two votes, or two numbers of cells where none is taken, lanes are taken to execute a
        block together as often as they can: a device cannot do better.
        """
        return self._counts("ptx_issued")

    def _counts(self, name: str) -> Counter[str]:
        counts = (ctypes.c_uint64 * len(self._blocks)).in_dll(self._loaded, name)
        total: Counter[str] = Counter()
        for count, block in zip(counts, self._blocks, strict=True):
            for opcode, each in block.items():
                total[opcode] += count * each
        ctypes.memset(counts, 0, ctypes.sizeof(counts))
        return +total


def translated(ptx: str) -> str:
    """Return a PTX file in C.

    Parameters
    ----------
    ptx
        As LLVM writes it, of PTX 7.0 or 7.8, with entries that take one address.

    Raises
    ------
    PtxError
        If a line is not known, or does not say how it rounds.
    """
    return translation(ptx).source


def translation(ptx: str) -> Translation:
    """Return a PTX file in C, and what is in it; raise as `translated` does."""
    module = parsed(ptx)
    blocks: list[Counter[str]] = []
    functions = [Body(each, module, blocks).text() for each in module.functions.values()]
    source = "\n".join(
        (
            f"#define BLOCKS {len(blocks)}",
            PRELUDE.read_text("utf-8"),
            *_tables(module),
            *(f"{declaration(each)};" for each in module.functions.values()),
            *functions,
            "",
        )
    )
    entries = tuple(each.name for each in module.functions.values() if each.entry)
    return Translation(source, entries, tuple(blocks))


def loaded(
    files: Iterable[Path],
    folder: Path,
    *,
    checked: bool = False,
    counted: bool = False,
    nan: int | None = None,
    fill: int = 0xFF,
) -> dict[str, Program]:
    """Translate, compile and load PTX files.

    Parameters
    ----------
    files
        The PTX files.
    folder
        Where the sources in C and the libraries are written; a library that is there is used.
    checked
        Whether to look at each access, division and conversion: see `Program.hazards`.
    counted
        Whether to count instructions: see `Program.executed`.
    nan
        Bits of the NaN that arithmetic makes; those of this processor by default.
    fill
        Byte that stack memory and registers begin with, where accesses are checked: what a kernel
        computes must not depend on it.

    Returns
    -------
    dict[str, Program]
        By the names of the entries.

    Raises
    ------
    PtxError
        If a line is not known.
    LinkError
        If no compiler is in reach.
    """
    options = [f"-DPTX_FILL={fill:#x}", "-DPTX_CHECKED"] * checked + ["-DPTX_COUNTED"] * counted
    if nan is not None:
        options.append(f"-DPTX_NAN=UINT64_C({nan:#x})")
    programs = {}
    for file in files:
        found = translation(file.read_text("ascii"))
        content = "\n".join((*options, found.source))
        key = hashlib.sha256(content.encode()).hexdigest()[:16]
        library = folder / f"{file.stem}-{key}.so"
        if not library.is_file():
            compiled(found.source, library, options)
        for name in found.entries:
            programs[name] = Program(library, c_name(name), found.blocks)
    return programs


def compiled(source: str, library: Path, options: Iterable[str] = ()) -> None:
    """Compile a translation to a library; raise `LinkError` if no compiler is in reach."""
    text, scratch = library.with_suffix(".c"), library.with_suffix(".tmp")
    text.write_text(source, "utf-8")
    said = "it needs a C compiler: gcc, clang or the package ziglang"
    for compiler in compilers(TARGETS[targets()[0]]).values():
        command = [*compiler, "-O1", "-shared", "-fPIC", *_OPTIONS, *options]
        done = subprocess.run(
            [*command, "-o", str(scratch), str(text), "-lm"],
            check=False,
            capture_output=True,
            text=True,
        )
        if done.returncode == 0:
            scratch.replace(library)
            return
        said = (done.stderr.strip().splitlines() or [said])[0]
    raise LinkError(f"{library.name}: {said}")


def _tables(module: Module) -> list[str]:
    """Return the global variables in C, and where they are for the checks."""
    names = {each.name: f"g_{c_name(each.name)}" for each in module.tables.values()}
    heads = {
        each.name: f"static uint{8 * each.each}_t {names[each.name]}[{each.size // each.each}] "
        f"__attribute__((aligned({each.align})))"
        for each in module.tables.values()
    }
    lines = [f"{head};" for head in heads.values()]
    for each in module.tables.values():
        content = ", ".join(
            f"UINT64_C({value})"
            if isinstance(value, int)
            else f"(uint64_t)(uintptr_t){names[value]}"
            for value in each.content
        )
        lines.append(f"{heads[each.name]} = {{{content or 0}}};")
    ranges = "".join(
        f"{{(uint64_t)(uintptr_t){names[each.name]}, {each.size}}}, "
        for each in module.tables.values()
    )
    checks = f"static const table tables[] = {{{ranges}{{0, 0}}}};"
    return [*lines, f"#if defined(PTX_CHECKED)\n{checks}\n#endif"]


def main() -> int:
    """Say of PTX files how long they take to translate and compile."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("files", nargs="+", type=Path)
    parser.add_argument("--folder", type=Path, required=True)
    given = parser.parse_args()
    for file in given.files:
        start = time.perf_counter()
        try:
            source = translated(file.read_text("ascii"))
        except PtxError as error:
            print(f"{file.name}: {error}")
            continue
        between = time.perf_counter()
        compiled(source, given.folder / f"{file.stem}.so")
        lines, seconds = source.count("\n"), time.perf_counter() - between
        print(f"{file.name}: {lines} lines, {between - start:.2f} s, compiled in {seconds:.1f} s")
    return 0


if __name__ == "__main__":
    sys.exit(main())
