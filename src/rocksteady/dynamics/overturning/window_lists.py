"""Lists of windows over which a block overturns: what all results that have them share."""

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats, Integers
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import index_value
from rocksteady.model.equations import Model
from rocksteady.results.result import Result


class OverturningWindow(NamedTuple):
    """A range of amplitudes over which the block overturns in the same way."""

    low: float
    high: float
    """In the unit of the search; where `endless` is true, the end of the range."""
    impacts: int
    """Before it overturns, as `Impacts` counts them; ten or more vary, and are those at `low`."""
    side: int
    """On which it falls, +1 or -1."""
    endless: bool
    """Whether the window reaches the end of the range, so that its own end is not known."""


@checked
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class WindowLists(Result):
    """Windows of some rows: frequencies, records or kicks.

    Attributes
    ----------
    block, model
        What falls, by which equations.
    within, resolution
        The range that was searched, and its largest first step as a part of the amplitude.
    low, high, impacts, side
        Ends, impacts and side of each window, shape (rows, windows); nan, -1 and 0 beyond the last
        of a row.
    first
        The smallest amplitude that overturns the block, shape (rows,); nan where none does.
    opposite
        The same of the reversed motion; that of a block whose sides are alike is `first`.
    left_out, left_out_width, undecided, unsettled
        What the search has left, shape (rows,); the last two count both directions.
    left_out_low, left_out_high
        Ends of the stretches in which the windows left out lie, or narrower ones may hide, shape
        (rows, stretches); nan beyond the last.
    """

    block: Block | DimensionlessBlock
    model: Model
    within: tuple[float, float]
    resolution: float
    low: Floats
    high: Floats
    impacts: Integers
    side: Integers
    first: Floats
    opposite: Floats
    left_out: Integers
    left_out_width: Floats
    undecided: Integers
    unsettled: Integers
    left_out_low: Floats
    left_out_high: Floats

    def _row_of(self, index: int | str) -> int:
        """Return a row by its number, counted from the end where that is below 0."""
        return index_value(index, len(self.first), "row")

    @property
    def governing(self) -> Floats:
        """The smallest amplitude that overturns the block either way, shape (rows,)."""
        least: Floats = np.fmin(self.first, self.opposite)
        return least

    @property
    def opposite_governs(self) -> NDArray[np.bool_]:
        """Whether the reversed motion overturns the block at less, shape (rows,)."""
        smaller: NDArray[np.bool_] = self.governing < np.nan_to_num(self.first, nan=math.inf)
        return smaller

    @property
    def _two_ways(self) -> bool:
        """Whether the reversed motion was searched too: the sides of the block differ."""
        sides = self.model.sides(self.block)
        return bool((sides[0] != sides[1]).any())

    @property
    def _on_floors(self) -> bool:
        """Whether a motion is that of a floor, where narrow windows crowd."""
        return False

    @property
    def _ends(self) -> Floats:
        """Ends of the range that was searched, shape (rows,)."""
        return np.full(len(self.first), self.within[1])

    def at(self, index: int | str) -> tuple[OverturningWindow, ...]:
        """Return the windows of one row, in ascending order."""
        row = self._row_of(index)
        end = self._ends[row]
        return tuple(
            OverturningWindow(low, high, impacts, side, bool(high >= end))
            for low, high, impacts, side in zip(
                *(part[row].tolist() for part in (self.low, self.high, self.impacts, self.side)),
                strict=True,
            )
            if side != 0
        )

    def intervals(self, index: int | str) -> list[tuple[float, float]]:
        """Return where the block overturns in one row, in whatever way."""
        intervals: list[tuple[float, float]] = []
        for window in self.at(index):
            if intervals and intervals[-1][1] == window.low:
                intervals[-1] = (intervals[-1][0], window.high)
            else:
                intervals.append((window.low, window.high))
        return intervals

    def unlisted(self, index: int | str) -> list[tuple[float, float]]:
        """Return the stretches of one row in which windows are left out."""
        row = self._row_of(index)
        ends = zip(self.left_out_low[row].tolist(), self.left_out_high[row].tolist(), strict=True)
        return [(low, high) for low, high in ends if not math.isnan(low)]
