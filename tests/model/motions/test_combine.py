"""Motions made of motions, against the values of their parts."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rocksteady import Harmonic, Piecewise, Pulse, Record, Still
from rocksteady.dynamics.history.base_motion import base_acceleration
from rocksteady.errors import InputError, ModelError
from rocksteady.model.linear_tables import segment_table
from rocksteady.motions import Impulses, Segment, add, cut, delay, join, scale
from tests.every import every
from tests.model.motions.test_pulses import Floats, acceleration

SINE = Pulse(shape="one-sine", amplitude=2.0, frequency_ratio=4.0)
TRIANGLE = Pulse(shape="triangle", amplitude=3.0, frequency_ratio=2.0)
GRID = np.linspace(0.0, 8.0, 9973)

segments = st.builds(
    Segment,
    duration=st.floats(0.1, 3.0),
    constant=st.floats(-3.0, 3.0),
    slope=st.floats(-2.0, 2.0),
    amplitude=st.floats(-3.0, 3.0),
    frequency=st.just(2.5),
    phase=st.floats(-7.0, 7.0),
)
motions = st.lists(segments, max_size=4).map(lambda pieces: Piecewise(pieces=tuple(pieces)))


def away_from_edges(s: Floats, *parts: Any) -> Floats:
    """The times that are not within rounding of where a segment begins or ends."""
    starts = np.concatenate(
        [[0.0], *(np.cumsum([p.duration for p in part.segments()]) for part in parts)]
    )
    clear: Floats = s[np.abs(s[:, None] - starts).min(axis=1) > 1e-9]
    return clear


@given(motions, st.floats(-5.0, 5.0))
def test_scaled(motion: Piecewise, factor: float) -> None:
    found = acceleration(scale(motion, factor), GRID)
    np.testing.assert_allclose(found, factor * acceleration(motion, GRID), rtol=0.0, atol=2e-13)


@given(motions, st.floats(0.0, 3.0))
def test_delayed(motion: Piecewise, by: float) -> None:
    s = away_from_edges(GRID, delay(motion, by))
    before = np.where(s < by, 0.0, acceleration(motion, np.maximum(s - by, 0.0)))
    np.testing.assert_allclose(acceleration(delay(motion, by), s), before, rtol=0, atol=1e-12)


def test_joined() -> None:
    both = join(SINE, Still(), TRIANGLE)
    assert both.segments() == SINE.segments() + TRIANGLE.segments()
    endless = join(SINE, Harmonic(amplitude=1.0, frequency_ratio=2.0))
    assert endless.segments()[-1].duration == math.inf
    with pytest.raises(ModelError, match="only the last segment may be endless"):
        join(Harmonic(amplitude=1.0, frequency_ratio=2.0), SINE)


@pytest.mark.slow
@given(st.lists(motions, max_size=4))
@settings(max_examples=60)
def test_sums_of_one_frequency_are_exact(parts: list[Piecewise]) -> None:
    total = add(*parts)
    s = away_from_edges(GRID, *parts)
    expected = sum((acceleration(part, s) for part in parts), np.zeros(len(s)))
    np.testing.assert_allclose(acceleration(total, s), expected, rtol=0.0, atol=1e-12)
    assert len(total.segments()) <= 1 + sum(len(part.segments()) for part in parts)


@every("tolerance", [1e-2, 1e-4, 1e-6])
def test_sums_of_several_frequencies_keep_their_tolerance(tolerance: float) -> None:
    later = delay(Pulse(shape="type-c1", amplitude=1.0, frequency_ratio=7.0), 0.5)
    total = add(SINE, later, TRIANGLE, tolerance=tolerance)
    s = away_from_edges(GRID, SINE, later, TRIANGLE)
    expected = acceleration(SINE, s) + acceleration(later, s) + acceleration(TRIANGLE, s)
    error = np.abs(acceleration(total, s) - expected)
    assert 0.3 * tolerance < error.max() <= tolerance
    exact = (s < 0.5) | (s > SINE.duration)  # where one of the two frequencies is alone
    assert error[exact].max() < 1e-11


def test_impulses_add_up_and_are_kept() -> None:
    hits = Impulses(velocities=(0.5, -0.25), times=(0.2, 0.5))
    once = Impulses(velocities=(0.125,), times=(0.2,))
    fast = Pulse(shape="one-sine", amplitude=1.0, frequency_ratio=9.0)
    total = add(hits, once, SINE, fast)
    table = segment_table(total)
    struck = np.flatnonzero(table[:, 1])
    starts = np.concatenate([[0.0], np.cumsum(table[:-1, 0])])
    np.testing.assert_allclose(starts[struck], [0.2, 0.5], atol=1e-14)
    np.testing.assert_array_equal(table[struck, 1], [0.625, -0.25])
    assert scale(hits, -2.0).segments()[1].jump == -1.0


def test_times_that_differ_by_rounding_are_one() -> None:
    third = Pulse.lasting(0.1, shape="rectangle", amplitude=1.0)
    first = join(third, third, third)  # 0.30000000000000004
    second = Pulse.lasting(0.3, shape="rectangle", amplitude=1.0)
    total = add(first, second)
    assert [piece.constant for piece in total.segments()] == [2.0, 2.0, 2.0]


def test_wavelets_are_added_line_by_line() -> None:
    first = Pulse(shape="ricker", amplitude=2.0, frequency_ratio=3.0)
    second = Pulse(shape="mavroeidis-papageorgiou", amplitude=1.0, frequency_ratio=4.0)
    total = add(first, delay(second, 1.0))
    s = np.linspace(0.0, 6.0, 5003)
    later = np.where(s < 1.0, 0.0, acceleration(second, np.maximum(s - 1.0, 0.0)))
    np.testing.assert_allclose(acceleration(total, s), acceleration(first, s) + later, atol=1e-11)


def test_the_jump_of_a_segment_too_short_to_last_is_kept() -> None:
    blink = Segment(duration=1e-14, jump=0.5)
    motion = Piecewise(pieces=(Segment(duration=1.0), blink, Segment(duration=1.0, jump=0.25)))
    assert [piece.jump for piece in add(motion, SINE).segments() if piece.jump] == [0.75]


def test_two_harmonic_shakings_of_one_frequency_are_one() -> None:
    first = Harmonic(amplitude=3.0, frequency_ratio=2.0)
    second = Harmonic(amplitude=4.0, frequency_ratio=2.0, phase=0.5 * math.pi)
    (total,) = add(first, second).segments()
    assert total.duration == math.inf
    assert total.amplitude == pytest.approx(5.0, rel=1e-15)
    assert total.phase == pytest.approx(math.atan2(4.0, 3.0), rel=1e-15)


def test_what_opposes_itself_is_still() -> None:
    total = add(SINE, scale(SINE, -1.0))
    assert np.abs(acceleration(total, GRID)).max() < 1e-15


def test_the_sum_of_nothing_is_still() -> None:
    assert add().segments() == ()
    assert add(Still(), Still()).segments() == ()


def test_what_cannot_be_made_is_refused() -> None:
    beats = (
        Harmonic(amplitude=1.0, frequency_ratio=2.0),
        Harmonic(amplitude=1.0, frequency_ratio=math.sqrt(3.0)),
    )
    with pytest.raises(ModelError, match=r"whole multiples of one frequency"):
        add(*beats)
    with pytest.raises(InputError, match=r"^tolerance = 0"):
        add(SINE, TRIANGLE, tolerance=0.0)
    with pytest.raises(InputError, match=r"^by = -1"):
        delay(SINE, -1.0)
    with pytest.raises(InputError, match=r"^factor = nan"):
        scale(SINE, math.nan)
    # a sum that ends may hold one that does not
    assert base_acceleration(segment_table(add(beats[0], TRIANGLE)), 100.0) == pytest.approx(
        math.sin(200.0), abs=1e-12
    )


def test_a_scaled_record_is_a_record() -> None:
    record = Record(acceleration_m_s2=np.array([0.0, 2.0, -1.0]), dt_s=0.02, name="hut")
    twice = scale(record, -2.0)
    assert isinstance(twice, Record)
    assert twice == record.scaled(-2.0)
    assert twice.acceleration_m_s2.tolist() == [0.0, -4.0, 2.0]
    with pytest.raises(InputError, match="must not be 0"):
        scale(record, 0.0)


@given(motions, st.floats(0.0, 15.0))
def test_cut_off(motion: Piecewise, at: float) -> None:
    found = cut(motion, at)
    s = away_from_edges(GRID, motion, found)
    expected = np.where(s < at, acceleration(motion, s), 0.0)
    np.testing.assert_array_equal(acceleration(found, s), expected)
    whole = sum(piece.duration for piece in motion.segments())
    assert sum(piece.duration for piece in found.segments()) == pytest.approx(min(at, whole))


def test_of_endless_shaking_a_part_is_taken() -> None:
    shaking = Harmonic(amplitude=2.0, frequency_ratio=4.0, phase=1.0)
    (piece,) = cut(shaking, 7.5).segments()
    assert (piece.duration, piece.phase) == (7.5, 1.0)
    assert cut(shaking, 0.0).segments() == ()
    struck = Impulses(velocities=(0.5, 0.5), times=(0.0, 3.0))
    assert len(cut(struck, 3.0).segments()) == 1
    with pytest.raises(InputError, match="at"):
        cut(shaking, -1.0)
    with pytest.raises(InputError, match="motion"):
        cut(Record(acceleration_m_s2=[0.0, 1.0], dt_s=0.1), 0.1)  # type: ignore[arg-type]
