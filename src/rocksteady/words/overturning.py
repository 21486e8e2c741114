"""Words of overturning windows: at one frequency, or over a spectrum of them."""

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from rocksteady.dynamics.overturning.thresholds import THRESHOLDS
from rocksteady.dynamics.overturning.windows import OverturningWindows, threshold_without_impact
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.gravity import in_g
from rocksteady.model.equations import Linear
from rocksteady.model.facts import amplitude_text, case_text, restitution_values, solved_text
from rocksteady.results.description import Column, Description, Fact, Table, line
from rocksteady.results.numbers import number, plural, quantity
from rocksteady.results.result import describes
from rocksteady.words._window_lists import (
    NO_WINDOW,
    OTHER_WAY,
    block_fact,
    computed_fact,
    first_text,
    floor_digits,
    governing_text,
    governing_verdict,
    left_values,
    listed,
    missing_text,
    narrower_text,
    other_rows_fact,
    searched_attributes,
    shown_rows,
    undecided_fact,
    verdict,
    widest_text,
    window_values,
    window_variables,
    with_other_way,
)

if TYPE_CHECKING:
    import xarray

MOST_ROWS = 100
"""Windows that a summary shows."""


@describes(OverturningWindows)
def describe_windows(windows: OverturningWindows) -> Description:
    """Return the windows by frequency, in g and Hz too where the block has a size."""
    block, pulse, floor = windows.block, windows.pulse, _floor_text(windows)
    least, most = (amplitude_text(block, end) for end in windows.within)
    facts = [
        block_fact(windows),
        Fact("pulse", pulse.shape, "pulse", _pulse_text(windows)),
        Fact("reversed", pulse.reverse),
        Fact("oscillations", pulse.oscillations),
        Fact("phase", pulse.phase),
        Fact("floor", floor or None, "stands on" if floor else ""),
        Fact("model", windows.model.name, "model"),
        Fact("amplitudes", list(windows.within), "searched", f"{least} to {most}"),
        Fact("resolution", windows.resolution),
        *(Fact(key, value) for key, value in restitution_values(block).items()),
    ]
    rows = [_row(windows, index) for index in range(len(windows.frequency_ratio))]
    table = Table(
        "",
        list(_window_rows(windows)),
        _columns(windows),
        most=MOST_ROWS,
        severity=lambda row: -row["low"],
    )
    notes = [f"A is a/(alpha g){', of the ground' if floor else ''}."]
    stands = [number(ratio) for ratio in windows.frequency_ratio[np.isnan(windows.governing)]]
    if stands:
        notes.append(
            f"The block stands throughout at omega/p = {', '.join(stands[:8])}"
            + (f" and {len(stands) - 8} more." if stands[8:] else ".")
        )
    left_out = int(windows.left_out.sum())
    if left_out:
        notes.append(
            f"{left_out} narrower windows are left out, at no frequency more than "
            f"{windows.left_out_width.max():.2g} wide together."
        )
    unsettled = int((windows.unsettled > 0).sum())
    if unsettled:
        notes.append(
            f"At {unsettled} of the frequencies there are so many windows that narrow ones may "
            "be missing."
        )
    headline = (
        f"Overturning: {_pulse_text(windows)} pulse, "
        f"{floor}{', ' if floor else ''}"
        f"{case_text(block)}, {windows.model.name} model"
    )
    tables = [table, Table("windows", rows)]
    sentence, screen = _answer(windows)
    return Description(headline, [*screen, *facts], tables, notes, sentence=sentence)


def _answer(windows: OverturningWindows) -> tuple[str, list[Fact]]:
    """Return where it falls, at the one frequency or at each."""
    sized, unit = isinstance(windows.block, Block), 1.0
    if isinstance(windows.block, Block):
        unit = in_g(windows.block.uplift_acceleration)

    def write(amplitude: float) -> str:
        size = number(amplitude * unit)
        return f"{size} g" if sized else f"A = {size}"

    names = [_name(windows, index) for index in range(len(windows.frequency_ratio))]
    shown, pulse = shown_rows(windows), f"{_pulse_text(windows)} pulse"
    searched = f"{write(windows.within[0])} to {write(windows.within[1])}{missing_text(windows)}"
    facts = [
        line("stands on", _floor_text(windows)),
        undecided_fact(windows),
        line("searched", solved_text(searched, windows.block)),
        computed_fact(windows),
    ]
    at = names[0] if len(names) == 1 else f"all {len(names)} frequencies"
    stand = f"It stands in the {pulse} at {at}, up to {write(windows.within[1])}."
    if not shown:
        return stand, facts
    if len(names) > 1:
        stands = [names[row] for row in np.flatnonzero(np.isnan(windows.governing))]
        facts[1:1] = [
            *(line(names[row], governing_verdict(windows, row, write)) for row in shown),
            other_rows_fact(windows),
            line("stands at", listed(stands)),
        ]
        least = float(windows.governing[shown[0]])
        way = f", {OTHER_WAY}" * bool(windows.opposite_governs[shown[0]])
        sentence = (
            f"It falls at {len(names) - len(stands)} of {len(names)} frequencies, "
            f"{first_text(windows, least, write)} ({names[shown[0]]}, {pulse}{way})."
        )
        return sentence, facts
    if math.isnan(windows.first[0]):
        return with_other_way(windows, write, stand, facts)
    first, last = windows.at(0)[0], windows.at(0)[-1]
    after = f"{plural(first.impacts, 'impact')} at {write(first.low)}"
    if last.low > first.low:
        after += f", {plural(last.impacts, 'impact')} at {write(last.low)}"
    spans = "{} g" if sized else "A = {}"
    widest, closed = widest_text(windows, 0, unit), _closed_form(windows, 0)
    facts[1:1] = [
        line("falls", widest and f"{spans.format(widest)}{narrower_text(windows, 0)}"),
        line("falls after", after),
        line("without impact", "" if closed is None else f"from {write(closed)} on, closed form"),
    ]
    sentence = f"It falls {verdict(windows, 0, write)} ({names[0]} {pulse})."
    return with_other_way(windows, write, sentence, facts)


def _pulse_text(windows: OverturningWindows) -> str:
    """Return the pulse in a word or two."""
    return f"reversed {windows.pulse.shape}" if windows.pulse.reverse else windows.pulse.shape


def _floor_text(windows: OverturningWindows) -> str:
    """Return the floor in words; empty on the ground."""
    return "" if windows.floor is None else windows.floor.label


def _row(windows: OverturningWindows, index: int) -> dict[str, object]:
    """Return all that is known at one of the frequencies."""
    ratio, intervals = float(windows.frequency_ratio[index]), windows.intervals(index)
    governing = float(windows.governing[index])
    row: dict[str, object] = {
        "frequency_ratio": ratio,
        "intervals": [list(ends) for ends in intervals],
        "modes": window_values(windows, index),
        "first": float(windows.first[index]),
        "opposite": float(windows.opposite[index]),
        "governing": governing,
        "governs": governing_text(windows, index),
        "closed_form": _closed_form(windows, index),
        **left_values(windows, index),
    }
    if isinstance(windows.block, Block):
        unit = in_g(windows.block.uplift_acceleration)
        row["freq_hz"] = replace(windows.pulse, frequency_ratio=ratio).frequency_hz(windows.block)
        row["governing_g"] = governing * unit
        row["intervals_g"] = [[end * unit for end in ends] for ends in intervals]
    return row if windows.floor is None else floor_digits(row)


def _closed_form(windows: OverturningWindows, index: int) -> float | None:
    """Return from which amplitude on the block falls without an impact; None where not known."""
    pulse, ratio = windows.pulse, float(windows.frequency_ratio[index])
    linear = isinstance(windows.model, Linear)
    if not linear or pulse.shape not in THRESHOLDS or windows.floor is not None:
        return None
    return float(threshold_without_impact(windows.block, pulse, ratio))


def _name(windows: OverturningWindows, index: int) -> str:
    """Return one of the frequencies in words."""
    ratio = float(windows.frequency_ratio[index])
    if not isinstance(windows.block, Block):
        return f"W = {number(ratio)}"
    pulse = replace(windows.pulse, frequency_ratio=ratio)
    return quantity(pulse.frequency_hz(windows.block), "Hz")


def _window_rows(windows: OverturningWindows) -> Iterator[dict[str, object]]:
    """Yield one row per window, as in tables and files."""
    names = ("frequency_ratio", "freq_hz", "governing", "governing_g", "governs")
    for index in range(len(windows.frequency_ratio)):
        row = _row(windows, index)
        head: dict[str, object] = {name: row[name] for name in names if name in row}
        for each in windows.at(index) or [NO_WINDOW] * bool(row["governs"]):
            window = {**head, "low": each.low, "high": each.high}
            if isinstance(windows.block, Block):
                unit = in_g(windows.block.uplift_acceleration)
                window |= {"low_g": each.low * unit, "high_g": each.high * unit}
            window |= {"impacts": each.impacts, "side": each.side, "endless": each.endless}
            yield window if windows.floor is None else floor_digits(window)


def _columns(windows: OverturningWindows) -> list[Column]:
    """Return the columns of windows, in Hz and g first where the block has a size."""

    def high(value: float) -> str:
        return "the end" if value >= windows.within[1] else number(value, 6)

    columns = [
        Column("frequency_ratio", "omega/p", lambda value: number(value, 5)),
        Column("low", "from A", lambda value: number(value, 6)),
        Column("high", "to A", high),
        Column("impacts", "impacts", lambda value: str(value) if value >= 0 else ""),
        Column("side", "side", lambda value: ("", "+", "-")[value]),
    ]
    if windows._two_ways:
        name, unit = ("_g", "g") if isinstance(windows.block, Block) else ("", "A")
        columns.append(Column(f"governing{name}", f"first {unit}"))
        columns.append(Column("governs", "governs"))
    if isinstance(windows.block, Block):
        columns[:0] = [
            Column("freq_hz", "Hz"),
            Column("low_g", "from g"),
            Column("high_g", "to g"),
        ]
    return columns


def windows_dataset(windows: OverturningWindows) -> "xarray.Dataset":
    """Return the windows over frequency ratio and window."""
    import xarray

    along = "frequency_ratio"
    return xarray.Dataset(
        window_variables(windows, along, {"units": "1", "long_name": "a_max/(alpha g)"}),
        coords={
            along: (along, windows.frequency_ratio, {"long_name": "omega/p"}),
            "window": ("window", np.arange(windows.low.shape[1])),
        },
        attrs={
            "pulse": windows.pulse.shape,
            "reversed": int(windows.pulse.reverse),
            **({} if windows.floor is None else {"floor": windows.floor.label}),
            **searched_attributes(windows),
        },
    )
