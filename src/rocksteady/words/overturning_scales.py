"""Words of the scales of records at which they overturn a block."""

import functools
import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from rocksteady.model.facts import case_text, solved_text
from rocksteady.results.description import Column, Description, Fact, Table, line
from rocksteady.results.numbers import number, plural, quantity
from rocksteady.results.result import describes
from rocksteady.seismic.spectra.overturning_scales import OverturningScales
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
from rocksteady.words.spectra import shortened

if TYPE_CHECKING:
    import xarray


MOST_ROWS = 100
"""Windows that a summary shows."""


def scales_dataset(scales: OverturningScales) -> "xarray.Dataset":
    """Return the windows as an xarray Dataset over record and window."""
    import xarray

    along, scale = "record", {"units": "1", "long_name": "factor of the accelerations"}
    return xarray.Dataset(
        window_variables(scales, along, scale, "top", "share"),
        coords={
            "record": list(scales.names),
            "window": np.arange(scales.low.shape[1]),
            "pga_g": (along, scales.pga_g, {"units": "g", "long_name": "PGA at scale 1"}),
            "pgv_m_s": (along, scales.pgv_m_s, {"units": "m/s", "long_name": "PGV at scale 1"}),
        },
        attrs=searched_attributes(scales),
    )


@describes(OverturningScales)
def describe_overturning_scales(scales: OverturningScales) -> Description:
    """Return the windows by record, in scale, PGA and PGV."""
    low, high = (number(end) for end in scales.within)
    facts = [
        block_fact(scales),
        Fact("model", scales.model.name, "model"),
        Fact("scales", list(scales.within), "searched", f"scales {low} to {high}"),
        Fact("resolution", scales.resolution),
    ]
    rows = [_row(scales, index) for index in range(len(scales.names))]
    records = [
        {name: row[name] for name in ("record", "first", "governing", "governs", "share")}
        | {name: row[name] for name in ("first_g", "governing_g")}
        | {"windows": len(scales.intervals(index))}
        for index, row in enumerate(rows)
    ]
    columns = [
        Column("record", "record"),
        Column("governing", "first scale", lambda value: number(value, 6)),
        Column("governing_g", "PGA g", lambda value: number(value, 4)),
        *([Column("governs", "governs")] if scales._two_ways else []),
        Column("windows", "windows"),
    ]
    window_columns = [
        Column("record", "record"),
        Column("low", "from scale", lambda value: number(value, 6)),
        Column("high", "to scale", lambda value: number(value, 6)),
        Column("low_g", "from g", lambda value: number(value, 4)),
        Column("high_g", "to g", lambda value: number(value, 4)),
        Column("low_m_s", "from m/s"),
        Column("high_m_s", "to m/s"),
        Column("side", "side", lambda value: ("", "+", "-")[value]),
    ]
    sentence, screen = _answer(scales)
    return Description(
        f"Overturning scales: {plural(len(rows), 'record')}, {case_text(scales.block)}, "
        f"{scales.model.name} model",
        [*screen, *facts],
        [
            Table(
                "",
                list(_window_rows(scales)),
                window_columns,
                most=MOST_ROWS,
                severity=lambda row: -row["low"],
            ),
            Table(
                "records",
                records,
                columns,
                most=MOST_ROWS,
                severity=lambda row: -row["governing"] if row["governs"] else -math.inf,
                kind=lambda row: "falling" if row["governs"] else "standing",
            ),
            Table("windows", rows),
        ],
        _notes(scales),
        sentence=sentence,
    )


def _answer(scales: OverturningScales) -> tuple[str, list[Fact]]:
    """Return at which scales it falls in the one record, or in each."""
    names, count = [shortened(name) for name in scales.names], len(scales.names)
    shown, falls = shown_rows(scales), int((~np.isnan(scales.governing)).sum())
    low, high = (number(end) for end in scales.within)
    searched = f"{low} to {high} x{missing_text(scales)}"
    if short := int((scales.top < scales.within[1]).sum()):
        searched += f"; {plural(short, 'record')} up to -g, from {number(scales.top.min())} x on"
    facts = [
        undecided_fact(scales),
        line("searched", solved_text(searched, scales.block)),
        computed_fact(scales),
    ]

    def write(row: int, scale: float) -> str:
        pga = quantity(scale * scales.pga_g[row], "g")
        return f"{number(scale)} x ({pga})"

    where = names[0] if count == 1 else f"all {count} records"
    reached = quantity(scales.pga_g.max() * scales.within[1], "g")
    stand = f"It stands in {where}, from {low} to {high} x ({reached})."
    if not shown:
        return stand, facts
    if count == 1:
        single, name = functools.partial(write, 0), names[0]
        if math.isnan(scales.first[0]):
            return with_other_way(scales, single, stand, facts)
        windows = widest_text(scales, 0)
        facts[1:1] = [line("falls", windows and f"{windows} x{narrower_text(scales, 0)}")]
        sentence = f"It falls {verdict(scales, 0, single)}.".replace(" x (", f" x {name} (", 1)
        return with_other_way(scales, single, sentence, facts)
    rows = [
        line(names[row], governing_verdict(scales, row, functools.partial(write, row)))
        for row in shown
    ]
    facts[1:1] = [*rows, other_rows_fact(scales)]
    row = shown[0]
    least = first_text(scales, float(scales.governing[row]), functools.partial(write, row))
    way = f", {OTHER_WAY}" * bool(scales.opposite_governs[row])
    sentence = f"It falls in {falls} of {count} records, {least} in {names[row]}{way}."
    return sentence, facts


def _notes(scales: OverturningScales) -> list[str]:
    """Return what the search has left."""
    notes = []
    if stands := int(np.isnan(scales.governing).sum()):
        notes.append(f"The block stands at all scales searched of {plural(stands, 'record')}.")
    if left_out := int(scales.left_out.sum()):
        notes.append(
            f"{plural(left_out, 'narrower window')} left out of the list and of CSV, of no "
            f"record more than {scales.left_out_width.max():.2g} wide together."
        )
    if unsettled := int((scales.unsettled > 0).sum()):
        notes.append(
            f"Ever narrower windows remain in {plural(unsettled, 'record')}: those narrower "
            f"than some {0.1 * scales.resolution:.0e} of the scale may be missing."
        )
    if short := int((scales.top < scales.within[1]).sum()):
        notes.append(
            f"The vertical component of {plural(short, 'record')} takes the base away under "
            f"the block, at -g, from scale {number(float(scales.top.min()))} on: the search ends "
            "there."
        )
    return notes


def _row(scales: OverturningScales, index: int) -> dict[str, object]:
    """Return all that is known of one record."""
    pga, pgv = float(scales.pga_g[index]), float(scales.pgv_m_s[index])
    intervals = scales.intervals(index)
    row = {
        "record": scales.names[index],
        "pga_g": pga,
        "pgv_m_s": pgv,
        "intervals": [list(ends) for ends in intervals],
        "intervals_g": [[end * pga for end in ends] for ends in intervals],
        "intervals_m_s": [[end * pgv for end in ends] for ends in intervals],
        "modes": window_values(scales, index),
        "first": float(scales.first[index]),
        "first_g": float(scales.first[index]) * pga,
        "opposite": float(scales.opposite[index]),
        "governing": float(scales.governing[index]),
        "governing_g": float(scales.governing[index]) * pga,
        "governs": governing_text(scales, index),
        "top": float(scales.top[index]),
        "share": float(scales.share[index]),
        **left_values(scales, index),
    }
    return floor_digits(row) if scales._floors[index] else row


def _window_rows(scales: OverturningScales) -> Iterator[dict[str, object]]:
    """Yield one row per window, as in tables and files."""
    for index, floor in enumerate(scales._floors):
        row, pga, pgv = _row(scales, index), scales.pga_g[index], scales.pgv_m_s[index]
        for each in scales.at(index) or [NO_WINDOW] * bool(row["governs"]):
            window = {
                "record": row["record"],
                "low": each.low,
                "high": each.high,
                "low_g": each.low * float(pga),
                "high_g": each.high * float(pga),
                "low_m_s": each.low * float(pgv),
                "high_m_s": each.high * float(pgv),
                "impacts": each.impacts,
                "side": each.side,
                "endless": each.endless,
                "left_out": row["left_out"],
                **{name: row[name] for name in ("governing", "governing_g", "governs")},
            }
            yield floor_digits(window) if floor else window
