"""Turn what the solvers did into one table: on the terminal and in docs/benchmarks.md.

``python -m bench.peers.report`` writes it anew from out/peers.json.
"""

import json
import sys
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.table import Table

from bench.report import PEERS, ROOT, machine_line, write_section

HEADINGS = (
    "solver",
    "version",
    "settings",
    "cells",
    "µs a trajectory",
    "rocksteady there",
    "ratio",
    "set-up",
    "same class",
    "same impacts",
    "last impact [rad]",
)
AGAINST = "heyoka"
AIMS = {"rocksteady": 200.0, "rocksteady, leaping": 500.0}  # times as fast, in one run
LEFT = 3  # so many columns hold words

INTRODUCTION = """\
Written by `make bench-peers`; do not edit. Work unit B1 in other solvers, each written as its users
would at its best (`bench/peers`): CPU time of one core, every trajectory run to its end of 200
forcing periods or to overturning. *Set-up*, import and compilation, is not in the times (heyoka and
the package keep compiled code on disk: their first set-up takes longer). Slow solvers run every
{thinnings} cell of either axis. *Rocksteady there* is the package on the same cells as in its first
row, right before and after, and *ratio* is against that. *Same class*: the share of cells whose
fate, overturned or not, is right; *same impacts*: the share whose number of impacts is, without the
{rested} cells of the map that come to rest, where it is a matter of the rest rule; *last impact*:
its error as a phase of the shaking, median and largest over the cells with the right number. The
largest ones stand in few cells, where rounding grows fastest. All but MuJoCo call a block
overturned once its angle rises past 1 + A, from where it provably cannot return, or by the proof of
the package.

What is right is what the package finds, settled by a march in {digits} digits that shares no code
with it and cannot miss an impact (`bench/peers/reference.py`): on every fourth cell of either axis,
{checked} cells, and in {more_digits} digits on the {disputed} in which a solver disagrees with the
package or has its largest errors. The rows of the package are for these cells. {unchanged} of
{again} come out the same in {digits} and in {more_digits} digits.
"""

CONTACT = """\
**MuJoCo** runs another experiment, for a physics engine cannot be told the restitution of an
angular velocity: what remains after an impact comes out of its contacts. With contacts that do not
rebound a rectangle keeps Housner's 1 - 1.5 sin² alpha, so that a restitution of 0.8 belongs to a
block of alpha = 0.374 rad and no slender one can have it. It runs that rectangle, and its class and
number of impacts are compared with the nonlinear equation of motion at restitution 0.8
(Runge-Kutta, 2000 steps a period), which gives the class of the linear model in {linear} of these
cells. Its impacts are changes of the sign of the rotation.
"""


def main(source: Path, target: Path) -> None:
    """Read the results, print the table and write the section."""
    data = json.loads(source.read_text(encoding="utf-8"))
    lines = [line(row) for row in data["rows"]]
    machine = machine_line(data["machine"])
    table = Table(title="B1 beside other solvers", caption=machine, title_justify="left")
    for i, heading in enumerate(HEADINGS):
        table.add_column(heading, justify="left" if i < LEFT else "right")
    for cells in lines:
        table.add_row(*cells)
    Console(width=None if sys.stdout.isatty() else 160).print(table)
    write_section(target, PEERS, section(data, lines, machine))
    print("\n".join(shortfalls(data)))


def line(row: dict[str, Any]) -> list[str]:
    """Return the cells of one row."""
    if "failed" in row:
        return [row["name"], "", row["failed"], *[""] * (len(HEADINGS) - LEFT)]
    return [
        row["name"],
        row["version"],
        row["settings"],
        str(row["cells"]),
        figure(row["us"]),
        figure(row["ours_us"]),
        figure(row["ratio"]),
        f"{row['setup_s']:.2f} s" if "setup_s" in row else "",
        share(row.get("same_class")),
        share(row.get("same_impacts")),
        "{median:.0e}, {largest:.0e}".format(**row["last_impact"]) if "last_impact" in row else "",
    ]


def section(data: dict[str, Any], lines: list[list[str]], machine: str) -> str:
    """Return the section in Markdown."""
    check = data["check"]
    side = round(data["cells"] ** 0.5)
    thinnings = sorted(
        {-(-side // round(row["cells"] ** 0.5)) for row in data["rows"] if "cells" in row} - {1}
    )
    introduction = INTRODUCTION.format(
        thinnings=" or ".join(f"{k}th" for k in thinnings) or "1st",
        rested=data["rested"],
        digits=check["digits"],
        checked=check["cells"],
        disputed=check["disputed"],
        unchanged=check["unchanged"],
        again=check["again"],
        more_digits=check["more_digits"],
    )
    rows = [
        "| " + " | ".join(HEADINGS) + " |",
        "|---" * LEFT + "|--:" * (len(HEADINGS) - LEFT) + "|",
    ]
    rows += ["| " + " | ".join(cells) + " |" for cells in lines]
    notes = [
        CONTACT.format(linear=share(row["linear_class"])) + row["remark"]
        for row in data["rows"]
        if "linear_class" in row
    ]
    return "\n".join([introduction, f"{machine}.", "", *rows, "", *shortfalls(data), *notes])


def shortfalls(data: dict[str, Any]) -> list[str]:
    """Return what was aimed at and is not reached, with and without leaps."""
    rows = {row["name"]: row for row in data["rows"] if "us" in row}
    lines = []
    for name, aim in AIMS.items():
        ratios = [
            rows[solver]["us"] / rows[name]["us"] for solver in rows if solver.startswith(AGAINST)
        ]
        if ratios and min(ratios) < aim:
            reached = " and ".join(f"{ratio:.0f}" for ratio in ratios)
            lines.append(
                f"Short of its aim: {AGAINST} takes {reached} times as long as *{name}*; aimed at "
                f"are {aim:.0f} times."
            )
    return [*lines, ""] if lines else []


def figure(value: float) -> str:
    """Return three digits, and whole thousands apart."""
    if value >= 100.0:
        return f"{value:,.0f}".replace(",", " ")
    return f"{value:.1f}"


def share(value: float | None) -> str:
    """Return a share in per cent: 100 % is all of them."""
    if value is None:
        return ""
    return "100 %" if value == 1.0 else f"{min(100.0 * value, 99.99):.2f} %"


if __name__ == "__main__":
    main(ROOT / "out" / "peers.json", ROOT / "docs" / "benchmarks.md")
