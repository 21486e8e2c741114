"""Time histories against an integrator, from every start, and by symmetry."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    Rest,
    State,
    Status,
    Steady,
    Still,
    simulate,
)
from rocksteady.errors import InputError, ModelError
from rocksteady.formulas import steady_states
from rocksteady.motions import Segment
from tests.dynamics.integrator import integrate
from tests.dynamics.runs import BARE, half_sine, pulse, rocked
from tests.every import every

# ------------------------------------------------------------------- against an integrator


@every(
    ("a", "w", "r", "angle", "velocity", "phase"),
    [
        (2.0, 4.0, 0.8, 0.0, 0.3, 0.0),
        (2.0, 6.0, 0.8, 0.3, 0.0, 1.0),
        (3.0, 2.3, 0.9, -0.2, 0.1, 2.5),
        (0.4, 1.0, 0.95, -0.5, 0.0, -1.0),
        (6.0, 12.0, 0.5, 0.0, -0.2, 1.0),
        (1.0, 12.0, 1.0, 0.05, 0.0, 0.3),
    ],
)
def test_impacts_and_angles_are_those_of_an_adaptive_integrator(
    a: float, w: float, r: float, angle: float, velocity: float, phase: float
) -> None:
    run = rocked(a, w, r, angle, velocity, phase, cycles=4)
    oracle = integrate(
        lambda s: a * math.sin(w * s + phase),
        4.0 * 2.0 * math.pi / w,
        alpha=1.0,
        p=1.0,
        restitution=r,
        angle=angle,
        velocity=velocity,
        longest_step=0.05 / w,
    )
    assert len(run.impacts) == len(oracle.impacts) > 0
    np.testing.assert_allclose(run.impacts.pt, oracle.impacts, rtol=0.0, atol=2e-8)
    np.testing.assert_allclose(run.impacts.velocity_before, oracle.before, rtol=0.0, atol=2e-7)
    np.testing.assert_allclose(run.impacts.velocity_after, oracle.after, rtol=0.0, atol=2e-7)
    inside = oracle.times <= run.end_time_pt
    angles = run(oracle.times[inside]).angle
    np.testing.assert_allclose(angles, oracle.angles[inside], rtol=0.0, atol=2e-7)


def test_a_real_block_in_seconds_metres_and_g() -> None:
    block = Block.rectangle(width=0.5, height=1.6, restitution=0.9)
    g, accel_g, hertz, phase = block.gravity, 0.4, 2.3, 0.7
    run = simulate(
        block,
        Harmonic.from_si(block, acceleration_m_s2=accel_g * g, frequency_hz=hertz, phase=phase),
        start=State(angle=0.1, velocity=-0.2),
        cycles=5,
        model="linear",
    )
    alpha, p = math.atan2(0.5, 1.6), math.sqrt(0.75 * g / (0.5 * math.hypot(0.5, 1.6)))
    oracle = integrate(
        lambda t: accel_g * math.sin(2.0 * math.pi * hertz * t + phase),
        5.0 / hertz,
        alpha=alpha,
        p=p,
        restitution=0.9,
        angle=0.1 * alpha,
        velocity=-0.2 * alpha * p,
        longest_step=0.01,
    )
    assert len(run.impacts) == len(oracle.impacts) > 3
    np.testing.assert_allclose(run.impacts.pt / p, oracle.impacts, rtol=0.0, atol=1e-8)
    np.testing.assert_allclose(
        run.impacts.velocity_after * alpha * p, oracle.after, rtol=0.0, atol=1e-7
    )
    inside = oracle.times <= run.end_time_pt / p
    np.testing.assert_allclose(
        run.at_time(oracle.times[inside]).angle * alpha,
        oracle.angles[inside],
        rtol=0.0,
        atol=1e-8,
    )


def test_the_time_of_overturning_is_the_last_upward_crossing_of_alpha() -> None:
    run = rocked(2.0, 1.7, 0.8, 0.0, 0.5, cycles=100)
    assert run.status is Status.OVERTURNED
    assert run.overturn_time_pt is not None
    s = np.linspace(0.0, run.end_time_pt, 400_001)
    beyond = np.abs(run(s).angle) >= 1.0
    last_inside = int(np.flatnonzero(~beyond)[-1])
    assert s[last_inside] <= run.overturn_time_pt <= s[last_inside + 1]
    assert abs(float(run(run.overturn_time_pt).angle)) == pytest.approx(1.0, abs=1e-12)
    inside = np.abs(run(s[s <= run.overturn_time_pt]).angle).max()
    assert run.peak >= inside - 1e-12
    assert run.peak == pytest.approx(max(1.0, inside), abs=1e-6)
    assert run.overturn_time_tau == pytest.approx(1.7 * run.overturn_time_pt)
    assert run.overturn_time_s is None, "there is no block"


def test_a_swing_beyond_alpha_that_comes_back_does_not_overturn() -> None:  # TW7
    run = simulate(BARE, Harmonic(amplitude=2.0, frequency_ratio=1.85), start=Steady(), cycles=400)
    assert run.status is Status.ROCKING
    s = run.end_time_pt - np.linspace(0.0, 20.0 * math.pi / 1.85, 40_001)
    settled = run(s).angle
    assert sorted([settled.max(), -settled.min()]) == pytest.approx([0.36025, 1.01036], abs=2e-5)
    assert run.overturn_time_pt is None


# -------------------------------------------------------------------- starts and boundaries


@every("a", [0.0, 0.3, 0.999, 1.0])
@every("w", [0.05, 3.0, 400.0])
def test_a_block_at_rest_stays_below_uplift(a: float, w: float) -> None:
    run = simulate(BARE, Harmonic(amplitude=a, frequency_ratio=w, phase=0.4), cycles=30)
    assert run.status is Status.AT_REST
    assert (run.peak, len(run.impacts), run.rest_time_pt) == (0.0, 0, 0.0)
    assert run.end_time_pt == pytest.approx(30.0 * 2.0 * math.pi / w, rel=1e-14)
    assert not run(np.linspace(0.0, run.end_time_pt, 50)).angle.any()


@given(st.floats(1.001, 6.0), st.floats(0.1, 30.0), st.sampled_from([0.0, math.pi]))
@settings(max_examples=30)
def test_a_block_at_rest_lifts_when_the_base_reaches_alpha_g(
    a: float, w: float, phase: float
) -> None:
    run = simulate(BARE, Harmonic(amplitude=a, frequency_ratio=w, phase=phase), cycles=1)
    lifting = math.asin(1.0 / a) / w
    assert run.flights.side[:2].tolist() == [0, 1 if phase == 0.0 else -1]
    assert run.flights.pt[1] == pytest.approx(lifting, rel=1e-12)
    begin = run(run.flights.pt[1])
    assert [float(begin.angle), float(begin.velocity)] == [0.0, 0.0]


def test_a_start_with_the_base_beyond_uplift_picks_the_lifting_side() -> None:
    for phase, side in ((0.5 * math.pi, 1), (-0.5 * math.pi, -1)):
        run = simulate(BARE, Harmonic(amplitude=2.0, frequency_ratio=4.0, phase=phase), cycles=1)
        assert run.flights.side[0] == side
        assert run.flights.pt[0] == 0.0


@pytest.mark.parametrize("side", [1, -1])
def test_a_start_beyond_alpha_overturns_at_once_unless_it_is_thrown_back(side: int) -> None:
    out = simulate(BARE, Still(), start=State(angle=1.2 * side, velocity=0.0))
    assert (out.status, out.overturn_time_pt, out.peak) == (Status.OVERTURNED, 0.0, 1.2)
    # growing part (u - 1 + v)/2: thrown back faster than 0.2 it returns, slower it does not
    back = simulate(BARE, Still(), start=State(angle=1.2 * side, velocity=-0.2001 * side))
    assert back.status is Status.AT_REST
    assert back.peak == pytest.approx(1.2)
    slow = simulate(BARE, Still(), start=State(angle=1.2 * side, velocity=-0.1999 * side))
    assert slow.status is Status.OVERTURNED
    assert slow.overturn_time_pt == 0.0, "it never came below alpha"


def test_a_start_beyond_alpha_that_dips_below_it_overturns_when_it_rises_again() -> None:
    # u - 1 = 0.2 cosh s - v sinh s with shaking that pushes it out again
    run = simulate(
        BARE,
        pulse(Segment(duration=1.0), Segment(duration=1.0, constant=3.0)),
        start=State(angle=1.2, velocity=-0.3),
    )
    assert run.status is Status.OVERTURNED
    assert run.overturn_time_pt is not None
    s = np.linspace(0.0, min(run.end_time_pt, 2.0), 20_001)
    below = s[np.abs(run(s).angle) < 1.0]
    assert below[-1] == pytest.approx(run.overturn_time_pt, abs=2e-4)
    assert len(run.impacts) == 0


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_block_balanced_on_its_edge_neither_falls_nor_returns(side: float) -> None:
    run = simulate(BARE, Still(), start=State(angle=side, velocity=0.0))
    assert run.status is Status.ROCKING
    assert run.peak == 1.0
    np.testing.assert_array_equal(run([0.0, 10.0, 1000.0]).angle, side)
    nudged = simulate(BARE, Still(), start=State(angle=side * (1.0 + 1e-14), velocity=0.0))
    assert nudged.status is Status.OVERTURNED
    held = simulate(BARE, Still(), start=State(angle=side * (1.0 - 1e-14), velocity=0.0))
    assert held.status is Status.AT_REST


@every("velocity", [1.0 + 1e-12, 2.0, 1e8, 1e12])
def test_a_fast_start_overturns_however_fast(velocity: float) -> None:
    run = simulate(BARE, Still(), start=State(angle=0.0, velocity=velocity))
    assert run.status is Status.OVERTURNED
    if velocity > 1.5:  # u = 1 - cosh s + v sinh s reaches 1 where tanh s = 1/v
        assert run.overturn_time_pt == pytest.approx(math.atanh(1.0 / velocity), rel=1e-3)


def test_free_rocking_comes_to_rest_in_the_sum_of_its_half_periods() -> None:
    run = simulate(
        DimensionlessBlock(restitution=0.5), Still(), start=State(angle=0.5, velocity=0.0)
    )
    energy = 1.0 - 0.25
    total = math.acosh(2.0) + sum(
        2.0 * math.atanh(math.sqrt(0.25**i * energy)) for i in range(1, 60)
    )
    assert run.rest_time_pt == pytest.approx(total, abs=1e-7)
    assert run.status is Status.AT_REST


def test_a_rested_block_is_lifted_again_and_again_by_the_next_cycles() -> None:
    run = simulate(
        DimensionlessBlock(restitution=0.3), Harmonic(amplitude=1.1, frequency_ratio=8.0), cycles=20
    )
    lifted = np.flatnonzero(run.flights.ended_by == 3)
    assert len(lifted) == 40, "twice a cycle"
    assert not run.flights.side[lifted].any()
    lifts = run.flights.pt[lifted + 1]
    phases = (8.0 * lifts) % math.pi
    np.testing.assert_allclose(phases, math.asin(1.0 / 1.1), atol=1e-11)


# ------------------------------------------------------------------------------- symmetries


@every("start", [(0.0, 0.3), (0.4, -0.2), (-0.6, 0.0), (0.0, -1e-9)])
@every("a", [0.5, 2.0, 5.0])
def test_a_mirrored_start_under_mirrored_shaking_gives_the_mirrored_motion(
    start: tuple[float, float], a: float
) -> None:
    one = rocked(a, 4.0, 0.8, *start, phase=0.7, cycles=20)
    other = rocked(a, 4.0, 0.8, -start[0], -start[1], phase=0.7 + math.pi, cycles=20)
    assert one.status is other.status
    assert len(one.impacts) == len(other.impacts)
    # Chaotic cases multiply the rounding of 0.7 + pi: compare what it cannot reach.
    n = min(len(one.impacts), 8)
    np.testing.assert_allclose(one.impacts.pt[:n], other.impacts.pt[:n], rtol=1e-8, atol=1e-15)
    np.testing.assert_array_equal(one.impacts.side[:n], -other.impacts.side[:n])
    until = float(one.impacts.pt[n - 1]) if n else min(one.end_time_pt, other.end_time_pt)
    s = np.linspace(0.0, 0.999 * until, 200)
    np.testing.assert_allclose(one(s).angle, -other(s).angle, atol=1e-8)


def test_phases_that_differ_by_a_full_turn_are_the_same() -> None:
    one, other = (
        rocked(2.0, 4.0, 0.8, 0.1, 0.2, phase, cycles=5) for phase in (0.5, 0.5 - 2 * math.pi)
    )
    np.testing.assert_allclose(one.impacts.pt, other.impacts.pt, rtol=1e-11)


def test_a_run_taken_up_where_another_ended_goes_on_as_if_it_had_not() -> None:
    whole = rocked(2.0, 4.0, 0.8, 0.1, 0.2, cycles=6.5)
    first = rocked(2.0, 4.0, 0.8, 0.1, 0.2, cycles=2.25)
    middle = first(first.end_time_pt)
    assert first.end_time_pt == pytest.approx(2.25 * 2.0 * math.pi / 4.0, rel=1e-14)
    second = rocked(
        2.0,
        4.0,
        0.8,
        float(middle.angle),
        float(middle.velocity),
        phase=2.25 * 2.0 * math.pi,
        cycles=4.25,
    )
    s = np.linspace(0.0, second.end_time_pt * 0.999, 300)
    np.testing.assert_allclose(second(s).angle, whole(first.end_time_pt + s).angle, atol=1e-9)
    assert len(first.impacts) + len(second.impacts) == len(whole.impacts)


def test_the_same_motion_as_one_segment_or_several() -> None:
    a, w = 2.0, 4.0
    cut = 0.37
    pieces = (
        Segment(duration=cut, amplitude=a, frequency=w),
        Segment(duration=3.0 - cut, amplitude=a, frequency=w, phase=w * cut),
    )
    whole = pulse(Segment(duration=3.0, amplitude=a, frequency=w))
    one = simulate(BARE, whole, start=State(angle=0.1, velocity=0.1))
    two = simulate(BARE, pulse(*pieces), start=State(angle=0.1, velocity=0.1))
    assert one.status is two.status
    n = min(len(one.impacts), len(two.impacts), 12)
    np.testing.assert_allclose(one.impacts.pt[:n], two.impacts.pt[:n], rtol=1e-11)
    assert len(two.flights) > len(one.flights)


# ------------------------------------------------------------------------------- long runs


@pytest.mark.slow
def test_a_million_cycles_do_not_drift() -> None:
    states = steady_states(2.0, 4.0, 0.8)
    run = simulate(
        BARE, Harmonic(amplitude=2.0, frequency_ratio=4.0), start=Steady(), cycles=1_000_000.25
    )
    impacts = run.impacts
    assert len(impacts) == 2_000_000
    # The clock counts half cycles as integers, and the phase within them never moves.
    assert (np.diff(impacts.half_cycles) == 1).all()
    assert np.abs(impacts.phase - float(states.phase[0])).max() < 1e-13
    assert np.abs(np.abs(impacts.velocity_after) / states.velocity[0] - 1.0).max() < 1e-12
    assert states.peak is not None
    assert run.peak == pytest.approx(states.peak[0], abs=1e-12)


def test_half_cycles_and_phase_say_the_time_of_each_impact() -> None:
    run = rocked(2.0, 4.0, 0.8, 0.1, 0.2, phase=1.0, cycles=30)
    impacts = run.impacts
    assert ((impacts.phase >= 0.0) & (impacts.phase < math.pi)).all()
    clock = (impacts.half_cycles * math.pi + impacts.phase - 1.0) / 4.0
    np.testing.assert_allclose(clock, impacts.pt, rtol=1e-14)


def test_the_most_flights_end_a_run_as_undecided() -> None:
    run = rocked(2.0, 4.0, 0.8, 0.0, 0.3, cycles=50, max_flights=7)
    whole = rocked(2.0, 4.0, 0.8, 0.0, 0.3, cycles=50)
    assert run.status is Status.UNDECIDED
    assert len(run.flights) == 7
    np.testing.assert_allclose(run.impacts.pt, whole.impacts.pt[: len(run.impacts)], rtol=1e-14)
    assert run.end_time_pt < whole.end_time_pt
    assert run.overturn_time_pt is run.rest_time_pt is None
    assert np.isfinite(run(np.linspace(0.0, run.end_time_pt, 100)).angle).all()


def test_a_run_that_is_repeated_is_the_same_to_the_last_bit() -> None:
    runs = [rocked(5.0, 12.0, 0.9, 0.0, 0.3, cycles=200) for _ in range(2)]
    np.testing.assert_array_equal(runs[0].rows, runs[1].rows)


# ---------------------------------------------------------------------------- bad arguments


@every(
    ("name", "value"),
    [
        ("cycles", 0.0),
        ("cycles", -1.0),
        ("cycles", math.nan),
        ("cycles", math.inf),
        ("cycles", 1e300),
        ("cycles", "10"),
        ("max_flights", 0),
        ("max_flights", 1.5),
    ],
)
def test_a_bad_number_is_refused(name: str, value: Any) -> None:
    with pytest.raises(InputError, match=f"^{name} = "):
        simulate(BARE, Harmonic(amplitude=2.0, frequency_ratio=4.0), **{name: value})


@every("value", [0, 2, "+", 1.5])
def test_a_steady_start_is_left_on_one_of_two_sides(value: Any) -> None:
    with pytest.raises(InputError, match=r"^side = "):
        Steady(side=value)


@every("value", [math.nan, math.inf, 1e60, "0", None, True])
def test_a_bad_state_is_refused(value: Any) -> None:
    with pytest.raises(InputError, match=r"^angle = "):
        State(angle=value, velocity=0.0)
    with pytest.raises(InputError, match=r"^velocity = "):
        State(angle=0.0, velocity=value)
    with pytest.raises(InputError, match=r"^velocity_tau = "):
        State.per_tau(angle=0.0, velocity_tau=value, frequency_ratio=4.0)


def test_a_state_per_tau_is_the_papers() -> None:
    assert State.per_tau(angle=0.1, velocity_tau=0.2, frequency_ratio=4.0) == State(
        angle=0.1, velocity=0.8
    )


@every(
    ("arguments", "name"),
    [({"branch": 3}, "branch"), ({"branch": 0}, "branch"), ({"order": 2}, "order")],
)
def test_a_bad_steady_start_is_refused(arguments: dict[str, int], name: str) -> None:
    with pytest.raises(InputError, match=f"^{name} = "):
        Steady(**arguments)


def test_a_steady_start_needs_harmonic_shaking() -> None:
    with pytest.raises(ModelError, match="needs harmonic shaking"):
        simulate(BARE, Still(), start=Steady())
    with pytest.raises(ModelError, match="needs harmonic shaking"):
        simulate(BARE, half_sine(2.0, 1.0), start=Steady())


def test_a_steady_start_where_none_exists_says_from_which_amplitude_one_does() -> None:
    with pytest.raises(ModelError, match=r"0\.260201 or above"):
        simulate(BARE, Harmonic(amplitude=0.2, frequency_ratio=4.0), start=Steady())


def test_a_steady_start_through_the_floor_is_refused() -> None:
    with pytest.raises(ModelError, match="through the floor"):
        simulate(BARE, Harmonic(amplitude=2.0, frequency_ratio=4.0), start=Steady(branch=2))


def test_a_steady_start_overrides_the_phase_and_says_so_in_the_motion() -> None:
    run = simulate(BARE, Harmonic(amplitude=2.0, frequency_ratio=4.0, phase=1.0), start=Steady())
    assert isinstance(run.motion, Harmonic)
    assert run.motion.phase == pytest.approx(2.8465425429)


def test_rest_is_the_default_start() -> None:
    motion = Harmonic(amplitude=2.0, frequency_ratio=4.0)
    one, other = simulate(BARE, motion), simulate(BARE, motion, start=Rest())
    zero = simulate(BARE, motion, start=State(angle=0.0, velocity=0.0))
    np.testing.assert_array_equal(one.rows, other.rows)
    np.testing.assert_array_equal(one.rows, zero.rows)
