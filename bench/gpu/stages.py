"""The measurements, each of which returns what it measured and ends when its time is up."""

import os
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from bench.gpu.devices import Bench
from bench.gpu.work import SECONDS, classes, impacts_of, on_host, work
from rocksteady.gpu._cuda import DriverError
from rocksteady.kernels.devices import FORMS, Form

Say = Callable[[str], None]

BATCHES = tuple(4**power for power in range(6, 13))  # 4096 to 17 million cells
SHAPED = ("lane_fates", "nonlinear_lane_fates")
BLOCKS = (32, 64, 128, 256)
CAPS = (0, 168, 128, 96)
"""Most registers of a thread; 0 for what the kernel needs."""
LONGEST = 4.0
"""Seconds of a call beyond which no larger batch is tried."""
LISTED = 5
"""Cells with other bits that are written out."""


@dataclass
class Budget:
    """Time that is left.

    Parameters
    ----------
    seconds
        Of all measurements.
    """

    seconds: float
    began: float = field(default_factory=time.monotonic)

    @property
    def left(self) -> float:
        """Seconds that are left."""
        return self.seconds - (time.monotonic() - self.began)

    def part(self, share: float) -> "Budget":
        """Return a part of what is left."""
        return Budget(max(0.0, share * self.left))


def loading(device: Bench, budget: Budget, say: Say, names: Sequence[str]) -> list[dict[str, Any]]:
    """Compile each kernel for the GPU: seconds, registers and stack of a thread."""
    rows: list[dict[str, Any]] = []
    for name in names:
        if budget.left <= 0.0:
            break
        loaded = device.load(FORMS[name].queued)
        rows.append(
            {
                "kernel": name,
                "seconds": loaded.seconds,
                "registers": loaded.registers,
                "stack": loaded.stack,
                "resident": loaded.resident,
            }
        )
        say(f"  {name}: {loaded.seconds:.1f} s, {loaded.registers} registers")
    return rows


def speed(
    device: Bench, budget: Budget, say: Say, batches: tuple[int, ...], names: Sequence[str]
) -> list[dict[str, Any]]:
    """Run each kernel in growing batches, until a call is long or the time is up."""
    rows: list[dict[str, Any]] = []
    for place, name in enumerate(names):
        mine = budget.part(1.0 / (len(names) - place))
        for count in batches:
            row = called(device, name, FORMS[name], count)
            rows.append(row)
            say(f"  {name}, {count} cells: {words(row)}")
            # The next batch has four times as many cells.
            if 8.0 * row["whole_s"] > mine.left or row["whole_s"] > LONGEST:
                break
    return rows


def called(device: Bench, name: str, form: Form, count: int, **options: int) -> dict[str, Any]:
    """Return what one call took; the second of two, because the first one takes memory."""
    arguments = work(name, count)
    device.launch(form, arguments, **options)
    timing = device.launch(form, arguments, **options)
    impacts = impacts_of(name, arguments)
    return {
        "kernel": name,
        "cells": count,
        "kernel_s": timing.kernel,
        "whole_s": timing.whole,
        "cells_per_s": count / timing.kernel,
        "impacts": impacts,
        "impacts_per_s": None if impacts is None else impacts / timing.kernel,
        "left_over": int(np.count_nonzero(classes(arguments) == -1)),
        **options,
    }


def words(row: dict[str, Any]) -> str:
    """Return the speed of a call in words."""
    impacts = row["impacts_per_s"]
    rest = "" if impacts is None else f", {impacts:.2e} impacts/s"
    return f"{row['kernel_s']:.4f} s in the kernel, {row['cells_per_s']:.2e} cells/s{rest}"


def shapes(device: Bench, budget: Budget, say: Say, cells: int) -> list[dict[str, Any]]:
    """Run the kernels of fates with other threads per block, and with fewer registers."""
    rows: list[dict[str, Any]] = []
    for name in SHAPED:
        count = scaled(name, cells)
        for block, cap in [(block, 0) for block in BLOCKS] + [(64, cap) for cap in CAPS[1:]]:
            if budget.left <= 0.0:
                return rows
            try:
                row = called(device, name, FORMS[name], count, block=block, registers=cap)
            except DriverError as error:  # too many threads for the registers, say
                say(f"  {name}, {block} threads a block, {cap or 'all'} registers: {error}")
                continue
            rows.append(row)
            say(f"  {name}, {block} threads a block, {cap or 'all'} registers: {words(row)}")
    return rows


def orders(device: Bench, budget: Budget, say: Say, cells: int) -> list[dict[str, Any]]:
    """Run the kernels of fates with their cells in other orders; each its own divergence."""
    rows: list[dict[str, Any]] = []
    for name in SHAPED:
        count = scaled(name, cells)
        drawn = np.random.default_rng(1).random(count)
        form = FORMS[name]
        arguments = work(name, count)
        device.launch(form, arguments)
        impacts = arguments[-1].impacts.astype(np.float64)
        chosen: dict[str, Callable[..., Any] | None] = {
            "expected length": form.length,
            "natural": None,
            "random": lambda *_, drawn=drawn: drawn,
            "number of impacts": lambda *_, impacts=impacts: impacts,
        }
        for order, length in chosen.items():
            if budget.left <= 0.0:
                return rows
            row = called(device, name, replace(form, length=length), count)
            rows.append(row | {"order": order})
            say(f"  {name}, {order}: {words(row)}")
    return rows


def scaled(name: str, cells: int) -> int:
    """Return so many cells of `lane_fates`, or as many of another kernel as take as long."""
    return max(64, int(cells * SECONDS["lane_fates"] / SECONDS[name]))


def sameness(
    device: Bench, budget: Budget, say: Say, cells: int, names: Sequence[str]
) -> list[dict[str, Any]]:
    """Compare each kernel with the processor, cell by cell: classes, and all bits of all results.

    Cells come in batches until there are as many as asked for, or the time is up.
    """
    rows: list[dict[str, Any]] = []
    workers = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    for place, name in enumerate(names):
        mine = budget.part(1.0 / (len(names) - place))
        row: dict[str, Any] = {"kernel": name, "cells": 0, "classes": 0, "bits": 0, "first": []}
        row["left_over"] = 0
        wanted, seed = scaled(name, cells), 1
        while row["cells"] < wanted and mine.left > 0.0:
            count = min(wanted - row["cells"], scaled(name, 2**20))
            compare(device, name, count, seed, workers or 1, row)
            seed += 1
        rows.append(row)
        say(
            f"  {name}: of {row['cells']} cells {row['classes']} have another class and "
            f"{row['bits']} other bits; {row['left_over']} are left to the processor"
        )
    return rows


def compare(
    device: Bench, name: str, count: int, seed: int, workers: int, row: dict[str, Any]
) -> None:
    """Compare one batch, and add to a row."""
    form = FORMS[name]
    arguments = work(name, count, seed)
    device.launch(form, arguments)
    wanted = on_host(name, arguments, workers)
    here, there = classes(arguments), classes(wanted)
    # What either leaves over the scalar code computes; the rest of its row means nothing.
    left = here == -1
    done = ~left & (there != -1)
    other = np.zeros(count, dtype=np.bool_)
    for got, right in zip(arguments[-1], wanted[-1], strict=True):
        differs = got.view(np.int64) != right.view(np.int64)
        other |= differs.reshape(count, -1).any(axis=1)
    other &= done
    row["cells"] += count
    row["left_over"] += int(left.sum())
    row["classes"] += int((done & (here != there)).sum())
    row["bits"] += int(other.sum())
    row["first"] += list(listed(name, arguments, wanted, other))
    del row["first"][LISTED:]


def listed(name: str, arguments: Any, wanted: Any, other: Any) -> Iterator[dict[str, Any]]:
    """Yield the first cells with other bits: what they are given, and both results."""
    for cell in np.flatnonzero(other)[:LISTED].tolist():
        given = (
            {}
            if name.endswith("record_fates")
            else {
                "amplitude": arguments[0].amplitude[cell].hex(),
                "frequency_ratio": arguments[0].frequency_ratio[cell].hex(),
            }
        )
        yield given | {
            "cell": cell,
            "device": [np.asarray(each[cell]).tolist() for each in arguments[-1]],
            "processor": [np.asarray(each[cell]).tolist() for each in wanted[-1]],
        }
