"""Overturning windows as a sweep: one number per output and cell."""

import functools
import math
from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.dynamics.history.lowering import segment_table
from rocksteady.dynamics.history.nonlinear_tables import nonlinear_segment_table, sides_of
from rocksteady.dynamics.overturning._scan import Fates, Found, scan
from rocksteady.kernels.batch.pulses import pulse_fates
from rocksteady.kernels.core.tables import ALPHA, CEILING, LEAN, LEFT_OUT, is_nonlinear
from rocksteady.kernels.elementary.arrays import tan
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.equations import Linear, Model, Nonlinear
from rocksteady.model.motions.pulses import Pulse
from rocksteady.outcomes import Status
from rocksteady.sweep.cases.outputs import Output

Floats = NDArray[np.float64]

MOST_WINDOWS = 32
"""That are kept of one frequency; of more the widest."""
MOST_LINES = 1000
"""Segments of a pulse from which on a nonlinear search goes by fewer of them."""
ROUGH = 1e-4
"""Tolerance of the straight lines of a wavelet in such a search; its borders are found without.

The windows of lines that differ so little are the same but for those that are about as narrow.  The
linear model is fast enough without.
"""
ROUGH_LEFT_OUT = 1e-9
"""What a step may leave out of the motion in such a search."""
CLOSEST = 1e-12
"""Part of an amplitude to which a border is wanted in the nonlinear model, whose steps stay within
1e-10 of the motion: what is closer has no meaning."""
REST_VELOCITY = 1e-3
"""Chatter slower than this, in alpha p, may come to rest: its bounces stay below 1e-6 alpha."""
FLIGHT_LIMIT = 30_000
"""Only without loss, and barely lifted, a block has more of them in a pulse."""
BATCH = 4
"""Frequencies of one call, for which an interruption waits, and of a chunk of a store."""
OUTPUTS = (
    Output(name="windows", dtype=np.int32, long_name="windows that are kept"),
    Output(name="first", long_name="smallest a_max/(alpha g) that overturns"),
    Output(name="left_out", dtype=np.int32, long_name="windows that are not kept"),
    Output(name="left_out_width", long_name="their width together"),
    Output(name="undecided", dtype=np.int32, long_name="amplitudes without a decision"),
    Output(
        name="unsettled", dtype=np.int32, long_name="intervals in which a window might still hide"
    ),
    *(Output(name=f"low_{k}", long_name=f"lower end of window {k}") for k in range(MOST_WINDOWS)),
    *(Output(name=f"high_{k}", long_name=f"upper end of window {k}") for k in range(MOST_WINDOWS)),
    *(
        Output(name=f"way_{k}", dtype=np.int64, long_name=f"side (1 + impacts) of window {k}")
        for k in range(MOST_WINDOWS)
    ),
)
"""Of a frequency: a sweep has one number a cell in each of its outputs."""


def windows_at(
    frequency_ratio: Floats,
    *,
    block: Block | DimensionlessBlock,
    model: Model,
    pulse: Pulse,
    low: float,
    high: float,
    resolution: float,
) -> dict[str, NDArray[Any]]:
    """Return the windows at some frequencies."""
    table, sides = _tables(block, model, pulse)
    uplifts = uplifts_of(sides)
    lines, quick = table, sides
    if isinstance(model, Nonlinear) and len(table) > MOST_LINES:
        tolerance = max(ROUGH, pulse.tolerance)
        lines, _ = _tables(block, model, replace(pulse, tolerance=tolerance))
        quick = sides.copy()
        quick[:, LEFT_OUT] = np.maximum(sides[:, LEFT_OUT], ROUGH_LEFT_OUT)
    found = {
        output.name: np.full(
            len(frequency_ratio), np.nan if output.dtype.kind == "f" else 0, output.dtype
        )
        for output in OUTPUTS
    }
    for cell, ratio in enumerate(frequency_ratio.tolist()):
        follow, rough = (
            functools.partial(_follow, ratio=ratio, table=rows, sides=own)
            for rows, own in ((table, sides), (lines, quick))
        )
        windows = scan(
            follow,
            low,
            high,
            resolution,
            uplifts=uplifts,
            keep=MOST_WINDOWS,
            rough=None if lines is table else rough,
            closest=CLOSEST if isinstance(model, Nonlinear) else 0.0,
        )
        _keep(found, cell, windows)
    return found


def load_kernel(block: Block | DimensionlessBlock, model: Model, pulse: Pulse) -> None:
    """Load the kernel, or compile it, so that what is timed afterwards is computation alone."""
    table, sides = _tables(block, model, pulse)
    _follow(np.empty(0), ratio=1.0, table=table, sides=sides)


def uplifts_of(sides: Floats) -> tuple[float, float]:
    """Return the a/(alpha g) at which either side lifts: 1, or tan(alpha)/alpha, times its lean."""
    if not is_nonlinear(sides):
        return float(sides[0, LEAN]), float(sides[1, LEAN])
    first, second = (tan(side[ALPHA]) / side[ALPHA] * side[LEAN] for side in sides)
    return first, second


def _keep(found: dict[str, NDArray[Any]], cell: int, windows: Found) -> None:
    """Write the windows at one frequency into their outputs, the widest where there are many."""
    width = windows.high - windows.low
    kept = np.sort(np.argsort(-width, kind="stable")[:MOST_WINDOWS])
    found["windows"][cell] = len(kept)
    found["left_out"][cell] = len(width) - len(kept)
    found["left_out_width"][cell] = float(np.delete(width, kept).sum())
    found["undecided"][cell] = windows.undecided
    found["unsettled"][cell] = windows.unsettled
    if len(width):
        found["first"][cell] = windows.low[0]
    for place, k in enumerate(kept.tolist()):
        found[f"low_{place}"][cell] = windows.low[k]
        found[f"high_{place}"][cell] = windows.high[k]
        found[f"way_{place}"][cell] = windows.side[k] * (1 + windows.impacts[k])


def _follow(amplitude: Floats, *, ratio: float, table: Floats, sides: Floats) -> Fates:
    """Return the fates of the block at some amplitudes."""
    # A pulse of amplitude 0 is none, and the kernel divides by it.
    size = np.maximum(amplitude, 1e-3)
    status, impacts, side, during = (np.empty(len(size), dtype=np.int64) for _ in range(4))
    margin = np.empty(len(size))
    pulse_fates(
        table,
        sides,
        size,
        np.full(len(size), ratio),
        REST_VELOCITY,
        FLIGHT_LIMIT,
        status,
        impacts,
        side,
        during,
        margin,
    )
    return Fates(
        status == Status.OVERTURNED,
        status != Status.UNDECIDED,
        impacts,
        side,
        during,
        np.minimum(margin, 1e200),  # so that differences and slopes stay finite
    )


@lru_cache(maxsize=8)
def _tables(block: Block | DimensionlessBlock, model: Model, pulse: Pulse) -> tuple[Floats, Floats]:
    """Return the segments of a pulse, without the still base after it, and the block's sides."""
    sides = sides_of(block, model)
    if isinstance(model, Linear):
        return np.ascontiguousarray(segment_table(pulse)[:-1]), sides
    table = np.ascontiguousarray(nonlinear_segment_table(pulse, block)[:-1])
    # A ceiling ends a march that is lost before it lies; the margin asks at what speed it will.
    table[:, CEILING] = math.inf
    return table, sides
