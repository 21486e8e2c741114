"""Words on fields: what a label makes of a value, and the order of the facts."""

import inspect
import math
from dataclasses import dataclass
from typing import Annotated

import numpy as np
import pytest

from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked_result
from rocksteady.model.checks.bounds import Bounds
from rocksteady.results.description import Description, Fact
from rocksteady.results.numbers import number, number_or_none
from rocksteady.results.result import Result
from rocksteady.results.words import Label, facts_of

SHARE = Bounds(0.0, 1.0, "[]", "give a share")


@checked_result
@dataclass(frozen=True, kw_only=True)
class Made(Result):
    """A result of some fields."""

    runs: Annotated[int, Label()] = 3
    mass_kg: Annotated[float, Label("mass", unit="kg")] = 2.5
    share: Annotated[float, SHARE, Label("share", lambda part: f"{number(100.0 * part)} %")] = 0.5
    beta: Annotated[float, Label("beta", plain=number_or_none)] = math.nan
    ends: Annotated[tuple[float, ...], Label("", plain=number_or_none)] = (1.0, math.inf)
    period_s: Annotated[float | None, Label("period", unit="s", optional=True)] = None
    seed: int = 7

    @property
    def levels(self) -> Annotated[np.ndarray, Label("levels")]:
        """An array."""
        return np.array([1.0, 2.0])

    def describe(self) -> Description:
        """Return all facts, the mass first."""
        return Description("made", facts_of(self, "mass_kg seed", Fact("more", 1), share="half"))


def test_facts_that_are_named_come_first_and_the_others_in_the_order_of_the_class() -> None:
    keys = [fact.key for fact in Made().describe().facts]
    first = ["mass_kg", "seed", "more"]
    assert keys == [*first, "runs", "share", "beta", "ends", "period_s", "levels"]


def test_a_label_writes_the_value_and_makes_it_plain() -> None:
    facts = {fact.key: fact for fact in Made(period_s=1.5).describe().facts}
    assert facts["mass_kg"] == Fact("mass_kg", 2.5, "mass", "2.5 kg")
    assert facts["runs"] == Fact("runs", 3, "runs")
    assert facts["seed"] == Fact("seed", 7), "what has no label is for JSON alone"
    assert facts["beta"] == Fact("beta", None, "beta")
    assert facts["ends"] == Fact("ends", [1.0, None])
    assert facts["levels"] == Fact("levels", [1.0, 2.0], "levels")
    assert facts["period_s"] == Fact("period_s", 1.5, "period", "1.5 s")


def test_people_do_not_read_what_is_optional_and_missing() -> None:
    facts = {fact.key: fact for fact in Made().describe().facts}
    assert facts["period_s"] == Fact("period_s", None)


def test_a_text_replaces_what_the_label_writes() -> None:
    assert Fact("share", 0.5, "share", "half") in Made().describe().facts
    assert Fact("share", 0.5, "share", "50 %") in facts_of(Made())


def test_a_rule_and_a_label_stand_in_one_annotation_and_neither_in_the_signature() -> None:
    with pytest.raises(InputError, match="give a share"):
        Made(share=2.0)
    assert "Annotated" not in str(inspect.signature(Made))
    assert inspect.signature(Made).parameters["share"].annotation is float
