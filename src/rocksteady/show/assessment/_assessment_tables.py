"""Rows of the tables of an assessment's page, in words."""

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any, Final

from rocksteady.results.numbers import angle, chance, length, number, quantity, share_of
from rocksteady.results.stated import band_words
from rocksteady.risk.assess.assessment import Assessment
from rocksteady.risk.assess.described.objects import key_words
from rocksteady.risk.counted.verdict import MARGIN
from rocksteady.risk.fragility.fragility import Fragility
from rocksteady.risk.fragility.state_fragility import StateFragility
from rocksteady.risk.screens.friction import least_gravity_g
from rocksteady.show.report import prose
from rocksteady.show.style.markup import (
    Cell,
    Row,
    badge,
    beside,
    digest,
    figure,
    named,
    quiet,
    under,
)
from rocksteady.show.style.wording import (
    BADGES,
    NOTHING,
    greek,
    sentence,
    span,
    state_words,
)
from rocksteady.words.assessment import inputs_of, lines_of

PASSES = {True: badge("passes", "plain"), False: badge("does not pass", "plain"), None: ""}
"""Verdicts of formulas; the colours are those of the answer."""
FURTHER: Final = ("qualification", "base_force_kn")
"""Keys of what the runs at the demand give beside their share."""


def verdict_words(assessment: Assessment) -> str:
    """Return what the verdict rests on; empty of no answer, whose sentence says it."""
    for line in lines_of(assessment):
        if line.quantity == "verdict":
            word = BADGES[assessment.decision.verdict][0]
            return sentence(greek(line.words.removeprefix(f"{word}: ")))
    return ""


def answer_rows(assessment: Assessment) -> list[dict[str, str]]:
    """Return the lines of the screen, that of the verdict excepted."""
    return [
        _row(line.quantity, replace(line, condition="").words, line.condition)
        for line in lines_of(assessment)
        if line.quantity != "verdict" and line.words
    ]


def further_rows(assessment: Assessment) -> list[dict[str, str]]:
    """Return what else the runs at the demand give: motion of the top, and forces."""
    facts = assessment.describe().facts
    return [_row(fact.label, fact.words) for fact in facts if fact.key in FURTHER and fact.label]


def _row(name: str, words: str, note: str = "") -> dict[str, str]:
    """Return a row of a table of names and words."""
    return {"name": greek(name[:1].upper() + name[1:]), "words": greek(words), "note": greek(note)}


def share_rows(assessment: Assessment) -> list[Row]:
    """Return a row for each level, with the counted share of each damage state."""
    fragility, shaking = assessment.fragility, assessment.judged.shaking
    assert fragility is not None
    assert shaking is not None
    last, (label, unit) = fragility.states[-1], level_words(assessment)
    marks = {shaking.level: "this demand", MARGIN * shaking.level: f"{MARGIN:g} x this demand"}
    several = len({row["runs"] for row in last.rows}) > 1
    rows: list[Row] = []
    for place, level in enumerate(last.curve.levels.tolist()):
        mark = next((words for at, words in marks.items() if math.isclose(at, level)), None)
        row: Row = {label: quantity(level, unit).rstrip() + quiet(mark)}
        for each in fragility.states:
            count = each.curve.counts[place]
            share = share_cell(count.share, count.falls, count.runs)
            row[state_words(each.state.name)] = figure(share)
        count = last.curve.counts[place]
        row["90 %"] = figure(prose(ends(count.band)))
        if several:
            row["runs"] = figure(f"{count.runs:,}")
        rows.append(row)
    return rows


def level_words(assessment: Assessment) -> tuple[str, str]:
    """Return label and unit of the levels of the shaking."""
    fragility = assessment.fragility
    assert fragility is not None
    if fragility.measure is None:
        return "factor", ""
    of_ground = " of the ground" * assessment.described.on_floor
    return greek(fragility.measure.label) + of_ground, fragility.measure.unit


def share_cell(share: float, reached: int, runs: int) -> str:
    r"""Return a counted share; of none or of all runs a word.

    Examples
    --------
    >>> share_cell(0.0, 0, 280), share_cell(0.111, 31, 280), share_cell(1.0, 280, 280)
    ('none', '11\xa0%', 'all')
    """
    if reached in (0, runs):
        return "all" if reached else "none"
    return prose(chance(share))


def ends(band: tuple[float, float]) -> str:
    """Return both ends of an interval of a share.

    Examples
    --------
    >>> ends((0.0, 0.052))
    '0 to 5.2 %'
    """
    return band_words(band).partition(": ")[2].removesuffix(")")


def summary_rows(fragility: Fragility) -> list[Row]:
    """Return a row for each damage state: where half reach it, and the nearest lognormal."""
    unit = "" if fragility.measure is None else fragility.measure.unit
    return [_summary_row(each, unit) for each in fragility.states]


def _summary_row(state: StateFragility, unit: str) -> Row:
    """Return what summarises the counted shares of a damage state."""
    half, best = NOTHING, state.lognormal
    if state.half is not None:
        level, low, high = state.half
        half = quantity(level, unit).rstrip()
        if low and high:
            half += f" ({span(low, high)})"
    words, misfit = "none: use the points", NOTHING
    if best.status == "separated":
        words = "none: a step"
    elif not math.isnan(best.beta):
        misfit = f"{number(100.0 * best.misfit, 2)} points"
        if state.is_lognormal:
            words = f"median {quantity(best.median, unit).rstrip()}, β {number(best.beta)}"
    return {
        "state": state_words(state.state.name),
        "half reach it at": figure(half),
        "lognormal": words,
        "distance from the shares": figure(misfit),
    }


def object_rows(assessment: Assessment) -> list[dict[str, str]]:
    """Return the derived facts of the object."""
    facts = assessment.facts.describe().facts
    on_floor = " of floor acceleration" * assessment.described.on_floor
    rows = [
        _row(fact.label, fact.words + on_floor * (fact.key == "uplift_pga_g"))
        for fact in facts
        if fact.label and fact.key != "name"
    ]
    if assessment.facts.friction is not None:
        rows.append(_row("friction given", span(*assessment.facts.friction)))
    return rows


def side_rows(assessment: Assessment) -> list[Row]:
    """Return a row for each edge; none of an object whose sides are alike."""
    facts = assessment.facts
    block = facts.block
    if block.symmetric or block.one_sided:
        return []
    gravity_g = least_gravity_g(block, facts.demand.vertical_at_peak_g)
    return [
        {
            "pivot": name,
            "α": figure(angle(side.alpha)),
            "p [rad/s]": figure(number(side.p)),
            "R": figure(length(side.radius)),
            "restitution": figure(number(side.restitution)),
            "lifts at": figure(f"{number(gravity_g * math.tan(side.alpha))} g"),
        }
        for name, side in (("left edge", block.positive), ("right edge", block.negative))
    ]


def motion_rows(assessment: Assessment, manifest: Mapping[str, Any]) -> list[Row]:
    """Return a row for each motion: its peaks as it is, and the factors that it was run with."""
    shaking = assessment.judged.shaking
    inputs = inputs_of(assessment.suite, shaking)
    hashes = [each.get("sha256", "") for each in manifest["records"]]
    known = len(hashes) == len(inputs)
    stretched = shaking is not None and shaking.stretched
    return [
        {
            "motion": named(
                each["name"] or "", "quarter", quiet("with vertical" if each["vertical"] else None)
            ),
            "PGA [g]": figure(number(each["pga_g"])),
            "PGV [m/s]": figure(number(each["pgv_m_s"])),
            "lasts": figure(f"{number(each['samples'] * each['dt_s'])} s"),
            "scale": figure(_factor(each["scale"])),
            **({"stretch": figure(_factor(each["stretch"]))} if stretched else {}),
            **({"SHA-256": digest(hashes[place][:16])} if known and hashes[place] else {}),
        }
        for place, each in enumerate(inputs)
    ]


def _factor(value: float | None) -> str:
    """Return a factor; a dash of a motion that was not run."""
    return NOTHING if value is None else number(value)


def screen_rows(assessment: Assessment) -> list[Row]:
    """Return a row for each published formula."""
    return [
        {
            "formula": Cell(greek(row.name), "name"),
            "value": Cell(row.words, "value"),
            "verdict": beside(PASSES[row.passes], prose(greek(row.verdict)))
            + under(prose(greek(row.remark)) or None),
            "equation, edition": greek(row.equation) + under(row.edition),
            "status": row.status,
        }
        for row in assessment.screens.rows
    ]


def remedy_rows(assessment: Assessment) -> list[Row]:
    """Return a row for each kind of change that is a remedy."""
    return [
        {
            "changed": Cell(remedy.change, "name"),
            "to": figure(_length(remedy.value, f"none up to {length(remedy.last)}")),
            "falls": figure(prose(share_of(remedy.share))),
            f"at {MARGIN:g} x": figure(prose(share_of(remedy.share_1_1))),
            "sure from": figure(_length(remedy.shown_at, NOTHING)),
            "friction needed": figure(
                NOTHING if remedy.friction_needed is None else number(remedy.friction_needed)
            ),
        }
        for remedy in assessment.remedies
    ]


def _length(metres: float | None, other: str) -> str:
    """Return a length, or what stands in its place where there is none."""
    return other if metres is None else length(metres)


def case_rows(assessment: Assessment) -> list[Row]:
    """Return a row for each change of the sensitivity."""
    return [
        {
            "changed": Cell(key_words(case.parameter), "name"),
            "to": prose(case.change) or None,
            "falls": figure(share_cell(case.share, case.fall, case.runs)),
            "90 %": figure(prose(ends((case.low, case.high)))),
            "runs that fall": figure(prose(f"{case.fall:,} of {case.runs:,}")),
        }
        for case in assessment.cases
    ]
