"""Tables of an assessment: sensitivity, remedies, risk, published formulas, motions."""

from collections.abc import Sequence

from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.record import Record
from rocksteady.results.description import Column, Table
from rocksteady.results.numbers import chance, quantity
from rocksteady.risk.assess._counts import Basis
from rocksteady.risk.assess._demand_level import horizontal, measured
from rocksteady.risk.assess._remedies import Remedy
from rocksteady.risk.assess._sensitivity import Case, end_words, tornado
from rocksteady.risk.assess.described.objects import parameter_words
from rocksteady.risk.hazard.failure_risk import Risk
from rocksteady.risk.screens.screens import Screens
from rocksteady.seismic.measures.scalar import Measure


def tables_of(
    screens: Screens,
    cases_found: Sequence[Case],
    basis: Basis | None,
    remedies: Sequence[Remedy],
    risks_found: Sequence[Risk],
    motions: Sequence[Record | BaseMotion],
) -> list[Table]:
    """Return the tables of an assessment that have rows; some are for JSON alone."""
    rows = [dict(row.values()) for row in screens.rows]
    words = [{**row.values(), "value": row.words} for row in screens.rows]
    screen_columns = [
        Column("name", "formula", left=True),
        Column("value", "value", str),
        Column("verdict", "verdict", left=True),
    ]
    risks = [
        {
            "hazard": risk.hazard.name or risk.hazard.label,
            "annual_rate": risk.annual_rate,
            "years": risk.years,
            "probability": risk.probability,
            "hclpf": risk.hclpf,
            "share_outside": risk.share_outside,
        }
        for risk in risks_found
    ]
    risks_read = [
        {**row, "hclpf": quantity(risk.hclpf, risk.hazard.unit).rstrip()}
        for row, risk in zip(risks, risks_found, strict=True)
    ]
    risk_columns = [
        Column("hazard", "hazard", left=True),
        Column("annual_rate", "annual rate [1/yr]"),
        Column("years", "years"),
        Column("probability", "probability in them", chance),
        Column("hclpf", "HCLPF", str),
    ]
    cases = [case.to_dict() for case in cases_found]
    bars = tornado(cases_found, basis) if cases_found else []
    bar_columns = [
        Column("parameter", "what is varied alone", parameter_words, left=True),
        Column("range", "over", left=True),
        Column("low", "lowest probability", end_words),
        Column("high", "highest", end_words),
    ]
    bars = [{**bar, "range": _range(cases_found, bar["parameter"])} for bar in bars]
    tables = [
        Table("cases", cases),
        Table("tornado", bars, bar_columns, title="What matters most"),
        Table("remedies", [remedy.to_dict() for remedy in remedies]),
        Table("risks", risks),
        Table("", risks_read, risk_columns, title="Risk of falling"),
        Table("screens", rows),
        Table("", words, screen_columns, title="Code formulas, side by side"),
        Table("inputs", _inputs(motions)),
    ]
    return [table for table in tables if table.rows]


def _range(cases: Sequence[Case], parameter: str) -> str:
    """Return the changes of a parameter in words."""
    return ", ".join(case.change for case in cases if case.parameter == parameter)


def _inputs(suite: Sequence[Record | BaseMotion]) -> list[dict[str, object]]:
    """Return what each motion is."""
    records = [horizontal(each) for each in suite]
    pga, pgv = (measured(suite, Measure(name)) for name in ("pga_g", "pgv_m_s"))
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
