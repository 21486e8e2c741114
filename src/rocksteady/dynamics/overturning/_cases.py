"""Overturning windows as a sweep: one number per output and cell."""

import functools
from collections.abc import Iterable
from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats
from rocksteady.dynamics.overturning.scan import MANY, MOST, Fates, scan
from rocksteady.dynamics.overturning.window_cells import (
    MOST_WINDOWS,
    closest_of,
    follow,
    keep,
    lifts_of,
    nothing_found,
    shaking_of,
    uplifts_of,
)
from rocksteady.kernels.core.tables import LEFT_OUT, is_nonlinear
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.equations import Model
from rocksteady.model.motions.floor import Floor
from rocksteady.model.motions.pulses import Pulse
from rocksteady.model.motions.segments import Piecewise, segments_of

MOST_LINES = 1000
"""Segments of a pulse from which on a nonlinear search goes by fewer of them."""
ROUGH = 1e-4
"""Tolerance of the straight lines of a wavelet in such a search; its borders are found without.

The windows of lines that differ so little are the same, except windows that are about as narrow.
The linear model is fast enough without.
"""
ROUGH_LEFT_OUT = 1e-9
"""What a step may leave out of the motion in such a search."""
BATCH = 4
"""Frequencies of one call, for which an interruption waits, and of a chunk of a store."""


def windows_at(
    frequency_ratio: Floats,
    *,
    block: Block | DimensionlessBlock,
    model: Model,
    sides: Floats,
    pulse: Pulse,
    low: float,
    high: float,
    resolution: float,
    floor: Floor | None = None,
) -> dict[str, NDArray[Any]]:
    """Return the windows at some frequencies."""
    table, uplifts = _table(block, model, pulse), list(uplifts_of(sides))
    lines, quick = table, sides
    if is_nonlinear(sides) and len(table) > MOST_LINES and floor is None:
        tolerance = max(ROUGH, pulse.tolerance)
        lines = _table(block, model, replace(pulse, tolerance=tolerance))
        quick = sides.copy()
        quick[:, LEFT_OUT] = np.maximum(sides[:, LEFT_OUT], ROUGH_LEFT_OUT)
    windows_found = nothing_found(len(frequency_ratio))
    for cell, ratio in enumerate(frequency_ratio.tolist()):
        speed = ratio
        if floor is not None:
            moved = replace(pulse, frequency_ratio=ratio)
            (table, ends), speed = _on_floor(floor, block, model, moved), 1.0
            lines, uplifts = table, lifts_of(ends, sides)
        exact, rough = (
            functools.partial(
                follow if floor is None else _uncounted, ratio=speed, table=rows, sides=lanes
            )
            for rows, lanes in ((table, sides), (lines, quick))
        )
        windows = scan(
            exact,
            low,
            high,
            resolution,
            uplifts=uplifts,
            keep=MOST_WINDOWS,
            rough=None if lines is table else rough,
            closest=closest_of(sides),
            most=MOST if floor is None else 3 * MOST,
            numbered=floor is None,
            crowded=floor is not None,
        )
        if floor is not None:
            windows = windows._replace(impacts=windows.impacts - MANY)
        keep(windows_found, cell, windows)
    return windows_found


def _uncounted(amplitude: Floats, **how: Any) -> Fates:
    """Return the fates under a motion whose impacts are many, and make no windows of their own."""
    fates = follow(amplitude, **how)
    return fates._replace(impacts=fates.impacts + MANY)


def _on_floor(
    floor: Floor, block: Block | DimensionlessBlock, model: Model, pulse: Pulse
) -> tuple[Floats, Floats]:
    """Return the segments of a floor, and the accelerations at their ends over alpha g."""
    assert isinstance(block, Block)
    moved: Any = floor.motion(pulse, block)
    lines = segments_of(moved)[:-1]
    ends = [a for p in lines for a in (p.constant, p.constant + p.slope * p.duration)]
    return _table(block, model, moved), np.array(ends)


def least_lift(
    floor: Floor,
    block: Block | DimensionlessBlock,
    model: Model,
    pulse: Pulse,
    ratios: Iterable[float],
) -> float:
    """Return the least amplitude of the ground's pulse, either way, at which a side lifts."""
    sides = model.sides(block)
    pulses = (replace(pulse, frequency_ratio=ratio) for ratio in ratios)
    floors = (_on_floor(floor, block, model, each)[1] for each in pulses)
    return min(min(lifts_of(np.append(ends, -ends), sides)) for ends in floors)


def load_kernel(block: Block | DimensionlessBlock, model: Model, pulse: Pulse) -> None:
    """Load the kernel, or compile it, so that what is timed afterwards is computation alone."""
    table = _table(block, model, pulse)
    follow(np.empty(0), ratio=1.0, table=table, sides=model.sides(block))


@lru_cache(maxsize=8)
def _table(block: Block | DimensionlessBlock, model: Model, pulse: Pulse | Piecewise) -> Floats:
    """Return the segments of a pulse, without the still base after it."""
    return shaking_of(model.lower(block, pulse))
