"""Time histories under pulses: published numbers by bisection, an integrator, mirror images."""

import math
from collections.abc import Callable
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    Pulse,
    State,
    Status,
    SyntheticMotion,
    simulate,
)
from rocksteady.histories import Trajectory
from rocksteady.model.equations import Linear
from rocksteady.model.motions.pulses import PULSES
from rocksteady.motions import Impulses, add, delay, join, scale
from tests.every import every
from tests.model.motions.formulae_of_pulses import FORMULAE, GAMMA, NU, centred

Floats = NDArray[np.float64]
MP = {"oscillations": GAMMA, "phase": NU}
GRAVITY = 9.81
"""Of the published numbers in g."""


def topples(block: Block | DimensionlessBlock, motion: Any) -> bool:
    return simulate(block, motion, model=Linear()).status is Status.OVERTURNED


def first_to_topple(falls: Callable[[float], bool], near: float) -> float:
    """The size at which a block begins to topple, within 1 % of a number, by bisection."""
    low, high = 0.99 * near, 1.01 * near
    assert not falls(low)
    assert falls(high)
    while high - low > 1e-12 * high:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if falls(middle) else (middle, high)
    return high


# ---------------------------------------------------------------------- published numbers


@every(("a", "duration"), [(1.2, 1.7917595), (1.5, 1.0986123), (2.0, 0.6931472), (3.0, 0.4054651)])
def test_h4_the_shortest_rectangle_that_topples(a: float, duration: float) -> None:
    block = DimensionlessBlock(restitution=0.9)
    found = first_to_topple(
        lambda d: topples(block, Pulse.lasting(d, shape="rectangle", amplitude=a)), duration
    )
    assert found == pytest.approx(duration, abs=5.1e-8)
    assert found == pytest.approx(math.log(a / (a - 1.0)), rel=1e-11)


@every(
    ("w", "a"),
    [*enumerate((1.322397, 1.800724, 2.293872, 2.790798, 3.289147, 3.788155), start=1)],
)
def test_h7_the_smallest_half_sine_that_topples(w: float, a: float) -> None:
    block = DimensionlessBlock(restitution=0.9)
    found = first_to_topple(
        lambda size: topples(block, Pulse(shape="half-sine", amplitude=size, frequency_ratio=w)), a
    )
    assert found == pytest.approx(a, abs=5.1e-7)


@every(
    ("shape", "duration", "a", "digits"),
    [
        ("half-sine", 1.0, 2.36409069, 8),
        ("versed-sine", 1.0, 2.84992425, 8),
        ("triangle", 1.0, 2.97259, 5),
        ("rectangle", 1.0, 1.58197671, 8),
        ("half-sine", 2.0, 1.59204939, 8),
        ("versed-sine", 2.0, 1.83885220, 8),
        ("triangle", 2.0, 1.96032, 5),
    ],
)
def test_g1_the_smallest_single_pulse_that_topples(
    shape: str, duration: float, a: float, digits: int
) -> None:
    block = DimensionlessBlock(restitution=0.9)
    found = first_to_topple(
        lambda size: topples(block, Pulse.lasting(duration, shape=shape, amplitude=size)), a
    )
    assert found == pytest.approx(a, abs=0.51 * 10.0**-digits)


@every(
    ("shape", "block", "hertz", "accel_g", "digits"),
    [
        pytest.param(
            "half-sine", Block.rectangle(width=0.4, height=1.2, gravity=GRAVITY), 1.0, 0.554586, 6,
            id="H7",
        ),
        pytest.param(
            "one-sine", Block.from_p(alpha=0.25, p=2.14, restitution=0.9, gravity=GRAVITY),
            15.7 / (2.0 * math.pi), 3.2301, 4,
            id="Z4",
        ),
        pytest.param(
            "one-sine", Block.rectangle(width=1, height=3, restitution=0.85, gravity=GRAVITY),
            1.0, 0.451540, 6,
            id="M1",
        ),
        pytest.param(
            "one-cosine", Block.rectangle(width=1, height=3, restitution=0.85, gravity=GRAVITY),
            1.0, 0.595894, 6,
            id="M2",
        ),
        pytest.param(
            # printed .307851, as cut off: it is .3078518
            "one-cosine", Block.from_p(alpha=math.radians(15), p=2, restitution=0.8995),
            0.5, 0.3078515, 6,
            id="M3",
        ),
    ],
)  # fmt: skip
def test_published_accelerations_in_g(
    shape: str, block: Block, hertz: float, accel_g: float, digits: int
) -> None:
    def pulse(g: float) -> Pulse:
        return Pulse.from_si(
            block, shape=shape, acceleration_m_s2=g * block.gravity, frequency_hz=hertz
        )

    found = first_to_topple(lambda g: topples(block, pulse(g)), accel_g)
    assert found == pytest.approx(accel_g, abs=0.51 * 10.0**-digits)
    weaker = np.linspace(block.alpha, 0.999 * found, 100)
    assert not any(topples(block, pulse(g)) for g in weaker)


def one_sine(a: float, w: float) -> Trajectory:
    pulse = Pulse(shape="one-sine", amplitude=a, frequency_ratio=w)
    return simulate(DimensionlessBlock(restitution=0.9), pulse)


@every(
    ("w", "a"),
    [*enumerate((1.418315, 2.349903, 3.631150, 5.238964, 7.168129, 9.416966), start=1)],
)
def test_z1_the_smallest_one_sine_that_topples_without_an_impact(w: float, a: float) -> None:
    # The first is 1.41831534, printed as 1.418316.
    found = first_to_topple(lambda size: len(one_sine(size, w).impacts) == 0, a)
    assert found == pytest.approx(a, abs=5.1e-7)
    assert one_sine(found, w).status is Status.OVERTURNED


@every(
    ("w", "edge", "falls"),
    [
        (5.0, 3.018600, True),  # Z2
        (5.0, 6.318071, False),
        (5.0, 7.168129, True),
        (2.0, 1.225179, True),  # Z3
        (2.0, 2.314403, False),
        (3.0, 1.403565, True),
        (3.0, 3.484663, False),
        (4.0, 1.795442, True),
        (4.0, 4.850111, False),
        (6.0, 5.164159, True),
        (6.0, 7.669873, False),
    ],
)
def test_z2_z3_where_toppling_with_an_impact_begins_and_ends(
    w: float, edge: float, falls: bool
) -> None:
    found = first_to_topple(lambda a: (one_sine(a, w).status is Status.OVERTURNED) is falls, edge)
    assert found == pytest.approx(edge, abs=5.1e-7)


def test_z3_the_window_of_toppling_with_an_impact_vanishes() -> None:
    def window(w: float) -> bool:
        no_impact = first_to_topple(lambda a: len(one_sine(a, w).impacts) == 0, above(w))
        sizes = np.linspace(0.5 * no_impact, 0.999 * no_impact, 400)
        return any(one_sine(float(a), w).status is Status.OVERTURNED for a in sizes)

    def above(w: float) -> float:
        """Z1: w sin psi - cos psi = -exp(-(2 pi - psi)/w), a = 1/sin psi."""
        psi = brentq(
            lambda x: w * math.sin(x) - math.cos(x) + math.exp((x - 2.0 * math.pi) / w), 0.0, 1.0
        )
        return 1.0 / math.sin(psi)

    assert window(6.58)
    assert not window(6.59)


# ---------------------------------------------------------------------- an integrator


def integrated(
    base: Callable[[float], float], edges: list[float], restitution: float, impacts: int
) -> tuple[list[float], list[float], Callable[[Floats], Floats]]:
    """Impacts, velocities before them and the angle, of a block at rest that the base moves.

    Eqs 4, 5 and 9 by DOP853 in pivot time, in stretches on which the base is smooth; the first
    uplift is where |base| passes 1, found on a fine grid.
    """
    s = np.unique(np.concatenate([np.linspace(a, b, 4001) for a, b in pairwise(edges)]))
    over = np.flatnonzero(np.abs([base(float(t)) for t in s]) > 1.0)[0]
    now = 0.0
    if over > 0 and s[over - 1] not in edges[1:]:
        now = float(brentq(lambda t: abs(base(t)) - 1.0, s[over - 1], s[over], xtol=1e-15))
    side = math.copysign(1.0, base(float(s[over])))
    state = np.array([0.0, 0.0])
    times: list[float] = []
    speeds: list[float] = []
    pieces: list[tuple[float, float, Any]] = []
    ends = [edge for edge in edges if edge > now + 1e-12] + [math.inf]
    while len(times) < impacts:
        end = min(ends[0], now + 20.0)

        def motion(t: float, x: Floats, edge: float = side) -> list[float]:
            return [x[1], x[0] - edge + base(t)]

        def landing(_t: float, x: Floats) -> float:
            return float(x[0])

        landing.terminal = True  # type: ignore[attr-defined]
        landing.direction = -side  # type: ignore[attr-defined]
        run = solve_ivp(
            motion, (now, end), state, method="DOP853", rtol=1e-12, atol=1e-14,
            events=landing, dense_output=True, max_step=0.05,
        )  # fmt: skip
        pieces.append((now, float(run.t[-1]), run.sol))
        assert run.t_events is not None
        assert run.y_events is not None
        now, state = float(run.t[-1]), run.y[:, -1]
        if len(run.t_events[0]) > 0:
            now = float(run.t_events[0][0])
            times.append(now)
            speeds.append(float(run.y_events[0][0][1]))
            state = np.array([0.0, restitution * speeds[-1]])
            side = -side
        else:
            ends = ends[1:]

    def angle(at: Floats) -> Floats:
        found = np.zeros(len(at))
        for start, stop, solution in pieces:
            inside = (at >= start) & (at <= stop)
            if inside.any():
                found[inside] = solution(at[inside])[0]
        return found

    return times, speeds, angle


# large enough to lift the block well off, and small enough to leave it standing
SIZES = {
    "rectangle": (1.4, 4.0), "half-sine": (1.5, 3.0), "versed-sine": (1.7, 3.0),
    "triangle": (1.8, 3.0), "decaying-ramp": (2.0, 4.0), "one-sine": (1.5, 4.0),
    "one-cosine": (1.6, 4.0), "type-c1": (1.5, 5.0), "type-c2": (1.5, 5.0),
    "type-c3": (1.5, 6.0), "type-c12": (1.2, 9.0), "ricker": (2.0, 6.0),
    "ricker-antisymmetric": (2.0, 6.0), "mavroeidis-papageorgiou": (1.8, 5.0),
}  # fmt: skip


@every("name", SIZES)
def test_a_run_is_what_an_integrator_finds(name: str) -> None:
    a, w = SIZES[name]
    block = DimensionlessBlock(restitution=0.85)
    if name in FORMULAE:
        periods, formula = FORMULAE[name]
        pulse = Pulse(shape=name, amplitude=a, frequency_ratio=w)
        end = 2.0 * math.pi * periods / w
        edges = [0.0, end]
        if name == "triangle":
            edges.insert(1, 0.5 * end)
        accuracy = 1e-10

        def base(t: float) -> float:
            # at an end, the value on its earlier side: the stretch ends there
            return float(formula(np.asarray(t), a, w)) if t < end else 0.0

    else:
        more: Any = MP if name == "mavroeidis-papageorgiou" else {}
        pulse = Pulse(shape=name, amplitude=a, frequency_ratio=w, tolerance=1e-7, **more)
        end = pulse.duration
        edges = [0.0, end]
        accuracy = 3e-6
        middle = 0.5 * end
        if name == "mavroeidis-papageorgiou":
            grid = np.linspace(0.0, end, 400_001)
            values = centred(name, grid - middle, a, w)

            def base(t: float) -> float:
                return float(np.interp(t, grid, values)) if t < end else 0.0

        else:

            def base(t: float) -> float:
                return float(centred(name, np.asarray(t - middle), a, w)) if t < end else 0.0

    run = simulate(block, pulse)
    assert run.status is Status.AT_REST
    times, speeds, angle = integrated(base, edges, 0.85, 5)
    assert run.peak > 0.05, "the block does move"
    np.testing.assert_allclose(run.impacts.pt[:5], times, rtol=0.0, atol=accuracy)
    np.testing.assert_allclose(run.impacts.velocity_before[:5], speeds, rtol=0.0, atol=accuracy)
    at = np.linspace(0.0, times[-1], 500)[:-1]
    np.testing.assert_allclose(run(at).angle, angle(at), rtol=0.0, atol=accuracy)


# ---------------------------------------------------------------------- mirror images, and more


def mirrored(run: Trajectory, image: Trajectory, *, exact: bool) -> None:
    """Both runs are one, seen from two sides: to the last bit, or to rounding."""
    assert run.status is image.status
    assert len(run.rows) == len(image.rows)
    limit = 0.0 if exact else 1e-13
    for column in ("angle", "velocity"):
        np.testing.assert_allclose(
            getattr(run.flights, column), -getattr(image.flights, column), rtol=0.0, atol=limit
        )
    np.testing.assert_array_equal(run.flights.side, -image.flights.side)
    np.testing.assert_allclose(run.flights.pt, image.flights.pt, rtol=0.0, atol=10.0 * limit)
    assert run.peak == image.peak if exact else run.peak == pytest.approx(image.peak, rel=1e-12)


@pytest.mark.slow
@every("name", PULSES)
@every("a", [1.5, 3.0, 8.0])
def test_a_pulse_turned_round_gives_the_mirrored_run(name: str, a: float) -> None:
    block = DimensionlessBlock(restitution=0.9)
    pulse = Pulse(shape=name, amplitude=a, frequency_ratio=5.0)
    start = State(angle=0.1, velocity=-0.2)
    other = State(angle=-0.1, velocity=0.2)
    # Cosines of type C end in a phase that rounds otherwise half a cycle on.
    exact = not name.startswith("type-c")
    mirrored(simulate(block, pulse), simulate(block, scale(pulse, -1.0)), exact=exact)
    mirrored(
        simulate(block, pulse, start=start),
        simulate(block, scale(pulse, -1.0), start=other),
        exact=exact,
    )


def test_impulses_synthetic_motions_and_sums_turned_round_give_mirrored_runs() -> None:
    block = DimensionlessBlock(restitution=0.9)
    noise = SyntheticMotion(rms=0.8, frequency_ratio=5.0, duration=20.0, seed=3)
    hits = Impulses(velocities=(0.4, -0.3, 0.2), times=(0.5, 1.5, 2.5))
    fast = Pulse(shape="one-sine", amplitude=2.0, frequency_ratio=9.0)
    slow = Pulse(shape="one-cosine", amplitude=1.0, frequency_ratio=3.0)
    straight = (noise, hits, add(noise, hits))
    for motion in (*straight, add(fast, slow), join(fast, slow)):
        run = simulate(block, motion)
        assert len(run.impacts) > 5
        mirrored(run, simulate(block, scale(motion, -1.0)), exact=motion in straight)


def test_a_delayed_pulse_does_the_same_later() -> None:
    block = DimensionlessBlock(restitution=0.9)
    pulse = Pulse(shape="one-sine", amplitude=2.0, frequency_ratio=5.0)
    run, later = simulate(block, pulse), simulate(block, delay(pulse, 2.0))
    np.testing.assert_allclose(later.impacts.pt, run.impacts.pt + 2.0, atol=1e-13)
    np.testing.assert_array_equal(later.impacts.velocity_after, run.impacts.velocity_after)


@pytest.mark.slow
@every("name", PULSES)
def test_a_run_goes_on_to_rest_or_to_a_proof(name: str) -> None:
    for a in (0.5, 1.1, 3.0, 30.0):
        pulse = Pulse(shape=name, amplitude=a, frequency_ratio=4.0)
        run = simulate(DimensionlessBlock(restitution=0.9), pulse)
        assert run.status in (Status.AT_REST, Status.OVERTURNED)
        if run.status is Status.AT_REST:
            assert run.shown_to_pt >= pulse.duration
            assert run.rest_time_pt is not None
        if a < 1.0:
            assert run.peak == 0.0
            assert len(run.impacts) == 0


def test_an_impulse_of_the_velocity_alpha_g_over_p_just_topples() -> None:
    # Housner's slender limit of I1: v0 = alpha sqrt(4 g R/3) = alpha g/p
    block = Block.rectangle(width=0.4, height=1.6, gravity=9.80665)
    v = block.alpha * math.sqrt(4.0 * 9.80665 * block.radius / 3.0)
    found = first_to_topple(
        lambda size: topples(block, Impulses.from_si(block, velocities_m_s=(size,))), v
    )
    assert found == pytest.approx(v, rel=1e-11)


def test_a_short_rectangle_is_an_impulse() -> None:
    block = DimensionlessBlock(restitution=0.9)
    hit = simulate(block, Impulses(velocities=(0.5,)))
    short = simulate(block, Pulse.lasting(1e-3, shape="rectangle", amplitude=0.5e3))
    assert short.peak == pytest.approx(hit.peak, rel=5e-3)
    assert short.impacts.pt[0] == pytest.approx(hit.impacts.pt[0], rel=5e-3)


def test_a_pulse_before_endless_shaking() -> None:
    block = DimensionlessBlock(restitution=0.9)
    pulse = Pulse(shape="half-sine", amplitude=1.5, frequency_ratio=5.0)
    shaking = Harmonic(amplitude=1.2, frequency_ratio=3.0)
    run = simulate(block, join(pulse, shaking), cycles=10)
    end = pulse.duration + 10 * 2.0 * math.pi / 3.0
    assert run.end_time_pt == pytest.approx(end, rel=1e-14)
    before = run(pulse.duration)
    start = State(angle=float(before.angle), velocity=float(before.velocity))
    after = simulate(block, shaking, start=start, cycles=10)
    assert after.peak == pytest.approx(run.peak, rel=1e-9) or after.peak < run.peak
    assert float(after(after.end_time_pt).angle) == pytest.approx(
        float(run(run.end_time_pt).angle), abs=1e-9
    )
