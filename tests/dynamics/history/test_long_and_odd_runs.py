"""Runs at the edges: long pieces, slow shaking, hardly any loss, odd starts and odd arguments."""

import math
from collections.abc import Iterable
from typing import Any

import numpy as np
import pytest

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    Piecewise,
    Rest,
    State,
    Status,
    Steady,
    Still,
    simulate,
)
from rocksteady.errors import InputError
from rocksteady.model.equations import Linear, Model, Nonlinear
from rocksteady.motions import Segment
from tests.every import every

BLOCK = DimensionlessBlock(restitution=0.8)
MODELS: tuple[Model, ...] = (Linear(), Nonlinear())


@every("duration", [190.0, 210.0, 1e3, 1e5, 1e6])
def test_a_long_quiet_segment_is_free_rocking(duration: float) -> None:
    start = State(angle=0.5, velocity=0.0)
    free = simulate(BLOCK, Still(), start=start)
    long = simulate(BLOCK, Piecewise(pieces=(Segment(duration=duration),)), start=start)
    assert long.status is Status.AT_REST
    assert long.peak == free.peak == 0.5
    assert long.impacts.pt[0] == pytest.approx(math.acosh(2.0), rel=1e-15)
    np.testing.assert_allclose(long.impacts.pt, free.impacts.pt, rtol=1e-13)
    assert long.rest_time_pt == pytest.approx(free.rest_time_pt, rel=1e-13)


@every("ratio", [0.01, 0.015, 0.02, 0.022])
def test_slow_shaking_is_followed_as_closely_as_fast(ratio: float) -> None:
    # Slow shaking cut into short pieces is the same shaking.
    rng = np.random.default_rng(int(1e4 * ratio))
    for _ in range(12):
        amplitude, phase = rng.uniform(0.1, 0.99), rng.uniform(0.0, 2.0 * math.pi)
        start = State(angle=rng.uniform(-0.3, 0.3), velocity=rng.uniform(-0.1, 0.1))
        whole = simulate(
            BLOCK, Harmonic(amplitude=amplitude, frequency_ratio=ratio, phase=phase), start=start
        )
        pieces = tuple(
            Segment(
                duration=10.0,
                amplitude=amplitude,
                frequency=ratio,
                phase=phase + 10.0 * ratio * number,
            )
            for number in range(12)
        )
        cut = simulate(BLOCK, Piecewise(pieces=pieces), start=start)
        early = whole.impacts.pt[(whole.impacts.pt < 100.0)][:8]
        np.testing.assert_allclose(cut.impacts.pt[: len(early)], early, rtol=1e-11)
        assert whole.peak <= 1.0 or whole.status is Status.OVERTURNED


@every("restitution", [0.5, 0.8, 0.9, 0.99, 0.999])
def test_rest_comes_after_the_whole_series_of_bounces(restitution: float) -> None:
    # Half of the energy left to the upright position shrinks by r^2 an impact; a half swing of
    # height phi lasts 2 atanh(sqrt(1 - (1 - phi)^2)), of which the first is only half.
    run = simulate(
        DimensionlessBlock(restitution=restitution), Still(), start=State(angle=0.6, velocity=0.0)
    )
    energy, total = 1.0 - 0.4**2, math.atanh(math.sqrt(1.0 - 0.4**2))
    while energy > 1e-34:
        energy *= restitution**2
        total += 2.0 * math.atanh(math.sqrt(energy))
    assert run.rest_time_pt == pytest.approx(total, rel=1e-12)


def test_a_block_that_never_moves_rests_from_the_start() -> None:
    run = simulate(BLOCK, Piecewise(pieces=(Segment(duration=5.0, constant=1.0),)))
    assert run.rest_time_pt == 0.0
    assert run.peak == 0.0


def test_hardly_any_loss_still_ends_at_rest_and_none_at_all_goes_on_rocking() -> None:
    start = State(angle=0.6, velocity=0.0)
    little = simulate(DimensionlessBlock(restitution=0.9999), Still(), start=start)
    assert little.status is Status.AT_REST
    none = simulate(DimensionlessBlock(restitution=1.0), Still(), start=start)
    assert none.status is Status.ROCKING
    assert none.end_time_pt == pytest.approx(1e4)
    np.testing.assert_allclose(np.diff(none.impacts.pt), 2.0 * none.impacts.pt[0], rtol=1e-9)


@every("velocity", [1e-300, 1e-30, 1e-22, 1e-14])
def test_what_moves_off_the_balance_by_less_than_rounding_falls_or_comes_back(
    velocity: float,
) -> None:
    block = Block.from_p(alpha=0.2, p=2.0, restitution=0.8)
    for side in (1, -1):
        for model in MODELS:
            outwards, back = (
                simulate(block, Still(), start=State(angle=side, velocity=v), model=model)
                for v in (side * velocity, -side * velocity)
            )
            assert outwards.status is Status.OVERTURNED
            assert back.status is Status.AT_REST
            assert outwards.peak == back.peak == 1.0
            assert len(outwards.impacts) == 0 < len(back.impacts)


def test_a_block_balanced_for_ever_can_be_drawn() -> None:
    run = simulate(BLOCK, Still(), start=State(angle=1.0, velocity=0.0))
    assert run.status is Status.ROCKING
    assert (run(run.times()).angle == 1.0).all()


def never_backwards(restitution: float, exponents: Iterable[int]) -> None:
    """Runs from velocities down to the smallest: time rises and no angle is nan."""
    shaking = Harmonic(amplitude=4.04, frequency_ratio=3.33, phase=0.2496)
    for exponent in exponents:
        for side in (1.0, -1.0):
            run = simulate(
                DimensionlessBlock(restitution=restitution),
                shaking,
                start=State(angle=0.0, velocity=side * 10.0**exponent),
                cycles=3,
            )
            assert (np.diff(run.flights.pt) >= 0.0).all()
            assert np.isfinite(run(run.times(5)).angle).all()


@pytest.mark.slow
def test_time_never_runs_backwards() -> None:
    never_backwards(0.6, range(-300, -10, 7))
    never_backwards(1.0, (-300, -104, -13))


@pytest.mark.slow
def test_time_never_runs_backwards_in_millions_of_bounces() -> None:
    """Without loss a velocity of 1e-55 bounces until the run's limit of flights is reached."""
    never_backwards(1.0, (-55,))


def test_a_start_that_is_zero_but_for_rounding_lifts_to_where_the_base_pushes() -> None:
    # sin(pi) is 1e-16 and not 0: it is the slope of 6 - 6 = 0 and the curvature that decide nothing
    # here, and 1 + 1e-16 must not lift the block to the negative side.
    ramp = Segment(
        duration=10.0, amplitude=2.0, frequency=3.0, phase=math.pi, slope=12.0, constant=1.0
    )
    run = simulate(BLOCK, Piecewise(pieces=(ramp,)))
    assert run.flights.side[0] == 1


@every("start", ["steady", (0.5, 0.0), Steady, 3])
def test_what_is_no_start_is_refused(start: Any) -> None:
    with pytest.raises(InputError, match="start"):
        simulate(BLOCK, Harmonic(amplitude=2.0, frequency_ratio=4.0), start=start)


def test_what_is_no_block_or_no_motion_is_refused() -> None:
    shaking = Harmonic(amplitude=2.0, frequency_ratio=4.0)
    nothing: Any = None
    with pytest.raises(InputError, match="block"):
        simulate(nothing, shaking)
    swapped: Any = shaking
    other: Any = BLOCK
    with pytest.raises(InputError, match="block comes first"):
        simulate(swapped, other)
    with pytest.raises(InputError, match="motion"):
        simulate(BLOCK, nothing, start=Rest())


@every("phase", [1e17, -1e19, 1.1e6])
def test_a_phase_without_digits_is_refused(phase: float) -> None:
    with pytest.raises(InputError, match="phase"):
        Harmonic(amplitude=2.0, frequency_ratio=4.0, phase=phase)
    with pytest.raises(InputError, match="phase"):
        Segment(duration=1.0, amplitude=2.0, frequency=4.0, phase=phase)


@every("pieces", [None, Segment(duration=1.0), ((1.0, 2.0),)])
def test_what_is_no_list_of_segments_is_refused(pieces: Any) -> None:
    with pytest.raises(InputError, match="Segments"):
        Piecewise(pieces=pieces)


def test_cycles_count_from_the_start_of_an_endless_last_segment() -> None:
    shaken = Piecewise(
        pieces=(
            Segment(duration=2.0, constant=0.5),
            Segment(duration=math.inf, amplitude=2.0, frequency=4.0),
        )
    )
    run = simulate(BLOCK, shaken, cycles=7)
    assert run.end_time_pt == pytest.approx(2.0 + 7.0 * 2.0 * math.pi / 4.0, rel=1e-14)


def test_impacts_after_the_last_flight_are_counted_where_a_run_ends_at_its_limit() -> None:
    # On a still base each impact leaves r times as fast as it comes: fewer than 1e-6 do not count.
    for block in (BLOCK, Block.from_p(alpha=0.2, p=2.0, restitution=0.9)):
        start = State(angle=0.5, velocity=0.0)
        whole = simulate(block, Still(), start=start)
        for flights in (3, 10, 30):
            short = simulate(block, Still(), start=start, max_flights=flights)
            assert short.status is Status.AT_REST
            assert len(short.rows) == flights
            assert short.impacts_left_out == len(whole.impacts) - len(short.impacts) > 0
            assert short.impact_count == whole.impact_count == len(whole.impacts)
        assert whole.impacts_left_out == 0
