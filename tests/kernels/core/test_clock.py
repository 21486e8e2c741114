"""The clock of a march: half cycles and a phase, against the phase in many digits."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rocksteady.kernels.core.clock import (
    clock,
    elapsed_time,
    later_clock,
    segment_end,
    segment_start,
    side_clock,
    side_phase,
    uplift_clock,
)
from rocksteady.kernels.core.forcing import make_forcing
from rocksteady.kernels.core.tables import DURATION, FREQUENCY, PHASE, SEGMENT_COLUMNS
from tests.oracles import mp

PHASES = st.floats(0.0, math.pi, exclude_max=True)
HALVES = st.integers(-1000, 1000)


def whole(half: int, phase: float) -> mp.mpf:
    return half * mp.pi + mp.mpf(phase)


@given(st.floats(-1e6, 1e6))
def test_a_phase_is_half_cycles_of_pi_and_a_rest(phase: float) -> None:
    half, rest = clock(phase)
    assert isinstance(half, int)
    assert 0.0 <= rest < math.pi
    assert abs(whole(half, rest) - phase) <= 4e-16 * (2.0 + abs(phase))


def test_a_phase_at_a_half_cycle_belongs_to_the_one_that_it_begins() -> None:
    for k in range(-50, 51):
        half, rest = clock(k * math.pi)
        # k times the double next to pi is below k pi where k > 0.
        assert abs(whole(half, rest) - mp.mpf(k * math.pi)) <= 1e-15 * (1 + abs(k))
        assert half in (k - 1, k)
    assert clock(0.0) == (0, 0.0)
    assert clock(math.nextafter(0.0, -1.0)) in {(-1, math.nextafter(math.pi, 0.0)), (0, 0.0)}


@given(HALVES, PHASES, st.sampled_from([1, -1]))
def test_a_side_sees_the_shaking_half_a_cycle_on_or_as_it_is(
    half: int, phase: float, side: int
) -> None:
    seen, moved = side_phase(half, phase, side, 2.0)
    assert -0.5 * math.pi <= seen < 1.5 * math.pi
    # What the positive side sees at half cycle 0 the negative one sees at 1.
    assert (half + moved) % 2 == (0 if side > 0 else 1) or moved == 0
    sign = (1 if half % 2 == 0 else -1) * side
    assert math.sin(seen) == pytest.approx(sign * math.sin(phase), abs=1e-15)
    assert math.cos(seen) == pytest.approx(sign * math.cos(phase), abs=1e-15)
    assert moved in (-1, 0, 1)
    assert seen == pytest.approx(phase + moved * math.pi, abs=1e-15)
    # And back again to the last digits but one.
    again, rest = side_clock(seen, moved)
    assert abs(whole(half - moved + again, rest) - whole(half, phase)) <= 2e-15


def test_without_a_sinusoid_there_are_no_half_cycles() -> None:
    assert side_phase(3, 0.7, 1, 0.0) == (0.0, 0)
    assert elapsed_time(0, 2.5, 0, 0.4, 0.0) == 2.1
    assert later_clock(0, 0.4, 0.0, 2.1) == (0, 2.5)
    segments = np.zeros((1, SEGMENT_COLUMNS))
    segments[0, [DURATION, PHASE]] = 1.7, 0.9
    assert segment_start(segments, 0) == (0, 0.0)
    assert segment_end(segments, 0) == (0, 1.7)


@given(HALVES, PHASES, st.floats(0.01, 100.0), st.floats(0.0, 50.0))
def test_a_later_clock_is_later_by_the_phase_that_is_turned(
    half: int, phase: float, frequency: float, time: float
) -> None:
    later = later_clock(half, phase, frequency, time)
    turned = mp.mpf(frequency) * mp.mpf(time)
    assert abs(whole(*later) - whole(half, phase) - turned) <= 2e-15 * (2.0 + float(turned))
    passed = elapsed_time(*later, half, phase, frequency)
    assert passed == pytest.approx(time, rel=1e-13, abs=1e-13 / frequency)


def test_a_segment_ends_where_its_phase_has_turned_to() -> None:
    segments = np.zeros((2, SEGMENT_COLUMNS))
    segments[1, [DURATION, FREQUENCY, PHASE]] = 2.5, 3.0, -0.4
    assert whole(*segment_start(segments, 1)) == pytest.approx(-0.4)
    assert whole(*segment_end(segments, 1)) == pytest.approx(7.1)
    assert elapsed_time(*segment_end(segments, 1), *segment_start(segments, 1), 3.0) == (
        pytest.approx(2.5)
    )


def test_an_uplift_is_where_the_base_pushes_as_hard_as_gravity_pulls() -> None:
    amplitude, frequency = 1.6, 3.0
    forcing = make_forcing(-1.0, 0.0, amplitude, frequency)
    for side in (1, -1):
        for half in (-3, 0, 1, 4):
            for phase in (0.0, 0.3, 0.7, 1.2, 2.9):
                begun = half * math.pi + phase
                # A side is pushed by side A sin(phase); it is held down as long as that is below 1.
                up, first = math.asin(1.0 / amplitude) + (0.0 if side > 0 else math.pi), None
                for k in range(-5, 10):
                    node = up + 2.0 * math.pi * k
                    if node >= begun and first is None:
                        first = node
                assert first is not None
                wait = (first - begun) / frequency
                found = uplift_clock(half, phase, frequency, wait, side, forcing)
                assert float(whole(*found)) == pytest.approx(first, abs=1e-13), (side, half, phase)
    # Of other forcings the wait says it.
    line = make_forcing(-1.0, 0.5, 0.0, 0.0)
    assert uplift_clock(0, 0.3, 0.0, 1.5, 1, line) == (0, 1.8)
    mixed = make_forcing(-1.0, 0.5, 1.6, 3.0)
    assert uplift_clock(2, 0.3, 3.0, 0.5, 1, mixed) == later_clock(2, 0.3, 3.0, 0.5)
