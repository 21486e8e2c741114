"""Write files of recorded calls.

``python -m tools.aot.calls`` renews the calls that the package ships, some 200 of all kernels.
``python -m tools.aot.calls --large FOLDER`` writes calls of up to 1e5 cells, one file a call, for
the tests of other targets.
"""

import argparse
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from rocksteady.installation._recorded import Call, save
from rocksteady.installation.check import RECORDED
from rocksteady.kernels.entries import ENTRIES
from tools.aot.calls import batches, functions, histories, orbits, series
from tools.aot.calls.recorder import Recorder

CELLS = 100_000
"""Cells of a large call in the linear model."""
FEW_CELLS = 5_000
"""And in the nonlinear one, which takes some 30 times as long."""


def small_calls(entries: dict[str, Callable[..., Any]]) -> list[Call]:
    """Return some calls of every kernel."""
    call = Recorder(entries)
    for k, (nonlinear, leaping) in enumerate(
        ((False, True), (False, False), (True, True), (True, True))
    ):
        name = f"fates, {k}"
        batches.record_fates(call, name, 24, nonlinear=nonlinear, leaping=leaping)
        batches.record_attractors(call, f"attractors, {k}", 8, nonlinear=nonlinear)
        batches.record_pulses(call, f"pulses, {k}", 24, nonlinear=nonlinear)
    batches.record_attractors(call, "chatter", 8, nonlinear=False, chatter=True)
    batches.record_attractors(call, "chatter", 4, nonlinear=True, chatter=True)
    for k, nonlinear in enumerate((False, True, False, True)):
        batches.record_records(
            call, f"record, {k}", 8, nonlinear=nonlinear, samples=60, scattered=k > 1
        )
        batches.record_steady_states(call, f"steady, {k}", 20, shapes=k != 3)
    batches.record_records(call, "brief", 40, nonlinear=True, samples=60, brief=True)
    histories.record_histories(call)
    histories.record_small_parts(call)
    histories.record_motions(call)
    orbits.record_steady_orbits(call)
    orbits.record_passages(call)
    orbits.record_orbits(call)
    orbits.record_chains(call)
    series.record_series(call)
    functions.record_functions(call, 60)
    functions.record_oscillators(call, 60)
    return call.calls


def large_calls(entries: dict[str, Callable[..., Any]], part: float = 1.0) -> list[Call]:
    """Return calls of many cells; `part` makes them smaller."""
    call = Recorder(entries)
    for nonlinear, cells in ((False, int(CELLS * part)), (True, int(FEW_CELLS * part))):
        name = f"{cells} cells, {nonlinear}"
        batches.record_fates(call, name, cells, nonlinear=nonlinear, leaping=True)
        batches.record_attractors(call, name, cells, nonlinear=nonlinear)
        batches.record_pulses(call, name, cells, nonlinear=nonlinear)
        batches.record_records(call, name, cells, nonlinear=nonlinear, samples=200)
    batches.record_steady_states(call, "many steady states", int(CELLS * part), shapes=True)
    functions.record_functions(call, int(CELLS * part))
    functions.record_oscillators(call, int(CELLS * part))
    return call.calls


def main() -> None:
    """Write what the command line asks for."""
    parser = argparse.ArgumentParser(prog="python -m tools.aot.calls", description=__doc__)
    parser.add_argument("--large", type=Path, metavar="FOLDER", help="write large calls there")
    parser.add_argument("--part", type=float, default=1.0, help="share of the cells; default 1")
    arguments = parser.parse_args()
    if arguments.large is None:
        with np.errstate(all="ignore"):  # uncompiled kernels warn of overflow, which is meant
            calls = small_calls(ENTRIES)
        save(RECORDED, calls, compress=True)
        print(f"{RECORDED}: {len(calls)} calls, {RECORDED.stat().st_size / 1000:.0f} kB")
        return
    arguments.large.mkdir(parents=True, exist_ok=True)
    for number, call in enumerate(large_calls(ENTRIES, arguments.part)):
        file = arguments.large / f"{number:02d}-{call.entry}.calls"
        save(file, [call], compress=False)
        print(f"{file}: {file.stat().st_size / 1e6:.1f} MB")


if __name__ == "__main__":
    main()
