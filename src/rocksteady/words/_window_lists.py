"""Words of lists of windows: what all results that have them say alike."""

import math
from collections.abc import Callable, Mapping, Sequence

import numpy as np

from rocksteady.dynamics.history.samples import COUNTED_IMPACTS
from rocksteady.dynamics.overturning.window_lists import OverturningWindow, WindowLists
from rocksteady.model.blocks.block import Block
from rocksteady.model.facts import block_text, block_values, side_attributes
from rocksteady.results.description import Fact, left_out, line
from rocksteady.results.numbers import number, plural

WIDEST = 3
"""Windows that an answer names."""
SHOWN = 3
"""Rows of an answer."""
MOST_DIGITS = 6
"""Significant digits of an end of a window."""
UNLISTED = ("left_out_low", "left_out_high")
"""Fields on the stretches in which windows left out lie."""
LEFT = ("left_out", "left_out_width", "undecided", "unsettled")
"""Fields on amplitudes that a search leaves out, undecided or unsettled."""

ON_FLOOR = 4
"""Digits of amplitudes on a floor, whose lines are within 1e-3 of the ground's peak."""
EXACT = ("frequency_ratio", "freq_hz", "pga_g", "pgv_m_s", "top")
"""Keys of a row whose values are given, not searched."""
OTHER_WAY = "the other way"
"""Mark of an amplitude of the reversed motion."""
NO_WINDOW = OverturningWindow(math.nan, math.nan, impacts=-1, side=0, endless=False)
"""Row of a table where only the reversed motion overturns the block."""


def block_fact(lists: WindowLists) -> Fact:
    """Return the block in words, and in values where it has a size."""
    words = block_text(lists.block)
    if isinstance(lists.block, Block):
        return Fact("block", block_values(lists.block), "block", words)
    return Fact("", label="block", text=words)


def shown_rows(lists: WindowLists) -> list[int]:
    """Return the rows that an answer shows, the smallest `governing` first."""
    falling = np.flatnonzero(~np.isnan(lists.governing))
    order = falling[np.argsort(lists.governing[falling], kind="stable")]
    return [int(row) for row in order[:SHOWN]]


def computed_fact(lists: WindowLists) -> Fact:
    """Return model and block, as a fact of an answer."""
    return line("computed", f"{lists.model.name}, {lists.block.describe().headline}")


def undecided_fact(lists: WindowLists) -> Fact:
    """Return how many sizes have no decision, as a fact of an answer."""
    count = int(lists.undecided.sum())
    words = f"at {count:,} of the sizes tried, which count as standing"
    return line("undecided", words if count else "")


def other_rows_fact(lists: WindowLists) -> Fact:
    """Return the number of rows that are left out, as a fact of an answer."""
    stand = int(np.isnan(lists.governing).sum())
    fall = len(lists.first) - stand - len(shown_rows(lists))
    kinds = {"falling": fall, "standing": stand}
    words = ", ".join(f"{count} {kind}" for kind, count in kinds.items() if count)
    return left_out(fall + stand, words)


def missing_text(lists: WindowLists) -> str:
    """Return what the list of windows lacks, after the range that was searched."""
    words, count = ", both ways" * lists._two_ways, int(lists.left_out.sum())
    if count:
        width = number(lists.left_out_width.sum(), 2)
        words += f"; {plural(count, 'narrower window')}, {width} in width, left out"
    narrow = f"; ones narrower than {number(100.0 * lists.resolution)} % may be missing"
    return words + narrow * bool(lists.unsettled.any() or lists._on_floors)


def with_other_way(
    lists: WindowLists, write: Callable[[float], str], sentence: str, facts: Sequence[Fact]
) -> tuple[str, list[Fact]]:
    """Return the answer of a single row with the least of the reversed motion."""
    if not lists._two_ways:
        return sentence, [*facts]
    least = float(lists.opposite[0])
    words = "stands" if math.isnan(least) else f"falls {first_text(lists, least, write)}"
    if not lists.opposite_governs[0]:
        return sentence, [line(OTHER_WAY, words), *facts]
    given = sentence.replace("It ", "As given it ", 1)
    return f"The other way it {words}, which governs. {given}", [*facts]


def least_mark(lists: WindowLists, size: float) -> str:
    """Return a mark where a block falls at the beginning of the search already."""
    return ", the least searched" * (size <= lists.within[0])


def first_text(lists: WindowLists, size: float, write: Callable[[float], str]) -> str:
    """Return the size from which a block falls in words."""
    return f"first at {write(size)}{least_mark(lists, size)}"


def governing_verdict(lists: WindowLists, row: int, write: Callable[[float], str]) -> str:
    """Return the size from which a row falls in the direction that governs."""
    if lists.opposite_governs[row]:
        return f"falls {OTHER_WAY} {first_text(lists, float(lists.opposite[row]), write)}"
    return f"falls {verdict(lists, row, write)}"


def verdict(lists: WindowLists, row: int, write: Callable[[float], str]) -> str:
    """Return the size from which a row falls, and what follows up to the end."""
    first, end = float(lists.first[row]), float(lists._ends[row])
    at = f"at {write(first)}{least_mark(lists, first)}"
    last = (lists.intervals(row) or [(first, end)])[-1]
    turn = last[1] if last[1] < end else last[0]  # beyond it nothing changes
    if turn > first and number(turn) == number(end):
        return f"first {at}"
    to_end = f"to {write(end)}"  # where the search ends
    if last[1] < end and lists.left_out[row]:
        return f"first {at}"
    if last[1] < end:
        return f"first {at}; it stands from {write(turn)} {to_end}"
    if turn == first:
        return f"{at}, and always up {to_end}"
    return f"first {at}; always from {write(turn)} {to_end}"


def governing_text(lists: WindowLists, row: int) -> str:
    """Return the direction that governs a row; empty where it stands."""
    if math.isnan(lists.governing[row]):
        return ""
    if lists.opposite_governs[row]:
        return OTHER_WAY
    return "either way" if lists.first[row] == lists.opposite[row] else "as given"


def widest_text(lists: WindowLists, row: int, unit: float = 1.0) -> str:
    """Return the widest windows of one row that end before the search does."""
    ended = [ends for ends in lists.intervals(row) if ends[1] < lists._ends[row]]
    widest = sorted(sorted(ended, key=lambda ends: ends[0] - ends[1])[:WIDEST])
    return ", ".join(_span(low * unit, high * unit) for low, high in widest)


def narrower_text(lists: WindowLists, row: int) -> str:
    """Return how many windows of one row are narrower than the widest ones."""
    count = sum(ends[1] < lists._ends[row] for ends in lists.intervals(row)) - WIDEST
    return f"; {plural(count, 'narrower window')}" if count > 0 else ""


def window_values(lists: WindowLists, row: int) -> list[dict[str, object]]:
    """Return the windows of one row in plain values."""
    return [
        {
            "interval": [window.low, window.high],
            "impacts": window.impacts,
            "side": window.side,
            "endless": window.endless,
        }
        for window in lists.at(row)
    ]


def left_values(lists: WindowLists, row: int) -> dict[str, object]:
    """Return what is left out, undecided or unsettled in one row."""
    left = {name: getattr(lists, name)[row].item() for name in LEFT}
    return left | {"left_out_within": [list(ends) for ends in lists.unlisted(row)]}


def window_variables(
    lists: WindowLists, rows: str, unit: Mapping[str, str], *more: str
) -> dict[str, object]:
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
        name: (dims.get(name, (rows,)), getattr(lists, name), words.get(name, {"units": "1"}))
        for name in (*per_window, "first", "opposite", *more, *LEFT, *UNLISTED)
    }


def searched_attributes(lists: WindowLists) -> dict[str, object]:
    """Return the attributes of a dataset: equations, sides and what was searched."""
    return {
        "model": lists.model.name,
        **side_attributes(lists.block),
        "within": list(lists.within),
        "resolution": lists.resolution,
    }


def listed(names: Sequence[str]) -> str:
    """Return some names, the first three and the number of the others."""
    more = len(names) - WIDEST
    return ", ".join(names[:WIDEST]) + (f" and {more:,} more" if more > 0 else "")


def _span(low: float, high: float) -> str:
    """Return two ends with as many digits as they differ in."""
    pairs = ((number(low, digits), number(high, digits)) for digits in range(3, MOST_DIGITS))
    apart = next((ends for ends in pairs if ends[0] != ends[1]), None)
    return "-".join(apart or (number(low, MOST_DIGITS), number(high, MOST_DIGITS)))


def floor_digits(row: Mapping[str, object]) -> dict[str, object]:
    """Return a row with the digits of amplitudes that are right on a floor."""
    kept = {key: each if key in EXACT else _rounded(each) for key, each in row.items()}
    for unit in ("", "_g", "_m_s"):
        low, high = row.get(f"low{unit}"), row.get(f"high{unit}")
        if isinstance(low, float) and isinstance(high, float):
            kept[f"low{unit}"], kept[f"high{unit}"] = _ends(low, high)
    return kept


def _rounded(value: object) -> object:
    """Return a value of a row on a floor; of two numbers, the ends of a window."""
    if isinstance(value, dict):
        return floor_digits(value)
    if isinstance(value, list) and len(value) == 2 and {*map(type, value)} == {float}:
        return list(_ends(*value))
    if isinstance(value, list):
        return [_rounded(each) for each in value]
    return float(f"{value:.{ON_FLOOR}g}") if isinstance(value, float) else value


def _ends(low: float, high: float) -> tuple[float, float]:
    """Return the ends of a window with the digits that are right, or more to tell them apart."""
    rounded = ((float(f"{low:.{n}g}"), float(f"{high:.{n}g}")) for n in range(ON_FLOOR, 18))
    return next((ends for ends in rounded if ends[0] != ends[1]), (low, high))
