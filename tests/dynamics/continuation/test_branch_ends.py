"""Where branches end, what their points say, and what is refused."""

import math
from itertools import pairwise

import numpy as np
import pytest

from rocksteady import DimensionlessBlock, Harmonic, Steady, find_attractor, find_orbits
from rocksteady.branches import (
    BranchPoint,
    PointType,
    find_branches,
    find_cascade,
    follow_bifurcation,
    follow_branch,
)
from rocksteady.dynamics.continuation.chains.chain import Chain
from rocksteady.dynamics.continuation.points import Branch
from rocksteady.errors import InputError, ModelError
from rocksteady.formulas import steady_states, symmetry_breaking_amplitude
from rocksteady.orbits import compute_region_boundaries
from tests.dynamics.continuation.branches import (
    first,
    least_height,
    special,
    symmetric_start,
    unsymmetric_branch,
    values_of,
)
from tests.every import every

BLOCK = DimensionlessBlock(restitution=0.8)
PLANE = ("amplitude", "frequency_ratio")


@pytest.fixture(scope="module")
def leaning() -> list[BranchPoint]:
    return unsymmetric_branch()


# --------------------------------------------------------------------------- where branches end


def test_a_branch_ends_at_the_end_of_its_range_exactly() -> None:
    start = symmetric_start(1.0, 2.0, 0.8)
    for parameter, within in (
        ("amplitude", (0.9, 1.3)),
        ("frequency_ratio", (1.9, 2.7)),
        ("restitution", (0.7, 1.0)),
    ):
        for direction, end in ((1, within[1]), (-1, within[0])):
            *_, last = follow_branch(start, parameter, within, direction=direction)
            assert last.type == "end-of-range"
            assert getattr(last, parameter) == end
            states = steady_states(last.amplitude, last.frequency_ratio, last.restitution)
            here = last.chain.phases[0] + last.chain.turns[0] * math.pi
            assert math.cos(here - states.phase[0]) == pytest.approx(1.0, abs=1e-12)


def test_from_the_end_of_the_range_outwards_there_is_nothing() -> None:
    start = symmetric_start(1.0, 2.0, 0.8)
    points = list(follow_branch(start, "amplitude", (1.0, 2.0), direction=-1))
    assert [point.type.value for point in points] == ["regular", "end-of-range"]
    assert points[1].amplitude == 1.0


def test_without_loss_nothing_is_stable() -> None:
    *_, last = follow_branch(symmetric_start(1.0, 2.0, 0.8), "restitution", (0.7, 1.0))
    assert last.restitution == 1.0
    assert not last.stable
    assert abs(last.multipliers) == pytest.approx(1.0, abs=1e-12)


def test_inadmissible_solutions_are_followed_if_they_are_asked_for() -> None:
    start = symmetric_start(1.1 * 1.61999, 6.0, 0.8, order=3)
    short = list(follow_branch(start, "amplitude", (1.0, 6.0)))
    long = list(follow_branch(start, "amplitude", (1.0, 6.0), inadmissible=True))
    assert short[-1].type == "symmetry-breaking" or short[-1].type in ("grazing", "end-of-range")
    through = list(follow_branch(start, "amplitude", (1.0, 6.0), direction=-1, inadmissible=True))
    stops = list(follow_branch(start, "amplitude", (1.0, 6.0), direction=-1))
    assert stops[-1].type == "grazing"
    assert through[-1].type == "end-of-range"
    assert len(long) >= len(short)
    graze = first(through, "grazing")
    assert graze.amplitude == pytest.approx(stops[-1].amplitude, rel=1e-13)
    beyond = through[through.index(graze) + 1 :]
    assert not any(point.admissible or point.stable for point in beyond)
    for point in beyond[::5]:
        assert least_height(point) < 0.0
        with pytest.raises(ModelError, match="no motion"):
            _ = point.orbit


def test_from_a_graze_a_branch_goes_where_there_are_motions_or_ends() -> None:
    start = symmetric_start(2.0, 6.0, 0.8, order=3)
    *_, graze = follow_branch(start, "amplitude", (1.0, 6.0), direction=-1)
    assert graze.type == "grazing"
    into = list(follow_branch(graze, "amplitude", (1.0, 6.0), direction=1))
    back = list(follow_branch(graze, "amplitude", (1.0, 6.0), direction=-1))
    assert [point.type.value for point in into] == ["grazing"]
    assert all(point.admissible for point in back)
    assert [point.type.value for point in special(back)][:2] == ["grazing", "fold"]
    asked = list(follow_branch(graze, "amplitude", (1.0, 6.0), inadmissible=True))
    assert not any(point.admissible for point in asked[1:])


def test_from_a_fold_both_sides_can_be_followed() -> None:
    start = symmetric_start(2.0, 6.0, 0.8, order=3)
    fold = first(follow_branch(start, "amplitude", (1.0, 3.0), direction=-1), "fold")
    ends = []
    for direction in (1, -1):
        points = list(follow_branch(fold, "amplitude", (1.0, 3.0), direction=direction))
        assert [point.type.value for point in special(points)] == ["fold", "end-of-range"]
        amplitudes = [point.amplitude for point in points]
        assert all(b > a for a, b in pairwise(amplitudes))
        ends.append(points[-1])
    states = steady_states(3.0, 6.0, 0.8, order=3)
    phases = sorted(end.chain.phases[0] for end in ends)
    assert phases == pytest.approx(sorted(states.phase), abs=1e-12)


def test_a_branch_of_so_many_points_ends_there() -> None:
    start = symmetric_start(1.0, 2.0, 0.8)
    points = list(follow_branch(start, "amplitude", (0.1, 3.0), most_points=5))
    assert [point.type.value for point in points] == ["regular"] * 5 + ["limit"]
    on = list(follow_branch(points[-1], "amplitude", (0.1, 3.0)))
    assert first(on, "symmetry-breaking").amplitude == pytest.approx(
        float(symmetry_breaking_amplitude(2.0, 0.8)), rel=1e-12
    )


# ---------------------------------------------------------------------------------------- results


def test_a_branch_as_arrays(leaning: list[BranchPoint]) -> None:
    branch = Branch(parameter="frequency_ratio", points=tuple(leaning))
    count = len(leaning)
    assert branch.values.shape == branch.stable.shape == branch.admissible.shape == (count,)
    assert branch.peaks.shape == (count, 2)
    # It begins at the symmetric orbit, drawn once for each flight.
    assert branch.peaks[0, 0] == -branch.peaks[0, 1] > 0.0
    assert branch.peaks[0] == pytest.approx(branch.peaks[1], abs=0.2)
    assert [point.type.value for point in branch.bifurcations][:2] == [
        "symmetry-breaking", "period-doubling"
    ]  # fmt: skip
    assert (branch.period, branch.impacts, branch.symmetric) == (1, 2, False)
    assert not branch.stable[0]
    assert branch.stable[1]


def test_what_a_point_says_of_itself() -> None:
    start = symmetric_start(2.0, 6.0, 0.8, order=3)
    point = next(follow_branch(start, "amplitude", (1.0, 3.0)))
    assert point.type is PointType.REGULAR
    assert (point.kind, point.symmetric, point.period, point.impacts) == ("symmetric", True, 3, 2)
    assert values_of(point) == pytest.approx([2.0, 6.0, 0.8])
    assert point.multipliers == pytest.approx(start.multipliers, rel=1e-9)
    assert point.peaks == pytest.approx([start.highest, start.lowest], rel=1e-9)


# ------------------------------------------------------------------------------------- refusals


@every(
    ("change", "said"),
    [
        ({"parameter": "amp"}, "parameter = 'amp'"),
        ({"parameter": None}, "parameter = None"),
        ({"within": (3.0, 0.1)}, "below its upper end"),
        ({"within": 0.1}, "two numbers"),
        ({"within": (0.1, 0.5)}, "it must hold the amplitude of the start, 1"),
        ({"within": (-0.1, 3.0)}, "amplitude = -0.1"),
        ({"within": (math.nan, 3.0)}, "within = nan"),
        ({"within": (0.1, "3")}, "within = '3'"),
        ({"parameter": "restitution", "within": (0.5, 1.1)}, "restitution = 1.1"),
        ({"parameter": "frequency_ratio", "within": (0.0, 3.0)}, "frequency_ratio = 0"),
        ({"direction": 0}, "direction = 0"),
        ({"direction": True}, "direction = True"),
        ({"direction": np.array([1, 1])}, "direction = array"),
        ({"largest_step": 0.0}, "largest_step = 0"),
        ({"largest_step": 0.3}, "largest_step = 0.3"),
        ({"most_points": 0}, "most_points = 0"),
        ({"origin": None}, "origin = None"),
    ],
)
def test_what_is_out_of_range_is_refused_at_once_and_in_one_line(
    change: dict[str, object], said: str
) -> None:
    given: dict[str, object] = {
        "origin": symmetric_start(1.0, 2.0, 0.8),
        "parameter": "amplitude",
        "within": (0.1, 3.0),
        **change,
    }
    start, parameter, within = given.pop("origin"), given.pop("parameter"), given.pop("within")
    with pytest.raises(InputError) as raised:
        follow_branch(start, parameter, within, **given)  # type: ignore[arg-type]
    assert said in str(raised.value)
    assert "\n" not in str(raised.value)


def test_what_is_no_motion_or_comes_to_rest_is_refused() -> None:
    floor = symmetric_start(3.0, 4.0, 0.8, branch=2)
    assert not floor.admissible
    with pytest.raises(ModelError, match="passes through the floor"):
        follow_branch(floor, "amplitude", (1.0, 4.0))
    assert list(follow_branch(floor, "amplitude", (2.9, 3.1), inadmissible=True))
    block, shaking = (
        DimensionlessBlock(restitution=0.5),
        Harmonic(amplitude=1.1, frequency_ratio=2.0),
    )
    rests = [each for each in find_orbits(block, shaking, seeds=4) if each.rest_phases]
    with pytest.raises(ModelError, match="comes to rest"):
        follow_branch(rests[0], "amplitude", (0.5, 2.0))


def test_a_regular_point_has_nothing_to_switch_to() -> None:
    start = symmetric_start(1.0, 2.0, 0.8)
    with pytest.raises(ModelError, match="no other branch"):
        follow_branch(start, "amplitude", (0.5, 2.0), switch=True)


# --------------------------------------------------------------------------- ended by rounding


@pytest.fixture(scope="module")
def doublings() -> tuple[BranchPoint, ...]:
    shaking = Harmonic(amplitude=2.0, frequency_ratio=2.0)
    orbit = find_attractor(BLOCK, shaking, start=Steady()).orbit
    assert orbit is not None
    within = (1.5, 2.1)
    return find_cascade(orbit, "frequency_ratio", within, direction=-1, doublings=2).points


@pytest.mark.slow
@every("lowest", [0.2, 0.3])
@every("which", [0, 1])
def test_a_curve_that_runs_into_endless_half_cycles_ends_there(
    doublings: tuple[BranchPoint, ...], which: int, lowest: float
) -> None:
    # At Omega = 0.2 a difference grows by e^(5 pi) in half a cycle, in two of them by 4e13.
    within = ((0.02, 8.0), (lowest, 14.0))
    curve = list(follow_bifurcation(doublings[which], PLANE, within, direction=-1))
    assert curve[-1].type in (PointType.LOST, PointType.RANGE_END, PointType.GRAZING)
    assert curve[-1].frequency_ratio < 0.5
    assert all(point.type is PointType.PERIOD_DOUBLING for point in curve[:-1])


@pytest.mark.slow
@pytest.mark.parametrize("ratio", [6.0, 12.0])
def test_branches_with_a_graze_beside_a_merging_end_without_an_error(ratio: float) -> None:
    # Brent's method halves its bracket here so seldom that it takes more than 100 steps.
    low = float(compute_region_boundaries(ratio, 0.8, order=3).existence)
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
    edge = float(compute_region_boundaries(4.5, 0.87, order=3).existence)
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
