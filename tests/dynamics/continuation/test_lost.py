"""Branches and curves that rounding ends: they say so, and nothing is raised."""

import numpy as np
import pytest

from rocksteady import (
    BranchPoint,
    DimensionlessBlock,
    Harmonic,
    PointType,
    Steady,
    find_attractor,
    find_branches,
    find_cascade,
    find_orbits,
    follow_bifurcation,
    follow_branch,
    region_boundaries,
    symmetry_breaking_amplitude,
)
from rocksteady.dynamics.continuation._chain import Chain

BLOCK = DimensionlessBlock(restitution=0.8)
PLANE = ("amplitude", "frequency_ratio")


@pytest.fixture(scope="module")
def doublings() -> tuple[BranchPoint, ...]:
    shaking = Harmonic(amplitude=2.0, frequency_ratio=2.0)
    orbit = find_attractor(BLOCK, shaking, start=Steady()).orbit
    assert orbit is not None
    within = (1.5, 2.1)
    return find_cascade(orbit, "frequency_ratio", within, direction=-1, doublings=2).points


@pytest.mark.parametrize("lowest", [0.2, 0.3])
@pytest.mark.parametrize("which", [0, 1])
def test_a_curve_that_runs_into_endless_half_cycles_ends_there(
    doublings: tuple[BranchPoint, ...], which: int, lowest: float
) -> None:
    # At Omega = 0.2 a difference grows by e^(5 pi) in half a cycle, in two of them by 4e13.
    within = ((0.02, 8.0), (lowest, 14.0))
    curve = list(follow_bifurcation(doublings[which], PLANE, within, direction=-1))
    assert curve[-1].type in (PointType.LOST, PointType.RANGE_END, PointType.GRAZING)
    assert curve[-1].frequency_ratio < 0.5
    assert all(point.type is PointType.PERIOD_DOUBLING for point in curve[:-1])


@pytest.mark.parametrize("ratio", [6.0, 12.0])
def test_branches_with_a_graze_beside_a_merging_end_without_an_error(ratio: float) -> None:
    # Brent's method halves its bracket here so seldom that it takes more than 100 steps.
    low = float(region_boundaries(ratio, 0.8, order=3).existence)
    high = float(symmetry_breaking_amplitude(ratio, 0.8, order=3))
    shaking = Harmonic(amplitude=0.7 * low + 0.3 * high, frequency_ratio=ratio)
    found = find_orbits(BLOCK, shaking, max_period=3, max_impacts=1, seeds=1)
    starts = [orbit for orbit in found if orbit.period == 3 and orbit.branch == 1]
    within = (0.9 * low, 2.0 * high)
    branches = find_branches(
        starts, "amplitude", within, max_period=6, max_impacts=16, max_branches=12
    )
    assert branches[0].symmetric
    assert branches[0].stable.any()


def test_what_gets_nowhere_is_stalled_and_says_where_and_why(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    # With the chain's own sizes the test of a fold jumps from -1 to 1 where half cycles are long.
    monkeypatch.setattr(
        Chain,
        "scaled_determinant",
        lambda self, closing, sizes: float(  # noqa: ARG005 -- called with three
            np.linalg.det(self.matrix(closing) / self.sizes[:, np.newaxis])
        ),
    )
    block = DimensionlessBlock(restitution=0.87)
    edge = float(region_boundaries(4.5, 0.87, order=3).existence)
    shaking = Harmonic(amplitude=1.1 * edge, frequency_ratio=4.5)
    found = find_orbits(block, shaking, max_period=3, max_impacts=2, seeds=1)
    start = next(orbit for orbit in found if orbit.period == 3 and orbit.symmetric)
    branch = follow_branch(start, "amplitude", (0.02, 8.0), direction=-1)
    fold = next(point for point in branch if point.type is PointType.FOLD)
    curve = list(follow_bifurcation(fold, PLANE, ((0.02, 8.0), (0.5, 8.0)), direction=-1))
    assert len(curve) < 1500
    end = curve[-1]
    assert end.type is PointType.STALLED
    assert "shorter than the largest one" in end.reason
    assert 0.5 < end.frequency_ratio < 0.6
    assert curve[0].reason == ""
