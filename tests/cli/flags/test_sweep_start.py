"""Where the sweeps of a diagram begin, and what carries them."""

import math
from typing import Any

import pytest

from rocksteady import DimensionlessBlock, ModelError, Rest, State, Steady, find_attractor
from rocksteady.cli.commands.bifurcate import _sweep
from rocksteady.cli.console.refusals import FlagError
from rocksteady.cli.flags.range import Range
from rocksteady.cli.flags.sweep_start import SweepStart

SPAN = Range(
    parameter="amplitude",
    values=(0.1, 1.0, 2.0),
    body=DimensionlessBlock(restitution=0.8),
    amplitude=0.1,
    frequency_ratio=4.0,
)


@pytest.mark.parametrize(
    ("flags", "value", "expected"),
    [
        ({}, 2.0, ("steady", Steady(), 0.0)),
        ({}, 0.1, ("rest", Rest(), 0.0)),  # below the existence of steady states
        ({"phase": 1.0}, 2.0, ("rest", Rest(), 1.0)),
        ({"start": "rest", "order": 3}, 2.0, ("rest", Rest(), 0.0)),
        ({"start": "steady:1", "kick": 1e-3}, 2.0, ("steady:1", Steady(kick=1e-3), 0.0)),
        ({"start": "0.2,0.1"}, 2.0, ("0.2,0.1", State(angle=0.2, velocity=0.1), 0.0)),
        ({"start": "0.2,tau=0.5"}, 2.0, ("0.2,tau=0.5", State(angle=0.2, velocity=2.0), 0.0)),
    ],
)
def test_a_sweep_begins_where_it_is_told_or_on_a_steady_state(
    flags: dict[str, Any], value: float, expected: tuple[str, object, float]
) -> None:
    assert SweepStart(**flags).begin(SPAN, value) == expected


def test_a_steady_state_that_is_asked_for_must_exist() -> None:
    with pytest.raises(FlagError, match=r"'steady' is not accepted: .* there is none"):
        SweepStart(start="steady").begin(SPAN, 0.1)
    with pytest.raises(ModelError):
        SweepStart(start="steady:2").begin(SPAN, 0.1)


@pytest.mark.parametrize("flags", [{"start": "rest"}, {"phase": 0.0}, {"kick": 1e-3}])
def test_without_sweeps_what_only_they_have_is_refused(flags: dict[str, Any]) -> None:
    with pytest.raises(FlagError, match="without sweeps, it has no meaning; leave it out"):
        SweepStart(**flags).refuse("without sweeps")
    SweepStart(order=3, side="-").refuse("without sweeps")


@pytest.mark.parametrize("upwards", [True, False])
def test_a_sweep_goes_along_the_axis_from_its_first_value(upwards: bool) -> None:
    start = SweepStart(start="0.2,0.1", phase=0.5)
    found = _sweep(SPAN, start, 300, upwards=upwards)
    values = SPAN.values if upwards else SPAN.values[::-1]
    assert found.start == "0.2,0.1"
    assert found.trail.values.tolist() == list(values)
    bare, shaking = SPAN.at(values[0])
    begun = State(angle=0.2, velocity=0.1)
    alone = find_attractor(
        bare,
        type(shaking)(amplitude=values[0], frequency_ratio=4.0, phase=0.5),
        start=begun,
        max_cycles=300,
    )
    first = found.trail.attractors[0]
    assert (first.kind, first.period, first.after) == (alone.kind, alone.period, alone.after)
    assert math.isclose(first.growth, alone.growth)
