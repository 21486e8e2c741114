"""Branches: closed forms, the return map alone, step sizes, mirror images, stability by kicks."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rocksteady import find_attractor, find_orbits
from rocksteady.branches import BranchPoint, follow_branch
from rocksteady.formulas import (
    steady_states,
    symmetry_breaking_amplitude,
    symmetry_breaking_frequencies,
)
from rocksteady.orbits import compute_region_boundaries
from tests.dynamics.continuation.branches import (
    PARAMETERS,
    RANGES,
    events,
    first,
    least_height,
    located,
    random_start,
    same_events,
    setting,
    special,
    symmetric_start,
    unsymmetric_branch,
    values_of,
)
from tests.dynamics.kicks import keeps, loses
from tests.every import every


@pytest.fixture(scope="module")
def leaning() -> list[BranchPoint]:
    return unsymmetric_branch()


# ------------------------------------------------------------------------------------ closed forms


@pytest.mark.slow
@every("order", [1, 3, 5])
def test_folds_are_the_existence_boundary(order: int) -> None:
    rng = np.random.default_rng(order)
    for _ in range(6):
        frequency, restitution = rng.uniform(0.8, 3.0) * order, rng.uniform(0.3, 0.95)
        edge = float(compute_region_boundaries(frequency, restitution, order=order).existence)
        start = symmetric_start(1.05 * edge, frequency, restitution, order=order)
        if not start.admissible:
            continue
        within = (0.5 * edge, 2.0 * edge)
        branch = list(follow_branch(start, "amplitude", within, direction=-1, inadmissible=True))
        fold = first(branch, "fold")
        assert fold.amplitude == pytest.approx(edge, rel=1e-12)  # eq 23
        assert fold.multipliers[0] == pytest.approx(1.0, abs=1e-6)
        assert not fold.stable
        # In frequency the same boundary, as a root.
        here = list(follow_branch(start, "frequency_ratio", (0.3, 40.0), inadmissible=True))
        for other in (point for point in here if point.type == "fold"):
            found = compute_region_boundaries(other.frequency_ratio, restitution, order=order)
            assert other.amplitude == pytest.approx(float(found.existence), rel=1e-11)


@every(("frequency", "order", "printed"), [(4.0, 1, None), (6.0, 3, 1.61999), (8.0, 3, None)])
def test_a_branch_turns_from_branch_1_into_branch_2(
    frequency: float, order: int, printed: float | None
) -> None:
    start = symmetric_start(1.9, frequency, 0.8, order=order)
    points = list(follow_branch(start, "amplitude", (0.1, 2.0), direction=-1))
    turn = next(k for k, point in enumerate(points) if point.type == "fold")
    if printed is not None:
        assert points[turn].amplitude == pytest.approx(printed, abs=1e-5)  # TW2
    for k, point in enumerate(points):
        if abs(k - turn) < 2:
            continue
        states = steady_states(point.amplitude, frequency, 0.8, order=order)
        which = 0 if k < turn else 1
        here = point.chain.phases[0] + point.chain.turns[0] * math.pi
        assert math.cos(here - states.phase[which]) == pytest.approx(1.0, abs=1e-12)
        assert point.peaks[0] == pytest.approx(np.asarray(states.peak)[which], abs=1e-9)
        pair = states.multipliers[which]
        assert sorted(abs(point.chain.multipliers)) == pytest.approx(sorted(abs(pair)), rel=1e-7)
        assert point.stable is bool(states.stable[which])


@every(
    ("amplitude", "order", "printed"),
    [
        (1.0, 1, 1.448324), (2.0, 1, 1.948378), (3.0, 1, 2.345723), (4.0, 1, 2.690687),
        (6.0, 1, 3.291248), (1.0, 3, 2.957132), (2.0, 3, 4.249471), (3.0, 3, 5.237990),
        (4.0, 3, 6.143263), (6.0, 3, 7.959945),
    ],
)  # fmt: skip
def test_symmetry_breaks_where_it_is_printed(amplitude: float, order: int, printed: float) -> None:
    start = symmetric_start(amplitude, printed * 1.08, 0.8, order=order)
    branch = follow_branch(
        start, "frequency_ratio", (0.8 * printed, 1.2 * printed), direction=-1, inadmissible=True
    )
    breaking = first(branch, "symmetry-breaking")
    assert breaking.frequency_ratio == pytest.approx(printed, abs=6e-7)  # TW6
    exact = symmetry_breaking_frequencies(amplitude, 0.8, order=order)
    assert np.abs(exact - breaking.frequency_ratio).min() <= 1e-12 * printed


@pytest.mark.slow
@every("parameter", PARAMETERS)
def test_symmetry_breaks_on_the_closed_curve_in_any_parameter(parameter: str) -> None:
    rng, found = np.random.default_rng(3), 0
    for _ in range(20):
        order = int(rng.choice([1, 3, 5]))
        values = [0.0, rng.uniform(1.2, 3.0) * order, rng.uniform(0.3, 0.95)]
        values[0] = 0.97 * float(symmetry_breaking_amplitude(values[1], values[2], order=order))
        states = steady_states(*values, order=order)
        assert states.admissible is not None
        if not states.admissible[0]:
            continue
        start = symmetric_start(*values, order=order)
        for direction in (1, -1):
            points = follow_branch(start, parameter, RANGES[parameter], direction=direction)
            for point in points:
                if point.type != "symmetry-breaking":
                    continue
                found += 1
                exact = symmetry_breaking_amplitude(
                    point.frequency_ratio, point.restitution, order=order
                )
                assert point.amplitude == pytest.approx(float(exact), rel=1e-11)
                assert not point.stable
    assert found >= 8


@pytest.mark.slow
def test_a_symmetric_branch_ends_where_the_closed_form_meets_the_floor() -> None:
    rng, found = np.random.default_rng(4), 0
    for _ in range(40):
        order = int(rng.choice([3, 5]))
        frequency, restitution = rng.uniform(1.2, 3.0) * order, rng.uniform(0.3, 0.95)
        edge = float(compute_region_boundaries(frequency, restitution, order=order).existence)
        start = symmetric_start(1.1 * edge, frequency, restitution, order=order)
        if not start.admissible:
            continue
        *_, last = follow_branch(start, "amplitude", (0.5 * edge, 6.0 * edge))
        if last.type != "grazing":
            continue
        found += 1
        assert last.admissible

        def keeps_off(
            amplitude: float,
            frequency: float = frequency,
            restitution: float = restitution,
            order: int = order,
        ) -> bool:
            states = steady_states(amplitude, frequency, restitution, order=order)
            return bool(np.asarray(states.admissible)[0])

        low, high = 0.999 * last.amplitude, 1.001 * last.amplitude
        assert keeps_off(low)
        assert not keeps_off(high)
        for _ in range(60):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if keeps_off(middle) else (low, middle)
        assert last.amplitude == pytest.approx(low, rel=1e-10)
    assert found >= 5


# ------------------------------------------------------------------------- by the return map alone


@every("seed", range(12))
def test_every_point_of_a_random_branch_is_an_orbit_of_the_map(seed: int) -> None:
    rng = np.random.default_rng(100 + seed)
    start = random_start(rng)
    if start is None:
        return
    parameter = PARAMETERS[seed % 3]
    direction = int(rng.choice([1, -1]))
    points = list(
        follow_branch(start, parameter, RANGES[parameter], direction=direction, most_points=150)
    )
    lengths = np.diff([point.arclength for point in points])
    assert (lengths >= -1e-12).all()
    assert lengths.max() <= 0.02 * (1.0 + 1e-12)
    fixed = [index for index, name in enumerate(PARAMETERS) if name != parameter]
    for point in points[::4]:
        assert (values_of(point)[fixed] == values_of(points[0])[fixed]).all()
        # No orbit here loses stability through a complex pair: the product is known.
        first_one, second = point.multipliers
        loss = point.restitution ** (2 * point.impacts)
        if point.type == "grazing":
            assert np.isnan(first_one)
        else:
            assert first_one * second == pytest.approx(loss, rel=1e-9)
        assert point.admissible
        if point.type in ("grazing", "fold") or max(point.chain.durations) > 12.0:
            continue
        assert least_height(point) > -1e-12
        orbit = point.orbit
        size = max(1.0, orbit.largest_multiplier)
        assert orbit.residual <= 1e-11 * size
        assert (orbit.period, orbit.impacts) == (point.period, point.impacts)
        assert orbit.kind == point.kind
        assert orbit.multipliers[0] == pytest.approx(first_one, rel=1e-6, abs=1e-9)
        assert max(point.peaks) == pytest.approx(orbit.highest, abs=1e-10 * size)
        assert min(point.peaks) == pytest.approx(orbit.lowest, abs=1e-10 * size)


@every("seed", range(12))
def test_bifurcations_of_random_branches_are_where_the_map_has_them(seed: int) -> None:
    rng = np.random.default_rng(200 + seed)
    start = random_start(rng)
    if start is None:
        return
    for parameter in PARAMETERS:
        points = list(follow_branch(start, parameter, RANGES[parameter], most_points=150))
        for point in special(points):
            if point.type not in ("fold", "symmetry-breaking", "period-doubling"):
                continue
            if max(point.chain.durations) > 8.0:
                continue
            exact = located(point, parameter, 1.0 if point.type == "fold" else -1.0)
            assert getattr(point, parameter) == pytest.approx(exact, rel=1e-10)


def test_the_cascade_of_the_paper(leaning: list[BranchPoint]) -> None:
    # TW7: a period-doubled attractor at 1.78, and none at 1.77.
    doubling = first(leaning, "period-doubling")
    assert 1.78 < doubling.frequency_ratio < 1.80
    assert doubling.frequency_ratio == pytest.approx(
        located(doubling, "frequency_ratio", -1.0), rel=1e-12
    )
    at = {round(w, 3): None for w in (1.9, 1.85, 1.8)}
    printed = {1.9: (0.90035, -0.44427), 1.85: (1.01036, -0.36025), 1.8: (1.0976, -0.2997)}
    for frequency in at:
        near = min(leaning, key=lambda point: abs(point.frequency_ratio - frequency))
        within = sorted((near.frequency_ratio, frequency))
        (*_, there) = follow_branch(
            near,
            "frequency_ratio",
            (within[0] - (near.frequency_ratio > frequency) * 0.0, within[1] + 1e-12),
            direction=1 if near.frequency_ratio < frequency else -1,
        )
        extremes = (max(there.peaks), min(there.peaks))
        mirrored = (-extremes[1], -extremes[0])
        found = max(extremes, mirrored)
        assert found == pytest.approx(printed[frequency], abs=6e-5)
        assert there.stable


def test_stability_is_what_kicked_motions_say(leaning: list[BranchPoint]) -> None:
    checked = 0
    for point in leaning[3::6]:
        size = abs(point.multipliers[0])
        if not point.admissible or 0.9 < size < 1.1 or size > 1e3:
            continue
        checked += 1
        orbit = point.orbit
        assert point.stable is keeps(orbit)
        assert point.stable is not loses(orbit)
    assert checked >= 4


def test_stable_points_attract(leaning: list[BranchPoint]) -> None:
    stable = [point for point in leaning if point.stable and abs(point.multipliers[0]) < 0.9]
    for point in stable[::3]:
        orbit = point.orbit
        found = find_attractor(orbit.block, orbit.motion, start=orbit.start)
        assert found.orbit is not None
        assert found.period == point.period
        assert found.orbit.highest == pytest.approx(orbit.highest, abs=1e-7)


# -------------------------------------------------------------------------------------- step sizes


def steps_disagree(seed: int) -> str:
    """Return a branch on which long steps do not find what short ones do; empty if they do."""
    rng = np.random.default_rng(seed)
    start = random_start(rng)
    if start is None:
        return ""
    parameter, direction = PARAMETERS[seed % 3], int(rng.choice([1, -1]))
    inadmissible = bool(rng.random() < 0.3)

    def followed(step: float) -> list[tuple[str, float, int]]:
        points = follow_branch(
            start,
            parameter,
            RANGES[parameter],
            direction=direction,
            inadmissible=inadmissible,
            largest_step=step,
            most_points=round(6.0 / step),
        )
        return events(points, parameter)

    long, short = followed(0.02), followed(0.002)
    if same_events(long, short, within=1e-10):
        return ""
    return f"{seed} {parameter} {start.motion} {direction}: {long} or {short}"


@pytest.mark.slow
@every("seed", range(16))
def test_no_event_depends_on_the_size_of_the_steps(seed: int) -> None:
    assert not steps_disagree(seed)


@pytest.mark.slow
def test_no_event_depends_on_the_size_of_the_steps_on_many_branches() -> None:
    assert not [found for seed in range(16, 28) if (found := steps_disagree(seed))]


# ----------------------------------------------------------------------------------- symmetries


def test_a_mirror_image_has_the_same_branch(leaning: list[BranchPoint]) -> None:
    begin = leaning[5]
    orbit = begin.orbit
    for parameter in PARAMETERS:
        one, other = (
            list(follow_branch(each, parameter, RANGES[parameter], direction=-1, most_points=60))
            for each in (orbit, orbit.mirrored)
        )
        assert same_events(events(one, parameter), events(other, parameter), within=1e-11)
        for point, image in zip(one, other, strict=True):
            assert values_of(image) == pytest.approx(values_of(point), abs=1e-9)
            assert sorted(image.peaks) == pytest.approx(sorted(-point.peaks), abs=1e-9)
            expected = point.multipliers[0]
            assert image.multipliers[0] == pytest.approx(expected, rel=1e-6, nan_ok=True)


def test_a_branch_followed_back_is_the_same() -> None:
    start = symmetric_start(2.0, 6.0, 0.8, order=3)
    there = list(follow_branch(start, "amplitude", (1.0, 3.5), direction=-1))
    assert [point.type.value for point in special(there)] == ["fold", "end-of-range"]
    back = list(follow_branch(there[-1], "amplitude", (1.0, 3.5), direction=-1))
    assert [point.type.value for point in special(back)] == [
        "end-of-range", "fold", "end-of-range"
    ]  # fmt: skip
    assert back[-1].amplitude == there[-1].amplitude == 3.5
    folds = [first(points, "fold").amplitude for points in (there, back)]
    assert folds[0] == pytest.approx(folds[1], rel=1e-13)


def test_the_course_does_not_depend_on_the_impact_at_which_an_orbit_begins() -> None:
    found = find_orbits(*setting((1.0, 2.0, 0.8)), max_impacts=4, seeds=24)
    orbit = next(each for each in found if len(each.states) == 4 and each.admissible)
    points = list(follow_branch(orbit, "amplitude", (0.3, 3.0), most_points=40))
    for begin in (1, 2, 3):
        states = orbit.states[begin:] + orbit.states[:begin]
        same = list(follow_branch(replace(orbit, states=states), "amplitude", (0.3, 3.0)))
        assert same_events(events(points, "amplitude"), events(same, "amplitude"), within=1e-11)


def test_an_orbit_of_long_flights_is_followed_where_no_march_stays_on_it() -> None:
    start = symmetric_start(1.0, 1.0, 0.8)
    *_, last = follow_branch(start, "frequency_ratio", (0.1, 1.0), direction=-1)
    assert (last.type, last.frequency_ratio) == ("end-of-range", 0.1)
    orbit, exact = last.orbit, symmetric_start(1.0, 0.1, 0.8)
    assert math.isnan(orbit.residual)
    assert math.cos(orbit.states[0].phase - exact.states[0].phase) == pytest.approx(1.0, abs=1e-12)
    assert orbit.states[0].speed == pytest.approx(exact.states[0].speed, rel=1e-12)
    assert orbit.multipliers == pytest.approx(exact.multipliers, rel=1e-9)
    assert (orbit.highest, orbit.lowest) == pytest.approx((exact.highest, exact.lowest))
    assert (orbit.symmetric, orbit.period, orbit.admissible) == (True, 1, True)
