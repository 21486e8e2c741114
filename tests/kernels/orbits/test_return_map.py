"""The return map's passages against the march, their derivative against differences, invariants."""

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from rocksteady.kernels.core.clock import clock
from rocksteady.kernels.core.forcing import GRAZING_SPEED
from rocksteady.kernels.core.tables import (
    ENDED_BY_IMPACT,
    ROW_ANGLE,
    ROW_COLUMNS,
    ROW_DURATION,
    ROW_EVENT,
    ROW_HALF_CYCLES,
    ROW_PHASE,
    ROW_SIDE,
    ROW_VELOCITY,
    March,
)
from rocksteady.kernels.core.tuples import Kept, Tables, Until
from rocksteady.kernels.march.march import march
from rocksteady.kernels.orbits.return_map import (
    FALL,
    GRAZE,
    IMPACT,
    STAY,
    STUCK,
    UPLIFT,
    AnyState,
    Jacobian,
    Passage,
    Section,
    first_passage,
    highest_after,
    identity,
    next_passage,
    phase_between,
    product,
    shifted,
)
from rocksteady.kernels.orbits.systems import for_system, make_series_system, make_system
from tests.every import every
from tests.kernels.passages import (
    LOPSIDED,
    Case,
    differenced,
    even_system,
    random_case,
    state_at_phase,
)
from tests.kernels.tables import NONE, both_sides, harmonic, run
from tests.strategies import logarithmic, sample_size

Floats = NDArray[np.float64]
TWO_PI = 2.0 * math.pi


def one_impact_of_the_march(case: Case) -> tuple[March, Floats]:
    """March from a state to the first impact, and return where that led and the flight."""
    segments, state = harmonic(case.amplitude, case.frequency), case.state
    start = March(
        state.side, 0.0, state.side * state.speed, 0, state.half_cycles, state.phase, 0, 0
    )
    rows = np.zeros((1, ROW_COLUMNS))
    _, end = march(Tables(segments, case.sides), start, Until(2**60, 0.0, 0.0, 1), Kept(rows, NONE))
    return end, rows[0]


def of_kind(
    kind: int, count: int, seed: int, *, lopsided: bool = False
) -> list[tuple[Case, Passage]]:
    """Return random cases whose passage is of a kind."""
    rng = np.random.default_rng(seed)
    found: list[tuple[Case, Passage]] = []
    while len(found) < count:
        case = random_case(rng, lopsided=lopsided)
        step = next_passage(case.system, case.state, -1.0)
        if step.kind == kind:
            found.append((case, step))
    return found


# ---------------------------------------------------------------------------- against the march


def test_a_passage_is_an_impact_of_the_march_bit_for_bit() -> None:
    for case, step in of_kind(IMPACT, sample_size(3000, 1000), 1):
        end, _ = one_impact_of_the_march(case)
        assert end.impacts == 1
        assert step.state.side == end.side == -case.state.side
        assert step.state.half_cycles == end.half_cycles
        assert step.state.phase == end.phase
        assert step.state.speed == end.side * end.velocity


def test_so_it_is_for_unlike_sides_to_rounding() -> None:
    for case, step in of_kind(IMPACT, sample_size(1500, 400), 2, lopsided=True):
        end, row = one_impact_of_the_march(case)
        assert end.impacts == 1
        assert step.state.side == end.side == -case.state.side
        assert step.state.half_cycles == end.half_cycles
        assert step.state.phase == end.phase
        assert step.state.speed == pytest.approx(end.side * end.velocity, rel=1e-15)
        assert step.time == row[ROW_DURATION]


def test_a_fall_is_one_of_the_march() -> None:
    for lopsided in (False, True):
        for case, step in of_kind(FALL, sample_size(300, 100), 3, lopsided=lopsided):
            end, _ = one_impact_of_the_march(case)
            assert end.impacts == 0
            assert step.time == math.inf
            assert step.state[:3] == case.state[:3]
            assert step.state.speed == pytest.approx(case.state.speed, rel=1e-15)


@every(
    ("amplitude", "frequency", "sides"),
    [
        (2.0, 4.0, both_sides(0.8)),
        (1.3, 3.0, both_sides(0.6)),
        (1.01, 2.0, both_sides(0.8)),
        (3.0, 9.0, both_sides(0.95)),
        (1.2, 6.0, both_sides(*LOPSIDED[0])),
        (1.3, 8.0, both_sides(*LOPSIDED[2])),
        (0.6, 4.0, both_sides((0.6, 0.5), (1.0, 0.5), (1.0, 1.3))),
    ],
)
def test_the_map_meets_every_impact_rest_and_uplift_of_a_long_march(
    amplitude: float, frequency: float, sides: Floats
) -> None:
    ran = run(harmonic(amplitude, frequency, 0.3), sides, half_cycles=sample_size(200, 30))
    system = make_system(amplitude, frequency, sides)
    rows = ran.rows
    steps = 0
    for row, later in pairwise(rows):
        side = int(row[ROW_SIDE])
        at, phase = int(row[ROW_HALF_CYCLES]), float(row[ROW_PHASE])
        assert row[ROW_ANGLE] == 0.0
        step = (
            first_passage(system, AnyState(0, at, phase, 0.0, 0.0))
            if side == 0
            else next_passage(system, Section(side, at, phase, abs(row[ROW_VELOCITY])), -1.0)
        )
        if side == 0:
            assert step.kind == UPLIFT
        elif later[ROW_SIDE] == 0.0:  # the impact after which the march proves rest
            assert step.kind in (IMPACT, GRAZE)
            here = step.state
            assert next_passage(system, here, -1.0).kind in (UPLIFT, STAY)
            assert [here.half_cycles, here.phase] == pytest.approx(
                [later[ROW_HALF_CYCLES], later[ROW_PHASE]], abs=1e-12
            )
            continue
        else:
            assert row[ROW_EVENT] == ENDED_BY_IMPACT
            assert step.kind == (IMPACT if step.landing > GRAZING_SPEED else GRAZE)
        steps += 1
        assert step.state.side == later[ROW_SIDE]
        passed = phase_between(
            Section(1, at, phase, 0.0),
            Section(1, int(later[ROW_HALF_CYCLES]), float(later[ROW_PHASE]), 0.0),
        )
        assert phase_between(Section(1, at, phase, 0.0), step.state) == pytest.approx(
            passed, rel=1e-12, abs=1e-15
        )
        assert step.time == pytest.approx(row[ROW_DURATION], rel=1e-12)
        assert step.state.speed == pytest.approx(abs(later[ROW_VELOCITY]), rel=1e-11, abs=1e-16)
    assert steps > 20


def test_the_first_passage_from_any_state_is_the_first_impact_of_the_march() -> None:
    rng = np.random.default_rng(6)
    for _ in range(sample_size(1000, 300)):
        case = random_case(rng, lopsided=bool(rng.random() < 0.4))
        angle, velocity = rng.uniform(-1.2, 1.2), rng.normal()
        half, phase, side = case.state.half_cycles, case.state.phase, int(math.copysign(1, angle))
        step = first_passage(case.system, AnyState(side, half, phase, angle, velocity))
        start = March(side, angle, velocity, 0, half, phase, 0, 0)
        rows = np.zeros((1, ROW_COLUMNS))
        _, end = march(
            Tables(harmonic(case.amplitude, case.frequency), case.sides),
            start,
            Until(2**60, 0.0, 0.0, 1),
            Kept(rows, NONE),
        )
        if step.kind == FALL:
            assert end.impacts == 0
            continue
        assert end.impacts == 1
        assert step.state[:3] == (end.side, end.half_cycles, end.phase)
        assert step.state.speed == pytest.approx(abs(end.velocity), rel=1e-15)


# ------------------------------------------------------------------------------- its derivative


@pytest.mark.parametrize("lopsided", [False, True])
def test_the_jacobian_agrees_with_central_differences(lopsided: bool) -> None:
    # Together 4,000 states with speeds after the impact above 1e-2, in extended precision.
    rng, checked = np.random.default_rng(10 + lopsided), 0
    while checked < sample_size(2000, 800):
        case = random_case(rng, lopsided=lopsided)
        step = next_passage(case.system, case.state, -1.0)
        if step.kind != IMPACT or step.state.speed < 1e-2:
            continue
        checked += 1
        truth = differenced(case, step.time)
        found = np.array(step.jacobian).reshape(2, 2)
        assert np.abs(found - truth).max() <= 1e-6 * np.abs(truth).max(), case


@pytest.mark.parametrize("lopsided", [False, True])
def test_its_determinant_is_that_of_a_flow_that_keeps_area(lopsided: bool) -> None:
    # v' dv' dphi' = restitution^2 v dv dphi, also where the sides have units of their own.
    for case, step in of_kind(IMPACT, sample_size(2000, 800), 20 + lopsided, lopsided=lopsided):
        j = step.jacobian
        square = sum(entry * entry for entry in j)
        loss = case.sides[case.row, 0] ** 2
        expected = loss * case.state.speed / step.state.speed
        found = j.phase_by_phase * j.speed_by_speed - j.phase_by_speed * j.speed_by_phase
        assert abs(found - expected) <= 1e-12 * square


def test_derivatives_multiply_like_matrices() -> None:
    rng = np.random.default_rng(7)
    one, other = (Jacobian(*rng.normal(size=4).tolist()) for _ in range(2))
    matrices = [np.array(j).reshape(2, 2) for j in (one, other)]
    assert np.allclose(np.array(product(one, other)).reshape(2, 2), matrices[0] @ matrices[1])
    assert product(one, identity()) == one == product(identity(), one)


def test_the_derivative_of_several_passages_is_the_product() -> None:
    rng, checked = np.random.default_rng(8), 0
    while checked < sample_size(200, 20):
        case = random_case(rng, lopsided=bool(checked % 2))
        total, state = identity(), case.state
        ends: list[Section] = []
        kinds: list[int] = []
        for df, dv in ((0.0, 0.0), (1e-7, 0.0), (-1e-7, 0.0), (0.0, 1e-7), (0.0, -1e-7)):
            here = shifted(case.state, df, dv)
            kinds = []
            for _ in range(3):
                step = next_passage(case.system, here, -1.0)
                kinds.append(step.kind if step.landing > 0.05 else GRAZE)
                here = step.state
                if kinds[-1] != IMPACT:
                    break
            ends.append(here)
        if kinds != [IMPACT] * 3:
            continue
        for _ in range(3):
            step = next_passage(case.system, state, -1.0)
            total, state = product(step.jacobian, total), step.state
        largest = max(abs(entry) for entry in total)
        if largest > 100.0:  # differences in doubles need room
            continue
        checked += 1
        columns = [
            [phase_between(less, more) / 2e-7, (more.speed - less.speed) / 2e-7]
            for more, less in ((ends[1], ends[2]), (ends[3], ends[4]))
        ]
        truth = np.array(columns).T
        found = np.array(total).reshape(2, 2)
        assert np.abs(found - truth).max() <= 1e-4 * max(1.0, largest)


# ---------------------------------------------------------------------------------- symmetries


@given(
    amplitude=st.floats(0.0, 12.0),
    frequency=logarithmic(0.05, 200.0),
    restitution=st.floats(0.05, 1.0),
    phase=st.floats(0.0, math.pi, exclude_max=True),
    half=st.integers(-(2**40), 2**40),
    speed=logarithmic(1e-6, 3.0),
)
def test_the_mirror_image_of_a_passage_is_that_of_its_mirror_image_and_periods_do_not_count(
    amplitude: float, frequency: float, restitution: float, phase: float, half: int, speed: float
) -> None:
    system = even_system(amplitude, frequency, restitution)
    here = next_passage(system, Section(1, half % 2, phase, speed), -1.0)
    mirrored = next_passage(system, Section(-1, half % 2 + 1, phase, speed), -1.0)
    later = next_passage(system, Section(1, half, phase, speed), -1.0)
    for other, side, moved in ((mirrored, -1, 1), (later, 1, half - half % 2)):
        assert other.kind == here.kind
        state = here.state
        assert other.state == Section(
            side * state.side, state.half_cycles + moved, state.phase, state.speed
        )
        assert (other.time, other.landing) == (here.time, here.landing)
        assert other.jacobian == here.jacobian or here.kind == GRAZE


@every(("restitution", "lean", "rate"), LOPSIDED)
def test_a_block_whose_sides_are_exchanged_moves_as_the_mirror_image(
    restitution: tuple[float, float], lean: tuple[float, float], rate: tuple[float, float]
) -> None:
    sides = both_sides(restitution, lean, rate)
    one, other = make_system(1.7, 3.0, sides), make_system(1.7, 3.0, sides[::-1].copy())
    for phase in np.linspace(0.1, 3.0, 12).tolist():
        here = next_passage(one, Section(1, 0, phase, 0.3), -1.0)
        there = next_passage(other, Section(-1, 1, phase, 0.3), -1.0)
        assert there.kind == here.kind
        assert there.jacobian == here.jacobian
        assert there.state.side == -here.state.side
        assert there.state[1:] == (here.state.half_cycles + 1, *here.state[2:])


def test_a_guess_changes_nothing_but_rounding() -> None:
    for case, step in of_kind(IMPACT, sample_size(500, 50), 9):
        for factor in (1.0, 0.7, 1.5):
            again = next_passage(case.system, case.state, factor * step.time)
            assert again.kind == IMPACT
            assert again.state.side == step.state.side
            slack = 1e-12 * (1.0 + case.frequency * step.time) * (1.0 + 1.0 / step.landing)
            assert abs(phase_between(step.state, again.state)) <= slack
            assert again.state.speed == pytest.approx(step.state.speed, abs=slack)


# --------------------------------------------------------------- what is no plain impact


@pytest.mark.parametrize("side", [1, -1])
def test_chatter_ends_in_an_uplift_at_the_phase_at_which_the_base_lifts_the_block(
    side: int,
) -> None:
    system = even_system(2.0, 4.0, 0.8)
    # Sinking base acceleration, |a| < 1: the next uplift is on the negative side, at 2 sin = -1.
    for phase in np.linspace(2.7, 3.5, 9).tolist():
        step = next_passage(system, state_at_phase(side, phase, 1e-6), -1.0)
        assert step.kind == UPLIFT
        assert (step.state.side, step.state.speed, step.landing) == (-1, 0.0, 0.0)
        assert step.state.half_cycles == 1
        assert step.state.phase == pytest.approx(math.asin(0.5), abs=1e-15)
        assert step.jacobian == (0.0, 0.0, 0.0, 0.0)
        assert step.time == pytest.approx((math.pi + math.asin(0.5) - phase) / 4.0)
        lifted = next_passage(system, step.state, -1.0)
        assert lifted.kind == IMPACT
        assert lifted.landing > 0.1


def test_a_lopsided_block_lifts_on_the_side_whose_threshold_comes_first() -> None:
    # The negative side is the slenderer: it lifts below an acceleration of -0.5.
    system = make_system(0.8, 2.0, both_sides((0.7, 0.7), (1.0, 0.5)))
    step = next_passage(system, state_at_phase(1, 0.2, 1e-7), -1.0)
    assert step.kind == UPLIFT
    assert step.state.side == -1
    phase = step.state.half_cycles * math.pi + step.state.phase
    assert phase == pytest.approx(math.pi + math.asin(0.5 / 0.8), abs=1e-15)


@every("amplitude", [0.0, 0.5, 0.999])
def test_without_uplift_chatter_ends_in_rest_for_ever(amplitude: float) -> None:
    system = even_system(amplitude, 4.0, 0.8)
    state = state_at_phase(1, 0.4, 1e-5)
    step = next_passage(system, state, -1.0)
    assert (step.kind, step.time) == (STAY, math.inf)
    assert first_passage(system, AnyState(0, 0, 0.0, 0.0, 0.0)).kind == STAY
    # So it does where the same amplitude bounds two waves.
    shares = np.array([0.6, 0.0, 0.0, -0.4])
    series = make_series_system(amplitude, 4.0, both_sides(0.8), shares, np.empty((2, 2)))
    step = for_system(next_passage, series)(series, state, -1.0)
    assert (step.kind, step.time, step.state.side) == (STAY, math.inf, 0)


@every("speed", [1e-12, 5e-10, 1.2e-9, 1e-8])
def test_a_bounce_off_a_base_that_lifts_the_other_side_grazes_below_a_speed(speed: float) -> None:
    # At phase 4 the base lifts the negative side; a bounce to the positive one is over at once.
    step = next_passage(even_system(2.0, 2.0, 0.8), state_at_phase(1, 4.0, speed), -1.0)
    assert step.landing == pytest.approx(speed, rel=1e-6)
    assert step.kind == (GRAZE if step.landing <= GRAZING_SPEED else IMPACT)
    assert step.state.side == -1
    assert step.state.speed == pytest.approx(0.8 * speed, rel=1e-6)


def test_an_upright_block_on_a_still_base_is_the_only_search_without_an_end() -> None:
    step = first_passage(even_system(0.0, 1.0, 0.8), AnyState(1, 0, 0.0, 1.0, 0.0))
    assert step.kind == STUCK


# ------------------------------------------------------------------------------- small helpers


@given(
    phase=st.floats(0.0, 3.14),
    move=st.floats(-20.0, 20.0),
    half=st.integers(-1000, 1000),
    speed=st.floats(0.0, 2.0),
)
def test_a_shifted_state_is_as_far_from_the_first_as_it_was_shifted(
    phase: float, move: float, half: int, speed: float
) -> None:
    state = Section(-1, half, phase, speed)
    moved = shifted(state, move, 0.25)
    assert phase_between(state, moved) == pytest.approx(move, abs=1e-14 * (1.0 + abs(move)))
    assert 0.0 <= moved.phase < math.pi
    assert (moved.side, moved.speed) == (-1, speed + 0.25)


def test_the_highest_angle_on_the_way_is_that_of_the_sampled_flight() -> None:
    for lopsided in (False, True):
        cases = of_kind(IMPACT, sample_size(200, 20), 30 + lopsided, lopsided=lopsided)
        for case, step in cases:
            lean, rate = case.sides[case.row, 1:]
            a, w = case.amplitude / lean, case.frequency / rate
            beta = a / (1.0 + w * w)
            state = case.state
            phase = state.phase + (state.half_cycles % 2 + (state.side < 0)) * math.pi
            s = np.linspace(0.0, step.time * rate, 4001)
            y = (
                (state.speed / (lean * rate) + beta * w * math.cos(phase)) * np.sinh(s)
                + (beta * math.sin(phase) - 1.0) * np.cosh(s)
                + 1.0
                - beta * np.sin(w * s + phase)
            )
            # Between samples it is higher by no more than |y''| (step/2)^2 / 2.
            between = (1.0 + a + np.abs(y).max()) * (s[1] / 2.0) ** 2 / 2.0
            here, other = highest_after(case.system, state, step)
            assert other == 0.0
            above = here / lean - y.max()
            noise = 1e-13 * (1.0 + beta * (1.0 + w)) * math.exp(s[-1])
            assert -noise <= above <= between + noise


def test_before_a_rest_the_first_bounce_to_either_side_is_the_highest() -> None:
    system = even_system(2.0, 4.0, 0.8)
    speed = 1e-6
    state = state_at_phase(1, 3.0, speed)
    # So slow a bounce is a parabola, under a pull that hardly changes.
    pull = 1.0 - 2.0 * math.sin(3.0)
    other_pull = 1.0 + 2.0 * math.sin(3.0)
    here, other = highest_after(system, state, next_passage(system, state, -1.0))
    assert here == pytest.approx(speed**2 / (2.0 * pull), rel=1e-4)
    assert other == pytest.approx((0.8 * speed) ** 2 / (2.0 * other_pull), rel=1e-4)
    resting = Section(state.side, state.half_cycles, state.phase, 0.0)
    assert highest_after(system, resting, next_passage(system, resting, -1.0)) == (0.0, 0.0)


def test_the_clock_of_a_passage_does_not_drift() -> None:
    # On a stable orbit, 200,000 periods from the start.
    system, count = even_system(2.0, 4.0, 0.8), sample_size(2000, 100)
    half, phase = clock(2.846542542894803)
    state = Section(1, half + 400_000, phase, 0.7323890872)
    for _ in range(count):
        state = next_passage(system, state, -1.0).state
    assert state.phase == pytest.approx(phase, abs=1e-9)
    assert state.half_cycles == half + 400_000 + count
