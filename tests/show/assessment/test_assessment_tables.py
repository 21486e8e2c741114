"""Rows of the page of an assessment: remedies out of reach, and the one of the least change."""

from types import SimpleNamespace
from typing import Any

from rocksteady import Block, Demand
from rocksteady.risk.assess._remedies import Remedy
from rocksteady.show.assessment._assessment_tables import _remedy_words, remedy_rows, side_rows
from rocksteady.show.style.markup import figure


def remedy(words: str, change: float | None, probability: float = 0.05) -> Any:
    """Return what the table reads of a remedy."""
    return SimpleNamespace(words=words, change=change, probability=probability)


def words_of(*remedies: Any) -> tuple[str, str]:
    """Return the cells of the row of remedies."""
    return _remedy_words(SimpleNamespace(remedies=remedies))  # type: ignore[arg-type]


def test_the_remedy_of_the_least_change_is_named_with_its_probability() -> None:
    wider, lower = remedy("a wider base", 0.3, 0.02), remedy("a lower mass", 0.1, 0.04)
    assert words_of(wider, lower) == words_of(lower, wider) == ("a lower mass", "then 4.0 %")


def test_a_remedy_out_of_reach_is_none() -> None:
    out_of_reach = remedy("no width helps", None)
    assert words_of(out_of_reach) == ("none within reach", "")
    assert words_of(out_of_reach, remedy("a wider base", 0.3)) == ("a wider base", "then 5.0 %")


def test_an_object_without_remedies_needs_none() -> None:
    assert words_of() == ("none needed", "")


def test_a_count_below_a_remedy_stays_on_its_line() -> None:
    wider = Remedy(
        name="width", words="widen it", probability=0.05, basis="count", fell=3, trials=66
    )
    (row,) = remedy_rows(SimpleNamespace(remedies=[wider]))  # type: ignore[arg-type]
    assert "3\xa0of\xa066<" in str(row["from"])


def test_each_edge_lifts_in_the_gravity_of_the_object_and_with_its_vertical_share() -> None:
    block = Block.asymmetric(left=0.2, right=0.3, height=2.0, gravity=4.903325)
    demand = Demand(pga_g=0.2, vertical_g=0.1)
    rows = side_rows(SimpleNamespace(facts=SimpleNamespace(block=block, demand=demand)))  # type: ignore[arg-type]
    assert [row["lifts at"] for row in rows] == [figure("0.08 g"), figure("0.12 g")]
