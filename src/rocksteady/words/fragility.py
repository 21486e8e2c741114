"""Words of fragility: counted shares of damage states, and fitted curves."""

import math
from typing import Final

from rocksteady.results.description import Column, Description, Fact, Table
from rocksteady.results.doubts import NOT_IDENTIFIED
from rocksteady.results.numbers import (
    chance,
    interval,
    number,
    number_or_none,
    plural,
    quantity,
    share_of,
)
from rocksteady.results.result import describes
from rocksteady.results.stated import Stated, facts_stated, runs_that, share_words
from rocksteady.results.words import facts_of
from rocksteady.risk.counted.verdict import LEAST
from rocksteady.risk.fits.fragility_curve import FragilityCurve
from rocksteady.risk.fits.maximum import ALWAYS, FITTED, NEVER
from rocksteady.risk.fragility.damage_states import UPLIFT, DamageState
from rocksteady.risk.fragility.fragility import Fragility
from rocksteady.risk.fragility.state_fragility import StateFragility


@describes(FragilityCurve)
def describe_curve(curve: FragilityCurve) -> Description:
    """Return the curve and its stripes."""
    name, unit = curve.measure
    facts = facts_of(
        curve,
        Fact("measure", name, "intensity", f"{name} [{unit}]" if unit else name),
        "status median beta step log_likelihood misfit trials failures sampled",
        median=_intensity(curve, curve.median),
        beta=NOT_IDENTIFIED if math.isnan(curve.beta) else number(curve.beta),
        sampled=f"{number(curve.sampled[0])} to {_intensity(curve, curve.sampled[1])}",
    )
    rows = [
        {"intensity": at, "trials": n, "failures": k, "share": k / n, "probability": share}
        for at, n, k, share in curve.stripes
    ]
    columns = (
        Column("intensity", "intensity", number),
        Column("trials", "trials"),
        Column("failures", "failures"),
        Column("share", "share", number),
        Column("probability", "curve"),
    )
    return Description(
        headline=_headline_of_curve(curve), facts=facts, tables=[Table("stripes", rows, columns)]
    )


def _headline_of_curve(curve: FragilityCurve) -> str:
    """Return the curve, and how far it is from the shares, in a line."""
    name, trials = curve.measure[0], plural(curve.trials, "trial")
    if curve.status == FITTED:
        return (
            f"lognormal in {name}: median {_intensity(curve, curve.median)}, beta "
            f"{number(curve.beta)}, within {number(100.0 * curve.misfit, 2)} points of the shares"
            f" of {trials}"
        )
    if curve.step is not None:
        ends = list(dict.fromkeys(_intensity(curve, end) for end in curve.step))
        place = f"between {' and '.join(ends)}" if len(ends) > 1 else f"at {ends[0]}"
        return f"step in {name} {place}, {trials}"
    low, high = (_intensity(curve, end) for end in curve.sampled)
    if curve.status == NEVER:
        return f"no failure in {trials}: the median is above the highest {name}, {high}"
    if curve.status == ALWAYS:
        return f"no survival in {trials}: the median is below the lowest {name}, {low}"
    return f"no curve: failures do not become more frequent with {name}"


def _intensity(curve: FragilityCurve, value: float) -> str:
    """Return an intensity with its unit."""
    unit = curve.measure[1]
    return quantity(value, unit) if unit and not math.isnan(value) else number(value)


@describes(StateFragility)
def describe_state(fragility: StateFragility) -> Description:
    """Return the counted shares at all levels."""
    unit = "" if fragility.measure is None else fragility.measure.unit
    columns = (
        Column("level", f"level [{unit}]" if unit else "level", number),
        Column("share", "share", chance),
        Column("band", "90 %", left=True),
        Column("reached", "runs"),
        Column("runs", "of"),
    )
    rows = [
        {**row, "band": interval((row["low"], row["high"]), 0.9).partition(": ")[2].rstrip(")")}
        for row in fragility.rows
    ]
    half, summary = fragility.half, fragility.summary_row
    words = f"half at {number(half[0])} {unit}".rstrip() if half else "not half at any level"
    return Description(
        headline=f"{fragility.state.name}: {words}",
        facts=[
            Fact("damage_state", summary.pop("damage_state"), "damage state"),
            Fact("peak", fragility.state.peak),
            *(Fact(key, value) for key, value in summary.items()),
        ],
        tables=[Table("shares", rows, columns)],
    )


MOST_SCALED: Final = 10.0
"""Factor of a record beyond which an answer states the largest."""


@describes(Fragility)
def describe_fragility(fragility: Fragility) -> Description:
    """Return the counted shares of all states, and what summarises them."""
    ensemble, last = fragility.ensemble, fragility.states[-1]
    sentence = _sentence(fragility)
    columns = (
        Column("level", f"level [{fragility.unit}]" if fragility.unit else "level", number),
        Column("runs", "runs"),
        *(Column(each.state.name, verb_of(each.state)) for each in fragility.states),
    )
    facts = [
        Fact("measure", fragility.key, "intensity", str(fragility.measure or "factor")),
        Fact("unit", fragility.unit),
        Fact("model", fragility.model.name, "model"),
        Fact("records", fragility.records, "records"),
        Fact("runs", fragility.runs, "runs"),
        Fact("blocks", int(ensemble.sizes["block"])),
        Fact("levels", last.curve.levels.tolist()),
        Fact("uplift_level", number_or_none(float(last.curve.lifts_at[0]))),
        Fact("restitution", ensemble["restitution"].values.tolist()),
        Fact("scatter", float(ensemble.attrs["scatter"])),
        Fact("directions", [str(each) for each in ensemble["direction"].values]),
        Fact("vertical", [str(each) for each in ensemble["vertical"].values]),
        Fact("friction", fragility.friction),
        Fact("friction_needed", fragility.friction_needed),
        Fact("scale_factor_max", fragility.scale_factor_max, "largest scale factor"),
        Fact("seconds", fragility.seconds),
        Fact("warnings", list(fragility.warnings)),
    ]
    return Description(
        headline=sentence,
        facts=[*facts_stated(_lines(fragility)), *facts],
        tables=[
            Table("shares", [row for each in fragility.states for row in each.rows]),
            Table("fits", [each.summary_row for each in fragility.states]),
            Table("", _shown_rows(fragility), columns, title="Counted shares"),
        ],
        notes=fragility.warnings,
        sentence=sentence,
    )


def _level(fragility: Fragility, value: float) -> str:
    """Return a level in words."""
    label = "" if fragility.measure is None else fragility.measure.label
    return (
        f"{number(value)} {fragility.unit}"
        if fragility.unit
        else f"{label} {number(value)}".strip()
    )


def _sentence(fragility: Fragility) -> str:
    """Return where half of the runs reach the last state, or how many do at most."""
    last = fragility.states[-1]
    verb, half = verb_of(last.state), last.half
    label = "the records" if fragility.measure is None else fragility.measure.label
    if fragility.records < LEAST:
        verb = "gives" if fragility.records == 1 else "give"
        who = plural(fragility.records, "record")
        return f"No answer: {who} {verb} no share, {LEAST} are the least."
    if half is None:
        place = 0 if last.curve.steps[0] > 0.5 else -1
        end, count = ("lowest", "highest")[place], last.curve.counts[place]
        words = share_words(count.falls, count.runs, count.band, count.share)
        at = f"{_level(fragility, float(last.curve.levels[place]))}, the {end} level"
        first, space, beyond = verb.capitalize().partition(" ")
        verbs = f"{first}s{space}{beyond}"
        return f"{runs_that(verbs, count.falls, count.runs)} at {at}: {words}."
    value, low, high = half
    stated = Stated(
        quantity=f"Half {verb} at",
        value=value,
        unit=fragility.unit,
        band=(low, high) if low and high else None,
    )
    of = "" if fragility.measure is None else f" of {label}" if fragility.unit else f" {label}"
    return f"{stated.quantity} {stated.number}{of}{stated.interval}."


def _lines(fragility: Fragility) -> list[Stated]:
    """Return what stands below the sentence."""
    last, few = fragility.states[-1], fragility.records < LEAST
    runs = f"{fragility.runs:,} runs, {plural(fragility.records, 'record')}"
    lines = [
        Stated(
            quantity="lifts at",
            value=float(last.curve.lifts_at[0]),
            unit=fragility.unit,
            evidence="in the record that lifts it first",
        )
        if math.isfinite(last.curve.lifts_at[0])
        else Stated(quantity="lifts at", text="no level: no record lifts it"),
        Stated(
            quantity="counted",
            text=runs,
            condition="" if last.curve.is_monotone else "fewer fall at some higher level",
        ),
        *([] if few else [_summary(fragility, last)]),
    ]
    if fragility.friction_needed is not None:
        given, above = fragility.friction, fragility.slides_above
        where = "" if few or last.half is None else f" where half {verb_of(last.state)}"
        lines.append(
            Stated(
                quantity="friction",
                text=f"needs {number(fragility.friction_needed)}{where}",
                evidence="it is not given" if given is None else f"given {number(given)}",
                condition="" if above is None else f"it slides above {_level(fragility, above)}",
            )
        )
    if fragility.scale_factor_max > MOST_SCALED:
        words = f"records by up to {number(fragility.scale_factor_max)} x: check these"
        lines.append(Stated(quantity="scaled", text=words))
    lines += [
        Stated(quantity=f"half {verb_of(each.state)}", value=each.half[0], unit=fragility.unit)
        for each in fragility.states[-2:-1]
        if each.half is not None and each.state.name != UPLIFT and not few
    ]
    return lines


def _summary(fragility: Fragility, last: StateFragility) -> Stated:
    """Return median and beta, where they summarise the points."""
    best, misfit = last.lognormal, f"{number(100.0 * last.lognormal.misfit, 2)} points"
    if math.isnan(best.beta):
        return Stated(quantity="lognormal", text="none: use the points")
    if not last.is_lognormal:
        words = f"none: the best is {misfit} from the counts; use the points"
        return Stated(quantity="lognormal", text=words)
    return Stated(
        quantity="lognormal",
        text=f"median {number(best.median)} {fragility.unit}".rstrip()
        + f", beta {number(best.beta)}",
        evidence=f"within {misfit} of the counts",
    )


def _shown_rows(fragility: Fragility) -> list[dict[str, object]]:
    """Return a row for each level, with the share of each state."""
    curve = fragility.states[-1].curve
    return [
        {
            "level": level,
            "runs": curve.counts[place].runs,
            **{
                each.state.name: share_of(each.curve.counts[place].share)
                for each in fragility.states
            },
        }
        for place, level in enumerate(curve.levels.tolist())
    ]


def verb_of(state: DamageState) -> str:
    """Return what a block does in a damage state, in a word or two."""
    if state.peak is not None:
        return f"tilt > {state.peak:g} alpha"
    return {"uplift": "lift", "overturned": "fall"}[state.name]
