"""Branches of the nonlinear model: against shooting by DOP853, the linear limit, and simulation."""

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
    simulate,
)
from rocksteady.branches import (
    Branch,
    BranchOptions,
    BranchPoint,
    find_branches,
    find_cascade,
    follow_bifurcation,
    follow_branch,
)
from rocksteady.errors import ModelError
from rocksteady.orbits import Orbit
from tests.dynamics.continuation.branches import first
from tests.dynamics.shooting import solved
from tests.every import every

MULTIPLIERS = {"fold": 1.0, "symmetry-breaking": -1.0, "period-doubling": -1.0, "grazing": None}
MERGED = 1e-9


def block_of(alpha: float, restitution: float) -> Block:
    return Block.from_p(alpha=alpha, p=3.0, restitution=restitution)


def start_of(
    block: Block | DimensionlessBlock,
    amplitude: float,
    frequency: float,
    *,
    order: int = 1,
    branch: int = 1,
    model: Linear | Nonlinear | None = None,
) -> Orbit:
    motion = Harmonic(amplitude=amplitude, frequency_ratio=frequency)
    equations = Nonlinear() if model is None else model
    found = find_orbits(block, motion, max_period=order, max_impacts=1, seeds=1, model=equations)
    return next(each for each in found if each.period == order and each.branch == branch)


def checked_events(branches: tuple[Branch, ...], parameter: str, *, longest: int) -> list[str]:
    """Hold the bifurcations of branches to shooting, and return their types."""
    kinds = []
    for branch in branches:
        for point in branch.bifurcations:
            merging = np.abs(point.chain.durations).min() < MERGED
            if merging or point.chain.impacts > longest:
                continue
            there = solved(point, parameter, MULTIPLIERS[point.type.value])
            assert getattr(point, parameter) == pytest.approx(there, abs=1e-10), point
            kinds.append(point.type.value)
    return kinds


@pytest.fixture(scope="module")
def leaning() -> tuple[Branch, ...]:
    """Branches with every type of bifurcation, n = 3, alpha 0.35."""
    start = start_of(block_of(0.35, 0.85), 3.5, 7.9, order=3, branch=2)
    return find_branches(
        [start], "frequency_ratio", (3.0, 8.0), max_period=3, max_impacts=8, max_branches=3
    )


@pytest.mark.slow
def test_bifurcations_are_those_of_shooting(leaning: tuple[Branch, ...]) -> None:
    kinds = checked_events(leaning, "frequency_ratio", longest=3)
    assert set(kinds) == {"fold", "symmetry-breaking", "grazing"}


def test_doublings_are_those_of_shooting() -> None:
    start = start_of(block_of(0.5, 0.8), 2.0, 2.2)
    branches = find_branches([start], "frequency_ratio", (1.3, 2.6), max_branches=3)
    kinds = checked_events(branches, "frequency_ratio", longest=4)
    assert kinds.count("period-doubling") == 3


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(6))
def test_bifurcations_of_drawn_blocks_are_those_of_shooting(seed: int) -> None:
    rng = np.random.default_rng(seed)
    alpha, restitution = rng.uniform(0.05, 0.6), rng.uniform(0.6, 0.92)
    order = int(rng.choice([1, 3]))
    parameter = ("amplitude", "frequency_ratio", "restitution")[seed % 3]
    amplitude, frequency = rng.uniform(1.5, 3.0), rng.uniform(2.0, 2.4) * (1.0 + 0.8 * (order > 1))
    within = {
        "amplitude": (0.4, 3.5),
        "frequency_ratio": (0.6 * frequency, 1.6 * frequency),
        "restitution": (0.4, 0.99),
    }[parameter]
    motion = Harmonic(amplitude=amplitude, frequency_ratio=frequency)
    found = find_orbits(
        block_of(alpha, restitution),
        motion,
        max_period=order,
        max_impacts=1,
        seeds=1,
        model=Nonlinear(),
    )
    branches = find_branches(
        [each for each in found if each.period == order],
        parameter,
        within,
        max_branches=8,
        max_period=2 * order,
        max_impacts=8,
    )
    checked_events(branches, parameter, longest=4)


def test_events_tend_to_the_linear_ones_as_the_square_of_the_slenderness() -> None:
    def events(block: Block | DimensionlessBlock, model: Linear | Nonlinear) -> list[float]:
        found = []
        start = start_of(block, 2.0, 2.2, model=model)
        breaking = first(
            follow_branch(start, "frequency_ratio", (1.5, 2.4), direction=-1), "symmetry-breaking"
        )
        broken = follow_branch(breaking, "frequency_ratio", (1.5, 2.4), switch=True)
        found += [breaking.frequency_ratio, first(broken, "period-doubling").frequency_ratio]
        start = start_of(block, 3.5, 7.0, order=3, branch=2, model=model)
        grazing = first(
            follow_branch(start, "frequency_ratio", (2.0, 8.0), direction=-1), "grazing"
        )
        found.append(grazing.frequency_ratio)
        # In amplitude downwards a symmetric branch turns back at a fold, eq 23.
        start = start_of(block, 2.0, 2.2, model=model)
        fold = first(
            follow_branch(start, "amplitude", (0.05, 2.5), direction=-1, inadmissible=True), "fold"
        )
        return [*found, fold.amplitude]

    straight = np.array(events(DimensionlessBlock(restitution=0.8), Linear()))
    coarse, fine = (
        np.array(events(block_of(alpha, 0.8), Nonlinear())) - straight for alpha in (0.04, 0.02)
    )
    assert np.abs(coarse).min() > 1e-5
    np.testing.assert_allclose(coarse / fine, 4.0, rtol=0.01)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("parameter", "within", "amplitude", "order"),
    [("amplitude", (0.2, 3.0), 2.0, 1), ("frequency_ratio", (3.0, 7.0), 3.0, 3)],
)
def test_a_diagram_of_a_very_slender_block_is_the_linear_one(
    parameter: str, within: tuple[float, float], amplitude: float, order: int
) -> None:
    straight, full = (
        find_bifurcations(
            block,
            Harmonic(amplitude=amplitude, frequency_ratio=2.0),
            parameter,
            within=within,
            values=0,
            search=BranchOptions(orders=(order,), doublings=0),
            model=model,
        )
        for block, model in (
            (DimensionlessBlock(restitution=0.85), Linear()),
            (block_of(1e-4, 0.85), Nonlinear()),
        )
    )
    assert len(straight.points) > 60  # folds, breakings, doublings and grazes of both kinds
    assert len(straight.branches) == len(full.branches)
    here, there = (
        sorted((each.point.type.value, getattr(each.point, parameter)) for each in found.points)
        for found in (straight, full)
    )
    assert [kind for kind, _ in here] == [kind for kind, _ in there]
    np.testing.assert_allclose(
        [value for _, value in here], [value for _, value in there], atol=1e-7
    )


def test_orbits_of_points_come_back_when_they_are_flown(leaning: tuple[Branch, ...]) -> None:
    seen = 0
    for branch in leaning:
        for point in branch.points[3::4]:
            if not point.admissible or point.type.value == "grazing":
                continue
            orbit = point.orbit
            assert isinstance(orbit.model, Nonlinear)
            assert orbit.block == point.block
            assert orbit.residual < 1e-9
            np.testing.assert_allclose(orbit.multipliers, point.multipliers, rtol=1e-6, atol=1e-6)
            size = abs(orbit.multipliers[0])
            assert orbit.highest == pytest.approx(point.peaks.max(), abs=1e-9)
            if size > 1e3:
                continue
            run = simulate(
                orbit.block,
                orbit.motion,
                start=orbit.start,
                cycles=orbit.period + 1,
                model=Nonlinear(),
            )
            period = 2.0 * math.pi * orbit.period / point.frequency_ratio
            there = run(0.4 * point.chain.durations[0] + np.array([0.0, period]))
            assert abs(np.diff(there.angle)) < 1e-10 * max(size, 1.0)
            assert abs(np.diff(there.velocity)) < 1e-10 * max(size, 1.0)
            seen += 1
    assert seen > 5


@pytest.mark.slow
def test_a_cascade_tends_to_feigenbaums_ratio() -> None:
    start = start_of(block_of(0.3, 0.8), 2.0, 2.0)
    found = find_cascade(start, "frequency_ratio", (1.6, 2.2), direction=-1, doublings=6)
    assert found.ratios[-1] == pytest.approx(4.6692, abs=0.01)
    assert found.model == Nonlinear()
    assert "nonlinear model, alpha 0.3 rad" in found.describe().headline
    doubling = found.points[1]
    assert doubling.frequency_ratio == pytest.approx(
        solved(doubling, "frequency_ratio", -1.0), abs=1e-10
    )


@pytest.mark.slow
@every("kind", ["fold", "symmetry-breaking", "grazing"])
def test_curves_in_two_parameters_are_those_of_shooting(
    leaning: tuple[Branch, ...], kind: str
) -> None:
    origin = next(
        point
        for branch in leaning
        for point in branch.bifurcations
        if point.type.value == kind and np.abs(point.chain.durations).min() > MERGED
    )
    plane = ("amplitude", "frequency_ratio")
    curve = list(follow_bifurcation(origin, plane, ((3.0, 4.0), (3.0, 8.0)), most_points=6))
    assert len(curve) > 4
    point = curve[4]
    assert abs(point.amplitude - origin.amplitude) > 1e-3
    assert point.frequency_ratio == pytest.approx(
        solved(point, "frequency_ratio", MULTIPLIERS[kind]), abs=1e-10
    )


def test_a_diagram_knows_its_model() -> None:
    block = block_of(0.25, 0.8)
    motion = Harmonic(amplitude=2.0, frequency_ratio=2.0)
    diagram = find_bifurcations(
        block,
        motion,
        "frequency_ratio",
        within=(1.7, 2.2),
        values=6,
        search=BranchOptions(doublings=2),
        model=Nonlinear(),
    )
    assert [each.point.type.value for each in diagram.points][:2] == [
        "symmetry-breaking",
        "period-doubling",
    ]
    told = diagram.describe()
    assert "nonlinear model, alpha 0.25 rad" in told.headline
    assert diagram.to_dict()["model"] == "nonlinear"
    assert all(sweep.model == Nonlinear() for sweep in diagram.sweeps)
    point = diagram.branches[0].points[0]
    assert point.to_dict()["alpha_rad"] == 0.25
    assert (point.model, point.block.dimensionless().restitution) == (Nonlinear(), 0.8)


def test_over_restitution_the_block_has_that_of_each_point() -> None:
    start = start_of(block_of(0.25, 0.8), 2.0, 2.0)
    points: list[BranchPoint] = list(follow_branch(start, "restitution", (0.7, 0.95)))
    assert all(point.block.dimensionless().restitution == point.restitution for point in points)
    assert points[-1].restitution == 0.95
    assert points[-1].orbit.block == points[-1].block


def test_a_block_without_slenderness_has_no_nonlinear_branches() -> None:
    with pytest.raises(ModelError, match="slenderness"):
        find_bifurcations(
            DimensionlessBlock(restitution=0.8),
            Harmonic(amplitude=2.0, frequency_ratio=2.0),
            "amplitude",
            model=Nonlinear(),
        )
