"""What can be known of the speed on a GPU without one: ``python -m bench.gpu.estimate [FOLDER]``.

Writes its part of docs/benchmarks.md from the programs in FOLDER, by default those of `make gpu`:
what each takes of a GPU, as ``ptxas`` and ``nvdisasm`` have it, and an estimate of the speed, whose
assumptions are the constants below.  `make resources` calls it.
"""

import re
import sys
import textwrap
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from bench.report import ESTIMATED_GPU, ROOT, write_section
from rocksteady.kernels.machine_code.gpu import BLOCK
from rocksteady.kernels.machine_code.library import built_folder
from tools.aot.device.resources import ToolError, table

SCHEDULERS, THREADS = 4, 32
"""Of a multiprocessor, each of which issues one instruction a clock; threads of a warp."""


@dataclass(frozen=True)
class Architecture:
    """A GPU, from the public documents of its maker."""

    name: str
    multiprocessors: int
    clock_ghz: float
    fp64_lanes: int

    @property
    def fp64_clocks(self) -> float:
        """Clocks for which one instruction of a warp in float64 occupies a scheduler's unit."""
        return THREADS / (self.fp64_lanes / SCHEDULERS)


ARCHITECTURES = (
    Architecture("A100", 108, 1.41, 32),
    Architecture("H100, H200", 132, 1.98, 64),
)


@dataclass(frozen=True)
class Model:
    """A pass of a kernel and how many of them there are, in the cells of B1.

    Parameters
    ----------
    name
        Of the model.
    issued, fp64, local
        Instructions that a thread runs in one pass, those in float64, and accesses of 8 bytes to
        local memory, counted in the code that ``ptxas`` made of the loops of an earlier build, one
        by one.
    counted, flown
        Passes per impact: with periods leapt over, whose impacts count, and with all impacts flown.
    together
        Share of issued threads that have work, at least and at most: warps of 32 threads replayed
        from the passes of each cell, in random and in natural order.
    hidden
        Share of the clocks in which a scheduler with two to four warps has something to issue, at
        least and at most: an assumption.
    kept
        Part of this speed that remains if local memory does not fit into the first cache, and if it
        does: an assumption.
    """

    name: str
    issued: int
    fp64: int
    local: int
    counted: float
    flown: float
    together: tuple[float, float]
    hidden: tuple[float, float]
    kept: tuple[float, float]

    def clocks(self, of: Architecture) -> dict[str, float]:
        """Return the clocks of a scheduler that a pass of a warp takes at least, by what limits."""
        return {
            "issue": float(self.issued),
            "float64": self.fp64 * of.fp64_clocks,
            # Two times 128 bytes for a warp, one a clock for all schedulers together.
            "local memory": 2.0 * SCHEDULERS * self.local,
        }

    def passes(self, of: Architecture) -> tuple[float, float]:
        """Return the passes per second of all threads, at least and at most."""
        each = of.multiprocessors * of.clock_ghz * 1e9 * SCHEDULERS * THREADS
        full = each / max(self.clocks(of).values())
        low, high = (
            share * clocks * kept
            for share, clocks, kept in zip(self.together, self.hidden, self.kept, strict=True)
        )
        return low * full, high * full


MODELS = (
    Model("linear", 754, 341, 50, 0.434, 1.26, (0.48, 0.54), (0.4, 0.9), (0.8, 1.0)),
    Model("nonlinear", 9000, 3300, 1600, 1.56, 3.58, (0.93, 0.98), (0.4, 0.9), (0.3, 1.0)),
)

INTRODUCTION = """\
Written by `make resources`; do not edit. **No GPU has run these programs.** What stands here is
what the assembler of NVIDIA makes of them, and an estimate; `make bench-gpu` measures. The wheel
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
and what is in registers is saved around the call: the state of a lane has 60 numbers of two
registers each. Kernels without lanes consist of the march itself. In the listing of
queued_lane_fates for sm_90, 645 instructions access local memory; 75 of them stand in the loop
over steps and nodes, of 18 490 instructions, and none in the loops inside that one. The others
stand before it, and where cells are taken and flights left to the march.
"""

ESTIMATE = """\
**The estimate.** A *pass* is one trip of a thread through the loop that all lanes share. Counted
on a processor, in a copy of the lanes with one lane that notes each pass, on B1 with 128 x 128
cells (nonlinear: 96 x 96, alpha = 0.2): {linear_counted:.2f} passes an impact in the linear model
with periods leapt over, whose impacts count, and {linear_flown:.2f} with all flown; in the
nonlinear one {nonlinear_counted:.2f} and {nonlinear_flown:.2f}. Of the linear passes 75 % are
steps, 22 % look at a node, 1 % wait for the march or for the next cell and 1 % begin a slow
flight; the nonlinear ones are alike, and 0.3 % wait. A linear step runs {linear_issued}
instructions, {linear_fp64} of them in float64; a nonlinear pass about {nonlinear_issued},
{nonlinear_fp64} and {nonlinear_local} accesses to the Taylor rows in local memory. For what
spills {linear_local} accesses a linear step are assumed. These instructions were counted in an
earlier build of the programs, in which other functions were inlined.

Replayed on a processor as warps of 32 threads that take their cells from one queue, and of which
linear ones gather as its lanes do, {linear_low:.0f} % (random order) to {linear_high:.0f} %
(natural order) of the threads of a linear warp have work, {nonlinear_low:.0f} to
{nonlinear_high:.0f} % of a nonlinear one. Without gathering it would be 39 to 41 % in the linear
model, and about 20 % with one cell a thread. The order of the cells matters little beyond that;
but a single cell can take 26 000 passes where the mean is 95 (at amplitudes near 1.08, where
bounces never die out), and a launch lasts as long as its longest cell: 0.02 to 0.05 s at 1400 to
4000 clocks a pass. So launches have to overlap.

Assumed: one instruction a clock from each of four schedulers; 32 (A100) or 64 (H100, H200) units
in float64 per multiprocessor; 128 bytes a clock between it and its first cache; boost clocks of
1.41 and 1.98 GHz on 108 and 132 multiprocessors; two to four warps a scheduler, which keep it
busy 40 to 90 % of the time; and of the speed {linear_kept:.0f} % (linear) or {nonlinear_kept:.0f}
% (nonlinear) left at worst because what a thread keeps in local memory does not stay in the first
cache.
"""

VERDICT = """\
The aim on an H200 is 1e10 impacts/s in the linear model and 1e9 in the nonlinear one, of blocks
under harmonic shaking with periods leapt over. By this estimate the linear kernel reaches it. The
nonlinear one may miss it by up to a factor of five: its limit is local memory. A resident thread
has some 1.3 kB that each pass reads, and the 512 (A100) or 384 (H100) threads of a multiprocessor
have two to four times what its first cache holds, 192 or 256 kB. Rows in shared memory or fewer
resident threads might help; `make bench-gpu` tries other blocks and fewer registers.
"""


def main(files: Iterable[Path], page: Path) -> None:
    """Write the section."""
    write_section(page, ESTIMATED_GPU, section(table(files, BLOCK)))


def section(programs: str) -> str:
    """Return the section in Markdown, given the table of the programs."""
    facts = {
        f"{model.name}_{name}": value
        for model in MODELS
        for name, value in {
            "issued": model.issued,
            "fp64": model.fp64,
            "local": model.local,
            "counted": model.counted,
            "flown": model.flown,
            "low": 100 * model.together[0],
            "high": 100 * model.together[1],
            "kept": 100 * model.kept[0],
        }.items()
    }
    rows = [
        "| model | GPU | limited by | impacts/s, periods leapt over | impacts/s, all flown |",
        "|---|---|---|--:|--:|",
    ]
    for model in MODELS:
        for each in ARCHITECTURES:
            clocks = model.clocks(each)
            low, high = model.passes(each)
            rows.append(
                f"| {model.name} | {each.name} | {max(clocks, key=lambda name: clocks[name])} "
                f"| {between(low / model.counted, high / model.counted)} "
                f"| {between(low / model.flown, high / model.flown)} |"
            )
    return "\n".join(
        [
            wrapped(INTRODUCTION.format(block=BLOCK)),
            "",
            programs,
            "",
            *spills(programs),
            wrapped(ESTIMATE.format(**facts)),
            "",
            *rows,
            "",
            wrapped(VERDICT),
        ]
    )


def spills(programs: str) -> list[str]:
    """Return the paragraph on what the programs of a table spill, and an empty line."""
    rows = re.findall(r"\| (\d+), \d+ \| \d+ \| \d+ \| \d+\.\d %", programs)
    out = [int(stores) for stores in rows]
    if not out:
        return []
    reached = sum(each < AIM for each in out)
    facts = {"aim": AIM, "all": len(out), "least": min(out), "most": max(out)}
    return [wrapped(SPILLS.format(reached=reached or "none", **facts)), ""]


def wrapped(text: str) -> str:
    """Return paragraphs in lines of equal length; a target of make is not broken."""
    joined = re.sub(r"`make\s+", "`make\N{NO-BREAK SPACE}", text)
    paragraphs = [
        textwrap.fill(each, 100, break_on_hyphens=False) for each in joined.strip().split("\n\n")
    ]
    return "\n\n".join(paragraphs).replace("\N{NO-BREAK SPACE}", " ")


def between(low: float, high: float) -> str:
    """Return a range in one digit and a half."""
    return f"{low:.1e} to {high:.1e}".replace("e+0", "e").replace("e+1", "e1")


if __name__ == "__main__":
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else built_folder()
    programs = sorted(folder.glob("rocksteady-sm_*-queued_*.ptx"))
    if not programs:
        sys.exit(f"python -m bench.gpu.estimate: no programs in {folder}; run 'make gpu' first")
    try:
        main(programs, ROOT / "docs" / "benchmarks.md")
    except (FileNotFoundError, ToolError) as error:
        sys.exit(f"python -m bench.gpu.estimate: {error}; the page stays as it is")
