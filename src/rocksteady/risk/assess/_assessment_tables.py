"""Tables of an assessment: sensitivity, published formulas, motions."""

from collections.abc import Sequence

import numpy as np

from rocksteady.results.description import Column, Table
from rocksteady.results.numbers import number, share_of
from rocksteady.risk.assess._remedy import Remedy
from rocksteady.risk.assess._sensitivity import Case, bars_of
from rocksteady.risk.counted.motions import across, has_vertical
from rocksteady.risk.counted.suite import Shaking, Suite
from rocksteady.risk.screens.screens import Screens

REMEDIES = (
    Column("change", "what is changed", left=True),
    Column("value", "to [m]", number),
    Column("share", "falls", share_of),
    Column("share_1_1", "at 1.1 x", share_of),
    Column("shown_at", "shown from [m]", number),
    Column("friction_needed", "friction", number),
)
"""Columns of the least changes."""


def tables_of(
    screens: Screens,
    cases_found: Sequence[Case],
    suite: Suite,
    shaking: Shaking | None,
    remedies: Sequence[Remedy],
) -> list[Table]:
    """Return the tables of an assessment that have rows; some are for JSON alone."""
    rows = [dict(row.values()) for row in screens.rows]
    words = [{**row.values(), "value": row.words} for row in screens.rows]
    screen_columns = [
        Column("name", "formula", left=True),
        Column("value", "value", str),
        Column("verdict", "verdict", left=True),
    ]
    bar_columns = [
        Column("parameter", "what is varied alone", left=True),
        Column("ends", "from, to", left=True),
        Column("low", "falls at its low end", share_of),
        Column("high", "at its high end", share_of),
    ]
    bars = [bar._asdict() for bar in bars_of(cases_found)]
    tables = [
        Table("cases", [case.to_dict() for case in cases_found]),
        Table("tornado", bars, bar_columns, title="What matters most"),
        Table("remedies", [each.to_dict() for each in remedies], REMEDIES, title="Least changes"),
        Table("screens", rows),
        Table("", words, screen_columns, title="Code formulas, side by side"),
        Table("inputs", _inputs(suite, shaking)),
    ]
    return [table for table in tables if table.rows]


def _inputs(suite: Suite, shaking: Shaking | None) -> list[dict[str, object]]:
    """Return what each motion is, and by what factors it has the peaks of the demand."""
    factors: list[list[float]] = []
    if shaking is not None:
        factors = np.stack([shaking.scales, shaking.stretches], axis=1).tolist()
    every, left = len(factors) == len(suite.motions), iter(factors)
    rows: list[dict[str, object]] = []
    for motion, pga, pgv in zip(suite.motions, *(x.tolist() for x in suite.peaks), strict=True):
        record, lifted = across(motion), has_vertical(motion)
        counted = len(factors) > 0 and (every or lifted)
        scale, stretch = next(left) if counted else (None, None)
        rows.append(
            {
                "name": record.name,
                "samples": len(record.acceleration_m_s2),
                "dt_s": record.dt_s,
                "pga_g": pga,
                "pgv_m_s": pgv,
                "vertical": lifted,
                "scale": scale,
                "stretch": stretch,
            }
        )
    return rows
