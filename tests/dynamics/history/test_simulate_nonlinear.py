"""The nonlinear model against an adaptive integrator, the linear one, energy and symmetry."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, minimize_scalar

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    Piecewise,
    Pulse,
    Record,
    State,
    Status,
    Still,
    simulate,
)
from rocksteady.errors import InputError, ModelError
from rocksteady.model.equations import Linear, Nonlinear
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.motions import Impulses, Segment
from tests.dynamics.full_integrator import (
    agree_on_harmonic,
    agree_on_pulse,
    agree_on_samples,
    full,
)
from tests.every import every
from tests.records import synthetic

G = 9.80665


def drawn(seed: int) -> tuple[Block, State, np.random.Generator]:
    rng = np.random.default_rng(seed)
    block = Block.from_p(
        alpha=rng.uniform(0.05, 0.6), p=rng.uniform(1.0, 5.0), restitution=rng.uniform(0.7, 0.95)
    )
    state = State(angle=rng.uniform(-0.5, 0.5), velocity=rng.uniform(-0.3, 0.3))
    return block, state, rng


# ------------------------------------------------------------------- an adaptive integrator


@every("seed", range(7))
def test_impacts_of_harmonic_shaking(seed: int) -> None:
    block, state, rng = drawn(seed)
    a, w, phase = rng.uniform(0.5, 3.0), rng.uniform(2.0, 10.0), rng.uniform(0.0, 6.0)
    agree_on_harmonic(block, state, Harmonic(amplitude=a, frequency_ratio=w, phase=phase))


@every("shape", ["half-sine", "one-sine", "one-cosine", "triangle"])
def test_impacts_of_pulses(shape: str) -> None:
    block, state, _ = drawn(len(shape))
    agree_on_pulse(block, state, Pulse(shape=shape, amplitude=1.4, frequency_ratio=4.0))


@every("lifted", [False, True])
@every("seed", range(5))
def test_impacts_of_records(seed: int, lifted: bool) -> None:
    block, state, rng = drawn(50 + seed)
    dt, n = 0.02, 100
    flat = synthetic(rng, n, dt, 1.5 * block.alpha * G)
    up = synthetic(rng, n, dt, 0.6 * G)
    agree_on_samples(block, state, flat, up if lifted else None, dt)


# ------------------------------------------------------------------------ energy, symmetry


@every("alpha", [0.05, 0.3, 0.7])
def test_energy_is_constant_over_a_thousand_impacts_without_loss(alpha: float) -> None:
    block = Block.from_p(alpha=alpha, p=2.0, restitution=1.0)
    run = full(block, Still(), start=State(angle=0.7, velocity=0.0), max_flights=1002)
    assert len(run.impacts) >= 1000
    energy = run(run.times(2, span=(0.0, float(run.impacts.pt[999])))).energy
    assert np.ptp(energy) <= 1e-10 * energy[0]


def test_small_slenderness_is_the_linear_model() -> None:
    motion = Harmonic(amplitude=2.0, frequency_ratio=5.0, phase=0.3)
    start = State(angle=0.2, velocity=0.1)
    bare = simulate(DimensionlessBlock(restitution=0.8), motion, start=start, cycles=4)
    errors = []
    for alpha in (1e-6, 1e-2, 2e-2):
        run = full(Block.from_p(alpha=alpha, p=1.0, restitution=0.8), motion, start=start, cycles=4)
        assert len(run.impacts) == len(bare.impacts)
        errors.append(np.abs(run.impacts.pt - bare.impacts.pt).max())
    assert errors[0] < 1e-10
    assert errors[2] / errors[1] == pytest.approx(4.0, rel=0.05)


def test_turned_round_everything_is_a_mirror_image_to_the_last_bit() -> None:
    block, state, rng = drawn(3)
    flat = synthetic(rng, 300, 0.02, 1.6 * block.alpha * G)
    up = Record(acceleration_m_s2=synthetic(rng, 300, 0.02, 0.5 * G), dt_s=0.02)
    record = Record(acceleration_m_s2=flat, dt_s=0.02)
    here = full(block, BaseMotion(record, up), start=state)
    mirrored = State(angle=-state.angle, velocity=-state.velocity)
    there = full(block, BaseMotion(record.reversed(), up), start=mirrored)
    assert np.array_equal(here.impacts.pt, there.impacts.pt)
    assert np.array_equal(here.impacts.velocity_after, -there.impacts.velocity_after)
    assert here.peak == there.peak


def test_the_motion_is_continuous_and_obeys_the_equation() -> None:
    block = Block.from_p(alpha=0.4, p=2.0, restitution=0.8)
    run = full(block, Harmonic(amplitude=2.0, frequency_ratio=3.0), cycles=5)
    s = np.linspace(0.0, run.end_time_pt, 4001)
    motion = run(s)
    backwards = run(s[::-1])
    np.testing.assert_allclose(backwards.angle[::-1], motion.angle, rtol=0.0, atol=1e-14)
    side = np.sign(motion.angle)
    tilt = block.alpha * (1.0 - np.abs(motion.angle))
    expected = motion.base_acceleration * np.cos(tilt) - side * np.sin(tilt) / block.alpha
    moving = side != 0.0
    np.testing.assert_allclose(motion.acceleration[moving], expected[moving], atol=1e-12)
    assert np.abs(motion.angle).max() <= run.peak * (1.0 + 1e-14)
    assert np.abs(motion.angle).max() >= run.peak * (1.0 - 1e-4)


# ------------------------------------------------------------------------------ its limits


def test_a_block_stays_at_rest_up_to_its_own_uplift() -> None:
    block = Block.from_p(alpha=0.5, p=2.0)
    just = math.tan(0.5) / 0.5  # in units of alpha g
    for factor, lifts in ((1.0 - 1e-12, False), (1.0 + 1e-6, True)):
        run = full(block, Harmonic(amplitude=just * factor, frequency_ratio=4.0), cycles=3)
        assert run.flights.side.any() == lifts


def test_the_base_falls_away_under_the_block() -> None:
    block = Block.from_p(alpha=0.3, p=2.0)
    flat = Record(acceleration_m_s2=np.array([0.0, 1.0, 0.0, 0.0]), dt_s=0.1)
    up = Record(acceleration_m_s2=np.array([0.0, 0.0, -2.0 * G, 0.0]), dt_s=0.1)
    for start in (None, State(angle=0.5, velocity=0.0)):
        run = full(block, BaseMotion(flat, up), start=start)
        assert run.status is Status.LOST_CONTACT
        assert run.end_time_pt / block.p == pytest.approx(0.15, abs=1e-14)


@pytest.mark.parametrize("down", [(0.0, -1.0, 0.0, 0.0), (0.0, -1.0, -1.0, 0.0)])
def test_a_sample_of_exactly_minus_g_is_lost_contact_whatever_the_slenderness(
    down: tuple[float, ...],
) -> None:
    flat = Record(acceleration_m_s2=np.array([0.0, 1.0, 0.0, 0.0]), dt_s=0.1)
    up = Record(acceleration_m_s2=G * np.array(down), dt_s=0.1)
    for alpha in np.linspace(0.05, 1.4, 28).tolist():
        block = Block.from_p(alpha=alpha, p=2.0, restitution=0.8)
        for start in (None, State(angle=0.5, velocity=0.0)):
            run = full(block, BaseMotion(flat, up), start=start)
            assert run.status is Status.LOST_CONTACT
            assert run.end_time_pt / block.p == pytest.approx(0.1, abs=1e-14)


def test_a_heavier_base_holds_the_block_longer() -> None:
    block = Block.from_p(alpha=0.3, p=2.0)
    flat = Record(acceleration_m_s2=np.array([0.0, 0.0, 6.0, 0.0]), dt_s=0.1)
    up = Record(acceleration_m_s2=np.array([0.5 * G] * 3 + [0.0]), dt_s=0.1)
    lifted = full(block, BaseMotion(flat, up)).flights
    expected = 0.1 + 0.1 * 1.5 * math.tan(0.3) * G / 6.0
    assert lifted.pt[np.flatnonzero(lifted.side)[0]] / block.p == pytest.approx(expected, rel=1e-12)


def test_vertical_samples_need_not_lie_where_the_horizontal_ones_do() -> None:
    block = Block.from_p(alpha=0.3, p=2.0, restitution=0.9)
    start = State(angle=0.4, velocity=0.0)
    rng = np.random.default_rng(4)
    flat = Record(acceleration_m_s2=synthetic(rng, 50, 0.04, 2.0), dt_s=0.04)
    up = synthetic(rng, 50, 0.04, 4.0)
    coarse = Record(acceleration_m_s2=up, dt_s=0.04)
    fine = np.interp(0.016 * np.arange(123), 0.04 * np.arange(50), up)
    whole = np.interp(0.01 * np.arange(197), 0.04 * np.arange(50), up)
    one = full(block, BaseMotion(flat, coarse), start=start)
    same = full(block, BaseMotion(flat, Record(acceleration_m_s2=whole, dt_s=0.01)), start=start)
    other = full(block, BaseMotion(flat, Record(acceleration_m_s2=fine, dt_s=0.016)), start=start)
    np.testing.assert_allclose(same.impacts.pt[:5], one.impacts.pt[:5], rtol=1e-12)
    assert np.abs(other.impacts.pt[:5] - one.impacts.pt[:5]).max() < 0.02


def test_overturning_is_proved_and_timed() -> None:
    block = Block.from_p(alpha=0.3, p=2.0)
    run = full(block, Impulses(velocities=(2.0,)))
    assert run.status is Status.OVERTURNED
    assert run.overturn_time_pt is not None
    assert run(run.overturn_time_pt).angle == pytest.approx(1.0, abs=1e-12)
    assert run.peak == pytest.approx(1.0, abs=1e-12)
    assert run(run.end_time_pt).angle == pytest.approx(2.0, abs=1e-12)


def test_a_stocky_block_is_followed_until_it_lies_on_its_side() -> None:
    block = Block.from_p(alpha=1.2, p=2.0, restitution=0.5)
    run = full(block, Still(), start=State(angle=1.05, velocity=0.0))
    assert run.status is Status.OVERTURNED
    assert run(run.end_time_pt).angle == pytest.approx(0.5 * math.pi / 1.2, abs=1e-12)


def test_a_push_during_a_strong_motion_may_lay_the_block_down() -> None:
    block = Block.from_p(alpha=0.4, p=2.0)
    push = Piecewise(pieces=(Segment(duration=20.0, constant=3.0),))
    run = full(block, push)
    assert run.status is Status.OVERTURNED
    assert run(run.end_time_pt).angle == pytest.approx(2.0, abs=1e-10) or run.end_time_pt < 20.0


def test_looser_tolerances_give_larger_errors_within_them() -> None:
    block = Block.from_p(alpha=0.4, p=2.0, restitution=0.8)
    motion = Harmonic(amplitude=2.0, frequency_ratio=4.0)
    start = State(angle=0.1, velocity=0.3)
    exact = full(block, motion, start=start, cycles=20, model=Nonlinear(tolerance=1e-11))
    for tolerance in (1e-3, 1e-6, 1e-9):
        run = full(block, motion, start=start, cycles=20, model=Nonlinear(tolerance=tolerance))
        error = np.abs(run.impacts.pt - exact.impacts.pt).max()
        assert error <= tolerance


# ------------------------------------------------------------------------------ refusals


def test_what_is_refused_says_why() -> None:
    block = Block.from_p(alpha=0.3, p=2.0)
    record = Record(acceleration_m_s2=np.array([0.0, 1.0, 0.0]), dt_s=0.1)
    shaking = Harmonic(amplitude=1.0, frequency_ratio=2.0)
    with pytest.raises(ModelError, match="needs the block's slenderness"):
        simulate(DimensionlessBlock(restitution=0.9), shaking, model=Nonlinear())
    with pytest.raises(ModelError, match="linear equations of motion have no term"):
        simulate(block, BaseMotion(record, record), model=Linear())
    with pytest.raises(ModelError, match="linear between samples"):
        full(block, BaseMotion(record, shaking))
    with pytest.raises(InputError, match="vertical"):
        full(block, BaseMotion(record, 3))  # type: ignore[arg-type]
    with pytest.raises(InputError, match="there are two equations of motion"):
        simulate(block, record, model="quadratic")  # type: ignore[arg-type]
    with pytest.raises(InputError, match="tolerance"):
        full(block, record, model=Nonlinear(tolerance=1e-15))


Floats = NDArray[np.float64]


@pytest.mark.slow
@every(
    ("alpha", "amplitude", "ratio", "angle"),
    [
        (0.1, 3.0, 3.0, 0.3),
        (0.3, 3.0, 3.0, 0.2),
        (0.5, 4.0, 4.0, 0.2),
        (0.8, 5.0, 3.0, 0.3),
        (0.2, 6.0, 6.0, 0.1),
    ],
)
def test_grazes_are_neither_missed_nor_made_up(
    alpha: float, amplitude: float, ratio: float, angle: float
) -> None:
    phase = math.pi  # pushed back first, then away
    span = 1.9 * math.pi / ratio

    def dip(velocity: float) -> tuple[float, float]:
        """Lowest angle of the flight on one side, as if there were no floor, and its time."""

        def motion(s: float, y: Floats) -> list[float]:
            tilt = alpha * (1.0 - y[0])
            h = amplitude * math.sin(ratio * s + phase)
            return [y[1], h * math.cos(tilt) - math.sin(tilt) / alpha]

        run = solve_ivp(
            motion,
            (0.0, span),
            [angle, velocity],
            method="DOP853",
            rtol=1e-12,
            atol=1e-14,
            dense_output=True,
            max_step=0.02 * span,
        )
        assert run.sol is not None
        course = run.sol
        s = np.linspace(0.0, span, 4001)
        near = float(s[np.argmin(course(s)[0])])
        found = minimize_scalar(
            lambda t: float(course(t)[0]),
            bounds=(near - 1e-3 * span, near + 1e-3 * span),
            method="bounded",
            options={"xatol": 1e-10},
        )
        return float(found.fun), float(found.x)

    touching = brentq(lambda v: dip(v)[0], -1.5, 3.0, xtol=1e-12)
    _, when = dip(touching)
    assert 0.05 * span < when < 0.95 * span
    block = Block.from_p(alpha=alpha, p=1.0, restitution=0.9)
    shaking = Harmonic(amplitude=amplitude, frequency_ratio=ratio, phase=phase)
    for off in (1e-3, 1e-6, 1e-9, 1e-10):
        for sign, lands in ((-1.0, True), (1.0, False)):
            start = State(angle=angle, velocity=touching + sign * off)
            run = simulate(block, shaking, start=start, cycles=2, model=Nonlinear())
            early = run.impacts.pt[run.impacts.pt < span]
            first = float(early[0]) if len(early) else math.inf
            assert (first <= when) is lands
            if lands:
                assert first == pytest.approx(when, abs=10.0 * math.sqrt(off))
