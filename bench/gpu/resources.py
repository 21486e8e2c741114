"""What the programs take of a GPU: ``python -m bench.gpu.resources [FOLDER]``.

Writes its part of docs/benchmarks.md from the programs in FOLDER, by default those of `make gpu`:
registers, memory and instructions, as ``ptxas`` and ``nvdisasm`` have them.  `make resources` calls
it; it needs no GPU.
"""

import re
import sys
import textwrap
from collections.abc import Iterable
from pathlib import Path

from bench.report import GPU_PROGRAMS, ROOT, write_section
from rocksteady.kernels.machine_code.gpu import BLOCK
from rocksteady.kernels.machine_code.sources import libraries_folder
from tools.aot.device.resources import ToolError, table

INTRODUCTION = """\
Written by `make resources`; do not edit. What NVIDIA's assembler makes of the programs. The wheel
rocksteady-gpu brings those for sm_80, which newer GPUs run too; those for sm_90 differ in their
header.

*Registers*, *stack* and *spills* are of one thread, functions that are called included; *threads
resident* are those that a multiprocessor holds at a time, in blocks of {block}; *occupancy* is
their share of the most, 2048. A *warp* is the 32 threads of a GPU that run in step.
*Instructions* are those of the code as it stands, not those that run.
"""

AIM = 200
"""Bytes of spills out of registers that a kernel has at most, if it reaches the aim."""

SPILLS = """\
**Spills.** The aim is less than {aim} bytes out, which {reached} of {all} programs reach: they
spill {least} to {most}. Where lanes leave one of their few flights to the march, they call it,
and what is in registers is saved around the call. Kernels without lanes consist of the march
itself.
"""


def main(files: Iterable[Path], page: Path) -> None:
    """Write the section."""
    write_section(page, GPU_PROGRAMS, section(table(files, BLOCK)))


def section(programs: str) -> str:
    """Return the section in Markdown, given the table of the programs."""
    return "\n".join([wrapped(INTRODUCTION.format(block=BLOCK)), "", programs, *spills(programs)])


def spills(programs: str) -> list[str]:
    """Return an empty line and the paragraph on what the programs of a table spill."""
    rows = re.findall(r"\| (\d+), \d+ \| \d+ \| \d+ \| \d+\.\d %", programs)
    out = [int(stores) for stores in rows]
    if not out:
        return []
    reached = sum(each < AIM for each in out)
    facts = {"aim": AIM, "all": len(out), "least": min(out), "most": max(out)}
    return ["", wrapped(SPILLS.format(reached=reached or "none", **facts))]


def wrapped(text: str) -> str:
    """Return paragraphs in lines of equal length; a target of make is not broken."""
    joined = re.sub(r"`make\s+", "`make\N{NO-BREAK SPACE}", text)
    paragraphs = [
        textwrap.fill(each, 100, break_on_hyphens=False) for each in joined.strip().split("\n\n")
    ]
    return "\n\n".join(paragraphs).replace("\N{NO-BREAK SPACE}", " ")


if __name__ == "__main__":
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else libraries_folder()
    programs = sorted(folder.glob("rocksteady-sm_*-queued_*.ptx"))
    if not programs:
        sys.exit(f"python -m bench.gpu.resources: no programs in {folder}; run 'make gpu' first")
    try:
        main(programs, ROOT / "docs" / "benchmarks.md")
    except (FileNotFoundError, ToolError) as error:
        sys.exit(f"python -m bench.gpu.resources: {error}; the page stays as it is")
