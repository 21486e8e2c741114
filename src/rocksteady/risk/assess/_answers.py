"""Answers of assessments: of one object on motions, and of many objects under one demand."""

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any

from rocksteady.model.checks.confidence import CONFIDENCE
from rocksteady.results.answer import MOST_ROWS, Answer, left_out
from rocksteady.results.doubts import FEW_RECORDS, misfit_words
from rocksteady.results.numbers import chance, counted, interval, number, plural, quantity
from rocksteady.risk.assess._probability import EXTRAPOLATED
from rocksteady.risk.assess._remedies import Remedy, cheapest
from rocksteady.risk.assess._sensitivity import as_described, bar_words, tornado
from rocksteady.risk.assess.described.objects import parameter_words

FEWEST_ROWS = 5
"""Rows of a table on the first screen, unless more objects are above the target."""
EACH = "the demand of each"
"""Of objects whose demands differ."""
MOST_SCALED = 10.0
"""Factor of a record beyond which an answer states the largest."""


def demand_words(pga_g: float | None, pgv_m_s: float | None) -> str:
    """Return the peaks of a demand, as "0.35 g and 0.4 m/s"."""
    peaks = ((pga_g, "g"), (pgv_m_s, "m/s"))
    return " and ".join(quantity(value, unit) for value, unit in peaks if value is not None)


def answer_of_object(result: Any) -> Answer:
    """Return the number that the verdict follows, its doubts, and what would help.

    Parameters
    ----------
    result
        An `Assessment`, whose module imports this one.
    """
    level = result.level
    given, target = result.described.given, result.described.given.assessment.target_probability
    at = level.words
    if level.measure.name in ("pga_g", "pgv_m_s") and not level.assumed:
        # Runs at a PGA have the PGV of their records; at a PGV the PGA decides on uplift.
        velocity = given.demand.pgv_m_s if level.measure.name == "pgv_m_s" else None
        at = demand_words(given.demand.pga_g, velocity)
    limit = f"the target of {number(100.0 * target)} %"
    verdict = f"{result.colour}, {result.verdict.partition(' ')[0]} {limit}"
    vertical = result.described.demand.vertical_words
    peaks = f"{at} with {vertical}" if vertical else at
    lifts, shaken = quantity(result.facts.uplift_pga_g, "g"), result.described.demand.pga_g
    lifts += " as one body" * bool(result.facts.block.parts)
    if shaken is not None:
        lifts += f", {number(result.facts.uplift_pga_g / shaken, 2)} of the demand"
    lifts += " on its floor" * result.described.on_floor
    need = result.friction_needed
    friction = "" if need is None else f"{number(need)} for {result.friction_cause}"
    if result.basis is None:
        low = result.facts.friction[0] if result.facts.friction else 0.0
        facts = [
            ("verdict", f"{result.colour}: rocking alone is no answer"),
            ("friction needed", f"{friction}; the lowest given is {number(low)}"),
            ("lifts at", lifts),
        ]
        return Answer(f"It slides at {peaks}: no probability of falling by rocking.", facts)
    if result.basis == "statics":
        facts = [("verdict", f"green: {result.verdict}"), ("lifts at", lifts)]
        return Answer(f"It stands at {peaks}: this does not lift it.", facts)
    if result.probability is None:
        facts = [("verdict", f"{result.colour}: {result.verdict}"), ("lifts at", lifts)]
        return Answer(f"No answer yet: no run lifts at {at}.", facts)
    base, curve, fragility = result.cases[0], result.curve, result.fragility
    assert curve is not None
    assert fragility is not None
    value, band = result.probability, interval(result.probability_band, CONFIDENCE)
    runs = plural(base.trials, "run") + " that lift" * level.measure.given_uplift
    share = f" ({chance(base.counted)})" if 0 < base.fell < base.trials else ""
    at_curve = value if result.by_curve is None else result.by_curve
    by_curve = f"{chance(at_curve)} by the curve through all levels"
    count = f"{counted(base.fell, f'{runs} at this demand')}{share}"
    if not base.trials:
        count = "no run lifts at this demand"
    sentence = f"{chance(value)} of such objects fall at {at}{band}."
    if result.basis == "count":
        lead = counted(base.fell, f"its {runs}")
        share = share.replace(" (", ", ").rstrip(")")
        sentence = f"{lead[0].upper()}{lead[1:]} at {at}{share}{band}."
    if result.by_curve is None:
        count = f"by {runs} at this demand; no curve can be fitted"
    elif result.basis == "count":
        count = f"these runs decide; {by_curve}"
    elif result.beyond:
        sentence = f"{sentence[:-1]}, {EXTRAPOLATED}."
        verdict = f"provisional: {verdict}"
    matters = [
        f"{parameter_words(bar['parameter'])}: {bar_words(bar)}{as_described(bar, value)}"
        for bar in tornado(result.cases, result.basis)[:1]
        if bar_words(bar)
    ]
    facts = [
        ("verdict", "; ".join([verdict, *_doubts(result, misfit_words(curve.misfit))])),
        ("counted", count),
        ("least change", _change_words(result.remedies)),
        ("lifts at", f"{lifts}; friction needed {friction}" if friction else lifts),
        ("matters most", "".join(matters)),
    ]
    return Answer(sentence, facts)


def _doubts(result: Any, poor: str) -> list[str]:
    """Return what limits the use of a probability, the most important first."""
    fragility, doubts = result.fragility, []
    assert fragility is not None
    if result.level.assumed:
        doubts.append("no demand is given: it is the median of the motions")
    if poor:
        doubts.append(poor)
    if fragility.records < FEW_RECORDS:
        doubts.append(f"only {plural(fragility.records, 'record')}")
    if fragility.scale_factor_max > MOST_SCALED:
        doubts.append(f"records scaled by more than {MOST_SCALED:g}")
    if result.described.demand.vertical_at_peak_g:
        doubts.append("the runs have the vertical motion of the records, if any")
    if result.level.measure.given_uplift and result.described.given.demand.pga_g is None:
        doubts.append("no PGA is given: it is taken to lift it")
    return doubts


def _change_words(remedies: Sequence[Remedy]) -> str:
    """Return the least change that brings the probability to the target, and the probability."""
    least = cheapest(remedies)
    if least is None or least.value is None:
        return "; ".join(dict.fromkeys(each.words for each in remedies if each.value is None))
    words = f"let it slide on a base with a friction of at most {number(least.value)}"
    if least.name == "width":
        before = least.value / (1.0 + (least.change or 0.0))
        words = f"base from {number(before)} to {number(least.value)} m wide"
    if least.name == "ballast":
        amount = quantity(least.value, "kg")
        if least.unit != "kg":
            amount = f"{number(100.0 * least.value)} % of its mass"
        words = f"{amount} of ballast at its base"
    return f"{words}: {chance(least.probability, least.trials or 0)}"


def answer_of_table(result: Any, rows: Sequence[Mapping[str, Any]]) -> Answer:
    """Return how many objects are above the target, and those of the highest probability.

    Parameters
    ----------
    result
        An `ObjectsTable`, whose module imports this one.
    rows
        Its rows, the worst first.
    """
    colours = Counter(row["colour"] for row in rows)
    most = min(max(FEWEST_ROWS, colours["red"]), MOST_ROWS)
    target = f"the target of {number(100.0 * result.target_probability)} %"
    verb = "is" if 1 in (colours["red"], len(rows)) else "are"
    without = f"; {colours['grey']} without an answer" if colours["grey"] else ""
    sentence = (
        f"{colours['red'] or 'None'} of {plural(len(rows), 'object')} {verb} above {target} at "
        f"{EACH if result.demand is None else demand_words(*result.demand)}{without}."
    )
    left = Counter(row["colour"] for row in rows[most:])
    kinds = ", ".join(f"{count:,} {colour}" for colour, count in left.items())
    few = (
        f"; a curve needs {FEW_RECORDS} or more to be relied on"
        if result.records < FEW_RECORDS
        else ""
    )
    if any(row["pga_g"] is None for row in rows):
        few += "; the PGA is taken to lift each object"
    facts = [
        left_out(sum(left.values()), kinds),
        ("records", f"{result.records:,}{few}"),
    ]
    return Answer(sentence, facts, [(row["name"], _row_words(row)) for row in rows[:most]])


def _row_words(row: Mapping[str, Any]) -> str:
    """Return the number that the colour of an object follows, and what else is known."""
    if row["probability"] is None:
        return f"grey: {row['verdict']}, no probability"
    of = row["tried"] if row["basis"] == "count" else 0
    words = f"{row['colour']}, {chance(row['probability'], of)}"
    if row["basis"] == "statics":
        return f"{row['colour']}: the PGA does not lift it"
    if row["basis"] == "count":
        beside = "no curve can be fitted"
        if row["by_curve"] is not None:
            beside = f"{chance(row['by_curve'])} by curve"
        return (
            f"{words}{interval((row['band_low'], row['band_high']), CONFIDENCE)}, counted; {beside}"
        )
    return f"{words}, {EXTRAPOLATED}" if EXTRAPOLATED in row["method"] else words
