"""Measure the kernels on a GPU, in ten minutes at most: ``python -m bench.gpu``.

Writes out/gpu.json and, from it, its part of docs/benchmarks.md; `make bench-gpu` calls it. Each
measurement is announced when it begins and ends when its share of the time is up; after Ctrl-C or a
failure what has been measured is written. Without a GPU it says what is missing and exits with 2.

With --emulated all of it runs at small sizes on this processor, by the emulation of a device: a
test of the script, whose figures mean nothing and are written to out/gpu-emulated.json only.

What limits a kernel, the GPU's own counters say, which need Nsight Compute and the right to read
them:

    ncu --set full --kernel-name regex:rs_queued --launch-skip 2 --launch-count 1 \\
        python -m bench.gpu --only speed --seconds 60
"""

import argparse
import json
import shutil
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from bench.gpu import report, stages
from bench.gpu.atlas import atlas
from bench.gpu.devices import Bench, OnGpu, OnProcessor
from bench.gpu.stages import Budget, Say
from bench.gpu.whole import whole_map
from bench.report import ROOT
from rocksteady.errors import RocksteadyError
from rocksteady.kernels.devices import FORMS

SECONDS = 600.0
ATLAS_CELLS = 4e7
FEW, MANY = 512, 2**22
"""Cells of `lane_fates` of which shapes and orders are measured: emulated, and on a GPU."""
SHARES = {
    "loading": 0.2,
    "speed": 0.3,
    "shapes": 0.25,
    "orders": 0.25,
    "sameness": 0.5,
    "map": 0.5,
    "atlas": 1.0,
}
"""Of the time that is left when a measurement begins, what it may take, in their order."""


def main(arguments: list[str] | None = None) -> int:
    """Measure; return the exit status."""
    parser = argparse.ArgumentParser(
        prog="python -m bench.gpu",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--emulated", action="store_true", help="test the script without a GPU")
    parser.add_argument("--seconds", type=float, default=SECONDS, help="time for all of it")
    parser.add_argument("--only", nargs="+", choices=list(SHARES), default=list(SHARES))
    parser.add_argument(
        "--kernels", nargs="+", choices=list(FORMS), default=list(FORMS), help="to load and measure"
    )
    parser.add_argument(
        "--cells-compared", type=float, default=1e7, help="of lane_fates; of others in proportion"
    )
    parser.add_argument(
        "--atlas-cells",
        type=float,
        help=f"such as 1e9; by default as many as there is time for, {ATLAS_CELLS:.0e} at most",
    )
    parser.add_argument("--out", type=Path, default=ROOT / "out", help="folder for the figures")
    given = parser.parse_args(arguments)
    try:
        device: Bench = OnProcessor() if given.emulated else OnGpu()
    except RocksteadyError as error:
        print(f"python -m bench.gpu: {error}", file=sys.stderr)
        return 2
    given.out.mkdir(parents=True, exist_ok=True)
    file = given.out / ("gpu-emulated.json" if given.emulated else "gpu.json")
    data: dict[str, Any] = {"device": device.facts(), "emulated": device.emulated}
    try:
        interrupted = measure(device, given, data)
    finally:
        file.write_text(json.dumps(data, indent=1, default=str) + "\n", encoding="utf-8")
        print(f"written to {file}")
    if not given.emulated and not interrupted:
        report.main(file, ROOT / "docs" / "benchmarks.md")
    return 130 if interrupted else 0


def measure(device: Bench, given: Any, data: dict[str, Any]) -> bool:
    """Put what is measured into `data`; return whether it was interrupted."""
    budget, said = Budget(given.seconds), _say(time.monotonic())
    said(f"{data['device']}")
    try:
        for name in given.only:
            mine = budget.part(SHARES[name])
            if mine.left <= 0.0:
                said(f"{name}: no time is left")
                continue
            said(f"{name}: {mine.left:.0f} s at most")
            data[name] = MEASUREMENTS[name](device, mine, said, given)
        data["device after"] = device.facts()
    except KeyboardInterrupt:
        said("interrupted: what has been measured is written")
        return True
    return False


def _say(began: float) -> Say:
    """Return what prints a line with the time since the beginning."""
    return lambda text: print(f"{time.monotonic() - began:6.1f} s  {text}", flush=True)


def _speed(device: Bench, budget: Budget, say: Say, given: Any) -> Any:
    batches = (64, 512) if device.emulated else stages.BATCHES
    return stages.speed(device, budget, say, batches, given.kernels)


def _shapes(device: Bench, budget: Budget, say: Say, _: Any) -> Any:
    return stages.shapes(device, budget, say, FEW if device.emulated else MANY)


def _orders(device: Bench, budget: Budget, say: Say, _: Any) -> Any:
    return stages.orders(device, budget, say, FEW if device.emulated else MANY)


def _sameness(device: Bench, budget: Budget, say: Say, given: Any) -> Any:
    cells = min(given.cells_compared, 2000) if device.emulated else given.cells_compared
    return stages.sameness(device, budget, say, int(cells), given.kernels)


def _map(device: Bench, budget: Budget, say: Say, given: Any) -> Any:
    return whole_map(device, budget, say, given.out)


def _atlas(device: Bench, budget: Budget, say: Say, given: Any) -> Any:
    store, picture = given.out / "gpu-atlas.zarr", given.out / "gpu-atlas.png"
    if given.atlas_cells is None:
        shutil.rmtree(store, ignore_errors=True)
    if isinstance(device, OnProcessor):
        return atlas(640, store, "serial", picture, device.device)
    if given.atlas_cells is not None:
        return atlas(int(given.atlas_cells), store, "gpu", picture)
    # A small one first: it tells how many cells there is time for.
    first = atlas(MANY // 4, store, "gpu", picture)
    say(f"  {first['cells']} cells in {first['seconds']:.1f} s")
    rate = first["cells"] / (first["seconds"] + first["counting_s"])
    cells = min(0.5 * rate * budget.left, ATLAS_CELLS)
    if cells < first["cells"]:
        return first
    shutil.rmtree(store)
    return atlas(int(cells), store, "gpu", picture)


def _loading(device: Bench, budget: Budget, say: Say, given: Any) -> Any:
    return stages.loading(device, budget, say, given.kernels)


MEASUREMENTS: dict[str, Callable[[Bench, Budget, Say, Any], Any]] = {
    "loading": _loading,
    "speed": _speed,
    "shapes": _shapes,
    "orders": _orders,
    "sameness": _sameness,
    "map": _map,
    "atlas": _atlas,
}


if __name__ == "__main__":
    sys.exit(main())
