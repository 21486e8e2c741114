"""Words of facades: their checks, runs, mechanism and file."""

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Final

from rocksteady.facades.checks.facade_check import FacadeCheck, LimitStateCheck, enumerated
from rocksteady.facades.checks.facade_runs import BEYOND, FacadeRuns
from rocksteady.facades.checks.facade_schema import FILE
from rocksteady.facades.checks.mechanism import SHARE_SLV, Mechanism
from rocksteady.facades.checks.read_facade import DescribedFacade
from rocksteady.facades.checks.record_demand import FEWEST
from rocksteady.outcomes import Status
from rocksteady.results.description import Column, Description, Fact, Table, line
from rocksteady.results.numbers import length, number, number_or_none, plural, quantity
from rocksteady.results.result import describes
from rocksteady.results.words import facts_of

IN_TABLE: Final = ("no_demand", "q", "mean_of_runs", "eta")
"""Remarks that a text leaves out: its table shows them, or they follow from a formula."""

MECHANISM: Final = (Column("name", "quantity", left=True), Column("value", "value", left=True))
"""Columns of the table of the mechanism."""

KEYS = (
    "limit_state", "method", "formula", "page", "demand_name", "capacity_name", "unit", "demand",
    "capacity", "satisfied", "remark",
)  # fmt: skip
"""Columns of a row of JSON and CSV."""


@describes(FacadeCheck)
def describe_check(checked: FacadeCheck) -> Description:
    """Return the verdict, a row for each check, the mechanism, the reasons and remarks."""
    mechanism = checked.mechanism.describe()
    rows = [_row(check) for check in checked.checks]
    shown = [
        {
            **row,
            "check": check.name,
            "compared": f"{check.demand_name} <= {check.capacity_name}",
            "demand": _words(check, check.demand),
            "capacity": _words(check, check.capacity),
        }
        for check, row in zip(checked.checks, rows, strict=True)
    ]
    columns = [
        Column("check", "check", left=True),
        Column("compared", "compared", left=True),
        Column("demand", "demand"),
        Column("capacity", "capacity"),
        Column("satisfied", "satisfied"),
    ]
    # People read the checks first: the facts are a table below them.
    facts = [replace(fact, label="") for fact in mechanism.facts]
    facts.append(Fact("verdict", checked.sentence))
    facts.append(Fact("ending", [each.name for each in checked.facade.ending]))
    curve = [{"displacement_m": d, "capacity_g": a} for d, a in checked.mechanism.curve]
    sizes = [
        {"name": fact.label, "value": fact.words}
        for fact in mechanism.facts
        if fact.label and fact.key not in ("name", "d_slv_m", "d_slc_m")
    ]
    if checked.runs is not None:
        facts.append(Fact("runs", checked.runs.describe().to_dict()))
    sentence, screen, decided = _answer(checked)
    return Description(
        headline=checked.verdict,
        facts=[*screen, *facts],
        tables=[
            Table("checks", rows),
            Table("", shown, columns),
            Table("", sizes, MECHANISM, title="Mechanism"),
            Table("capacity_curve", curve),
        ],
        notes=[*map(str, checked.reasons), *_of_checks(checked), *map(str, checked.remarks)],
        sentence=sentence,
        rows=decided,
    )


def _answer(checked: FacadeCheck) -> tuple[str, list[Fact], list[tuple[str, str]]]:
    """Return the verdict, the checks, and runs beyond d0."""
    decided = [check for check in checked.checks if check.satisfied is not None]
    decided.sort(key=lambda check: (check.satisfied is True, -_ratio(check)))
    sentence = checked.verdict
    if not decided:
        sentence = "No answer yet: no check has a demand, capacity alone is known"
    refused = [
        str(remark)
        for check in checked.checks
        for remark in check.remarks
        if check.satisfied is None and remark.key == "weak_records"
    ]
    sentence += "; no verdict by runs" if refused and decided else ""
    if checked.runs is not None and checked.runs.refusal is not None:
        refused = [checked.runs.refusal]
    facts = [line("runs", " ".join(refused))]
    if checked.runs is not None and checked.runs.beyond:
        records = plural(len(checked.runs.records), "record")
        facts.append(line("beyond d0", f"runs under {len(checked.runs.beyond)} of {records}"))
    if checked.runs is None:
        d0, slv = length(checked.mechanism.d0_m), length(checked.mechanism.d_slv_m)
        facts.append(line("d0", f"{d0}, and d_SLV = {SHARE_SLV:g} d0 = {slv}"))
    open_states = {each.limit_state: None for each in checked.checks if each.satisfied is None}
    missing = enumerated([each for each in open_states if each not in checked.states])
    facts.append(line("no demand", f"for {missing}" if missing else ""))
    facts.append(line("not counted", ", ".join(each.name for each in checked.facade.ending)))
    rows = [(each.name, _compared(checked, each)) for each in decided]
    return f"{sentence}.", facts, rows


def _compared(checked: FacadeCheck, check: LimitStateCheck) -> str:
    """Return demand and capacity of a check with their names and their ratio."""
    if check.demand == math.inf:
        return f"beyond d0 = {length(checked.mechanism.d0_m)}: not satisfied"
    demand = f"{check.demand_name} {_words(check, check.demand)}"
    capacity = f"{check.capacity_name} {_words(check, check.capacity)}"
    ratio = number(_ratio(check), 2)
    return f"{demand} of {capacity} ({ratio}){'' if check.satisfied else ': not satisfied'}"


def _of_checks(checked: FacadeCheck) -> Iterator[str]:
    """Yield how demands were made, as far as the table does not show it."""
    missing = [
        check.limit_state
        for check in checked.checks
        if any(remark.key == "no_demand" for remark in check.remarks)
    ]
    if missing:
        yield f"No demand is given for {enumerated(list(dict.fromkeys(missing)))}: capacity alone."
    for check in checked.checks:
        words = "; ".join(str(each) for each in check.remarks if each.key not in IN_TABLE)
        if words:
            yield f"{check.name}: {words}."


def _row(check: LimitStateCheck) -> dict[str, object]:
    """Return a check as plain values."""
    row = {key: getattr(check, key) for key in KEYS}
    return {**row, "demand": None if check.demand == math.inf else check.demand}


def _ratio(check: LimitStateCheck) -> float:
    """Return demand over capacity of a check with a demand."""
    assert check.ratio is not None
    return check.ratio


def _words(check: LimitStateCheck, value: float | None) -> str:
    """Return a demand or a capacity of a check as people read it."""
    if value is None:
        return "—"
    if value == math.inf:
        return "beyond d0"
    return quantity(value, "g") if check.unit == "g" else length(value)


@describes(FacadeRuns)
def describe_runs(runs: FacadeRuns) -> Description:
    """Return the mean beside its limit, and a row for each record and each run."""
    mechanism = runs.facade.mechanism
    mean, beyond, ratio = runs.mean_m, runs.beyond, mechanism.block().restitution
    limit = f"d_{runs.limit_state} = {length(runs.limit_m)}"
    facts = [
        Fact("limit_state", runs.limit_state, "limit state of the records"),
        Fact("model", runs.model.name, "equations of motion"),
        Fact("d0_m", mechanism.d0_m, "d0", length(mechanism.d0_m)),
        Fact("limit_m", runs.limit_m, "the mean may reach", limit),
        Fact("mean_m", number_or_none(mean), "mean of the largest", _mean_words(runs)),
        Fact("beyond", list(beyond), "records beyond d0", ", ".join(beyond) or "none"),
        Fact("satisfied", runs.satisfied, "dynamic check", _verdict(runs.satisfied)),
        Fact("base_factor", mechanism.base_factor, "factor of the base acceleration"),
        Fact("restitution", ratio, "restitution", number(ratio)),
    ]
    rows, signs = list(_by_record(runs)), list(_by_run(runs))
    criterion = (
        "Circolare 2019 n. 7, C8.7.1.2.1.9 (pp. 272-277, not checked against the printed "
        "standard): no run "
        f"beyond d0, and a mean of the largest displacements of at most d_{runs.limit_state}; "
        "of each record the larger of both signs counts."
    )
    columns = (
        Column("record", "record", left=True),
        Column("pga_g", "PGA [g]", number),
        *(Column(key, f"d {key}", _length) for key in runs.directions),
        Column("share_d0", "d/d0", _share),
    )
    return Description(
        headline=f"{runs.facade.name}: {plural(len(runs.records), 'record')}, "
        f"{plural(len(signs), 'run')}, {_mean_words(runs)}, limit {limit}",
        facts=facts,
        tables=[
            Table("runs", signs),
            Table(
                "records",
                rows,
                columns,
                title="Largest displacement of each record",
                severity=lambda row: math.inf if row["share_d0"] is None else row["share_d0"],
                kind=lambda row: BEYOND if row["beyond_d0"] else "within d0",
                alarm=BEYOND,
            ),
        ],
        notes=[*runs.remarks, criterion],
    )


def _by_record(runs: FacadeRuns) -> Iterator[dict[str, object]]:
    """Yield a row for each record."""
    for place, name in enumerate(runs.records):
        signs = zip(runs.directions, runs.displacement_m[place].tolist(), strict=True)
        worst = float(runs.share[place].max())
        yield {
            "record": name,
            "pga_g": float(runs.pga_g[place]),
            "scale": float(runs.scale[place]),
            "vertical": runs.vertical[place],
            **{sign: number_or_none(value) for sign, value in signs},
            "largest_m": number_or_none(float(runs.largest_m[place])),
            "share_d0": number_or_none(worst),
            "beyond_d0": worst > 1.0,
        }


def _by_run(runs: FacadeRuns) -> Iterator[dict[str, object]]:
    """Yield a row for each run."""
    for place, name in enumerate(runs.records):
        for sign, direction in enumerate(runs.directions):
            ratio = float(runs.share[place, sign])
            yield {
                "record": name,
                "direction": direction,
                "pga_g": float(runs.pga_g[place]),
                "scale": float(runs.scale[place]),
                "status": Status(int(runs.status[place, sign])).label,
                "uplift": ratio > 0.0,
                "displacement_m": number_or_none(ratio * runs.facade.mechanism.d0_m),
                "share_d0": number_or_none(ratio),
                "beyond_d0": ratio > 1.0,
            }


def _length(value: float | None) -> str:
    """Return a displacement of a row as people read it."""
    return "beyond d0" if value is None else length(value)


def _share(value: float | None) -> str:
    """Return a part of d0 of a row as people read it."""
    return "beyond" if value is None else number(value)


def _mean_words(runs: FacadeRuns) -> str:
    """Return the mean as people read it."""
    mean = runs.mean_m
    if mean is None:
        return f"no mean of fewer than {FEWEST} records"
    if not math.isfinite(mean):
        return "mean beyond d0"
    return f"mean {length(mean)} ({number(mean / runs.facade.mechanism.d0_m)} d0)"


def _verdict(satisfied: bool | None) -> str:
    """Return a verdict as people read it."""
    return "no verdict" if satisfied is None else "satisfied" if satisfied else "not satisfied"


@describes(Mechanism)
def describe_mechanism(mechanism: Mechanism) -> Description:
    """Return what the formulas of the circular give, and the equivalent block."""
    facts = facts_of(
        mechanism,
        "name alpha0 uplift_g e_star e_star_lumped mass_kg confidence_factor a0_g a0_lumped_g "
        "linear_g elastic_period_s arm_m d0_m d_slv_m d_slc_m t_slv_s t_slc_s theta0_rad "
        "p_rad_s base_factor run_activation_g",
    )
    return Description(
        headline=f"{mechanism.name}: a0 {quantity(mechanism.a0_g, 'g')}, "
        f"d0 {length(mechanism.d0_m)}, T_SLV {quantity(mechanism.t_slv_s, 's')}",
        facts=facts,
    )


@describes(DescribedFacade)
def describe_facade(described: DescribedFacade) -> Description:
    """Return the sizes, what acts, and which limit states have a demand."""
    facade = described.facade
    ending, given = [each.name for each in facade.ending], list(described.demand.given)
    facts = [
        Fact("name", facade.name, "facade"),
        Fact("kind", facade.kind, "kind"),
        Fact("thickness_m", facade.thickness_m, "thickness", f"{facade.thickness_m:g} m"),
        Fact("height_m", facade.height_m, "height", f"{facade.height_m:g} m"),
        Fact("weight_kn", facade.weight_kn, "own weight", f"{facade.weight_kn:.4g} kN"),
        *(Fact(key, len(getattr(facade, key)), key) for key in FILE.lists),
        Fact("ending", ending, "not counted in d0", ", ".join(ending) or "none"),
        Fact("base_height_m", facade.base_height_m),
        Fact("elastic_modulus_mpa", facade.elastic_modulus_mpa),
        Fact("t0_s", facade.t0_s),
        Fact("confidence_factor", facade.confidence_factor, "confidence factor FC"),
        Fact("one_sided", facade.one_sided, "one-sided"),
        Fact("demand", given, "demand", ", ".join(given) or "—"),
        Fact("sha256", described.sha256),
    ]
    return Description(
        headline=f"{facade.name}: {facade.kind} {facade.thickness_m:g} x {facade.height_m:g} m",
        facts=facts,
    )
