"""Overturning factors: all scales of a record at which it overturns a block."""

import functools
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats
from rocksteady.dynamics.overturning.scan import MANY, scan
from rocksteady.dynamics.overturning.window_cells import (
    closest_of,
    follow,
    keep,
    kept_windows,
    lifts_of,
    nothing_found,
    outputs,
    search_both_ways,
    shaking_of,
)
from rocksteady.dynamics.overturning.window_lists import WindowLists
from rocksteady.errors import InputError
from rocksteady.kernels.core.tables import LIFT, LIFT_SLOPE
from rocksteady.kernels.elementary.arrays import log
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.validation import in_range, index_value, rising
from rocksteady.model.equations import Model, ModelChoice, chosen_model
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.record import Record
from rocksteady.results.result import words_module
from rocksteady.seismic.measures.time_course import integrate_record
from rocksteady.seismic.spectra.batch import GroundShaking
from rocksteady.seismic.spectra.grounds import check_grounds, grounds_of, names_of
from rocksteady.sweep.cases.axes import Axis
from rocksteady.sweep.cases.grid import Grid
from rocksteady.sweep.cases.outputs import Output
from rocksteady.sweep.evaluate import compute_cells
from rocksteady.sweep.run import Execution

if TYPE_CHECKING:
    import xarray


WITHIN = (0.1, 10.0)
RESOLUTION = 5e-4
SMALLEST, LARGEST_SCALE = 1e-3, 1e3
"""Ends beyond which no range of scales goes."""
MOST = 30_000
"""Scales, besides the grid, after which a search at that resolution ends."""
KEPT = 256
"""Windows that are kept of a record; of more the widest."""
LYING = 64
"""Most stretches kept of a record, in which the windows left out lie."""
ON_THE_GROUND = 1.0 - 1e-9
"""Part of g up to which the base may fall."""
OUTPUTS = (
    *outputs(KEPT, LYING),
    Output(name="share", long_name="share of the range that overturns, in the log of the scale"),
    Output(name="top", long_name="largest scale that was searched"),
)


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class OverturningScales(WindowLists):
    """All scales of records at which they overturn a block.

    Attributes
    ----------
    block, model
        Block and equations of motion.
    motions, names
        The records, each with its vertical component where it has one, and their names.
    within
        Ends of the range of scales.
    top
        The largest scale that was searched, shape (records,): the end of the range, or that at
        which the vertical component takes the base away under the block, at -g.
    resolution
        The largest step of the first scales that were tried, as a part of them.
    low, high
        Ends of the windows, shape (records, windows); nan beyond the last of a record.  Windows
        that touch differ in their side.
    impacts
        Impacts before the block overturns at the lower end, as `Impacts` counts them, the same
        shape; they vary in a window.
    side
        Side on which it falls, +1 or -1; 0 beyond the last.
    first
        The smallest scale that overturns the block, shape (records,); nan where none does.
    opposite
        That of the reversed record, the same for a block whose sides are alike; the smaller governs
        where the direction of the motion is not known.
    share
        Part of the range, in the logarithm of the scale, over which the block falls.
    pga_g, pgv_m_s
        PGA [g] and PGV [m/s] of the horizontal component at scale 1, shape (records,).
    left_out, left_out_width
        Number of windows beyond the widest 256, and their total width.
    left_out_low, left_out_high
        Ends of the stretches in which they lie, or narrower ones may hide, between and beside the
        windows listed, shape (records, stretches); nan beyond the last.  At most 64.
    undecided
        Scales that were tried, either way, and whose fate could not be decided; they count as safe.
    unsettled
        Intervals, either way, in which a narrow window might still hide when the search ended.
    """

    motions: tuple[Record | BaseMotion, ...]
    names: tuple[str, ...]
    top: Floats
    share: Floats
    pga_g: Floats
    pgv_m_s: Floats

    def _row_of(self, index: int | str) -> int:
        """Return a record by its name or its number."""
        if isinstance(index, str) and index in self.names:
            return self.names.index(index)
        return index_value(index, len(self.names), "record")

    @property
    def _ends(self) -> Floats:
        return self.top

    def falls(self, index: int | str, scale: float) -> bool:
        """Return whether a scale lies in one of the windows of a record.

        Parameters
        ----------
        index
            The record, by number or name.
        scale
            From the lower end of `within` to the record's `top`.

        Raises
        ------
        InputError
            If there is no such record, the scale was not searched, or it is beside the windows
            where narrower ones are left out.
        """
        row = self._row_of(index)
        low, high = self.within[0], float(self.top[row])
        hint = "stay inside, or search further: find_overturning_scales(..., within=...)"
        factor = in_range("scale", scale, low, high, "[]", hint=hint)
        listed = self.intervals(row)
        if factor == self.first[row] or any(low <= factor <= high for low, high in listed):
            return True
        if any(low <= factor <= high for low, high in self.unlisted(row)):
            raise InputError(
                "scale",
                scale,
                "it lies where windows narrower than those listed are left out",
                "search about it: find_overturning_scales(..., within=...)",
            )
        return False

    def to_dataset(self) -> "xarray.Dataset":
        """Return the windows as an xarray Dataset over record and window."""
        dataset: xarray.Dataset = words_module(OverturningScales).scales_dataset(self)
        return dataset

    @property
    def _on_floors(self) -> bool:
        return any(self._floors)

    @property
    def _floors(self) -> list[bool]:
        """Whether each record is that of a floor, whose lines leave four digits right."""
        return [ground.record.ground is not None for ground in grounds_of(self.motions)]


@checked
def find_overturning_scales(
    block: Block,
    motions: Record | BaseMotion | Sequence[Record | BaseMotion],
    *,
    within: tuple[float, float] | None = None,
    resolution: float | None = None,
    model: ModelChoice = None,
    run: Execution | None = None,
) -> OverturningScales:
    """Find all scales of records at which they overturn a block at rest.

    A record that topples a block may leave it standing when it is made stronger: the scales that
    overturn are windows, as the amplitudes of a pulse are.  Their borders are found to rounding, in
    the nonlinear model to a part of 1e-12.  A record's windows have no end to their number: beside
    each border there are narrower ones.  So a window narrower than `resolution` may be missed, and
    `unsettled` counts where.

    Parameters
    ----------
    block
        At rest at first.  If its sides differ, or one is a wall, the reversed record has other
        windows: their first scale is searched too.
    motions
        A record or several, or `BaseMotion` of a horizontal and a vertical record, which are scaled
        by the same factor.
    within
        Range (low, high) of scales, from 0.001 to 1000; default (0.1, 10).
    resolution
        Largest step of the first scales, as a part of them (default 0.0005).  The scales that may
        be tried besides grow with 1/resolution: 30 000 at the default.
    model
        ``"nonlinear"`` (default) or ``"linear"``.
    run
        Executor, store and progress, as for `evaluate`; a cell is a record.

    Returns
    -------
    OverturningScales
        The windows of each record, and the share of ln(scale) within the range that overturns.

    Raises
    ------
    InputError, ModelError
        If an argument is outside its range, or the linear model meets a vertical motion.

    Examples
    --------
    >>> from rocksteady import Block, Record, find_overturning_scales
    >>> block = Block.rectangle(width=0.4, height=1.6)
    >>> shock = Record(acceleration_m_s2=[0.0, 4.0, -4.0, 0.0], dt_s=0.3)
    >>> scales = find_overturning_scales(block, shock, within=(0.5, 2.0))
    >>> [(round(low, 4), round(high, 4)) for low, high in scales.intervals(0)]
    [(0.9388, 2.0)]
    """
    grounds = grounds_of(motions)
    names = names_of(ground.record for ground in grounds)
    chosen = chosen_model(model, block)
    low, high = _range(WITHIN if within is None else within)
    part = RESOLUTION if resolution is None else resolution
    step = in_range("resolution", part, 1e-6, 0.1, "[]", hint="give a part, as 0.002")
    check_grounds(grounds, [high] * len(grounds), [block], chosen)
    axis = Axis(name="record", values=names, long_name="record", items=grounds)
    follow(np.empty(0), table=_table(block, chosen, grounds[0]), sides=chosen.sides(block))
    data = compute_cells(
        functools.partial(
            search_both_ways,
            search=_windows_of,
            block=block,
            model=chosen,
            low=low,
            high=high,
            resolution=step,
        ),
        Grid(axes=(axis,)),
        OUTPUTS,
        run=run,
        batch=1,
    )
    courses = [integrate_record(ground.record.reference) for ground in grounds]
    return OverturningScales(
        block=block,
        motions=tuple(
            ground.record if ground.vertical is None else BaseMotion(ground.record, ground.vertical)
            for ground in grounds
        ),
        names=tuple(names),
        model=chosen,
        within=(low, high),
        resolution=step,
        top=data["top"].values,
        share=data["share"].values,
        pga_g=np.array([abs(course.peak_acceleration.value) for course in courses])
        / STANDARD_GRAVITY,
        pgv_m_s=np.array([abs(course.peak_velocity.value) for course in courses]),
        **kept_windows(data, LYING),
    )


def _windows_of(
    record: NDArray[np.object_],
    *,
    block: Block,
    model: Model,
    sides: Floats,
    low: float,
    high: float,
    resolution: float,
) -> dict[str, NDArray[Any]]:
    """Return the windows of some records."""
    windows_found = nothing_found(len(record), KEPT, LYING)
    windows_found |= {"share": np.zeros(len(record)), "top": np.full(len(record), high)}
    for cell, ground in enumerate(record):
        table = _table(block, model, ground)
        end = max(min(high, _largest_scale(table)), low)
        windows_found["top"][cell] = end
        if end == low:
            continue

        def fates(scale: Floats, table: Floats = table) -> Any:
            # The impacts of a record are many, and make no windows of their own.
            result = follow(scale, table=table, sides=sides)
            return result._replace(impacts=result.impacts + MANY)

        windows = scan(
            fates,
            low,
            end,
            resolution,
            uplifts=lifts_of(ground.record.acceleration_m_s2 / block.uplift_acceleration, sides),
            keep=KEPT,
            closest=closest_of(sides),
            most=round(MOST * max(1.0, RESOLUTION / resolution)),
            numbered=False,
        )
        keep(windows_found, cell, windows._replace(impacts=windows.impacts - MANY), KEPT, LYING)
        windows_found["share"][cell] = log(windows.high / windows.low).sum() / log(end / low)
    return windows_found


def _table(block: Block, model: Model, ground: GroundShaking) -> Floats:
    """Return the segments of a ground motion, without the still base after it."""
    return shaking_of(model.lower(block, ground.record, ground.vertical))


def _largest_scale(table: Floats) -> float:
    """Return the scale up to which the vertical component leaves the base under the block."""
    if table.shape[1] <= LIFT:
        return math.inf
    least = float(min((table[:, LIFT] + table[:, LIFT_SLOPE] * table[:, 0]).min(), 0.0))
    least = min(least, float(table[:, LIFT].min()))
    return math.inf if least >= 0.0 else ON_THE_GROUND / -least


def _range(within: tuple[float, float]) -> tuple[float, float]:
    """Return the ends of the range of scales."""
    hint = "give the lowest and the highest scale, as (0.1, 10.0)"
    return rising("within", within, SMALLEST, LARGEST_SCALE, hint=hint)
