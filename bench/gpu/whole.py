"""A whole map of fates with a store, as a user runs it: on the device, and in threads."""

import shutil
import time
from contextlib import nullcontext
from pathlib import Path
from typing import Any

import numpy as np

import rocksteady as rs
from bench.gpu.devices import Bench, OnProcessor
from bench.gpu.stages import Budget, Say

SIDES = (400, 2000)
"""Cells along either axis; the larger map follows if there is time for it."""
SMALL = 20


def whole_map(device: Bench, budget: Budget, say: Say, folder: Path) -> list[dict[str, Any]]:
    """Run a map of fates in both models, each with the executor "gpu" and in threads."""
    rows: list[dict[str, Any]] = []
    blocks = {
        "linear": rs.DimensionlessBlock(restitution=0.8),
        "nonlinear": rs.Block.from_p(alpha=0.2, p=1.0, restitution=0.8),
    }
    for side in (SMALL,) if device.emulated else SIDES:
        for name, block in blocks.items():
            model = rs.Linear() if name == "linear" else rs.Nonlinear()
            fates = {}
            for executor in ("gpu", "threads"):
                if budget.left <= 0.0:
                    return rows
                seconds, cells = _run(device, executor, block, model, side, folder)
                fates[executor] = cells
                row = {"model": name, "executor": executor, "cells": side * side}
                rows.append(row | {"seconds": seconds})
                say(f"  {name}, {side * side} cells, {executor}: {seconds:.2f} s")
            rows[-1]["same"] = bool(np.array_equal(fates["gpu"], fates["threads"]))
    return rows


def _run(
    device: Bench, executor: str, block: Any, model: Any, side: int, folder: Path
) -> tuple[float, Any]:
    """Return the seconds of a map from first cell to last chunk, and its fates."""
    from rocksteady.kernels.machine_code.device import on_device

    store = folder / f"gpu-map-{executor}.zarr"
    shutil.rmtree(store, ignore_errors=True)
    place: Any = nullcontext()
    if isinstance(device, OnProcessor) and executor == "gpu":
        executor, place = "serial", on_device(device.device)
    began = time.perf_counter()
    with place:
        fates = rs.map_fates(
            block,
            axes={
                "amplitude": np.linspace(1.0, 6.0, side),
                "frequency_ratio": np.linspace(1.0, 12.0, side),
            },
            start=rs.State(angle=0.0, velocity=0.3),
            cycles=200,
            model=model,
            run=rs.Execution(executor=executor, store=store),
        )
    seconds = time.perf_counter() - began
    cells = fates.fate.to_numpy()
    shutil.rmtree(store)
    return seconds, cells
