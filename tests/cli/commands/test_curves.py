"""`rocksteady curves`: its contract, its text and its files."""

from pathlib import Path
from typing import Any

import pytest

from tests.cli.program import ran_once, refused, rocksteady

SIMPLE = "curves -A 0.2:4:2 -W 1.5:3:2 -r 0.8 --max-impacts 2 --max-period 1"


def values_of(command: str) -> dict[str, Any]:
    ran = ran_once(f"{command} --json")
    assert (ran.code, ran.err) == (0, "")
    return ran.json


NARROW = "curves -W 5.05:5.15:2 -A 2.9:3.85:2 -n 3 --max-impacts 2 --max-period 3 --max-branches 3"


@pytest.mark.slow
def test_the_nonlinear_model_is_said_with_the_slenderness_that_it_knows() -> None:
    block = "--alpha-rad 0.1 --p-rad-s 3 -r 0.87"
    values = values_of(f"{NARROW} {block} --model nonlinear")
    assert (values["model"], values["block"]["alpha_rad"]) == ("nonlinear", 0.1)
    (graze,) = (each for each in values["points"] if each["type"] == "doubling-graze")
    # As solved by shooting: tests/dynamics/continuation/curves/test_search_plane.py.
    assert graze["frequency_ratio"] == pytest.approx(5.11137269802, abs=1e-9)
    assert graze["amplitude"] == pytest.approx(3.76310721944, abs=1e-9)
    assert "slenderness" in refused(f"{NARROW} -r 0.87 --model nonlinear")


@pytest.mark.slow
def test_a_block_whose_sides_differ_has_curves_of_unsymmetric_motions() -> None:
    sides = "--left-m 0.15 --right-m 0.2 --height-m 1.2 -r 0.85,0.8"
    values = values_of(f"curves {sides} -A 1.6:3:2 -W 1.5:2.6:2 --max-impacts 2 --max-period 1")
    assert {each["type"] for each in values["curves"]} >= {"period-doubling"}
    assert not any(each["symmetric"] for each in values["curves"])
    assert values["block"]["negative"]["restitution"] == 0.8


@pytest.mark.slow
def test_a_budget_that_ends_the_work_is_said(tmp_path: Path) -> None:
    ran = rocksteady(f"{SIMPLE} --max-curves 1 --plot", tmp_path / "curves.png")
    assert ran.code == 3
    assert "raise --max-curves" in ran.err
