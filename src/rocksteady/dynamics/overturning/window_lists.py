"""Lists of windows over which a block overturns: what all results that have them share."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rocksteady.dynamics.history.counted import COUNTED_IMPACTS
from rocksteady.dynamics.history.lowering import side_attributes
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import index_value
from rocksteady.model.equations import Model
from rocksteady.model.facts import block_text, block_values
from rocksteady.results.description import Fact
from rocksteady.results.result import Result

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

LEFT = ("left_out", "left_out_width", "undecided", "unsettled")
"""Fields on amplitudes that a search leaves out, undecided or unsettled."""


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
    left_out, left_out_width, undecided, unsettled
        What the search has left, shape (rows,).
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
    left_out: Integers
    left_out_width: Floats
    undecided: Integers
    unsettled: Integers

    def _row_of(self, index: int | str) -> int:
        """Return a row by its number, counted from the end where that is below 0."""
        return index_value(index, len(self.first), "row")

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

    @property
    def _block_fact(self) -> Fact:
        """The block in words, and in values where it has a size."""
        words = block_text(self.block)
        if isinstance(self.block, Block):
            return Fact("block", block_values(self.block), "block", words)
        return Fact("", label="block", text=words)

    def _modes(self, row: int) -> list[dict[str, Any]]:
        """Return the windows of one row in plain values."""
        return [
            {
                "interval": [window.low, window.high],
                "impacts": window.impacts,
                "side": window.side,
                "endless": window.endless,
            }
            for window in self.at(row)
        ]

    def _left(self, row: int) -> dict[str, Any]:
        """Return what is left out, undecided or unsettled in one row."""
        return {name: getattr(self, name)[row].item() for name in LEFT}

    def _variables(self, rows: str, unit: Mapping[str, str], *more: str) -> dict[str, Any]:
        """Return the windows as variables of a dataset.

        Parameters
        ----------
        rows
            Dimension of the rows.
        unit
            Attributes of an amplitude.
        more
            Further fields of shape (rows,), which stand before those of `LEFT`.
        """
        words = dict.fromkeys(("low", "high", "first", "top"), unit)
        words["impacts"] = {"units": "1", "long_name": f"{COUNTED_IMPACTS}; -1: no window"}
        per_window = ("low", "high", "impacts", "side")
        dims = dict.fromkeys(per_window, (rows, "window"))
        return {
            name: (dims.get(name, (rows,)), getattr(self, name), words.get(name, {"units": "1"}))
            for name in (*per_window, "first", *more, *LEFT)
        }

    @property
    def _searched(self) -> dict[str, Any]:
        """Attributes of a dataset: the equations, the sides and what was searched."""
        return {
            "model": self.model.name,
            **side_attributes(self.block),
            "within": list(self.within),
            "resolution": self.resolution,
        }
