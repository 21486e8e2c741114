"""Words of hazard: of a curve, of the annual rate of failure, and of branches tested."""

import math
from operator import itemgetter
from typing import Final

from rocksteady.results.description import Column, Description, Fact, Table, line
from rocksteady.results.numbers import CONFIDENCE, chance, number, plural, quantity
from rocksteady.results.result import describes
from rocksteady.results.words import facts_of
from rocksteady.risk.hazard.balanced_rocks import HazardBranchCheck
from rocksteady.risk.hazard.failure_risk import Risk
from rocksteady.risk.hazard.hazard_curve import HazardCurve
from rocksteady.risk.hazard.hazard_measures import written
from rocksteady.seismic.measures.scalar import Measure


def _measure_fact(measure: Measure) -> Fact:
    """Return the fact of a measure."""
    return Fact("measure", written(measure), "Measure", str(measure))


@describes(HazardCurve)
def describe_hazard_curve(curve: HazardCurve) -> Description:
    """Return the points of the curve."""
    rows = [
        {"level": level, "annual_rate": rate}
        for level, rate in zip(curve.levels.tolist(), curve.rates.tolist(), strict=True)
    ]
    low, high = rows[0], rows[-1]
    name = f", {curve.name}" if curve.name else ""
    columns = (Column("level", f"{curve.label} [{curve.unit}]"), Column("annual_rate", "1/year"))
    return Description(
        headline=f"Hazard of {curve.label}{name} from {number(low['level'])} to "
        f"{quantity(high['level'], curve.unit)}: {number(low['annual_rate'])} to "
        f"{number(high['annual_rate'])} a year",
        facts=facts_of(curve, _measure_fact(curve.intensity), "name"),
        tables=[Table("points", rows, columns, title=plural(len(rows), "level"))],
        notes=list(curve.remarks),
    )


POISSON: Final = (
    "Failures are a Poisson process: independent, at a constant rate, the object set up again "
    "unchanged."
)


@describes(Risk)
def describe_risk(risk: Risk) -> Description:
    """Return rate, probability, and where the rate comes from."""
    label, unit = risk.hazard.label, risk.hazard.unit
    low, high = risk.band or (None, None)
    facts = facts_of(
        risk,
        _measure_fact(risk.hazard.intensity),
        "years annual_rate",
        Fact("rate_low", low),
        Fact("rate_high", high),
        Fact("return_period_years", 1.0 / risk.annual_rate),
        "probability outside unknown contributing",
        contributing=", ".join(quantity(level, unit) for level in risk.contributing),
    )
    columns = (
        Column("low", f"{label} from"),
        Column("high", f"to [{unit}]"),
        Column("annual_rate", "1/year"),
        Column("share", "share of the rate", chance),
    )
    title, rows = "Where the rate is", risk.rows()
    sentence = f"Falls {rate_words(risk)}."
    return Description(
        headline=sentence,
        facts=[line("half of it", f"below {quantity(risk.contributing[1], unit)}"), *facts],
        tables=[Table("contributions", rows, columns, title, severity=itemgetter("share"))],
        notes=[_reach(risk), POISSON],
        sentence=sentence,
    )


def _reach(risk: Risk) -> str:
    """Return which part of the shaking counts."""
    low, high = (
        float(risk.hazard.levels[0]),
        quantity(float(risk.hazard.levels[-1]), risk.hazard.unit),
    )
    return (
        f"The hazard curve reaches from {number(low)} to {high}: weaker shaking is left out, "
        "stronger shaking counts as that of its last level."
    )


SENTENCES = (
    (
        "A branch is rejected where an object of this fragility would have fallen within its age "
        "with at least that confidence: 1 - exp(-age x rate), averaged over alpha. The age must be "
        "that of the object in its present shape and place."
    ),
    (
        "No bound on PGA follows from one object: it may have stood through strong shaking that "
        "did not suit it. What is tested are whole hazard curves, through the rate of toppling "
        "that each gives."
    ),
    (
        "Posterior weights are prior weights times survival. Branches of one model share faults "
        "and ground-motion models, and one object tests all of them with the same fragility."
    ),
)
"""What is to be known of every test."""


@describes(HazardBranchCheck)
def describe_branch_check(check: HazardBranchCheck) -> Description:
    """Return rate, survival and verdict of each branch."""
    count, percent = int(check.rejected.sum()), f"{number(100.0 * check.level)} %"
    weight = float(check.prior[check.rejected].sum())
    columns = (
        Column("branch", "branch", left=True),
        Column("annual_rate", "topples, 1/year"),
        Column("survival", "survival"),
        Column("confidence", "confidence"),
        Column("rejected", "rejected"),
        Column("prior", "prior"),
        Column("posterior", "posterior"),
    )
    return Description(
        headline=f"An object that stands for {number(check.age_years)} years rejects {count} of "
        f"{plural(len(check.branches), 'branch').replace('branchs', 'branches')} at {percent}",
        facts=facts_of(
            check,
            _measure_fact(check.branches[0].intensity),
            "age_years alpha_cv level",
            Fact("rejected_weight", weight, "Weight of what is rejected"),
            level=percent,
        ),
        tables=[
            Table(
                "branches",
                check.rows(),
                columns,
                severity=lambda row: row["annual_rate"],
                kind=lambda row: "rejected" if row["rejected"] else "not rejected",
            )
        ],
        notes=SENTENCES,
    )


def rate_words(risk: Risk) -> str:
    """Return a rate in words, as "once in 962 years (90 %: 862 to 1,130): 5.1 % in 50 years"."""
    band = ""
    if risk.band is not None:
        longest, shortest = (years_words(end) for end in risk.band)
        band = f" ({100.0 * CONFIDENCE:g} %: {shortest} to {longest})"
    chances = f"{chance(risk.probability)} in {number(risk.years)} years"
    return f"once in {years_words(risk.annual_rate)} years{band}: {chances}"


def years_words(rate: float) -> str:
    """Return the years between events of an annual rate, with three digits."""
    years = float(f"{1.0 / rate:.3g}") if rate > 0.0 else math.inf
    return f"{years:,.0f}" if 10.0 <= years < math.inf else number(years)
