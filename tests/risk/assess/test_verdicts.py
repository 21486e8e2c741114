"""Verdicts and colours at the target itself, and the sentences of each kind of answer."""

import math
from typing import Any

from rocksteady.risk.assess._demand_level import DemandLevel
from rocksteady.risk.assess._probability import NO_ANSWER, Onset, Probability
from rocksteady.risk.assess._remedies import Remedy
from rocksteady.risk.assess._sensitivity import Case
from rocksteady.risk.assess._verdicts import (
    Answer,
    Findings,
    answer_of,
    colour_of,
    verdict_of,
    with_article,
)
from rocksteady.risk.assess.described.facts import compute_object_facts
from rocksteady.risk.assess.described.objects import DescribedObject
from rocksteady.risk.screens.friction import FrictionNeed
from rocksteady.seismic.measures.scalar import Measure

LEVEL = DemandLevel(measure=Measure("pgv_m_s"), value=0.4, words="PGV of 0.4 m/s")
OBJECT = DescribedObject(
    values={
        "name": "vase",
        "friction": {"low": 0.3, "high": 0.6},
        "geometry": {"width_m": 0.36, "height_m": 1.8},
        "demand": {"pga_g": 0.5, "pgv_m_s": 0.4},
    }
)


def case(parameter: str, counted: float, **keys: Any) -> Case:
    values: dict[str, Any] = {
        "parameter": parameter,
        "change": "",
        "fitted": counted,
        "counted": counted,
        "basis": "count",
        "fell": 0 if math.isnan(counted) else round(20 * counted),
        "trials": 20,
        "median": 0.5,
    }
    return Case(**{**values, **keys})


def answered(answer: Probability = NO_ANSWER, *, target: float = 0.1, **keys: Any) -> Answer:
    onset = Onset(motion="rocks", friction_needed=FrictionNeed(0.25, 0.2))
    values: dict[str, Any] = {
        "facts": compute_object_facts(OBJECT), "level": LEVEL, "demand": "0.5 g and 0.4 m/s",
        "onset": onset, "target": target, "answer": answer,
    }  # fmt: skip
    return answer_of(Findings(**{**values, **keys}))


def test_at_the_target_it_is_met_and_a_fifth_of_it_is_green() -> None:
    for target in (0.1, 0.5, 1e-4):
        fifth = 0.2 * target
        colours = [colour_of(p, target) for p in (0.0, fifth, 1.001 * fifth, target)]
        assert colours == ["green", "green", "amber", "amber"]
        assert colour_of(1.001 * target, target) == "red"
        for value, verdict in ((target, "below target"), (1.001 * target, "above target")):
            assert verdict_of(Probability(value=value, basis="curve"), target) == verdict
    assert colour_of(None, 0.1) == "grey"
    assert verdict_of(NO_ANSWER, 0.1) == "slides"
    assert verdict_of(Probability(value=None, basis="count"), 0.1) == "undecided"
    assert verdict_of(Probability(value=0.0, basis="statics"), 0.1) == "stands"


def test_what_slides_has_the_friction_that_it_needs_and_its_cause() -> None:
    found = answered(onset=Onset(motion="slides", friction_needed=FrictionNeed(0.35, 0.4)))
    assert (found.verdict, found.colour) == ("slides", "grey")
    assert "vase slides at a PGA of 0.5 g: rocking is no answer" in found.sentence
    assert "friction of 0.4 for impacts; the lowest given is 0.3." in found.reason


def test_what_stands_and_what_no_run_lifts() -> None:
    stands = answered(Probability(value=0.0, basis="statics"))
    assert (stands.verdict, stands.colour) == ("stands", "green")
    assert "vase stays where it stands" in stands.sentence
    assert stands.reason.startswith("It lifts at 0.2 g.")
    open_ = answered(Probability(value=None, basis="count"))
    assert (open_.verdict, open_.colour) == ("undecided", "grey")
    assert open_.sentence == "No answer yet for vase: no run lifts at a PGV of 0.4 m/s."
    assert "the demand is 0.5 g and 0.4 m/s" in open_.reason


def test_a_share_of_runs_is_stated_as_a_count_with_its_interval() -> None:
    cases = (case("as described", 0.3), case("mass centre", 0.1), case("base width", 0.35))
    given = Probability(value=0.3, band=(0.16, 0.5), basis="count")
    found = answered(given, cases=cases)
    assert found.sentence == (
        "6 of its 20 runs that lift fall at a PGV of 0.4 m/s (30 %; 90 %: 16 to 50 %): more than "
        "the target of 10 %."
    )
    assert found.reason == (
        "It lifts at 0.2 g; the demand is 0.5 g and 0.4 m/s. In 6 of 20 runs that lift at the "
        "demand it falls. What matters most is the mass centre: over its range 10 to 30 % fall."
    )
    # The answer lies outside the bar where it is by another curve.
    curve = answered(Probability(value=0.5, basis="curve"), cases=cases)
    assert curve.reason.endswith(
        "over its range 10 to 30 % fall by the runs about the demand, 30 % as described."
    )
    # None of the runs, and all of them, are no per cents.
    for share, words in (
        (0.0, "None of its 20 runs that lift fall at"),
        (1.0, "20 of its 20 runs that lift fall at"),
    ):
        edge = answered(Probability(value=share, basis="count"), cases=(case("", share),))
        assert edge.sentence.startswith(words)
        assert "(30 %" not in edge.sentence
        assert ("In none of 20 runs" in edge.reason) is (share == 0.0)
        assert "What matters most" not in edge.reason


def test_a_probability_by_curve_is_stated_as_odds_and_beside_runs_that_decide() -> None:
    cases = (case("as described", 0.05),)
    given = Probability(value=0.02, by_curve=0.02, band=(0.01, 0.04), basis="curve")
    found = answered(given, cases=cases)
    assert "objects of this shape and size would fall at a PGV of 0.4 m/s (2.0 %): within" in (
        found.sentence
    )
    assert found.colour == "green"
    decided = answered(
        Probability(value=0.25, by_curve=0.02, band=(0.1, 0.4), basis="count"),
        cases=(case("as described", 0.25),),
    )
    assert "(2.0 %), but 5 of its 20 runs that lift fall there (25 %; 90 %: 10 to 40 %)" in (
        decided.sentence
    )
    assert decided.verdict == "above target"


def test_over_pga_all_runs_count_and_a_remedy_ends_the_sentence() -> None:
    level = DemandLevel(measure=Measure("pga_g"), value=0.5, words="PGA of 0.5 g")
    remedy = Remedy(name="width", words="widen it", probability=0.05, basis="count")
    found = answered(
        Probability(value=0.3, basis="count"),
        cases=(case("as described", 0.3),),
        level=level,
        remedy=remedy,
    )
    assert "runs that lift" not in found.sentence + found.reason
    assert found.sentence.endswith("the least change that meets the target is to widen it.")
    assert ".;" not in found.sentence


def test_the_article_is_that_of_the_sound() -> None:
    assert with_article("Sa(1 s) of 0.3 g") == "an Sa(1 s) of 0.3 g"
    assert with_article("PGV of 0.4 m/s") == "a PGV of 0.4 m/s"


def test_a_probability_that_is_not_known_is_no_bar() -> None:
    cases = (case("as described", 0.3), case("mass centre", math.nan, fell=0, trials=0))
    found = answered(Probability(value=0.3, basis="count"), cases=cases)
    assert "What matters most" not in found.reason
