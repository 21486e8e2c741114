"""Blocks whose sides differ: against an integrator in seconds and radians, mirrors and energy."""

import math

import numpy as np
import pytest

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    Piecewise,
    Record,
    State,
    Status,
    Still,
    find_attractor,
    find_orbits,
    map_attractors,
    simulate,
)
from rocksteady.model.equations import Linear
from rocksteady.motions import Impulses, Segment
from tests.dynamics.asymmetric import ASYMMETRY, BLOCK, HARD, random_block
from tests.dynamics.integrator import integrate_sides
from tests.every import every
from tests.strategies import sample_size

# ------------------------------------------------------------------ an integrator


@every("seed", range(sample_size(6, 1)))
def test_impacts_are_those_of_an_integrator(seed: int) -> None:
    rng = np.random.default_rng(seed)
    block = random_block(rng)
    shaking = Harmonic(
        amplitude=float(rng.uniform(1.2, 2.5)),
        frequency_ratio=float(rng.uniform(2.5, 6.0)),
        phase=float(rng.uniform(0.0, 6.0)),
    )
    side = int(rng.choice([-1, 1]))
    start = State(angle=0.0, velocity=0.35 * side)
    run = simulate(block, shaking, start=start, cycles=6, model="linear")
    peak, omega = shaking.acceleration_m_s2(block), 2.0 * math.pi * shaking.frequency_hz(block)
    truth = integrate_sides(
        lambda t: peak / block.gravity * math.sin(omega * t + shaking.phase),
        6.0 * 2.0 * math.pi / omega,
        sides=(block.positive, block.negative),
        velocity=start.velocity * block.alpha * block.p,
        longest_step=0.05 / block.p,
    )
    count = 0
    for time, before, after in zip(truth.impacts, truth.before, truth.after, strict=True):
        if abs(after) < 1e-3 * block.alpha * block.p:  # the integrator loses short bounces
            break
        at = run.impacts.pt[count] / block.p
        assert at == pytest.approx(time, abs=1e-9)
        unit = block.alpha * block.p
        assert run.impacts.velocity_before[count] * unit == pytest.approx(before, abs=1e-8)
        assert run.impacts.velocity_after[count] * unit == pytest.approx(after, abs=1e-8)
        count += 1
    assert count > 0 or run.status is Status.OVERTURNED
    inside = truth.times <= run.end_time_pt / block.p
    angles = run.at_time(truth.times[inside]).angle * block.alpha
    near = np.abs(truth.angles[inside]) < 1.5 * block.alpha
    apart = np.abs(angles - truth.angles[inside])[near]
    assert np.max(apart, initial=0.0) < 1e-6 * block.alpha


def test_an_impulse_of_the_base_turns_each_side_by_its_own_p() -> None:
    # An impulse is a short, strong push: a rectangle of the same area does the same in the limit.
    motion = Impulses.from_si(BLOCK, times_s=(0.1, 0.5), velocities_m_s=(-0.4, 0.25))
    run = simulate(BLOCK, motion, model=Linear())
    short = 1e-7

    def push(area: float) -> Segment:
        return Segment(duration=short, constant=area / short)

    still = [s.duration for s in motion.segments()]
    areas = [s.jump for s in motion.segments()]
    pieces: list[Segment] = []
    for duration, area in zip(still, areas, strict=True):
        if area:
            pieces.append(push(area))
        if math.isfinite(duration):
            pieces.append(Segment(duration=duration - (short if area else 0.0)))
    pushed = simulate(BLOCK, Piecewise(pieces=tuple(pieces)), model=Linear())
    assert len(run.impacts) > 3
    assert run.impacts.pt[:3] == pytest.approx(pushed.impacts.pt[:3], abs=1e-5)
    assert run.side_peaks == pytest.approx(pushed.side_peaks, abs=1e-5)


def test_a_record_moves_it_as_its_samples_do() -> None:
    rng = np.random.default_rng(4)
    samples = 6.0 * np.convolve(rng.normal(size=400), np.ones(8) / 8, mode="same")
    record = Record(acceleration_m_s2=samples, dt_s=0.01)
    run = simulate(BLOCK, record, start=State(angle=0.0, velocity=-0.3), model=Linear())
    grid = np.arange(len(samples)) * 0.01
    truth = integrate_sides(
        lambda t: float(np.interp(t, grid, samples)) / BLOCK.gravity,
        1.5,
        sides=(BLOCK.positive, BLOCK.negative),
        velocity=-0.3 * BLOCK.alpha * BLOCK.p,
        longest_step=0.002,
    )
    found = run.impacts.pt[: len(truth.impacts)] / BLOCK.p
    assert len(truth.impacts) > 1
    assert found[:2] == pytest.approx(truth.impacts[:2], abs=1e-6)


# ------------------------------------------------------------------ mirrors and special cases

MOTIONS = [
    Harmonic(amplitude=1.8, frequency_ratio=3.0, phase=0.4),
    Harmonic(amplitude=0.9, frequency_ratio=0.8, phase=1.0),
    Piecewise(
        pieces=(
            Segment(duration=0.7, constant=1.5),
            Segment(duration=0.9, constant=-1.2, slope=0.3),
            Segment(duration=0.5, jump=-0.2),
        )
    ),
    Impulses(times=(0.0, 1.0), velocities=(0.4, -0.9)),
    Still(),
]


def reversed_motion(motion: Harmonic | Piecewise | Impulses | Still, alpha: float, p: float):  # type: ignore[no-untyped-def]
    """Return a motion of the ground the other way round, in units of another alpha and p."""
    if isinstance(motion, Harmonic):
        return Harmonic(
            amplitude=motion.amplitude / alpha,
            frequency_ratio=motion.frequency_ratio / p,
            phase=motion.phase + math.pi,
        )
    if isinstance(motion, Piecewise):
        return Piecewise(
            pieces=tuple(
                Segment(
                    duration=piece.duration * p,
                    constant=-piece.constant / alpha,
                    slope=-piece.slope / (alpha * p),
                    jump=-piece.jump * p / alpha,
                )
                for piece in motion.pieces
            )
        )
    if isinstance(motion, Impulses):
        return Impulses(
            times=tuple(time * p for time in motion.times),
            velocities=tuple(-velocity * p / alpha for velocity in motion.velocities),
        )
    return motion


@every("motion", MOTIONS)
@every("restitution", [(0.85, 0.75), (0.6, 0.95)])
def test_the_mirrored_block_on_the_reversed_ground_moves_mirrored(
    motion: Harmonic | Piecewise | Impulses | Still, restitution: tuple[float, float]
) -> None:
    # Ratios that are powers of two change no digit, so that the mirror image is exact.
    block = DimensionlessBlock(
        restitution=restitution[0],
        negative_restitution=restitution[1],
        alpha_ratio=2.0,
        p_ratio=0.5,
    )
    other = DimensionlessBlock(
        restitution=restitution[1],
        negative_restitution=restitution[0],
        alpha_ratio=0.5,
        p_ratio=2.0,
    )
    # Harmonic phases turn by pi, which rounds: without a sinusoid everything is exact.
    start = State(angle=0.0, velocity=0.25)
    turned = State(angle=0.0, velocity=-0.25 / 2.0 / 0.5)
    run = simulate(block, motion, start=start, cycles=20)
    image = simulate(other, reversed_motion(motion, 2.0, 0.5), start=turned, cycles=20)
    assert image.status is run.status
    assert image.side_peaks[::-1] == pytest.approx(run.side_peaks, rel=1e-10)
    assert len(image.impacts) == len(run.impacts)
    assert np.array_equal(image.flights.side, -run.flights.side)
    if isinstance(motion, Harmonic):
        assert image.impacts.pt == pytest.approx(0.5 * run.impacts.pt, rel=1e-9, abs=1e-12)
        return
    assert np.array_equal(image.impacts.pt, 0.5 * run.impacts.pt)
    assert np.array_equal(image.impacts.velocity_after, -run.impacts.velocity_after)
    assert image.rest_time_pt == (None if run.rest_time_pt is None else 0.5 * run.rest_time_pt)


def test_the_mirror_image_under_harmonic_shaking_is_exact_too() -> None:
    # Half a period is added as a whole half cycle: the phases 0 and pi are both exact.
    block = DimensionlessBlock(restitution=0.8, alpha_ratio=2.0)
    other = DimensionlessBlock(restitution=0.8, alpha_ratio=0.5)
    shaking = Harmonic(amplitude=3.0, frequency_ratio=8.0)
    run = simulate(block, shaking, cycles=100)
    image = simulate(other, Harmonic(amplitude=1.5, frequency_ratio=8.0, phase=math.pi), cycles=100)
    assert len(run.impacts) > 20
    assert np.array_equal(image.impacts.phase, run.impacts.phase)
    assert np.array_equal(image.impacts.velocity_after, -0.5 * run.impacts.velocity_after)
    assert image.side_peaks == run.side_peaks[::-1]


@every("motion", MOTIONS)
def test_with_equal_sides_it_is_the_symmetric_block_to_the_last_bit(
    motion: Harmonic | Piecewise | Impulses | Still,
) -> None:
    one = Block.asymmetric(left=0.2, right=0.2, height=1.2, restitution=(0.8, 0.8))
    two = Block.rectangle(width=0.4, height=1.2, restitution=0.8)
    runs = [
        simulate(block, motion, start=State(angle=0.3, velocity=0.1), cycles=30, model=Linear())
        for block in (one, two, DimensionlessBlock(restitution=0.8))
    ]
    for run in runs[1:]:
        assert np.array_equal(run.rows, runs[0].rows, equal_nan=True)
        assert (run.peak, run.rest_time_pt) == (runs[0].peak, runs[0].rest_time_pt)


def test_sides_that_hardly_differ_move_as_if_they_did_not() -> None:
    near = DimensionlessBlock(restitution=0.8, alpha_ratio=1.0 + 1e-12, p_ratio=1.0 - 1e-12)
    like = DimensionlessBlock(restitution=0.8)
    shaking = Harmonic(amplitude=2.0, frequency_ratio=4.0)
    one, other = (simulate(block, shaking, cycles=20) for block in (near, like))
    assert one.impacts.pt == pytest.approx(other.impacts.pt, abs=1e-9)
    assert find_attractor(like, shaking).kind == "symmetric"
    found = find_attractor(near, shaking)
    assert found.kind == "unsymmetric"
    assert not any(orbit.symmetric for orbit in find_orbits(near, shaking, max_period=1, seeds=24))
    cells = map_attractors(near, shaking, axes={"phase": [0.0, 1.0]})
    assert set(cells.kind.values.tolist()) == {1}


# ------------------------------------------------------------------ energy and peaks


def test_without_loss_the_energy_stays_what_it_was() -> None:
    block = BLOCK.with_restitution(1.0)
    run = simulate(
        block, Still(), start=State(angle=0.6, velocity=0.0), max_flights=1002, model=Linear()
    )
    energy = run(run.impacts.pt[:-1]).energy
    assert len(energy) >= 1000
    assert np.ptp(energy) < 1e-10 * energy[0]
    between = run(np.linspace(0.0, float(run.impacts.pt[20]), 500)).energy
    assert between == pytest.approx(energy[0], rel=1e-12)
    assert run.side_peaks[0] == pytest.approx(0.6, rel=1e-12)
    # On the other side it rises to p2^2 (alpha2 theta - theta^2/2) = p1^2 (...).
    lean, rate = block.negative.alpha / block.alpha, block.negative.p / block.p
    square = (0.6 - 0.18) / rate**2
    expected = (lean - math.sqrt(lean**2 - 2.0 * square)) / lean
    assert run.side_peaks[1] == pytest.approx(expected, rel=1e-9)


def test_peaks_of_each_side_are_those_of_dense_samples() -> None:
    run = simulate(ASYMMETRY, HARD, start=State(angle=0.2, velocity=0.3), cycles=10)
    angle = run(np.linspace(0.0, run.end_time_pt, 40_001)).angle
    assert run.side_peaks[0] == pytest.approx(angle.max(), rel=1e-5)
    assert run.side_peaks[1] == pytest.approx(-angle.min() / 1.3, rel=1e-5)
    assert run.peak == max(run.side_peaks)
    assert run.balances == (-1.3, 1.0)


@pytest.mark.parametrize("side", [-1, 1])
def test_it_overturns_past_the_balance_of_the_side_to_which_it_falls(side: int) -> None:
    lean = 1.3 if side < 0 else 1.0
    run = simulate(ASYMMETRY, Still(), start=State(angle=0.0, velocity=1.5 * side))
    assert run.status is Status.OVERTURNED
    assert run.overturn_time_pt is not None
    assert float(run(run.overturn_time_pt).angle) == pytest.approx(side * lean, rel=1e-12)
    assert run.side_peaks[0 if side > 0 else 1] == pytest.approx(1.0, rel=1e-12)
    assert float(run(run.end_time_pt).angle) == pytest.approx(2.0 * lean * side, rel=1e-12)


@pytest.mark.parametrize("side", [-1, 1])
def test_it_comes_to_rest_when_all_its_bounces_are_over(side: int) -> None:
    run = simulate(ASYMMETRY, Still(), start=State(angle=0.0, velocity=0.3 * side))
    assert run.status is Status.AT_REST
    assert run.rest_time_pt is not None
    # Free bounces in closed form: each lasts 2 artanh(v) in its own units and loses its part.
    velocity, here, total = 0.3, 0 if side > 0 else 1, 0.0
    for _ in range(400):
        restitution, lean, rate = ASYMMETRY.sides[here]
        total += 2.0 * math.atanh(velocity / (lean * rate)) / rate
        velocity, here = velocity * restitution, 1 - here
    assert run.rest_time_pt == pytest.approx(total, rel=1e-13)


def test_a_block_at_rest_is_lifted_to_either_side_by_its_own_acceleration() -> None:
    for sign, least in ((1.0, 1.0), (-1.0, 1.3)):
        for share, status in ((0.999, Status.AT_REST), (1.001, Status.AT_REST)):
            push = Piecewise(pieces=(Segment(duration=0.01, constant=sign * share * least),))
            run = simulate(ASYMMETRY, push)
            assert run.status is status
            assert (len(run.impacts) > 0) == (share > 1.0)
