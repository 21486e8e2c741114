"""Measure the explorer's page: ``python -m bench.explorer``.

Writes out/explorer.json and, from it, its part of docs/benchmarks.md; `make bench-explorer` calls
it.
"""

import gzip
import json
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from playwright.sync_api import Browser
from pytest_benchmark.plugin import pytest_benchmark_generate_machine_info
from rich.console import Console
from rich.table import Table

from bench.explorer.session import (
    BLOCK,
    COARSE,
    DRAG,
    FIRST_MAP,
    LANDING,
    MAP,
    MOVED,
    PUSH,
    SHAKE,
    STAGE,
    chromium,
    opened,
)
from bench.report import EXPLORER, ROOT, machine_line, write_section
from rocksteady import write_explorer
from rocksteady.explorer._module import page_module
from rocksteady.explorer.view import PLACES
from rocksteady.export import ExplorerView

OPENINGS = 11
EVENTS = 200
DRAGS = 3
MOVES = 12
BLOCKS = {"rack": (0.6, 2.0), "cabinet": (0.25, 1.0)}
"""Width and height [m]."""
KINDS = {"on": "goes on", "push": "one push"}
INTRODUCTION = """\
Written by `make bench-explorer`; do not edit. The page of `rocksteady explore` without ground
motions, in Chromium {version} without a graphics card, 1280 x 800 pixels. *First picture*: from the
request of the file until the block is drawn, in *Shake it* with the axes of its map, each time in a
new profile; *first map*: until its first 16 x 12 cells are drawn. *Hand, work*: what an event of
the hand and the frame after it take together on the main thread, the march of the kernels included;
{events} events, {drags} times. *Hand, until it is drawn*: from an event until ground that was at
rest is drawn elsewhere; it goes where the hand was 1/60 s ago. *Point, work*: as of the hand,
while the point of the map is dragged. *Coarse map*: from a change of the block until the first
16 x 12 cells are drawn. *Longest task*: on the main thread; the browser reports those of 50 ms and
more.
"""


def main(target: Path, page: Path) -> None:
    """Measure, and write both files."""
    target.parent.mkdir(parents=True, exist_ok=True)
    data = measured(write_explorer(target.parent / "explorer.html"))
    data["machine"] = pytest_benchmark_generate_machine_info()
    target.write_text(json.dumps(data, indent=1, default=str) + "\n", encoding="utf-8")
    rows = lines(data)
    machine = machine_line(data["machine"])
    show(rows, machine)
    write_section(page, EXPLORER, section(rows, machine, data))


def measured(file: Path) -> dict[str, Any]:
    """Return the sizes of a page and what it takes."""
    text, module = file.read_bytes(), page_module().read_bytes()
    data: dict[str, Any] = {
        "bytes": len(text),
        "packed": len(gzip.compress(text, 9)),
        "module": len(module),
        "module_packed": len(gzip.compress(module, 9)),
    }
    with TemporaryDirectory() as folder:
        sizes = [
            write_explorer(Path(folder, "scene.html"), ExplorerView(scene=scene), embed=True)
            .stat()
            .st_size
            for scene in PLACES[:-1]
        ]
    data["scene"] = max(sizes)
    with chromium() as browser:
        data["version"] = browser.version
        return data | openings(browser, file) | hands(browser, file) | maps(browser, file)


def openings(browser: Browser, file: Path) -> dict[str, list[float]]:
    """Return when first pictures are there, and the longest tasks until then."""
    found: dict[str, list[float]] = {}
    for _ in range(OPENINGS):
        for name, where in (("landing", LANDING), ("shake", SHAKE)):
            view, first = opened(browser, file, where, reduced_motion="reduce")
            view.wait_for_timeout(1500.0)
            found.setdefault(f"first_{name}", []).append(first)
            found.setdefault(f"long_{name}", []).append(longest(view.evaluate("window.long_")))
            if where == SHAKE:
                found.setdefault("first_map", []).append(view.evaluate(f"({FIRST_MAP})(0)"))
            view.context.close()
    return found


def hands(browser: Browser, file: Path) -> dict[str, list[float]]:
    """Return what the hand on the ground and on the map's point takes."""
    found: dict[str, list[float]] = {}
    for _ in range(DRAGS):
        for name, where, canvas in (
            ("hand_landing", LANDING, STAGE),
            ("hand_shake", SHAKE, BLOCK),
            ("point_on", SHAKE, MAP),
            ("point_push", PUSH, MAP),
        ):
            view, _ = opened(browser, file, where, reduced_motion="reduce")
            view.wait_for_timeout(3000.0)
            view.evaluate("window.long_.length = 0")
            found.setdefault(name, []).extend(view.evaluate(DRAG, [canvas, EVENTS]))
            view.wait_for_timeout(500.0)
            found.setdefault("long_hands", []).append(longest(view.evaluate("window.long_")))
            view.context.close()
    view, _ = opened(browser, file, SHAKE, reduced_motion="reduce")
    view.wait_for_timeout(3000.0)
    waited = view.evaluate(MOVED, [BLOCK, MOVES])
    view.context.close()
    return found | {
        "moved": [each["time"] for each in waited],
        "moved_frames": [each["frames"] for each in waited],
    }


def maps(browser: Browser, file: Path) -> dict[str, list[float]]:
    """Return how long the coarse maps of two blocks take; none is the same twice."""
    found: dict[str, list[float]] = {}
    view, _ = opened(browser, file, SHAKE, reduced_motion="reduce")
    view.wait_for_timeout(3000.0)
    for turn in range(OPENINGS):
        for block, (width, height) in BLOCKS.items():
            for kind in KINDS:
                address = f"{SHAKE}&kind={kind}&b={width + 0.001 * turn:.3f}&h={height}"
                found.setdefault(f"coarse_{block}_{kind}", []).append(
                    view.evaluate(COARSE, address)
                )
    view.context.close()
    return found


def longest(tasks: list[dict[str, float]]) -> float:
    """Return the longest task [ms], 0 where none was long."""
    return max((task["duration"] for task in tasks), default=0.0)


def lines(data: dict[str, Any]) -> list[tuple[str, str, str, str]]:
    """Return the rows: what, median, 95 %, aim."""

    def timed(what: str, name: str, aim: str = "") -> tuple[str, str, str, str]:
        middle, high = np.percentile(data[name], (50, 95))
        least = "under 50 ms" if name.startswith("long_") else "0.0 ms"
        texts = [f"{value:.1f} ms" if value else least for value in (middle, high)]
        return what, texts[0], texts[1], aim

    def counted(what: str, name: str, aim: str) -> tuple[str, str, str, str]:
        middle, high = np.percentile(data[name], (50, 95))
        return what, f"{middle:.0f}", f"{high:.0f}", aim

    def sized(what: str, name: str, aim: str) -> tuple[str, str, str, str]:
        return what, f"{data[name] / 1000.0:.0f} kB", "", aim

    return [
        sized("the page", "bytes", "600 kB"),
        sized("the page, packed", "packed", ""),
        sized("a scene alone, its largest", "scene", "250 kB"),
        sized("its kernels", "module", ""),
        sized("its kernels, packed", "module_packed", ""),
        timed("first picture, landing", "first_landing", "500 ms"),
        timed("first picture, Shake it", "first_shake", "500 ms"),
        timed("first map, Shake it", "first_map"),
        timed("hand, work, landing", "hand_landing", "95 %: 16 ms"),
        timed("hand, work, Shake it", "hand_shake", "95 %: 16 ms"),
        timed("hand, until it is drawn", "moved", "16 ms"),
        counted("hand, frames until it is drawn", "moved_frames", "1"),
        *(
            timed(f"point, work, {words}", f"point_{kind}", "95 %: 16 ms")
            for kind, words in KINDS.items()
        ),
        *(
            timed(f"coarse map, {width} x {height} m, {words}", f"coarse_{block}_{kind}", "100 ms")
            for block, (width, height) in BLOCKS.items()
            for kind, words in KINDS.items()
        ),
        timed("longest task, landing", "long_landing", "50 ms"),
        timed("longest task, Shake it opens", "long_shake", "50 ms"),
        timed("longest task, hand and point", "long_hands", "50 ms"),
    ]


def show(rows: list[tuple[str, str, str, str]], machine: str) -> None:
    """Print the table."""
    table = Table(title="the explorer", caption=machine, title_justify="left")
    for heading in ("what", "median", "95 %", "aim"):
        table.add_column(heading, justify="left" if heading in {"what", "aim"} else "right")
    for row in rows:
        table.add_row(*row)
    Console().print(table)


def section(rows: list[tuple[str, str, str, str]], machine: str, data: dict[str, Any]) -> str:
    """Return the section in Markdown."""
    introduction = INTRODUCTION.format(
        version=data["version"].partition(".")[0],
        events=EVENTS,
        drags=DRAGS,
    )
    table = ["| what | median | 95 % | aim |", "|---|--:|--:|---|"]
    table += ["| " + " | ".join(row) + " |" for row in rows]
    return "\n".join([introduction, machine + ".", "", *table])


if __name__ == "__main__":
    main(ROOT / "out" / "explorer.json", ROOT / "docs" / "benchmarks.md")
