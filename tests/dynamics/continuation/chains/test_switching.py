"""Branches that begin at bifurcations: how they leave, and that they meet known orbits."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rocksteady import find_attractor, find_orbits
from rocksteady.branches import BranchPoint, PointType, follow_branch
from rocksteady.dynamics.continuation.chains.switching import switched
from rocksteady.dynamics.continuation.from_orbit import chain_of
from rocksteady.dynamics.orbits.return_map import make_system, section_of
from rocksteady.errors import ModelError
from rocksteady.kernels.orbits import periodic
from rocksteady.model.equations import Linear
from tests.dynamics.continuation.branches import (
    first,
    setting,
    special,
    symmetric_start,
    unsymmetric_branch,
    values_of,
)
from tests.every import every

FREQUENCIES = (1.6, 2.1)


@pytest.fixture(scope="module")
def leaning() -> list[BranchPoint]:
    return unsymmetric_branch()


@pytest.fixture(scope="module")
def doubled(leaning: list[BranchPoint]) -> list[BranchPoint]:
    doubling = first(leaning, "period-doubling")
    return list(follow_branch(doubling, "frequency_ratio", FREQUENCIES, switch=True))


def leaves_like_a_root(points: list[BranchPoint], parent: BranchPoint) -> None:
    """Check that the first orbits lie about as far from the parent as the root of the way."""
    twice = parent.chain.doubled()
    ratios = []
    for point in points[1:6]:
        away = abs(point.frequency_ratio - parent.frequency_ratio)
        ratios.append(point.chain.distance(twice) ** 2 / away)
    assert min(ratios) > 0.0
    assert max(ratios) < 1.3 * min(ratios)


def test_at_a_breaking_two_leaning_orbits_leave_like_a_root(leaning: list[BranchPoint]) -> None:
    breaking = leaning[0]
    assert breaking.type == "symmetry-breaking"
    leaves_like_a_root(leaning, breaking)
    for point in leaning[1:8]:
        assert not point.symmetric
        assert (point.period, point.impacts) == (1, 2)
        assert point.stable  # a supercritical pitchfork: it takes the stability over
    # What leans to the other side is the mirror image.
    one, other = leaning[5].orbit, leaning[5].orbit.mirrored
    assert one.highest == pytest.approx(-other.lowest)
    assert abs(one.highest + one.lowest) > 0.01


def test_at_a_doubling_orbits_of_twice_the_period_leave_like_a_root(
    leaning: list[BranchPoint], doubled: list[BranchPoint]
) -> None:
    doubling = first(leaning, "period-doubling")
    assert doubled[0].frequency_ratio == doubling.frequency_ratio
    leaves_like_a_root(doubled, doubling)
    for point in doubled[1:6]:
        assert (point.period, point.impacts, point.symmetric) == (2, 4, False)
        assert point.stable
        orbit = point.orbit
        assert orbit.period == 2
        assert orbit.residual < 1e-11
        found = find_attractor(orbit.block, orbit.motion, start=orbit.start)
        assert found.period == 2


def test_the_printed_doubled_attractor_lies_on_the_doubled_branch(
    doubled: list[BranchPoint],
) -> None:
    # TW7: period-doubled at Omega = 1.78.
    found = [each for each in find_orbits(*setting((2.0, 1.78, 0.8)), seeds=48) if each.period == 2]
    (orbit,) = (each for each in found if each.impacts == 4 and each.stable)
    near = min(doubled, key=lambda point: abs(point.frequency_ratio - 1.78))
    direction = 1 if near.frequency_ratio < 1.78 else -1
    within = (min(near.frequency_ratio, 1.78), max(near.frequency_ratio, 1.78))
    *_, there = follow_branch(near, "frequency_ratio", within, direction=direction)
    assert there.frequency_ratio == 1.78
    assert there.chain.repeats(chain_of(orbit), 1e-9, mirrors=True)


def test_a_bubble_of_doubled_orbits_ends_at_its_other_doubling() -> None:
    # A branch of period 2 that begins and ends on one branch of period 1.
    found = find_orbits(
        *setting((2.324497483803872, 1.6585167782306718, 0.6684959452715873)),
        max_period=2,
        max_impacts=4,
        seeds=24,
    )
    start = next(each for each in found if each.period == 2 and each.impacts == 4)

    def both_ends(step: float) -> list[BranchPoint]:
        branch = follow_branch(start, "frequency_ratio", (0.3, 12.0), largest_step=step)
        return special(branch)

    for ends in (both_ends(0.05), both_ends(0.02), both_ends(0.002)):
        assert [point.type.value for point in ends] == ["period-doubling"] * 2
        assert [point.impacts for point in ends] == [4, 2]
        assert ends[0].frequency_ratio == pytest.approx(1.9069885905930, abs=1e-12)
        assert ends[1].frequency_ratio == pytest.approx(1.9290959595324, abs=1e-12)
    # The orbit that is doubled there has that doubling on its own branch.
    back = list(follow_branch(both_ends(0.02)[1], "frequency_ratio", (1.8, 2.0), direction=-1))
    assert back[0].type == "period-doubling"
    assert back[0].multipliers[0] == pytest.approx(-1.0, abs=1e-6)


# ----------------------------------------------------------------------------------------- grazes


@pytest.fixture(scope="module")
def graze() -> BranchPoint:
    start = symmetric_start(2.0, 6.0, 0.8, order=3)
    *_, last = follow_branch(start, "amplitude", (1.0, 6.0), direction=-1)
    assert last.type == "grazing"
    return last


def test_at_a_graze_orbits_with_two_impacts_more_begin(graze: BranchPoint) -> None:
    points = list(follow_branch(graze, "amplitude", (1.0, 6.0), switch=True))
    assert len(points) > 5
    assert points[0].amplitude == graze.amplitude
    assert points[0].chain.impacts == graze.chain.impacts + 2
    assert points[0].chain.shortest == 0.0
    for point in points[1:]:
        assert point.admissible
        assert (point.impacts, point.period) == (graze.impacts + 4, graze.period)
    # Beside a fold Newton's method on the return map is singular.
    apart = [each for each in points[1:-1] if abs(each.multipliers[0] - 1.0) > 10.0]
    assert len(apart) > 10
    for point in apart[::5]:
        # Newton's method on the return map finds it again, from a place beside it.
        orbit = point.orbit
        begin, table = orbit.states[0], np.zeros((orbit.impacts or 0, periodic.ORBIT_COLUMNS))
        system = make_system(orbit.block.dimensionless(), orbit.motion, Linear())
        beside = replace(begin, speed=begin.speed * (1.0 + 1e-13))
        fixed = periodic.polish(system, section_of(beside), len(table), point.period, table)
        assert fixed.residual < 1e-9
        assert table[:, periodic.SPEED] == pytest.approx([s.speed for s in orbit.states], rel=1e-6)


def test_where_two_impacts_merge_orbits_with_two_fewer_begin(graze: BranchPoint) -> None:
    points = list(follow_branch(graze, "amplitude", (1.0, 6.0), switch=True))
    here = points[0]
    assert here.type == "grazing"
    back = list(follow_branch(here, "amplitude", (1.0, 6.0), switch=True))
    assert back[0].chain.impacts == graze.chain.impacts
    assert back[0].chain.distance(graze.chain) < 1e-9
    assert all(point.admissible for point in back)
    assert first(back, "fold").amplitude == pytest.approx(1.6199920091468, abs=1e-12)


def test_of_an_orbit_that_leans_a_merging_may_leave_a_symmetric_one() -> None:
    # Its symmetry breaks further on, which a chain of its whole length would not say.
    block_and_shaking = setting((2.0, 2.2, 0.8))
    leaning = [
        each
        for each in find_orbits(*block_and_shaking, max_period=3, max_impacts=6, seeds=40)
        if each.admissible and not each.rest_phases and each.impacts == 6
    ]
    seen = 0
    for start in leaning:
        for direction in (1, -1):
            *_, last = follow_branch(start, "frequency_ratio", (1.6, 4.5), direction=direction)
            if last.type != "grazing":
                continue
            chain, along = switched(last.type, last.chain)
            assert along is None
            assert chain.primitive(1e-6) is chain
            on = list(follow_branch(last, "frequency_ratio", (1.6, 4.5), switch=True))
            for point in on[1:-1:3]:
                if max(point.chain.durations) < 8.0:
                    assert point.orbit.kind == point.kind
                    seen += 1
    assert seen > 3


def test_two_arcs_that_merge_across_the_end_of_the_chain_are_left_out(graze: BranchPoint) -> None:
    points = list(follow_branch(graze, "amplitude", (1.0, 6.0), switch=True))
    chain = points[0].chain
    (merged,) = np.flatnonzero(np.abs(chain.durations) < 1e-9)
    # Begun at each of its impacts, half of a symmetric orbit: the other half follows mirrored.
    for begin in range(chain.impacts):
        turns = np.concatenate([chain.turns[begin:], chain.turns[:begin] + chain.half_cycles])
        phases = np.concatenate([chain.phases[begin:], chain.phases[:begin]])
        other = chain.moved(phases, chain.parameters)
        other = type(chain)(
            parameters=chain.parameters,
            turns=turns + begin % 2,
            phases=phases,
            half_cycles=chain.half_cycles,
        )
        assert np.abs(other.errors).max() < 1e-12
        rest, _ = switched(PointType.GRAZING, other)
        assert rest.impacts == chain.impacts - 2
        assert np.abs(rest.errors).max() < 1e-9
        assert rest.repeats(graze.chain, 1e-8)
    assert merged in range(chain.impacts)


@every("kind", [PointType.REGULAR, PointType.FOLD, PointType.RANGE_END])
def test_elsewhere_nothing_begins(kind: PointType) -> None:
    chain = chain_of(symmetric_start(2.0, 2.0, 0.8))
    with pytest.raises(ModelError, match="no other branch begins there") as raised:
        switched(kind, chain)
    assert "\n" not in str(raised.value)


def test_of_two_impacts_that_merge_nothing_is_left(leaning: list[BranchPoint]) -> None:
    # The branch that leans, followed to slow shaking of a stronger block: one flight takes all.
    *_, last = follow_branch(
        leaning[5], "frequency_ratio", (0.3, 12.0), direction=-1, largest_step=0.02
    )
    if last.type == "grazing" and last.impacts == 2:
        with pytest.raises(ModelError):
            follow_branch(last, "frequency_ratio", (0.3, 12.0), switch=True)
    assert np.isfinite(last.peaks).all()
    assert math.isfinite(values_of(last).sum())
