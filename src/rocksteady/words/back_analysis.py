"""Words of surveys and of back-analyses: which shakings agree with what fell."""

import numpy as np

from rocksteady.results.description import Column, Description, Fact, Table, doubt, line
from rocksteady.results.numbers import chance, number, plural, quantity
from rocksteady.results.result import describes
from rocksteady.results.words import facts_of
from rocksteady.risk.back_analysis.back_analysis import BackAnalysis
from rocksteady.risk.back_analysis.survey import Survey


@describes(Survey)
def describe_survey(survey: Survey) -> Description:
    """Return how many objects fell, and a row for each."""
    assert survey.reversed is not None
    rows = [
        {
            "object": each.name,
            "outcome": "fell" if fell else "stood",
            "outline_alpha_rad": each.outline_alpha_rad,
            "reversed": facing,
        }
        for each, fell, facing in zip(survey.objects, survey.fell, survey.reversed, strict=True)
    ]
    columns = [
        Column("object", "object", left=True),
        Column("outcome", "outcome", left=True),
        Column("outline_alpha_rad", "alpha by sizes, rad", number),
    ]
    count = sum(survey.fell)
    return Description(
        headline=f"{plural(len(survey), 'object')}: {count} fell, {len(survey) - count} stood",
        facts=[
            Fact("objects", len(survey), "objects"),
            Fact("fell", count, "fell"),
            Fact("sources", dict(survey.sources)),
        ],
        tables=[Table("rows", rows, columns, kind=lambda row: str(row["outcome"]))],
    )


CAVEATS = (
    (
        "One object that stands bounds no PGA from above: at 0.6 g 66 % of 59 records leave an "
        "object standing that a static formula topples at 0.42 g. Many objects, the records of the "
        "suite and the limits of the scales make the upper end here."
    ),
    (
        "The region is of shakings like those of the suite, each record as likely as the others "
        "before the survey. The temper and the probability of the region are chosen so that "
        "records that are left out are covered: that is no Bayesian posterior."
    ),
    "Rigid objects in one plane, without slip and bounce, all on the same ground.",
)
"""What is to be known of every back-analysis."""


@describes(BackAnalysis)
def describe_analysis(analysis: BackAnalysis) -> Description:
    """Return the interval of each measure, and the weight of each record."""
    fell, first = sum(analysis.survey.fell), analysis.measures[0]
    low, high = map(number, analysis.limits)
    columns = (
        Column("label", "measure", left=True),
        Column("median", "median", _or_open),
        Column("low", "low", _or_open),
        Column("high", "high", _or_open),
        Column("mc_error", "error of ln", _or_open),
    )
    record_columns = (
        Column("record", "record", left=True),
        Column("weight", "weight"),
        Column("scale", "best scale"),
        *(Column(measure.key, str(measure)) for measure in analysis.measures),
    )
    coverage = (
        "not checked by records that are left out"
        if analysis.held_out_surveys == 0
        else f"{number(analysis.confidence)} of {analysis.held_out_surveys} simulated surveys "
        f"under records that are left out, at a posterior probability of {number(analysis.share)}"
    )
    sentence, screen = _answer(analysis, coverage)
    return Description(
        headline=f"{fell} of {plural(len(analysis.survey), 'object')} fell: " + _sentence(analysis),
        facts=[
            *screen,
            *facts_of(
                analysis,
                Fact("objects", len(analysis.survey), "Objects"),
                Fact("fell", fell, "Fell"),
                Fact("records", len(analysis.records), "Records"),
                "bound confidence share plain_coverage held_out_surveys temper",
                Fact(
                    "temper_scores",
                    {f"{key:g}": each for key, each in analysis.temper_scores.items()},
                ),
                "effective_records limits draws runs",
                Fact("model", analysis.model.name, "Equations of motion"),
                Fact("sources", dict(analysis.survey.sources)),
                "warnings",
                held_out_surveys=coverage,
                limits=f"{low} to {high} {first.unit}".strip() + f" of {first.label}",
            ),
        ],
        tables=[
            Table("measures", analysis.rows(), columns),
            Table("record_weights", analysis.record_rows(), record_columns),
        ],
        notes=[*analysis.warnings, *CAVEATS],
        sentence=sentence,
    )


def _answer(analysis: BackAnalysis, coverage: str) -> tuple[str, list[Fact]]:
    """Return the intervals of the first two measures, their middles, and doubts."""
    fell, level = sum(analysis.survey.fell), chance(analysis.confidence)
    medians = [
        quantity(float(median), measure.unit).rstrip()
        for measure, median in zip(analysis.measures[:2], analysis.medians, strict=False)
        if not np.isnan(median)
    ]
    best = analysis.record_rows()[0]
    if analysis.held_out_surveys:
        coverage = f"{level} of {analysis.held_out_surveys} simulated surveys"
    facts = [
        line("doubt", doubt(analysis.warnings)),
        line("median", " and ".join(medians)),
        line("coverage", coverage if analysis.bound == "interval" else ""),
        line(
            "records", f"{len(analysis.records)}, of {number(analysis.effective_records)} effective"
        ),
        line("best record", f"{best['record']}, scaled by {number(best['scale'])}"),
    ]
    sentence = f"{fell or 'None'} of {len(analysis.survey)} fell: {_sentence(analysis)} ({level})."
    return sentence, facts


def _sentence(analysis: BackAnalysis) -> str:
    """Return the interval of the first two measures in words."""
    parts = []
    for measure, low, high in zip(
        analysis.measures[:2], analysis.lows, analysis.highs, strict=False
    ):
        words, end = f"{number(low)} to ", high
        if analysis.bound != "interval":
            lower = analysis.bound == "lower bound"
            words, end = ("at least ", low) if lower else ("likely below ", high)
        bound = words + quantity(end, measure.unit).rstrip()
        parts.append(f"{measure.label} {'without a bound' if np.isnan(end) else bound}")
    return ", ".join(parts)


def _or_open(value: float | None) -> str:
    """Return a number in words; an open end is a dash."""
    return "-" if value is None else number(value)
