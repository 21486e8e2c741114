"""Overturning windows as a sweep: one number per output and cell."""

import functools
import math
from collections.abc import Iterable, Sequence
from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats
from rocksteady.dynamics.history.lowering import only_side, segment_table
from rocksteady.dynamics.history.nonlinear_tables import nonlinear_segment_table, sides_of
from rocksteady.dynamics.overturning.scan import MANY, MOST, Fates, scan
from rocksteady.dynamics.overturning.window_cells import (
    CLOSEST,
    MOST_WINDOWS,
    follow,
    keep,
    nothing_found,
    uplifts_of,
)
from rocksteady.kernels.core.tables import CEILING, LEFT_OUT
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.equations import Linear, Model, Nonlinear
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
    table, _ = _tables(block, model, pulse)
    uplifts: Sequence[float] = uplifts_of(sides)
    lines, quick = table, sides
    if isinstance(model, Nonlinear) and len(table) > MOST_LINES and floor is None:
        tolerance = max(ROUGH, pulse.tolerance)
        lines, _ = _tables(block, model, replace(pulse, tolerance=tolerance))
        quick = sides.copy()
        quick[:, LEFT_OUT] = np.maximum(sides[:, LEFT_OUT], ROUGH_LEFT_OUT)
    windows_found = nothing_found(len(frequency_ratio))
    for cell, ratio in enumerate(frequency_ratio.tolist()):
        speed = ratio
        if floor is not None:
            moved = replace(pulse, frequency_ratio=ratio)
            (table, uplifts), speed = _on_floor(floor, block, model, sides, moved), 1.0
            lines = table
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
            closest=CLOSEST if isinstance(model, Nonlinear) else 0.0,
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
    floor: Floor, block: Block | DimensionlessBlock, model: Model, sides: Floats, pulse: Pulse
) -> tuple[Floats, list[float]]:
    """Return the segments of a floor, and the amplitudes of its pulse at which a side lifts."""
    assert isinstance(block, Block)
    moved: Any = floor.motion(pulse, block)
    table, _ = _tables(block, model, moved)
    lines, sign = segments_of(moved)[:-1], only_side(sides)  # 0 where both sides are free
    ends = [a for p in lines for a in (p.constant, p.constant + p.slope * p.duration)]
    peak = max(sign * end if sign else abs(end) for end in ends)
    return table, [uplift / peak for uplift in uplifts_of(sides)]


def least_lift(
    floor: Floor,
    block: Block | DimensionlessBlock,
    model: Model,
    pulse: Pulse,
    ratios: Iterable[float],
) -> float:
    """Return the least amplitude of the ground's pulse, either way, at which a side lifts."""
    sides = sides_of(block, model)
    pulses = [replace(pulse, frequency_ratio=ratio) for ratio in ratios]
    ways = [(each, lanes) for each in pulses for lanes in (sides, sides[::-1].copy())]
    return min(min(_on_floor(floor, block, model, lanes, each)[1]) for each, lanes in ways)


def load_kernel(block: Block | DimensionlessBlock, model: Model, pulse: Pulse) -> None:
    """Load the kernel, or compile it, so that what is timed afterwards is computation alone."""
    table, sides = _tables(block, model, pulse)
    follow(np.empty(0), ratio=1.0, table=table, sides=sides)


@lru_cache(maxsize=8)
def _tables(
    block: Block | DimensionlessBlock, model: Model, pulse: Pulse | Piecewise
) -> tuple[Floats, Floats]:
    """Return the segments of a pulse, without the still base after it, and the block's sides."""
    sides = sides_of(block, model)
    if isinstance(model, Linear):
        return np.ascontiguousarray(segment_table(pulse)[:-1]), sides
    table = np.ascontiguousarray(nonlinear_segment_table(pulse, block)[:-1])
    # A ceiling ends a march that is lost before it lies; the margin needs its speed then.
    table[:, CEILING] = math.inf
    return table, sides
