"""The windows at some frequencies: the cases of a sweep, whose cells have one number an output."""

import functools
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.dynamics.lowering import segment_table, side_table
from rocksteady.dynamics.overturning.scan import Fates, Found, scan
from rocksteady.errors import Status
from rocksteady.kernels.pulsed import pulse_fates
from rocksteady.model.block import DimensionlessBlock
from rocksteady.model.pulses import Pulse
from rocksteady.sweep.outputs import Output

Floats = NDArray[np.float64]

MOST_WINDOWS = 32
"""That are kept of one frequency; of more the widest."""
MANY = 10
"""Impacts from which on they are not told apart."""
REST_VELOCITY = 1e-3
"""Chatter slower than this, in alpha p, may come to rest: its bounces stay below 1e-6 alpha."""
FLIGHT_LIMIT = 30_000
"""Only without loss, and barely lifted, a block has more of them in a pulse."""
BATCH = 16
"""Frequencies of one call, for which an interruption waits."""
OUTPUTS = (
    Output(name="windows", dtype=np.int32, long_name="windows that are kept"),
    Output(name="first", long_name="smallest a_max/(alpha g) that overturns"),
    Output(name="left_out", dtype=np.int32, long_name="windows that are not kept"),
    Output(name="left_out_width", long_name="their width together"),
    Output(name="undecided", dtype=np.int32, long_name="amplitudes without a decision"),
    *(Output(name=f"low_{k}", long_name=f"lower end of window {k}") for k in range(MOST_WINDOWS)),
    *(Output(name=f"high_{k}", long_name=f"upper end of window {k}") for k in range(MOST_WINDOWS)),
    *(
        Output(name=f"way_{k}", dtype=np.int8, long_name=f"side (1 + impacts) of window {k}")
        for k in range(MOST_WINDOWS)
    ),
)
"""Of a frequency: a sweep has one number a cell in each of its outputs."""


def windows_at(
    frequency_ratio: Floats,
    *,
    block: DimensionlessBlock,
    pulse: Pulse,
    low: float,
    high: float,
    resolution: float,
) -> dict[str, NDArray[Any]]:
    """Return the windows at some frequencies."""
    table, sides = _table(pulse), side_table(block)
    found = {
        output.name: np.full(
            len(frequency_ratio), np.nan if output.dtype.kind == "f" else 0, output.dtype
        )
        for output in OUTPUTS
    }
    for cell, ratio in enumerate(frequency_ratio.tolist()):
        follow = functools.partial(_follow, ratio=ratio, table=table, sides=sides)
        _keep(found, cell, scan(follow, low, high, resolution))
    return found


def load_kernel(block: DimensionlessBlock, pulse: Pulse) -> None:
    """Load the kernel, or compile it, so that what is timed afterwards is computation alone."""
    _follow(np.empty(0), ratio=1.0, table=_table(pulse), sides=side_table(block))


def _keep(found: dict[str, NDArray[Any]], cell: int, windows: Found) -> None:
    """Write the windows at one frequency into their outputs, the widest where there are many."""
    width = windows.high - windows.low
    kept = np.sort(np.argsort(-width, kind="stable")[:MOST_WINDOWS])
    found["windows"][cell] = len(kept)
    found["left_out"][cell] = len(width) - len(kept)
    found["left_out_width"][cell] = float(np.delete(width, kept).sum())
    found["undecided"][cell] = windows.undecided
    if len(width):
        found["first"][cell] = windows.low[0]
    for place, k in enumerate(kept.tolist()):
        found[f"low_{place}"][cell] = windows.low[k]
        found[f"high_{place}"][cell] = windows.high[k]
        found[f"way_{place}"][cell] = windows.side[k] * (1 + windows.impacts[k])


def _follow(amplitude: Floats, *, ratio: float, table: Floats, sides: Floats) -> Fates:
    """Return what becomes of the block at some amplitudes."""
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
        np.minimum(impacts, MANY),
        side,
        np.minimum(during, 3 * MANY + 3),
        np.minimum(margin, 1e200),  # so that differences and slopes stay finite
    )


@lru_cache(maxsize=8)
def _table(pulse: Pulse) -> Floats:
    """Return the segments of a pulse, without the still base after it."""
    return np.ascontiguousarray(segment_table(pulse)[:-1])
