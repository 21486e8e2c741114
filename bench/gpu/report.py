"""Turn what a GPU did into tables, in docs/benchmarks.md: ``python -m bench.gpu.report``."""

import json
import re
import sys
import textwrap
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any

from bench.report import MEASURED_GPU, ROOT, write_section

INTRODUCTION = """\
Written by `make bench-gpu`; do not edit. The programs that the executor `gpu` launches, on
**{name}** (compute capability {capability}, {multiprocessors} multiprocessors, {clock_mhz:.0f} MHz
at most, CUDA {cuda}{smi}). *Kernel* is the time between two events on the GPU, *call* all from
the arguments in NumPy to the results there. Cells are those of B1, of the nonlinear model with
alpha = 0.2; records are 5400 samples of noise. Impacts leapt over in periodic motions are counted,
as they are for the processor above."""
COMPILED = "The first map of a model begins with what the driver takes to compile the program."


def main(source: Path, page: Path) -> None:
    """Read the figures and write the section."""
    data = json.loads(source.read_text(encoding="utf-8"))
    write_section(page, MEASURED_GPU, section(data))


def section(data: dict[str, Any]) -> str:
    """Return the section in Markdown."""
    facts = data["device"]
    said = facts.get("nvidia_smi", {})
    smi = f", driver {said['driver_version']}" if "driver_version" in said else ""
    cuda = f"{facts['driver'] // 1000}.{facts['driver'] % 1000 // 10}"
    parts = [wrapped(INTRODUCTION.format(**facts, cuda=cuda, smi=smi))]
    for name, made in TABLES.items():
        if data.get(name):
            parts += ["", *made(data[name])]
    return "\n".join(parts)


def wrapped(text: str) -> str:
    """Return paragraphs in lines of equal length; a target of make is not broken."""
    joined = re.sub(r"`make\s+", "`make\N{NO-BREAK SPACE}", text)
    paragraphs = [
        textwrap.fill(each, 100, break_on_hyphens=False) for each in joined.strip().split("\n\n")
    ]
    return "\n\n".join(paragraphs).replace("\N{NO-BREAK SPACE}", " ")


def table(headings: Sequence[str], rows: Iterable[Sequence[Any]], words: int = 1) -> list[str]:
    """Return a table, whose first columns hold words."""
    lines = ["| " + " | ".join(headings) + " |"]
    lines.append("|" + "---|" * words + "--:|" * (len(headings) - words))
    return lines + ["| " + " | ".join(map(str, row)) + " |" for row in rows]


def rate(number: float | None) -> str:
    """Return a rate, or nothing."""
    return "" if number is None else f"{number:.2e}"


def _loading(rows: list[dict[str, Any]]) -> list[str]:
    return table(
        ("program", "compiled by the driver", "registers", "stack [B]", "threads at a time"),
        [
            (r["kernel"], f"{r['seconds']:.1f} s", r["registers"], r["stack"], r["resident"])
            for r in rows
        ],
    )


def _speed(rows: list[dict[str, Any]]) -> list[str]:
    return table(
        ("kernel", "cells", "kernel", "call", "cells/s", "impacts/s"),
        [
            (
                r["kernel"],
                r["cells"],
                f"{1e3 * r['kernel_s']:.1f} ms",
                f"{1e3 * r['whole_s']:.1f} ms",
                rate(r["cells_per_s"]),
                rate(r["impacts_per_s"]),
            )
            for r in rows
        ],
    )


def _shapes(rows: list[dict[str, Any]]) -> list[str]:
    return table(
        ("kernel", "cells", "threads a block", "most registers", "kernel", "cells/s"),
        [
            (
                r["kernel"],
                r["cells"],
                r["block"],
                r["registers"] or "",
                f"{1e3 * r['kernel_s']:.1f} ms",
                rate(r["cells_per_s"]),
            )
            for r in rows
        ],
    )


def _orders(rows: list[dict[str, Any]]) -> list[str]:
    return table(
        ("kernel", "order of the cells", "cells", "kernel", "cells/s"),
        [
            (
                r["kernel"],
                r["order"],
                r["cells"],
                f"{1e3 * r['kernel_s']:.1f} ms",
                rate(r["cells_per_s"]),
            )
            for r in rows
        ],
        words=2,
    )


def _sameness(rows: list[dict[str, Any]]) -> list[str]:
    lines = table(
        ("kernel", "cells compared", "other class", "other bits", "left to the processor"),
        [(r["kernel"], r["cells"], r["classes"], r["bits"], r["left_over"]) for r in rows],
    )
    unlike = [(r["kernel"], each) for r in rows for each in r["first"]]
    if unlike:
        lines += ["", "The first cells with other bits:", ""]
        lines += [f"- {name}: `{json.dumps(each)}`" for name, each in unlike]
    return lines


def _map(rows: list[dict[str, Any]]) -> list[str]:
    lines = table(
        ("map of fates with a store", "executor", "cells", "elapsed", "the same"),
        [
            (
                r["model"],
                r["executor"],
                r["cells"],
                f"{r['seconds']:.2f} s",
                "" if "same" not in r else "yes" if r["same"] else "no",
            )
            for r in rows
        ],
        words=2,
    )
    return [*lines, "", COMPILED]


def _atlas(data: dict[str, Any]) -> list[str]:
    kinds = ", ".join(f"{number} {name}" for name, number in data["kinds"].items() if number)
    several = ", ".join(
        f"{number} points with {count}" for count, number in data["points_by_motions"].items()
    )
    text = (
        f"**Atlas of coexisting motions**: {data['cells']} cells, {data['phases']} phases at each "
        f"of {data['points']} points of amplitude and frequency, in {data['seconds']:.1f} s with a "
        f"store: {kinds}; different motions at a point: {several}."
    )
    return [wrapped(text)]


TABLES: dict[str, Callable[[Any], list[str]]] = {
    "loading": _loading,
    "speed": _speed,
    "shapes": _shapes,
    "orders": _orders,
    "sameness": _sameness,
    "map": _map,
    "atlas": _atlas,
}


if __name__ == "__main__":
    given = [Path(argument) for argument in sys.argv[1:]]
    defaults = [ROOT / "out" / "gpu.json", ROOT / "docs" / "benchmarks.md"]
    main(*(given + defaults[len(given) :]))
