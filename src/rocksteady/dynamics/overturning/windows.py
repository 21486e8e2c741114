"""Overturning spectra: all windows of amplitude in which a pulse overturns a block."""

import functools
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Annotated

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.dynamics.overturning._cases import BATCH, least_lift, load_kernel, windows_at
from rocksteady.dynamics.overturning.thresholds import THRESHOLDS
from rocksteady.dynamics.overturning.window_cells import (
    kept_windows,
    outputs,
    search_both_ways,
    uplifts_of,
)
from rocksteady.dynamics.overturning.window_lists import WindowLists
from rocksteady.errors import InputError, ModelError
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.bounds import INSIDE
from rocksteady.model.checks.validation import in_range, index_value, is_pair, rising
from rocksteady.model.equations import Linear, ModelChoice, chosen_model
from rocksteady.model.motions.floor import Floor
from rocksteady.model.motions.pulses import Pulse
from rocksteady.results.result import words_module
from rocksteady.sweep.cases.axes import Axis
from rocksteady.sweep.cases.grid import Grid
from rocksteady.sweep.evaluate import compute_cells
from rocksteady.sweep.run import Execution

if TYPE_CHECKING:
    import xarray


TOP = 20.0
"""Default largest amplitude of the search; for a block that hardly lifts by then,"""
UPLIFTS = 2.0
"""up to as many times that at which it lifts."""
HIGHEST = 1e6
"""Largest amplitude of a range."""
RESOLUTION = 2e-3


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class OverturningWindows(WindowLists):
    """All windows of amplitude in which a pulse overturns a block, over the frequency ratio.

    Attributes
    ----------
    block, pulse
        Block and pulse; only the shape of the pulse counts.
    floor
        Floor of the block, or None; amplitudes and frequencies are those of the ground.
    model
        `Linear()` or `Nonlinear()`.
    frequency_ratio
        omega/p, ascending, shape (frequencies,).
    within
        Ends of the range of amplitudes that was searched, a_max/(alpha g).
    resolution
        The largest step of the first amplitudes that were tried, as a part of them.
    low, high
        Ends of the windows, shape (frequencies, windows); nan beyond the last of a frequency.  On a
        floor, whose motion is lines within 1e-3 of the ground's peak, four digits are right, and
        windows narrower than `resolution` may be missing.
        Windows that touch differ in their impacts or their side.
    impacts
        Impacts before the block overturns, as `Impacts` counts them, the same shape; -1 beyond the
        last.  Ten or more, and on a floor all, vary in a window: those at its lower end stand here.
    side
        Side on which it falls, +1 or -1; 0 beyond the last.
    first
        The smallest amplitude that overturns the block, shape (frequencies,); nan where none does.
    opposite
        That of the reversed pulse, the same for a block whose sides are alike; the smaller governs
        where the direction of the motion is not known.
    left_out, left_out_width
        Number of windows beyond the widest 32, and their total width, to within
        the steps of the search.
    left_out_low, left_out_high
        Ends of the stretches in which they lie, or narrower ones may hide, between and beside the
        windows listed, shape (frequencies, stretches); nan beyond the last.
    undecided
        Amplitudes that were tried, either way, and whose fate could not be decided; they count as
        safe.
    unsettled
        Intervals, either way, in which a window might still hide when the search ended.  On the
        ground above 0 only after more than ten thousand amplitudes: where windows have no number,
        or nearly none.
    """

    pulse: Pulse
    frequency_ratio: Floats
    floor: Floor | None = None

    def _row_of(self, index: int | str) -> int:
        """Return a frequency by its number."""
        return index_value(index, len(self.frequency_ratio), "frequency ratio")

    def to_dataset(self) -> "xarray.Dataset":
        """Return the windows as an xarray Dataset over frequency ratio and window."""
        dataset: xarray.Dataset = words_module(OverturningWindows).windows_dataset(self)
        return dataset

    @property
    def _on_floors(self) -> bool:
        return self.floor is not None


@checked
def find_overturning_windows(
    block: Block | DimensionlessBlock,
    pulse: Pulse | str,
    frequency_ratios: ArrayLike,
    *,
    within: Annotated[tuple[float, float] | None, INSIDE] = None,
    resolution: float | None = None,
    model: ModelChoice = None,
    floor: Floor | None = None,
    run: Execution | None = None,
) -> OverturningWindows:
    """Find all windows of amplitude in which a pulse overturns a block, over the frequency.

    The amplitudes at which a block stands are not an interval [1]_: under a one-sine pulse it may
    fall after one impact, stand under a stronger pulse, and fall without an impact under a still
    stronger one.  At each frequency ratio the borders are found to rounding, or in the nonlinear
    model to a part of 1e-12, on a grid of amplitudes that is refined wherever the fate, the impacts
    on the way or the margin leave a doubt.  Long pulses with many impacts, below omega/p = 1 or of
    several cycles, have windows without end to their number: there `unsettled` counts where the
    search was ended.

    Parameters
    ----------
    block
        At rest at first.  In the linear model its restitution counts, and the ratios of its sides;
        in the nonlinear one its slenderness too.  One against a wall is held by what throws it
        there.
    pulse
        The name of a shape, or a `Pulse` for its shape, oscillations, phase and tolerance.
    frequency_ratios
        omega/p, ascending, shape (frequencies,), from 0.01 to 5000.
    within
        Range (low, high) of a_max/(alpha g), from 0 to 1e6; by default from uplift to 20, or to
        twice an uplift beyond 10.  Where a window reaches its end, nothing is known beyond.
    resolution
        Largest step of the first amplitudes, as a part of them (default 0.002).
    model
        ``"linear"`` or ``"nonlinear"``; by default nonlinear for a `Block`.
    floor
        A `rocksteady.motions.Floor` on which the block stands, a `Block`: at each frequency the
        motion is `floor_motion` of the pulse; amplitudes are those of the ground, by default from
        the least that lifts the block.  Impacts are many there: they vary in a window, and do not
        part any.
    run
        Executor, store and progress, as for `evaluate`; a cell is a frequency.

    Returns
    -------
    OverturningWindows
        The windows with the impacts before overturning and the side of each.

    Raises
    ------
    InputError, ModelError, OutputError, UnfinishedError
        If an argument is outside its range, the ratios do not ascend, the nonlinear model meets a
        block without slenderness, or as for `Pulse` and `evaluate`.

    References
    ----------
    .. [1] J. Zhang and N. Makris, J. Eng. Mech. 127, 473-483 (2001).

    Examples
    --------
    >>> from rocksteady import DimensionlessBlock, find_overturning_windows
    >>> block = DimensionlessBlock(restitution=0.9)
    >>> windows = find_overturning_windows(block, "one-sine", [2.0, 5.0])
    >>> for window in windows.at(1):
    ...     print(f"{window.low:.6f} to {window.high:.6f}, {window.impacts} impacts")
    3.018600 to 6.318071, 1 impacts
    7.168129 to 20.000000, 0 impacts
    """
    bare = block.dimensionless()
    axis = _ratios(frequency_ratios)
    unit = _unit(pulse, axis.points)
    chosen = chosen_model(model, block)
    # What counts of a block of the linear model is dimensionless.
    body = bare if isinstance(chosen, Linear) and floor is None else block
    if floor is not None and not isinstance(block, Block):
        raise ModelError("floor", floor, "its hertz need a block with a p", "give a Block")
    if within is None:
        top = min(max(TOP, UPLIFTS * max(uplifts_of(chosen.sides(body)))), HIGHEST)
        within = lowest_of(block, unit, axis.points.tolist(), model=chosen, floor=floor), top
    low, high = range_of(within)
    hint = "give a part of the amplitude, as 0.002"
    part = RESOLUTION if resolution is None else resolution
    step = in_range("resolution", part, 1e-6, 0.1, "[]", hint=hint)
    load_kernel(body, chosen, unit)
    data = compute_cells(
        functools.partial(
            search_both_ways,
            search=windows_at,
            block=body,
            model=chosen,
            pulse=unit,
            low=low,
            high=high,
            resolution=step,
            floor=floor,
        ),
        Grid(axes=(axis,)),
        outputs(),
        run=run,
        batch=BATCH,
    )
    return OverturningWindows(
        block=block,
        pulse=unit,
        model=chosen,
        frequency_ratio=axis.points,
        floor=floor,
        within=(low, high),
        resolution=step,
        **kept_windows(data),
    )


def lowest_of(
    block: Block | DimensionlessBlock,
    pulse: Pulse,
    ratios: Iterable[float],
    *,
    model: ModelChoice,
    floor: Floor | None,
) -> float:
    """Return the amplitude at which a search begins: of uplift, and on the ground at most 1.

    Parameters
    ----------
    block, pulse, model, floor
        As for `find_overturning_windows`.
    ratios
        omega/p.
    """
    equations = chosen_model(model, block)
    if floor is None:
        return min(*uplifts_of(equations.sides(block)), 1.0)
    return least_lift(floor, block, equations, replace(pulse, amplitude=1.0), ratios)


def threshold_without_impact(
    block: Block | DimensionlessBlock, pulse: Pulse, frequency_ratios: ArrayLike
) -> Floats:
    """Return `overturning_amplitude` for the side that a pulse lifts first, in A of the positive.

    Parameters
    ----------
    block
        For the negative side, which a reversed pulse lifts, alpha and p count; not for a block
        against a wall, which a reversed pulse holds at first.
    pulse
        Its shape and sign count.
    frequency_ratios
        Omega = omega/p of the positive side.
    """
    _, alpha_ratio, p_ratio = block.dimensionless().sides[int(pulse.reverse)]
    # Without the bounds of `overturning_amplitude`, which hold for the positive side.
    threshold = np.vectorize(THRESHOLDS[pulse.shape], otypes=[np.float64])
    amplitude: Floats = alpha_ratio * threshold(np.asarray(frequency_ratios) / p_ratio)
    return amplitude


def _unit(pulse: Pulse | str, ratios: Floats) -> Pulse:
    """Return the pulse of amplitude 1 and frequency ratio 1, at which the table is made."""
    given = pulse
    if isinstance(given, str):
        given = Pulse(shape=given, amplitude=1.0, frequency_ratio=1.0)
    if not isinstance(given, Pulse):
        raise InputError(
            "pulse", pulse, "it must be a Pulse or the name of one", "give a name, as 'one-sine'"
        )
    for ratio in (ratios.min(), ratios.max()):  # refuses what is outside its range
        replace(given, amplitude=1.0, frequency_ratio=float(ratio))
    return replace(given, amplitude=1.0, frequency_ratio=1.0)


def _ratios(frequency_ratios: ArrayLike) -> Axis:
    """Return the axis of frequency ratios."""
    axis = Axis(name="frequency_ratio", values=np.atleast_1d(frequency_ratios), long_name="omega/p")
    if axis.points.dtype.kind != "f" or (np.diff(axis.points) <= 0.0).any():
        raise InputError(
            "frequency_ratios",
            frequency_ratios,
            "they must be numbers that ascend",
            "give them from the lowest to the highest",
        )
    return axis


def range_of(within: tuple[float, float]) -> tuple[float, float]:
    """Return the ends of the range of amplitudes."""
    given: object = within
    hint = "give the lowest and the highest a_max/(alpha g), as (1.0, 20.0)"
    if not is_pair(given):
        raise InputError("within", given, "it must be a pair", hint)
    return rising("within", given, 0.0, HIGHEST, hint=hint)
