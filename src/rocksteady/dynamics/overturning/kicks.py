"""Least fatal kicks: the smallest impulse of the base that overturns a block from any state."""

import functools
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rocksteady.arrays import Floats
from rocksteady.dynamics.arrays import real_array
from rocksteady.dynamics.history.base_motion import (
    at_segment_starts,
    motion_after,
    refuse_endless,
)
from rocksteady.dynamics.history.simulate import simulate
from rocksteady.dynamics.history.start import HasStart, Rest, State, start_without_phase
from rocksteady.dynamics.overturning._kicked import Kicked, kicked_fates
from rocksteady.dynamics.overturning.scan import MANY, Found, scan
from rocksteady.dynamics.overturning.window_cells import (
    MOST_WINDOWS,
    closest_of,
    keep,
    kept_windows,
    nothing_found,
    outputs,
)
from rocksteady.dynamics.overturning.window_lists import WindowLists
from rocksteady.errors import InputError
from rocksteady.kernels.core.tables import JUMP
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.validation import rising
from rocksteady.model.equations import ModelChoice, chosen_model
from rocksteady.model.facts import kick_m_s
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.record import Record
from rocksteady.model.motions.segments import Motion, Still
from rocksteady.results.result import words_module
from rocksteady.sweep.cases.axes import Axis
from rocksteady.sweep.cases.grid import Grid
from rocksteady.sweep.evaluate import compute_cells
from rocksteady.sweep.run import Execution

if TYPE_CHECKING:
    import xarray


WITHIN = (0.0, 4.0)
MOST_KICK = 100.0
RESOLUTION = 0.01
FIRST = 1e-3
"""Part of the largest kick at which the grid begins, besides the least."""
NONE = 1e-9
"""Size below which a kick counts as zero."""
TRIES = 500
"""Kicks, besides the grid, after which a search ends."""
BELOW = 1.0 - 1e-9
"""Part of the least kick up to which a search is repeated,"""
CLOSER = 0.2
"""with steps that are so many times as large."""
SIGNS = (1, -1)


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class FatalKicks(WindowLists):
    """All kicks that overturn a block, at one or several moments, in both directions.

    A kick is a sudden change of the base velocity.  Rows are the moments, each with the positive
    kicks and then the negative ones.

    Attributes
    ----------
    block, model
        Block and equations of motion.
    start
        The state at pivot time 0.
    motion
        Motion of the base besides the kick.
    time_pt
        Pivot times p t of the kicks, shape (moments,).
    angle, velocity
        The state of the block just before the kick, and before an impulse of the motion at that
        moment: theta/alpha and d(theta/alpha)/d(p t).
    within
        Ends of the range of sizes, in units of alpha g/p.
    resolution
        The largest step of the first sizes that were tried, as a part of them.
    low, high, impacts, side
        Ends, impacts after the kick and side of each window of size, shape (2 moments, windows).
    first
        The smallest size that overturns, shape (2 moments,); nan where none in the range does, 0
        where the block falls without a kick.
    opposite
        That in the other direction, shape (2 moments,).
    left_out, left_out_width, undecided, unsettled
        What the search has left, shape (2 moments,).
    left_out_low, left_out_high
        Ends of the stretches in which the windows left out lie, shape (2 moments, stretches).
    """

    start: Rest | State
    motion: Motion | Record | BaseMotion
    time_pt: Floats
    angle: Floats
    velocity: Floats

    @property
    def unit_m_s(self) -> float:
        """The unit of a kick, alpha g/p [m/s]; nan of a dimensionless block."""
        return kick_m_s(self.block, 1.0)

    @property
    def signed(self) -> Floats:
        """The least fatal kick of each direction [alpha g/p], shape (moments, 2)."""
        kicks: Floats = self.first.reshape(-1, 2) * np.array(SIGNS) + 0.0  # no -0
        return kicks

    @property
    def least(self) -> Floats:
        """The least fatal kick with its sign [alpha g/p], shape (moments,); nan where none."""
        sizes = np.where(np.isnan(self.signed), math.inf, np.abs(self.signed))
        chosen = np.argmin(sizes, axis=1)[:, np.newaxis]
        kicks: Floats = np.take_along_axis(self.signed, chosen, axis=1)[:, 0]
        return kicks

    @property
    def least_m_s(self) -> Floats:
        """The least fatal kick with its sign [m/s], shape (moments,)."""
        return self.least * self.unit_m_s

    def to_dataset(self) -> "xarray.Dataset":
        """Return the windows as an xarray Dataset over moment, direction and window."""
        dataset: xarray.Dataset = words_module(FatalKicks).kicks_dataset(self)
        return dataset

    @property
    def _two_ways(self) -> bool:
        return True


@checked
def find_fatal_kicks(
    block: Block | DimensionlessBlock,
    *,
    start: Rest | State | HasStart | None = None,
    motion: Motion | Record | BaseMotion | None = None,
    times_pt: ArrayLike = 0.0,
    within: tuple[float, float] | None = None,
    model: ModelChoice = None,
    run: Execution | None = None,
) -> FatalKicks:
    """Find the smallest sudden change of the base velocity that overturns a block.

    The kick is added to the motion of the base at a moment, at which the block has the state that
    it has come to by then; with an impulse of the motion at that moment it makes one impulse.  All
    sizes are searched in both directions, since a block that falls under a kick may stand under a
    harder one.  From rest on a still base the least towards the positive side is
    `overturning_impulse`.

    Parameters
    ----------
    block
        The block.
    start
        `Rest` (default) or `State`, at pivot time 0.
    motion
        What shakes the base from time 0 on and comes to an end; a still base by default.
    times_pt
        Pivot times p t of the kick, a number or several, up to 1e6 and before the block has fallen
        without one; default 0.
    within
        Range (low, high) of sizes in units of alpha g/p, from 0 to 100; default (0, 4).
    model
        ``"linear"`` or ``"nonlinear"``; by default nonlinear for a `Block`.
    run
        Executor, store and progress, as for `evaluate`; a cell is a moment and a direction.

    Returns
    -------
    FatalKicks
        The windows of size, and the least of all.

    Raises
    ------
    InputError, ModelError
        If an argument is outside its range, the motion has no end, or as for `simulate`.

    Examples
    --------
    A slender block that leans by half its slenderness, at rest for a moment.  Towards its fall it
    needs 1/2; against it the impact takes a part away:

    >>> from rocksteady import DimensionlessBlock, State, find_fatal_kicks
    >>> block = DimensionlessBlock(restitution=0.9)
    >>> kicks = find_fatal_kicks(block, start=State(angle=0.5, velocity=0.0))
    >>> print(kicks.signed.round(6))
    [[ 0.5      -0.696109]]
    """
    begun = start_without_phase(start)
    shaking: Motion | Record | BaseMotion = Still() if motion is None else motion
    chosen = chosen_model(model, block)
    hint = "give the lowest and the highest kick over alpha g/p, as (0.0, 4.0)"
    given = WITHIN if within is None else within
    low, high = rising("within", given, 0.0, MOST_KICK, hint=hint)
    times = np.atleast_1d(real_array("times_pt", times_pt))
    if times.ndim != 1 or not times.size or not ((times >= 0.0) & (times <= 1e6)).all():
        raise InputError("times_pt", times_pt, "they must lie in [0, 1e6]", "give pivot times p t")
    course = simulate(block, shaking, start=begun, model=chosen)
    refuse_endless(course.segments, shaking)
    if (times > course.end_time_pt).any():
        raise InputError(
            "times_pt",
            float(times.max()),
            f"without a kick the run ends at {course.end_time_pt:.10g}: {course.status.label}",
            "give earlier pivot times p t",
        )
    times = at_segment_starts(course.segments, times)
    tables = [motion_after(course.segments, time) for time in times.tolist()]
    struck = np.array([table[0, JUMP] != 0.0 for table in tables])
    before = np.where(struck, np.nextafter(times, 0.0), times)
    samples = course(before)
    angle, velocity = samples.angle.copy(), samples.velocity.copy()
    if isinstance(begun, State):
        angle[times == 0.0], velocity[times == 0.0] = begun.angle, begun.velocity
    else:
        angle[times == 0.0] = velocity[times == 0.0] = 0.0
    sides = course.sides.copy()  # kernels take no read-only arrays
    cells = [
        Kicked(
            angle=float(u),
            velocity=float(v),
            direction=direction,
            table=table,
            sides=sides,
        )
        for table, u, v in zip(tables, angle, velocity, strict=True)
        for direction in SIGNS
    ]
    closest = closest_of(sides)
    names = [f"{moment}{'+' if cell.direction > 0 else '-'}" for moment, cell in enumerate(cells)]
    data = compute_cells(
        functools.partial(_windows_of, low=low, high=high, closest=closest),
        Grid(axes=(Axis(name="kick", values=names, long_name="kick", items=cells),)),
        outputs(),
        run=run,
        batch=1,
    )
    windows = kept_windows(data)
    windows["opposite"] = windows["first"].reshape(-1, 2)[:, ::-1].ravel()
    return FatalKicks(
        block=block,
        model=chosen,
        start=begun,
        motion=shaking,
        time_pt=times,
        angle=angle,
        velocity=velocity,
        within=(low, high),
        resolution=RESOLUTION,
        **windows,
    )


def _windows_of(
    kick: NDArray[np.object_], *, low: float, high: float, closest: float
) -> dict[str, NDArray[Any]]:
    """Return the windows of size of some kicks."""
    windows_found = nothing_found(len(kick))
    for cell, state in enumerate(kick):
        # Under a motion the impacts are many, and make no windows of their own.
        added = MANY if len(state.table) > 1 else 0
        fates = functools.partial(kicked_fates, kicked=state, impacts=added)
        windows = scan(
            fates,
            max(low, NONE),
            high,
            RESOLUTION,
            uplifts=(FIRST * high,),
            keep=MOST_WINDOWS,
            closest=closest,
            most=TRIES,
        )
        # Once more and closer below the least: that is what the search is for.
        below = float(windows.low[0]) * BELOW if added and windows.low.size else 0.0
        if below > max(low, NONE):
            less = scan(
                fates,
                max(low, NONE),
                below,
                CLOSER * RESOLUTION,
                uplifts=(FIRST * high,),
                keep=MOST_WINDOWS,
                closest=closest,
                most=TRIES,
            )
            windows = Found(
                np.concatenate([less.low, windows.low]),
                np.concatenate([less.high, windows.high]),
                np.concatenate([less.impacts, windows.impacts]),
                np.concatenate([less.side, windows.side]),
                less.undecided + windows.undecided,
                less.tried + windows.tried,
                np.concatenate([less.hidden, windows.hidden]),
            )
        # A block that falls under next to no kick falls without one.
        begin = np.where(windows.low <= NONE, 0.0, windows.low)
        windows = windows._replace(low=begin, impacts=windows.impacts - added)
        keep(windows_found, cell, windows)
    return windows_found
