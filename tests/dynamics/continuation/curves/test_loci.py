"""Curves of bifurcations in two parameters: closed forms, and each point in one parameter."""

import math

import numpy as np
import pytest

from rocksteady.branches import BranchPoint, follow_bifurcation, follow_branch
from rocksteady.errors import InputError, ModelError
from rocksteady.formulas import steady_states, symmetry_breaking_amplitude
from rocksteady.orbits import compute_region_boundaries
from tests.dynamics.continuation.branches import (
    PARAMETERS,
    first,
    least_height,
    located,
    symmetric_start,
    unsymmetric_branch,
    values_of,
)
from tests.every import every

PLANES = [
    ("amplitude", "frequency_ratio"),
    ("frequency_ratio", "restitution"),
    ("amplitude", "restitution"),
    ("restitution", "amplitude"),
]
WITHIN = {"amplitude": (0.1, 6.0), "frequency_ratio": (1.0, 9.0), "restitution": (0.3, 0.98)}


def ranges(plane: tuple[str, str]) -> tuple[tuple[float, float], tuple[float, float]]:
    return WITHIN[plane[0]], WITHIN[plane[1]]


def both_ways(start: BranchPoint, plane: tuple[str, str]) -> list[BranchPoint]:
    one, other = (
        list(follow_bifurcation(start, plane, ranges(plane), direction=direction, most_points=400))
        for direction in (1, -1)
    )
    return [*reversed(other[1:]), *one]


def found_again(point: BranchPoint, parameter: str, kind: str) -> float | None:
    """Return where a branch in one parameter, through a place beside a point, has the event."""
    value = getattr(point, parameter)
    for side in (1, -1):
        near = (value * 0.97, value * 1.03)
        back = follow_branch(point, parameter, near, direction=side, inadmissible=True)
        *_, end = back
        for direction in (1, -1):
            branch = follow_branch(end, parameter, near, direction=direction, inadmissible=True)
            for each in branch:
                if each.type == kind and each.arclength > 0.0:
                    found = float(getattr(each, parameter))
                    if abs(found - value) < 1e-6 * value:
                        return found
    return None


@pytest.mark.slow
@every("plane", PLANES)
@every("order", [1, 3])
def test_symmetry_breaks_on_the_closed_form_all_along(plane: tuple[str, str], order: int) -> None:
    frequency = 2.2 if order == 1 else 5.0
    edge = float(symmetry_breaking_amplitude(frequency, 0.8, order=order))
    start = symmetric_start(0.97 * edge, frequency, 0.8, order=order)
    breaking = first(follow_branch(start, "amplitude", (0.1, 6.0)), "symmetry-breaking")
    points = both_ways(breaking, plane)
    assert len(points) > 20
    for point in points:
        exact = symmetry_breaking_amplitude(point.frequency_ratio, point.restitution, order=order)
        assert point.amplitude == pytest.approx(float(exact), rel=1e-10)  # TW6
        assert point.type in ("symmetry-breaking", "end-of-range", "grazing")
        assert point.multipliers[0] == pytest.approx(1.0, abs=1e-6)  # -1 twice
    fixed = next(name for name in PARAMETERS if name not in plane)
    assert len({getattr(point, fixed) for point in points}) == 1


@pytest.mark.slow
@every("plane", PLANES)
@every("order", [1, 3])
def test_folds_run_along_the_existence_boundary(plane: tuple[str, str], order: int) -> None:
    frequency = 4.0 if order == 1 else 6.0
    edge = float(compute_region_boundaries(frequency, 0.8, order=order).existence)
    start = symmetric_start(1.05 * edge, frequency, 0.8, order=order)
    branch = follow_branch(start, "amplitude", (0.1, 6.0), direction=-1)
    points = both_ways(first(branch, "fold"), plane)
    assert len(points) > 20
    for point in points:
        exact = compute_region_boundaries(point.frequency_ratio, point.restitution, order=order)
        assert point.amplitude == pytest.approx(float(exact.existence), rel=1e-10)  # eq 23


@every(("restitution", "order"), [(0.87, 3), (0.5, 5), (0.8, 1), (0.99, 3)])
def test_folds_of_long_half_cycles_run_along_the_existence_boundary_too(
    restitution: float, order: int
) -> None:
    # Near a fold all terms of the derivative by the one phase vanish like e^-T together.
    edge = float(compute_region_boundaries(4.5, restitution, order=order).existence)
    start = symmetric_start(1.1 * edge, 4.5, restitution, order=order)
    fold = first(follow_branch(start, "amplitude", (1e-4, 8.0), direction=-1), "fold")
    lowest = 0.3 if order < 5 else 0.6  # half cycles of 31 and of 26 pivot times
    within = ((1e-4, 9.0), (lowest, 9.0))
    points = list(follow_bifurcation(fold, PLANES[0], within, direction=-1))
    assert points[-1].type == "end-of-range"
    assert points[-1].frequency_ratio == lowest
    assert len(points) < 200
    for point in points:
        exact = compute_region_boundaries(point.frequency_ratio, restitution, order=order)
        assert point.amplitude == pytest.approx(float(exact.existence), rel=1e-10)  # eq 23


@pytest.mark.slow
@every("plane", PLANES[:3])
def test_doublings_are_doublings_by_the_map(plane: tuple[str, str]) -> None:
    points = both_ways(first(unsymmetric_branch(), "period-doubling"), plane)
    assert len(points) > 20
    doublings = [point for point in points if point.type == "period-doubling"]
    for point in doublings[:: max(1, len(doublings) // 8)]:
        assert point.multipliers[0] == pytest.approx(-1.0, abs=1e-6)
        if max(point.chain.durations) > 8.0:
            continue
        for parameter in PARAMETERS:
            exact = located(point, parameter, -1.0)
            assert getattr(point, parameter) == pytest.approx(exact, rel=1e-9)


@every("plane", PLANES[:3])
def test_grazes_are_grazes_of_the_closed_form(plane: tuple[str, str]) -> None:
    start = symmetric_start(2.0, 6.0, 0.8, order=3)
    *_, graze = follow_branch(start, "amplitude", (1.0, 6.0), direction=-1)
    assert graze.type == "grazing"
    points = both_ways(graze, plane)
    assert len(points) > 10
    for point in points[::5]:
        assert abs(least_height(point)) < 1e-5
        # A little weaker shaking keeps it off the floor, a little stronger does not.
        here = []
        for share in (1.0 - 1e-7, 1.0 + 1e-7):
            states = steady_states(
                share * point.amplitude, point.frequency_ratio, point.restitution, order=3
            )
            which = int(np.argmin(np.abs(np.sin(0.5 * (states.phase - graze_phase(point))))))
            here.append(bool(np.asarray(states.admissible)[which]))
        assert here == [True, False], point


def graze_phase(point: BranchPoint) -> float:
    return float(point.chain.phases[0] + point.chain.turns[0] * math.pi)


@pytest.mark.slow
@every("kind", ["fold", "symmetry-breaking", "period-doubling"])
def test_each_point_is_that_bifurcation_in_one_parameter_alone(kind: str) -> None:
    if kind == "period-doubling":
        start = first(unsymmetric_branch(), kind)
    else:
        begin = symmetric_start(2.0, 6.0, 0.8, order=3)
        direction = -1 if kind == "fold" else 1
        branch = follow_branch(
            begin, "amplitude", (0.5, 6.0), direction=direction, inadmissible=True
        )
        start = first(branch, kind)
    points = both_ways(start, ("amplitude", "frequency_ratio"))
    inner = [point for point in points if point.type == kind]
    checked = 0
    for point in inner[5:-5:12]:
        for parameter in ("amplitude", "frequency_ratio"):
            again = found_again(point, parameter, kind)
            assert again is not None, (parameter, values_of(point))
            assert again == pytest.approx(getattr(point, parameter), rel=1e-9)
            checked += 1
    assert checked >= 4


def test_a_curve_ends_at_its_range_and_can_be_followed_back() -> None:
    start = symmetric_start(1.0, 2.0, 0.8)
    breaking = first(follow_branch(start, "amplitude", (0.1, 3.0)), "symmetry-breaking")
    plane = ("amplitude", "frequency_ratio")
    within = ((0.5, 4.0), (1.0, 3.0))
    *_, up = follow_bifurcation(breaking, plane, within)
    *_, down = follow_bifurcation(breaking, plane, within, direction=-1)
    assert up.type == down.type == "end-of-range"
    for end in (up, down):
        assert end.amplitude in within[0] or end.frequency_ratio in within[1]
        exact = symmetry_breaking_amplitude(end.frequency_ratio, 0.8)
        assert end.amplitude == pytest.approx(float(exact), rel=1e-12)
    assert up.frequency_ratio > breaking.frequency_ratio > down.frequency_ratio


@pytest.mark.slow
def test_steps_do_not_matter_and_points_are_counted() -> None:
    doubling = first(unsymmetric_branch(), "period-doubling")
    plane, within = ("amplitude", "frequency_ratio"), ((1.5, 3.0), (1.5, 2.3))
    ends = [
        list(follow_bifurcation(doubling, plane, within, largest_step=step))[-1]
        for step in (0.02, 0.004)
    ]
    assert ends[0].type == ends[1].type
    assert values_of(ends[0]) == pytest.approx(values_of(ends[1]), rel=1e-10)
    points = list(follow_bifurcation(doubling, plane, within, most_points=3))
    assert [point.type.value for point in points] == ["period-doubling"] * 3 + ["limit"]


@every(
    ("parameters", "within"),
    [
        (("amplitude",), ((0.1, 3.0),)),
        (("amplitude", "amplitude"), ((0.1, 3.0), (0.1, 3.0))),
        (("amplitude", "amplitude", "restitution"), ((0.1, 3.0), (0.1, 3.0))),
        (("amplitude", "restitution"), None),
        (None, None),
        ("amplitude", ((0.1, 3.0), (0.1, 1.0))),
        (("amplitude", "mass"), ((0.1, 3.0), (0.1, 1.0))),
        ((["amplitude"], "restitution"), ((0.1, 3.0), (0.1, 1.0))),
        (("amplitude", "restitution"), ((0.1, 3.0), (0.9, 1.0))),
        (("amplitude", "restitution"), ((0.1, 3.0), (0.1, 1.1))),
    ],
)
def test_what_are_no_two_parameters_is_refused(parameters: object, within: object) -> None:
    start = symmetric_start(1.0, 2.0, 0.8)
    breaking = first(follow_branch(start, "amplitude", (0.1, 3.0)), "symmetry-breaking")
    with pytest.raises(InputError) as raised:
        follow_bifurcation(breaking, parameters, within)  # type: ignore[arg-type]
    assert "\n" not in str(raised.value)


def test_what_is_no_bifurcation_is_refused() -> None:
    orbit = symmetric_start(1.0, 2.0, 0.8)
    point = next(follow_branch(orbit, "amplitude", (0.1, 3.0)))
    for start in (orbit, point, None):
        with pytest.raises(ModelError, match="a curve begins at") as raised:
            follow_bifurcation(
                start,  # type: ignore[arg-type]
                ("amplitude", "restitution"),
                ((0.1, 3.0), (0.1, 1.0)),
            )
        assert "\n" not in str(raised.value)
