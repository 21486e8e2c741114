"""Edge states by tracking: closed forms, orbits found otherwise, least fatal kicks."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    Nonlinear,
    Rest,
    State,
    Status,
    Steady,
    find_attractor,
    find_edge_state,
    find_fatal_kicks,
    find_orbits,
    simulate,
)
from rocksteady.basins import HilltopSaddle, compute_manifold, find_hilltop_saddles
from rocksteady.errors import InputError, ModelError
from rocksteady.formulas import heteroclinic_amplitude
from rocksteady.histories import ImpactState
from rocksteady.orbits import Orbit

TURN = 2.0 * math.pi
BARE = DimensionlessBlock(restitution=0.9)


@pytest.mark.parametrize("kick", [1, -1])
def test_on_a_still_base_the_least_kick_is_that_of_find_fatal_kick(kick: int) -> None:
    start = State(angle=0.5, velocity=0.0)
    still = Harmonic(amplitude=0.0, frequency_ratio=2.0)
    edge = find_edge_state(BARE, still, start=start, kick=kick)
    known = find_fatal_kicks(BARE, start=start).signed[0, 0 if kick > 0 else 1]
    assert edge.kick == pytest.approx(float(known), abs=1e-9)
    assert isinstance(edge.saddle, HilltopSaddle)
    assert edge.saddle.side == kick
    assert edge.outcomes[0] == "rest"
    assert edge.exponent == pytest.approx(math.pi, abs=2e-4)  # 2 pi/Omega


@settings(max_examples=12)
@given(
    st.floats(0.3, 4.0), st.floats(0.6, 0.97), st.floats(0.1, 0.9), st.floats(0.0, 6.2),
    st.sampled_from([1, -1]),
)  # fmt: skip
def test_below_the_tangency_the_kick_and_the_edge_are_in_closed_form(
    ratio: float, restitution: float, part: float, phase: float, kick: int
) -> None:
    # From rest a motion tends to the hilltop on the side of the kick if its growing part is 0.
    # Other kicks, that fall behind after an impact, are larger; at phases of much help from
    # the shaking the block may fall over that side first by way of the other.
    amplitude = part * float(heteroclinic_amplitude(ratio, restitution))
    motion = Harmonic(amplitude=amplitude, frequency_ratio=ratio, phase=phase)
    edge = find_edge_state(DimensionlessBlock(restitution=restitution), motion, kick=kick)
    beta = amplitude / (1.0 + ratio**2)
    expected = 1.0 - kick * beta * (math.sin(phase) + ratio * math.cos(phase))
    assert edge.kick == pytest.approx(kick * expected, abs=1e-9)
    assert isinstance(edge.saddle, HilltopSaddle)
    assert edge.saddle.side == kick
    assert edge.distance < 1e-4


def test_under_the_least_kick_the_block_comes_to_the_edge_state() -> None:
    motion = Harmonic(amplitude=2.0, frequency_ratio=1.9)
    block = DimensionlessBlock(restitution=0.8)
    attractor = find_attractor(block, motion, start=Steady(side=-1))
    start = attractor.start
    assert isinstance(start, ImpactState)
    edge = find_edge_state(block, motion, start=start)
    assert isinstance(edge.saddle, Orbit)
    orbit = edge.saddle
    # A run from the border, which it leaves by rounding, is on the saddle's states in between.
    run = simulate(block, edge.motion, start=edge.boundary, cycles=9)
    times = TURN / 1.9 * np.arange(9)
    here = run(times)
    saddle = orbit.trajectory()
    since = (edge.motion.phase - orbit.states[0].phase) % TURN + TURN * np.arange(orbit.period)
    there = saddle(since / 1.9)
    away = np.hypot(
        here.angle[:, np.newaxis] - there.angle, here.velocity[:, np.newaxis] - there.velocity
    ).min(axis=1)
    assert away.min() < 1e-4 < away[0]
    # A little less and it stands, a little more and it falls.
    assert edge.kick is not None
    for more, status in ((-1e-6, Status.ROCKING), (1e-6, Status.OVERTURNED)):
        speed = start.side * start.speed + edge.kick + more
        end = simulate(block, edge.motion, start=State(angle=0.0, velocity=speed), cycles=60)
        assert end.status is status


def test_between_rest_and_an_orbit_it_is_an_orbit_that_a_search_finds() -> None:
    motion = Harmonic(amplitude=0.5, frequency_ratio=2.0)
    edge = find_edge_state(BARE, motion, start=Rest(), other=State(angle=0.2, velocity=0.3))
    assert edge.outcomes == ("rest", "symmetric orbit of period 1")
    assert edge.kind == "orbit"
    assert isinstance(edge.saddle, Orbit)
    unstable = [
        orbit
        for orbit in find_orbits(BARE, motion, max_period=1, seeds=16)
        if orbit.admissible and not orbit.stable
    ]
    assert any(
        abs(orbit.highest - edge.saddle.highest) < 1e-10
        and orbit.multipliers == pytest.approx(edge.saddle.multipliers, rel=1e-8)
        for orbit in unstable
    )
    assert edge.exponent == pytest.approx(edge.saddle.lyapunov, rel=0.01)


def test_between_two_mirror_images_it_is_the_orbit_that_is_its_own() -> None:
    motion = Harmonic(amplitude=2.0, frequency_ratio=1.9)
    block = DimensionlessBlock(restitution=0.8)
    one = find_attractor(block, motion, start=Steady(side=-1)).orbit
    assert one is not None
    start = one.states[0]
    run = one.mirrored.trajectory()
    there = run(((start.phase - one.mirrored.states[0].phase) % TURN) / 1.9)
    other = State(angle=float(there.angle), velocity=float(there.velocity))
    edge = find_edge_state(block, motion, start=start, other=other)
    assert isinstance(edge.saddle, Orbit)
    assert edge.saddle.symmetric
    known = find_orbits(block, motion, max_period=1, seeds=4)[0]
    assert edge.saddle.highest == pytest.approx(known.highest, abs=1e-12)


def test_of_the_nonlinear_model_it_is_that_models_hilltop() -> None:
    block = Block.from_p(alpha=0.3, p=2.0, restitution=0.85)
    motion = Harmonic(amplitude=0.2, frequency_ratio=2.0)
    edge = find_edge_state(block, motion, kick=-1, model=Nonlinear())
    left = find_hilltop_saddles(block, motion, model=Nonlinear())[1]
    assert isinstance(edge.saddle, HilltopSaddle)
    assert edge.saddle.start == left.start
    assert edge.kick is not None
    assert edge.kick_m_s == pytest.approx(edge.kick * 0.3 * block.gravity / 2.0)  # alpha g/p


def test_the_least_kick_is_never_less_than_the_distance_of_the_stable_manifold() -> None:
    motion = Harmonic(amplitude=0.2, frequency_ratio=2.0)
    edge = find_edge_state(BARE, motion)
    assert edge.kick is not None
    nearest = [
        compute_manifold(saddle, "stable", phase=0.0, length=6.0).nearest(0.0, 0.0)
        for saddle in find_hilltop_saddles(BARE, motion)
    ]
    least = min(math.hypot(*point) for point in nearest)
    # The border is straight near by, at 45 degrees: 1/sqrt(2) of the kick that reaches it.
    assert least == pytest.approx(min(0.92, 1.08) / math.sqrt(2.0), abs=1e-6)
    assert least < abs(edge.kick)


def test_a_wall_takes_kicks_into_it_and_a_fractal_border_holds_orbits() -> None:
    walled = DimensionlessBlock(restitution=0.6, one_sided=True)
    motion = Harmonic(amplitude=0.5, frequency_ratio=2.0)
    edge = find_edge_state(walled, motion)
    assert edge.kick == pytest.approx(1.0 - 0.1 * 2.0, abs=1e-9)
    assert edge.opposite is not None
    assert math.isnan(edge.opposite)
    assert "no kick up to 4 alpha g/p makes it fall" in str(edge.describe())
    with pytest.raises(ModelError, match="stands under every negative kick"):
        find_edge_state(walled, motion, kick=-1)
    fractal = find_edge_state(BARE, motion)
    assert fractal.kind == "orbit"
    assert isinstance(fractal.saddle, Orbit)
    assert fractal.saddle.largest_multiplier > 1.0


@pytest.mark.parametrize("kick", [1, -1])
def test_a_least_kick_whose_end_rounding_decides_has_an_edge(kick: int) -> None:
    motion = Harmonic(amplitude=2.0, frequency_ratio=3.0)
    edge = find_edge_state(DimensionlessBlock(restitution=0.87), motion, start=Steady(), kick=kick)
    assert edge.outcomes[0] == "symmetric orbit of period 1"
    assert edge.outcomes[1].startswith("overturned")


def test_what_has_no_edge_is_refused() -> None:
    motion = Harmonic(amplitude=0.5, frequency_ratio=2.0)
    with pytest.raises(ModelError, match="ends as start does"):
        find_edge_state(BARE, motion, other=State(angle=0.0, velocity=0.01))
    with pytest.raises(ModelError, match="overturns without a kick"):
        find_edge_state(BARE, motion, start=State(angle=1.5, velocity=0.5))
    with pytest.raises(InputError, match="without a phase"):
        find_edge_state(BARE, motion, other=State(angle=0.0, velocity=1.0, phase=1.0))
    with pytest.raises(InputError, match="kick"):
        find_edge_state(BARE, motion, kick=2)


def test_fast_shaking_is_tracked_until_the_block_has_come_to_its_saddle() -> None:
    block = DimensionlessBlock(restitution=0.85)
    motion = Harmonic(amplitude=0.1, frequency_ratio=300.0)
    edge = find_edge_state(block, motion)
    (saddle,) = [each for each in find_hilltop_saddles(block, motion) if each.side == 1]
    assert isinstance(edge.saddle, HilltopSaddle)
    assert edge.saddle.at(edge.motion.phase)[1] == saddle.at(edge.motion.phase)[1]
