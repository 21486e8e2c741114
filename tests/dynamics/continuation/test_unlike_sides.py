"""Branches of blocks whose sides differ: mirror images, the symmetric limit, and shooting."""

import math

import numpy as np
import pytest

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    Linear,
    Nonlinear,
    find_bifurcations,
    find_orbits,
)
from rocksteady.branches import Branch, find_branches, follow_branch
from rocksteady.errors import InputError, ModelError
from rocksteady.orbits import Orbit
from tests.dynamics.continuation.branches import first
from tests.dynamics.continuation.test_nonlinear_branches import checked_events

RANGE = (1.4, 2.8)
MODELS = (Linear(), Nonlinear())


def block_of(left: float, right: float, restitution: tuple[float, float]) -> Block:
    return Block.asymmetric(left=left, right=right, height=1.2, restitution=restitution)


def starts(block: Block | DimensionlessBlock, model: Linear | Nonlinear) -> list[Orbit]:
    motion = Harmonic(amplitude=2.2, frequency_ratio=2.3)
    found = find_orbits(block, motion, max_period=1, max_impacts=2, seeds=16, model=model)
    return [each for each in found if each.admissible and not each.rest_phases]


def branches_of(block: Block, model: Linear | Nonlinear, frequency: float = 1.0) -> list[Branch]:
    within = (RANGE[0] * frequency, RANGE[1] * frequency)
    found = find_branches(starts(block, model), "frequency_ratio", within, max_branches=4)
    return list(found)


@pytest.mark.slow
def test_bifurcations_are_those_of_shooting() -> None:
    branches = branches_of(block_of(0.15, 0.2, (0.85, 0.8)), Nonlinear())
    kinds = checked_events(tuple(branches), "frequency_ratio", longest=4)
    assert kinds.count("period-doubling") >= 3
    for branch in branches:
        assert not branch.symmetric
        for point in branch.points[::7]:
            determinant = math.prod(complex(m).real for m in point.multipliers)
            if np.isreal(point.multipliers).all():
                exact = (0.85 * 0.8) ** point.impacts
                assert determinant == pytest.approx(exact, rel=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("model", MODELS)
def test_exchanged_sides_give_the_mirror_image(model: Linear | Nonlinear) -> None:
    block, image = block_of(0.15, 0.2, (0.85, 0.8)), block_of(0.2, 0.15, (0.8, 0.85))
    # Amplitude and frequency count in units of the positive side.
    lean = image.positive.alpha / block.positive.alpha
    rate = image.positive.p / block.positive.p
    (start,) = starts(block, model)
    motion = Harmonic(amplitude=2.2 / lean, frequency_ratio=2.3 / rate)
    found = find_orbits(image, motion, max_period=1, max_impacts=2, seeds=16, model=model)
    (other,) = (each for each in found if each.admissible and not each.rest_phases)
    for parameter, within, scale in (
        ("frequency_ratio", RANGE, rate),
        ("amplitude", (1.5, 3.9), lean),
    ):
        mine = find_branches([start], parameter, within, max_branches=3)
        theirs = find_branches(
            [other], parameter, (within[0] / scale, within[1] / scale), max_branches=3
        )
        assert len(mine) == len(theirs)
        for one, two in zip(mine, theirs, strict=True):
            here, there = one.bifurcations, two.bifurcations
            assert [each.type for each in here] == [each.type for each in there]
            for point, twin in zip(here, there, strict=True):
                assert getattr(point, parameter) == pytest.approx(
                    scale * getattr(twin, parameter), abs=1e-9
                )
                assert sorted(point.peaks) == pytest.approx(sorted(-lean * twin.peaks), abs=1e-6)
        assert any(one.bifurcations for one in mine)


def test_sides_that_hardly_differ_give_the_branches_of_like_ones() -> None:
    # The doubling of the orbits that lean, of the closed chain of both halves: as published.
    block = DimensionlessBlock(restitution=0.8, alpha_ratio=1.0 + 1e-9)
    motion = Harmonic(amplitude=2.0, frequency_ratio=1.85)
    found = find_orbits(block, motion, max_period=1, max_impacts=2, seeds=16)
    leaning = [each for each in found if each.admissible and each.stable]
    assert len(leaning) == 2  # mirror images but for 1e-9: both are listed
    for start in leaning:
        points = list(follow_branch(start, "frequency_ratio", (1.7, 1.9), direction=-1))
        doubling = first(points, "period-doubling")
        assert doubling.frequency_ratio == pytest.approx(1.789272022957, abs=1e-7)
        # Upwards there is no symmetry left to win: one passes by, one turns back at a fold.
        onwards = list(follow_branch(start, "frequency_ratio", (1.8, 2.2)))
        kinds = {point.type.value for point in onwards}
        assert "symmetry-breaking" not in kinds
        turning = [each for each in onwards if each.type.value == "fold"]
        for fold in turning:
            assert fold.frequency_ratio == pytest.approx(1.948377644, abs=1e-4)
        assert not any(each.symmetric for each in points)


def test_branches_of_other_blocks_hold_no_orbit() -> None:
    one, other = block_of(0.15, 0.2, (0.85, 0.85)), block_of(0.15, 0.21, (0.85, 0.85))
    for model in MODELS:
        origins = [*starts(one, model), *starts(other, model)]
        found = find_branches(origins, "frequency_ratio", (2.28, 2.4), max_period=1)
        assert len(found) == 2
        assert found[0].block == one
        assert found[1].block == other
    mixed = [*starts(one, Linear()), *starts(one, Nonlinear())]
    found = find_branches(mixed, "frequency_ratio", (2.28, 2.4), max_period=1)
    assert [each.model.name for each in found] == ["linear", "nonlinear"]


def test_the_restitution_of_unlike_impacts_is_no_parameter() -> None:
    (start,) = starts(block_of(0.15, 0.2, (0.85, 0.8)), Linear())
    with pytest.raises(ModelError, match=r"differs, 0\.85 and 0\.8") as raised:
        follow_branch(start, "restitution", (0.7, 0.9))
    assert "\n" not in str(raised.value)
    with pytest.raises(InputError, match="impulse"):
        follow_branch(start, "impulse", (0.7, 0.9))


@pytest.mark.parametrize("model", [Linear(), pytest.param(Nonlinear(), marks=pytest.mark.slow)])
def test_a_diagram_of_unlike_sides_has_its_doublings(model: Linear | Nonlinear) -> None:
    block = block_of(0.15, 0.2, (0.85, 0.85))
    diagram = find_bifurcations(
        block,
        Harmonic(amplitude=2.2, frequency_ratio=2.0),
        "frequency_ratio",
        within=RANGE,
        values=0,
        model=model,
    )
    assert diagram.cascade is not None
    assert diagram.cascade.ratios[-1] == pytest.approx(4.67, abs=0.05)
    assert "mirror" not in str(diagram.describe().notes)
    over = find_bifurcations(
        block,
        Harmonic(amplitude=2.2, frequency_ratio=2.1),
        "restitution",
        within=(0.7, 0.95),
        values=0,
        model=model,
    )
    for branch in over.branches:
        assert all(
            {kept for kept, _, _ in point.block.dimensionless().sides} == {point.restitution}
            for point in branch.points
        )
