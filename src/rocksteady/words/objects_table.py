"""Words of many objects: a row for each, how many have which verdict, and the worst kinds."""

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Final

from rocksteady.results.description import Column, Description, Fact, Table, left_out, line
from rocksteady.results.numbers import chance, number, plural, share_of
from rocksteady.results.result import describes
from rocksteady.results.stated import share_words
from rocksteady.risk.assess.described.objects import DescribedObject, bounds_of
from rocksteady.risk.assess.described.schema import Value
from rocksteady.risk.assess.judging import Judged
from rocksteady.risk.assess.objects_table import ObjectsTable
from rocksteady.risk.assess.placed_objects import demand_of
from rocksteady.risk.assess.remedy import CHANGES, Remedy
from rocksteady.risk.counted.suite import Peaks, Suite
from rocksteady.risk.counted.verdict import LEAST, VERDICTS, Target, Verdict
from rocksteady.risk.screens.friction import uplift_acceleration_g
from rocksteady.risk.spectra.design_spectrum import DesignSpectrum
from rocksteady.seismic.measures.free_sides import first_side
from rocksteady.words._object_sentences import WORDS, change_words
from rocksteady.words.assessment import CAVEATS, answer_facts, demand_facts, screen_of, target_facts
from rocksteady.words.placing import doubt_on_spectrum, spectrum_line

OPEN: Final[tuple[Verdict, ...]] = ("slides", "not-shown", "no-answer")
"""Verdicts that are neither above nor below a target."""
EACH = "the demand of each object"
MOST_ROWS = 5
"""Kinds of objects on a screen."""


def _where(table: ObjectsTable) -> str:
    """Return the demand in words after a verb, as far as the motions have it."""
    demand = table.demand
    if demand is None:
        return f"at {EACH}"
    shaken = [row["stretched"] for row in table.rows if row["median_scale"] is not None]
    if not demand.kept or all(shaken):
        return demand.where
    return f"{Peaks(pga_g=demand.pga_g).where} with each record's own PGV"


@describes(ObjectsTable)
def describe_table(table: ObjectsTable) -> Description:
    """Return how many objects have which verdict, and a row for each, the worst first."""
    columns = [
        Column("name", "object", left=True),
        Column("share", "falls", share_of),
        Column("low", "from", share_of),
        Column("high", "to (90 %)", share_of),
        Column("share_1_1", "at 1.1 x", share_of),
        *[Column("probability_50_years", "in 50 years", share_of)] * _has_rates(table),
        Column("verdict", "verdict", lambda verdict: WORDS[verdict], left=True),
    ]
    where = _where(table)
    words = verdict_words(table.verdicts)
    facts = [
        Fact("objects", len(table.rows), "objects"),
        Fact("kinds", len(table.kinds), "kinds of object"),
        Fact("records", table.records, "records"),
        Fact("copies", table.suite.copies),
        Fact("built_in", table.suite.built_in),
        Fact("model", table.model.name, "model"),
        Fact("pga_g", table.pga_g),
        Fact("pgv_m_s", table.pgv_m_s),
        *_demand_facts(table),
        *target_facts(table.target),
        Fact("verdicts", table.verdicts, "verdicts", words),
        Fact("seconds", table.seconds),
    ]
    sentence, screen, rows = _answer(table)
    return Description(
        headline=f"{plural(len(table.rows), 'object')} {where}: {words}",
        facts=[*screen, *facts],
        tables=[
            Table(
                "objects",
                table.worst,
                columns,
                kind=lambda row: WORDS[row["verdict"]],
                alarm=WORDS["red"],
            )
        ],
        notes=[*CAVEATS, *_remarks(table)],
        sentence=sentence,
        rows=rows,
    )


def _answer(table: ObjectsTable) -> tuple[str, list[Fact], list[tuple[str, str]]]:
    """Return how many objects are above the target, and the worst kinds."""
    kinds, red = table.kinds, table.verdicts.get("red", 0)
    placing = None if table.shaking is None else table.shaking.placing
    several = len(kinds) < len(table.rows)
    objects = plural(len(table.rows), "object")
    place = "" if table.target.years else f" {_where(table)}"
    at = f"{place}{' on built-in motions' * table.suite.built_in}"
    target = f"the target of {table.target.words}"
    count = sum(row["verdict"] == "red" for row, _ in kinds) if several else red
    subject = f"{red} of {objects}"
    if several:
        subject = f"{count} of {plural(len(kinds), 'kind')} ({subject})"
    neither = {key: table.verdicts[key] for key in OPEN if key in table.verdicts}
    others = f"; {verdict_words(neither)}" if neither else ""
    sentence = f"{subject} {'are' if count > 1 else 'is'} above {target}{at}{others}."
    if not red:
        sentence = f"{verdict_words(table.verdicts)} of {objects}{at}, for {target}."
    rest = kinds[MOST_ROWS:]
    left = verdict_words(Counter(row["verdict"] for row, _ in rest))
    needs = [row["friction_needed"] for row in table.rows if row["friction"] is None]
    facts = [
        left_out(len(rest), left),
        line(
            "spectrum",
            "" if placing is None else spectrum_line(placing, doubt_on_spectrum(placing)).words,
        ),
        line("records", f"{table.records:,}" if not table.suite.built_in else ""),
        line(
            "friction",
            f"must be at least {number(max(needs))} where it is not given" if needs else "",
        ),
    ]
    return sentence, facts, _kind_rows(table)


def _remarks(table: ObjectsTable) -> list[str]:
    """Return what formulas of spectra leave to the engineer."""
    spectra = [each for each in table.demands.values() if isinstance(each, DesignSpectrum)]
    return [*filter(None, dict.fromkeys(each.remark for each in spectra))]


def _demand_facts(table: ObjectsTable) -> list[Fact]:
    """Return the demand in JSON and in words, with the motions of the first object on it."""
    return demand_facts(table.shaking, table.demand, _where(table).partition(" ")[2])


def _has_rates(table: ObjectsTable) -> bool:
    """Return whether a rate is known of an object."""
    return any(row["rate_per_year"] is not None for row in table.rows)


def verdict_words(counts: Mapping[Verdict, int]) -> str:
    """Return numbers of verdicts in words, as "2 red, 1 not shown"."""
    return ", ".join(
        f"{counts[verdict]:,} {WORDS[verdict]}" for verdict in VERDICTS if verdict in counts
    )


def _kind_rows(table: ObjectsTable) -> list[tuple[str, str]]:
    """Return name, verdict and share of each of the worst kinds."""
    rows, in_years = [], table.target.years is not None
    for row, count in table.kinds[:MOST_ROWS]:
        words, rate = WORDS[row["verdict"]], row["probability_50_years"]
        if in_years and rate is not None:
            words += f", {chance(rate)} in 50 years"
        elif in_years and row["no_rate"]:
            words += f", no rate: {row['no_rate']}"
        elif row["by"] == "statics" and row["verdict"] != "slides":
            words += ", by statics"
        elif row["share"] is not None:
            band = (row["low"], row["high"])
            words += f", {share_words(row['fall'], row['runs'], band, row['share'])}"
        elif row["verdict"] == "no-answer":
            words += f", {row['records']} of {LEAST} records"
        if rate is not None and not in_years:
            words += f"; {chance(rate)} in 50 years"
        rows.append((row["name"], f"{words}; {count:,} alike" if count > 1 else words))
    return rows


def row_of(described: DescribedObject, judged: Judged, suite: Suite) -> dict[str, object]:
    """Return the row of an object."""
    block, demand, given = described.block, described.demand, described.given
    asked = demand_of(described)
    side = first_side(block)
    uplift = uplift_acceleration_g(block, demand.vertical_at_peak_g)
    sentence = screen_of(described, judged, suite).sentence
    answer = answer_facts(judged, described.target, built_in=suite.built_in)
    return {
        "name": described.name,
        "kind": given.kind,
        "building": given.building,
        "floor": given.floor,
        "storey": described.storey,
        "place": given.demand.place,
        "pga_g": described.pga_g,
        "pgv_m_s": given.demand.pgv_m_s,
        "spectrum": asked.words_of_source if isinstance(asked, DesignSpectrum) else None,
        "floor_pga_g": demand.pga_g if described.on_floor else None,
        **{fact.key: fact.value for fact in answer if fact.key not in ("doubts", "conditions")},
        "alpha_rad": side.alpha,
        "p_rad_s": side.p,
        "uplift_pga_g": uplift,
        "friction": _friction(given.friction),
        "vertical_g": demand.vertical_g,
        "vertical_share": demand.vertical_share,
        **_least(judged.remedies, described.target),
        "sentence": f"{described.label}: {sentence[0].lower()}{sentence[1:]}",
    }


def _least(remedies: Sequence[Remedy], target: Target) -> dict[str, object]:
    """Return the least changes of a row, in metres and in words; None where there is none."""
    row: dict[str, object] = {}
    for change in CHANGES:
        remedy = next((each for each in remedies if each.change == change), None)
        key = change.replace(" ", "_")
        row |= {f"{key}_m": remedy and remedy.value, f"{key}_shown_m": remedy and remedy.shown_at}
    helped = next((each for each in remedies if each.values), None)
    return row | {"least_change": helped and change_words(helped, target)}


def _friction(given: Value | None) -> str | None:
    """Return a friction as a table of objects takes it, as "0.3:0.5"; None of none."""
    if given is None:
        return None
    return ":".join(dict.fromkeys(f"{end:g}" for end in bounds_of(given)))
