"""Rates of objects: against a sum, twins over velocities, verdicts in 50 years, refusals."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from rocksteady import assess_object, assess_objects, compute_risk
from rocksteady.errors import InputError
from rocksteady.motions import make_synthetic_suite
from rocksteady.risk import DescribedObject, HazardCurve, Target
from tests.every import every
from tests.risk.counted.recorded import SITE, described

SUITE = make_synthetic_suite(28)
YEARS = Target(0.02, years=50.0)
PGA, PGV = 0.4, 0.45
VELOCITIES = replace(SITE, measure="pgv_m_s", levels=SITE.levels * PGV / PGA)
EARLY = replace(SITE, levels=SITE.levels[:7], rates=SITE.rates[:7])


def statue(width: float = 0.45, **keys: Any) -> DescribedObject:
    usual = {"pga_g": PGA, "pgv_m_s": PGV, "assessment": {"draws": 1}}
    return described(width, 1.8, **{**usual, **keys})


def test_the_rate_of_an_object_is_the_sum_of_its_shares_and_the_hazard() -> None:
    """As of `compute_risk`, and by a sum of many small steps."""
    assessment = assess_object(statue(), SUITE, hazard=SITE)
    risk, fragility, values = assessment.risk, assessment.fragility, assessment.to_dict()
    assert risk is not None
    assert fragility is not None
    again = compute_risk(fragility, SITE)
    assert (risk.annual_rate, risk.band) == (again.annual_rate, again.band)
    ends = np.geomspace(SITE.levels[0], SITE.levels[-1], 200_000)
    shares, rates = fragility.state("overturned").share(ends), SITE.rate(ends)
    total = -(0.5 * (shares[1:] + shares[:-1]) * np.diff(rates)).sum() + shares[-1] * rates[-1]
    assert risk.annual_rate == pytest.approx(total, rel=2e-3)
    assert (values["rate_per_year"], values["rate_low"], values["rate_high"]) == (
        risk.annual_rate, *(risk.band or ()),
    )  # fmt: skip
    assert values["probability_50_years"] == pytest.approx(1.0 - math.exp(-50.0 * risk.annual_rate))
    assert values["rate_outside"] == risk.outside < 0.1
    (row,) = assess_objects([statue()], SUITE, hazard=SITE).rows
    for key in ("rate_per_year", "rate_low", "rate_high", "rate_outside", "probability_50_years",
                "friction_needed_of_rate", "verdict", "share"):  # fmt: skip
        assert row[key] == values[key], key


def test_with_both_peaks_a_hazard_curve_over_velocities_is_one_over_accelerations() -> None:
    rates = [
        assess_objects([statue()], SUITE, hazard=each, target=YEARS).rows[0]["rate_per_year"]
        for each in (SITE, VELOCITIES)
    ]
    assert rates[0] == pytest.approx(rates[1], rel=1e-12)
    (row,) = assess_objects([statue(pga_g=None)], SUITE, hazard=VELOCITIES, target=YEARS).rows
    assert row["rate_per_year"] > 0.0


def test_a_target_in_50_years_is_judged_by_the_interval_of_the_rate() -> None:
    """Over widths and frictions each row has the verdict of the definition."""
    cases = [(width, mu) for width in (0.25, 0.45, 0.6, 1.0) for mu in (3.0, None, 0.57, 0.3)]
    ranges = {mu: mu and {"low": mu, "high": 3.0} for _, mu in cases}  # the low end counts
    objects = [statue(width, friction=ranges[mu]) for width, mu in cases]
    seen = set()
    for row, (_, mu) in zip(
        assess_objects(objects, SUITE, hazard=SITE, target=YEARS).rows, cases, strict=True
    ):
        verdict, reason = row["verdict"], row["reason"]
        seen.add(reason or verdict)
        if verdict == "slides":
            assert mu is not None
            continue
        assert (reason == "rate-unknown") == (row["rate_per_year"] is None)
        if row["rate_per_year"] is None:
            continue
        low, high = (-math.expm1(-50.0 * row[key]) for key in ("rate_low", "rate_high"))
        known = mu is not None and mu >= row["friction_needed_of_rate"]
        assert (verdict == "green") == (high < YEARS.share and known and reason != "stretched")
        assert (verdict == "red") == (low > YEARS.share and reason != "stretched")
    assert seen >= {"green", "red", "slides", "friction", "rate-unknown"}


def test_built_in_motions_are_never_green_in_50_years_either() -> None:
    (row,) = assess_objects([statue(0.7)], hazard=SITE, target=YEARS).rows
    assert (row["verdict"], row["reason"]) == ("not-shown", "built-in")
    assert row["probability_50_years"] < YEARS.share


def test_the_less_friction_the_more_of_a_rate_is_without_runs() -> None:
    """A level at which it slides is none that was run; none is where it slides first."""
    frictions = (3.0, 0.5, 0.45, 0.4)
    objects = [statue(friction={"low": mu, "high": 3.0}) for mu in frictions]
    rows = assess_objects(objects, SUITE, hazard=SITE, target=0.999).rows
    outside = [row["rate_outside"] for row in rows]
    assert outside == sorted({*outside})
    assert outside[0] == 0.0
    assert outside[-1] > 0.1
    for row, mu, part in zip(rows, frictions, outside, strict=True):
        assert (row["rate_per_year"] is None) == (part > 0.1)
        assert (part > 0.05) == (mu < row["friction_needed_of_rate"])  # that of 95 % of the rate
    first = statue(1.0, friction=0.5)  # stands at the demand, and slides at 0.5 g, before 0.556 g
    for target, verdict in ((YEARS, "slides"), (0.1, "stands")):
        (row,) = assess_objects([first], SUITE, hazard=SITE, target=target).rows
        assert (row["verdict"], row["rate_per_year"]) == (verdict, None)


@every(
    ("records", "verdict", "reason", "rate", "band"),
    [
        (10, "no-answer", "few-records", False, False),
        (11, "not-shown", "rate-records", True, False),
        (27, "not-shown", "rate-records", True, False),
        (28, "red", None, True, True),
    ],
)
def test_a_rate_takes_11_records_and_its_interval_28(
    records: int, verdict: str, reason: str | None, rate: bool, band: bool
) -> None:
    (row,) = assess_objects([statue(0.3)], SUITE[:records], hazard=SITE, target=YEARS).rows
    assert (row["verdict"], row["reason"]) == (verdict, reason)
    assert (row["rate_per_year"] is not None, row["rate_low"] is not None) == (rate, band)


def test_a_hazard_curve_that_ends_early_gives_no_rate() -> None:
    """Of shaking above its end nothing is known; the verdict at the demand stays."""
    (in_years,) = assess_objects([statue()], SUITE, hazard=EARLY, target=YEARS).rows
    assert (in_years["verdict"], in_years["reason"]) == ("not-shown", "rate-unknown")
    with_curve = assess_object(statue(), SUITE, hazard=EARLY)
    assert with_curve.verdict == assess_object(statue(), SUITE).verdict
    for values in (in_years, with_curve.to_dict()):
        assert (values["rate_per_year"], values["rate_low"]) == (None, None)
        assert values["probability_50_years"] is None
    assert "the hazard curve ends at 0.3 g" in " ".join(with_curve.summary().split())


@every(
    ("keys", "hazard", "stretch", "words"),
    [
        (
            {"pgv_m_s": None},
            VELOCITIES,
            True,
            "hazard is over pgv_m_s: the demand of object is 0.4",
        ),
        ({"pga_g": None}, SITE, True, "hazard is over pga_g: the demand of object is 0.45 m/s"),
        ({}, VELOCITIES, False, "give a hazard curve over pga_g"),
        ({}, replace(SITE, measure="sa_g:1.0"), True, "hazard is over sa_g:1.0"),
        ({"demand": {"place": "floor"}}, SITE, True, "hazard is that of the ground"),
        (
            {"assessment": {"target_50_years": 0.01}, "target": None},
            None,
            True,
            "hazard is missing",
        ),
    ],
)
def test_what_gives_no_rate_is_refused_in_one_line(
    keys: dict[str, Any], hazard: HazardCurve | None, stretch: bool, words: str
) -> None:
    each = statue(**keys)
    for ask in (
        lambda: assess_object(each, SUITE, hazard=hazard, stretch=stretch),
        lambda: assess_objects([each], SUITE, hazard=hazard, stretch=stretch, target=each.target),
    ):
        with pytest.raises(InputError) as error:
            ask()
        assert words in str(error.value)
        assert "\n" not in str(error.value)
