"""Case functions in a module that worker processes import, and scripts that use them."""

import os
import signal
import time
import uuid
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.errors import InputError
from rocksteady.sweep.cases.axes import Axis
from rocksteady.sweep.cases.grid import Grid
from rocksteady.sweep.cases.outputs import Output

Floats = NDArray[np.float64]
Found = dict[str, NDArray[Any]]

GRID = Grid(
    axes=(
        Axis(name="a", values=np.linspace(0.1, 3.0, 30), units="rad", long_name="an angle"),
        Axis(name="b", values=np.arange(20.0)),
    )
)
OUTPUTS = (
    Output(name="sum", long_name="a sum", units="m"),
    Output(name="sign", dtype=np.int8, flags={-1: "negative", 0: "zero", 1: "positive"}),
)


def some(a: Floats, b: Floats, *, factor: float = 1.0) -> Found:
    total = factor * np.sin(a) * 7.0 - b
    return {"sum": total, "sign": np.sign(total).astype(np.int8)}


def slow(a: Floats, b: Floats, *, seconds: float = 0.002) -> Found:
    time.sleep(seconds * len(a))
    return some(a, b)


def held(a: Floats, b: Floats, *, gate: str) -> Found:
    """Compute the first half of the cells at once, the others as soon as there is a file."""
    while (a > GRID.axes[0].points[14]).any() and not Path(gate).exists():
        time.sleep(0.01)
    return some(a, b)


def failing(a: Floats, b: Floats, *, kind: str) -> Found:
    if (b == 13.0).any():
        if kind == "ours":
            raise InputError("b", 13.0, "it is another", "give another")
        raise ZeroDivisionError("as it happens")
    return some(a, b)


def deadly(a: Floats, b: Floats, *, folder: str, times: int) -> Found:
    """Kill the process at one cell, so many times."""
    there = ((a == GRID.axes[0].points[20]) & (b == 13.0)).any()
    if there and len(list(Path(folder).iterdir())) < times:
        (Path(folder) / uuid.uuid4().hex).touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return slow(a, b)


@dataclass(frozen=True)
class Noted:
    """Notes in a folder that it has been unpickled."""

    value: float
    folder: str

    def __reduce__(self) -> Any:
        return _noted, (self.value, self.folder)


def _noted(value: float, folder: str) -> Noted:
    (Path(folder) / f"{os.getpid()}-{uuid.uuid4().hex}").touch()
    return Noted(value, folder)


def of_items(thing: NDArray[Any], b: Floats) -> Found:
    time.sleep(0.001 * len(b))
    return {"sum": np.array([item.value for item in thing]) * b}
