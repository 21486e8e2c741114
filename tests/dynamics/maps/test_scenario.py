"""Scenarios: nouns and numbers only, and the same cell as nouns and as arrays."""

import json
import pickle
from dataclasses import asdict, fields, is_dataclass
from itertools import product
from typing import Any

import numpy as np
import pytest

from rocksteady import Block, DimensionlessBlock, Harmonic, Rest, State, Steady
from rocksteady.dynamics.batch.initial_states import at_phases
from rocksteady.dynamics.history.start import initial_march
from rocksteady.dynamics.maps._resizing import sizes_with
from rocksteady.dynamics.maps._scenario import Scenario
from rocksteady.dynamics.parameters import AXES, SIZES
from rocksteady.errors import ModelError
from rocksteady.model.equations import Linear
from tests.dynamics.maps.drawn import Case, drawn_case
from tests.every import every

CASES = [drawn_case(number) for number in range(200)]


def scenario(case: Case) -> Scenario:
    return Scenario(
        axes=tuple(case.axes),
        block=case.block,
        motion=case.shaking,
        start=case.start,
        fixed=tuple(case.fixed.items()),
        housner=1.0 if case.housner else None,
    )


def coordinates(case: Case) -> dict[str, Any]:
    cells = np.array(list(product(*case.axes.values())))
    return dict(zip(case.axes, cells.T.copy(), strict=True))


@every("case", CASES)
def test_a_cell_is_what_the_constructors_make_of_its_values(case: Case) -> None:
    for values in product(*case.axes.values()):
        cell = dict(zip(case.axes, values, strict=True))
        block, shaking, start = scenario(case).at(cell)
        expected = case.at(cell)
        assert (block, start) == (expected[0], expected[2])
        assert (shaking.amplitude, shaking.frequency_ratio) == (
            expected[1].amplitude,
            expected[1].frequency_ratio,
        )
        if not isinstance(start, Steady):
            assert shaking.phase == expected[1].phase


@pytest.mark.slow
@every("case", CASES)
def test_arrays_of_cells_are_the_nouns_to_the_last_bit(case: Case) -> None:
    cells = scenario(case).cells(coordinates(case))
    for place, values in enumerate(product(*case.axes.values())):
        block, shaking, start = scenario(case).at(dict(zip(case.axes, values, strict=True)))
        bare = block.dimensionless()
        assert cells.amplitude[place] == shaking.amplitude
        assert cells.frequency_ratio[place] == shaking.frequency_ratio
        assert cells.sides[place, 0, 0] == bare.restitution
        try:
            begin = initial_march(start, bare, shaking, Linear().sides(bare))[1]
        except ModelError:
            assert not cells.there[place]
            continue
        assert cells.there[place]
        for name in ("side", "angle", "velocity", "half_cycles", "phase"):
            assert getattr(cells.begin, name)[place] == getattr(begin, name)


@every("case", CASES[:40])
def test_a_scenario_holds_nouns_numbers_and_names_only(case: Case) -> None:
    def plain(thing: object) -> None:
        if is_dataclass(thing):
            for each in fields(thing):
                plain(getattr(thing, each.name))
        elif isinstance(thing, tuple):
            for part in thing:
                plain(part)
        else:
            assert type(thing) in (str, float, int, bool, type(None))

    whole = scenario(case)
    plain(whole)
    json.dumps(asdict(whole))
    json.dumps(whole.attributes)
    again = pickle.loads(pickle.dumps(whole))
    assert again == whole
    assert np.array_equal(
        again.cells(coordinates(case)).amplitude, whole.cells(coordinates(case)).amplitude
    )


def test_a_parameter_is_either_an_axis_or_kept() -> None:
    for case in CASES:
        whole = scenario(case)
        assert not set(whole.kept) & set(whole.axes)
        assert case.fixed.items() <= whole.kept.items()
        assert {*whole.kept, *whole.axes} <= set(AXES)


def test_what_keeps_what_among_the_sizes() -> None:
    block = Block.rectangle(width=0.4, height=1.2, restitution=0.9)
    shaking = Harmonic(amplitude=2.0, frequency_ratio=3.0)
    kept = {
        "width": "height",
        "height": "width",
        "alpha": "radius",
        "radius": "alpha",
        "p": "alpha",
    }
    assert set(kept) == set(SIZES)
    for moved, stays in kept.items():
        assert sizes_with([moved]) != ()
        there = Scenario(axes=(moved,), block=block, motion=shaking).kept
        assert {name for name in there if name in SIZES} == {stays}
        assert there[stays] == getattr(block, stays)
        assert (there["amplitude"], there["frequency_ratio"]) == (2.0, 3.0)


def test_one_ground_is_felt_otherwise_by_a_larger_block() -> None:
    block = Block.rectangle(width=0.4, height=1.2, restitution=0.9)
    ground = (("acceleration_m_s2", 5.0), ("frequency_hz", 1.5))
    small = Harmonic.from_si(block, **dict(ground))
    whole = Scenario(axes=("radius",), block=block, fixed=ground)
    grown, shaken, _ = whole.at({"radius": 4.0 * block.radius})
    assert isinstance(grown, Block)
    assert grown.alpha == block.alpha
    assert shaken == Harmonic.from_si(grown, **dict(ground))
    assert shaken.amplitude == small.amplitude
    assert shaken.frequency_ratio == pytest.approx(2.0 * small.frequency_ratio, rel=1e-15)


def test_two_sizes_may_be_fixed_in_place_of_those_of_the_block() -> None:
    block = Block.rectangle(width=0.4, height=1.2, restitution=0.9)
    whole = Scenario(
        axes=("frequency_ratio",),
        block=block,
        fixed=(("alpha", 0.25), ("p", 3.0), ("acceleration_m_s2", 4.0)),
        housner=1.0,
    )
    other = Block.from_p(alpha=0.25, p=3.0)
    assert whole.at({"frequency_ratio": 2.0})[0] == other
    cells = whole.cells({"frequency_ratio": np.array([2.0, 3.0])})
    assert cells.sides[:, 0, 0].tolist() == [other.restitution] * 2
    assert cells.amplitude.tolist() == [4.0 / other.uplift_acceleration] * 2


@pytest.mark.parametrize("fixed", [(("width", 0.5),), (("p", 3.0), ("p", 3.0))])
def test_a_parameter_is_named_once(fixed: Any) -> None:
    block = Block.rectangle(width=0.4, height=1.2)
    shaking = Harmonic(amplitude=2.0, frequency_ratio=3.0)
    with pytest.raises(ModelError, match="one thing in two ways"):
        Scenario(axes=("width",), block=block, motion=shaking, fixed=fixed)


def test_restitution_follows_the_slenderness_only_where_asked() -> None:
    block = Block.rectangle(width=0.4, height=1.2, restitution=0.7)
    own = Block.rectangle(width=0.8, height=1.2).restitution
    for housner, wide, words in (
        (None, 0.7, 0.7),
        (1.0, own, "housner"),
        (0.965, 0.965 * own, "housner*0.965"),
    ):
        whole = Scenario(
            axes=("width",),
            block=block,
            motion=Harmonic(amplitude=2.0, frequency_ratio=3.0),
            housner=housner,
        )
        cells = whole.cells({"width": np.array([0.8, 0.8])})
        assert cells.sides[:, 0, 0].tolist() == [wide, wide]
        assert whole.attributes["restitution"] == words


@every(
    ("start", "axes", "said"),
    [
        (Rest(), ("phase",), {"start": "rest"}),
        (Rest(), ("angle",), {"start": "state", "velocity": 0.0}),
        (State(angle=0.1, velocity=0.2), ("velocity",), {"start": "state", "angle": 0.1}),
        (
            Steady(order=3, side=-1),
            ("kick",),
            {"start": "steady", "branch": 1, "order": 3, "side": -1},
        ),
        (
            Steady(),
            ("amplitude",),
            {"start": "steady", "branch": 1, "order": 1, "kick": 1e-6, "side": 1},
        ),
    ],
)
def test_attributes_name_the_start(start: Any, axes: Any, said: dict[str, Any]) -> None:
    shaking = Harmonic(amplitude=2.0, frequency_ratio=3.0, phase=0.5)
    block = DimensionlessBlock(restitution=0.8)
    whole = Scenario(axes=axes, block=block, motion=shaking, start=start)
    given: dict[str, Any] = {"amplitude": 2.0, "frequency_ratio": 3.0, "restitution": 0.8}
    given["model"] = "linear"
    if not isinstance(start, Steady):
        given["phase"] = 0.5
    expected = {**{name: value for name, value in given.items() if name not in axes}, **said}
    assert whole.attributes == expected


def test_clocks_of_many_phases_are_those_of_each() -> None:
    rng = np.random.default_rng(3)
    near = np.array([n * np.pi + d for n in range(-9, 9) for d in (-1e-15, -1e-16, 0.0, 1e-16)])
    phases = np.concatenate([rng.uniform(-1e6, 1e6, 500), near, rng.uniform(-7.0, 7.0, 500)])
    upright = np.zeros(len(phases))
    begin = at_phases(upright, upright, phases)
    block = DimensionlessBlock(restitution=0.8)
    for place, phase in enumerate(phases.tolist()):
        shaking = Harmonic(amplitude=2.0, frequency_ratio=3.0, phase=phase)
        march = initial_march(Rest(), block, shaking, Linear().sides(block))[1]
        assert begin.half_cycles[place] == march.half_cycles
        assert begin.phase[place] == march.phase
