"""Words of the assessment of one object: facts, tables, caveats and the answer."""

from collections.abc import Sequence
from dataclasses import replace
from typing import TypedDict

import numpy as np

from rocksteady.results.description import Column, Description, Fact, Table
from rocksteady.results.numbers import force_words, number, number_or_none, share_of
from rocksteady.results.result import describes
from rocksteady.results.stated import Stated, facts_stated
from rocksteady.risk.assess.assessment import Assessment
from rocksteady.risk.assess.described.objects import DescribedObject, bounds_of
from rocksteady.risk.assess.judging import Judged
from rocksteady.risk.assess.placed_objects import demand_of
from rocksteady.risk.assess.remedy import Remedy
from rocksteady.risk.assess.sensitivity import Case, bars_of
from rocksteady.risk.counted.motions import across, folds, has_vertical, median_fold
from rocksteady.risk.counted.suite import Demanded, Peaks, Shaking, Suite
from rocksteady.risk.counted.verdict import LEAST, Target
from rocksteady.risk.screens.screen import KINDS
from rocksteady.risk.screens.screens import Screens
from rocksteady.risk.spectra.design_spectrum import DesignSpectrum
from rocksteady.words._object_sentences import Screen, remedy_warning
from rocksteady.words.ensembles import OF_ROCKING, rocking_words
from rocksteady.words.placing import spectrum_remark

CAVEATS = tuple(
    """\
The object is one rigid body that rocks in a plane on a rigid floor: it does not bend, bounce or \
slide while it rocks, and its content does not move.
The outcome of a single record is no prediction: slightly stronger or weaker shaking can turn a \
fall into survival and back. Rely on the share of many records.
An object may fall at one level and survive a higher one. Outcomes are reported as computed; none \
is sorted or smoothed.
Shares belong to these records: another suite, of other durations, gives others. The interval is \
of the records alone, not of doubts about the object.
Vertical motion can change single outcomes and shares: run the records with and without it. In \
runs it has the sign of its file; a peak that is stated counts in the worse direction.
Restitution in tests is often above Housner's value e; by default a band from e to min(0.98, sqrt \
e) is run.
Where friction is near width over height the object slides: rocking alone is then no answer, and \
none is given.
Code formulas stand side by side and are not averaged; each implements the equation that it names, \
and the engineer verifies.
This is no substitute for rules on anchorage.""".splitlines()
)
"""Sentences for the end of every assessment."""


def demand_words(assessment: Assessment) -> str:
    """Return the demand in words."""
    return where_words(assessment.described, assessment.judged.shaking).partition(" ")[2]


def scope_words(assessment: Assessment) -> str:
    """Return which published formulas stand beside the answer, and a kind without any."""
    kind = assessment.described.given.kind
    words = f"Published formulas, {': '.join(assessment.screens.scope)}."
    if assessment.screens.kind is not None or kind == "other":
        return words
    return f"Kind {kind!r} chooses no formulas; {', '.join(KINDS)} do. {words}"


@describes(Assessment)
def describe_assessment(assessment: Assessment) -> Description:
    """Return the sentence, facts, sensitivity, formulas, caveats and inputs."""
    facts = assessment.facts.describe()
    kept = [fact for fact in facts.facts if fact.key != "name"]
    return Description(
        headline=assessment.sentence,
        facts=[*facts_stated(lines_of(assessment)), *_facts(assessment), *kept],
        tables=tables_of(
            assessment.screens,
            assessment.cases,
            assessment.suite,
            assessment.judged.shaking,
            assessment.remedies,
        ),
        notes=[
            *assessment.facts.warnings,
            *_warnings(assessment),
            *CAVEATS,
            scope_words(assessment),
        ],
        sentence=assessment.sentence,
    )


def lines_of(assessment: Assessment) -> list[Stated]:
    """Return the facts below the sentence."""
    screen = screen_of(assessment.described, assessment.judged, assessment.suite)
    lines = list(screen.lines)
    for bar in bars_of(assessment.cases)[:1]:
        if words := bar.words:
            words = f"{bar.parameter}, {bar.ends}: {words}"
            lines.append(Stated(quantity="matters most", text=words))
    if parts := assessment.facts.block.parts:
        words = f"{parts} as one body"
        names = [line.quantity for line in lines]
        if "lifts at" in names:  # where there is room
            place = names.index("lifts at")
            condition = lines[place].condition
            lines[place] = replace(lines[place], condition=f"{condition}; {words}".lstrip("; "))
        else:
            lines.append(Stated(quantity="one body", text=words))
    return lines


def _facts(assessment: Assessment) -> list[Fact]:
    """Return the facts of the answer."""
    judged, target = assessment.judged, assessment.target
    words = rocking_words(assessment.qualification) if assessment.qualification else ""
    moved = ("top moves", words) if words else ("", "")
    force = assessment.base_force_kn
    pushed = ("force on base", f"{force_words(force, 'kN')}, {OF_ROCKING}") if force else ("", "")
    return [
        Fact("name", assessment.described.name, "object"),
        Fact("sentence", assessment.sentence),
        *answer_facts(judged, target, built_in=assessment.suite.built_in),
        Fact("copies", assessment.suite.copies),
        *target_facts(target),
        *demand_facts(
            assessment.judged.shaking, demand_of(assessment.described), demand_words(assessment)
        ),
        Fact("vertical_g", assessment.described.demand.vertical_g),
        Fact("vertical_share", assessment.described.demand.vertical_share),
        Fact("model", assessment.model.name, "model"),
        Fact("qualification", assessment.qualification or None, *moved),
        Fact("base_force_kn", force and list(force), *pushed),
        Fact("seconds", assessment.seconds),
    ]


def _warnings(assessment: Assessment) -> list[str]:
    """Return what limits the runs, and least changes beside others that would do."""
    warnings = [] if assessment.fragility is None else list(assessment.fragility.warnings)
    shaking = assessment.judged.shaking
    if shaking is not None and shaking.stretched and assessment.fragility is not None:
        words = f"The curve is over multiples of the demand: {shaking.demand.kept}."
        warnings.append(words)
    demand = demand_of(assessment.described)
    warnings += [demand.remark] if isinstance(demand, DesignSpectrum) else []
    if shaking is not None and shaking.placing is not None:
        warnings.append(spectrum_remark(shaking.placing))
    warnings += map(remedy_warning, assessment.remedies)
    warnings += [] if assessment.risk is None else assessment.risk.hazard.remarks
    return [*filter(None, dict.fromkeys(warnings))]


def answer_facts(judged: Judged, target: Target, *, built_in: bool) -> list[Fact]:
    """Return what a judgement is in JSON, under the keys that others rely on."""
    decision, shaking = judged.decision, judged.shaking
    counted = decision.verdict in ("green", "red", "not-shown") and not judged.stands
    count = judged.count if counted else None
    stands = judged.stands and decision.verdict != "slides"
    low, high = (0.0, 0.0) if stands else count.band if count else (None, None)
    by, in_years = None, target.years is not None
    if decision.verdict == "slides" or (judged.stands and not in_years):
        by = "statics"
    elif count is not None or decision.verdict in ("green", "red", "not-shown"):
        by = "built-in motions" if built_in else "runs"
    beyond = judged.beyond if judged.beyond is not None and judged.beyond.records >= LEAST else None
    near = judged.near
    conditions = []
    if not judged.friction_known and decision.verdict != "no-answer":
        conditions.append(f"friction at least {number(judged.friction.largest)}")
        if judged.friction_of_rate is not None:
            need = number(judged.friction_of_rate.largest)
            conditions.append(f"friction at least {need} for the rate")
    return [
        Fact("verdict", decision.verdict),
        Fact("reason", decision.reason or None),
        Fact("doubts", list(decision.doubts)),
        Fact("conditions", conditions),
        Fact("by", by),
        Fact("share", 0.0 if stands else count and number_or_none(count.share)),
        Fact("low", low),
        Fact("high", high),
        Fact("share_1_1", beyond and number_or_none(beyond.share)),
        Fact("records", 0 if judged.count is None else judged.count.records),
        Fact("runs", 0 if judged.count is None else judged.count.runs),
        Fact("fall", 0 if judged.count is None else judged.count.falls),
        Fact("without_answer", 0 if judged.count is None else judged.count.without),
        Fact("lifted", judged.lifted),
        Fact("share_near", near.share if near and near.records >= LEAST else None),
        Fact("records_near", near and near.records),
        Fact("median_scale", None if shaking is None else median_fold(shaking.scales)),
        Fact("median_stretch", None if shaking is None else median_fold(shaking.stretches)),
        Fact("largest_stretch", None if shaking is None else float(folds(shaking.stretches).max())),
        Fact("stretched", shaking is not None and shaking.stretched),
        Fact("friction_needed", judged.friction.largest),
        Fact("friction_cause", judged.friction.cause),
        *_rate_facts(judged),
    ]


def _rate_facts(judged: Judged) -> list[Fact]:
    """Return the rate of falling in JSON; None where it is not known."""
    risk, need = judged.risk, judged.friction_of_rate
    known = risk if risk is not None and risk.is_known else None
    low, high = known.band if known and known.band else (None, None)
    return [
        Fact("no_rate", judged.no_rate or None),
        Fact("rate_per_year", known and known.annual_rate),
        Fact("rate_low", low),
        Fact("rate_high", high),
        Fact("rate_outside", risk and risk.outside),
        Fact("rate_unknown", risk and number_or_none(risk.unknown)),
        Fact("probability_50_years", known and known.probability),
        Fact("friction_needed_of_rate", need and need.largest),
    ]


def demand_facts(shaking: Shaking | None, demand: Demanded | None, words: str) -> list[Fact]:
    """Return a demand, None of several, and how motions lie on its spectrum."""
    kind = None if demand is None else "peaks" if isinstance(demand, Peaks) else "spectrum"
    values = demand.values if isinstance(demand, DesignSpectrum) else None
    if shaking is not None and shaking.placing is not None:
        values = shaking.placing.values
    return [
        Fact("demand", {"kind": kind, "words": words}, "demand", words),
        Fact("spectrum", values),
    ]


def target_facts(target: Target) -> list[Fact]:
    """Return a target in JSON and in words."""
    at_demand = target.years is None
    return [
        Fact("target_probability", target.share if at_demand else None, "target", target.words),
        Fact("target_50_years", None if at_demand else target.share),
    ]


def where_words(described: DescribedObject, shaking: Shaking | None) -> str:
    """Return the demand of an object in words after a verb, as far as its motions have it."""
    demand = demand_of(described)
    words = demand.where
    if shaking is not None and not shaking.stretched and demand.kept:
        words = f"{Peaks(pga_g=demand.pga_g).where} with each record's own PGV"
    if described.on_floor:
        words += " of ground motion"
    if vertical := described.demand.vertical_words:
        words += f" with {vertical}"
    return words


def screen_of(described: DescribedObject, judged: Judged, suite: Suite) -> Screen:
    """Return sentence and lines of an object."""
    friction = described.given.friction
    return Screen(
        judged,
        target=described.target,
        friction=None if friction is None else bounds_of(friction)[0],
        where=where_words(described, judged.shaking),
        suite=suite,
        on_floor=described.on_floor,
        of_floor=described.given.demand.place == "floor",
        idle_spectrum=described.spectrum is not None and not described.is_on_spectrum,
    )


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
    cases: Sequence[Case],
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
    bars = [bar._asdict() for bar in bars_of(cases)]
    tables = [
        Table("cases", [case.to_dict() for case in cases]),
        Table("tornado", bars, bar_columns, title="What matters most"),
        Table("remedies", [each.to_dict() for each in remedies], REMEDIES, title="Least changes"),
        Table("screens", rows),
        Table("", words, screen_columns, title="Code formulas, side by side"),
        Table("inputs", inputs_of(suite, shaking)),
    ]
    return [table for table in tables if table.rows]


class Input(TypedDict):
    """A motion as it is, and the factors it was run with."""

    name: str | None
    samples: int
    dt_s: float
    pga_g: float
    pgv_m_s: float
    vertical: bool
    scale: float | None
    stretch: float | None


def inputs_of(suite: Suite, shaking: Shaking | None) -> list[Input]:
    """Return what each motion is, and by what factors it has the peaks of the demand."""
    factors: list[list[float]] = []
    if shaking is not None:
        factors = np.stack([shaking.scales, shaking.stretches], axis=1).tolist()
    every, left = len(factors) == len(suite.motions), iter(factors)
    rows: list[Input] = []
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
