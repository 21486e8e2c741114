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
from pytest_benchmark.plugin import pytest_benchmark_generate_machine_info
from rich.console import Console
from rich.table import Table

from bench.explorer.session import (
    DRAG,
    LANDING,
    MAP,
    MAP_OF,
    REFINED,
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
INTRODUCTION = """\
Written by `make bench-explorer`; do not edit. The page of `rocksteady explore` without ground
motions, in Chromium {version} without a graphics card, 1440 x 900 pixels. *First picture*: from the
request of the file until the block is drawn, or all panels of the laboratory, each time in a new
profile. *From hand to block*: what an event of the hand and the frame after it take together on
the main thread, the march of the kernels included; 200 events, 3 times.
*Drag*: {events} events over the map, one a frame, {drags} times: *work* is what handler and frame
take together on the main thread, computing and drawing of all panels; *next frame* ends with the
frame after the event. *Coarse map*: from a zoom until there is a cell for each 8 x 8 pixels; *whole
map*: a cell for each pixel, {cells} of them. *128 x 128 cells*: 16 jobs of the page's workers.
*Longest task*: on the main thread while the page opens, and afterwards; the browser reports those
of 50 ms and more.
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
        firsts, opening, later, work, following, refined = [], [], [], [], [], []
        for _ in range(OPENINGS):
            view, first = opened(browser, file, reduced_motion="reduce")
            view.wait_for_timeout(1500.0)
            firsts.append(first)
            opening.append(longest(view.evaluate("window.long_")))
            view.context.close()
        for _ in range(DRAGS):
            view, _ = opened(browser, file, reduced_motion="reduce")
            view.wait_for_timeout(5000.0)
            view.evaluate("window.long_.length = 0")
            drag = view.evaluate(DRAG, [MAP, EVENTS])
            work += drag["work"]
            following += drag["next"]
            refined.append(view.evaluate(REFINED))
            later.append(longest(view.evaluate("window.long_")))
            view.context.close()
        blocks, landing, hand = [], [], []
        for _ in range(OPENINGS):
            view, first = opened(browser, file, LANDING, reduced_motion="reduce")
            view.wait_for_timeout(1500.0)
            blocks.append(first)
            if len(blocks) <= DRAGS:
                hand += view.evaluate(DRAG, [STAGE, EVENTS])["work"]
            landing.append(longest(view.evaluate("window.long_")))
            view.context.close()
        view, _ = opened(browser, file, reduced_motion="reduce")
        view.wait_for_timeout(5000.0)
        data["map_128"] = view.evaluate(MAP_OF, [128, 16])
    return data | {
        "first": firsts,
        "first_block": blocks,
        "hand": hand,
        "long_landing": landing,
        "work": work,
        "next": following,
        "coarse": [each["coarse"] for each in refined],
        "whole": [each["whole"] for each in refined],
        "cells": refined[0]["cells"],
        "long_opening": opening,
        "long_later": later,
    }


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

    def sized(what: str, name: str, aim: str) -> tuple[str, str, str, str]:
        return what, f"{data[name] / 1000.0:.0f} kB", "", aim

    return [
        sized("the page", "bytes", "600 kB"),
        sized("the page, packed", "packed", ""),
        sized("a scene alone, its largest", "scene", "250 kB"),
        sized("its kernels", "module", ""),
        sized("its kernels, packed", "module_packed", ""),
        timed("first picture, the block", "first_block", "500 ms"),
        timed("from hand to block, work", "hand", "95 %: 16 ms"),
        timed("longest task, the block", "long_landing", "50 ms"),
        timed("first picture, laboratory", "first", "600 ms"),
        timed("drag, work", "work", "95 %: 8 ms"),
        timed("drag, next frame", "next", "95 %: 33 ms"),
        timed("coarse map", "coarse", "100 ms"),
        timed("128 x 128 cells", "map_128", "400 ms"),
        timed("whole map", "whole"),
        timed("longest task, opening", "long_opening", "50 ms"),
        timed("longest task, drag and zoom", "long_later", "50 ms"),
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
        cells=f"{data['cells']:,}".replace(",", " "),
    )
    table = ["| what | median | 95 % | aim |", "|---|--:|--:|---|"]
    table += ["| " + " | ".join(row) + " |" for row in rows]
    return "\n".join([introduction, machine + ".", "", *table])


if __name__ == "__main__":
    main(ROOT / "out" / "explorer.json", ROOT / "docs" / "benchmarks.md")
