"""Answers of a fragility: its sentence in each case, and the fields of its JSON."""

from typing import Any

import pytest

from rocksteady import Block, compute_fragility
from rocksteady.motions import make_synthetic_suite
from rocksteady.risk import Fragility, Levels, RestitutionBand, Ways
from tests.every import every
from tests.risk.counted.test_suite import peaks_of

SUITE = make_synthetic_suite(14, seed=6)
BLOCK = Block.rectangle(width=0.4, height=1.6)
ONE = RestitutionBand(draws=1)


def made(levels: Any = None, *, records: int = 14, measure: str = "pga_g", **how: Any) -> Fragility:
    return compute_fragility(
        BLOCK,
        SUITE[:records],
        levels=Levels(measure, levels, beside=()),
        restitution=ONE,
        ways=Ways(reverse=False),
        **how,
    )


@pytest.fixture(scope="module", name="found")
def _found() -> Fragility:
    return made()


def words_module(found: Fragility) -> tuple[str, dict[str, str]]:
    answer = found.describe()
    return answer.sentence, dict(answer.screen)


def test_the_first_line_is_the_level_at_which_half_fall(found: Fragility) -> None:
    half = found.state("overturned").half
    assert half is not None
    middle, low, high = half
    assert low is not None
    assert high is not None
    sentence, lines = words_module(found)
    assert sentence == f"Half fall at {middle:.3g} g of PGA (90 %: {low:.3g} to {high:.3g})."
    assert lines["lifts at"].startswith("0.25 g")
    shares = found.states[-1].curve.shares.tolist()
    doubt = "" if shares == sorted(shares) else "; fewer fall at some higher level"
    assert lines["counted"] == f"{found.runs:,} runs, 14 records{doubt}"
    assert found.summary().partition("\n")[0] == sentence
    assert found.to_dict()["uplift_level"] == found.state("uplift").curve.lifts_at[0]


@every(
    ("levels", "states", "begins"),
    [
        ([0.1, 0.2], None, "Falls in none of 14 runs at 0.2 g, the highest level: at most "),
        ([20.0, 30.0], None, "Falls in all 14 runs at 20 g, the lowest level: at least "),
        ([0.1, 0.2], [0.5], "Tilts > 0.5 alpha in none of 14 runs at 0.2 g, the highest level"),
    ],
)
def test_without_a_half_the_nearest_count_is_the_answer(
    levels: list[float], states: Any, begins: str
) -> None:
    found = made(levels, **({} if states is None else {"states": states}))
    assert found.states[-1].half is None
    assert words_module(found)[0].startswith(begins)


def test_fewer_than_11_records_are_no_answer() -> None:
    for records, few in ((1, True), (10, True), (11, False)):
        sentence, lines = words_module(made([0.2, 0.5, 1.0, 2.0], records=records))
        assert sentence.startswith("No answer: ") == few
        assert ("11 are the least" in sentence) == few
        assert ("lognormal" in lines) is not few


def test_large_factors_are_said_from_ten_on() -> None:
    pga = max(peaks_of(each)[0] for each in SUITE), min(peaks_of(each)[0] for each in SUITE)
    for factor, said in ((9.9, False), (10.1, True)):
        level = factor * pga[1]
        _, lines = words_module(made([0.5 * level, level]))
        assert ("scaled" in lines) == said
        assert made([level]).scale_factor_max == pytest.approx(factor)
