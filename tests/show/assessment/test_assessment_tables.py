"""Rows of the page of an assessment: the sides of a block, the levels of its demand."""

from types import SimpleNamespace
from typing import Any

import numpy as np

from rocksteady import Block, Demand
from rocksteady.measures import Measure
from rocksteady.risk import DamageState
from rocksteady.risk.counted.count import Count
from rocksteady.risk.counted.curve import Curve
from rocksteady.show.assessment._assessment_tables import share_rows, side_rows
from rocksteady.show.style.markup import figure


def test_each_edge_lifts_in_the_gravity_of_the_object_and_with_its_vertical_share() -> None:
    block = Block.asymmetric(left=0.2, right=0.3, height=2.0, gravity=4.903325)
    demand = Demand(pga_g=0.2, vertical_g=0.1)
    rows = side_rows(SimpleNamespace(facts=SimpleNamespace(block=block, demand=demand)))  # type: ignore[arg-type]
    assert [row["lifts at"] for row in rows] == [figure("0.08 g"), figure("0.12 g")]


def levels(*counts: tuple[list[int], list[int]]) -> Any:
    """Return what the table reads of an assessment at 0.2 g, counted at 0.1, 0.2, 0.22 g."""
    made = [Count(fell=np.array(fell), answered=np.array(runs), ways=2) for fell, runs in counts]
    at = np.array([0.1, 0.2, 1.1 * 0.2])
    curve = Curve(levels=at[: len(made)], counts=made, lifts_at=at)
    rows = [{"runs": count.runs} for count in made]
    state = SimpleNamespace(state=DamageState("overturned"), curve=curve, rows=rows)
    fragility = SimpleNamespace(states=[state], measure=Measure("pga_g"))
    judged = SimpleNamespace(shaking=SimpleNamespace(level=0.2))
    described = SimpleNamespace(on_floor=False)
    return SimpleNamespace(fragility=fragility, judged=judged, described=described)


def test_the_demand_and_its_margin_are_named_in_the_table_of_shares() -> None:
    rows = share_rows(levels(([0] * 4, [2] * 4), ([1, 0, 0, 0], [2] * 4), ([2] * 4, [2] * 4)))
    heads = [str(row["PGA"]) for row in rows]
    assert heads[0] == "0.1 g"
    assert "> this demand<" in heads[1].replace('"quiet">', '"quiet"> ')
    assert "1.1 x this demand" in heads[2]
    assert [row["falls"] for row in rows] == [figure("none"), figure("12\xa0%"), figure("all")]
    assert all("runs" not in row for row in rows)


def test_a_share_of_runs_without_an_answer_is_the_mean_of_the_records() -> None:
    """One record has one run, which falls, the others two that stand: 1 of 4, and not 1 of 7."""
    rows = share_rows(levels(([0] * 4, [2] * 4), ([1, 0, 0, 0], [1, 2, 2, 2])))
    assert rows[1]["falls"] == figure("25\xa0%")
    assert [row["runs"] for row in rows] == [figure("8"), figure("7")]
