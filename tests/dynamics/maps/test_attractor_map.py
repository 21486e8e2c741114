"""Maps of attractors: every cell is what one gets at that point alone."""

import math
from dataclasses import replace
from itertools import product
from typing import Any

import numpy as np
import pytest

from rocksteady import (
    Block,
    DimensionlessBlock,
    Execution,
    Harmonic,
    Rest,
    State,
    Steady,
    find_attractor,
    map_attractors,
)
from rocksteady.dynamics.batch.attractors import KIND_FLAGS
from rocksteady.dynamics.parameters import AXES as PARAMETERS_OF_MAPS
from rocksteady.errors import InputError, ModelError
from rocksteady.formulas import housner_restitution
from tests.dynamics.maps.drawn import drawn_case, same_as_alone
from tests.every import every

BLOCK = DimensionlessBlock(restitution=0.8)
AMPLITUDES = np.linspace(0.4, 6.0, 12)
RATIOS = np.linspace(0.6, 8.0, 11)
AXES = {"amplitude": AMPLITUDES, "frequency_ratio": RATIOS}
SHAKING = Harmonic(amplitude=2.0, frequency_ratio=3.0)
RECTANGLE = Block.rectangle(width=0.4, height=1.2, restitution=0.9)
RING = Block.general(mass=1.0, inertia=2.0, radius=1.0, alpha=0.3, restitution=0.9)
CASES = 60
"""Maps of random axes."""


@every(
    ("start", "phase"),
    [
        (Rest(), 0.0),
        (State(angle=0.2, velocity=-0.1), 5.0),
        (State(angle=0.0, velocity=-0.3), 1.0),
        (Steady(side=-1), 0.0),
        (Steady(branch=2, order=3, kick=1e-3), 0.0),
    ],
)
def test_every_cell_is_the_attractor_at_that_point(start: Any, phase: float) -> None:
    shaking = replace(SHAKING, phase=phase)
    found = map_attractors(BLOCK, shaking, axes=AXES, start=start, max_cycles=300)
    assert found.kind.dims == ("amplitude", "frequency_ratio")
    for a in AMPLITUDES:
        for w in RATIOS:
            shaking = Harmonic(amplitude=a, frequency_ratio=w, phase=phase)
            cell = found.sel(amplitude=a, frequency_ratio=w)
            same_as_alone(cell, BLOCK, shaking, start=start, cycles=300)


def test_a_row_along_which_chatter_ends_at_uplift_is_as_fast_as_any_other() -> None:
    # A row of 1000 x 1000 cells, 445 of which were undecided after 2000 periods, a second each.
    ratios = np.linspace(0.2, 8.0, 1000)[::25]
    block = DimensionlessBlock(restitution=0.87)
    axes: dict[str, Any] = {"amplitude": [1.0565565565565567], "frequency_ratio": ratios}
    found = map_attractors(block, axes=axes)
    words = [KIND_FLAGS[kind] for kind in found.kind.values[0].tolist()]
    assert {"symmetric", "unsymmetric", "overturned"} <= set(words)
    assert found.after.values.max() < 200  # as if each had gone on for 2000


def test_executors_agree_to_the_bit_and_progress_is_told() -> None:
    told: list[int] = []
    one = map_attractors(BLOCK, axes=AXES, max_cycles=300, run=Execution(progress=told.append))
    other = map_attractors(BLOCK, axes=AXES, max_cycles=300, run=Execution(executor="serial"))
    assert one.identical(other)
    assert sum(told) == 12 * 11


def test_the_phase_is_an_axis_as_any_other() -> None:
    phases = [-7.0, 0.0, 2.5]
    found = map_attractors(BLOCK, axes={"phase": phases, **AXES}, max_cycles=100)
    for phase in phases:
        shaking = replace(SHAKING, phase=phase)
        alone = map_attractors(BLOCK, shaking, axes=AXES, max_cycles=100)
        assert found.sel(phase=phase).drop_vars("phase").equals(alone)


def test_a_map_says_what_it_was_computed_from() -> None:
    block = Block.rectangle(width=0.4, height=1.2, restitution=0.9, gravity=9.8)
    found = map_attractors(
        block, SHAKING, axes={"height": [1.2, 2.4], "phase": [0.0]}, max_cycles=7
    )
    attributes = dict(found.attrs)
    for name in ("rocksteady_version", "source", "inputs"):
        assert attributes.pop(name)
    assert attributes == {
        "width": block.width,
        "gravity": 9.8,
        "restitution": 0.9,
        "amplitude": 2.0,
        "frequency_ratio": 3.0,
        "start": "rest",
        "model": "nonlinear",
        "max_cycles": 7,
    }
    assert found.height.attrs == {"long_name": "full height of the block", "units": "m"}


def test_a_number_among_the_axes_is_fixed_and_no_dimension() -> None:
    given: dict[str, Any] = {
        "width": [0.4, 0.5],
        "height": np.float64(1.5),
        "acceleration_m_s2": 4,
        "frequency_hz": np.array(0.7),
        "phase": 1.0,
    }
    found = map_attractors(RECTANGLE, axes=given, max_cycles=50)
    assert found.kind.dims == ("width",)
    for name in ("height", "acceleration_m_s2", "frequency_hz", "phase"):
        assert found.attrs[name] == given[name]
        assert type(found.attrs[name]) is float
    assert not {"amplitude", "frequency_ratio"} & set(found.attrs)


def test_what_is_fixed_overrides_block_shaking_and_start() -> None:
    block = Block.rectangle(width=0.4, height=1.2, restitution=0.7)
    start = State(angle=0.1, velocity=0.2)
    fixed = {"restitution": 0.9, "amplitude": 3.0, "velocity": -0.1, "height": 1.5}
    found = map_attractors(block, SHAKING, axes={"phase": [0.0, 1.0], **fixed}, start=start)
    other = map_attractors(
        Block.rectangle(width=block.width, height=1.5, restitution=0.9),
        replace(SHAKING, amplitude=3.0),
        axes={"phase": [0.0, 1.0]},
        start=State(angle=0.1, velocity=-0.1),
    )
    assert found.equals(other)


@pytest.mark.parametrize("widths", [[0.3, 0.6, 0.9], [0.9, 0.6, 0.3]])
def test_a_harmonic_keeps_its_ratios_where_sizes_move(widths: list[float]) -> None:
    for block in (RECTANGLE, Block.rectangle(width=0.7, height=1.2, restitution=0.9)):
        found = map_attractors(
            block, SHAKING, axes={"width": widths, "height": 2.0}, max_cycles=100
        )
        for width in widths:
            there = Block.rectangle(width=width, height=2.0, restitution=0.9)
            cell = found.sel(width=width)
            same_as_alone(cell, there, SHAKING, start=None, cycles=100)


@every("number", range(CASES))
def test_every_cell_of_any_map_is_the_attractor_of_its_block_shaking_and_start(
    number: int,
) -> None:
    case = drawn_case(number)
    found = map_attractors(
        case.block,
        case.shaking,
        axes=case.named,
        start=case.start,
        max_cycles=60,
    )
    assert found.kind.dims == tuple(case.axes)
    for values in product(*case.axes.values()):
        cell = dict(zip(case.axes, values, strict=True))
        block, shaking, start = case.at(cell)
        same_as_alone(found.sel(cell), block, shaking, start=start, cycles=60)


def test_the_drawn_maps_hold_every_axis_every_start_and_one_to_four_dimensions() -> None:
    cases = [drawn_case(number) for number in range(CASES)]
    assert {name for case in cases for name in case.axes} == set(PARAMETERS_OF_MAPS)
    assert {type(case.start) for case in cases} == {Rest, State, Steady}
    assert {name for case in cases for name in case.fixed} == set(PARAMETERS_OF_MAPS)
    assert {len(case.axes) for case in cases} == {1, 2, 3, 4}
    assert {case.housner for case in cases} == {True, False}
    assert {case.shaking is None for case in cases} == {True, False}
    assert {type(case.block) for case in cases} == {Block, DimensionlessBlock}


@every(
    ("axes", "more", "valid"),
    [
        ({"amplitude": [2.0, -1.0]}, {}, "amplitude = -1.0 is not valid"),
        ({"frequency_ratio": [0.0]}, {}, "frequency_ratio = 0.0 is not valid"),
        ({"restitution": [0.5, 1.5]}, {}, "restitution = 1.5 is not valid"),
        ({"phase": [0.0, 1e7]}, {}, "phase = 10000000.0 is not valid"),
        ({"angle": [1e60]}, {}, "angle = 1e[+]60 is not valid"),
        ({"kick": [0.01, 0.2]}, {"start": Steady()}, "kick = 0.2 is not valid"),
        ({"phase": []}, {}, "one or more real numbers"),
        ({"phase": "abc"}, {}, "one or more real numbers"),
        ({"phase": 1.0}, {}, "a map has one axis or more"),
        ({"phase": [0.0], "amplitude": math.nan}, {}, "amplitude = nan is not valid"),
        ({"phase": [0.0], "amplitude": True}, {}, "amplitude = True is not valid"),
        ({"phase": [0.0], "amplitude": -1.0}, {}, "amplitude = -1.0 is not valid"),
        ({"phase": [0.0], "tilt": 1.0}, {}, "there is no parameter of that name"),
        (
            {"phase": [0.0], "amplitude": 1.0},
            {"motion": None},
            "only where its amplitude and its frequency",
        ),
        ({"phase": [0.0, math.nan]}, {}, "values of an axis are finite"),
        ({}, {}, "a map has one axis or more"),
        (["amplitude"], {}, "it names parameters"),
        (
            {"tilt": [1.0]},
            {},
            "axes = 'tilt' is not valid: there is no parameter of that name; choose",
        ),
        ({"phase": [0.0]}, {"start": "rest"}, "must be a Rest"),
        ({"phase": [0.0]}, {"max_cycles": 0}, "whole number"),
        ({"kick": [0.01]}, {"start": Steady(order=10**6 + 1)}, "order = 1000001 is not valid"),
        ({"phase": [0.0]}, {"motion": None}, "only where its amplitude and its frequency"),
        ({"width": [0.0, 0.4]}, {"block": RECTANGLE}, "width = 0.0 is not valid"),
        ({"alpha": [0.3, 1.6]}, {"block": RECTANGLE}, "alpha = 1.6 is not valid"),
        (
            {"width": [0.4, 3.0], "restitution": "housner"},
            {"block": RECTANGLE},
            "rocking needs one above 0",
        ),
        (
            {"frequency_hz": [1.0, 1e5]},
            {"block": RECTANGLE},
            "frequency_hz = 100000.0 is not valid",
        ),
        ({"acceleration_m_s2": [-1.0]}, {"block": RECTANGLE}, "acceleration_m_s2 = -1.0"),
    ],
)
def test_bad_values_are_refused(axes: Any, more: dict[str, Any], valid: str) -> None:
    given = {"block": BLOCK, "motion": SHAKING, **more}
    with pytest.raises(InputError, match=valid):
        map_attractors(axes=axes, **given)


@every(
    ("axes", "more", "valid"),
    [
        (("amplitude", "acceleration_m_s2"), {"block": RECTANGLE}, "one thing in two ways"),
        (("frequency_hz", "frequency_ratio"), {"block": RECTANGLE}, "one thing in two ways"),
        (("width", "alpha"), {"block": RECTANGLE}, "one thing in two ways"),
        (("radius", "p"), {"block": RECTANGLE}, "one thing in two ways"),
        (("width",), {}, "no size to measure by"),
        (("acceleration_m_s2",), {}, "no size to measure by"),
        (("phase",), {"housner": True}, "has no slenderness"),
        (("alpha",), {"block": RING}, "whose p\\^2 R/g is 3/4; of this block it is 0.5"),
        (("phase",), {"start": Steady()}, "a steady state to start on decides"),
        (("angle",), {"start": Steady()}, "a steady state to start on decides"),
        (("kick",), {}, "how far from a steady state"),
    ],
)
def test_what_does_not_go_together_is_refused(
    axes: tuple[str, ...], more: dict[str, Any], valid: str
) -> None:
    given = {"block": BLOCK, "motion": SHAKING, **more}
    whole: dict[str, Any] = {name: [0.05] for name in axes}
    first = axes[0] if len(axes) > 1 else "frequency_ratio"
    fixed: dict[str, Any] = {first: [0.05], axes[-1]: 0.05}
    housner = {"restitution": "housner"} if given.pop("housner", False) else {}
    for named in (whole | housner, fixed | housner):
        with pytest.raises(ModelError, match=valid) as caught:
            map_attractors(axes=named, **given)
        assert "\n" not in str(caught.value)


def test_only_its_sizes_are_refused_to_a_block_that_is_no_homogeneous_rectangle() -> None:
    axes = {"acceleration_m_s2": [4.0], "frequency_hz": [0.7], "phase": [0.0, 1.0]}
    found = map_attractors(RING, axes={**axes, "restitution": "housner"}, max_cycles=100)
    ratio = housner_restitution(RING.alpha, p=RING.p, radius=RING.radius, gravity=RING.gravity)
    assert found.attrs["restitution"] == ratio
    bare = DimensionlessBlock(restitution=ratio)
    shaking = Harmonic.from_si(RING, acceleration_m_s2=4.0, frequency_hz=0.7)
    for phase in (0.0, 1.0):
        cell = found.sel(acceleration_m_s2=4.0, frequency_hz=0.7, phase=phase)
        same_as_alone(cell, bare, replace(shaking, phase=phase), start=None, cycles=100)


def test_a_fixed_acceleration_and_frequency_take_the_place_of_the_shaking() -> None:
    ground = {"acceleration_m_s2": 4.0, "frequency_hz": 1.5}
    found = map_attractors(RECTANGLE, axes={"width": [0.3, 0.8], "height": 1.2, **ground})
    other = map_attractors(RECTANGLE, SHAKING, axes={"width": [0.3, 0.8], "height": 1.2, **ground})
    assert found.equals(other)
    for width in (0.3, 0.8):
        block = Block.rectangle(width=width, height=1.2, restitution=0.9)
        shaking = Harmonic.from_si(block, **ground)
        same_as_alone(found.sel(width=width), block, shaking, start=None, cycles=2000)


def test_where_no_number_says_how_an_unstable_state_is_left_there_is_no_start() -> None:
    start = Steady(order=3)
    axes = {"amplitude": [0.5, 5.0], "frequency_ratio": [0.01, 2.0]}
    found = map_attractors(BLOCK, axes=axes, start=start, max_cycles=20)
    shaking = Harmonic(amplitude=0.5, frequency_ratio=0.01)
    with pytest.raises(ModelError, match="no number determines how it is left"):
        find_attractor(BLOCK, shaking, start=start)
    for a, w in product(*axes.values()):
        cell = found.sel(amplitude=a, frequency_ratio=w)
        shaking = Harmonic(amplitude=a, frequency_ratio=w)
        same_as_alone(cell, BLOCK, shaking, start=start, cycles=20)
