"""A trajectory as a function of time, and its impacts and flights as arrays."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    Piecewise,
    State,
    Status,
    Steady,
    Still,
    simulate,
)
from rocksteady.errors import InputError, ModelError
from rocksteady.histories import Trajectory
from rocksteady.model.equations import Linear
from rocksteady.motions import Segment
from tests.every import every

BARE = DimensionlessBlock(restitution=0.8)
ELASTIC = DimensionlessBlock(restitution=1.0)
BLOCK = Block.from_p(alpha=0.2, p=3.0, restitution=0.8)


def rocking(block: Any = BARE, cycles: float = 12.3, phase: float = 0.4) -> Trajectory:
    return simulate(
        block,
        Harmonic(amplitude=2.0, frequency_ratio=4.0, phase=phase),
        start=State(angle=0.3, velocity=0.1),
        cycles=cycles,
    )


def free(block: Any = BARE, angle: float = 0.6) -> Trajectory:
    return simulate(block, Still(), start=State(angle=angle, velocity=0.0))


def shaken_in_pieces() -> Trajectory:
    pieces = (
        Segment(duration=0.7, amplitude=2.0, frequency=5.0, phase=0.3),
        Segment(duration=0.5, constant=-1.2, slope=2.0),
        Segment(duration=0.4, jump=0.3),
        Segment(duration=1.0, amplitude=-0.7, frequency=3.0, constant=0.2),
    )
    return simulate(BARE, Piecewise(pieces=pieces), start=State(angle=0.2, velocity=-0.1))


KINDS: dict[str, Callable[[], Trajectory]] = {
    "harmonic": rocking,
    "free": free,
    "pieces": shaken_in_pieces,
}
kinds = every("run", [make() for make in KINDS.values()])


def inside_flights(run: Trajectory) -> NDArray[np.float64]:
    """Times well inside each of the first flights."""
    starts, spans = run.flights.pt[:20], np.minimum(run.flights.duration[:20], 1.0)
    moving = run.flights.side[:20] != 0
    times: NDArray[np.float64] = (
        starts[:, np.newaxis] + spans[:, np.newaxis] * np.array([0.2, 0.5, 0.8])
    )[moving]
    return times.ravel()


# ---------------------------------------------------------------------------- the functions


@kinds
def test_velocity_and_acceleration_are_the_derivatives(run: Trajectory) -> None:
    s = inside_flights(run)
    spans = np.repeat(np.minimum(run.flights.duration[:20], 1.0)[run.flights.side[:20] != 0], 3)
    keep = spans > 1e-3
    s, h = s[keep], 1e-3 * spans[keep]
    before, at, after = run(s - h), run(s), run(s + h)
    scale = h**2 * (1.0 + 4.0 * 25.0)
    assert (np.abs((after.angle - before.angle) / (2.0 * h) - at.velocity) < scale).all()
    assert (
        np.abs((after.velocity - before.velocity) / (2.0 * h) - at.acceleration) < 5.0 * scale
    ).all()


@kinds
def test_the_motion_obeys_the_equation_of_motion(run: Trajectory) -> None:  # eqs 4, 5
    s = inside_flights(run)
    motion = run(s)
    side = np.sign(motion.angle)
    np.testing.assert_allclose(
        motion.acceleration, motion.angle - side + motion.base_acceleration, atol=1e-12
    )


@kinds
def test_the_angle_is_continuous_and_zero_at_impacts(run: Trajectory) -> None:
    impacts = run.impacts
    assert len(impacts) > 3
    np.testing.assert_array_equal(run(impacts.pt).angle, 0.0)
    just_before = np.nextafter(impacts.pt, 0.0)
    assert np.abs(run(just_before).angle).max() < 1e-13
    ends = run.flights.pt[1:]
    gap = run(ends).angle - run(np.nextafter(ends, 0.0)).angle
    assert np.abs(gap).max() < 1e-13


@kinds
def test_velocities_at_impacts_are_those_after_it(run: Trajectory) -> None:
    impacts = run.impacts
    lively = np.abs(impacts.velocity_after) > 1e-6
    np.testing.assert_allclose(
        run(impacts.pt[lively]).velocity, impacts.velocity_after[lively], rtol=4e-15
    )
    np.testing.assert_allclose(
        run(np.nextafter(impacts.pt[lively], 0.0)).velocity,
        impacts.velocity_before[lively],
        rtol=1e-7,
    )


@kinds
def test_impacts_lose_the_restitution_and_change_the_side(run: Trajectory) -> None:
    impacts = run.impacts
    np.testing.assert_allclose(impacts.velocity_after, 0.8 * impacts.velocity_before, rtol=1e-15)
    assert (np.sign(impacts.velocity_before) == -impacts.side).all()
    assert (np.diff(impacts.pt) > 0.0).all() or run.status is Status.AT_REST
    # sides alternate where no rest lies between
    rests = run.flights.pt[run.flights.side == 0]
    for i in range(len(impacts) - 1):
        if not ((rests >= impacts.pt[i]) & (rests <= impacts.pt[i + 1])).any():
            assert impacts.side[i + 1] == -impacts.side[i]


@kinds
def test_flights_hold_the_state_from_which_they_start(run: Trajectory) -> None:
    flights = run.flights
    assert len(flights) == len(run.rows)
    begins = run(flights.pt[:30])
    lively = flights.duration[:30] > 1e-9
    np.testing.assert_allclose(
        begins.angle[lively], flights.angle[:30][lively], rtol=1e-12, atol=1e-15
    )
    np.testing.assert_allclose(
        begins.velocity[lively], flights.velocity[:30][lively], rtol=1e-12, atol=1e-15
    )
    np.testing.assert_allclose(np.diff(flights.pt), flights.duration[:-1], rtol=1e-9, atol=1e-14)
    landed = np.flatnonzero(flights.ended_by[:-1] == 1)
    assert int((np.abs(flights.velocity[landed + 1]) >= 1e-6).sum()) == run.impact_count


@kinds
def test_the_peak_is_the_largest_angle(run: Trajectory) -> None:
    s = np.linspace(0.0, min(run.end_time_pt, 60.0), 200_001)
    sampled = np.abs(run(s).angle).max()
    assert sampled - 1e-13 <= run.peak <= sampled + 4.0 * (s[1] - s[0]) ** 2


def test_the_base_acceleration_is_that_of_the_motion() -> None:
    run = rocking()
    s = np.linspace(0.0, run.end_time_pt, 101)
    np.testing.assert_allclose(run.base_acceleration(s), 2.0 * np.sin(4.0 * s + 0.4), atol=1e-13)
    pieces = shaken_in_pieces()
    for at, expected in (
        (0.0, 2.0 * math.sin(0.3)),
        (0.5, 2.0 * math.sin(2.8)),
        (0.7, -1.2),
        (1.0, -0.6),
        (1.3, 0.0),
        (1.6, 0.2),
        (2.0, 0.2 - 0.7 * math.sin(1.2)),
        (2.6, 0.0),
        (100.0, 0.0),
    ):
        assert pieces.base_acceleration(at) == pytest.approx(expected, abs=1e-13), at
    np.testing.assert_array_equal(free().base_acceleration([0.0, 5.0]), 0.0)


# -------------------------------------------------------------------------------- the energy


@given(st.floats(0.05, 0.95), st.floats(-0.3, 0.3))
@settings(max_examples=30)
def test_free_flight_conserves_energy_and_an_impact_takes_its_share(
    angle: float, velocity: float
) -> None:
    run = simulate(BARE, Still(), start=State(angle=angle, velocity=velocity))
    s = np.linspace(0.0, min(run.end_time_pt, 12.0), 500)
    energy = run(s).energy
    begin = 0.5 * velocity**2 + angle - 0.5 * angle**2
    assert run(0.0).energy == pytest.approx(begin, rel=1e-14)
    landed = run.flights.pt[1:][run.flights.ended_by[:-1] == 1]
    passed = np.searchsorted(landed, s, side="right")
    np.testing.assert_allclose(energy, begin * 0.64**passed, rtol=1e-9, atol=1e-15)


def test_elastic_impacts_conserve_energy_for_a_thousand_swings() -> None:
    run = simulate(ELASTIC, Still(), start=State(angle=0.5, velocity=0.0))
    assert run.status is Status.ROCKING
    assert len(run.impacts) > 1000
    s = np.linspace(0.0, run.end_time_pt, 5001)
    np.testing.assert_allclose(run(s).energy, 0.375, rtol=1e-11)
    assert run.peak == pytest.approx(0.5, rel=1e-12)


def test_the_upright_position_has_the_energy_of_one_half() -> None:
    run = simulate(BARE, Still(), start=State(angle=1.0, velocity=0.0))
    assert run(3.0).energy == 0.5


# --------------------------------------------------------------------------- times and units


def test_pivot_time_tau_and_seconds_agree() -> None:
    run = rocking(BLOCK)
    s = np.linspace(0.0, run.end_time_pt, 50)
    for other in (run.at_tau(4.0 * s), run.at_time(s / 3.0)):
        np.testing.assert_allclose(other.angle, run(s).angle, atol=1e-12)
        np.testing.assert_allclose(other.velocity[:-1], run(s).velocity[:-1], atol=1e-11)
    assert run.frequency_ratio == 4.0
    assert run.end_time_pt == pytest.approx(12.3 * 2.0 * math.pi / 4.0, rel=1e-14)


def test_a_block_gives_the_time_of_overturning_in_seconds() -> None:
    run = simulate(BLOCK, Harmonic(amplitude=4.0, frequency_ratio=1.0))
    assert run.status is Status.OVERTURNED
    assert run.overturn_time_pt is not None
    assert run.overturn_time_s == pytest.approx(run.overturn_time_pt / 3.0, rel=1e-15)
    assert run.overturn_time_tau == pytest.approx(run.overturn_time_pt, rel=1e-15)
    assert run.rest_time_pt is None


def test_every_time_of_a_run_is_in_seconds_and_tau_too() -> None:
    omega = 2.5  # of the shaking, over p = 3 rad/s
    run = simulate(BLOCK, Harmonic(amplitude=1.001, frequency_ratio=omega), cycles=4)
    bare = simulate(BLOCK.dimensionless(), run.motion, cycles=4)
    let_go = free(BLOCK)
    assert let_go.rest_time_pt is not None
    assert let_go.rest_time_s == pytest.approx(let_go.rest_time_pt / 3.0, rel=1e-15)
    assert let_go.rest_time_tau is None
    assert run.end_time_s == pytest.approx(4.0 * 2.0 * math.pi / (omega * 3.0), rel=1e-14)
    assert run.end_time_tau == pytest.approx(8.0 * math.pi, rel=1e-14)
    assert (bare.end_time_s, bare.end_time_tau) == (None, run.end_time_tau)
    resting = simulate(BLOCK, Harmonic(amplitude=0.5, frequency_ratio=omega), cycles=1)
    assert (resting.rest_time_pt, resting.rest_time_s, resting.rest_time_tau) == (0.0, 0.0, 0.0)


def test_what_does_not_overturn_has_no_such_time() -> None:
    run = rocking(BLOCK)
    assert [run.overturn_time_pt, run.overturn_time_s, run.overturn_time_tau] == [None, None, None]


def test_seconds_need_a_block_and_tau_needs_harmonic_shaking() -> None:
    with pytest.raises(ModelError, match="seconds need a block"):
        rocking().at_time(0.0)
    with pytest.raises(ModelError, match="harmonic"):
        free().at_tau(0.0)
    with pytest.raises(ModelError, match="harmonic"):
        _ = free().frequency_ratio
    assert (
        simulate(
            BLOCK, Piecewise(pieces=(Segment(duration=1.0, constant=9.0),)), model=Linear()
        ).overturn_time_tau
        is None
    )


@kinds
def test_a_trajectory_can_be_asked_at_its_two_ends(run: Trajectory) -> None:
    begin, end = run(0.0), run(run.end_time_pt)
    assert begin.angle == run.flights.angle[0]
    assert np.isfinite([end.angle, end.velocity, end.acceleration, end.energy]).all()


@kinds
@every("outside", [-1e-9, math.nan, math.inf, -math.inf])
def test_times_outside_are_refused_with_the_range(run: Trajectory, outside: float) -> None:
    with pytest.raises(InputError, match="reaches from 0 to"):
        run(outside)
    with pytest.raises(InputError, match="reaches from 0 to"):
        run([0.0, run.end_time_pt * (1.0 + 1e-9)])


def test_answers_have_the_shape_of_the_question() -> None:
    run = rocking()
    for shape in ((), (3,), (2, 3), (0,), (1, 1, 2)):
        motion = run(np.full(shape, 0.5))
        for name in ("pt", "angle", "velocity", "acceleration", "base_acceleration", "energy"):
            assert getattr(motion, name).shape == shape
    assert run(0.5).angle == run([[0.1, 0.5]]).angle[0, 1]
    assert run(1).angle == run(1.0).angle


def test_a_fall_is_followed_until_twice_alpha() -> None:
    run = simulate(BARE, Harmonic(amplitude=2.0, frequency_ratio=1.7), start=Steady(), cycles=100)
    assert run.status is Status.OVERTURNED
    assert abs(float(run(run.end_time_pt).angle)) == pytest.approx(2.0, rel=1e-10)
    far = simulate(BARE, Still(), start=State(angle=-5.0, velocity=0.0))
    assert float(far(far.end_time_pt).angle) == pytest.approx(-6.0, rel=1e-10)


# ----------------------------------------------------------------------------- for drawing


@kinds
@every("per_unit", [1, 7, 100])
def test_drawing_times_ascend_and_hold_every_impact(run: Trajectory, per_unit: int) -> None:
    times = run.times(per_unit)
    assert (np.diff(times) > 0.0).all()
    assert times[0] == 0.0
    shown = run.impacts.pt[run.impacts.pt <= times[-1]]
    assert np.isin(shown, times).all()
    assert len(shown) == len(run.impacts)
    unit = 2.0 * math.pi / 4.0 if isinstance(run.motion, Harmonic) else 1.0
    assert np.diff(times).max() <= unit / per_unit * (1.0 + 1e-12)
    assert times[-1] <= run.end_time_pt


def test_a_run_that_came_to_rest_is_drawn_a_little_into_its_rest() -> None:
    run = free()
    assert run.rest_time_pt is not None
    assert run.rest_time_pt < run.times()[-1] < 1.1 * run.rest_time_pt + 0.2
    assert run.end_time_pt > 1000.0


@every("per_unit", [0, -1, 1.5, "100"])
def test_bad_numbers_of_samples_are_refused(per_unit: Any) -> None:
    with pytest.raises(InputError, match=r"^per_unit = "):
        rocking().times(per_unit)


def test_the_phase_path_holds_both_states_of_each_impact() -> None:
    run = rocking()
    angle, velocity = run.phase_path(50)
    times, impacts = run.times(50), run.impacts
    assert len(angle) == len(velocity) == len(times) + len(impacts)
    pairs = list(zip(angle, velocity, strict=True))
    for before, after in zip(impacts.velocity_before, impacts.velocity_after, strict=True):
        at = pairs.index((0.0, before))
        assert pairs[at + 1][0] == pytest.approx(0.0, abs=1e-15)
        assert pairs[at + 1][1] == pytest.approx(after, rel=1e-14)


def test_a_notebook_shows_how_it_ended() -> None:
    run = simulate(BARE, Harmonic(amplitude=2.0, frequency_ratio=1.7), start=Steady())
    table = run._repr_html_()
    assert ">overturned<" in table
    assert f">{len(run.impacts)}<" in table
    assert f">pt {run.overturn_time_pt:.3g} (" in table
    assert "overturns" not in rocking()._repr_html_()


def test_each_end_is_one_moment_in_all_three_clocks() -> None:
    block, bare = Block.rectangle(width=0.4, height=1.6), DimensionlessBlock(restitution=0.9)
    shaking = Harmonic(amplitude=2.0, frequency_ratio=3.0)
    for body, motion, start in (
        (block, shaking, State(angle=1.5, velocity=0.5)),
        (bare, shaking, State(angle=1.5, velocity=0.5)),
        (block, Still(), State(angle=0.3, velocity=0.0)),
        (bare, Still(), State(angle=0.3, velocity=0.0)),
    ):
        run = simulate(body, motion, start=start, cycles=3)
        falls = motion is shaking
        assert (run.overturn_time_pt is None, run.rest_time_pt is None) == (not falls, falls)
        for name in ("end", "rest", "overturn"):
            pt, tau, s = (getattr(run, f"{name}_time_{clock}") for clock in ("pt", "tau", "s"))
            assert (tau is None) == (pt is None or motion is not shaking)
            assert (s is None) == (pt is None or body is bare)
            if tau is not None:
                assert run.at_tau(tau).angle == pytest.approx(run(pt).angle, rel=1e-12)
            if s is not None and s <= run.end_time_s:
                assert run.at_time(s).angle == pytest.approx(run(pt).angle, rel=1e-12, abs=1e-300)
