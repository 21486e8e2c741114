"""Where the sweeps of a diagram begin, and what carries them."""

from dataclasses import replace
from typing import Any

import pytest

from rocksteady import DimensionlessBlock, Linear, Rest, State, Steady
from rocksteady.cli.console.refusals import FlagError
from rocksteady.cli.flags.range import Range
from rocksteady.cli.flags.sweep_start import SweepStart
from rocksteady.errors import ModelError
from tests.every import every

SPAN = Range(
    parameter="amplitude",
    values=(0.1, 1.0, 2.0),
    body=DimensionlessBlock(restitution=0.8),
    amplitude=0.1,
    frequency_ratio=4.0,
)


@every(
    ("flags", "expected"),
    [
        ({}, Steady()),
        ({"order": [3, 1], "side": "-"}, Steady(order=3, side=-1)),
        ({"phase": 1.0}, Rest()),
        ({"start": "rest", "order": [3]}, Rest()),
        ({"start": "0.2,0.1"}, State(angle=0.2, velocity=0.1)),
        ({"start": "0.2,tau=0.5"}, State(angle=0.2, velocity=2.0)),
    ],
)
def test_a_sweep_begins_as_typed_or_on_a_steady_state(
    flags: dict[str, Any], expected: object
) -> None:
    assert SweepStart(**flags).chosen(SPAN, Linear()) == expected


def test_a_steady_state_that_is_typed_must_exist_at_both_ends() -> None:
    with pytest.raises(FlagError, match=r"'steady' is not accepted: .* there is none"):
        SweepStart(start="steady").chosen(SPAN, Linear())  # at 0.1 there is none
    with pytest.raises(ModelError):
        SweepStart(start="steady:2").chosen(SPAN, Linear())
    there = replace(SPAN, values=(1.0, 2.0), amplitude=1.0)
    assert SweepStart(start="steady:1", kick=1e-3).chosen(there, Linear()) == Steady(kick=1e-3)


def test_the_start_of_each_sweep_is_written_as_it_was_typed() -> None:
    values = {"sweeps": [{"start": "steady", "values": 3}]}
    assert SweepStart().as_given(values) == values
    typed = SweepStart(start="steady:1").as_given(values)
    assert typed == {"sweeps": [{"start": "steady:1", "values": 3}]}


@every("flags", [{"start": "rest"}, {"phase": 0.0}, {"kick": 1e-3}])
def test_without_sweeps_what_only_they_have_is_refused(flags: dict[str, Any]) -> None:
    with pytest.raises(FlagError, match="without sweeps, it has no meaning; leave it out"):
        SweepStart(**flags).refuse("without sweeps")
    SweepStart(order=[3], side="-").refuse("without sweeps")


def test_the_orders_of_branches_are_all_that_are_typed() -> None:
    assert SweepStart().orders == (1,)
    assert SweepStart(order=[3, 1]).orders == (3, 1)
