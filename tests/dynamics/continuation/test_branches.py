"""All branches that hang together: none twice, none lost, against orbits found by search."""

import math

import numpy as np
import pytest

from rocksteady import DimensionlessBlock, Harmonic, find_orbits
from rocksteady.branches import Branch, BranchPoint, find_branches, follow_branch
from rocksteady.dynamics.continuation.chains.chain import Chain
from rocksteady.dynamics.continuation.from_orbit import chain_of
from rocksteady.dynamics.parameters import PARAMETERS
from rocksteady.errors import InputError, ModelError
from rocksteady.orbits import Orbit
from tests.dynamics.continuation.branches import setting, special, symmetric_start, values_of
from tests.every import every

WITHIN = (1.6, 4.5)


@pytest.fixture(scope="module")
def starts() -> list[Orbit]:
    found = find_orbits(*setting((2.0, 2.2, 0.8)), max_period=3, max_impacts=6, seeds=40)
    return [each for each in found if not each.rest_phases]


@pytest.fixture(scope="module")
def branches(starts: list[Orbit]) -> tuple[Branch, ...]:
    return find_branches(starts, "frequency_ratio", WITHIN, max_period=3, max_impacts=8)


def chains_at(branch: Branch, value: float) -> list[Chain]:
    """Return the orbits of a branch at a value of its parameter, each continued to there."""
    found = []
    values = branch.values
    for k in range(len(values) - 1):
        low, high = sorted((values[k], values[k + 1]))
        if not low <= value <= high or low == high:
            continue
        ends = [branch.points[k], branch.points[k + 1]]
        if len({each.chain.impacts for each in ends}) > 1 or ends[0].type == "fold":
            continue
        direction = 1 if values[k + 1] > values[k] else -1
        within = (low, value) if direction > 0 else (value, high)
        if within[0] == within[1]:
            continue
        *_, end = follow_branch(
            ends[0], branch.parameter, within, direction=direction, inadmissible=True
        )
        if getattr(end, branch.parameter) == value:
            found.append(end.chain)
    return found


@pytest.mark.slow
def test_no_branch_is_followed_twice(branches: tuple[Branch, ...]) -> None:
    assert len(branches) > 8
    for value in (1.72, 1.9, 2.4, 2.7):
        chains = [chain for branch in branches for chain in chains_at(branch, value)]
        assert chains
        for i, one in enumerate(chains):
            for other in chains[:i]:
                assert not one.repeats(other, 1e-5, mirrors=True)


def test_every_start_lies_on_a_branch(branches: tuple[Branch, ...], starts: list[Orbit]) -> None:
    chains = [chain for branch in branches for chain in chains_at(branch, 2.2)]
    for start in starts:
        if start.admissible:
            chain = chain_of(start)
            assert sum(chain.repeats(each, 1e-7, mirrors=True) for each in chains) == 1


@pytest.mark.slow
@every("frequency", [1.85, 2.05, 2.6, 3.3])
def test_stable_orbits_elsewhere_lie_on_a_branch(
    branches: tuple[Branch, ...], frequency: float
) -> None:
    found = find_orbits(*setting((2.0, frequency, 0.8)), max_period=3, max_impacts=6, seeds=40)
    chains = [chain for branch in branches for chain in chains_at(branch, frequency)]
    stable = [each for each in found if each.stable and not each.rest_phases]
    assert stable
    for orbit in stable:
        assert any(chain_of(orbit).repeats(each, 1e-7, mirrors=True) for each in chains)


def test_branches_hang_together_and_keep_their_limits(branches: tuple[Branch, ...]) -> None:
    for branch in branches:
        assert branch.parameter == "frequency_ratio"
        assert branch.period <= 3
        assert branch.impacts <= 8
        assert branch.values.min() >= WITHIN[0]
        assert branch.values.max() <= WITHIN[1]
        assert branch.admissible.all()
        lengths = np.diff([point.arclength for point in branch.points])
        assert (lengths >= -1e-12).all()
        assert np.isfinite(branch.peaks).all()
    # A branch that begins at a doubling or a breaking begins at one of another branch.
    ends: list[BranchPoint] = [point for branch in branches for point in special(branch.points)]
    for branch in branches:
        begin = branch.points[0]
        if begin.type not in ("symmetry-breaking", "period-doubling"):
            continue
        same = [
            point
            for point in ends
            if point.type == begin.type
            and np.abs(values_of(point) - values_of(begin)).max() < 1e-9
            and point.chain.impacts == begin.chain.impacts
        ]
        assert len(same) >= 2


@pytest.mark.slow
def test_shorter_steps_find_the_same_branches(
    branches: tuple[Branch, ...], starts: list[Orbit]
) -> None:
    again = find_branches(
        starts, "frequency_ratio", WITHIN, max_period=3, max_impacts=8, largest_step=0.008
    )
    assert len(again) == len(branches)
    for one, other in zip(branches, again, strict=True):
        assert [p.type for p in special(one.points)] == [p.type for p in special(other.points)]
        values = [[p.frequency_ratio for p in special(each.points)] for each in (one, other)]
        assert values[0] == pytest.approx(values[1], rel=1e-10)


@pytest.mark.slow
def test_a_cascade_is_gone_through_up_to_the_period_asked_for() -> None:
    start = symmetric_start(2.0, 2.0, 0.8)
    for longest in (1, 2, 4, 8):
        found = find_branches(
            [start], "frequency_ratio", (1.7, 2.1), max_period=longest, max_impacts=2 * longest
        )
        periods = [branch.period for branch in found]
        assert max(periods) == longest
        assert sorted(set(periods)) == [2**k for k in range(int(math.log2(longest)) + 1)]


def test_where_a_symmetric_orbit_grazes_orbits_that_lean_begin_too(
    branches: tuple[Branch, ...],
) -> None:
    # With the two new impacts in both of its halves, or in one alone.
    grazes = {
        point.frequency_ratio
        for branch in branches
        for point in branch.points
        if point.type == "grazing" and point.symmetric and point.impacts == 2
    }
    assert len(grazes) == 1
    (graze,) = grazes
    begun = [
        branch
        for branch in branches
        if branch.impacts > 2 and abs(branch.points[0].frequency_ratio - graze) < 1e-9
    ]
    both, leaning = sorted(begun, key=lambda branch: not branch.symmetric)
    assert [(each.impacts, each.symmetric) for each in (both, leaning)] == [(6, True), (4, False)]
    orbit = leaning.points[len(leaning.points) // 2].orbit
    assert (orbit.impacts, orbit.symmetric) == (4, False)
    assert orbit.residual < 1e-9 * max(1.0, orbit.largest_multiplier)


def test_limits_and_order() -> None:
    start = symmetric_start(2.0, 2.0, 0.8)
    few = find_branches([start], "frequency_ratio", (1.7, 2.1), max_branches=2)
    assert [branch.symmetric for branch in few] == [True, False]
    twice = find_branches(
        [start, start], "frequency_ratio", (1.7, 2.1), max_period=1, max_impacts=2
    )
    once = find_branches([start], "frequency_ratio", (1.7, 2.1), max_period=1, max_impacts=2)
    assert len(twice) == len(once)
    assert find_branches([], "frequency_ratio", (1.7, 2.1)) == ()
    point = once[1].points[5]
    from_a_point = find_branches(
        [point], "frequency_ratio", (1.7, 2.1), max_period=1, max_impacts=2
    )
    assert len(from_a_point) >= 1


@every("parameter", PARAMETERS)
def test_any_parameter(parameter: str) -> None:
    within = {"amplitude": (1.0, 3.0), "frequency_ratio": (1.7, 3.0), "restitution": (0.6, 0.95)}
    start = symmetric_start(2.0, 2.0, 0.8)
    found = find_branches([start], parameter, within[parameter], max_period=2)
    assert found[0].symmetric
    assert {branch.parameter for branch in found} == {parameter}


@every(
    ("change", "said"),
    [
        ({"max_period": 0}, "max_period = 0"),
        ({"max_impacts": 1.5}, "max_impacts = 1.5"),
        ({"max_branches": None}, "max_branches = None"),
        ({"origins": 3}, "origins = 3"),
        ({"origins": [3]}, "origins = [3]"),
        ({"within": (3.0, 2.0)}, "below its upper end"),
        ({"parameter": "mass"}, "parameter = 'mass'"),
        ({"largest_step": 0.0}, "largest_step = 0"),
    ],
)
def test_what_is_out_of_range_is_refused(change: dict[str, object], said: str) -> None:
    given: dict[str, object] = {
        "origins": [symmetric_start(2.0, 2.0, 0.8)],
        "parameter": "frequency_ratio",
        "within": (1.7, 2.1),
        **change,
    }
    with pytest.raises(InputError) as raised:
        find_branches(**given)  # type: ignore[arg-type]
    assert said in str(raised.value)
    assert "\n" not in str(raised.value)


def test_an_orbit_with_rests_is_refused() -> None:
    block, shaking = (
        DimensionlessBlock(restitution=0.5),
        Harmonic(amplitude=1.1, frequency_ratio=2.0),
    )
    found = [each for each in find_orbits(block, shaking, seeds=4) if each.rest_phases]
    with pytest.raises(ModelError, match="comes to rest"):
        find_branches(found, "amplitude", (0.5, 2.0))


@pytest.mark.parametrize("within", [(2.0, 3.0), (1.0, 2.0)])
def test_a_start_at_an_end_of_the_range_is_that_end_and_stands_once(
    within: tuple[float, float],
) -> None:
    start = symmetric_start(2.0, 2.0, 0.8)
    first, *_ = find_branches([start], "frequency_ratio", within, max_period=1)
    at_start = [point for point in first.points if point.frequency_ratio == 2.0]
    assert [point.type.value for point in at_start] == ["end-of-range"]
    assert {first.points[0].type, first.points[-1].type} == {at_start[0].type}


def test_a_start_inside_the_range_is_a_point_of_its_branch() -> None:
    start = symmetric_start(2.0, 2.0, 0.8)
    for parameter, value in (("amplitude", 2.0), ("restitution", 0.8)):
        within = (0.99 * value, 1.01 * value)
        first, *_ = find_branches([start], parameter, within, max_period=1)
        (here,) = (point for point in first.points if point.arclength == 0.0)
        assert getattr(here, parameter) == value
        assert here.chain.repeats(chain_of(start), 1e-12)
