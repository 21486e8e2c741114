"""Words of least fatal kicks: the least of all moments, and that of each."""

import functools
import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from rocksteady.dynamics.history.simulate import simulate
from rocksteady.dynamics.overturning.kicks import SIGNS, FatalKicks
from rocksteady.model.blocks.block import Block
from rocksteady.model.facts import case_text, kick_text, kicks_text, other_kick_text, solved_text
from rocksteady.outcomes import BALANCED
from rocksteady.results.description import Column, Description, Fact, Table, line
from rocksteady.results.numbers import number, quantity
from rocksteady.results.result import describes
from rocksteady.words._window_lists import (
    LEFT,
    OTHER_WAY,
    SHOWN,
    UNLISTED,
    block_fact,
    computed_fact,
    least_mark,
    left_values,
    missing_text,
    searched_attributes,
    undecided_fact,
    window_values,
)

if TYPE_CHECKING:
    import xarray

MOST_ROWS = 100
"""Moments and directions that a summary shows."""


@describes(FatalKicks)
def describe_kicks(kicks: FatalKicks) -> Description:
    """Return the least kicks by moment, in m/s too where the block has a size."""
    sized, write = isinstance(kicks.block, Block), functools.partial(number, digits=6)
    rows = list(_rows(kicks))
    listed = [
        {
            **row,
            "windows": [list(ends) for ends in kicks.intervals(index)],
            "modes": window_values(kicks, index),
            **left_values(kicks, index),
        }
        for index, row in enumerate(rows)
    ]
    columns = [
        *([Column("t_s", "s")] if sized else [Column("time_pt", "p t")]),
        Column("angle", "theta/alpha"),
        Column("direction", "kick", lambda value: "+" if value > 0 else "-"),
        *([Column("first_m_s", "least m/s", write)] if sized else []),
        Column("first", "of alpha g/p", write),
        Column("windows", "windows"),
    ]
    facts = [
        block_fact(kicks),
        Fact("model", kicks.model.name, "model"),
        Fact("sizes", list(kicks.within), "searched", f"kicks {_range_text(kicks)}"),
        Fact("resolution", kicks.resolution),
        Fact("least", _smallest(kicks), "least fatal kick", _least_text(kicks)),
    ]
    notes = []
    if unsettled := int((kicks.unsettled > 0).sum()):
        notes.append(
            f"Ever narrower windows remain in {unsettled} of {kicks.unsettled.size} searches: "
            "some may be missing."
        )
    headline = f"Least fatal kick: {case_text(kicks.block)}, {kicks.model.name} model"
    sentence, screen = _answer(kicks)
    return Description(
        headline,
        [*screen, *facts],
        [
            Table(
                "",
                rows,
                columns,
                most=MOST_ROWS,
                severity=lambda row: -row["first"] if row["windows"] else -math.inf,
            ),
            Table("kicks", listed),
        ],
        notes,
        sentence=sentence,
    )


def _answer(kicks: FatalKicks) -> tuple[str, list[Fact]]:
    """Return the least kick of all moments, then the other moments and the other way."""

    def write(kick: float) -> str:
        return f"{kick_text(kicks.block, kick)}{least_mark(kicks, abs(kick))}"

    def moment(index: int) -> str:
        time = float(kicks.time_pt[index])
        if isinstance(kicks.block, Block):
            return quantity(time / kicks.block.p, "s")
        return f"pt {number(time)}"

    searched = f"{_range_text(kicks)}{missing_text(kicks)}"
    facts = [
        undecided_fact(kicks),
        line("searched", solved_text(searched, kicks.block)),
        computed_fact(kicks),
    ]
    if math.isnan(_smallest(kicks)):
        return "It stands after every kick searched.", facts
    if _smallest(kicks) == 0.0:
        course = simulate(kicks.block, kicks.motion, start=kicks.start, model=kicks.model)
        ends = BALANCED if course.balanced else "falls without a kick"
        return f"It {ends}.", facts
    order = np.argsort(np.abs(kicks.least), kind="stable").tolist()
    at = order[0]
    opposite = float(kicks.signed[at, int(kicks.least[at] > 0.0)])
    words = other_kick_text(kicks.block, opposite, kicks.within) + least_mark(kicks, abs(opposite))
    state = f"theta/alpha {number(kicks.angle[at])}, velocity {number(kicks.velocity[at])}"
    least = kicks.least.tolist()
    rows = [
        line(moment(row), "stands" if math.isnan(least[row]) else write(least[row]))
        for row in order[:SHOWN]
    ]
    rows = rows if len(order) > 1 else []
    facts[1:1] = [*rows, line(OTHER_WAY, words), line("tilt before", state)]
    when = f" at {moment(at)}" if len(order) > 1 else ""
    kind = "kick found" if kicks.unsettled.any() else "kick"
    return f"The least {kind} that fells it is {write(_smallest(kicks))}{when}.", facts


def _range_text(kicks: FatalKicks) -> str:
    """Return the range that was searched, in words."""
    return kicks_text(kicks.block, kicks.within)


def _smallest(kicks: FatalKicks) -> float:
    """Return the least of all moments with its sign [alpha g/p]; nan where none."""
    fatal = kicks.least[~np.isnan(kicks.least)]
    return float(fatal[np.argmin(np.abs(fatal))]) if fatal.size else math.nan


def _least_text(kicks: FatalKicks) -> str:
    """Return the least fatal kick in words."""
    least = _smallest(kicks)
    return "none in the range" if math.isnan(least) else kick_text(kicks.block, least, 6)


def _rows(kicks: FatalKicks) -> Iterator[dict[str, object]]:
    """Yield a row for each moment and direction."""
    for moment, time in enumerate(kicks.time_pt.tolist()):
        for place, direction in enumerate(SIGNS):
            index = 2 * moment + place
            first = float(kicks.first[index])
            row: dict[str, object] = {
                "time_pt": time,
                "angle": float(kicks.angle[moment]),
                "velocity": float(kicks.velocity[moment]),
                "direction": direction,
                "first": first,
                "windows": len(kicks.intervals(index)),
            }
            if isinstance(kicks.block, Block):
                row["t_s"] = time / kicks.block.p
                row["first_m_s"] = first * kicks.unit_m_s
            yield row


def kicks_dataset(kicks: FatalKicks) -> "xarray.Dataset":
    """Return the windows over moment, direction and window."""
    import xarray

    across, every = ("moment", "direction"), ("moment", "direction", "window")
    kick = {"units": "1", "long_name": "change of base velocity over alpha g/p"}
    shape = len(kicks.time_pt), 2, kicks.low.shape[1]
    values: dict[str, object] = {
        name: (every, getattr(kicks, name).reshape(shape), kick) for name in ("low", "high")
    }
    for name in ("impacts", "side"):
        values[name] = (every, getattr(kicks, name).reshape(shape), {"units": "1"})
    values["first"] = (across, kicks.first.reshape(shape[:2]), kick)
    for name in LEFT:
        values[name] = (across, getattr(kicks, name).reshape(shape[:2]), {"units": "1"})
    for name in UNLISTED:
        ends = getattr(kicks, name).reshape(*shape[:2], -1)
        values[name] = ((*across, "stretch"), ends, kick)
    values["least"] = ("moment", kicks.least, kick)
    return xarray.Dataset(
        values,
        coords={
            "time_pt": ("moment", kicks.time_pt, {"units": "1", "long_name": "p t"}),
            "direction": list(SIGNS),
            "window": np.arange(shape[2]),
        },
        attrs=searched_attributes(kicks),
    )
