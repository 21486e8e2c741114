"""Run every solver on B1 and keep what it took and what it got right: ``python -m bench.peers``.

Writes out/peers.json and, from it, the table in docs/benchmarks.md; `make bench-peers` calls it. A
solver that is not installed, or that fails, has a row that says so.
"""

import importlib
import json
from pathlib import Path
from typing import Any

import numpy as np
from pytest_benchmark.plugin import pytest_benchmark_generate_machine_info
from rich.console import Console

from bench.peers import kernel, nonlinear, report
from bench.peers.runs import measured, noted, set_up
from bench.peers.truth import Truth, share
from bench.peers.work import OVERTURNED, Cells, Outcome, cells
from bench.report import ROOT

SOLVERS = {
    "kernel": "rocksteady",
    "taylor": "heyoka",
    "initial_value": "scipy",
    "runge_kutta": "numba",
    "contact": "MuJoCo",
}
CHECKED, DIGITS = 4, 60  # every so many-th cell is marched once more in so many digits
DOUBTED, MORE_DIGITS = 12, 120  # and every so many-th in more, as are cells in dispute


def main(target: Path, page: Path) -> None:
    """Run them all."""
    say = Console(stderr=True).print
    truth = Truth()
    say(f"{len(truth.impacts)} cells; checking some in {DIGITS} digits")
    check = checked(truth)
    rows: list[dict[str, Any]] = []
    disputed: set[int] = set()
    compared: list[tuple[dict[str, Any], Cells, Outcome]] = []
    package: list[tuple[dict[str, Any], Outcome]] = []
    for module, name in SOLVERS.items():
        with noted(name, rows, say):
            peers, setup = set_up(importlib.import_module(f"bench.peers.{module}").peers)
            for peer in peers:
                say(f"  {peer.name}")
                own = cells(peer.thinned)
                row, outcome = measured(peer, own, kernel.run)
                rows.append(row)
                if module == "kernel":
                    package.append((row, outcome))
                    continue
                row["setup_s"] = setup
                if peer.truth is not None:
                    linear = truth.overturned[own.index]
                    row.update(contact_agreement(peer.truth(own), outcome, linear))
                else:
                    disputed |= truth.disputed(own, outcome)
                    compared.append((row, own, outcome))
    say(f"{len(disputed)} cells in {MORE_DIGITS} digits")
    truth.settle(sorted(disputed), MORE_DIGITS)
    for row, own, outcome in compared:
        row.update(truth.agreement(own, outcome))
    for row, outcome in package:
        row.update(truth.own_agreement(outcome))
    data = {
        "machine": pytest_benchmark_generate_machine_info(),
        "cells": len(truth.impacts),
        "rested": int(truth.rested.sum()),
        "check": check | {"disputed": len(disputed)},
        "rows": rows,
        "nonlinear": nonlinear.compare(say),
    }
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_text(json.dumps(data, indent=1, default=str) + "\n", encoding="utf-8")
    report.main(target, page)


def checked(truth: Truth) -> dict[str, Any]:
    """March some cells in many digits, and some of these in more."""
    many, few = cells(CHECKED).index.tolist(), cells(DOUBTED).index.tolist()
    fates = dict(zip(many, truth.settle(many, DIGITS), strict=True))
    again = dict(zip(few, truth.settle(few, MORE_DIGITS), strict=True))
    return {
        "cells": len(many),
        "digits": DIGITS,
        "again": len(few),
        "more_digits": MORE_DIGITS,
        # As texts, because a cell without impacts has NaN for the phase of its last one.
        "unchanged": sum(str(again[cell]) == str(fates[cell]) for cell in few),
    }


def contact_agreement(right: Outcome, outcome: Outcome, linear: Any) -> dict[str, Any]:
    """Return what a solver of another equation of motion got right in that one."""
    fell = right.status == OVERTURNED
    return {
        "same_class": share((outcome.status == OVERTURNED) == fell),
        "same_impacts": share(outcome.impacts == right.impacts),
        "linear_class": share(np.equal(fell, linear)),
    }


if __name__ == "__main__":
    main(ROOT / "out" / "peers.json", ROOT / "docs" / "benchmarks.md")
