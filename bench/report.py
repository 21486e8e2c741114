"""Turn the results of a benchmark run into one table: on the terminal and in docs/benchmarks.md.

``python bench/report.py [BENCH.JSON [REPORT.MD]]``; `make bench` calls it. The page has sections,
each with a run of its own; what writes one leaves the others as they are.
"""

import json
import os
import platform
import re
import sys
from importlib.metadata import version
from pathlib import Path
from typing import Any, NamedTuple

from rich.console import Console
from rich.table import Table

ROOT = Path(__file__).resolve().parent.parent
NEEDED_RATIO = 20.0
SAMPLE_AIMS = {"flight, plain": "aim 25 ns", "earthquake, with peaks": "aim 90 ns"}
PACKAGES = ("rocksteady", "numba", "numpy", "pytest-benchmark")

# The sections of the page, in their order; `make bench-peers` writes the second, `make
# bench-explorer` the third and `make bench-gpu` the fourth.
PACKAGE = "The package"
PEERS = "Beside other solvers"
EXPLORER = "The explorer"
MEASURED_GPU = "A GPU, measured"
SECTIONS = (PACKAGE, PEERS, EXPLORER, MEASURED_GPU)

INTRODUCTION = """\
Written by `make bench`; do not edit. Medians; CPU time of one core, compilation excluded, for the
march and the steady states, elapsed time for the starts of a process.

**B1**: 100 x 100 cells of (Omega from 1 to 12, A from 1 to 6), 200 forcing periods each,
restitution 0.8, phase 0, angle 0 and velocity d(theta/alpha)/d(pt) = 0.3 at the start. **B2**: the
same from rest. **Lanes**: the same cells with trajectories side by side in vector registers;
leaping, over the periods of those that have become periodic.
**Sampling**: the closed form between impacts, {samples} samples per forcing period,
bisection to the last bit where the sign changes, overturned above an angle of 10 alpha
(`bench/sampling_march.py`). Its row and the one above it run every fourth cell of either axis,
{thinned} cells: their fate (overturned or not) agrees in {fates} (B1 and B2), their number of
impacts in {counts}. **Samples**: white noise in flight and at rest, and coloured noise of 54 s like
an earthquake (5400 samples of 0.01 s, 3.4 m/s²) on a block that lifts at 2 m/s² (p = 2/s,
restitution 0.9), for chatter at 3 m/s² (8/s, 0.97); as *runs* of samples, the same keeping the
peaks, and as single *segments*; 400 blocks on the latter noise, with uplift from 0.5 to 3.3 m/s²
and p from 1 to 8/s, come to rest where that is proved, as for a spectrum. **Spectrum**: 100 sizes
2 pi/p from 0.5 to 8 s and 5 slendernesses from 0.1 to 0.3 on such noise; elapsed time on all cores.
**Steady**: Omega from 0.014 to 14, A from 0.006 to 6, restitution
0.8, n = 1; *with shapes* adds peak, number of extrema and admissibility to phase, velocity and the
trace that decides on stability, for both branches. **Attractors**: what a block settles to from
rest, A from 0.5 to 6, Omega from 0.5 to 10, restitution 0.8. **Orbits**: up to 3 forcing periods
and 6 impacts at A = 1, Omega = 2, restitution 0.8, from 96 x 96 seeds. **Branch**: the harmonic
symmetric orbit of A = 2, restitution 0.8 over Omega, with multipliers and admissibility of each
point; **cascade**: the doublings that end near Omega = 1.7717. **Basins**, **erosion**, **map**:
elapsed time on all cores. Basins are 200 x 200 states over 200 periods, periodic at A = 1,
Omega = 2, restitution 0.8 and chaotic at A = 6, Omega = 6, restitution 0.25; the erosion has 17
amplitudes up to 1.6 at Omega = 2, restitution 0.9, with 200 x 200 states over 100 periods each, or
30 x 30 of a block of alpha = 0.2 in either model; the map has the axes of the attractors, and the
attractors of B1 its parameters and start. **Sweeps**: one map of attractors from rest, restitution
0.8, A from 1.2 to 6, Omega from 0.5 to 8, up to 2000 periods, in each of the ways to compute and to
keep it; and what the engine costs where a cell costs nothing. **Nonlinear**: blocks of alpha = 0.2
with the default tolerance, every fourth cell of either axis of B1, by the march, in lanes and as a
map of fates in one thread, the same cells with a block whose sides differ (0.15 and 0.25 m, height
1.2 m), the windows of a Ricker pulse, and the noise above in flight and as an
earthquake; some cells that stand beside scipy's DOP853 (rtol 1e-12, an event for each impact,
Python functions), which finds as many impacts in {solved} of them. **Risk**: elapsed time on all
cores; a block of 0.32 x 1.8 m on 56 synthetic motions at 20 levels with 10 restitutions.
**Observations**: elapsed time of two threads; 49 tests of 18 s at 100 Hz, of which half topple,
with 1500 blocks (alpha from 0.1 to 0.2, p from 2 to 5/s) at 5 gains, restitution that scatters by
0.05: a tenth of what a calibration of 490 tests takes, as its aims are.
"""


class Line(NamedTuple):
    """One row of the report."""

    what: str
    median: str
    each: str
    impact: str
    against: str


def main(source: Path, target: Path) -> None:
    """Read the results, print the table and write the page."""
    data = json.loads(source.read_text(encoding="utf-8"))
    results = {(b["group"], b["name"].removeprefix("test_")): b for b in data["benchmarks"]}
    march = {name: b for (group, name), b in results.items() if group == "march"}
    lines = []
    ratios = []
    alone = {
        "orbits": orbits_line,
        "continuation": continuation_line,
        "overturning": overturning_line,
        "spectra": spectra_line,
        "risk": risk_line,
        "observations": risk_line,
    }
    for unit in ("B1", "B2"):
        if f"march[{unit}]" not in march:
            continue
        lines.append(march_line(f"march {unit}", march[f"march[{unit}]"], guide(unit)))
        for mode, words in (("in_full", "lanes"), ("leaping", "lanes, leaping")):
            lanes = march[f"lanes[{unit}-{mode}]"]
            faster = march[f"march[{unit}]"]["stats"]["median"] / lanes["stats"]["median"]
            lines.append(march_line(f"{words}, {unit}", lanes, f"{faster:.1f} x the march"))
        ours, plain = march[f"march_thinned[{unit}]"], march[f"sampling_march[{unit}]"]
        ratio = plain["stats"]["median"] / ours["stats"]["median"]
        ratios.append(ratio)
        lines.append(march_line(f"march {unit}, every fourth cell", ours, ""))
        lines.append(
            march_line(f"sampling {unit}, every fourth cell", plain, f"{ratio:.1f} x slower")
        )
    for (group, name), b in results.items():
        if group == "steady":
            points = b["extra_info"]["points"]
            label = name.removeprefix("steady[").removesuffix("]")
            seconds = b["stats"]["median"]
            goal = "guide 3 s" if "shapes" in label else "guide 0.1 s"
            each = f"{1e6 * seconds / points:.3f} µs a point"
            lines.append(Line(f"steady 1000 x 1000, {label}", duration(seconds), each, "", goal))
        elif group == "samples":
            lines.append(samples_line(name, b, results))
        elif group == "nonlinear":
            lines.append(nonlinear_line(name, b, results))
        elif group in alone:
            lines.append(alone[group](name, b))
        elif group == "grids":
            lines.append(grid_line(name, b, results))
        elif group == "sweeps":
            lines.append(sweep_line(name, b, results[group, "map[one thread]"]))
        elif group == "start":
            label = name.removeprefix("start[").removesuffix("]")
            goal = "guide 0.3 s" if "--help" in label else ""
            lines.append(Line(label, duration(b["stats"]["median"]), "", "", goal))
    machine = machine_line(data["machine_info"])
    show(lines, machine)
    write_section(target, PACKAGE, section(lines, machine, results))
    if ratios and min(ratios) < NEEDED_RATIO:
        print(f"Sampling is {min(ratios):.1f} x slower where {NEEDED_RATIO:.0f} x is asked.")


def overturning_line(name: str, result: dict[str, Any]) -> Line:
    """Return the row of the windows of one pulse."""
    seconds, frequencies = result["stats"]["median"], result["extra_info"]["frequencies"]
    shape = name.removeprefix("windows[").removesuffix("]")
    nonlinear = name == "windows_nonlinear"
    if nonlinear:
        shape = "ricker, nonlinear"
    return Line(
        f"windows of {shape}, {frequencies} frequencies",
        duration(seconds),
        f"{1e3 * seconds / frequencies:.1f} ms a frequency",
        "",
        f"200 in {200 * seconds / frequencies:.1f} s; aim 15 s" if nonlinear else "guide 10 s",
    )


def nonlinear_line(
    name: str, result: dict[str, Any], results: dict[tuple[str, str], dict[str, Any]]
) -> Line:
    """Return a row of the nonlinear model; that of the general solver beside the march's."""
    info, seconds = result["extra_info"], result["stats"]["median"]
    if "samples" in info:
        # As "record[earthquake-with peaks]".
        case = name.removeprefix("record[").removesuffix("]").replace("-", ", ")
        each, impacts = 1e9 * seconds / info["samples"], info["impacts"]
        return Line(
            f"nonlinear, {info['samples']} samples, {case}",
            duration(seconds),
            f"{each:.0f} ns a sample",
            f"{1e9 * seconds / impacts:.0f} ns" if impacts else "",
            SAMPLE_AIMS.get(case, ""),
        )
    label = {
        "march_b1[symmetric]": "nonlinear march B1, every fourth cell",
        "march_b1[unlike sides]": "the same, sides unlike",
        "lanes_b1[symmetric]": "nonlinear lanes, leaping, B1, every fourth cell",
        "lanes_b1[unlike sides]": "the same, sides unlike",
        "map_fates_b1": "nonlinear map of fates B1, every fourth cell",
        "march_some": f"nonlinear march, {info['trajectories']} cells that stand",
        "solver_some": "DOP853 on these cells",
    }[name]
    ratio = seconds / results["nonlinear", "march_some"]["stats"]["median"]
    against = {
        "march_b1[symmetric]": "aim 80 µs",
        "lanes_b1[symmetric]": "aim 20 µs",
        "map_fates_b1": "aim 20 µs",
        "solver_some": f"{ratio:.0f} x slower",
    }
    return march_line(label, result, against.get(name, ""))


def spectra_line(name: str, result: dict[str, Any]) -> Line:
    """Return the row of the spectrum of one record."""
    info, seconds = result["extra_info"], result["stats"]["median"]
    how = name.removeprefix("spectrum[").removesuffix("]").strip("-").replace("-", ", ")
    return Line(
        f"spectrum of {info['blocks']} blocks, {how}",
        duration(seconds),
        f"{1e6 * seconds / info['blocks']:.0f} µs a block",
        "",
        f"guide {info['guide']:g} s",
    )


def risk_line(_: str, result: dict[str, Any]) -> Line:
    """Return the row of a step of an assessment."""
    info, seconds = result["extra_info"], result["stats"]["median"]
    each = f"{1e6 * seconds / info['count']:.0f} µs each"
    return Line(info["what"], duration(seconds), each, "", info["aim"])


def samples_line(
    name: str, result: dict[str, Any], results: dict[tuple[str, str], dict[str, Any]]
) -> Line:
    """Return the row of one march over samples, beside that over single segments."""
    info, seconds = result["extra_info"], result["stats"]["median"]
    case, _, way = name.removesuffix("]").replace("[", "-").rpartition("-")
    plain = results["samples", f"{name[: -len(way) - 1]}segments]"]["stats"]["median"]
    label = case.removeprefix("samples").strip("-_").replace("_", " ")
    impacts = info["impacts"]
    return Line(
        f"{info['samples']} samples, {label}, {way}",
        duration(seconds) if seconds > 1e-3 else f"{1e6 * seconds:.0f} µs",
        f"{1e9 * seconds / info['samples']:.1f} ns a sample",
        f"{1e9 * seconds / impacts:.0f} ns" if impacts else "",
        f"{plain / seconds:.1f} x faster than segments" if way != "segments" else "",
    )


def orbits_line(name: str, result: dict[str, Any]) -> Line:
    """Return the row of attractors over a grid, or of the orbits at a point."""
    info, seconds = result["extra_info"], result["stats"]["median"]
    if name == "attractors":
        each = f"{1e6 * seconds / info['points']:.0f} µs a point"
        return Line("attractors from rest, 50 x 50", duration(seconds), each, "", "")
    each = f"{1e3 * seconds / info['orbits']:.1f} ms an orbit"
    return Line(f"all {info['orbits']} orbits at a point", duration(seconds), each, "", "")


def continuation_line(name: str, result: dict[str, Any]) -> Line:
    """Return the row of a branch, or of the cascade of doublings."""
    points, seconds = result["extra_info"]["points"], result["stats"]["median"]
    if "cascade" in name:
        each = f"{1e3 * seconds / points:.1f} ms a doubling"
        return Line(f"cascade of {points} doublings", duration(seconds), each, "", "")
    each = f"{1e6 * seconds / points:.0f} µs a point"
    return Line(f"branch of {points} points", duration(seconds), each, "", "guide 2 s")


def grid_line(
    name: str, result: dict[str, Any], results: dict[tuple[str, str], dict[str, Any]]
) -> Line:
    """Return the row of many cases in threads; the erosion of one model beside the other."""
    cells, seconds = result["extra_info"]["cells"], result["stats"]["median"]
    label, _, kind = name.removesuffix("]").partition("[")
    what = (
        f"{label.replace('_', ' ').replace('b1', 'B1')}{', ' if kind else ''}{kind}, {cells} cells"
    )
    goal = "" if "erosion" in label else "guide 5 s"
    if kind == "nonlinear":
        linear = results["grids", f"{label}[linear]"]["stats"]["median"]
        goal = f"{seconds / linear:.0f} x linear; aim 10 x"
    elif label == "attractors_of_b1":
        goal = f"10^6 in {1e6 * seconds / cells:.1f} s; aim 3.5 s"
    return Line(what, duration(seconds), f"{1e6 * seconds / cells:.1f} µs a cell", "", goal)


def sweep_line(name: str, result: dict[str, Any], alone: dict[str, Any]) -> Line:
    """Return the row of one sweep in one way; maps beside the one in a single thread."""
    cells, seconds = result["extra_info"]["cells"], result["stats"]["median"]
    label, _, way = name.removesuffix("]").partition("[")
    what = "map of attractors" if label == "map" else "cells of next to no work"
    ratio = alone["stats"]["median"] / seconds
    against = f"{ratio:.2f} x one thread" if label == "map" else ""
    each = f"{1e6 * seconds / cells:.2f} µs a cell"
    return Line(f"{what}, {way}, {cells} cells", duration(seconds), each, "", against)


def guide(unit: str) -> str:
    """Return the target of a work unit, where there is one."""
    return "aim 20 µs" if unit == "B1" else ""


def march_line(what: str, result: dict[str, Any], against: str) -> Line:
    """Return the row of one run of a march."""
    info = result["extra_info"]
    return Line(
        what,
        duration(result["stats"]["median"]),
        f"{info['us_per_trajectory']:.1f} µs a trajectory",
        f"{info['ns_per_impact']:.0f} ns",
        against,
    )


def duration(seconds: float) -> str:
    """Return a time in the unit that suits it."""
    return f"{seconds:.2f} s" if seconds >= 1.0 else f"{1e3 * seconds:.1f} ms"


def machine_line(info: dict[str, Any]) -> str:
    """Return what the figures depend on: processor, cores, versions; no names of hosts."""
    cpu = info["cpu"]
    model = cpu.get("brand_raw", "unknown processor")
    kind = f"family {cpu.get('family', '?')} model {cpu.get('model', '?')}"
    speed = cpu.get("hz_actual_friendly", "unknown clock")
    packages = ", ".join(f"{name} {version(name)}" for name in PACKAGES)
    return (
        f"{model} ({kind}, {speed}), {cpu.get('count', os.cpu_count())} cores; "
        f"{info['system']} {info['machine']}; Python {platform.python_version()}, {packages}"
    )


def show(lines: list[Line], machine: str) -> None:
    """Print the table."""
    table = Table(title="rocksteady benchmarks", caption=machine, title_justify="left")
    for heading in ("what", "median", "each", "an impact", "against"):
        table.add_column(heading, justify="left" if heading in {"what", "against"} else "right")
    for line in lines:
        table.add_row(*(part.replace("[", r"\[") for part in line))
    Console(width=None if sys.stdout.isatty() else 110).print(table)


def section(lines: list[Line], machine: str, results: dict[tuple[str, str], dict[str, Any]]) -> str:
    """Return the section of the package in Markdown."""
    sampled = [
        b["extra_info"]
        for (group, name), b in results.items()
        if group == "march" and name.startswith("sampling")
    ]
    solver = results.get(("nonlinear", "solver_some"))
    introduction = INTRODUCTION.format(
        solved=f"{100 * solver['extra_info']['same_impacts']:.0f} %" if solver else "none",
        samples=" and ".join({str(info["samples_per_period"]) for info in sampled}) or "no",
        thinned=" and ".join({str(info["trajectories"]) for info in sampled}) or "no",
        fates=" and ".join(f"{100 * info['same_fate']:.1f} %" for info in sampled) or "none",
        counts=" and ".join(f"{100 * info['same_impacts']:.1f} %" for info in sampled) or "none",
    )
    rows = ["| what | median | each | an impact | against |", "|---|--:|--:|--:|---|"]
    rows += ["| " + " | ".join(line) + " |" for line in lines]
    return "\n".join([introduction, machine + ".", "", *rows])


def write_section(target: Path, heading: str, text: str) -> None:
    """Put a section into the page, in place of its former self; the other sections stay."""
    page = target.read_text(encoding="utf-8") if target.exists() else ""
    _, *parts = re.split(r"^## (.+)$", page, flags=re.MULTILINE)
    sections = dict(zip(parts[::2], parts[1::2], strict=True)) | {heading: text}
    target.parent.mkdir(parents=True, exist_ok=True)
    names = sorted(sections, key=lambda name: SECTIONS.index(name) if name in SECTIONS else 99)
    written = [f"## {name}\n\n{sections[name].strip()}" for name in names]
    target.write_text("\n\n".join(["# Benchmarks", *written, ""]), encoding="utf-8")


if __name__ == "__main__":
    given = [Path(argument) for argument in sys.argv[1:]]
    defaults = [ROOT / "out" / "bench.json", ROOT / "docs" / "benchmarks.md"]
    main(*(given + defaults[len(given) :]))
