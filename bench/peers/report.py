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
NONLINEAR_AIMS = {"rocksteady": 30.0}
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


NONLINEAR = """\
### The nonlinear model

The same cells, every 4th of either axis and for scipy every 24th, with the full equation of motion
of blocks of alpha = 0.2. *Rocksteady there* is `map_fates` in one thread with its default
tolerance, on the same cells right before and after. A block is overturned once it rises past
1 + arctan(alpha A)/alpha, from where it provably cannot return, or by the proof of the package.

What is right is what Taylor series in {digits} digits find, which share no code with the package
and cannot miss an impact (`bench/peers/pendulum.py`): on {checked} cells, every 8th of either axis,
and the three columns on the right are for those that a solver ran. {unchanged} of {again} come out
the same in {digits} and in {more_digits} digits.
"""


def main(source: Path, target: Path) -> None:
    """Read the results, print the table and write the section."""
    data = json.loads(source.read_text(encoding="utf-8"))
    machine = machine_line(data["machine"])
    show("B1 beside other solvers", data["rows"], machine)
    show("B1, nonlinear, beside other solvers", data["nonlinear"]["rows"], machine)
    write_section(target, PEERS, section(data, machine))
    print("\n".join(shortfalls(data["rows"], AIMS)))
    print("\n".join(shortfalls(data["nonlinear"]["rows"], NONLINEAR_AIMS)))


def show(title: str, rows: list[dict[str, Any]], machine: str) -> None:
    """Print a table."""
    table = Table(title=title, caption=machine, title_justify="left")
    for i, heading in enumerate(HEADINGS):
        table.add_column(heading, justify="left" if i < LEFT else "right")
    for row in rows:
        table.add_row(*line(row))
    Console(width=None if sys.stdout.isatty() else 160).print(table)


def markdown(rows: list[dict[str, Any]]) -> list[str]:
    """Return a table in Markdown, line by line."""
    return [
        "| " + " | ".join(HEADINGS) + " |",
        "|---" * LEFT + "|--:" * (len(HEADINGS) - LEFT) + "|",
        *("| " + " | ".join(line(row)) + " |" for row in rows),
    ]


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


def section(data: dict[str, Any], machine: str) -> str:
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
    notes = [
        CONTACT.format(linear=share(row["linear_class"])) + row["remark"]
        for row in data["rows"]
        if "linear_class" in row
    ]
    parts = [introduction, f"{machine}.", "", *markdown(data["rows"]), ""]
    parts += [*shortfalls(data["rows"], AIMS), *notes, "", *nonlinear_part(data["nonlinear"])]
    return "\n".join(parts)


def nonlinear_part(data: dict[str, Any]) -> list[str]:
    """Return what the section has on the nonlinear model, in Markdown, line by line."""
    check = data["check"] | {"checked": data["check"]["cells"]}
    table = markdown(data["rows"])
    return [NONLINEAR.format(**check), *table, "", *shortfalls(data["rows"], NONLINEAR_AIMS)]


def shortfalls(rows: list[dict[str, Any]], aims: dict[str, float]) -> list[str]:
    """Return what was aimed at and is not reached."""
    timed = [row for row in rows if "us" in row]
    lines = []
    for name, aim in aims.items():
        ratios = [
            row["us"] / own["us"]
            for own in timed
            if own["name"] == name
            for row in timed
            if row["name"].startswith(AGAINST)
        ]
        if ratios and min(ratios) < aim:
            reached = " and ".join(f"{ratio:.3g}" for ratio in ratios)
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
