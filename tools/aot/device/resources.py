"""What a kernel takes of a GPU, found without one: registers, stack, residency and instructions.

``ptxas`` assembles PTX into the code of an architecture and says what that takes; ``nvdisasm``
lists the code, whose instructions are counted here.  Both come in wheels, which
``tools/aot/device/constraints.txt`` names (`make ptx` installs them), or with CUDA.  Counts
are of the code as it stands: how often an instruction runs depends on the cells.
"""

import re
import shutil
import subprocess
import sysconfig
import tempfile
from collections import Counter
from collections.abc import Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from rocksteady.sweep.cases.queue import usable_cores

WARP = 32
"""Threads that a multiprocessor issues together."""
REGISTERS = 65536
"""Registers of 32 bits of one multiprocessor."""
ALLOCATED = 256
"""Registers are given to a warp in multiples of it."""
WARPS_TOGETHER = 4
"""Warps that have registers are a multiple of it: as many as there are schedulers."""
MOST_WARPS, MOST_BLOCKS, MOST_REGISTERS = 64, 32, 255
ARCHITECTURES = ("sm_80", "sm_90")
"""Those of which the numbers above are; they differ in shared memory, which no kernel uses."""

CLASSES = {
    "fp64": ("DADD", "DMUL", "DFMA", "DSETP", "DMNMX", "MUFU.RCP64H", "MUFU.RSQ64H"),
    "local": ("LDL", "STL"),
    "memory": ("LDG", "STG", "LD", "ST", "ATOM", "ATOMG", "RED", "LDC", "ULDC"),
    "branch": ("BRA", "BRX", "CALL", "RET", "EXIT", "BSSY", "BSYNC", "BREAK", "WARPSYNC"),
    "integer": (
        *("IADD3", "IMAD", "LOP3", "SHF", "ISETP", "LEA", "IMNMX", "VIMNMX", "VIADD", "IABS"),
        *("UIADD3", "UIMAD", "ULOP3", "USHF", "UISETP", "ULEA", "POPC", "FLO", "BREV", "I2I"),
    ),
}
"""Classes of instructions; all else is in "other", with what the compiler writes as a move."""
KEPT = ("DADD", "DMUL", "DFMA", "MUFU.RCP64H", "LDL", "STL", "LDG", "STG", "BRA")
"""Instructions that are counted by their names as well."""

_ENTRY = re.compile(r"Compiling entry function '(\w+)' for '(\w+)'")
_PROPERTIES = re.compile(r"Function properties for (\S+)")
_STACK = re.compile(
    r"(\d+) bytes stack frame, (\d+) bytes spill stores, (\d+) bytes spill loads", re.ASCII
)
_USED = re.compile(r"Used (\d+) registers")
_CUMULATIVE = re.compile(r"(\d+) bytes cumulative stack size")
_SECTION = re.compile(r"^\s*\.section\s+\.text\.([\w$.]+)")
_LABEL = re.compile(r"^\s*([.$\w]+):\s*$")
_INSTRUCTION = re.compile(
    r"^\s*/\*(?P<at>[0-9a-f]+)\*/\s+(?:@!?U?P\w+\s+)?(?P<name>[A-Z][\w.]*)(?P<rest>[^;]*);"
)
_TARGET = re.compile(r"`\(([.$\w]+)\)")


class ToolError(Exception):
    """A tool that does not accept what it is given; its words are the message."""


@dataclass(frozen=True, kw_only=True)
class Assembled:
    """What ``ptxas -v`` says of one kernel.

    Attributes
    ----------
    kernel, architecture
        Its name in the PTX, and that of the GPUs.
    registers
        Of 32 bits, per thread.
    stack, spill_stores, spill_loads
        Bytes of a thread in local memory: arrays, and registers that found no place; of the entry
        and of all functions that it calls.
    """

    kernel: str
    architecture: str
    registers: int
    stack: int
    spill_stores: int
    spill_loads: int


@dataclass(frozen=True, kw_only=True)
class Instructions:
    """Instructions of a part of a kernel: how many, by class and by name."""

    total: int
    classes: dict[str, int]
    names: dict[str, int]


@dataclass(frozen=True, kw_only=True)
class Resources:
    """What one kernel takes of one architecture.

    Attributes
    ----------
    assembled
        What ``ptxas`` says.
    code_bytes
        Size of the file that it wrote, code and constants.
    block
        Threads of a block that the next two are for.
    resident
        Threads that one multiprocessor holds at a time.
    occupancy
        Their share of the most that it can hold.
    whole, loops, innermost
        Instructions of all code, of what lies between a label and a branch back to it, and of the
        loops among these that hold no other; None without ``nvdisasm``.
    """

    assembled: Assembled
    code_bytes: int
    block: int
    resident: int
    occupancy: float
    whole: Instructions | None = None
    loops: Instructions | None = None
    innermost: Instructions | None = None


def tool(name: str) -> Path | None:
    """Return where a tool of CUDA is: in a wheel of this environment, on the PATH, or nowhere."""
    packages = Path(sysconfig.get_path("purelib"), "nvidia")
    for file in sorted(packages.glob(f"*/bin/{name}")):
        if file.is_file():
            return file
    found = shutil.which(name)
    return None if found is None else Path(found)


def resident_threads(registers: int, block: int) -> int:
    """Return how many threads of a kernel one multiprocessor holds at a time.

    That of the CUDA occupancy calculator for compute capability 8.0 and 9.0 and a kernel without
    shared memory.

    Parameters
    ----------
    registers
        Per thread, from 1 to MOST_REGISTERS.
    block
        Threads of a block, from 1 to 1024.

    Raises
    ------
    ValueError
        If either is out of its range.
    """
    if not 1 <= registers <= MOST_REGISTERS or not 1 <= block <= 1024:
        raise ValueError(f"{registers} registers, {block} threads a block")
    each = -(-registers * WARP // ALLOCATED) * ALLOCATED
    warps = REGISTERS // each // WARPS_TOGETHER * WARPS_TOGETHER
    of_block = -(-block // WARP)
    blocks = min(MOST_BLOCKS, MOST_WARPS // of_block, warps // of_block)
    return blocks * of_block * WARP


def assemble(ptx: Path, architecture: str, cubin: Path, options: Sequence[str] = ()) -> str:
    """Assemble a file of PTX and return what ``ptxas -v`` says.

    Raises
    ------
    FileNotFoundError
        If there is no ``ptxas``.
    ToolError
        If it refuses the file.
    """
    ptxas = tool("ptxas")
    if ptxas is None:
        raise FileNotFoundError("ptxas: neither a wheel nor CUDA brings it here")
    command = [str(ptxas), "-v", f"-arch={architecture}", *options, str(ptx), "-o", str(cubin)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise ToolError(f"{ptx.name}: {(done.stderr or done.stdout).strip()}")
    return done.stdout + done.stderr


def parsed(said: str) -> list[Assembled]:
    """Return what ``ptxas -v`` said of each entry, with what its functions spill added.

    Functions that are not inlined follow the first entry of their file; what is here has one entry
    a file.
    """
    found: list[Assembled] = []
    name = architecture = owner = ""
    frames: dict[str, tuple[int, int, int]] = {}
    registers = cumulative = 0
    for line in said.splitlines():
        if match := _ENTRY.search(line):
            if name:
                found.append(_assembled(name, architecture, registers, cumulative, frames))
            name, architecture, frames, registers, cumulative = *match.groups(), {}, 0, 0
        elif match := _PROPERTIES.search(line):
            owner = match[1]
        elif match := _STACK.search(line):
            frames[owner] = int(match[1]), int(match[2]), int(match[3])
        elif match := _USED.search(line):
            registers = int(match[1])
            stack = _CUMULATIVE.search(line)
            cumulative = int(stack[1]) if stack else 0
    if name:
        found.append(_assembled(name, architecture, registers, cumulative, frames))
    return found


def _assembled(
    name: str,
    architecture: str,
    registers: int,
    cumulative: int,
    frames: dict[str, tuple[int, int, int]],
) -> Assembled:
    _, stores, loads = (sum(column) for column in zip(*frames.values(), strict=True))
    return Assembled(
        kernel=name,
        architecture=architecture,
        registers=registers,
        stack=max(cumulative, *(frame for frame, _, _ in frames.values()), 0),
        spill_stores=stores,
        spill_loads=loads,
    )


def counted(listing: str) -> tuple[Instructions, Instructions, Instructions]:
    """Count the instructions of a listing of ``nvdisasm -c``: all, in loops, in innermost loops.

    A loop is what lies between a label and the last branch back to it, by address.  The persistent
    loop of a kernel, which takes the cells, is one: nearly everything is inside a loop.
    """
    instructions, loops = _read(listing)
    inner = [
        loop for loop in loops if not any(other != loop and _within(other, loop) for other in loops)
    ]
    return (
        _counted(name for _, _, name in instructions),
        _counted(name for section, at, name in instructions if _in_any(loops, section, at)),
        _counted(name for section, at, name in instructions if _in_any(inner, section, at)),
    )


Loop = tuple[str, int, int]
"""Section, first address and last."""


def _read(listing: str) -> tuple[list[tuple[str, int, str]], list[Loop]]:
    """Return instructions, as section, address and name, and loops."""
    section, waiting = "", list[str]()
    instructions: list[tuple[str, int, str]] = []
    labels: dict[str, int] = {}
    ends: dict[tuple[str, str], int] = {}
    for line in listing.splitlines():
        if match := _SECTION.match(line):
            section = match[1]
        elif match := _LABEL.match(line):
            waiting.append(match[1])
        elif match := _INSTRUCTION.match(line):
            at, name = int(match["at"], 16), match["name"]
            labels |= dict.fromkeys(waiting, at)
            waiting = []
            instructions.append((section, at, name))
            target = _TARGET.search(match["rest"])
            # A branch to itself pads the end of a function.
            if name == "BRA" and target and labels.get(target[1], at) < at:
                ends[section, target[1]] = at
    return instructions, [(part, labels[name], last) for (part, name), last in ends.items()]


def _within(inner: Loop, outer: Loop) -> bool:
    return inner[0] == outer[0] and outer[1] <= inner[1] and inner[2] <= outer[2]


def _in_any(loops: Iterable[Loop], section: str, at: int) -> bool:
    return any(part == section and first <= at <= last for part, first, last in loops)


def _counted(names: Iterable[str]) -> Instructions:
    """Count names; IMAD.MOV and the like move, and are in "other"."""
    classes, kept = Counter[str](), Counter[str]()
    for name in names:
        classes[class_of(name)] += 1
        kept.update(some for some in KEPT if name == some or name.startswith(f"{some}."))
    return Instructions(
        total=classes.total(),
        classes={each: classes[each] for each in (*CLASSES, "other")},
        names={each: kept[each] for each in KEPT},
    )


def class_of(name: str) -> str:
    """Return the class of an instruction, such as "fp64" of ``DADD`` or ``DSETP.GT.AND``."""
    if name.startswith(("IMAD.MOV", "UIMAD.MOV")):
        return "other"
    for kind, members in CLASSES.items():
        if any(name == member or name.startswith(f"{member}.") for member in members):
            return kind
    return "other"


def disassembled(cubin: Path) -> str | None:
    """Return the listing of an assembled file, or None where there is no ``nvdisasm``.

    Raises
    ------
    ToolError
        If it refuses the file.
    """
    nvdisasm = tool("nvdisasm")
    if nvdisasm is None:
        return None
    command = [str(nvdisasm), "-c", str(cubin)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise ToolError(f"{cubin.name}: {done.stderr.strip()}")
    return done.stdout


def resources(
    ptx: Path, architecture: str, block: int = 128, options: Sequence[str] = ()
) -> Resources:
    """Return what the kernel of a file of PTX takes of an architecture.

    Parameters
    ----------
    ptx
        The file, of one entry.
    architecture
        Such as "sm_90".
    block
        Threads of a block.
    options
        Further options of ``ptxas``, such as "-maxrregcount=168".

    Raises
    ------
    FileNotFoundError
        If there is no ``ptxas``.
    ToolError
        If a tool refuses the file, or it has not one entry.
    """
    with tempfile.TemporaryDirectory(prefix="rocksteady-") as scratch:
        cubin = Path(scratch, "kernel.cubin")
        entries = parsed(assemble(ptx, architecture, cubin, options))
        if len(entries) != 1:
            raise ToolError(f"{ptx.name}: {len(entries)} entries, and not one")
        listing = disassembled(cubin)
        size = cubin.stat().st_size
    threads = resident_threads(entries[0].registers, block)
    counts = (None, None, None) if listing is None else counted(listing)
    return Resources(
        assembled=entries[0],
        code_bytes=size,
        block=block,
        resident=threads,
        occupancy=threads / (MOST_WARPS * WARP),
        whole=counts[0],
        loops=counts[1],
        innermost=counts[2],
    )


HEADINGS = (
    "kernel",
    "architecture",
    "registers",
    "stack [B]",
    "spills out, in [B]",
    "code [kB]",
    "threads resident",
    "occupancy",
    "instructions",
    "fp64",
    "local",
    "integer",
    "in innermost loops, fp64",
)


def row(found: Resources) -> tuple[str, ...]:
    """Return what is in the table about one kernel, in the order of HEADINGS."""
    got, whole, inner = found.assembled, found.whole, found.innermost
    counts: tuple[str, ...] = ("",) * 5
    if whole is not None and inner is not None:
        counts = (
            str(whole.total),
            *(str(whole.classes[kind]) for kind in ("fp64", "local", "integer")),
            f"{inner.total}, {inner.classes['fp64']}",
        )
    return (
        got.kernel.removeprefix("rs_"),
        got.architecture,
        str(got.registers),
        str(got.stack),
        f"{got.spill_stores}, {got.spill_loads}",
        f"{found.code_bytes / 1e3:.0f}",
        str(found.resident),
        f"{100 * found.occupancy:.1f} %",
        *counts,
    )


def table(files: Iterable[Path], block: int = 128) -> str:
    """Return the table of programs ``rocksteady-<architecture>-<kernel>.ptx``, in Markdown.

    Raises
    ------
    FileNotFoundError
        If there is no ``ptxas``.
    ToolError
        If a tool refuses a file.
    """
    with ThreadPoolExecutor(usable_cores()) as threads:
        listed = threads.map(
            lambda file: resources(file, architecture_of(file), block), sorted(files)
        )
        rows = list(map(row, listed))
    lines = ["| " + " | ".join(HEADINGS) + " |", "|---|---|" + "--:|" * (len(HEADINGS) - 2)]
    return "\n".join(lines + ["| " + " | ".join(cells) + " |" for cells in rows])


def architecture_of(file: Path) -> str:
    """Return the architecture that the name of a program says, or else its ``.target``.

    Raises
    ------
    ToolError
        If neither says one.
    """
    named = re.match(r"rocksteady-(sm_\d+)-", file.name)
    said = named or re.search(r"^\.target (sm_\d+)", file.read_text(encoding="utf-8"), re.MULTILINE)
    if said is None:
        raise ToolError(f"{file.name}: no architecture")
    return said[1]
