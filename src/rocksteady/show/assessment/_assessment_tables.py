"""Rows of the tables of an assessment's page, in words."""

import math
from collections.abc import Mapping
from typing import Any

from rocksteady.model.checks.confidence import CONFIDENCE
from rocksteady.results.numbers import (
    angle,
    chance,
    force_words,
    interval,
    length,
    number,
    quantity,
)
from rocksteady.risk.assess.assessment import Assessment
from rocksteady.risk.assess.demand_in_units import PEAKS, unit_of
from rocksteady.risk.ensemble.gates import GIVEN_UPLIFT
from rocksteady.risk.ensemble.qualification import OF_ROCKING, rocking_words
from rocksteady.risk.fits.fragility_curve import FragilityCurve
from rocksteady.risk.fits.two_stages import TwoStageCurve
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
from rocksteady.show.style.wording import NOTHING, greek, key_words, span, state_words

STATUS = {
    "fitted": "fitted",
    "separated": "a step",
    "never": "none",
    "always": "all",
    "not-rising": "no curve",
}
"""Status of a curve in a word."""
PASSES = {True: badge("passes", "green"), False: badge("does not pass", "red"), None: ""}
CONFIRMED = {True: badge("confirmed", "green"), False: badge("not confirmed", "open")}
SYNTHETIC = "synthetic "
"""What the names of made motions begin with."""


def answer_rows(assessment: Assessment) -> list[dict[str, str]]:
    """Return the rows of the first page: object, demand, probability, median, what would help."""
    given = assessment.described.given
    rows = [
        _row("Object", _object_words(assessment)),
        _row("Demand", assessment.demand, assessment.percentile_words),
    ]
    if assessment.probability is not None:
        words = chance(assessment.probability)
        words += interval(assessment.probability_band, CONFIDENCE)
        if assessment.basis == "count" and assessment.by_curve is not None:
            words += f", counted at the demand; {chance(assessment.by_curve)} by the curve"
        target = f"target {number(100.0 * given.assessment.target_probability)} %"
        rows.append(_row("Probability of falling", words, target))
    if assessment.both_peaks_words:
        share, _, note = assessment.both_peaks_words.partition("; ")
        rows.append(_row("By PGA and PGV", share, note))
    rows += [_row("Doubt", text) for text in assessment.doubts]
    if assessment.curve is not None:
        rows.append(_row("Median, half fall at", *_median_words(assessment)))
    peak = "peak floor acceleration" if assessment.described.on_floor else "PGA"
    rows.append(_row("Lifts at", f"{quantity(assessment.facts.uplift_pga_g, 'g')} of {peak}"))
    rows.append(_row("Friction", *_friction_words(assessment)))
    if assessment.qualification and (words := rocking_words(assessment.qualification)):
        rows.append(_row("Top moves", words))
    if assessment.base_force_kn is not None:
        rows.append(
            _row("Force on base", f"{force_words(assessment.base_force_kn, 'kN')}, {OF_ROCKING}")
        )
    rows += [_row("Least remedy", *_remedy_words(assessment))] if assessment.fragility else []
    return rows


def _row(name: str, words: str, note: str = "") -> dict[str, str]:
    return {"name": name, "words": words, "note": note}


def _object_words(assessment: Assessment) -> str:
    """Return kind, slenderness and mass of the object."""
    block, facts = assessment.facts.block, assessment.facts
    kind = assessment.described.given.kind
    words: list[str] = [] if kind == "other" else [kind]
    words.append(f"base {length(block.positive.distance + block.negative.distance)} wide")
    words.append(f"mass centre {length(block.positive.centre_height)} up")
    if facts.mass_kg is not None:
        words.append(quantity(facts.mass_kg, "kg"))
    return ", ".join(words)


def _median_words(assessment: Assessment) -> tuple[str, str]:
    """Return the median in units that a reader knows, and in the measure of the curve."""
    fragility, curve = assessment.fragility, assessment.curve
    assert fragility is not None
    assert curve is not None
    median, band = float(curve.median), curve.median_band
    label = greek(fragility.measure.label)
    unit = f" {fragility.measure.unit}".rstrip()
    if math.isnan(median):
        low, high = curve.sampled
        return f"no level from {span(low, high)}{unit} of {label}", "no median was found"
    words = f"{number(median)}{unit} of {label}"
    if band is not None:
        words += f" ({span(*band)})"
    words += f", {GIVEN_UPLIFT}" * fragility.measure.given_uplift
    low, high = curve.sampled
    beyond = "" if low <= median <= high else f"beyond what was run, {span(low, high)}{unit}"
    at_one = unit_of(assessment)
    if math.isnan(at_one) or at_one == 1.0:
        return words, beyond
    peak = f"{number(at_one * median)} {PEAKS[fragility.measure.name][1]}"
    if band is not None:
        peak += f" ({span(band[0], band[1], at_one)})"
    return peak, f"{words}, {beyond}" if beyond else words


def _friction_words(assessment: Assessment) -> tuple[str, str]:
    """Return the friction that rocking needs, and the given friction."""
    given = assessment.facts.friction
    known = "none given" if given is None else f"{span(*given)} given"
    need = assessment.friction_needed
    if need is None:
        return f"more than {number(assessment.facts.friction_to_lift)} to lift at all", known
    return f"{number(need)} needed to rock without sliding at the demand", known


def _remedy_words(assessment: Assessment) -> tuple[str, str]:
    """Return the remedy of the least change."""
    possible = [each for each in assessment.remedies if each.change is not None]
    if not possible:
        return ("none within reach" if assessment.remedies else "none needed"), ""
    least = min(possible, key=lambda each: each.change or 0.0)
    return least.words, f"then {chance(least.probability)}"


def object_rows(assessment: Assessment) -> list[dict[str, str]]:
    """Return the derived facts of the object."""
    facts = assessment.facts.describe().facts
    rows = [_row(greek(fact.label), greek(fact.words)) for fact in facts if fact.label]
    if assessment.facts.friction is not None:
        rows.append(_row("friction given", span(*assessment.facts.friction)))
    return [row for row in rows if row["name"] != "object"]


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


def synthetic(assessment: Assessment) -> int:
    """Return how many motions are made from random numbers."""
    inputs = assessment.to_dict().get("inputs", [])
    return sum(str(each["name"]).startswith(SYNTHETIC) for each in inputs)


def motion_rows(assessment: Assessment, manifest: Mapping[str, Any]) -> list[Row]:
    """Return a row for each motion, with the factors that its accelerations were run at."""
    factors: list[str] = []
    if assessment.fragility is not None:
        scale = assessment.fragility.ensemble["scale"].isel(block=0).transpose("record", "level")
        factors = [span(float(row.min()), float(row.max())) for row in scale.values]
    inputs: list[dict[str, Any]] = assessment.to_dict().get("inputs", [])
    hashes = [each.get("sha256", "") for each in manifest["records"]]
    known = len(hashes) == len(inputs)
    of_ground = " of the ground" * assessment.described.on_floor
    return [
        {
            "motion": named(
                each["name"], "quarter", quiet("with vertical" if each["vertical"] else None)
            ),
            f"PGA{of_ground} [g]": figure(number(each["pga_g"])),
            f"PGV{of_ground} [m/s]": figure(number(each["pgv_m_s"])),
            "lasts": figure(f"{number(each['samples'] * each['dt_s'])} s"),
            "factors": figure(factors[place] if factors else ""),
            **({"SHA-256": digest(hashes[place][:16])} if known and hashes[place] else {}),
        }
        for place, each in enumerate(inputs)
    ]


def state_rows(fragility: Fragility) -> list[Row]:
    """Return a row for each damage state."""
    return [_state_row(each) for each in fragility.states]


def _state_row(each: StateFragility) -> Row:
    """Return the curve of a damage state: its median, and beta of its lognormal part."""
    curve, plain = each.curve, each.plain
    shape = curve if isinstance(curve, FragilityCurve) else curve.given_uplift
    status = STATUS.get(shape.status, shape.status)
    if shape.step is not None:
        status += f" at {span(*shape.step)}"
    single = None
    if isinstance(curve, TwoStageCurve):
        status += ", given uplift"
        if curve.offset:
            status += f", in {shape.measure[0]}"
        single = (
            f"one curve: median {number(plain.median)}, β {number(plain.beta)}, "
            f"misfit {number(plain.misfit)}"
        )
    given = f", {GIVEN_UPLIFT}" * each.given_uplift
    return {
        "state": state_words(each.state.name) + given,
        "median": _banded(curve.median, curve.median_band),
        "β": _banded(shape.beta, shape.beta_band),
        "curve": status + under(single),
        "runs in it": figure(f"{plain.failures:,} of {plain.trials:,}"),
        "misfit": figure(number(curve.misfit)),
        "p-value": figure(NOTHING if shape.goodness is None else number(shape.goodness)),
    }


def _banded(value: float, band: tuple[float, float] | None) -> str:
    """Return a number with its band."""
    if math.isnan(value):
        return NOTHING
    return number(value) if band is None else f"{number(value)} ({span(*band)})"


def ranking_rows(fragility: Fragility) -> list[Row]:
    """Return a row for each measure, the most efficient first."""
    trials = max(fragility.states[-1].plain.trials, 1)
    return [
        {
            "measure": Cell(
                prose(" and ".join(greek(part.label) for part in each.measure)), "half name"
            ),
            "β": figure(number(each.beta)),
            "ln L a run": figure(f"{each.log_likelihood / trials:.4f}".replace("-", "−")),
            "AIC": figure(f"{each.aic:,.0f}"),
            "curve": STATUS.get(each.status, each.status),
        }
        for each in fragility.ranking
    ]


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


def case_rows(assessment: Assessment) -> list[Row]:
    """Return a row for each change of the sensitivity."""
    return [
        {
            "changed": Cell(key_words(case.parameter), "name"),
            "to": prose(case.change),
            "fitted": figure(chance(case.fitted)),
            "counted": figure(chance(case.counted, case.trials)),
            "runs that fall": figure(f"{case.fell:,} of {case.trials:,}"),
            "median": figure(number(case.median)),
        }
        for case in assessment.cases
    ]


def remedy_rows(assessment: Assessment) -> list[Row]:
    """Return a row for each remedy."""
    return [
        {
            "remedy": each.name,
            "what to do": beside(
                each.words,
                CONFIRMED[each.confirmed] if each.trials and each.change is not None else "",
            ),
            "change": figure(
                NOTHING if each.change is None else f"{number(100.0 * each.change)} %"
            ),
            "probability": figure(chance(each.probability, each.trials or 0)),
            "from": each.basis
            + under(None if each.trials is None else prose(f"{each.fell:,} of {each.trials:,}")),
        }
        for each in assessment.remedies
    ]


def risk_rows(assessment: Assessment) -> list[Row]:
    """Return a row for each hazard curve."""
    rows: list[Row] = []
    for risk in assessment.risks:
        hazard, band = risk.hazard, risk.annual_rate_band
        low, middle, high = (
            f"above {number(float(hazard.levels[-1]))}" if math.isinf(each) else number(each)
            for each in risk.contributing
        )
        measure = under(greek(f"{hazard.label} [{hazard.unit}]"))
        rate = prose(number(risk.annual_rate))
        share = chance(risk.probability) + under(f"in {number(risk.years)} years")
        rows.append(
            {
                "hazard": named(hazard.name or greek(hazard.label), more=measure),
                "falls a year": rate + under(None if band is None else prose(span(*band))),
                "closed form": figure(prose(number(risk.closed_form_rate))),
                "probability": figure(share),
                "HCLPF": figure(number(risk.hclpf)),
                "half of it below (5 to 95 %)": Cell(
                    f"{middle} ({low} to {high})", label="half of it below"
                ),
            }
        )
    return rows
