"""All orbits at a point: closed forms, the map itself, kicks, and what cannot be one."""

import math
from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    Linear,
    Rest,
    State,
    Still,
    find_attractor,
    find_orbits,
)
from rocksteady.dynamics.orbits.search import _same
from rocksteady.errors import InputError, ModelError
from rocksteady.formulas import steady_states
from rocksteady.histories import ImpactState
from rocksteady.model.motions.fourier import PeriodicMotion
from rocksteady.motions import FourierSeries
from rocksteady.orbits import Orbit
from rocksteady.words.orbits import describe_orbits
from tests.dynamics.kicks import apart, around, clearance, departures, follow, keeps, loses
from tests.every import every

HOUSNER = Block.from_radius(alpha=0.2, radius=1.0, gravity=9.81)


def shaken(amplitude: float, frequency: float) -> Harmonic:
    return Harmonic(amplitude=amplitude, frequency_ratio=frequency)


def at(amplitude: float, frequency: float, restitution: float, **more: Any) -> tuple[Orbit, ...]:
    block = DimensionlessBlock(restitution=restitution)
    return find_orbits(block, shaken(amplitude, frequency), **more)


@pytest.fixture(scope="module")
def many() -> tuple[Orbit, ...]:
    return at(1.0, 2.0, 0.8)


POINTS = [
    (1.0, 2.0, 0.8),
    (2.0, 1.9, 0.8),
    (2.0, 4.0, 0.8),
    (4.0, 6.0, 0.8),
    (2.0, 10.0, 0.8),
    (5.0, 200.0, 0.3),
    (0.75, 4.0, 0.5),
    (3.0, 8.0, 0.95),
    (2.0, 1.78, 0.8),
]


# ------------------------------------------------------------------ each is one, by the map alone


@every("point", POINTS)
def test_each_orbit_closes_with_the_multipliers_of_its_map(
    point: tuple[float, float, float],
) -> None:
    restitution = point[2]
    found = at(*point, seeds=40)
    assert found
    for orbit in found:
        if not orbit.admissible:
            assert math.isnan(orbit.residual)
            continue
        # The state of a closed form is rounded, and its orbit unstable.
        assert orbit.residual <= 1e-12 * max(1.0, orbit.largest_multiplier / 1e3)
        assert len(orbit.states) == orbit.impacts
        for after, state in zip(follow(orbit), (*orbit.states[1:], orbit.states[0]), strict=True):
            assert apart(after, state) <= 1e-11 * max(1.0, orbit.largest_multiplier)
        first, second = orbit.multipliers
        assert first * second == pytest.approx(restitution ** (2 * len(orbit.states)), rel=1e-11)
        assert abs(first) >= abs(second) * (1.0 - 1e-12)
        # The derivative of the orbit is the product of those of its passages, wherever it begins.
        steps = [around(orbit)(state) for state in orbit.states]
        assert math.fsum(step.phase for step in steps) == pytest.approx(
            2.0 * math.pi * orbit.period, abs=1e-9
        )
        for begin in range(len(steps)):
            total = np.eye(2)
            for step in steps[begin:] + steps[:begin]:
                total = step.jacobian @ total
            size = np.abs(total).max()
            assert abs(np.trace(total) - (first + second).real) <= 1e-7 * max(size, 1.0)


@every("point", [POINTS[0], POINTS[1], POINTS[3], POINTS[5]])
def test_its_peaks_are_those_of_its_time_history(point: tuple[float, float, float]) -> None:
    checked = 0
    for orbit in at(*point, seeds=40):
        if not orbit.admissible or orbit.largest_multiplier > 1e4:
            continue
        checked += 1
        run = orbit.trajectory()
        angle = run(np.linspace(0.0, run.end_time_pt, 20_001)).angle
        gap = run.end_time_pt / 20_000
        between = (1.0 + point[0] + np.abs(angle).max()) * gap * gap / 8.0
        slack = 1e-9 * max(1.0, orbit.largest_multiplier)
        assert -slack <= orbit.highest - angle.max() <= between + slack
        assert -slack <= angle.min() - orbit.lowest <= between + slack
        turned = orbit.motion.phase - orbit.states[0].phase
        assert math.cos(turned) == pytest.approx(1.0, abs=1e-12)
        assert orbit.start == orbit.states[0]
    assert checked >= 2


@every("point", POINTS)
def test_symmetric_means_that_half_of_it_is_the_mirror_image_of_the_other(
    point: tuple[float, float, float],
) -> None:
    for orbit in at(*point, seeds=40):
        half = len(orbit.states) // 2
        mirrored = [state.mirrored for state in orbit.states]
        turned = orbit.states[half:] + orbit.states[:half]
        far = max(apart(one, other) for one, other in zip(mirrored, turned, strict=True))
        assert orbit.symmetric is (far < 1e-6)
        assert orbit.kind == ("symmetric" if orbit.symmetric else "unsymmetric")
        if orbit.symmetric:
            assert orbit.highest == pytest.approx(-orbit.lowest, rel=1e-9, nan_ok=True)
            assert math.isnan(orbit.highest) is not orbit.admissible
            assert orbit.mirrored is orbit
            continue
        image = orbit.mirrored
        assert (image.highest, image.lowest) == (-orbit.lowest, -orbit.highest)
        assert orbit.highest > -orbit.lowest  # of the two images, the one given
        for after, state in zip(follow(image), (*image.states[1:], image.states[0]), strict=True):
            assert apart(after, state) <= 1e-11 * max(1.0, orbit.largest_multiplier)
        assert apart(image.mirrored.states[0], orbit.states[0]) < 1e-14
        assert math.cos(image.motion.phase - image.states[0].phase) == pytest.approx(1.0)
        run = image.trajectory()
        assert run.peak <= max(image.highest, -image.lowest) * (1.0 + 1e-6) + 1e-6


# ----------------------------------------------------------------------- printed and closed forms


def test_symmetric_ones_are_the_closed_forms() -> None:
    for a, w, r in POINTS:
        found = at(a, w, r, max_period=5, max_impacts=1, seeds=2)
        for order in (1, 3, 5):
            states = steady_states(a, w, r, order=order)
            closed = [orbit for orbit in found if orbit.period == order]
            if states.region == 4:
                assert not closed
                continue
            assert [orbit.branch for orbit in closed] == sorted([1, 2], key=lambda b: (
                not bool(np.asarray(states.admissible)[b - 1]), b
            ))  # fmt: skip
            for orbit in closed:
                which = (orbit.branch or 0) - 1
                assert orbit.symmetric
                if orbit.admissible:
                    assert orbit.highest == float(np.asarray(states.peak)[which])
                assert orbit.admissible is bool(np.asarray(states.admissible)[which])
                pair = states.multipliers[which]
                pair = pair if pair[0].imag >= 0.0 else pair[::-1]
                assert orbit.multipliers == pytest.approx(pair)
                assert orbit.stable is bool(states.stable[which])
                assert math.cos(orbit.states[0].phase - states.phase[which]) == pytest.approx(1.0)


@every(
    ("amplitude", "frequency", "order", "printed"),
    [
        (1.0, 1.0, 1, 25.658), (1.0, 2.0, 1, 10.2467), (1.0, 8.0, 1, 7.2251),
        (2.0, 3.5, 3, 19.557), (2.0, 4.0, 3, 12.419), (2.0, 5.0, 3, 6.8005),
    ],
)  # fmt: skip
def test_branch_2_has_the_printed_multipliers(
    amplitude: float, frequency: float, order: int, printed: float
) -> None:
    # TW8, per half cycle.
    found = at(amplitude, frequency, 0.8, seeds=2)
    (orbit,) = (o for o in found if o.branch == 2 and o.period == order)
    assert orbit.admissible
    assert not orbit.stable
    assert math.sqrt(orbit.largest_multiplier) == pytest.approx(printed, rel=5e-5)


def test_where_the_paper_is_corrected() -> None:
    # E1: branch 2 goes through the floor.
    found = at(3.0, 4.0, 0.8, max_period=1, seeds=20)
    assert [orbit.admissible for orbit in found if orbit.branch == 2] == [False]
    assert not any(orbit.stable for orbit in found if not orbit.admissible)
    # E2: an in-phase solution is stable.
    for a, w, r, n in ((0.75, 4.0, 0.5, 1), (1.7, 6.0, 0.8, 3)):
        (orbit,) = (o for o in at(a, w, r, seeds=2) if o.branch == 1 and o.period == n)
        assert orbit.stable
        assert math.cos(orbit.states[0].phase) > 0.0
    # E3: Fig 11(a) is unstable, and an unsymmetric orbit has taken its stability.
    found = at(4.0, 6.0, 0.8)
    (figure,) = (o for o in found if o.branch == 1 and o.period == 3)
    assert -math.sqrt(figure.largest_multiplier) == pytest.approx(-1.182, abs=6e-4)
    (other,) = (o for o in found if o.stable and o.period == 3)
    assert (other.highest, other.lowest) == pytest.approx((0.39815, -0.27242), abs=1.1e-5)


@every(
    ("frequency", "period", "peaks"),
    [
        (1.9, 1, (0.90035, -0.44427)),
        (1.85, 1, (1.01036, -0.36025)),
        (1.8, 1, (1.0976, -0.2997)),
        (4.2, 3, (0.53129, -0.44713)),
    ],
)
def test_the_unsymmetric_orbits_of_the_reference(
    frequency: float, period: int, peaks: tuple[float, float]
) -> None:
    found = at(2.0, frequency, 0.8, max_impacts=2)
    stable = [o for o in found if o.stable and o.period == period and not o.symmetric]
    (orbit,) = stable
    slack = 1.1e-5 if frequency != 1.8 else 1.1e-4
    assert (orbit.highest, orbit.lowest) == pytest.approx(peaks, abs=slack)


def test_where_the_period_has_doubled_both_orbits_are_there() -> None:
    # TW7: at 1.78 the orbit of period 1 has a multiplier below -1 and one of period 2 is stable.
    found = [o for o in at(2.0, 1.78, 0.8, max_period=2, max_impacts=4) if not o.symmetric]
    (once,) = (o for o in found if o.period == 1 and o.highest > 1.0)
    assert once.multipliers[0].real < -1.0
    (twice,) = (o for o in found if o.stable)
    assert (twice.period, twice.impacts) == (2, 4)
    assert twice.highest > once.highest


# --------------------------------------------------------------------------------- completeness


def test_at_a_point_of_the_plane_there_are_22(many: tuple[Orbit, ...]) -> None:
    assert len(many) == 22
    assert sum(orbit.stable for orbit in many) == 1
    more = at(1.0, 2.0, 0.8, seeds=150)
    assert len(more) == 22
    for one, other in zip(many, more, strict=True):
        assert (one.period, one.impacts, one.kind) == (other.period, other.impacts, other.kind)
        assert one.highest == pytest.approx(other.highest, rel=1e-9)
        assert one.multipliers == pytest.approx(other.multipliers, rel=1e-6)


def test_no_orbit_is_given_twice(many: tuple[Orbit, ...]) -> None:
    for found in (many, at(2.0, 2.0, 0.5), at(4.0, 10.0, 0.5)):
        there = [orbit for orbit in found if orbit.admissible]
        for i, one in enumerate(there):
            for other in there[:i]:
                if (one.period, len(one.states)) != (other.period, len(other.states)):
                    continue
                for state in (*other.states, *other.mirrored.states):
                    assert apart(one.states[0], state) > 1e-6


@every(("turned", "same"), [(1e-9, True), (-1e-9, True), (0.01, False), (-0.01, False)])
def test_orbits_are_compared_round_the_circle_of_phases(
    turned: float, same: bool, many: tuple[Orbit, ...]
) -> None:
    """Nothing but the comparison is asked for: where impacts come at phase 0 rounding decides."""
    (orbit, *_) = (each for each in many if each.admissible)

    def moved(begin: float) -> Orbit:
        away = begin - orbit.states[0].phase
        states = (replace(each, phase=(each.phase + away) % math.tau) for each in orbit.states)
        return replace(orbit, states=tuple(states))

    for begin in (0.0, 3.0):
        for one, other in ((begin, begin + turned), (begin + turned, begin)):
            assert _same(moved(one), moved(other)) == same


def test_no_orbit_is_another_gone_round_twice(many: tuple[Orbit, ...]) -> None:
    for orbit in many:
        for k in range(1, len(orbit.states)):
            assert apart(orbit.states[0], orbit.states[k]) > 1e-6


def test_they_come_in_their_order(many: tuple[Orbit, ...]) -> None:
    keys = [(o.period, len(o.states), not o.symmetric) for o in many]
    assert keys == sorted(keys)
    for one, other in pairwise(many):
        if (one.period, one.impacts) == (other.period, other.impacts) and not one.symmetric:
            assert one.stable >= other.stable


@every(("kept", "said"), [(lambda orbit: orbit.admissible, True), (lambda _: False, False)])
def test_the_answer_counts_the_motions_that_there_are(
    kept: Callable[[Orbit], bool], said: bool, many: tuple[Orbit, ...]
) -> None:
    orbits = [orbit for orbit in many if kept(orbit)]
    block, motion = DimensionlessBlock(restitution=0.8), shaken(1.0, 2.0)
    limits = {"max_period": 1, "max_impacts": 2, "seeds": 2}
    answer = describe_orbits(orbits, block, motion, Linear(), **limits)
    assert answer.sentence.startswith("No steady motion was found") is not said
    assert (f"of {len(orbits)} steady motions" in answer.sentence) is said


def test_limits_limit() -> None:
    for orbit in at(1.0, 2.0, 0.8, max_period=2, max_impacts=4, seeds=30):
        assert orbit.period <= 2
        assert len(orbit.states) <= 4
    # Closed forms have two impacts, whatever is searched for.
    assert {o.branch for o in at(1.0, 2.0, 0.8, max_period=1, max_impacts=1, seeds=5)} == {1, 2}


def settled_orbits(seed: int, count: int) -> list[tuple[tuple[float, float, float], Orbit]]:
    """Return random points and the short orbits without rest to which motions settle there."""
    rng = np.random.default_rng(seed)
    found: list[tuple[tuple[float, float, float], Orbit]] = []
    while len(found) < count:
        a, w = 10.0 ** rng.uniform(-0.2, 1.1), 10.0 ** rng.uniform(-0.3, 2.2)
        r = rng.uniform(0.2, 0.98)
        start = Rest() if rng.random() < 0.5 else State(angle=rng.uniform(-0.5, 0.5), velocity=0.0)
        shaking = Harmonic(amplitude=a, frequency_ratio=w, phase=rng.uniform(0.0, 6.28))
        orbit = find_attractor(DimensionlessBlock(restitution=r), shaking, start=start).orbit
        if orbit and orbit.period <= 3 and len(orbit.states) <= 6 and not orbit.rest_phases:
            found.append(((a, w, r), orbit))
    return found


def is_among(orbit: Orbit, found: tuple[Orbit, ...]) -> bool:
    state = orbit.states[0]
    return any(
        apart(state, other) < 1e-6
        for one in found
        if one.period == orbit.period and one.admissible
        for other in (*one.states, *one.mirrored.states)
    )


def test_what_motions_settle_to_is_among_them() -> None:
    for point, orbit in settled_orbits(1, 25):
        found = at(*point, seeds=48, max_period=orbit.period, max_impacts=len(orbit.states))
        assert is_among(orbit, found), (point, orbit)


@pytest.mark.slow
def test_what_motions_settle_to_is_among_them_at_many_points() -> None:
    missed = [
        (point, orbit) for point, orbit in settled_orbits(2, 30) if not is_among(orbit, at(*point))
    ]
    assert not missed


# ----------------------------------------------------------------------------------------- kicks


def random_point(rng: np.random.Generator) -> tuple[float, float, float, int]:
    """Return amplitude, frequency ratio, restitution and longest period, drawn widely."""
    return (
        10.0 ** rng.uniform(-0.7, 1.1),
        10.0 ** rng.uniform(-0.2, 1.6),
        rng.uniform(0.1, 0.99),
        int(rng.choice([1, 3, 5])),
    )


def kicked(seed: int, points: int, seeds: int) -> tuple[int, int, list[Orbit]]:
    """Return how many orbits kept, how many lost a kick, and those that did otherwise."""
    rng = np.random.default_rng(seed)
    kept, lost = 0, 0
    wrong: list[Orbit] = []
    for _ in range(points):
        a, w, r, longest = random_point(rng)
        for orbit in at(a, w, r, seeds=seeds, max_period=longest):
            largest = orbit.largest_multiplier
            if not orbit.admissible or abs(largest - 1.0) <= 0.02 or clearance(orbit) <= 1e-3:
                continue
            if largest < 1.0:
                kept += 1
                if not keeps(orbit):
                    wrong.append(orbit)
            else:
                lost += 1
                if not loses(orbit):
                    wrong.append(orbit)
    return kept, lost, wrong


def test_an_orbit_keeps_or_loses_a_kick_as_its_multipliers_say() -> None:
    kept, lost, wrong = kicked(3, 25, 16)
    assert not wrong
    assert kept > 8
    assert lost > 20


@pytest.mark.slow
def test_an_orbit_keeps_or_loses_a_kick_as_its_multipliers_say_at_250_points() -> None:
    kept, lost, wrong = kicked(4, 250, 40)
    assert not wrong
    assert kept > 75
    assert lost > 250


def test_a_kick_shrinks_at_the_rate_of_the_multipliers() -> None:
    (orbit,) = (o for o in at(2.0, 4.0, 0.8, seeds=2) if o.branch == 1 and o.period == 1)
    far = departures(orbit, (1.0, 0.0))
    rate = (far[-1] / far[3]) ** (1.0 / (len(far) - 4))
    assert rate == pytest.approx(orbit.largest_multiplier, rel=0.15)
    assert orbit.lyapunov == math.log(orbit.largest_multiplier)


# ------------------------------------------------------------------- what is special, and refused


def test_without_loss_orbits_with_complex_multipliers_are_neutral() -> None:
    found = at(3.0, 4.0, 1.0, max_period=3, seeds=24)
    turning = [o for o in found if o.admissible and o.multipliers[0].imag != 0.0]
    assert turning
    for orbit in turning:
        assert orbit.neutral
        assert orbit.largest_multiplier == pytest.approx(1.0, abs=1e-12)
        assert orbit.lyapunov == pytest.approx(0.0, abs=1e-12)
    for orbit in found:
        if orbit.admissible:
            assert abs(np.prod(orbit.multipliers)) == pytest.approx(1.0, rel=1e-11)
    assert not any(o.neutral for o in at(2.0, 4.0, 0.8, seeds=8))


def test_without_loss_no_orbit_is_stable() -> None:
    for amplitude in (1.5, 2.0, 3.0):
        for orbit in at(amplitude, 4.0, 1.0, max_period=3, seeds=24):
            assert not orbit.stable


@pytest.mark.parametrize("restitution", [0.5, 1.0])
def test_on_a_still_base_there_is_none_that_a_search_could_find(restitution: float) -> None:
    # Without loss a free block swings at any amplitude: no orbit stands alone.
    assert at(0.0, 2.0, restitution, seeds=8) == ()


def test_of_the_linear_model_a_block_has_the_orbits_of_its_restitution() -> None:
    shaking = Harmonic(amplitude=2.0, frequency_ratio=4.0, phase=1.0)
    found = find_orbits(HOUSNER, shaking, max_period=1, seeds=10, model="linear")
    plain = at(2.0, 4.0, HOUSNER.dimensionless().restitution, max_period=1, seeds=10)
    assert [o.states for o in found] == [o.states for o in plain]
    assert found[0].motion.phase == found[0].states[0].phase


def test_an_orbit_has_a_table_for_notebooks(many: tuple[Orbit, ...]) -> None:
    page = many[0]._repr_html_()
    assert "symmetric" in page
    assert "0.432 alpha" in page


@every(
    ("values", "name"),
    [
        ({"max_period": 0}, "max_period"),
        ({"max_period": 1.5}, "max_period"),
        ({"max_impacts": 0}, "max_impacts"),
        ({"seeds": 0}, "seeds"),
        ({"seeds": math.nan}, "seeds"),
    ],
)
def test_what_is_no_number_of_anything_is_refused(values: dict[str, int], name: str) -> None:
    with pytest.raises(InputError, match=rf"^{name} = "):
        at(2.0, 4.0, 0.8, **values)


def test_what_is_no_block_and_what_is_not_harmonic_is_refused() -> None:
    with pytest.raises(InputError, match=r"^block = 0\.8 "):
        find_orbits(0.8, Harmonic(amplitude=1.0, frequency_ratio=1.0))  # type: ignore[arg-type]
    with pytest.raises(ModelError, match=r"^motion = Still"):
        find_orbits(DimensionlessBlock(restitution=0.8), Still())  # type: ignore[arg-type]


def test_a_state_of_an_orbit_can_be_taken_on_by_hand(many: tuple[Orbit, ...]) -> None:
    orbit = many[0]
    assert isinstance(orbit.states[0], ImpactState)
    after = around(orbit)(orbit.states[0], len(orbit.states))
    assert apart(after.state, orbit.states[0]) < 1e-12


@pytest.mark.parametrize("point", [(1.01, 2.0, 0.8), (1.05, 1.0, 0.3)])
def test_an_orbit_that_comes_to_rest_is_among_them(point: tuple[float, float, float]) -> None:
    a, w, r = point
    found = find_attractor(
        DimensionlessBlock(restitution=r), Harmonic(amplitude=a, frequency_ratio=w)
    ).orbit
    assert found is not None
    assert found.rest_phases == 2
    assert any(orbit.rest_phases for orbit in at(*point, seeds=24))


def test_an_orbit_that_comes_to_rest_is_found_up_to_its_period() -> None:
    for longest in (1, 2, 3, 4):
        found = at(1.173, 6.075, 0.43, max_period=longest, seeds=1)
        resting = [orbit.period for orbit in found if orbit.rest_phases]
        assert resting == ([3] if longest >= 3 else []), longest


TWICE = FourierSeries(amplitude=0.9, frequency_ratio=3.0, harmonics=((2, 1.0, 0.0), (3, 1.0, 0.0)))


@every(
    ("block", "motion", "rests"),
    [
        ({"restitution": 0.01, "negative_restitution": 0.02}, shaken(1.9, 3.0), [1, 1]),
        ({"restitution": 0.41, "negative_restitution": 0.02}, shaken(1.9, 4.0), [1]),
        ({"restitution": 0.0, "one_sided": True}, shaken(1.8, 3.0), [1]),
        ({"restitution": 0.2}, TWICE, [2]),
    ],
)
def test_orbits_that_come_to_rest_are_followed_from_each_uplift(
    block: dict[str, Any], motion: PeriodicMotion, rests: list[int]
) -> None:
    bare = DimensionlessBlock(**block)
    resting = [orbit for orbit in find_orbits(bare, motion, seeds=1) if orbit.rest_phases]
    assert [orbit.rest_phases for orbit in resting] == rests
    settled = [find_attractor(bare, replace(motion, phase=phase)) for phase in (0.0, math.pi)]
    assert {each.peaks for each in settled} == {(each.highest, each.lowest) for each in resting}


def test_an_orbit_is_stable_where_both_multipliers_lie_inside_the_unit_circle(
    many: tuple[Orbit, ...],
) -> None:
    for pair, stable in (((0.9, 0.1), True), ((1.0, 0.1), False), ((1j, -1j), False)):
        orbit = replace(many[0], multipliers=np.array(pair, dtype=np.complex128))
        assert orbit.stable is stable, pair


def test_orbits_whose_half_cycles_no_flight_stays_on_are_given_all_the_same() -> None:
    # Half cycles of pt = 77: a run from the closed form hovers upright, to the last bit.
    found = at(2.0, 2.0, 0.8, max_period=49, max_impacts=1, seeds=1)
    longest = [orbit for orbit in found if orbit.period == 49]
    assert len(longest) == 2
    assert all(orbit.branch is not None for orbit in longest)
    assert all(math.isnan(o.residual) or math.isfinite(o.residual) for o in longest)
    assert not any(orbit.stable for orbit in longest)
