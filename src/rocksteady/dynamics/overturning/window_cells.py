"""A search for windows as one cell of a sweep: its outputs, and the fates that it needs."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats
from rocksteady.dynamics.overturning.scan import Fates, Found
from rocksteady.kernels.batch.pulses import pulse_fates
from rocksteady.kernels.core.tables import (
    ALPHA,
    CEILING,
    COUNTED,
    LEAN,
    LIFT,
    NONLINEAR_SEGMENT_COLUMNS,
    is_nonlinear,
)
from rocksteady.kernels.core.tuples import PulseFates, Tables
from rocksteady.kernels.elementary.arrays import tan
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.equations import Model
from rocksteady.model.linear_tables import only_side
from rocksteady.outcomes import Status
from rocksteady.sweep.cases.outputs import Output

if TYPE_CHECKING:
    from rocksteady.sweep.cases.cells import Labelled


MOST_WINDOWS = 32
"""That are kept of one frequency; of more the widest."""
CLOSEST = 1e-12
"""Part of an amplitude to which a border is wanted in the nonlinear model, whose steps stay within
1e-10 of the motion: what is closer has no meaning."""
SMALLEST = 1e-3
"""Amplitude below which nothing is tried."""
FLIGHT_LIMIT = 30_000
"""Only without loss, and barely lifted, a block has more of them in a pulse."""


def outputs(most: int = MOST_WINDOWS, lying: int = MOST_WINDOWS) -> tuple[Output, ...]:
    """Return the outputs of a cell: one number per cell in each.

    Parameters
    ----------
    most
        Windows that are kept.
    lying
        Stretches that are kept, in which the other windows lie.
    """
    ends = (("low", "lower end"), ("high", "upper end"))
    return (
        Output(name="windows", dtype=np.int32, long_name="windows that are kept"),
        Output(name="first", long_name="smallest amplitude that overturns"),
        Output(name="opposite", long_name="that of the reversed motion"),
        Output(name="left_out", dtype=np.int32, long_name="windows that are not kept"),
        Output(name="left_out_width", long_name="their width together"),
        Output(name="undecided", dtype=np.int32, long_name="amplitudes without a decision"),
        Output(
            name="unsettled",
            dtype=np.int32,
            long_name="intervals in which a window might still hide",
        ),
        *(Output(name=f"low_{k}", long_name=f"lower end of window {k}") for k in range(most)),
        *(Output(name=f"high_{k}", long_name=f"upper end of window {k}") for k in range(most)),
        *(
            Output(name=f"way_{k}", dtype=np.int64, long_name=f"side (1 + impacts) of window {k}")
            for k in range(most)
        ),
        *(
            Output(name=f"left_{name}_{k}", long_name=f"{end} of stretch {k} of windows not kept")
            for name, end in ends
            for k in range(lying)
        ),
    )


def uplifts_of(sides: Floats) -> tuple[float, float]:
    """Return the a/(alpha g) at which either side lifts: 1, or tan(alpha)/alpha, times its lean.

    For a block against a wall, twice that of its one side.
    """
    if not is_nonlinear(sides):
        first, second = float(sides[0, LEAN]), float(sides[1, LEAN])
    else:
        first, second = (tan(side[ALPHA]) / side[ALPHA] * side[LEAN] for side in sides)
    side = only_side(sides)
    if side == 0:
        return first, second
    return (first, first) if side > 0 else (second, second)


def lifts_of(accelerations: Floats, sides: Floats) -> list[float]:
    """Return the factors of accelerations over alpha g at which either side lifts."""
    sign = only_side(sides)
    peak = float((sign * accelerations if sign else np.abs(accelerations)).max())
    return [uplift / peak if peak > 0.0 else np.inf for uplift in uplifts_of(sides)]


def closest_of(sides: Floats) -> float:
    """Return how close the ends of windows come, as a part of the amplitude: see `CLOSEST`."""
    return CLOSEST if is_nonlinear(sides) else 0.0


def shaking_of(tables: Tables) -> Floats:
    """Return the segments of a motion for a search, without the still base after it."""
    segments = np.ascontiguousarray(tables.segments[:-1])
    if is_nonlinear(tables.sides):
        # A ceiling ends a march that is lost before it lies; the margin needs its speed then.
        segments[:, CEILING] = np.inf
    return segments


def nothing_found(
    count: int, most: int = MOST_WINDOWS, lying: int = MOST_WINDOWS
) -> dict[str, NDArray[Any]]:
    """Return the outputs of some cells before a search, nan or 0."""
    return {
        output.name: np.full(count, np.nan if output.dtype.kind == "f" else 0, output.dtype)
        for output in outputs(most, lying)
    }


def keep(
    columns: dict[str, NDArray[Any]],
    cell: int,
    windows: Found,
    most: int = MOST_WINDOWS,
    lying: int = MOST_WINDOWS,
) -> None:
    """Write the windows of one cell into its outputs, the widest where there are many.

    Where the others lie, or may hide, is written as a number of stretches at most, with the widest
    gaps between.
    """
    width = windows.high - windows.low
    kept = np.sort(np.argsort(-width, kind="stable")[:most])
    columns["windows"][cell] = len(kept)
    columns["left_out"][cell] = len(width) - len(kept)
    columns["left_out_width"][cell] = float(np.delete(width, kept).sum())
    others = np.stack([np.delete(windows.low, kept), np.delete(windows.high, kept)], axis=1)
    low, high = np.array(sorted([*others.tolist(), *windows.hidden.tolist()])).reshape(-1, 2).T
    if len(low):
        high = np.maximum.accumulate(high)
        gaps = np.flatnonzero(high[:-1] < low[1:])
        order = np.argsort(high[gaps] / low[gaps + 1], kind="stable")
        gaps = np.sort(gaps[order[: lying - 1]])
        for place, (begin, end) in enumerate(zip([0, *(gaps + 1)], [*gaps, -1], strict=True)):
            columns[f"left_low_{place}"][cell] = low[begin]
            columns[f"left_high_{place}"][cell] = high[end]
    columns["undecided"][cell] = windows.undecided
    columns["unsettled"][cell] = len(windows.hidden)
    if len(width):
        columns["first"][cell] = windows.low[0]
    for place, k in enumerate(kept.tolist()):
        columns[f"low_{place}"][cell] = windows.low[k]
        columns[f"high_{place}"][cell] = windows.high[k]
        columns[f"way_{place}"][cell] = windows.side[k] * (1 + windows.impacts[k])


def search_both_ways(
    *,
    search: Callable[..., dict[str, NDArray[Any]]],
    block: Block | DimensionlessBlock,
    model: Model,
    **how: Any,
) -> dict[str, NDArray[Any]]:
    """Return the outputs of a search, with the first amplitude of the reversed motion.

    That is the first of the mirrored block; the doubts of both searches are added.  A block whose
    sides are alike is searched once.
    """
    sides = model.sides(block)
    ahead = search(block=block, model=model, sides=sides, **how)
    if (sides[0] == sides[1]).all():
        return ahead | {"opposite": ahead["first"]}
    mirrored = search(block=block, model=model, sides=sides[::-1].copy(), **how)
    doubts = {name: ahead[name] + mirrored[name] for name in ("undecided", "unsettled")}
    return ahead | doubts | {"opposite": mirrored["first"]}


def rows_of(data: "Labelled", name: str, most: int) -> NDArray[Any]:
    """Return the outputs of a name and a number as columns, one row per cell."""
    each: NDArray[Any] = np.stack([data[f"{name}_{k}"].values.ravel() for k in range(most)], axis=1)
    return each


def kept_windows(data: "Labelled", lying: int = MOST_WINDOWS) -> dict[str, Any]:
    """Return the fields of `WindowLists` from the outputs of a sweep, one row per cell."""
    kept = max(1, int(data["windows"].values.max()))
    way = rows_of(data, "way", kept).astype(np.int64)
    windows = {name: rows_of(data, name, kept) for name in ("low", "high")}
    windows |= {"impacts": np.abs(way) - 1, "side": np.sign(way)}
    left = {f"left_out_{name}": rows_of(data, f"left_{name}", lying) for name in ("low", "high")}
    used = max(1, int((~np.isnan(left["left_out_low"])).any(axis=0).sum()))
    windows |= {name: ends[:, :used] for name, ends in left.items()}
    for name in ("first", "opposite", "left_out_width"):
        windows[name] = data[name].values.ravel()
    for name in ("left_out", "undecided", "unsettled"):
        windows[name] = data[name].values.ravel().astype(np.int64)
    return windows


def follow(amplitude: Floats, *, table: Floats, sides: Floats, ratio: float = 1.0) -> Fates:
    """Return the fates of a block at rest under a motion of some amplitudes.

    Parameters
    ----------
    amplitude
        What the motion is multiplied by, its vertical component too.
    table, sides
        The motion, without the still base after it, and the block.
    ratio
        Factor by which the motion is faster.
    """
    # The kernel divides by the amplitude, which must not be 0.
    size = np.maximum(amplitude, SMALLEST)
    status, impacts, side, during = np.empty((4, len(size)), dtype=np.int64)
    fates = PulseFates(status, impacts, side, during, np.empty(len(size)))
    lifted = has_vertical(table)
    scaled = table.copy() if lifted else table
    # One motion does for all amplitudes, except for its vertical component, which counts in g.
    for part in (slice(k, k + 1) for k in range(len(size))) if lifted else (slice(None),):
        if lifted:
            np.multiply(table[:, LIFT:], size[part], out=scaled[:, LIFT:])
        ratios = np.full(len(size[part]), ratio)
        ends = PulseFates._make(each[part] for each in fates)
        pulse_fates(Tables(scaled, sides), size[part], ratios, COUNTED, FLIGHT_LIMIT, ends)
    return Fates(
        status == Status.OVERTURNED,
        np.isin(status, (Status.OVERTURNED, Status.AT_REST, Status.ROCKING)),
        impacts,
        side,
        during,
        # Differences and slopes stay finite.
        np.nan_to_num(np.minimum(fates.margin, 1e200), nan=-1.0),
    )


def has_vertical(table: Floats) -> bool:
    """Return whether the base moves vertically."""
    return table.shape[1] == NONLINEAR_SEGMENT_COLUMNS and bool(table[:, LIFT:].any())
