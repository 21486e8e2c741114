"""Nodes of the forcing against a fine grid and bisection; bounds against sampling."""

import math

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from rocksteady.kernels.core.forcing import (
    LINE,
    MIXED,
    ONE_SIGN,
    SINE,
    Forcing,
    grazes,
    largest_forcing,
    make_forcing,
    mixed_node,
    next_turn,
    side_forcing,
    starts_positive,
    steepest_forcing,
)
from rocksteady.kernels.core.tables import (
    AMPLITUDE,
    CONSTANT,
    FREQUENCY,
    SEGMENT_COLUMNS,
    SLOPE,
)
from rocksteady.kernels.linear.flight import wrapped
from tests.every import every
from tests.oracles import mp
from tests.strategies import amplitudes, logarithmic, phases, sample_size

constants = st.floats(-3.0, 3.0)
slopes = st.one_of(st.floats(-4.0, 4.0), st.just(0.0))
frequencies = logarithmic(0.05, 50.0)


def value(forcing: Forcing, phase: float, time: float) -> float:
    swing = forcing.amplitude * math.sin(phase + forcing.frequency * time)
    return forcing.constant + forcing.slope * time + swing


def first_change(forcing: Forcing, phase: float, time: float, positive: bool, span: float) -> float:
    """Return where the forcing leaves its sign: a grid far finer than its period, bisection."""
    sign = 1.0 if positive else -1.0
    step = min(span - time, 2.0 * math.pi / forcing.frequency) / 4000.0
    grid = np.arange(time + step, span + step, step)
    values = sign * (
        forcing.constant
        + forcing.slope * grid
        + forcing.amplitude * np.sin(phase + forcing.frequency * grid)
    )
    below = np.flatnonzero(values < 0.0)
    if len(below) == 0 or grid[below[0]] > span:
        return span
    high = float(grid[below[0]])
    low = high - step
    for _ in range(100):
        middle = 0.5 * (low + high)
        if not low < middle < high:
            break
        low, high = (low, middle) if sign * value(forcing, phase, middle) < 0.0 else (middle, high)
    return high


@given(constants, slopes, amplitudes, frequencies)
def test_a_forcing_is_classified_by_where_its_sign_may_change(
    constant: float, slope: float, amplitude: float, frequency: float
) -> None:
    forcing = make_forcing(constant, slope, amplitude, frequency)
    if amplitude == 0.0:
        assert forcing.kind == (ONE_SIGN if slope == 0.0 else LINE)
    elif slope != 0.0:
        assert forcing.kind == MIXED
    else:
        assert forcing.kind == (SINE if abs(constant) < amplitude else ONE_SIGN)
    assert forcing.beta == pytest.approx(amplitude / (1.0 + frequency**2), rel=1e-15)
    assert forcing.swing == pytest.approx(amplitude / math.hypot(1.0, frequency), rel=1e-15)


@given(st.floats(-0.999999, 0.999999), logarithmic(1e-3, 100.0))
def test_the_rising_node_is_exact(share: float, amplitude: float) -> None:
    forcing = make_forcing(-share * amplitude, 0.0, amplitude, 2.0)
    if forcing.kind != SINE:
        return
    truth = mp.asin(-mp.mpf(forcing.constant) / mp.mpf(amplitude))
    assert abs(forcing.rising - truth) <= 4e-16
    assert abs(forcing.node_sine - mp.sin(truth)) <= 4e-16
    assert abs(forcing.node_cosine - mp.cos(truth)) <= 4e-16 * mp.cos(truth)


@every("excess", [1e-15, 1e-12, 1e-9, 1e-6])
def test_the_cosine_at_a_crest_that_barely_clears_the_threshold_keeps_its_digits(
    excess: float,
) -> None:
    amplitude = 1.0 + excess
    forcing = make_forcing(-1.0, 0.0, amplitude, 2.0)
    truth = mp.sqrt(1 - 1 / mp.mpf(amplitude) ** 2)
    assert abs(forcing.node_cosine - truth) <= 4e-16 * truth


@given(constants, slopes, amplitudes, frequencies, phases)
def test_the_sign_just_after_the_start(
    constant: float, slope: float, amplitude: float, frequency: float, phase: float
) -> None:
    forcing = make_forcing(constant, slope, amplitude, frequency)
    start = mp.mpf(constant) + mp.mpf(amplitude) * mp.sin(phase)
    if abs(start) < 1e-9:
        return
    assert starts_positive(forcing, phase) == (start > 0)


@given(constants, st.floats(-4.0, 4.0), logarithmic(0.01, 12.0), frequencies, phases)
def test_nodes_of_a_slope_with_a_sinusoid_agree_with_bisection(
    constant: float, slope: float, amplitude: float, frequency: float, phase: float
) -> None:
    forcing = make_forcing(constant, slope, amplitude, frequency)
    if forcing.kind != MIXED:
        return
    span = 3.0 * 2.0 * math.pi / frequency
    time, positive = 0.0, starts_positive(forcing, phase)
    for _ in range(3):
        found = mixed_node(forcing, phase, time, positive, span)
        truth = first_change(forcing, phase, time, positive, span)
        if found != pytest.approx(truth, rel=1e-9, abs=1e-9):
            # They may differ only about a touch, where the forcing hardly passes zero.
            earlier = min(found, truth)
            grid = earlier + np.linspace(-1e-3, 1e-3, 2001) * 2.0 * math.pi / frequency
            size = amplitude + abs(constant) + abs(slope) * span
            assert min(abs(value(forcing, phase, t)) for t in grid) < 1e-6 * size
            return
        if found >= span:
            return
        time, positive = found, not positive


@given(logarithmic(0.01, 12.0), st.floats(-4.0, 4.0), frequencies, phases, st.floats(0.0, 20.0))
def test_turns_of_a_slope_with_a_sinusoid(
    amplitude: float, slope: float, frequency: float, phase: float, time: float
) -> None:
    forcing = make_forcing(0.3, slope, amplitude, frequency)
    if forcing.kind != MIXED:
        return
    found = next_turn(forcing, phase, time)
    if abs(slope) >= amplitude * frequency:
        assert math.isinf(found)
        return
    assert found > time
    assert found <= time + 2.0 * math.pi / frequency * (1.0 + 1e-12)
    turn = slope + amplitude * frequency * math.cos(phase + frequency * found)
    blur = 1e-14 * (1.0 + frequency * found) * amplitude * frequency
    assert abs(turn) <= blur + abs(slope) * 1e-15
    # And it does not turn before.
    times = np.linspace(time, found, 50)[1:-1]
    speeds = slope + amplitude * frequency * np.cos(phase + frequency * times)
    near = np.abs(speeds) > 100.0 * blur
    assert len(set(np.sign(speeds[near]).tolist())) <= 1


@given(constants, slopes, amplitudes, frequencies, phases, st.floats(0.0, 30.0))
@example(-0.5, 0.0, 1.0, 2.0, 1.0, 0.0)
@example(-0.5, 0.0, 1.0, 2.0, 4.0, 30.0)
def test_the_largest_forcing_bounds_the_forcing(
    constant: float, slope: float, amplitude: float, frequency: float, phase: float, span: float
) -> None:
    forcing = make_forcing(constant, slope, amplitude, frequency)
    bound = largest_forcing(forcing, phase, span)
    times = np.linspace(0.0, span, sample_size(2000, 400))
    values = constant + slope * times + amplitude * np.sin(phase + frequency * times)
    rounding = 1e-13 * (abs(constant) + abs(slope) * span + amplitude * (1 + frequency * span))
    assert bound >= values.max() - rounding
    if slope == 0.0:  # then it is the maximum, not a bound alone
        spacing = frequency * span / (len(times) - 1)
        assert bound <= values.max() + amplitude * min(2.0, spacing**2 + 1e-12) + rounding


@given(slopes, amplitudes, frequencies, phases)
def test_the_steepest_forcing_bounds_the_rate(
    slope: float, amplitude: float, frequency: float, phase: float
) -> None:
    forcing = make_forcing(-1.0, slope, amplitude, frequency)
    times = np.linspace(0.0, 2.0 * math.pi / frequency, 500)
    rates = slope + amplitude * frequency * np.cos(phase + frequency * times)
    assert steepest_forcing(forcing) >= np.abs(rates).max() * (1.0 - 1e-14)


@given(st.floats(-1e6, 1e6))
def test_a_phase_is_wrapped_into_its_turn(phase: float) -> None:
    found = wrapped(phase)
    assert -0.5 * math.pi <= found < 1.5 * math.pi
    turns = (mp.mpf(phase) - found) / (2 * mp.pi)
    assert abs(turns - mp.nint(turns)) <= 1e-15 * (1 + abs(phase))


def test_a_slope_as_steep_as_the_sinusoid_never_turns() -> None:
    # A (w t -+ sin(w t)) has a point of inflection each period and no extremum.
    for amplitude, frequency in ((2.0, 1.5), (0.25, 8.0)):
        for slope in (amplitude * frequency, -amplitude * frequency):
            forcing = make_forcing(0.3, slope, amplitude, frequency)
            assert next_turn(forcing, 0.4, 0.0) == math.inf
            steeper = make_forcing(0.3, slope * (1.0 + 1e-9), amplitude, frequency)
            assert next_turn(steeper, 0.4, 0.0) == math.inf
            flatter = make_forcing(0.3, slope * (1.0 - 1e-9), amplitude, frequency)
            assert next_turn(flatter, 0.4, 0.0) < 2.0 * math.pi / frequency


def test_where_it_begins_at_zero_its_rate_decides() -> None:
    rows: list[tuple[tuple[float, float, float, float], float, bool]] = []
    for slope in (-0.5, 0.5):
        # A line through zero, and one but for rounding.
        rows += [
            ((constant, slope, 0.0, 0.0), 0.2, slope > 0.0) for constant in (0.0, 4e-16, -4e-16)
        ]
        # Away from rounding the constant decides.
        rows += [((constant, slope, 0.0, 0.0), 0.2, constant > 0.0) for constant in (1e-14, -1e-14)]
        for phase in (-1.0, 0.3, 1.2, 2.0, 3.5):
            start = -2.0 * math.sin(phase)
            rate = slope + 2.0 * 3.0 * math.cos(phase)
            rows.append(((start, slope, 2.0, 3.0), phase, rate > 0.0))
            rows.append(((start + 1e-13, slope, 2.0, 3.0), phase, True))
            rows.append(((start - 1e-13, slope, 2.0, 3.0), phase, False))
    # 2 (sin(1.5 t) - 1.5 t) is below zero from its start on.
    rows.append(((0.0, -3.0, 2.0, 1.5), 0.0, False))
    # Without a slope: a constant, a sinusoid that touches zero, and one between its nodes.
    rows += [((0.0, 0.0, 0.0, 0.0), 0.0, False), ((1e-300, 0.0, 0.0, 0.0), 0.0, True)]
    rows += [((-2.0, 0.0, 2.0, 3.0), 0.5 * math.pi, False), ((2.0, 0.0, 2.0, 3.0), 0.1, True)]
    rising = math.asin(0.25)
    for phase, positive in (
        (rising - 1e-12, False),
        (rising + 1e-12, True),
        (math.pi - rising - 1e-12, True),
        (math.pi - rising + 1e-12, False),
        (4.0, False),
        (-0.5 * math.pi, False),
    ):
        rows.append(((-0.5, 0.0, 2.0, 3.0), phase, positive))
    at_node = make_forcing(-0.5, 0.0, 2.0, 3.0)
    assert starts_positive(at_node, at_node.rising)
    assert not starts_positive(at_node, math.pi - at_node.rising)
    wrong = [row for row in rows if starts_positive(make_forcing(*row[0]), row[1]) != row[2]]
    assert not wrong, wrong


def test_a_side_sees_the_base_in_its_own_units() -> None:
    segments = np.zeros((2, SEGMENT_COLUMNS))
    segments[1, [CONSTANT, SLOPE, AMPLITUDE, FREQUENCY]] = 0.4, -0.3, 1.2, 5.0
    sides = np.array([[0.9, 0.8, 1.25], [0.9, 1.4, 0.7]])
    for elapsed in (0.0, 0.6):
        for side, (_, lean, rate) in zip((1, -1), sides.tolist(), strict=True):
            forcing = side_forcing(segments, 1, sides, side, elapsed)
            # theta'' = rate^2 (theta - lean + side a) in reference units, over lean and rate^2.
            for own in (0.0, 0.3, 1.1):
                time = own / rate
                phase = 5.0 * time + 0.7
                base = side * (0.4 - 0.3 * (elapsed + time)) + 1.2 * math.sin(phase)
                seen = forcing.constant + forcing.slope * own
                seen += forcing.amplitude * math.sin(0.7 + forcing.frequency * own)
                assert seen == pytest.approx(base / lean - 1.0, rel=1e-13), (elapsed, side, own)


def test_impacts_graze_below_a_speed_of_the_shaking() -> None:
    for amplitude, frequency, unit in (
        (0.0, 0.5, 1.0),
        (0.0, 1.0, 1.0),
        (3.0, 0.1, 1.0),
        (3.0, 4.0, 1.0),
        (3.0, 8.0, 0.5),
        (0.0, 100.0, 0.01),
    ):
        least = 1e-9 * unit
        assert grazes(least, amplitude, frequency)
        assert grazes(0.0, amplitude, frequency)
        assert not grazes(least * (1.0 + 1e-12), amplitude, frequency)
