"""Lists of windows over which a block overturns: what all results that have them share."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats, Integers
from rocksteady.dynamics.history.counted import COUNTED_IMPACTS
from rocksteady.dynamics.history.lowering import side_attributes
from rocksteady.dynamics.history.nonlinear_tables import sides_of
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import index_value
from rocksteady.model.equations import Model
from rocksteady.model.facts import block_text, block_values
from rocksteady.results.answer import Answer, left_out
from rocksteady.results.description import Fact
from rocksteady.results.numbers import number, plural
from rocksteady.results.result import Result

WIDEST = 3
"""Windows that an answer names."""
SHOWN = 3
"""Rows of an answer."""
MOST_DIGITS = 6
"""Significant digits of an end of a window."""
UNLISTED = ("left_out_low", "left_out_high")
"""Fields on the stretches in which windows left out lie."""
ON_FLOOR = 4
"""Digits of amplitudes on a floor, whose lines are within 1e-3 of the ground's peak."""
EXACT = ("frequency_ratio", "freq_hz", "pga_g", "pgv_m_s", "top")
"""Keys of a row whose values are given, not searched."""
LEFT = ("left_out", "left_out_width", "undecided", "unsettled")
"""Fields on amplitudes that a search leaves out, undecided or unsettled."""
OTHER_WAY = "the other way"
"""Mark of an amplitude of the reversed motion."""
NO_WINDOW = {"interval": [math.nan, math.nan], "impacts": -1, "side": 0, "endless": False}
"""Row of a table where only the reversed motion overturns the block."""


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
        sides = sides_of(self.block, self.model)
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

    @property
    def _block_fact(self) -> Fact:
        """The block in words, and in values where it has a size."""
        words = block_text(self.block)
        if isinstance(self.block, Block):
            return Fact("block", block_values(self.block), "block", words)
        return Fact("", label="block", text=words)

    @property
    def _by_first(self) -> list[int]:
        """The rows that an answer shows, the smallest `governing` at the beginning."""
        falling = np.flatnonzero(~np.isnan(self.governing))
        order = falling[np.argsort(self.governing[falling], kind="stable")]
        return [int(row) for row in order[:SHOWN]]

    @property
    def _computed(self) -> tuple[str, str]:
        """Model and block, as a fact of an answer."""
        return "computed", f"{self.model.name}, {self.block.describe().headline}"

    @property
    def _undecided(self) -> tuple[str, str]:
        """How many sizes have no decision, as a fact of an answer."""
        count = int(self.undecided.sum())
        words = f"at {count:,} of the sizes tried, which count as standing"
        return "undecided", words if count else ""

    @property
    def _rest(self) -> tuple[str, str]:
        """Number of rows that are left out, as a fact of an answer."""
        stand = int(np.isnan(self.governing).sum())
        fall = len(self.first) - stand - len(self._by_first)
        kinds = {"falling": fall, "standing": stand}
        words = ", ".join(f"{count} {kind}" for kind, count in kinds.items() if count)
        return left_out(fall + stand, words)

    @property
    def _missing(self) -> str:
        """What the list of windows lacks, after the words on what was searched."""
        words, count = ", both ways" * self._two_ways, int(self.left_out.sum())
        if count:
            width = number(self.left_out_width.sum(), 2)
            words += f"; {plural(count, 'narrower window')}, {width} in width, left out"
        narrow = f"; ones narrower than {number(100.0 * self.resolution)} % may be missing"
        return words + narrow * bool(self.unsettled.any() or self._on_floors)

    def _with_other_way(self, write: Callable[[float], str], answer: Answer) -> Answer:
        """Return the answer of a single row with the least of the reversed motion."""
        if not self._two_ways:
            return answer
        least = float(self.opposite[0])
        words = "stands" if math.isnan(least) else f"falls {self._first_at(least, write)}"
        if not self.opposite_governs[0]:
            return replace(answer, facts=[(OTHER_WAY, words), *answer.facts])
        given = answer.sentence.replace("It ", "As given it ", 1)
        return replace(answer, sentence=f"The other way it {words}, which governs. {given}")

    def _least(self, size: float) -> str:
        """Return a mark where a block falls at the beginning of the search already."""
        return ", the least searched" * (size <= self.within[0])

    def _first_at(self, size: float, write: Callable[[float], str]) -> str:
        """Return the size from which a block falls in words."""
        return f"first at {write(size)}{self._least(size)}"

    def _governing_verdict(self, row: int, write: Callable[[float], str]) -> str:
        """Return from which size on the block of one row falls in the direction that governs."""
        if self.opposite_governs[row]:
            return f"falls {OTHER_WAY} {self._first_at(float(self.opposite[row]), write)}"
        return f"falls {self._verdict(row, write)}"

    def _verdict(self, row: int, write: Callable[[float], str]) -> str:
        """Return from which size on a block of one row falls, and what it does up to the end."""
        first, end = float(self.first[row]), float(self._ends[row])
        at = f"at {write(first)}{self._least(first)}"
        last = (self.intervals(row) or [(first, end)])[-1]
        turn = last[1] if last[1] < end else last[0]  # beyond it nothing changes
        if turn > first and number(turn) == number(end):
            return f"first {at}"
        to_end = f"to {write(end)}"  # where the search ends
        if last[1] < end and self.left_out[row]:
            return f"first {at}"
        if last[1] < end:
            return f"first {at}; it stands from {write(turn)} {to_end}"
        if turn == first:
            return f"{at}, and always up {to_end}"
        return f"first {at}; always from {write(turn)} {to_end}"

    def _governs(self, row: int) -> str:
        """Return the direction that governs a row in a word or two; empty where it stands."""
        if math.isnan(self.governing[row]):
            return ""
        if self.opposite_governs[row]:
            return OTHER_WAY
        return "either way" if self.first[row] == self.opposite[row] else "as given"

    def _widest(self, row: int, unit: float = 1.0) -> str:
        """Return the widest windows of one row that end before the search does."""
        ended = [ends for ends in self.intervals(row) if ends[1] < self._ends[row]]
        widest = sorted(sorted(ended, key=lambda ends: ends[0] - ends[1])[:WIDEST])
        return ", ".join(_span(low * unit, high * unit) for low, high in widest)

    def _narrower(self, row: int) -> str:
        """Return how many windows of one row are narrower than the widest ones."""
        count = sum(ends[1] < self._ends[row] for ends in self.intervals(row)) - WIDEST
        return f"; {plural(count, 'narrower window')}" if count > 0 else ""

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
        left = {name: getattr(self, name)[row].item() for name in LEFT}
        return left | {"left_out_within": [list(ends) for ends in self.unlisted(row)]}

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
        words = dict.fromkeys(("low", "high", "first", "opposite", "top", *UNLISTED), unit)
        words["impacts"] = {"units": "1", "long_name": f"{COUNTED_IMPACTS}; -1: no window"}
        per_window = ("low", "high", "impacts", "side")
        dims = dict.fromkeys(per_window, (rows, "window"))
        dims |= dict.fromkeys(UNLISTED, (rows, "stretch"))
        return {
            name: (dims.get(name, (rows,)), getattr(self, name), words.get(name, {"units": "1"}))
            for name in (*per_window, "first", "opposite", *more, *LEFT, *UNLISTED)
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


def floor_digits(row: Any) -> Any:
    """Return a row, or a part of it, with the digits of amplitudes that are right on a floor."""
    if isinstance(row, dict):
        kept = {key: each if key in EXACT else floor_digits(each) for key, each in row.items()}
        for unit in {"", "_g", "_m_s"} & {key.removeprefix("low") for key in row}:
            kept["low" + unit], kept["high" + unit] = _ends(row["low" + unit], row["high" + unit])
        return kept
    if isinstance(row, list) and len(row) == 2 and {*map(type, row)} == {float}:
        return list(_ends(*row))
    if isinstance(row, list):
        return [floor_digits(each) for each in row]
    return float(f"{row:.{ON_FLOOR}g}") if isinstance(row, float) else row


def _ends(low: float, high: float) -> tuple[float, float]:
    """Return the ends of a window with the digits that are right, or more to tell them apart."""
    rounded = ((float(f"{low:.{n}g}"), float(f"{high:.{n}g}")) for n in range(ON_FLOOR, 18))
    return next((ends for ends in rounded if ends[0] != ends[1]), (low, high))


def listed(names: Sequence[str]) -> str:
    """Return some names, the first three and the number of the others."""
    more = len(names) - WIDEST
    return ", ".join(names[:WIDEST]) + (f" and {more:,} more" if more > 0 else "")


def _span(low: float, high: float) -> str:
    """Return two ends with as many digits as they differ in."""
    pairs = ((number(low, digits), number(high, digits)) for digits in range(3, MOST_DIGITS))
    apart = next((ends for ends in pairs if ends[0] != ends[1]), None)
    return "-".join(apart or (number(low, MOST_DIGITS), number(high, MOST_DIGITS)))
