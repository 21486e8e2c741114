"""Events on branches: hidden in one step, next to another branch, at merging impacts, and none."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from rocksteady import find_orbits
from rocksteady.branches import BranchPoint, follow_branch
from rocksteady.dynamics.continuation.chains import events as chain_events
from tests.dynamics.continuation.branches import (
    PARAMETERS,
    RANGES,
    events,
    least_height,
    random_start,
    same_events,
    setting,
    special,
    symmetric_start,
)
from tests.every import every

GOES_ON = ("symmetry-breaking", "period-doubling", "grazing")


def branch_to(
    point: tuple[float, float, float], shape: tuple[int, int], parameter: str, graze: float
) -> list[BranchPoint]:
    """Return the branch of orbits of so many periods and impacts that comes to a graze."""
    period, impacts = shape
    for orbit in find_orbits(*setting(point), max_period=period, max_impacts=impacts, seeds=24):
        if (orbit.period, orbit.impacts) == shape and orbit.admissible:
            points = list(follow_branch(orbit, parameter, RANGES[parameter]))
            if any(abs(getattr(each, parameter) - graze) < 1e-9 for each in points):
                return points
    pytest.fail("no branch comes there")


def next_of(points: list[BranchPoint], kind: str) -> BranchPoint:
    return next(point for point in points[1:] if point.type == kind)


@pytest.mark.slow
def test_a_fold_there_and_back_within_one_step_is_found() -> None:
    # Two folds and two doublings within 4e-6 of amplitude: a step passes over all of them.
    point = (2.4189285690767743, 2.973149210133831, 0.8202732251014333)
    within = RANGES["amplitude"]
    branch = branch_to(point, (3, 4), "amplitude", 2.7349773743200805)
    for kind in ("grazing", "period-doubling"):
        branch = list(
            follow_branch(next_of(branch, kind), "amplitude", within, switch=True, most_points=300)
        )
    graze = next_of(branch, "grazing")
    assert graze.amplitude == pytest.approx(2.7543367390249, abs=1e-10)

    def followed(step: float) -> list[tuple[str, float, int]]:
        points = follow_branch(
            graze, "amplitude", within, switch=True, largest_step=step, most_points=3000
        )
        return events(points, "amplitude")

    long, short = followed(0.02), followed(0.002)
    assert same_events(long, short, within=1e-10)
    assert [each[0] for each in long][:5] == [
        "grazing", "fold", "period-doubling", "period-doubling", "fold"
    ]  # fmt: skip
    assert long[4][1] - long[1][1] == pytest.approx(3.7066e-6, rel=1e-3)


def branches_disagree(seed: int, most: int = 6) -> list[str]:
    """Return what long steps find otherwise than short ones on the branches that begin on one."""
    rng = np.random.default_rng(seed)
    start = random_start(rng)
    if start is None:
        return []
    parameter, direction = PARAMETERS[seed % 3], int(rng.choice([1, -1]))
    within = RANGES[parameter]
    points = follow_branch(start, parameter, within, direction=direction, most_points=300)
    waiting = [point for point in points if point.type in GOES_ON]
    found = []
    for _ in range(most):
        if not waiting:
            break
        here = waiting.pop(0)
        # Of two impacts that merge nothing is left; and long orbits take long.
        merged = np.abs(here.chain.durations).min() < 1e-9
        if here.impacts > 8 or (merged and here.chain.impacts <= 2):
            continue
        long, short = (
            list(
                follow_branch(
                    here,
                    parameter,
                    within,
                    switch=True,
                    largest_step=step,
                    most_points=round(4.0 / step),
                )
            )
            for step in (0.02, 0.002)
        )
        if not same_events(events(long, parameter), events(short, parameter), within=1e-10):
            found.append(f"{seed} {here.type} {parameter} {getattr(here, parameter)}")
        for point in long[1:-1:5]:
            assert point.admissible
            assert np.isfinite(point.peaks).all()
            if max(point.chain.durations) < 8.0:
                assert least_height(point) > -1e-12
                assert point.orbit.residual <= 1e-9 * max(1.0, abs(point.multipliers[0]))
        whole = max(point.chain.impacts for point in long)
        waiting += [
            point for point in long[1:] if point.type in GOES_ON and point.chain.impacts == whole
        ]
    return found


@pytest.mark.slow
@every("seed", range(300, 308))
def test_branches_that_begin_at_others_do_not_depend_on_the_steps(seed: int) -> None:
    assert not branches_disagree(seed, most=3)


@pytest.mark.slow
def test_nor_do_many_of_them() -> None:
    assert not [found for seed in range(308, 313) for found in branches_disagree(seed)]


@pytest.mark.slow
def test_two_branches_that_all_but_meet_are_told_apart() -> None:
    # Beyond 2.959 a long step straight ahead leads to the branch beside it.
    point = (4.04380985441199, 4.827757935623232, 0.9182915724237672)
    branch = branch_to(point, (4, 4), "frequency_ratio", 2.0004350667412765)
    graze = next(each for each in branch if each.type == "grazing")
    within = RANGES["frequency_ratio"]

    def followed(step: float) -> list[tuple[str, float, int]]:
        points = follow_branch(
            graze, "frequency_ratio", within, switch=True, largest_step=step, most_points=3000
        )
        return events(points, "frequency_ratio")

    short = followed(0.002)
    assert [each[0] for each in short] == [
        "grazing", "fold", "fold", "fold", "period-doubling", "grazing"
    ]  # fmt: skip
    for step in (0.1, 0.05, 0.02, 0.01):
        assert same_events(followed(step), short, within=1e-10)


def test_impacts_that_merge_end_a_branch_at_no_duration() -> None:
    start = symmetric_start(2.0, 6.0, 0.8, order=3)
    *_, graze = follow_branch(start, "amplitude", (1.0, 6.0), direction=-1)
    points = list(follow_branch(graze, "amplitude", (1.0, 6.0), switch=True))
    back = list(follow_branch(points[8], "amplitude", (1.0, 6.0), direction=1))
    there = list(follow_branch(points[8], "amplitude", (1.0, 6.0), direction=-1))
    ends = [branch[-1] for branch in (back, there) if branch[-1].type == "grazing"]
    nearest = min(ends, key=lambda end: abs(end.amplitude - graze.amplitude))
    assert nearest.amplitude == pytest.approx(graze.amplitude, abs=1e-10)
    assert abs(nearest.chain.shortest) < 1e-10
    assert (nearest.peaks == 0.0).any()  # between two impacts that are one
    assert nearest.admissible
    assert not nearest.stable or abs(nearest.multipliers[0]) < 1.0


def test_a_quiet_branch_has_no_events() -> None:
    start = symmetric_start(1.0, 4.0, 0.8)
    points = list(follow_branch(start, "frequency_ratio", (3.0, 9.0)))
    assert [point.type.value for point in special(points)] == ["end-of-range"]
    assert all(point.stable for point in points)


def test_a_closed_branch_ends_where_it_began() -> None:
    point = (3.987251776375143, 7.178139998457121, 0.45068500333975936)
    found = find_orbits(*setting(point), max_period=3, max_impacts=4, seeds=24)
    closed = []
    for orbit in found:
        if (orbit.period, orbit.impacts, orbit.symmetric) != (3, 4, False):
            continue
        for direction in (1, -1):
            points = list(
                follow_branch(orbit, "restitution", RANGES["restitution"], direction=direction)
            )
            if points[-1].type == "closed":
                closed.append(points)
    assert len(closed) >= 2
    for points in closed:
        last = points[-1]
        assert last.restitution == pytest.approx(points[0].restitution, rel=1e-14)
        assert last.chain.repeats(points[0].chain, 1e-9)
        kinds = sorted(each[0] for each in events(points, "restitution"))
        assert kinds == ["closed", "fold", "fold", "period-doubling", "period-doubling"]
    # In both directions it is the same ring.
    folds = [
        sorted(each[1] for each in events(points, "restitution") if each[0] == "fold")
        for points in closed[:2]
    ]
    assert folds[0] == pytest.approx(folds[1], rel=1e-11)
    assert folds[0] == pytest.approx([0.36975819029, 0.51689913214], abs=1e-10)


@pytest.mark.parametrize("direction", [1, -1])
def test_a_closed_branch_is_run_through_once_from_its_fold(direction: int) -> None:
    # At a fold the parameter only touches its value at the start: the branch passes it elsewhere.
    point = (3.987251776375143, 7.178139998457121, 0.45068500333975936)
    within = RANGES["restitution"]
    leaning = next(
        orbit
        for orbit in find_orbits(*setting(point), max_period=3, max_impacts=4, seeds=24)
        if (orbit.period, orbit.impacts, orbit.symmetric) == (3, 4, False)
        and list(follow_branch(orbit, "restitution", within))[-1].type == "closed"
    )
    fold = next(
        each for each in follow_branch(leaning, "restitution", within) if each.type == "fold"
    )
    around = special(list(follow_branch(fold, "restitution", within, direction=direction)))
    kinds = sorted(each.type.value for each in around)
    assert kinds == ["closed", "fold", "fold", "period-doubling", "period-doubling"]
    assert around[-1].type == "closed"
    assert around[-1].restitution == pytest.approx(fold.restitution, abs=1e-9)


def test_a_parabola_that_comes_near_zero_within_half_a_step_is_looked_at(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    rng = np.random.default_rng(3)
    seen = {True: 0, False: 0}
    for _ in range(60):
        begin, back, ahead = rng.uniform([-2.0, 0.1, 0.1], [2.0, 1.0, 1.0])
        bend = rng.choice([-1.0, 1.0], 20) * rng.uniform(0.2, 2.0, 20)
        middle = begin + ahead * rng.uniform(-1.2, 2.2, 20)
        least = rng.uniform(-0.3, 0.5, 20) * ahead**2

        def values(s: float, bend: Any = bend, middle: Any = middle, least: Any = least) -> Any:
            return bend * (s - middle) ** 2 + least

        one, two = values(begin), values(begin + ahead)
        inside = (begin - 0.5 * ahead < middle) & (middle < begin + 1.5 * ahead)
        alike = (one * two > 0.0) & (bend * one > 0.0)
        near = (least / one < 0.3) | (least / two < 0.3)
        monkeypatch.setattr(chain_events, "_tests", lambda spot, f=values: tuple(f(spot.arclength)))
        spots: list[Any] = [
            SimpleNamespace(arclength=at) for at in (begin - back, begin, begin + ahead)
        ]
        expected = np.flatnonzero(inside & alike & near).tolist()
        assert list(chain_events._suspicious(*spots)) == expected
        assert not list(chain_events._suspicious(spots[1], *spots[1:]))
        seen[True] += len(expected)
        seen[False] += 20 - len(expected)
    assert min(seen.values()) > 100


@every(("before", "after"), [(1.0, 0.0), (0.0, 1.0), (1.0, -1.0), (np.inf, 1.0), (1.0, np.nan)])
def test_a_test_that_changes_its_sign_or_is_not_finite_hides_nothing(
    before: float, after: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    values = {0.0: 4.0, 1.0: before, 2.0: after}
    monkeypatch.setattr(chain_events, "_tests", lambda spot: (values[spot.arclength],))
    spots: list[Any] = [SimpleNamespace(arclength=at) for at in values]
    assert not list(chain_events._suspicious(*spots))
