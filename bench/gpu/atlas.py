"""An atlas of coexisting motions: what a block at rest settles to, by the phase of the shaking.

``python -m bench.gpu.atlas CELLS STORE`` computes it alone: over the plane of frequency and
amplitude, from as many phases at the start as CELLS leave, kept in STORE, which an interrupted run
takes up again.  All is read in slabs of some rows, so that a thousand million cells need no more
memory than a million.
"""

import argparse
import time
from contextlib import nullcontext
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import rocksteady as rs

AMPLITUDES, FREQUENCIES = (0.5, 6.0), (0.5, 10.0)
PHASES = 64
SLAB = 2**22
"""Cells that are read together."""
CHUNK = 2**20
"""Cells that are written together, where there are many: 1000 chunks of 1e9 cells."""
STEP = 1e-6
"""Two motions whose largest angles differ by less, in units of the larger, are one."""


def axes(cells: int) -> dict[str, NDArray[np.float64]]:
    """Return amplitudes, frequency ratios and phases, as many as make about so many cells."""
    phases = min(PHASES, max(2, round((cells / 10) ** (1 / 3))))
    rows = max(2, round((cells / phases) ** 0.5))
    columns = max(2, round(cells / phases / rows))
    return {
        "amplitude": np.linspace(*AMPLITUDES, rows),
        "frequency_ratio": np.linspace(*FREQUENCIES, columns),
        "phase": np.linspace(0.0, 2.0 * np.pi, phases, endpoint=False),
    }


def computed(cells: int, store: Path, executor: str, progress: Any = None) -> Any:
    """Compute the cells, or those that a store does not hold yet, and return the map."""
    run = rs.Execution(
        executor=executor,
        store=rs.Store(store, resume=True, chunk=CHUNK if cells > 64 * CHUNK else None),
        progress=progress,
    )
    return rs.map_attractors(rs.DimensionlessBlock(restitution=0.8), axes=axes(cells), run=run)


def counted(cells: Any) -> dict[str, Any]:
    """Return the cells of each kind, and of how many different motions each point is.

    Two cells of a point have the same motion if their kind, period and impacts per period are the
    same and their largest angles agree to `STEP`; a motion and its mirror image are one.
    """
    rows, columns, phases = cells.kind.shape
    names = [str(kind) for kind in cells.kind.attrs["flag_meanings"].split()]
    codes = np.asarray(cells.kind.attrs["flag_values"])
    kinds = np.zeros(len(codes), dtype=np.int64)
    number = np.zeros((rows, columns), dtype=np.int16)
    some = max(1, SLAB // (columns * phases))
    for begin in range(0, rows, some):
        part = cells.isel(amplitude=slice(begin, begin + some))
        kind = part.kind.to_numpy()
        kinds += [np.count_nonzero(kind == code) for code in codes]
        number[begin : begin + some] = motions(
            kind,
            part.period.to_numpy(),
            part.impacts.to_numpy(),
            part.highest.to_numpy(),
            part.lowest.to_numpy(),
        )
    several = np.bincount(number.ravel())
    return {
        "points": rows * columns,
        "phases": phases,
        "cells": rows * columns * phases,
        "kinds": dict(zip(names, kinds.tolist(), strict=True)),
        "points_by_motions": {str(k): int(n) for k, n in enumerate(several) if n},
        "number": number,
    }


def motions(
    kind: NDArray[Any],
    period: NDArray[Any],
    impacts: NDArray[Any],
    highest: NDArray[np.float64],
    lowest: NDArray[np.float64],
) -> NDArray[np.int16]:
    """Return how many different motions there are along the last axis."""
    largest = np.nan_to_num(np.fmax(np.abs(highest), np.abs(lowest)))
    order = np.lexsort((largest, impacts, period, kind), axis=-1)
    sorted_ = [
        np.take_along_axis(each, order, axis=-1) for each in (kind, period, impacts, largest)
    ]
    new = np.zeros((*kind.shape[:-1], kind.shape[-1] - 1), dtype=np.bool_)
    for each in sorted_[:3]:
        new |= each[..., 1:] != each[..., :-1]
    angle = sorted_[3]
    new |= angle[..., 1:] - angle[..., :-1] > STEP * angle[..., 1:]
    result: NDArray[np.int16] = (1 + new.sum(axis=-1)).astype(np.int16)
    return result


def draw(number: NDArray[np.int16], file: Path) -> None:
    """Draw how many motions coexist at each point; neighbouring points share a pixel."""
    from matplotlib.figure import Figure

    thinned = [slice(None, None, max(1, length // 1000)) for length in number.shape]
    figure = Figure(figsize=(7.0, 5.0), layout="constrained")
    ax = figure.subplots()
    shown = ax.imshow(
        np.minimum(number[tuple(thinned)], 6),
        origin="lower",
        extent=(*FREQUENCIES, *AMPLITUDES),
        aspect="auto",
        cmap="viridis",
        vmin=1,
        vmax=6,
        interpolation="nearest",
    )
    ax.set_xlabel("frequency ratio Ω")
    ax.set_ylabel("amplitude A")
    bar = figure.colorbar(shown, ax=ax, ticks=range(1, 7))
    bar.ax.set_yticklabels([*map(str, range(1, 6)), "6 or more"])
    bar.set_label("motions to which a block at rest settles, by the phase")
    figure.savefig(file, dpi=150)


def atlas(
    cells: int, store: Path, executor: str, picture: Path, device: Any = None
) -> dict[str, Any]:
    """Compute the cells, count them and draw the picture; return the counts and the seconds.

    With a device the serial executor calls that, which is how it is tested without a GPU.
    """
    from rocksteady.kernels.machine_code.device import on_device

    began = time.perf_counter()
    with nullcontext() if device is None else on_device(device):
        done = computed(cells, store, executor)
    seconds = time.perf_counter() - began
    counts = counted(done)
    draw(counts.pop("number"), picture)
    return counts | {"seconds": seconds, "counting_s": time.perf_counter() - began - seconds}


def main() -> None:
    """Compute an atlas alone."""
    parser = argparse.ArgumentParser(prog="python -m bench.gpu.atlas", description=__doc__)
    parser.add_argument("cells", type=float, help="about how many cells, such as 1e9")
    parser.add_argument("store", type=Path, help="folder that keeps them, such as out/atlas.zarr")
    parser.add_argument("--executor", default="threads", help="as for rocksteady map")
    given = parser.parse_args()
    given.store.parent.mkdir(parents=True, exist_ok=True)
    found = atlas(int(given.cells), given.store, given.executor, given.store.with_suffix(".png"))
    for name, value in found.items():
        print(f"{name}: {value}")


if __name__ == "__main__":
    main()
