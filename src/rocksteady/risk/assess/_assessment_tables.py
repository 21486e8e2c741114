"""Tables of an assessment: sensitivity, remedies, risk, published formulas, motions."""

from collections.abc import Sequence

from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.record import Record
from rocksteady.results.description import Column, Table
from rocksteady.results.numbers import number
from rocksteady.risk.assess._demand_level import horizontal, measured
from rocksteady.risk.assess._remedies import Remedy
from rocksteady.risk.assess._sensitivity import Case, tornado
from rocksteady.risk.hazard.failure_risk import Risk
from rocksteady.risk.screens.screens import Screens
from rocksteady.seismic.measures.scalar import Intensity


def tables_of(
    screens: Screens,
    cases_found: Sequence[Case],
    remedies: Sequence[Remedy],
    risks_found: Sequence[Risk],
    motions: Sequence[Record | BaseMotion],
) -> list[Table]:
    """Return the tables of an assessment; those without rows are left out."""
    rows = [dict(row.values()) for row in screens.rows]
    screen_columns = [
        Column("name", "screen", left=True),
        Column("value", "value"),
        Column("unit", "", left=True),
        Column("verdict", "verdict", left=True),
    ]
    case_columns = [
        Column("parameter", "changed", left=True),
        Column("change", "to", left=True),
        Column("probability", "P fitted"),
        Column("counted", "P counted"),
        Column("median", "median"),
    ]
    remedy_columns = [
        Column("name", "remedy", left=True),
        Column("change", "least change", _per_cent),
        Column("fitted", "P fitted"),
        Column("counted", "P counted"),
    ]
    risks = [
        {
            "hazard": risk.hazard.name or risk.hazard.label,
            "annual_rate": risk.annual_rate,
            "years": risk.years,
            "probability": risk.probability,
            "hclpf": risk.hclpf,
        }
        for risk in risks_found
    ]
    risk_columns = [
        Column("hazard", "hazard", left=True),
        Column("annual_rate", "falls a year"),
        Column("years", "years"),
        Column("probability", "P in these"),
        Column("hclpf", "HCLPF"),
    ]
    cases = [case.to_dict() for case in cases_found]
    bars = tornado(cases_found) if cases_found else []
    bar_columns = [
        Column("parameter", "uncertain", left=True),
        Column("low", "lowest P"),
        Column("high", "highest P"),
    ]
    input_columns = [
        Column("name", "motion", left=True),
        Column("samples", "samples"),
        Column("dt_s", "dt [s]"),
        Column("pga_g", "PGA [g]"),
        Column("pgv_m_s", "PGV [m/s]"),
    ]
    found = [
        Table("cases", cases, case_columns, title="One thing changed at a time"),
        Table("tornado", bars, bar_columns, title="What matters most"),
        Table(
            "remedies",
            [remedy.to_dict() for remedy in remedies],
            remedy_columns,
            title="Remedies",
        ),
        Table("risks", risks, risk_columns, title="Risk"),
        Table("screens", rows, screen_columns, title="Code formulas, side by side"),
        Table("inputs", _inputs(motions), input_columns, title="Motions", most=12),
    ]
    return [table for table in found if table.rows]


def _per_cent(change: float | None) -> str:
    """Return a relative change in per cent."""
    return "—" if change is None else f"{number(100.0 * change)} %"


def _inputs(suite: Sequence[Record | BaseMotion]) -> list[dict[str, object]]:
    """Return what each motion is."""
    records = [horizontal(each) for each in suite]
    pga, pgv = (measured(suite, Intensity(name)) for name in ("pga_g", "pgv_m_s"))
    return [
        {
            "name": record.name,
            "samples": len(record.acceleration_m_s2),
            "dt_s": record.dt_s,
            "pga_g": float(first),
            "pgv_m_s": float(second),
            "vertical": isinstance(each, BaseMotion) and each.vertical is not None,
        }
        for each, record, first, second in zip(suite, records, pga, pgv, strict=True)
    ]
